"""Profiles of a scene in files: pressure and engine torque over time, road load over speed.

``points = "trace.csv"`` stands for pairs of numbers. They are put into the scene's tables as it is
read, with ``points_from``, which says where they come from: what is made of a scene needs no file.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, within
from ...model.toml_tables import quantity
from ...storage.tables.column_names import renamed
from ...storage.tables.table import Table, numbers
from ...storage.tables.table_file import read_table
from ...transmission.parameters import POINTS, PROFILES
from ...transmission.vehicle import GRAVITY, Vehicle
from ...units import format_quantity, parse_quantity
from .connections import PACKS
from .polyline import few_points

Array = NDArray[np.float64]
FROM = {"file", "rows", "rms", "share"}  # keys of ``points_from``
BY_POINTS = ("columns", "rolling", "drag_area")  # what points in their place make void
FAR = 0.02  # of the span: a larger root mean square of what is left out is doubted
UNDER_ZERO = 0.02  # of the span: a reading this far below 0 is an offset


def beside(table: dict[str, Any], folder: Path) -> None:
    """Let the files of a scene's profiles lie next to it."""
    for place in _places(table):
        if isinstance(place.given, str):
            place.table[place.key] = str(folder / place.given)


def without_old(below: Mapping[str, Any], new: Mapping[str, Any]) -> dict[str, Any]:
    """Return a table of a base without what another profile in its place makes untrue."""
    kept = {k: x for k, x in below.items() if not (k.endswith("_from") and k[:-5] in new)}
    if "points" in new:
        kept = {k: x for k, x in kept.items() if k not in BY_POINTS}
    for key, inner in new.items():
        if isinstance(inner, dict) and isinstance(kept.get(key), dict):
            kept[key] = without_old(kept[key], inner)
    return kept


def with_profiles(where: str, table: dict[str, Any]) -> dict[str, Any]:
    """Return the tables of a scene with numbers in place of files; ``where`` begins messages.

    ParameterError if a file cannot be read, with its line and column.
    """
    if not any(isinstance(place.given, str) for place in _places(table)):
        return table
    table = _copied(table)
    window = _window(where, table)
    for place in _places(table):
        if isinstance(place.given, str):
            with within(f"{where} [{place.name}]"):
                _read(place, window)
    return table


def profile_notes(table: dict[str, Any]) -> Iterator[tuple[str, bool]]:
    """Yield for every profile of a file what it was made of, and whether that is doubtful."""
    for place in _places(table):
        about = place.table.get(place.source)
        if about is None:
            continue
        if not isinstance(about, Mapping) or {*about} != FROM:
            raise ParameterError(f"[{place.name}]: {place.source}, allowed: as it was written")
        text = f"[{place.name}]: {about['rows']} rows of {about['file']}"
        if about["rms"]:
            off = format_quantity(about["rms"], place.unit, digits=3)
            text += f", {place.how}, off by {off} rms, {100 * about['share']:.2g} % of their span"
        yield text, about["share"] > FAR


def _copied(table: Mapping[str, Any]) -> dict[str, Any]:
    return {k: _copied(x) if isinstance(x, dict) else x for k, x in table.items()}


@dataclass(frozen=True)
class _Place:
    """Where a scene may name the file of a profile."""

    table: dict[str, Any]
    key: str
    name: str  # of the table
    columns: tuple[str, ...]  # of the file: over what, what; then other names of the last
    unit: str
    profile: str = ""  # of the transmission; "": a vehicle's road load

    @property
    def given(self) -> Any:
        """What stands there."""
        return self.table.get(self.key)

    @property
    def how(self) -> str:
        """What is made of the rows, a participle."""
        return "simplified" if self.profile else "fitted"

    @property
    def source(self) -> str:
        """The key that says what numbers were made of."""
        return f"{self.key}_from"


def _places(table: dict[str, Any]) -> Iterator[_Place]:
    """Yield the places that a scene has."""
    found: list[tuple[Any, str, str, str]] = [
        (table.get("engine"), "points", "engine", "engine_torque")
    ]
    pressures, down = (table.get("pressure") or {}), (table.get("sequence") or {}).get("down")
    for pack in PACKS:
        name = f"{pack}_pressure"
        found += [
            (pressures.get(pack), "points", f"pressure.{pack}", name),
            (down, pack, "sequence.down", name),
        ]
    found.append((down, "engine", "sequence.down", "engine_torque"))
    for own, key, name, profile in found:
        if isinstance(own, dict):
            what = profile.partition("_")[2]
            yield _Place(own, key, name, ("time", what, profile), PROFILES[profile][0], profile)
    if isinstance(own := table.get("vehicle"), dict):
        yield _Place(own, "points", "vehicle", ("speed", "force"), "N")


def _window(where: str, table: Mapping[str, Any]) -> tuple[float, float]:
    """Return the times [s] between which profiles act."""
    ends = [-math.inf, math.inf]
    for i, key in enumerate(("start_time", "stop_time")):
        if key in table and "sequence" not in table:
            ends[i] = quantity(where, key, table[key], "s")
    return ends[0], ends[1]


