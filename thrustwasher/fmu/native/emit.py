"""A model's kernel entries as one self-contained LLVM module: ``python -m ... KERNEL FILE``.

Runs in a process of its own, since numba reads its settings once, when it is imported. numba makes
of each entry a C callback around a compiled function. The callback holds all that needs Python
(lock, exceptions) and falls away here; what stays takes numbers and needs libm at most. The bitcode
is not optimised and names no CPU's instructions: ``lower.py`` makes each platform's object of it.
"""

import importlib
import os
import re
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

from ...errors import EnvironmentProblem

ENTRIES = {"derive": "derive", "broken_rule": "rule", "step": "step", "sens": "sens"}
SAID = 2  # exit status: the last line on stderr is the message for the user
# Reference counts of arrays. The caller owns all memory, there is nothing to count.
_COUNTING = re.compile(
    r"^define linkonce_odr void @(NRT_incref|NRT_decref)\([^\n]*\{\n.*?^\}\n", re.M | re.S
)
_NOTHING = r"define internal void @\1(ptr %p) alwaysinline {\n  ret void\n}\n"


def environment(cache: str) -> dict[str, str]:
    """Return the environment numba has to find, nothing of the caller's settings of numba.

    Without a name of the CPU numba would write for this machine's. The cache folder has to be
    empty: numba's cache does not see the optimisation level or edits of called functions, and would
    hand out what another setting had made.
    """
    own = {name: value for name, value in os.environ.items() if not name.startswith("NUMBA_")}
    return own | {
        "NUMBA_CPU_NAME": "x86-64-v2", "NUMBA_CPU_FEATURES": "", "NUMBA_OPT": "0",
        "NUMBA_DISABLE_INTEL_SVML": "1", "NUMBA_CACHE_DIR": cache,
    }  # fmt: skip


def entries(kernel: ModuleType) -> dict[str, tuple[Any, tuple[str, ...]]]:
    """Return symbol -> (kernel function, sizes of its arrays; "" for a number)."""
    arrays = ("NPAR", "NINP", "NSTATE", "NWORK")
    known = {
        "derive": ("NPAR",),
        "broken_rule": ("NPAR",),
        "step": (*arrays, "NOUT", "NIOUT", "", ""),
        "sens": (*arrays, "NINP", "NOUT"),
    }
    return {
        f"tw_{ENTRIES[name]}": (getattr(kernel, name), sizes)
        for name, sizes in known.items()
        if hasattr(kernel, name)
    }


def callback(function: Any, sizes: tuple[str, ...], kernel: ModuleType) -> Any:
    """Return numba's C callback around a kernel entry that takes bare pointers and numbers."""
    import numba

    compiler: Any = numba  # its annotations lag behind it
    types = compiler.types
    number = types.float64
    pointer = {"NIOUT": types.CPointer(types.int32), "": number}
    kinds = [pointer.get(size, types.CPointer(number)) for size in sizes]
    names = [f"a{i}" for i in range(len(sizes))]
    given = [f"carray({n}, {size})" if size else n for n, size in zip(names, sizes, strict=True)]
    scope = {"carray": compiler.carray, "function": function}
    scope |= {size: getattr(kernel, size) for size in sizes if size}
    exec(f"def entry({', '.join(names)}):\n return function({', '.join(given)})\n", scope)
    make = compiler.cfunc(types.int32(*kinds), error_model="numpy", boundscheck=False)
    return make(scope["entry"])


def function_in(made: Any) -> tuple[str, str]:
    """Return (text of the module, name) of the compiled function inside a C callback."""
    text, name = made.inspect_llvm(), made.native_name
    if not name.startswith("cfunc."):
        raise _unknown_numba(f"a callback is named {name[:40]!r}, not 'cfunc.' and its function")
    name = name.removeprefix("cfunc.")
    text, changed = _COUNTING.subn(_NOTHING, text)
    if changed != 2:
        raise _unknown_numba(f"{changed} definitions of NRT_incref and NRT_decref, expected 2")
    convention = r"\(ptr [^\n]*%retptr, ptr [^\n]*%excinfo"
    head = re.search(rf'^define i32 @"?{re.escape(name)}"?{convention}', text, re.M)
    if not head:
        raise _unknown_numba("a compiled function is not int32 f(result *, void **, arguments)")
    return text, name


def _unknown_numba(what: str) -> EnvironmentProblem:
    import numba

    return EnvironmentProblem(
        f"numba {numba.__version__} is not known to the native build: {what}; "
        "pip install 'thrustwasher[build]' brings the version it was tested with"
    )


def spare_machine_code() -> None:
    """Keep numba from compiling each function for this process too: a third of the time.

    Not public in numba: where the two methods are missing it only takes longer.
    """
    from numba.core import codegen

    library: Any = getattr(codegen, "JITCodeLibrary", None)
    if hasattr(library, "_finalize_specific") and hasattr(library, "_ensure_finalized"):
        library._finalize_specific = lambda self: None
        library.get_pointer_to_function = lambda self, name: self._ensure_finalized() or 1


def module(kernel: ModuleType, say: Callable[[str], None]) -> Any:
    """Return one module with all entries, external and hidden; everything else is internal."""
    import llvmlite.binding as llvm

    whole, names = None, []
    for symbol, (function, sizes) in entries(kernel).items():
        start = time.perf_counter()
        text, name = function_in(callback(function, sizes, kernel))
        part = llvm.parse_assembly(text)
        entry = part.get_function(name)
        entry.name, entry.linkage = symbol, "external"
        names.append(symbol)
        if whole is None:
            whole = part
        else:  # what both call is there once: functions of the same name are merged
            whole.link_in(part)
        say(f"{symbol} {time.perf_counter() - start:.1f} s")
    _hide(whole, names)
    return whole


def _hide(whole: Any, names: list[str]) -> None:
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

    name, file = arguments
    warnings.filterwarnings("ignore", message=r"[\s\S]*Cannot cache compiled function")
    llvm.initialize_all_targets()
    spare_machine_code()
    try:
        whole = module(importlib.import_module(name), print)
    except EnvironmentProblem as problem:
        print(problem, file=sys.stderr)
        return SAID
    Path(file).write_bytes(whole.as_bitcode())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
