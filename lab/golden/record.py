"""A record: columns as bits, results as numbers; its file; where two of them differ."""

import hashlib
import json
import math
import platform
from collections.abc import Iterator, Mapping
from importlib import metadata
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

FOLDER = Path(__file__).parent
CLOSE = 1e-9  # relative: numbers that differ by less are the same
LONG = 12  # numbers of a list that is kept whole
PACKAGES = ("numpy", "scipy", "numba", "llvmlite")
# Keys of results that are not of the model: times, costs, the machine, versions, paths.
LEFT_OUT = {"wall_time", "seconds", "cost", "file", "out", "version", "versions", "workers"}

Value = float | list[Any]  # a number; [digest, rows, last] of a column


class Record(NamedTuple):
    """What is kept of one name: place -> value."""

    kind: str  # "bits" or "numbers"
    values: dict[str, Value]
    why: str = ""  # the reason of the last renewal
    made_with: Mapping[str, str] = {}


class Difference(NamedTuple):
    """A place whose value is not the kept one."""

    name: str
    place: str
    kept: Value | None
    now: Value | None

    def __str__(self) -> str:
        return f"{self.name}: {self.place}: kept {_shown(self.kept)}, now {_shown(self.now)}"


def _shown(value: Value | None) -> str:
    if value is None:
        return "nothing"
    if isinstance(value, list):
        digest, rows, last = value
        return f"{last!r} at the end of {rows} rows ({digest})"
    return repr(value)


def bits(where: str, columns: Mapping[str, Any]) -> dict[str, Value]:
    """Return a digest, the number of rows and the last value of each column, of numbers or words.

    A column whose numbers all have the same bits is that number.
    """
    kept: dict[str, Value] = {}
    for name, column in columns.items():
        plain = np.asarray(column)
        if plain.dtype.kind in "OU":
            raw, last, constant = "\n".join(map(str, plain)).encode(), plain[-1], False
        else:
            raw = plain.astype("<f8").tobytes()
            last, constant = float(plain[-1]), raw == raw[:8] * plain.size
        finite = isinstance(last, float) and math.isfinite(last)
        end = last if finite else str(last)  # JSON knows no NaN
        digest = hashlib.sha256(raw).hexdigest()[:12]
        kept[f"{where} {name}"] = last if constant and finite else [digest, plain.size, end]
    return kept


def numbers(where: str, result: object) -> dict[str, Value]:
    """Return all finite numbers of a nested result by their place; long lists as four numbers."""
    return {f"{where} {place}": value for place, value in _leaves("", result)}


def _leaves(place: str, item: Any) -> Iterator[tuple[str, float]]:
    if isinstance(item, Mapping):
        for key, own in item.items():
            if key not in LEFT_OUT:
                yield from _leaves(f"{place}.{key}" if place else str(key), own)
    elif isinstance(item, list | tuple | np.ndarray):
        plain = np.asarray(item).tolist() if isinstance(item, np.ndarray) else list(item)
        if len(plain) > LONG and all(isinstance(x, int | float) for x in plain):
            known = [x for x in plain if math.isfinite(x)]
            plain = [len(plain), min(known), max(known), math.fsum(known)] if known else []
        for i, own in enumerate(plain):
            yield from _leaves(f"{place}[{i}]", own)
    elif isinstance(item, bool | int | float | np.number) and math.isfinite(item):
        yield place, float(item)


def differences(name: str, kept: Record, now: Record) -> list[Difference]:
    """Return where two records differ: bits at all, numbers by more than 1e-9 relative."""
    found = []
    for place in dict.fromkeys((*kept.values, *now.values)):
        old, new = kept.values.get(place), now.values.get(place)
        if not _same(kept.kind, old, new):
            found.append(Difference(name, place, old, new))
    return found


def _same(kind: str, old: Value | None, new: Value | None) -> bool:
    if isinstance(old, float) and isinstance(new, float):
        if kind == "bits":  # the sign of zero counts
            return old.hex() == new.hex()
        return math.isclose(old, new, rel_tol=CLOSE)
    return old == new


def versions() -> dict[str, str]:
    """Return what this run is made with."""
    return {"python": platform.python_version()} | {p: metadata.version(p) for p in PACKAGES}


def path_of(name: str, folder: Path = FOLDER) -> Path:
    """Return the file of a record."""
    return folder / f"{name}.json"


def read(name: str, folder: Path = FOLDER) -> Record:
    """Return a record from its file."""
    table = json.loads(path_of(name, folder).read_text("utf-8"))
    values = {k: x if isinstance(x, list) else float(x) for k, x in table["values"].items()}
    return Record(table["kind"], values, table["why"], table["made_with"])


def write(name: str, record: Record, folder: Path = FOLDER) -> None:
    """Write a record: a line for each value."""
    head = {"kind": record.kind, "why": record.why, "made_with": dict(record.made_with)}
    lines = [f"{json.dumps(k)}: {json.dumps(x)}" for k, x in record.values.items()]
    text = json.dumps(head, ensure_ascii=False)[:-1] + ', "values": {\n' + ",\n".join(lines)
    path_of(name, folder).write_text(text + "\n}}\n", "utf-8")
