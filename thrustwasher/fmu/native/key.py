"""The name under which compiled code is kept: the same only if nothing it is made from differs."""

import ast
import hashlib
import importlib.util
import sys
import threading
from importlib import metadata
from pathlib import Path

# An edit of one of these may change what comes out.
MAKERS = ("emit.py", "lower.py", "gate.py", "symbols.py")

_parsing = threading.Lock()  # CPython 3.11 miscounts its depth when two threads parse


def key(kernel: str, *settings: object) -> str:
    """Return 16 hex digits over a kernel with all it imports, the compilers and ``settings``.

    ``kernel`` is a dotted name, "" for none.
    """
    versions = [f"{name} {metadata.version(name)}" for name in ("numba", "llvmlite", "numpy")]
    hashed = hashlib.sha256(f"{versions} {sys.version_info[:2]} {settings}".encode())
    for name in MAKERS:
        hashed.update((Path(__file__).parent / name).read_bytes())
    found = sources(kernel) if kernel else {}
    for name in sorted(found):
        hashed.update(name.encode() + found[name])
    return hashed.hexdigest()[:16]


def sources(kernel: str) -> dict[str, bytes]:
    """Return module -> source of a kernel module and of all modules of its kind it imports."""
    found: dict[str, bytes] = {}
    roots, todo = {kernel.partition(".")[0], "thrustwasher"}, [kernel]
    while todo:
        name = todo.pop()
        spec = importlib.util.find_spec(name) if name not in found else None
        if spec and spec.origin and name.partition(".")[0] in roots:
            found[name] = Path(spec.origin).read_bytes()
            todo += _imported(found[name], name if _is_package(spec.origin) else spec.parent or "")
    return found


def _is_package(file: str) -> bool:
    return Path(file).name == "__init__.py"


def _imported(source: bytes, package: str) -> list[str]:
    """Return the modules a source imports by ``from . import x`` and ``from .x import y``."""
    names = []
    with _parsing:
        tree = ast.parse(source)
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            given = "." * node.level + (node.module or "")
            module = importlib.util.resolve_name(given, package)
            names += [module] if node.module else [f"{module}.{a.name}" for a in node.names]
        elif isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
    return names
