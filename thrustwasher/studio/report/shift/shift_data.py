"""A shift as the scripts of its page take it: every signal, in words and units of the models."""

import base64
import tomllib
import zlib
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ....shift.account import summary
from ....shift.account.shift_record import PACKS, Array, Record
from ....shift.account.worst_moments import Moment
from ....transmission.kernels.shift_figures import JERK_TIME
from ....units import UNITS, pretty_unit
from ..scatter.words import HIGH, LOW
from . import shift_tables

VERSION = 2  # of this form
ROOM = 1_250_000  # characters of packed signals: the page stays below 2 MB
DROPPED = 8  # bits of a number's 24 that a long run leaves out: four digits stay
READABLE = {"Pa": "kPa", "J": "kJ", "W": "kW", "m": "um", "m3/s": "l/min", "rad": "mrad"}
FIELDS = {
    "film_thickness": ("film thickness", "m"),
    "pressure": ("pressure in the film", "Pa"),
    "contact_pressure": ("pressure on asperities", "Pa"),
    "washer_temperature": ("temperature of the washer", "K"),
}
OF_THE_VEHICLE = {
    "vehicle.acceleration": ("acceleration of the vehicle", "m/s2"),
    "vehicle.jerk": ("its change over the next 10 ms", "m/s3"),
}
WITH_OIL = "torque over load, oil's shear included"
LOADED = 0.1  # of the maximum load: below it the load is only beginning


@cache
def panels() -> dict[str, Any]:
    """Return which signals stand together, as ``panels.toml`` says."""
    return tomllib.loads(Path(__file__).with_name("panels.toml").read_text("utf-8"))


def page_data(runs: Sequence[Mapping[str, object]]) -> dict[str, Any]:
    """Return all that the scripts of a page need for one run or two."""
    fields = {n: {"words": w, **_shown(u)} for n, (w, u) in FIELDS.items()}
    return {"version": VERSION, "runs": runs, "fields": fields, **panels()}


def run_data(
    record: Record,
    moments: Mapping[str, Moment | None],
    *,
    room: int = ROOM,
    texts: tuple[Sequence[str], Sequence[str]] | None = None,
) -> dict[str, Any]:
    """Return a run as JSON types; ``moments``: the washer solved again, by the moment's words.

    ``texts`` are its summary and its warnings, if they are not those of one shift.
    Signals that change are packed in ``room`` characters, all others are a number each.
    """
    absent = {f"{p.name}.{n}" for p in record.parts for n in p.spec.absent(p.params())}
    signals = {n: values for n, values in record.signals.items() if n not in absent}
    signals |= _of_the_vehicle(record) | _with_oil(record)
    moving = [name for name, values in signals.items() if np.ptp(values) != 0.0]
    rows = np.array([record.time, *(signals[name] for name in moving)], dtype="<f4")
    places: dict[bytes, int] = {}  # what one part gives another takes: such signals share a row
    row_of = [places.setdefault(row.tobytes(), len(places)) for row in rows]
    kept, packed = _packed_to_fit(rows[np.unique(row_of, return_index=True)[1]], record, room)
    bands = {name: _band(rows) for name, rows in bands_of(record).items()}
    events = [(e.time, e.text) for e in record.events]
    if swing := record.judder:
        events.append((swing.start, "the swing's growth is evaluated from here"))
        events.append((swing.end, "to here"))
    return {
        "name": record.name,
        "title": record.title,
        "summary": texts[0] if texts else summary.sentences(record),
        "warnings": texts[1] if texts else summary.warnings(record),
        "figures": [figure._asdict() for figure in record.key_figures],
        "phases": record.phases,
        "events": sorted(events),
        "recorded": len(record.time),
        "points": kept,
        "packed": packed,
        "moving": [
            signal_of(record, name) | {"row": k} for name, k in zip(moving, row_of[1:], strict=True)
        ],
        "steady": [
            {**signal_of(record, name), "value": float(values[0])}
            for name, values in signals.items()
            if name not in moving and np.isfinite(values[0])
        ],
        "shifts": 1,
        **({"bands": bands} if bands else {}),
        "slip": slip_of(record),
        "aside": set_aside(record),
        "inputs": [s.name for s in part.spec.inputs] if (part := record.part("washer")) else [],
        "moments": {words: _moment(m) for words, m in moments.items() if m is not None},
        "settings": shift_tables.settings(record),
    }


