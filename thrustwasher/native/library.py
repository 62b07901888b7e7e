"""The library of this machine: a kernel module's functions where Python can call them."""

import ctypes
import os
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from ..errors import EnvironmentProblem
from . import binaries, files, link, mathematics, shipped
from .digest import HERE, read
from .entries import symbols
from .files import Note, to_stderr
from .kept import forget_old, kept_folder
from .link import this_level, this_platform
from .signatures import Kind, entries
from .targets import WEB, Platform

TABLE = "tw_table"  # the one function a library shows: the addresses of the others, in their order
Addresses = dict[str, int]  # symbol -> address
Objects = Mapping[tuple[str, str], bytes]  # (platform, level) -> object file
_failed: dict[str, EnvironmentProblem] = {}  # what cannot be had is not tried at every call


def addresses(kernel: str) -> Addresses:
    """Return where the functions of a kernel module are, after loading its library.

    It is one kept from an earlier run, else the one shipped, which is that of the model's FMUs,
    else it is linked; where nothing can link, or nothing that is kept may run, the object is loaded
    by llvmlite. EnvironmentProblem: none of it works.
    """
    if kernel in _failed:
        raise _failed[kernel]
    try:
        return _found(kernel)
    except EnvironmentProblem as problem:
        _failed[kernel] = problem
        raise


@cache
def _found(kernel: str) -> Addresses:
    platform = this_platform()
    try:
        kept = _kept_file(kernel, platform)
    except OSError:  # nothing can be written, not even for a while
        return _by_llvm(kernel, platform)
    if files.kept(kept) is not None and (found := _loaded(kernel, kept)):
        return found
    own = shipped.library(kernel, platform.name)
    if own is None:
        return _made(kernel, kept)
    return _placed(kernel, kept, own) or _by_llvm(kernel, platform)


def _kept_file(kernel: str, platform: Platform) -> Path:
    name = f"{shipped.short(kernel)}-{platform.name}-{mathematics.digest()}"
    return kept_folder(kernel) / f"{name}.{platform.extension}"


def local_platform(kernel: str) -> Platform:
    """Return this machine's platform, with its processor's level alone where nothing is shipped."""
    platform = this_platform()
    is_whole = shipped.has_objects(kernel) or len(platform.levels) == 1
    return platform if is_whole else replace(platform, levels=(this_level(platform),))


def _made(kernel: str, path: Path) -> Addresses:
    """Link a library and load it."""
    one = local_platform(kernel)
    code = _objects(kernel, one)
    try:
        data = linked_library(kernel, one, code, linker=link.local_linker())
    except EnvironmentProblem:
        return _by_llvm(kernel, one)
    return _placed(kernel, path, data) or _by_llvm(kernel, one)


def _objects(kernel: str, platform: Platform) -> Objects:
    """Return the objects of a kernel module: shipped, kept or compiled now."""
    from .compiling.objects import objects  # no run that finds a library needs it

    return objects(kernel, [platform])


def _placed(kernel: str, path: Path, data: bytes) -> Addresses:
    """Return the addresses in a library after keeping it; none if no folder lets it be loaded."""
    forget_old(kernel, files.code_folder())
    for place in (path, files.private_folder() / path.name):
        try:
            files.keep(place, data)
        except OSError as error:
            if files.kept(place) is None:  # nor has another process just written it
                to_stderr(f"{place} is not kept: {error.strerror or error}")
                continue
        if found := _loaded(kernel, place):
            return found
    return {}


def linked_library(
    kernel: str, platform: Platform, code: Objects, linker: link.Linker | None = None
) -> bytes:
    """Return the objects of a kernel module linked to a library for Python alone, checked."""
    parts, name = table_sources(kernel), shipped.short(kernel)
    return linked_objects(parts, code, platform, name, [TABLE], linker=linker)


def table_sources(kernel: str) -> dict[str, bytes]:
    """Return the C files that make a library show what Python calls; for FMUs' libraries too."""
    names = " ".join(f"X({name})" for name in symbols(kernel))
    own = {name: read(HERE / "c" / name) for name in ("cpu.h", "library.c")}
    return own | {"symbols.h": f"#define SYMBOLS(X) {names}\n".encode()}


