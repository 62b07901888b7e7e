"""The name of a compilation: the same only if nothing it is made from differs.

It says nothing of the machine or of the compilers' versions: what is shipped was made by those in
the list that lies beside it, and holds whatever is installed where it is used.
"""

import ast
import hashlib
import importlib.util
import threading
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

from .entries import called, called_modules

PACKAGE = __name__.partition(".")[0]
HERE = Path(__file__).parent
# How code is made: another number where an edit of emit, lean, lower or of the decorator's options
# changes what comes out. `python -m lab.ship --check` finds a forgotten one.
RECIPE = 2
MAKERS = ("entries.py", "targets.py")  # what is compiled, and how hard the compiler works
# Modules that kernels import and that are no part of what is compiled.
_NOT_COMPILED = ("errors", "model", "native", "numerics.jit")

_parsing = threading.Lock()  # CPython 3.11 miscounts its depth when two threads parse


@cache
def digest(kernel: str) -> str:
    """Return 16 hex digits over a kernel module, all it imports, and what compiles it."""
    return digest_of(kernel, {name: read(path) for name, path in sources(kernel).items()})


def digest_of(kernel: str, found: Mapping[str, bytes]) -> str:
    """Return 16 hex digits over a kernel module's sources by name, and what compiles them."""
    hashed = hashlib.sha256(_makers() + str(called(kernel)).encode())
    for name in sorted(found):
        hashed.update(f"{name}\0{len(found[name])}\0".encode() + found[name])
    return hashed.hexdigest()[:16]


@cache
def _makers() -> bytes:
    return b"".join([f"recipe {RECIPE}".encode(), *(read(HERE / name) for name in MAKERS)])


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
    found: dict[str, Path] = {}
    others = tuple(f"{PACKAGE}.{other}." for other in _NOT_COMPILED)
    roots, todo = {PACKAGE, *(name.partition(".")[0] for name in modules)}, list(modules)
    while todo:
        name = todo.pop()
        if name in found or f"{name}.".startswith(others) or name.partition(".")[0] not in roots:
            continue
        path = file_of(name)
        if path and path.name != "__init__.py":
            found[name] = path
            todo += _imported(path, name.rpartition(".")[0])
    return found


def file_of(name: str) -> Path | None:
    """Return the file of a module; None where a name is no module but something in one."""
    try:
        spec = importlib.util.find_spec(name)
    except ModuleNotFoundError:
        return None
    return Path(spec.origin) if spec and spec.origin else None


@cache
def _imported(path: Path, package: str) -> Iterable[str]:
    """Return the modules a file imports at its top by ``from . import x``, ``from .x import y``."""
    names = []
    with _parsing:
        tree = ast.parse(path.read_bytes())
    for node in tree.body:
        if isinstance(node, ast.ImportFrom):
            given = "." * node.level + (node.module or "")
            module = importlib.util.resolve_name(given, package)
            names += [module, *(f"{module}.{alias.name}" for alias in node.names)]
        elif isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
    return names