def bands_of(record: Record) -> dict[str, tuple[Array, Array, Array]]:
    """Return time, 5 and 95 % quantile [SI] of each signal that a study has and that scatters."""
    series = record.scatter.series if record.scatter else {}
    found = {n: (s.time, s.quantiles[LOW], s.quantiles[HIGH]) for n, s in series.items()}
    return {n: b for n, b in found.items() if np.isfinite(b[1]).any() and np.any(b[2] > b[1])}


def _band(rows: tuple[Array, ...]) -> list[list[float | None]]:
    return [[float(f"{x:.4g}") if np.isfinite(x) else None for x in row] for row in rows]


def set_aside(record: Record) -> list[str]:
    """Return the signals that say nothing in this run: they are not drawn until requested."""
    idle = [pack for pack in PACKS if not record.presses(pack)]
    found = [f"{pack}.{own}" for pack in idle for own in ("temperature", "film_ratio")]
    if not np.any(record.series("transmission.shaft_twist")):  # rigid: repeats carrier and load
        found += ["transmission.vehicle_speed", "transmission.shaft_torque"]
    return found


def slip_of(record: Record) -> dict[str, Any] | None:
    """Return when the pack that engages slips and levels to compare its friction with.

    None if its coefficient of friction stays the same.
    """
    pack, start = record.engaging, record.ramp_start
    end = record.figures.get("lock_time") or float(record.time[-1]) + 1.0
    slip, friction = record.series(f"{pack}.speed"), record.series(f"{pack}.friction_coefficient")
    if slip is None or friction is None:
        return None
    where = (record.time >= start) & (record.time < end) & (slip != 0.0)
    if np.sum(where) < 2 or np.ptp(friction[where]) < 1e-9:
        return None
    given = [p["published"] for p in record.published if p["name"] == "friction_mean"]
    found = [(value, f"published mean {value:.4g}") for value in given]
    mean = record.figures.get("friction_mean")
    found += [] if mean is None else [(mean, f"mean of this run {mean:.4g}")]
    return {"pack": pack, "from": start, "to": end, "levels": found}


def _with_oil(record: Record) -> dict[str, Array]:
    """Return torque over load, radius and faces where the load is large, if oil adds to it."""
    part, pack = record.part(record.engaging), record.engaging
    names = ("friction_torque", "viscous_torque", "load")
    torque, oil, load = (record.series(f"{pack}.{name}") for name in names)
    if part is None or torque is None or oil is None or load is None or not np.any(oil):
        return {}
    params, pressed = part.params(), load > LOADED * np.max(load)
    able = np.where(pressed, load, np.nan) * params.friction_radius * params.faces
    return {f"{pack}.friction_with_oil": np.abs(torque) / able}


def _of_the_vehicle(record: Record) -> dict[str, Array]:
    """Return acceleration [m/s2] and jerk [m/s3] of the vehicle, if there is one."""
    turning = record.series("transmission.output_acceleration")
    if record.reach is None or turning is None:
        return {}
    felt = record.reach * turning
    change = np.interp(record.time + JERK_TIME, record.time, felt) - felt
    return dict(zip(OF_THE_VEHICLE, (felt, change / JERK_TIME), strict=True))


def _shown(unit: str, relative: bool = False) -> dict[str, Any]:
    """Return the unit that is shown: where its zero lies and how large it is, in SI units."""
    shown = "degC" if unit == "K" and not relative else READABLE.get(unit, unit)
    scale, zero = UNITS.get(unit, {}).get(shown, (1.0, 0.0))
    return {"unit": pretty_unit(shown), "zero": zero, "scale": scale}