def _read(place: _Place, window: tuple[float, float]) -> None:
    """Put numbers in place of a file."""
    over, value, table, left_out = _columns(place)
    rows = len(over)
    if not place.profile:
        about = _road_load(place, over, value)
    else:
        over, value = _in_window(place, table, over, value, window)
        found = few_points(over, value, POINTS)
        heights = np.clip(found.value, *PROFILES[place.profile][1:3])
        place.table[place.key] = np.column_stack([found.time, heights]).tolist()
        span = float(np.ptp(value))
        about = {"rms": found.rms, "share": found.rms / span if span else 0.0}
    file = Path(table.path).name + (f" ({', '.join(left_out)})" if left_out else "")
    place.table[place.source] = {"file": file, "rows": rows, **about}


def _columns(place: _Place) -> tuple[Array, Array, Table, list[str]]:
    """Return two columns of a file [SI], its table, and what of its samples was left out."""
    names = place.table.pop("columns", {}) if place.key == "points" else {}
    if not isinstance(names, dict) or not all(isinstance(x, str) for x in names.values()):
        raise ParameterError(f'columns = {names!r}, allowed: a table {{ name = "channel" }}')
    if not Path(place.given).exists():
        raise ParameterError(f"points = {place.given!r}: there is no such file")
    table = renamed(read_table(place.given), names)
    over, *wanted = place.columns
    known = {c.plain for c in table.columns}
    what = next((name for name in wanted if name in known), wanted[0])
    read = table.of_columns((over, what))
    left_out, table = read.remarks[len(table.remarks) :], read
    named = {c.plain: c for c in table.columns}
    found = []
    for name, unit in ((over, "m/s" if over == "speed" else "s"), (what, place.unit)):
        if name not in named:
            other = {"speed": ", not over speed as a full-load curve", "time": ", not over time"}
            wrong = "".join(text for key, text in other.items() if key != over and key in named)
            raise ParameterError(
                f"{table.path}: column {name} is missing, {what} over {over} is required{wrong}; "
                f"found: {', '.join(named)} (columns = "
                f'{{ {name} = "CHANNEL" }} names another)'
            )
        parse_quantity(f"1 {named[name].unit}", unit, f"{table.path}: unit of column {name}")
        values = numbers(named[name], table, unit, name=name)
        if None in values:
            line = table.lines[values.index(None)]
            raise ParameterError(f"{table.path}, line {line}: {name} is missing")
        found.append(np.array(values, float))
    return found[0], found[1], table, left_out


def _in_window(
    place: _Place, table: Table, time: Array, value: Array, window: tuple[float, float]
) -> tuple[Array, Array]:
    """Return the rows that act, checked: one before and one behind the run stay."""
    unit, low, high, _ = PROFILES[place.profile]
    if (np.diff(time) < 0.0).any():
        row = int(np.argmax(np.diff(time) < 0.0)) + 1
        raise ParameterError(
            f"{table.path}, line {table.lines[row]}: time falls from {time[row - 1]:.6g} to "
            f"{time[row]:.6g} s, rising times are required"
        )
    offset = UNDER_ZERO * float(np.ptp(value)) if low == 0.0 else 0.0
    wrong = (value < low - offset) | (value > high)
    if wrong.any():
        row = int(np.argmax(wrong))
        raise ParameterError(
            f"{table.path}, line {table.lines[row]}: {place.columns[1]} = "
            f"{format_quantity(float(value[row]), unit)}, allowed: {low:g} .. {high:g} {unit}"
        )
    first = max(int(np.searchsorted(time, window[0], "right")) - 1, 0)
    end = int(np.searchsorted(time, window[1], "left")) + 1
    if time[-1] < window[0] or time[0] > window[1]:
        raise ParameterError(
            f"{table.path}: time goes from {time[0]:.6g} to {time[-1]:.6g} s, the scene from "
            f"{window[0]:g} to {window[1]:g} s, allowed: times of the scene"
        )
    return time[first:end], value[first:end]


def _road_load(place: _Place, speed: Array, force: Array) -> dict[str, float]:
    """Put rolling resistance and drag area in place of forces [N] at speeds [m/s] on a flat road.

    They are those of least squares, not below 0. One that the table gives stays as it is.
    """
    from scipy.optimize import nnls

    own = place.table
    usual = {f.name: f.default for f in fields(Vehicle)}
    mass, density = (
        quantity("vehicle", key, own.get(key, usual[key]), unit)
        for key, unit in (("mass", "kg"), ("air_density", "kg/m3"))
    )
    if len(np.unique(speed)) < 2:
        raise ParameterError(f"{place.given}: one speed, allowed: two or more")
    shares = np.column_stack([np.ones_like(speed), speed**2])
    (rolling, drag), _ = nnls(shares, force)
    rms = float(np.sqrt(np.mean((force - shares @ (rolling, drag)) ** 2)))
    del own[place.key]
    own.setdefault("rolling", float(rolling) / (mass * GRAVITY))
    own.setdefault("drag_area", 2.0 * float(drag) / density)
    return {"rms": rms, "share": rms / float(np.abs(force).max() or 1.0)}