def web_module(kernel: str) -> bytes:
    """Return the module of a kernel module for browsers: the one shipped, else linked now."""
    shown = shipped.web_file(kernel)
    return shown.read_bytes() if shown else linked_library(kernel, WEB, _objects(kernel, WEB))


def web_functions(kernel: str, names: Iterable[str]) -> dict[str, dict[str, Any]]:
    """Return for JavaScript: name -> place in the table, words it takes, numbers that come back."""
    order, found = symbols(kernel), {}
    for entry in entries(kernel):
        name = getattr(entry.function, "py_func", entry.function).__name__
        if name in names:
            takes = [word for kind in entry.takes for word in _flat(kind)]
            place, numbers = order.index(entry.symbol), len(entry.returns)
            more = {"returns": numbers, "tuple": entry.is_tuple}
            found[name] = {"place": place, "takes": takes, **more}
    return found


def _flat(kind: Kind) -> list[str]:
    """Return the kinds of an argument's parts: "array", "table", "float", "int" or "bool"."""
    if kind.parts:
        return [word for part in kind.parts for word in _flat(part)]
    return ["table" if kind.ndim == 2 else kind.name]


def linked_objects(
    sources: Mapping[str, str | bytes],
    code: Objects,
    platform: Platform,
    name: str,
    exports: Iterable[str],
    *,
    linker: link.Linker | None = None,
    note: Note = to_stderr,
) -> bytes:
    """Return C files linked with a kernel's objects and the mathematical functions these call.

    What it needs and exports is checked.
    """
    levels = platform.levels
    parts = {f"kernel_{level}.o": content for (_, level), content in code.items()}
    wanted = {symbol for content in code.values() for symbol in binaries.undefined(content)}
    parts |= mathematics.sources(wanted)
    defines = [f"TW_LEVEL={levels[0].name}"] if len(levels) == 1 else []
    how: dict[str, Any] = {"linker": linker, "note": note, "defines": defines}
    made = link.shared_library({**sources, **parts}, platform=platform, name=name, **how)
    binaries.check(made, exports=exports)
    return made


def _loaded(kernel: str, path: Path) -> Addresses:
    """Return the addresses in a library file; none if the system does not load it."""
    try:
        table: Any = getattr(ctypes.CDLL(os.fspath(path)), TABLE)
    except (OSError, AttributeError):
        return {}
    names = symbols(kernel)
    table.restype = ctypes.POINTER(ctypes.c_void_p * len(names))
    found = table()
    if not found:
        raise EnvironmentProblem(
            "this processor lacks SSE4.2, which compiled kernels use; set THRUSTWASHER_KERNELS=jit "
            "to let numba compile them for it"
        )
    return {name: int(value or 0) for name, value in zip(names, found.contents, strict=True)}


_engines: list[Any] = []  # what has been loaded by llvmlite lives as long as the process


def _by_llvm(kernel: str, platform: Platform) -> Addresses:
    """Return the addresses in an object file loaded by llvmlite."""
    import llvmlite.binding as llvm

    code, level = _objects(kernel, platform), this_level(platform).name
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    machine = llvm.Target.from_default_triple().create_target_machine(jit=True)
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), machine)
    engine.add_object_file(llvm.ObjectFileRef.from_data(code[platform.name, level]))
    engine.finalize_object()
    _engines.append(engine)
    found = {name: engine.get_function_address(f"{name}_{level}") for name in symbols(kernel)}
    if not all(found.values()):
        raise EnvironmentProblem(
            f"{shipped.short(kernel)} cannot be loaded here; install gcc, or pip install ziglang"
        )
    return found


def is_ready(kernel: str) -> bool:
    """Tell if a kernel module's library is there, so that its first call compiles nothing."""
    try:
        platform = this_platform()
    except EnvironmentProblem:
        return False
    return shipped.has_objects(kernel) or files.kept(_kept_file(kernel, platform)) is not None