def signal_of(record: Record, name: str) -> dict[str, Any]:
    """Return a signal's words, unit and limit as its model gives them."""
    if name in OF_THE_VEHICLE:
        words, unit = OF_THE_VEHICLE[name]
        return {"name": name, "help": words, **_shown(unit)}
    of, _, own = name.partition(".")
    part = record.part(of)
    known = (*part.spec.inputs, *part.spec.outputs) if part else ()
    found = next((s for s in known if s.name == own), None)
    if found is None:
        words = f"{of}: {WITH_OIL}" if own == "friction_with_oil" else own.replace("_", " ")
        return {"name": name, "help": words, **_shown("1")}
    words = found.help if of == "transmission" else f"{of.replace('_', ' ')}: {found.help}"
    limit = {"limit": found.limit} if found.limit else {}
    return {"name": name, "help": words, **_shown(found.unit, found.relative), **limit}


def _packed_to_fit(rows: Array, record: Record, room: int) -> tuple[int, str]:
    """Return how many points are kept and the packed rows.

    Those of a long run have four digits; then so many are kept, evenly, as there is room for, and
    with them the extremes of all signals in each phase, those next to events and the last one.
    """
    n = count = rows.shape[1]
    keep, packed = np.ones(n, dtype=bool), pack(rows)
    if len(packed) > room:
        bits = rows[1:].view("<i4") + (1 << DROPPED - 1)
        rows = np.vstack((rows[:1], (bits >> DROPPED << DROPPED).view("<f4")))
        stay, packed = _to_stay(rows, record), pack(rows)
        while len(packed) > room and count > 1:
            count = int(0.97 * count * room / len(packed))
            keep = stay.copy()
            keep[np.linspace(0, n - 1, count).astype(int)] = True
            packed = pack(rows[:, keep])
    return int(keep.sum()), packed


def _to_stay(rows: Array, record: Record) -> Array:
    """Return which points are extremes of a phase, stand next to an event or at the end."""
    keep = np.zeros(rows.shape[1], dtype=bool)
    keep[-1] = True
    for _, start, end in record.phases:
        first, last = np.clip(np.searchsorted(record.time, [start, end]), 0, len(keep) - 1)
        for part in (rows[1:, first : last + 1], -rows[1:, first : last + 1]):
            keep[first + np.nan_to_num(part, nan=np.inf).argmin(axis=1)] = True
    beside = np.searchsorted(record.time, [e.time for e in record.events])
    for shift in (-1, 0, 1):
        keep[np.clip(beside + shift, 0, len(keep) - 1)] = True
    return keep


def pack(rows: Array) -> str:
    """Return single precision rows as text: second differences of their bits, by bytes, deflated.

    Profiles are smooth: what is left of them is mostly zeros.
    """
    bits = np.ascontiguousarray(rows, dtype="<f4").view("<i4")
    for _ in range(2):
        bits = np.diff(bits, axis=1, prepend=np.int32(0))
    planes = bits.astype("<i4").view(np.uint8).reshape(*rows.shape, 4).transpose(0, 2, 1)
    return base64.b64encode(zlib.compress(planes.tobytes(), 6)).decode("ascii")


def _moment(moment: Moment) -> dict[str, Any]:
    """Return the washer's fields, and where they were solved."""
    fields = moment.result.fields()
    return {
        "time": moment.time,
        "inputs": moment.point,
        "film_ratio": float(moment.result.film_ratio),
        "recorded_film_ratio": moment.recorded_film_ratio,
        "radius": fields.radius.tolist(),
        "angle": fields.angle.tolist(),
        **{n: [float(f"{x:.5g}") for x in getattr(fields, n).T.ravel()] for n in FIELDS},
    }
