"""What is usual next to what came out: the ranges stand in ``usual.toml``."""

import math
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from ....shift.account.shift_record import Record
from ....shift.account.worst_moments import Find, of_meshes
from ....shift.key_figures.figure_list import FILM_SPEED, usual_rows
from ..html import Table
from ..palette import CELSIUS
from ..scatter.words import BAND, HIGH, LOW, outside_words, padded, varies

MARKS = {"usual": "", "below": "▼\N{NO-BREAK SPACE}below", "above": "▲\N{NO-BREAK SPACE}above"}


class Usual(NamedTuple):
    """A figure with its usual range in the unit shown, one of which is ``scale`` SI units."""

    text: str
    range: tuple[float, float]
    basis: str
    unit: str = ""
    scale: float = 1.0

    def range_words(self) -> str:
        """Return the range with its unit."""
        low, high = self.range
        if math.isinf(high):
            return self._with_unit(f"{low:g} or more")
        return self._with_unit(f"up to {high:g}" if math.isinf(low) else f"{low:g} .. {high:g}")

    def value_words(self, value: float) -> str:
        """Return a value with the unit shown."""
        return self._with_unit(f"{float(f'{value / self.scale:.3g}'):g}")

    def place(self, value: float) -> str:
        """Return where a value lies: usual, below or above."""
        low, high = self.range
        shown = value / self.scale
        return "below" if shown < low else "above" if shown > high else "usual"

    def note(self, value: float) -> str:
        """Return the range, and on which side of it the value lies."""
        return f"usual: {self.range_words()} {MARKS[self.place(value)]}".strip()

    def study_words(self, band: Any) -> str:
        """Return the band of a study."""
        if band is None or not varies(band):
            return ""
        low, high = (padded(band.quantiles[level] / self.scale) for level in (LOW, HIGH))
        return self._with_unit(f"{low} .. {high}")

    def _with_unit(self, words: str) -> str:
        return f"{words} {self.unit}".strip().replace(" ", "\N{NO-BREAK SPACE}")


@cache
def ranges() -> dict[str, Usual]:
    """Return what is usual, by the name of the figure."""
    return {name: Usual(*row) for name, row in usual_rows().items()}


def _rise(r: Record) -> float | None:
    hot = r.figures.get(f"peak_{r.engaging}_temperature")
    return None if hot is None else hot - r.oil_temperature


def _friction_ratio(r: Record) -> float | None:
    lock, middle = r.figures.get("friction_lock"), r.figures.get("friction_middle")
    return lock / middle if lock and middle else None


def _face_pressure(r: Record) -> float | None:
    """Return the maximum pressure [Pa] on the land of the faces while the pack slips."""
    load, slip = r.series(f"{r.engaging}.load"), r.series(f"{r.engaging}.speed")
    part = r.part(r.engaging)
    if load is None or slip is None or part is None or not np.any(slip):
        return None
    params = part.params()
    return float(np.max(load[slip != 0.0]) * params.faces / params.lining_area / params.land_share)


def _sliding_speed(r: Record) -> float | None:
    slip, part = r.figures.get("maximum_slip"), r.part(r.engaging)
    return None if slip is None or part is None else float(slip * part.params().friction_radius)


def _tooth_film(r: Record) -> float | None:
    """Return the film ratio in the gear before; at lock-up the planets stop."""
    speed = r.at("mesh.speed", r.ramp_start)
    turns = r.rated_teeth and speed is not None and abs(speed) >= FILM_SPEED
    return r.at("mesh.film_ratio_gf", r.ramp_start) if turns else None


def _hottest_oil(r: Record) -> float | None:
    values = r.series("sump.temperature")
    return None if values is None else float(np.max(values)) - CELSIUS


FINDERS: dict[str, Find] = {
    "rise": _rise,
    "friction_ratio": _friction_ratio,
    "face_pressure": _face_pressure,
    "sliding_speed": _sliding_speed,
    "pitting_safety": of_meshes("pitting_safety"),
    "scuffing_safety": of_meshes("scuffing_safety"),
    "contact_pressure": of_meshes("contact_pressure_max", np.max),
    "tooth_film": _tooth_film,
    "hottest_oil": _hottest_oil,
}


def beside(record: Record) -> dict[str, tuple[Usual, float]]:
    """Return what the run has of these figures; nothing of a pack alone, as on a test rig."""
    found = {}
    for key, usual in () if record.alone else ranges().items():
        name = key.format(pack=record.engaging)
        value = FINDERS[key](record) if key in FINDERS else record.figures.get(name)
        if value is not None:
            found[name] = (usual, value)
    return found


def _outside(record: Record, name: str) -> str:
    found = record.band_name(name)
    return outside_words(record.scatter, found) if found and varies(record.band(name)) else ""


def usual_table(record: Record) -> Table:
    """Return every figure against what is usual; one outside is marked, not blamed.

    Where its band is known the median is marked. With a study of scatter also the band, and how
    probably it is below and above.
    """
    found, studied = beside(record), record.scatter is not None
    middles = {name: s[1] for name in found if (s := record.spread(name))}
    rows = [
        (
            u.text,
            u.value_words(v),
            *((u.value_words(middles[name]) if name in middles else "",) if middles else ()),
            *((u.study_words(record.band(name)), _outside(record, name)) if studied else ()),
            u.range_words(),
            MARKS[u.place(middles.get(name, v))],
            u.basis,
        )
        for name, (u, v) in found.items()
    ]
    more = (*(("median",) if middles else ()), *((BAND, "P(outside usual)") if studied else ()))
    heads = ("", "this run", *more, "usual", "", "what the range rests on")
    return Table(heads, rows, numbers=range(1, 2 + len(more)))
