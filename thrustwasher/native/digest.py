"""The name of a compilation: the same only if no code it is made from differs.

Comments, docstrings, layout and line ends do not count, nor the folders that modules lie in: they
go by number, in the order in which they are met. It says nothing of the machine or of the
compilers' versions: what is shipped was made by those in the list that lies beside it, and holds
whatever is installed where it is used.
"""

import hashlib
import importlib.util
import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from .code import Code, code_of
from .entries import called, called_modules, symbol_of

PACKAGE = __name__.partition(".")[0]
HERE = Path(__file__).parent
# How code is made: another number where an edit of emit, lean, lower or of the decorator's options
# changes what comes out. `python -m lab.ship --check` finds a forgotten one.
RECIPE = 3
MAKERS = ("entries.py", "targets.py")  # what is compiled, and how hard the compiler works
# Modules that kernels import and that are no part of what is compiled.
_NOT_COMPILED = ("errors", "model", "native", "numerics.jit")


@dataclass(frozen=True, slots=True)
class Module:
    """A module of kernels: its file, its code, and the names that it may import."""

    path: Path
    code: Code
    imports: tuple[str, ...]


@cache
def digest(kernel: str) -> str:
    """Return 16 hex digits over the code of a kernel module, all it imports, what compiles it."""
    modules = _modules(kernel, *called_modules(kernel))
    order = {name: number for number, name in enumerate(modules)}
    shown = [[order[m], symbol_of(m, name), *two] for m, name, two in called(kernel) if m in order]
    makers = [code_of(read(HERE / name)).digest for name in MAKERS]
    return _short([RECIPE, makers, shown, _graph(modules)])


def code_digest(*modules: str) -> str:
    """Return 16 hex digits over the code of kernel modules and of all that they import."""
    return _short(_graph(_modules(*modules)))


def _short(what: object) -> str:
    return hashlib.sha256(json.dumps(what).encode()).hexdigest()[:16]


def _graph(modules: dict[str, Module]) -> list[object]:
    """Return each module's code and the numbers of the modules that it imports."""
    order = {name: number for number, name in enumerate(modules)}
    return [[m.code.digest, *(order[n] for n in m.imports if n in order)] for m in modules.values()]


def read(path: Path) -> bytes:
    """Return a source with line ends as on Linux: a checkout on Windows has the same digest."""
    return path.read_bytes().replace(b"\r\n", b"\n")


def sources(kernel: str) -> dict[str, Path]:
    """Return module -> file of all that is compiled into a kernel module's library."""
    return closure(kernel, *called_modules(kernel))


def closure(*modules: str) -> dict[str, Path]:
    """Return module -> file of kernel modules and of all modules of their kind that they import.

    The heads of packages hold no code and are left out.
    """
    return {name: module.path for name, module in _modules(*modules).items()}


def _modules(*names: str) -> dict[str, Module]:
    """Return name -> module of kernel modules and of all of their kind that they import."""
    found: dict[str, Module] = {}
    others = tuple(f"{PACKAGE}.{other}." for other in _NOT_COMPILED)
    roots, todo = {PACKAGE, *(name.partition(".")[0] for name in names)}, list(names)
    for name in todo:  # which grows meanwhile
        if name in found or f"{name}.".startswith(others) or name.partition(".")[0] not in roots:
            continue
        path = file_of(name)
        if path and path.name != "__init__.py":
            code = code_of(read(path))
            imports = tuple(_resolved(code, name.rpartition(".")[0]))
            found[name] = Module(path, code, imports)
            todo += imports
    return found


def file_of(name: str) -> Path | None:
    """Return the file of a module; None where a name is no module but something in one."""
    if name.startswith(f"{PACKAGE}."):  # nothing is imported to know it
        return _own_file(name)
    try:
        spec = importlib.util.find_spec(name)
    except ModuleNotFoundError:
        return None
    return Path(spec.origin) if spec and spec.origin else None


@cache
def _own_file(name: str) -> Path | None:
    place = HERE.parents[1].joinpath(*name.split("."))
    files = place.with_suffix(".py"), place / "__init__.py"
    return next((path for path in files if path.is_file()), None)


def _resolved(code: Code, package: str) -> Iterator[str]:
    """Give the names of modules that a module may import, some of them of things in modules."""
    for line in code.imports:
        given, *names = line.split()
        module = importlib.util.resolve_name(given, package)
        yield module
        yield from (f"{module}.{name}" for name in names)
