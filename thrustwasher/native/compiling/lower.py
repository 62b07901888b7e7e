"""From bitcode to an object file for one platform and CPU level.

``python -m thrustwasher.native.compiling.lower BITCODE PLATFORM LEVEL KERNEL FILE``, the level as
JSON; a process of its own uses another core.
"""

import json
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from ...errors import EnvironmentProblem
from ..targets import TARGETS, Level, Platform
from . import emit, gate


def object_code(bitcode: bytes, platform: Platform, level: Level, kernel: str) -> bytes:
    """Return an object file with the entries as ``tw_<entry>_<level>``, passed by the gate."""
    import llvmlite.binding as llvm

    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    module = llvm.parse_bitcode(bitcode)
    if not _takes_attributes():
        level = replace(level, attribute="")
    reloc = "static" if platform.format == "WASM" else "pic"
    options = {"cpu": level.cpu, "features": "", "opt": 3, "codemodel": "default", "reloc": reloc}
    machine = llvm.Target.from_triple(platform.triple).create_target_machine(**options)
    module.triple, module.data_layout = platform.triple, str(machine.target_data)
    for function in module.functions:
        if function.is_declaration:
            continue
        if function.linkage.name == "external":
            function.name = f"{function.name}_{level.name}"
        if level.attribute and is_of(function.name, level.grouped):
            function.add_function_attribute("noinline")
            function.add_function_attribute("optsize")
        elif level.attribute and is_of(function.name, level.quick):
            function.add_function_attribute("noinline")
        elif level.attribute and not is_of(function.name, level.free):
            function.add_function_attribute(level.attribute)
    # internal names get numbers: the compiler's hold addresses and differ
    for letter, values in (("f", module.functions), ("g", module.global_variables)):
        inside = [v for v in values if v.linkage.name in ("internal", "private")]
        for number, value in enumerate(inside):
            value.name = f"{letter}.{number}"
    _optimise(module, machine, level)
    gate.check_module(module, kernel)
    code = bytes(machine.emit_object(module))
    gate.check_object(code, kernel)
    return code


def is_of(symbol: str, modules: tuple[str, ...]) -> bool:
    """Tell if a function, by the name that numba gave it, is of one of these modules."""
    names = ("".join(f"{len(p)}{p}" for p in name.split(".")) for name in modules)
    return any(name in symbol for name in names)


@cache
def _takes_attributes() -> bool:
    """Tell if a function's attributes can be set: llvmlite 0.45 to 0.47 put them elsewhere.

    Without them code gets larger, the numbers stay.
    """
    import llvmlite.binding as llvm

    module = llvm.parse_assembly("define void @f() {\n ret void\n}\n")
    for function in module.functions:
        function.add_function_attribute("optsize")
    try:
        module.verify()
    except RuntimeError:
        return False
    return True


def _optimise(module: Any, machine: object, level: Level) -> None:
    import llvmlite.binding as llvm

    options = llvm.create_pipeline_tuning_options(speed_level=level.speed)
    options.loop_unrolling = level.unrolling
    options.loop_vectorization = options.slp_vectorization = level.vectorization
    if level.inlining is not None:
        options.inlining_threshold = level.inlining
    builder = llvm.create_pass_builder(machine, options)
    passes = builder.getModulePassManager()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, builder)
    module.verify()


def main(arguments: list[str]) -> int:
    """Write one object file."""
    bitcode, platform, level, kernel, file = arguments
    settings = Level(**json.loads(level))
    try:
        code = object_code(Path(bitcode).read_bytes(), TARGETS[platform], settings, kernel)
    except EnvironmentProblem as problem:
        print(problem, file=sys.stderr)
        return emit.REPORTED
    Path(file).write_bytes(code)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
