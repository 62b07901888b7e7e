"""What is varied, what is requested and under which limits: from words to numbers."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...errors import ParameterError, suggestion
from ...model.quantity import Figure, Quantity
from ...shown import text_of
from ...units import into_range, parse_quantity
from .designs import Array, Row

MOST_GOALS = 2
SURE = (0.5, 0.999)  # share of the draws that a robust design meets its limits in


@dataclass(frozen=True, kw_only=True)
class Goal:
    """A figure that is to be as small as possible, or as large."""

    figure: Figure
    most: bool = False

    @property
    def words(self) -> str:
        """What is requested."""
        return f"{'maximise' if self.most else 'minimise'} {self.figure.name}"


@dataclass(frozen=True, kw_only=True)
class Limit:
    """A figure that has to stay on one side of a value [SI]."""

    figure: Figure
    bound: float
    upper: bool

    @property
    def words(self) -> str:
        """The limit as a person reads it."""
        return f"{self.figure.name} {'<=' if self.upper else '>='} {shown(self.figure, self.bound)}"


@dataclass(frozen=True, kw_only=True)
class Problem:
    """All of it; designs are points u of the unit cube, (k,) for k variables."""

    variables: tuple[Quantity, ...]
    goals: tuple[Goal, ...]
    limits: tuple[Limit, ...]
    robust: float | None = None
    """Share of the draws of the scatter in which the limits are to be met."""

    @property
    def every_figure(self) -> tuple[Figure, ...]:
        """The figures that count, each once."""
        every = (*(g.figure for g in self.goals), *(x.figure for x in self.limits))
        return tuple({figure.name: figure for figure in every}.values())

    @property
    def figures(self) -> tuple[str, ...]:
        """Names of the figures that count."""
        return tuple(figure.name for figure in self.every_figure)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the variables."""
        return tuple(v.name for v in self.variables)

    @property
    def spans(self) -> Array:
        """Widths of the variables [SI] (k,)."""
        return np.array([v.high - v.low for v in self.variables])

    def row(self, u: Array) -> dict[str, float]:
        """Return the values [SI] of a design."""
        return {
            v.name: min(max(v.low * (1.0 - float(x)) + v.high * float(x), v.low), v.high)
            for v, x in zip(self.variables, u, strict=True)
        }

    def point(self, row: Row) -> Array:
        """Return the place of a design in the cube, moved inside."""
        values = np.array([row[v.name] for v in self.variables], float)
        found: Array = np.clip((values - [v.low for v in self.variables]) / self.spans, 0.0, 1.0)
        return found

    def costs(self, values: Array) -> Array:
        """Return what is to be small of figures (n, m): (n, goals)."""
        columns = [self.figures.index(g.figure.name) for g in self.goals]
        found: Array = values[:, columns] * np.array([-1.0 if g.most else 1.0 for g in self.goals])
        return found

    def excess(self, values: Array) -> Array:
        """Return by how much figures (n, m) exceed their limits (n, limits); below 0: inside."""
        columns = [self.figures.index(x.figure.name) for x in self.limits]
        bounds = np.array([x.bound for x in self.limits])
        found: Array = (values[:, columns] - bounds) * self.sides
        return found

    @property
    def sides(self) -> Array:
        """1 for an upper limit, -1 for a lower one (limits,)."""
        return np.array([1.0 if x.upper else -1.0 for x in self.limits])


def shown(figure: Figure, value: float, digits: int = 4) -> str:
    """Return a figure's value as a person reads it."""
    return text_of(value, figure.unit, figure.relative, digits)


