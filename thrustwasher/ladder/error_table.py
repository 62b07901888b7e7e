"""Verification tables: the measured error of each fidelity level by region, and its cost.

A JSON file holds the tables of a model, one per parameter set. ``python -m
lab.verify`` writes those of the package, ``thrustwasher fidelity PART`` that of your
own part. A level's errors count for the kernels they were measured with; after a change of these
they are stale and are not used. A file that cannot be read is left out: a solve never stops for it.
"""

import hashlib
import json
import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from ..errors import ParameterError
from ..model.registry import find_model
from ..model.toml_tables import from_plain
from ..native.files import user_cache
from ..storage.digests import (
    CHECK,
    DATA,
    data_digest,
    is_broken,
    kernel_digest,
    own_digest,
    params_digest,
    sealed,
)
from ..storage.whole_files import whole_file

SCHEMA = 4
SAFETY = 1.5  # between the largest error found at points and what is promised between them
OWN = "own-"  # begins the name of a table that lies in the user's cache
FOLDER = "THRUSTWASHER_TABLES"  # environment: one more folder with tables
VERIFY = "python -m lab.verify"  # measures the package's own
# Unit of each quantity's error; None: relative to the value, or to ``floor`` if that is more.
QUANTITIES = {"friction_torque": None, "temperature": "K", "film_thickness": "m", "film_ratio": "1"}

Interval = tuple[float, float]
Box = Mapping[str, Interval]


@dataclass(frozen=True, slots=True)
class Axis:
    """One input's range; points are drawn from it in this ``scale``, "log" or "linear"."""

    min: float
    max: float
    unit: str
    scale: str


@dataclass(frozen=True, slots=True)
class Division:
    """A box divided into regions along ``axes``: inputs, or the film ratio that a result knows.

    A row is a region: its low and high end along each axis, the number of points in it, and the
    largest error of each of ``QUANTITIES``.
    """

    axes: tuple[str, ...]
    rows: tuple[tuple[float, ...], ...]

    def worst(self, quantity: str, box: Box) -> float:
        """Return the largest error in the regions that a box touches, edges included."""
        at = 2 * len(self.axes) + 1 + list(QUANTITIES).index(quantity)
        return max((row[at] for row in self.rows if self._touches(row, box)), default=math.inf)

    def _touches(self, row: Sequence[float], box: Box) -> bool:
        return all(
            row[2 * k] <= box[name][1] and box[name][0] <= row[2 * k + 1]
            for k, name in enumerate(self.axes)
        )


@dataclass(frozen=True, slots=True)
class Chart:
    """What was measured in one kind of solution: a branch of the washer, an engagement.

    ``floor`` [N m] bounds the torque that relative errors are taken of; ``beside_fold`` is the
    largest relative error of the torque at points next to a fold, which are in no division.
    """

    name: str | None
    points: int
    floor: float
    beside_fold: float
    divisions: tuple[Division, ...]

    def worst(self, quantity: str, box: Box) -> float:
        """Return the largest error in a box, by the division that knows best."""
        return min(d.worst(quantity, box) for d in self.divisions if set(d.axes) <= box.keys())


@dataclass(frozen=True, slots=True)
class LevelErrors:
    """The measured errors of one level in ``box``, and the seconds of a call.

    ``sources`` is the digest of its kernels and of the files in ``data`` that it reads.
    """

    fidelity: str
    sources: str
    files: tuple[str, ...]
    call: float
    box: dict[str, Axis]
    charts: tuple[Chart, ...]

    def worst(self, quantity: str, box: Box, chart: str | None = None) -> float | None:
        """Return the largest error in a box, over all charts or in one; None if it leaves ours.

        Of inputs that are symmetric only the size counts. ``box`` may hold the film ratio as well.
        """
        sizes = {n: _sizes(box[n], a) for n, a in self.box.items() if n in box}
        if any(n not in sizes or not _inside(sizes[n], a) for n, a in self.box.items()):
            return None
        mine = [c for c in self.charts if chart is None or c.name in (None, chart)]
        return max((c.worst(quantity, {**box, **sizes}) for c in mine), default=None)

    def common(self, box: Box) -> Box:
        """Return what a box has in common with ours; of inputs that do not meet, their own ends."""
        sizes = {n: _sizes(box[n], a) for n, a in self.box.items()}
        return {
            n: (max(low, self.box[n].min), min(high, self.box[n].max))
            for n, (low, high) in sizes.items()
        }

    def worst_anywhere(self, quantity: str, chart: Chart) -> float:
        """Return the largest error of a chart."""
        return chart.worst(quantity, {n: (a.min, a.max) for n, a in self.box.items()})


def _sizes(interval: Interval, axis: Axis) -> Interval:
    low, high = interval
    if axis.min < 0.0 or low >= 0.0:
        return interval
    return (0.0 if high >= 0.0 else -high, max(-low, high))


def _inside(interval: Interval, axis: Axis) -> bool:
    slack = 1e-9 * max(abs(axis.min), abs(axis.max))
    return axis.min - slack <= interval[0] and interval[1] <= axis.max + slack


@dataclass(frozen=True, slots=True)
class ErrorTable:
    """The measured errors of a model's levels with one parameter set, the cheapest first."""

    model: str
    name: str  # "default", a scene, a scene's part, or own-...
    sha256: str  # of the parameters
    changed: dict[str, Any]  # parameters that differ from the defaults
    made: str
    version: str  # of the package
    machine: str  # that the seconds are of
    reference: tuple[str, ...]
    levels: tuple[LevelErrors, ...]

    def stale(self, level: LevelErrors) -> str | None:
        """Return why a level's errors do not count any more, and what renews them, or None."""
        own = self.name.startswith(OWN)
        renew = "thrustwasher fidelity PART.toml" if own else f"{VERIFY} {self.model}"
        try:
            if sources_of(self.model, level.fidelity, level.files) == level.sources:
                return None
        except (KeyError, OSError) as error:
            return f"a source is not there ({error}); renew it: {renew}"
        return f"the kernels have changed since {self.made}; renew it: {renew}"


