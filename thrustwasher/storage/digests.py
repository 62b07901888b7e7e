"""Fingerprints: of a parameter set, of the sources of a level's numbers, of a JSON file."""

import json
import math
from collections.abc import Mapping
from dataclasses import fields
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from ..native import digest
from ..native.code import code_of

PACKAGE = Path(__file__).parents[1]
DATA = PACKAGE / "data"
CHECK = "check"  # key of the checksum in a JSON file


def params_digest(params: Any) -> str:
    """Return the SHA-256 of a parameter object: name of its class and all fields of the part.

    Numbers that are equal have equal digests: 1 and 1.0 count as the same. Fields with
    ``of_a_run`` in their metadata say how a run begins or goes, not what the part is.
    """
    mine = (f.name for f in fields(params) if not f.metadata.get("of_a_run"))
    values = {name: getattr(params, name) for name in mine}
    values |= {k: float(v) for k, v in values.items() if type(v) is int}
    text = json.dumps([type(params).__name__, values], sort_keys=True)
    return sha256(text.encode()).hexdigest()


def changed_fields(params: Any) -> dict[str, Any]:
    """Return the fields that differ from their defaults."""
    values = ((f, getattr(params, f.name)) for f in fields(params))
    return {f.name: value for f, value in values if value != f.default}


@cache
def closure(*modules: str) -> tuple[str, ...]:
    """Return the names of kernel modules and of all that they import; FileNotFoundError: none."""
    found = digest.closure(*modules)
    for name in modules:
        if name not in found:
            raise FileNotFoundError(name)
    return tuple(sorted(found))


@cache
def kernel_digest(*modules: str) -> str:
    """Return 16 hex digits over the code of kernel modules and of all that they import.

    Comments and docstrings do not count. FileNotFoundError: one is not there any more.
    """
    closure(*modules)
    return digest.code_digest(*modules)


@cache
def own_digest(module: str) -> str:
    """Return 16 hex digits over the code of one module alone; FileNotFoundError: there is none."""
    path = digest.file_of(module)
    if path is None:
        raise FileNotFoundError(module)
    return code_of(digest.read(path)).digest


def data_digest(name: str) -> str:
    """Return the SHA-256 of a file of ``data/``, which may be written anew meanwhile."""
    return sha256((DATA / name).read_bytes()).hexdigest()


def finite(value: object) -> Any:
    """Return JSON types with None for numbers that are not finite."""
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def seal_of(record: Mapping[str, object]) -> str:
    """Return 16 hex digits over keys and values, however the file is laid out."""
    bare = {key: value for key, value in record.items() if key != CHECK}
    text = json.dumps(bare, sort_keys=True, separators=(",", ":"))
    return sha256(text.encode()).hexdigest()[:16]


def sealed(record: Mapping[str, object]) -> dict[str, Any]:
    """Return the record with its checksum as the last key."""
    bare = {key: value for key, value in record.items() if key != CHECK}
    return {**bare, CHECK: seal_of(bare)}


def is_broken(record: Mapping[str, object]) -> bool:
    """Tell if the record has a checksum that does not fit; one without is taken as it is."""
    return CHECK in record and record[CHECK] != seal_of(record)
