"""Choose a level: the first, in the order of cost, that holds a tolerance over a box of inputs.

What it errs by is known from a table of measured errors. Where none speaks of the parameters or of
the box, the level is compared with the one above it at some points.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import NamedTuple

from ..errors import ParameterError, SolveError
from ..model.parameters import check_number, params_of
from ..model.prepare import tables_of
from ..model.registry import find_model, ladder_of, spec_of
from ..model.spec import ModelSpec
from ..units import format_quantity as say
from .compare_levels import Comparison, Point, points_of
from .error_table import QUANTITIES, SAFETY, Interval, LevelErrors, fresh_levels, load_tables
from .formats import shown_error

AUTO = "auto"
TOLERANCE = 0.01  # of "auto" alone
TORQUE = "friction_torque"
TOLERANCES = (1e-6, 0.5)
# The level above halves all widths and errs by a quarter: the difference is 3/4 of the error.
OF_DIFFERENCE = 4.0 / 3.0


def level_and_tolerance(where: str, spec: ModelSpec, text: object) -> tuple[str, float | None]:
    """Return level and tolerance of "field", "auto" or "auto:0.01"; None: as named.

    With a tolerance the level is the model's own default, until one is chosen.
    """
    level, _, given = text.partition(":") if isinstance(text, str) else ("", "", "")
    if level != AUTO and text not in spec.fidelities:
        options = " or ".join(map(repr, spec.levels))
        raise ParameterError(
            f"{where}: fidelity = {text!r}, allowed: {options} or 'auto:TOLERANCE'"
        )
    if level != AUTO:
        return level, None
    low, high = TOLERANCES
    try:
        tolerance = TOLERANCE if text == AUTO else float(given)
    except ValueError:
        tolerance = -1.0
    if not low <= tolerance <= high:
        raise ParameterError(
            f"{where}: fidelity = {text!r}, allowed: auto:TOLERANCE with {low:g} .. {high:g}, "
            "for example auto:0.01"
        )
    return spec.default_fidelity, tolerance


@dataclass(frozen=True, slots=True)
class Choice:
    """The level to take and its largest error in the box; ``str()`` gives the reasons.

    ``is_verified``: a table of measured errors promises the error. Otherwise it is estimated
    from the level above at some points, infinite if there is none above. ``seconds`` are those of
    all calls, NaN where no table speaks.
    """

    fidelity: str
    error: float
    seconds: float = field(compare=False)  # NaN is not equal to itself
    reasons: tuple[str, ...]
    is_verified: bool = True

    def __str__(self) -> str:
        return "\n  ".join(self.reasons)


def levels_of(spec: ModelSpec, params: object) -> list[str]:
    """Return the levels that can be chosen with these parameters, cheapest first.

    ParameterError: none can be chosen of this model.
    """
    ladder, found = ladder_of(spec.key), []
    for level in ladder.kernels:
        with suppress(ParameterError):  # there is no file for it to look its answers up in
            if tables := tables_of(spec, level):
                tables.find(params)
            if all(getattr(params, n) == value for n, value in ladder.only.get(level, {}).items()):
                found.append(level)
    return found


def choose(
    model: str,
    box: Mapping[str, float | Interval],
    *,
    quantity: str = "friction_torque",
    tol: float,
    n_calls: float = 1,
    safety: float = SAFETY,
    params: object = None,
    among: Sequence[str] | None = None,
    points: Sequence[Point] | None = None,
) -> Choice:
    """Return the cheapest level whose error stays within ``tol`` over a box of inputs.

    Parameters
    ----------
    model : "washer", "clutch" or "gearmesh"
    box : (low, high) for every input of the model, SI units; a single number is a point
    quantity : "friction_torque" (tol is relative), "temperature" (K), "film_thickness" (m) or
        "film_ratio" (1)
    tol : largest error allowed, above 0
    n_calls : how often the level will be called, for ``Choice.seconds``
    safety : factor on the largest error found, at least 1
    params : the parameter object; default: the model's defaults
    among : levels to choose from; default: all that can be chosen
    points : inputs at which levels are compared where no table speaks; default: 30 over the box

    Returns
    -------
    Choice : pass its ``fidelity`` to ``solve_*``

    Raises
    ------
    ParameterError : an argument is wrong; it is named with what is allowed
    SolveError : by its table no level holds the tolerance; the best that can be had is named

    Notes
    -----
    At a point the error of the torque is the ``error_estimate`` of the solution there, where
    results have one. Else the error of a level in a table is ``safety`` times the largest found in
    the regions that the box touches. With n random points in the table's box and none above tol,
    less than 3/n of the box is above tol, with 95 % confidence. The same tables and points give
    the same answer, and a larger tolerance never a costlier level.
    """
    spec = spec_of(model)
    params, whole = params_of(spec, params), checked_box(spec, box)
    if quantity not in QUANTITIES:
        raise ParameterError(f"quantity = {quantity!r}, allowed: {' or '.join(QUANTITIES)}")
    asked = _Request(
        spec.key,
        quantity,
        _above("tol", tol, 0.0, belongs=False),
        _above("safety", safety, 1.0),
        _above("n_calls", n_calls, 1.0),
    )
    levels = levels_of(spec, params)
    if among is not None:
        for name in among:
            if name not in levels:
                raise ParameterError(f"among: {name!r}, allowed: {' or '.join(map(repr, levels))}")
        levels = [name for name in levels if name in among]
    if not levels:
        raise ParameterError("among: no fidelity level, allowed: at least one")
    # What need not be given is zero in all tables.
    plain_inputs = all(whole[s.name] == (0.0, 0.0) for s in spec.inputs if s.optional)
    fresh = fresh_levels(spec.key, params) if plain_inputs else {}
    known = {
        level: asked.safety * worst
        for level in levels
        if level in fresh and (worst := fresh[level].worst(quantity, whole)) is not None
    }
    if known and asked.is_of_solutions and all(low == high for low, high in whole.values()):
        at = {name: low for name, (low, _) in whole.items()}
        found = _by_table(asked, known | _of_solutions(spec, params, at, known), fresh, at=True)
    elif known:
        found = _by_table(asked, known, fresh)
    else:
        compared = Comparison(spec, params, points or points_of(whole), quantity)
        found = _by_comparison(asked, levels, compared)
    tables = ((r, t.stale(r)) for t in load_tables(spec.key, params) for r in t.levels)
    stale = [
        f"not counted: {r.fidelity}: {why}" for r, why in tables if why and r.fidelity in levels
    ]
    return replace(found, reasons=(*found.reasons, *stale))


class _Request(NamedTuple):
    """What is requested: of which model, which error of what, between calls so many."""

    model: str
    quantity: str
    tol: float
    safety: float
    n_calls: float

    @property
    def is_of_solutions(self) -> bool:
        """Tell if it is the error that solutions estimate themselves."""
        return self.quantity == TORQUE and self.safety == SAFETY

    def shown(self, error: float) -> str:
        """Return an error of the quantity as a person reads it."""
        return shown_error(error, QUANTITIES[self.quantity])


def _of_solutions(
    spec: ModelSpec, params: object, at: dict[str, float], levels: Iterable[str]
) -> dict[str, float]:
    """Return the errors that the solutions at a point estimate, of levels of which they do."""
    model, found = find_model(spec.key), {}
    for level in levels:
        with suppress(ParameterError, SolveError):
            result = model.solve(params, **model.back(dict(at)), fidelity=level)
            estimate = getattr(result, "error_estimate", None)
            if estimate is not None:
                found[level] = float(estimate)
    return found


def _by_table(
    asked: _Request, known: dict[str, float], fresh: dict[str, LevelErrors], *, at: bool = False
) -> Choice:
    """Return the first level whose error holds, ``at`` a point or in a box; SolveError if none."""
    chosen = next((level for level, error in known.items() if error <= asked.tol), None)
    if chosen is None:
        best = min(known, key=lambda level: known[level])
        raise SolveError(
            f"{asked.model}: no fidelity level reaches {asked.shown(asked.tol)} in "
            f"{asked.quantity}; the "
            f"best is {best} with {asked.shown(known[best])}. Ask for less, or name a "
            f"fidelity level"
        )
    level = fresh[chosen]
    where = " at this point" if at else ""
    lines = [
        f"{asked.model}: {chosen}, {asked.quantity} within {asked.shown(known[chosen])}{where} "
        f"(requested {asked.shown(asked.tol)}), {say(level.call, 's', digits=2)} per call"
    ]
    beside = max(chart.beside_fold for chart in level.charts)
    if beside and not at and asked.quantity == TORQUE:
        promise = asked.shown(asked.safety * beside)
        lines.append(f"within 5 % of a fold's load: {promise}, if the branch is the same")
    for other, error in known.items():
        if other != chosen:
            words = "too coarse" if error > asked.tol else "would hold too"
            call = say(fresh[other].call, "s", digits=2)
            lines.append(f"{words}: {other}, {asked.shown(error)} in {call}")
    return Choice(chosen, known[chosen], asked.n_calls * level.call, tuple(lines))


def _by_comparison(asked: _Request, levels: list[str], compared: Comparison) -> Choice:
    """Return the first level that the one above confirms at the points, or the last."""
    coarse: list[str] = []
    n = len(compared.points)
    where = "there" if n == 1 else f"at {n} points"
    for level, above in pairwise(levels):
        difference = compared.difference(level, above)
        error = asked.safety * OF_DIFFERENCE * difference
        if error <= asked.tol:
            words = (
                f"{asked.model}: {level}, no table of errors speaks here; {where} it is "
                f"{asked.shown(difference)} from {above} (requested {asked.shown(asked.tol)})"
            )
            return Choice(level, error, math.nan, (words, *coarse), False)
        coarse.append(f"too coarse: {level}, {asked.shown(difference)} from {above}")
    words = f"{asked.model}: {levels[-1]}, the last fidelity level; no table of errors speaks here"
    return Choice(levels[-1], math.inf, math.nan, (words, *coarse), False)


def checked_box(spec: ModelSpec, box: Mapping[str, float | Interval]) -> dict[str, Interval]:
    """Return a box with an interval for every input, also of numbers, or say what is wrong."""
    names = [s.name for s in spec.inputs]
    for name in box:
        if name not in names:
            raise ParameterError(f"box: {name!r} is no input; allowed: {', '.join(names)}")
    found: dict[str, Interval] = {}
    for signal in spec.inputs:
        name, unit = f"box: {signal.name}", signal.unit
        if signal.name not in box and not signal.optional:
            raise ParameterError(
                f"{name} [{unit}] is missing; every input is required: {', '.join(names)}"
            )
        given = box.get(signal.name, signal.start or 0.0)
        try:
            low, high = (given, given) if isinstance(given, int | float) else given
        except (TypeError, ValueError):
            raise ParameterError(
                f"{name} = {given!r}, allowed: a number or (low, high) in {unit}"
            ) from None
        low, high = (check_number(name, x, unit, *signal.range) for x in (low, high))
        if low > high:
            raise ParameterError(f"{name} = {given!r} {unit}, allowed: low <= high")
        found[signal.name] = low, high
    return found


def _above(name: str, value: float, low: float, belongs: bool = True) -> float:
    """Return the value as a float if it is finite and above (or at) its lower limit."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not (math.isfinite(number) and (number >= low if belongs else number > low)):
        span = f"{low:g} or more" if belongs else f"above {low:g}"
        raise ParameterError(f"{name} = {value!r}, allowed: {span}")
    return number
