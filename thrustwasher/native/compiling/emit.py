"""A kernel module as one self-contained LLVM module.

``python -m thrustwasher.native.compiling.emit KERNEL DIGEST FILE`` runs in a process of its own,
since numba reads its settings once, when it is imported. Of the callbacks that numba makes only the
functions inside are taken. The bitcode is not optimised and names no CPU's instructions: ``lower``
makes each platform's object of it.
"""

import gc
import importlib
import os
import sys
import warnings
from collections.abc import Iterable
from pathlib import Path
from types import ModuleType
from typing import Any

from ...errors import EnvironmentProblem
from ..digest import digest
from . import lean
from .callbacks import callbacks

REPORTED = 2  # exit status: the last line on stderr is the message for the user


def environment(cache: str) -> dict[str, str]:
    """Return the environment numba has to find, nothing of the caller's settings of numba.

    Without a name of the CPU numba would write for this machine's. The cache folder has to be
    empty: numba's cache does not see the optimisation level or edits of called functions, and would
    hand out what another setting had made. Names inside the module must not depend on the order
    of a set.
    """
    own = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    return own | {
        "NUMBA_CPU_NAME": "x86-64-v2",
        "NUMBA_CPU_FEATURES": "",
        "NUMBA_OPT": "0",
        "NUMBA_DISABLE_INTEL_SVML": "1",
        "NUMBA_CACHE_DIR": cache,
        "NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING": "1",  # thousands, none of which is shown
        "THRUSTWASHER_KERNELS": "emit",
        "PYTHONHASHSEED": "0",
    }


def module(kernel: ModuleType) -> Any:
    """Return one module with all entries, external and hidden; everything else is internal."""
    entries = callbacks(kernel)
    whole = lean.module(entries)
    hide(whole, [callback.symbol for callback in entries])
    return whole


def hide(whole: Any, names: Iterable[str]) -> None:
    """Make everything but the entries internal, and drop what no entry uses."""
    import llvmlite.binding as llvm

    for value in (*whole.functions, *whole.global_variables):
        if value.name in names:
            value.visibility = "hidden"
        elif not value.is_declaration:
            value.linkage = "internal"
    machine = llvm.Target.from_triple(whole.triple).create_target_machine()
    builder = llvm.create_pass_builder(machine, llvm.create_pipeline_tuning_options())
    passes = llvm.create_new_module_pass_manager()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(whole, builder)
    whole.verify()


def main(arguments: list[str]) -> int:
    """Write the bitcode of a kernel module."""
    import llvmlite.binding as llvm

    name, expected, file = arguments
    warnings.filterwarnings("ignore", message=r"[\s\S]*Cannot cache compiled function")
    llvm.initialize_all_targets()
    gc.set_threshold(100_000, 10, 10)  # little is garbage here, and looking for it takes long
    try:
        whole = module(importlib.import_module(name))
        digest.cache_clear()
        if digest(name) != expected:
            raise EnvironmentProblem(f"{name}: its source changed meanwhile; start again")
    except EnvironmentProblem as problem:
        print(problem, file=sys.stderr)
        return REPORTED
    Path(file).write_bytes(whole.as_bitcode())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
