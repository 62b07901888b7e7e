"""Choose the cheapest rung that holds a tolerance over a box of inputs; nothing is solved here."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..errors import ParameterError, SolveError
from ..model.parameters import params_of
from ..model.registry import ladder_of, spec_of
from ..model.spec import ModelSpec
from ..units import format_quantity as say
from .boxes import Part, Request, checked_box
from .candidates import Candidate, Plan, candidates, plans
from .card import VERIFY
from .card_parts import QUANTITIES
from .formats import plain, shown_error, shown_share

AUTO = "auto"
TOLERANCE = 0.01  # of "auto" alone
TOLERANCES = (1e-6, 0.5)
REJECTED = ("cheaper but too coarse", "dearer and too coarse", "would hold too",
            "not verified in this box")  # fmt: skip


def rung_and_tolerance(where: str, spec: ModelSpec, text: object) -> tuple[str, float | None]:
    """Return rung and tolerance of "field", "auto" or "auto:0.01"; tolerance None: the rung as is.

    With a tolerance the rung is the model's own default, until one is chosen.
    """
    rung, _, given = text.partition(":") if isinstance(text, str) else ("", "", "")
    if rung != AUTO and text not in spec.fidelities:
        options = " or ".join(map(repr, spec.rungs))
        raise ParameterError(
            f"{where}: fidelity = {text!r}, allowed: {options} or 'auto:TOLERANCE'"
        )
    if rung != AUTO:
        return rung, None
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
    """The rung to take, what it promises and what it costs; ``str()`` gives the reasons.

    ``outside`` is the choice for the part of the box where the rung does not answer or is not
    verified, with ``share`` of the box and ``where`` in words. Its ``error`` is infinite where no
    card speaks: ``is_verified`` is then False.
    """

    fidelity: str
    error: float
    seconds: float
    reasons: tuple[str, ...]
    outside: "Choice | None" = None
    share: float = 1.0
    where: str = ""

    @property
    def is_verified(self) -> bool:
        """True if a card speaks for every part of the box."""
        return math.isfinite(self.error) and (self.outside is None or self.outside.is_verified)

    def __str__(self) -> str:
        return "\n  ".join(self.reasons)


def choose(
    model: str,
    box: Mapping[str, float | tuple[float, float]],
    *,
    quantity: str = "friction_torque",
    tol: float,
    n_calls: float = 1,
    safety: float = 1.5,
    params: Any = None,
    among: Sequence[str] | None = None,
    loaded: bool = False,
) -> Choice:
    """Return the cheapest rung whose verified error stays within ``tol`` over a box of inputs.

    Parameters
    ----------
    model : "washer", "clutch" or "gearmesh"
    box : (low, high) for every input of the model, SI units; a single number is a point
    quantity : "friction_torque" (tol is relative), "temperature" (K), "film_thickness" (m) or
        "film_ratio" (1)
    tol : largest error wanted, above 0
    n_calls : how often the rung will be called: what is spent once weighs less the more calls
    safety : factor on the largest held-out error, at least 1
    params : the parameter object; default: the model's defaults
    among : rungs to choose from; default: all that can have cards
    loaded : the model has been used before, so that no rung costs a first call

    Returns
    -------
    Choice : pass its ``fidelity`` to ``solve_*``

    Raises
    ------
    ParameterError : an argument is wrong; it is named with what is allowed
    SolveError : no rung holds the tolerance; the best that can be had is named

    Notes
    -----
    The error of a rung over the box is ``safety`` times the larger of its worst held-out error in
    the cells that the box touches and the uncertainty of the reference. What that promises is
    statistical: with n independent points and none above tol, less than 3/n of the verified box is
    above tol, with 95 % confidence. The same cards give the same answer.
    """
    ladder, spec = ladder_of(model), spec_of(model)  # ParameterError where no rung has a card
    rungs = [name for name in spec.fidelities if name in ladder.kernels]
    request = Request(
        spec, checked_box(spec, box), quantity, _above("tol", tol, 0.0, False),
        _above("n_calls", n_calls, 1.0), _above("safety", safety, 1.0), loaded,
    )  # fmt: skip
    if quantity not in QUANTITIES:
        raise ParameterError(f"quantity = {quantity!r}, allowed: {' or '.join(QUANTITIES)}")
    for name in among or ():
        if name not in rungs:
            raise ParameterError(f"among: {name!r}, allowed: {' or '.join(map(repr, rungs))}")
    wanted = [name for name in rungs if among is None or name in among]
    if not wanted:
        raise ParameterError(f"among: no rung, allowed: some of {', '.join(map(repr, rungs))}")
    found, refused = candidates(spec, params_of(spec, params), wanted)
    return decide(request, found, refused)


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


def decide(request: Request, found: list[Candidate], refused: dict[str, str]) -> Choice:
    """Return the choice among the candidates, in the ladder's order; SolveError if nothing fits.

    A pure function of cards and request. ``refused``: rung -> why its card does not count.
    """
    options = plans(request, found)
    if not options:
        raise SolveError(_refusal(request, found, refused))
    best, seen = options[0], options[0].seen
    asked = shown_error(request.tol, seen.kind, seen.unit)
    lines = [
        f"{request.spec.key}: {best.rung.fidelity}{seen.charts}, {request.quantity} within "
        f"{seen.promise} (asked {asked}), {say(best.rung.call, 's', digits=2)} per call",
        *_outside_lines(request, best),
    ]
    lines += _others(request, found, best) + [f"not asked: {r}: {w}" for r, w in refused.items()]
    return _choice(best, tuple(lines))


def _choice(plan: Plan, lines: tuple[str, ...]) -> Choice:
    """Return a plan and what follows it as choices."""
    after = None if plan.outside is None else _choice(plan.outside, ())
    return Choice(
        plan.rung.fidelity, plan.seen.error, plan.seconds, lines, after, plan.share, plan.where
    )


def _outside_lines(request: Request, plan: Plan) -> list[str]:
    """Say what serves where the chosen rung does not."""
    lines = []
    after = plan.outside
    while after is not None:
        part = f"outside it ({shown_share(after.share)} of the box, {after.where})"
        if math.isinf(after.seen.error):
            lines.append(f"{part}: no card speaks there; {after.rung.fidelity}, not verified")
        else:
            rung, promise = after.rung, after.seen.promise
            call = say(rung.call, "s", digits=2)
            lines.append(f"{part}: {rung.fidelity}, within {promise}, {call}")
        after = after.outside
    return [*lines, *filter(None, [plan.seen.beside_folds])]


def _others(request: Request, found: list[Candidate], best: Plan) -> list[str]:
    """Say of every rung that was not taken why: too coarse, dearer, or not verified here."""
    groups: dict[str, list[str]] = {words: [] for words in REJECTED}
    cheaper, coarser, holds, away = groups.values()
    for rung in found:
        if rung is best.rung:
            continue
        seen = rung.over([Part(request.box)], request)
        if seen is None:
            away.append(rung.fidelity)
            continue
        text = f"{rung.fidelity} {seen.promise}"
        if seen.error > request.tol:
            (cheaper if rung.call <= best.rung.call else coarser).append(text)
        else:
            holds.append(f"{text} in {say(rung.call, 's', digits=2)}")
    return [f"{words}: {', '.join(texts)}" for words, texts in groups.items() if texts]


def _refusal(request: Request, found: list[Candidate], refused: dict[str, str]) -> str:
    """Say that nothing fits, the best there is, and what to do."""
    key = request.spec.key
    if not found:
        why = "; ".join(f"{rung}: {why}" for rung, why in refused.items())
        return f"{key}: no rung has a card that holds here: {why}"
    stale = "".join(f"; {rung}: {why}" for rung, why in refused.items() if "card; make" not in why)
    seen = [(rung, rung.over([Part(request.box)], request)) for rung in found]
    here = [(s.error, rung.fidelity, s) for rung, s in seen if s is not None]
    if not here:
        envelope = found[-1].envelope
        spans = ", ".join(f"{n} {a.min:g} .. {a.max:g} {a.unit}" for n, a in envelope.items())
        return (
            f"{key}: the box lies outside what was verified for {request.quantity} ({spans}); "
            f"name a rung yourself, or move the box{stale}"
        )
    error, rung, s = min(here, key=lambda x: x[0])
    asked = f"{request.tol:.0e}" if request.tol < 1e-3 else plain(request.tol)
    unit = "" if s.unit in (None, "1") else f" {s.unit}"
    return (
        f"{key}: no rung reaches {asked}{unit} in {request.quantity}; the best is {rung} with "
        f"{plain(error)}{unit}. Ask for less, or verify a finer one: {VERIFY} {key} {rung}{stale}"
    )
