"""The mathematical functions that kernels call: musl's, linked in and visible to nothing else.

A host that has a function ``log`` of its own would otherwise be called in place of the C library's.
Every platform has the same functions, and so the same numbers. They lie in ``vendor/musl``, as musl
1.2.5 has them but for the headers that they include.
"""

import hashlib
import re
from collections.abc import Iterable, Mapping
from functools import cache

from .digest import HERE, read

FOLDER = HERE / "vendor" / "musl"
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
# Functions and tables that a file defines, from the start of a line.
DEFINED = re.compile(
    r"^(?!static|extern|hidden|return)[a-z][\w *]*?\b(\w+)(?:\([^;{}]*\)\s*\{| = )", re.M
)


@cache
def files() -> Mapping[str, bytes]:
    """Return the name and content of all files in C."""
    return {path.name: read(path) for path in sorted(FOLDER.rglob("*.[ch]"))}


@cache
def defined() -> Mapping[str, str]:
    """Return the name of each function and table, and of the file that defines it."""
    texts = {name: _plain(data) for name, data in files().items() if name.endswith(".c")}
    return {found: name for name, text in texts.items() for found in DEFINED.findall(text)}


def sources(wanted: Iterable[str]) -> dict[str, bytes]:
    """Return the C files of some functions, of all that these call, and the headers.

    Names that are no mathematical function are passed over: memory is the C library's.
    """
    found, todo = set[str](), list(wanted)
    while todo:
        name = defined().get(todo.pop())
        if name and name not in found:
            found.add(name)
            todo += re.findall(r"\w+", _plain(files()[name]))
    headers = {name for name in files() if name.endswith(".h")} if found else set[str]()
    return {name: files()[name] for name in sorted(found | headers)}


@cache
def digest() -> str:
    """Return 16 hex digits over the files."""
    hashed = hashlib.sha256()
    for name, data in files().items():
        hashed.update(f"{name}\0{len(data)}\0".encode() + data)
    return hashed.hexdigest()[:16]


def _plain(data: bytes) -> str:
    """Return C without comments."""
    return COMMENT.sub("", data.decode())