def read_problem(
    places: Mapping[str, Quantity],
    figures: Mapping[str, Figure],
    *,
    vary: Mapping[str, str | tuple[float, float]],
    minimise: Sequence[str] = (),
    maximise: Sequence[str] = (),
    limits: Sequence[str] = (),
    robust: float | None = None,
) -> Problem:
    """Return a problem.

    Parameters
    ----------
    places, figures : what there is, by name
    vary : by name "low:high" with units, or two numbers [SI]
    minimise, maximise : names of one or two figures in all
    limits : "FIGURE<=VALUE" or "FIGURE>=VALUE"
    robust : 0.5 .. 0.999, or None

    Raises
    ------
    ParameterError : something is not allowed, with its name
    """
    if not vary:
        raise ParameterError("vary: nothing is varied, allowed: NAME=low:high, at least one")
    goals = [Goal(figure=_figure("minimise", n, figures)) for n in minimise]
    goals += [Goal(figure=_figure("maximise", n, figures), most=True) for n in maximise]
    if not 1 <= len(goals) <= MOST_GOALS:
        raise ParameterError(
            f"minimise, maximise: {len(goals)} figures, allowed: one, or two for a front"
        )
    if len({g.figure.name for g in goals}) < len(goals):
        raise ParameterError(f"minimise, maximise: {goals[0].figure.name} is given twice")
    if robust is not None and not SURE[0] <= robust <= SURE[1]:
        raise ParameterError(f"robust = {robust!r}, allowed: {SURE[0]:g} .. {SURE[1]:g}")
    return Problem(
        variables=tuple(_variable(name, ends, places) for name, ends in vary.items()),
        goals=tuple(goals),
        limits=tuple(_limit(text, figures) for text in limits),
        robust=robust,
    )


def _figure(option: str, name: str, figures: Mapping[str, Figure]) -> Figure:
    if name in getattr(figures, "absent", ()):
        raise ParameterError(
            f"{option} {name}: has no value with these parameters: a limit that it is measured by "
            "(root_limit), or what it is of, is not given"
        )
    if name not in figures:
        hint = suggestion(name, figures, "; did you mean {}?")
        raise ParameterError(f"{option} {name}: allowed: {', '.join(figures)}{hint}")
    return figures[name]


def _variable(
    name: str, given: str | tuple[float, float], places: Mapping[str, Quantity]
) -> Quantity:
    if name not in places:
        hint = suggestion(name, places, "; did you mean {}?")
        raise ParameterError(f"vary {name}: there is no such parameter, input or path{hint}")
    place = places[name]
    if place.choices:
        raise ParameterError(f"vary {name}: is a choice or a count, allowed: real numbers")
    ends = given.split(":") if isinstance(given, str) else list(given)
    if len(ends) != 2:
        raise ParameterError(f"vary {name}={given}: allowed: low:high, e.g. {name}=1:2")
    low, high = (parse_quantity(x, place.unit, name, difference=place.relative) for x in ends)
    low, high = (into_range(place.low, place.high, value) for value in (low, high))
    for text, value in zip(ends, (low, high), strict=True):
        if not place.low <= value <= place.high:
            raise ParameterError(f"vary {name}: {text}, allowed: {place.range_text}")
    if not low < high:
        raise ParameterError(f"vary {name}={given}: allowed: low below high")
    words = " ".join(map(str, ends))
    in_degrees = place.unit == "rad" and ("deg" in words or "\N{DEGREE SIGN}" in words)
    return replace(place, low=low, high=high, in_degrees=in_degrees)


def _limit(text: str, figures: Mapping[str, Figure]) -> Limit:
    match = re.fullmatch(r"\s*([\w.]+)\s*(<=|>=)\s*(.+?)\s*", text)
    if match is None:
        raise ParameterError(f"limit {text!r}: allowed: FIGURE<=VALUE or FIGURE>=VALUE, in quotes")
    figure = _figure("limit", match[1], figures)
    bound = parse_quantity(match[3], figure.unit, figure.name, difference=figure.relative)
    if not np.isfinite(bound):
        raise ParameterError(f"limit {text!r}: allowed: a finite value")
    return Limit(figure=figure, bound=bound, upper=match[2] == "<=")
