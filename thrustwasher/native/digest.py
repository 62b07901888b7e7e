"""The name of a compilation: the same only if nothing it is made from differs.

It says nothing of the machine or of the compilers' versions: what is shipped was made by those in
the list that lies beside it, and holds whatever is installed where it is used.
"""

from __future__ import annotations

import ast
import hashlib
import importlib.util
import threading
from collections.abc import Iterable, Mapping
from functools import cache
from importlib.machinery import ModuleSpec
from pathlib import Path

from .entries import called_modules

PACKAGE = __name__.partition(".")[0]
HERE = Path(__file__).parent
# How code is made: another number where an edit of emit, lean, lower or of the decorator's options
# changes what comes out. `python -m thrustwasher.native.ship --check` finds a forgotten one.
RECIPE = 2
MAKERS = ("entries.py", "targets.py")  # what is compiled, and how hard the compiler works
# Modules that kernels import and that are no part of what is compiled.
_NOT_COMPILED = ("errors", "native", "kernels._jit")

_parsing = threading.Lock()  # CPython 3.11 miscounts its depth when two threads parse


@cache
def digest(kernel: str) -> str:
    """Return 16 hex digits over a kernel module, all it imports, and what compiles it."""
    return digest_of({name: read(path) for name, path in sources(kernel).items()})


def digest_of(found: Mapping[str, bytes]) -> str:
    """Return 16 hex digits over sources by the name of their module, and what compiles them."""
    hashed = hashlib.sha256(_makers())
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
    """Return module -> file of all that is compiled into a kernel module's library.

    That is the module, those of the functions that Python calls, and all modules of their kind that
    these import.
    """
    found: dict[str, Path] = {}
    roots, todo = {kernel.partition(".")[0], PACKAGE}, [kernel, *called_modules(kernel)]
    while todo:
        name = todo.pop()
        if name in found or not _is_compiled(name):
            continue
        spec = _found(name)
        if spec and spec.origin and name.partition(".")[0] in roots:
            found[name] = Path(spec.origin)
            package = name if found[name].name == "__init__.py" else spec.parent or ""
            todo += _imported(found[name].read_bytes(), package)
    return found


def _found(name: str) -> ModuleSpec | None:
    """Return where a module is; None where a name is no module but something in one."""
    try:
        return importlib.util.find_spec(name)
    except ModuleNotFoundError:
        return None


def _is_compiled(name: str) -> bool:
    own = name.removeprefix(f"{PACKAGE}.")
    return not any(own == other or own.startswith(f"{other}.") for other in _NOT_COMPILED)


def _imported(source: bytes, package: str) -> Iterable[str]:
    """Return the modules a source imports by ``from . import x`` and ``from .x import y``."""
    names = []
    with _parsing:
        tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            given = "." * node.level + (node.module or "")
            module = importlib.util.resolve_name(given, package)
            names += [module, *(f"{module}.{alias.name}" for alias in node.names)]
        elif isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
    return names