def sources_of(model: str, fidelity: str, files: Iterable[str] = ()) -> str:
    """Return the digest of all that a level computes with: its kernels, ``files`` of data.

    The step's module sends each level to its kernels; what else it imports does not count, or every
    level would hang on every other one. KeyError: no such level; OSError: a file is not there.
    """
    found = find_model(model)
    if found.ladder is None:
        raise KeyError(model)
    kernels = kernel_digest(*found.ladder.kernels[fidelity])
    data = [[name, data_digest(name)] for name in sorted(files)]
    text = json.dumps([kernels, own_digest(found.spec.kernel), data])
    return hashlib.sha256(text.encode()).hexdigest()


def write_tables(tables: Sequence[ErrorTable], path: Path) -> None:
    """Write the tables of a model to a file, with a checksum as its last key."""
    record = {"schema": SCHEMA, "tables": [asdict(table) for table in tables]}
    text = json.dumps(sealed(record), indent=1, allow_nan=False)
    innermost = re.compile(r"\[\s+([^][{}]*?)\s+\]|\{\s+([^][{}]*?)\s+\}")  # on one line each
    text = innermost.sub(lambda m: f"{m[0][0]}{' '.join((m[1] or m[2]).split())}{m[0][-1]}", text)
    with whole_file(path) as draft:
        draft.write_text(text + "\n", "utf-8")


def read_tables(path: Path) -> tuple[ErrorTable, ...]:
    """Return the tables in a file; ParameterError: none, changed, or of another version."""
    try:
        raw = json.loads(path.read_text("utf-8"))
        changed = not isinstance(raw, dict) or CHECK not in raw or is_broken(raw)
    except (OSError, ValueError, RecursionError) as error:
        raise ParameterError(f"{path.name}: cannot be read ({error})") from None
    if changed:
        raise ParameterError(
            f"{path.name}: was changed since it was written ({CHECK} does not fit); make it again: "
            f"{VERIFY}"
        )
    if raw.get("schema") != SCHEMA:
        raise ParameterError(
            f"{path.name}: schema = {raw.get('schema')}, this version reads {SCHEMA}; renew it: "
            f"{VERIFY}"
        )
    try:
        return tuple(from_plain(ErrorTable, table) for table in raw["tables"])
    except (KeyError, TypeError, AttributeError) as error:
        raise ParameterError(f"{path.name}: no tables of this version ({error})") from None


def own_folder() -> Path:
    """Return where the tables of the user's own parts lie; it need not exist."""
    return user_cache() / "error_tables"


def named_folder() -> str | None:
    """Return the folder that the environment names."""
    return os.environ.get(FOLDER)


def table_folders() -> list[Path]:
    """Return the folders that are searched: the package's, the user's, the environment's."""
    named = named_folder()
    return [DATA / "error_tables", own_folder(), *([Path(named)] if named else [])]


@cache
def _folder(folder: Path) -> tuple[tuple[ErrorTable, ...], dict[str, str]]:
    """Return the tables of a folder, and the reason why of each file that has none."""
    tables: list[ErrorTable] = []
    refused = {}
    for path in sorted(folder.glob("*.json")):
        try:
            tables += read_tables(path)
        except ParameterError as error:
            refused[path.name] = str(error)
    return tuple(tables), refused


def forget() -> None:
    """Read the folders again next time."""
    _folder.cache_clear()
    _fresh.cache_clear()


def load_tables(model: str, params: object = None) -> list[ErrorTable]:
    """Return the tables of a model, of one parameter set if it is given; stale ones too.

    Of two with one name the later folder's counts.
    """
    found = {
        t.name: t for folder in table_folders() for t in _folder(folder)[0] if t.model == model
    }
    digest = None if params is None else params_digest(params)
    return [t for t in found.values() if digest in (None, t.sha256)]


def refused_files() -> dict[str, str]:
    """Return name and reason of each file in the folders that cannot be read."""
    return {name: why for folder in table_folders() for name, why in _folder(folder)[1].items()}


def fresh_levels(model: str, params: object) -> dict[str, LevelErrors]:
    """Return the levels whose errors are known for these parameters and kernels, cheapest first."""
    return _fresh(model, params, named_folder())


@lru_cache(maxsize=64)
def _fresh(model: str, params: object, folder: str | None) -> dict[str, LevelErrors]:
    tables = load_tables(model, params)
    return {r.fidelity: r for t in tables for r in t.levels if t.stale(r) is None}


def error_estimate(
    model: str,
    fidelity: str,
    params: object,
    point: Mapping[str, float],
    quantity: str = "friction_torque",
    branch: str | None = None,
    film_ratio: float | None = None,
) -> float | None:
    """Return the error to expect at a point, or None where no table speaks.

    1.5 times the largest error found in the point's region; over all branches if none is named.
    With the film ratio found there, that among points of such film ratios if it is less.
    """
    level = fresh_levels(model, params).get(fidelity)
    known = point if film_ratio is None else {**point, "film_ratio": film_ratio}
    box = {name: (value, value) for name, value in known.items()}
    worst = level.worst(quantity, box, branch) if level else None
    return None if worst is None else SAFETY * worst
