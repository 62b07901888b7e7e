"""The list of key figures, from ``figures.toml``. Values come from ``key_figures``."""

from functools import cache
from typing import Any, NamedTuple

from ...model.toml_tables import table_beside

# [rad/s] of a planet on its pin. A film vanishes with speed: its minimum ratio is looked for above
# this speed only, else it would be that of the last sample before standstill.
FILM_SPEED = 10.0


class Definition(NamedTuple):
    """What a key figure says; ``difference``: of temperatures, no absolute temperature."""

    text: str
    unit: str
    reading: str = ""
    """What it is of a signal, as in "maximum mesh.load"; empty: it takes more to find it."""
    difference: bool = False


class KeyFigure(NamedTuple):
    """A key figure of a run: value in SI units, None where there is no such thing, and its time."""

    name: str
    text: str
    unit: str
    value: float | None
    time: float | None
    difference: bool


# name -> (value, time [s] it belongs to)
Found = dict[str, tuple[float | None, float | None]]

FIGURES = {n: Definition(*row) for n, row in table_beside(__file__, "figures.toml").items()}


@cache
def usual_rows() -> dict[str, list[Any]]:
    """Return the rows of ``usual.toml``: words, range, basis, unit and size of each figure."""
    return table_beside(__file__, "usual.toml")


def assemble(found: Found, pack: str, other: str) -> list[KeyFigure]:
    """Return the figures that were found, in the order of the list, in words for these packs."""
    words = {"pack": pack, "other": other, "film_speed": FILM_SPEED}
    return [
        KeyFigure(name, f.text.format(**words), f.unit, *found[name], f.difference)
        for name, f in FIGURES.items()
        if name in found
    ]
