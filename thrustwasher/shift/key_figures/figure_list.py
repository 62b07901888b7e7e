"""The list of key figures, from ``figures.toml``. Values come from ``key_figures``."""

from functools import cache
from typing import Any, NamedTuple

from ...model.toml_tables import table_beside
from ...moved import now_named

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


# Names of earlier versions, for one version.
RENAMED = {n.replace("minimum_", "least_"): n for n in FIGURES if n.startswith("minimum_")}
RENAMED["greatest_slip"] = "maximum_slip"


def current(name: str) -> str:
    """Return a figure's name of today; a name of an earlier version gives a warning."""
    return next(iter(now_named("figures", RENAMED, {name: None})))


class Figures(dict[str, float | None]):
    """Values by name; a name of an earlier version is read with a warning."""

    def __missing__(self, name: str) -> float | None:
        """Return the value by its name of today."""
        if name not in RENAMED:
            raise KeyError(name)
        return self[current(name)]

    def __contains__(self, name: object) -> bool:
        """Tell if there is a value, also by a name of an earlier version."""
        return super().__contains__(current(name) if isinstance(name, str) else name)

    def get(self, name: str, default: Any = None) -> Any:
        """Return the value, also by a name of an earlier version."""
        return super().get(current(name), default)


def assemble(found: Found, pack: str, other: str) -> list[KeyFigure]:
    """Return the figures that were found, in the order of the list, in words for these packs."""
    words = {"pack": pack, "other": other, "film_speed": FILM_SPEED}
    return [
        KeyFigure(name, f.text.format(**words), f.unit, *found[name], f.difference)
        for name, f in FIGURES.items()
        if name in found
    ]
