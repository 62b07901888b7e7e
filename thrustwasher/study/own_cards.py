"""Cards for a part of one's own: its map and its rungs, verified in its box while one waits.

The same points, references and tables as those of the shipped cards, only fewer points. Maps and
cards are kept in the user's cache, by the digests of parameters and kernels.
"""

import shutil
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from ..errors import ParameterError
from ..ladder.boxes import Box
from ..ladder.card import OWN, Card, forget, own_folder
from ..ladder.card_parts import Axis
from ..model.prepare import tables_of
from ..model.registry import ladder_of
from ..model.spec import ModelSpec
from ..processes import runner, usable_cores
from ..storage.digests import params_digest
from .card_cases import Case
from .card_writer import write_card
from .reference_cache import reference_points, source_of
from .verify import case_of, holds, rung_cards

POINTS = (12, 5000)  # allowed
USUAL = 60
LEAST_SHARE = 2e-3  # of the upper end: there a logarithmic axis begins that would begin at zero
Show = Callable[[int, int], None]
Progress = Callable[[str], Show]


def own_case(spec: ModelSpec, params: Any, box: Box, n: int) -> Case:
    """Return the case of a part and the box that it is meant for; inputs left out are as shipped.

    ParameterError: the box leaves the model's range, or the number of points is not allowed.
    """
    if not POINTS[0] <= n <= POINTS[1]:
        raise ParameterError(f"points = {n}, allowed: {POINTS[0]} .. {POINTS[1]}")
    usual, tables = ladder_of(spec.key).boxes["default"], tables_of(spec)
    axes = {}
    for s in spec.inputs:
        if s.name not in usual:
            continue
        low, high = box.get(s.name, usual[s.name][:2])
        if not (s.low or 0.0) <= low <= high <= (s.high or 0.0):
            raise ParameterError(
                f"box: {s.name} = {low:g} .. {high:g} {s.unit}, allowed: {s.low:g} .. {s.high:g} "
                f"{s.unit}, low not above high"
            )
        scale = usual[s.name][2]
        if scale == "log":
            low = max(low, LEAST_SHARE * high, tables.least(s.name) if tables else 0.0)
            scale = "log" if low > 0.0 else "linear"
        axes[s.name] = Axis(low, high, s.unit, scale)
    name = f"{OWN}{params_digest(params)[:8]}"
    return Case(spec, name, params, axes, n)


def make_own_cards(
    spec: ModelSpec, params: Any, box: Box, *, tol: float = 0.01, points: int = USUAL,
    workers: int | None = None, progress: Progress | None = None,
) -> list[Card]:  # fmt: skip
    """Build a part's map if its model has maps, verify its rungs, keep both; return the cards.

    ``box`` holds (low, high) [SI] of the inputs it is meant for, ``tol`` is relative, of the map's
    torque; ``progress`` is called with a label and returns ``show(done, total)``. ParameterError:
    box, tolerance or number of points is not allowed; SolveError: the map cannot be made.
    """
    case, tables = own_case(spec, params, box, points), tables_of(spec)
    count = workers or usable_cores()
    show = progress or (lambda _label: lambda _done, _total: None)
    if tables:
        tables.build(params, box, tol, count, show)
    found = []
    with runner(count) as run:
        reference = show("held-out points")
        known = reference_points(case, source_of(spec.key), points, lambda k: reference(k, points),
                                 run)  # fmt: skip
    for rung in ladder_of(spec.key).kernels:
        if not holds(spec, rung, params):
            continue
        found += _cards(case, rung, known)
    shutil.rmtree(own_folder() / f"{spec.key}-{case.name}", ignore_errors=True)
    for card in found:
        write_card(card, own_folder())
    forget()
    return found


def _cards(case: Case, rung: str, known: list[Any]) -> list[Card]:
    """Return the cards of a rung; a chart with points beside folds only has none."""
    charts = {t.chart for t in known if not t.beside_fold}
    mine = [t for t in known if t.chart in charts]
    its = case_of(case, rung)
    part = its.part
    if part is not None:  # what of the box the map covers
        mine = [t for t in mine if all(a.min <= t.point[n] <= a.max for n, a in part.items())]
    return list(rung_cards(replace(its, n=len(mine)), rung, mine))
