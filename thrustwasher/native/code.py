"""What a source says once it is parsed: without comments, docstrings and layout.

Parsing takes a while, so ``data/native/code.json`` lists what came out for the sources as they were
shipped, by the SHA-256 of their text; `python -m lab.ship` writes it. What is not there is parsed.
"""

import ast
import hashlib
import json
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

KNOWN = Path(__file__).parents[1] / "data" / "native" / "code.json"
_NO_CODE = {"ctx", "kind", "type_comment"}  # say nothing that the rest does not
_parsing = threading.Lock()  # CPython 3.11 miscounts its depth when two threads parse


@dataclass(frozen=True, slots=True)
class Code:
    """A source without what is only for readers.

    ``digest``: 16 hex digits. ``imports``: of each import at its top the module as it is written,
    and what is taken of it, in an order that does not depend on how many dots lead there.
    """

    digest: str
    imports: tuple[str, ...]


def code_of(text: bytes) -> Code:
    """Return the code of a source; SyntaxError: it is none."""
    return _code_of(text)


@cache
def _code_of(text: bytes) -> Code:
    try:
        digest, *imports = map(str, known()[key(text)])
        return Code(digest, tuple(imports))
    except (KeyError, TypeError, ValueError):  # new, or the list was changed by hand
        return parsed(text)


@cache
def known() -> dict[str, list[str]]:
    """Return the list of sources that have been parsed; empty if there is none to be read."""
    try:
        found = json.loads(KNOWN.read_text("utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def key(text: bytes) -> str:
    """Return the name of a source in the list."""
    return hashlib.sha256(text).hexdigest()[:32]


def parsed(text: bytes) -> Code:
    """Return the code of a source, parsed now."""
    with _parsing:
        body = ast.parse(text).body
    imports = sorted(_written_imports(body))
    rest = [node for node in body if not isinstance(node, ast.Import | ast.ImportFrom)]
    shown = "\n".join([*(line for line, _ in imports), _written(rest)])
    digest = hashlib.sha256(shown.encode()).hexdigest()[:16]
    return Code(digest, tuple(given for _, given in imports))


def _written_imports(body: list[ast.stmt]) -> Iterator[tuple[str, str]]:
    """Give each import without the way to its module, and as ``Code`` has it."""
    for node in body:
        if isinstance(node, ast.ImportFrom):
            given = "." * node.level + (node.module or "")
            yield _written(node), " ".join([given, *(alias.name for alias in node.names)])
        elif isinstance(node, ast.Import):
            yield from ((_written(alias), alias.name) for alias in node.names)


def _written(node: object) -> str:
    """Return a part of a parsed source as a text, the same in all versions of Python.

    Of a module that is imported by dots only the last name is written: which one it is, those say
    who follow the imports.
    """
    if isinstance(node, list):
        return f"[{','.join(_written(part) for part in node if not _is_text(part))}]"
    if not isinstance(node, ast.AST):
        return repr(node)
    fields = {name: value for name, value in ast.iter_fields(node) if name not in _NO_CODE}
    if isinstance(node, ast.ImportFrom) and fields.pop("level"):
        fields["module"] = (node.module or "").rpartition(".")[2]
    parts = [f"{name}={_written(v)}" for name, v in fields.items() if v is not None and v != []]
    return f"{type(node).__name__}({','.join(parts)})"


def _is_text(node: object) -> bool:
    """Tell if a statement is a text by itself, such as a docstring."""
    value = node.value if isinstance(node, ast.Expr) else None
    return isinstance(value, ast.Constant) and isinstance(value.value, str)
