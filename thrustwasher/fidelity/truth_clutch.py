"""The clutch's reference values: slip that lasts, and an engagement.

Chart `settled` is slip that lasts for ever, as ``solve_clutch`` takes it; chart `engagement` is a
pack that closes while its slip runs out, as in a shift, at points of time.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import SolveError, Status
from ..kernels.clutch_constants import derive_rings
from ..kernels.clutch_layout import HOT_LIMIT, O_FILM, O_RATIO, O_TEMPERATURE, O_TORQUE
from ..models.clutch import prepare
from ..models.clutch_engagement import PackCourse
from .courses import course
from .reference_clutch import RINGS, reference_clutch
from .truths import QUANTITIES, Point, Source, Truth, Values

PLACES = (O_TORQUE, O_TEMPERATURE, O_FILM, O_RATIO)  # of the quantities, among the outputs
BEFORE, GAIN = ((b / a) ** 2 - 1.0 for a, b in pairwise(RINGS))
Array = NDArray[np.float64]


def clutch_truths(params: Any, point: Point) -> list[Truth]:
    """Return the reference's answers at a point, settled and in an engagement.

    Both are extrapolated over the number of rings. A chart on which the equations have no solution
    is left out, and slip that would burn the lining before it settles.
    """
    found = []
    for chart, ask in (("settled", _settled), ("engagement", _engagement)):
        try:
            values, uncertainty = ask(params, point)
        except SolveError:
            continue
        if chart == "settled" and float(np.max(values["temperature"])) > HOT_LIMIT:
            continue
        found.append(Truth(point, chart, None, values, uncertainty))
    return found


def _settled(params: Any, point: Point) -> tuple[Values, dict[str, float]]:
    """Return the quantities of slip that lasts, and what they may be off by."""
    at: Any = point
    r = reference_clutch(params, **at)
    return {q: r.values[q] for q in QUANTITIES}, {q: r.uncertainty[q] for q in QUANTITIES}


def _engagement(params: Any, point: Point) -> tuple[Values, dict[str, float]]:
    """Return the quantities over the course, and what they may be off by at worst."""
    a, b, c = (_course(params, n, point) for n in RINGS)
    value, other = c + (c - b) / GAIN, b + (b - a) / BEFORE
    off = np.maximum(np.abs(c - b) / GAIN, np.abs(value - other)).max(axis=1)
    values: Values = dict(zip(QUANTITIES, value.tolist(), strict=True))
    return values, dict(zip(QUANTITIES, off.tolist(), strict=True))


def _course(params: Any, n: int, point: Point) -> Array:
    """Return the quantities over the course, one row each, of a pack in ``n`` rings."""
    par, oil = prepare(params, "fine").copy(), point["oil_temperature"]
    derive_rings(par, n)
    time, load, slip = course(point["load"], point["speed"])
    rows = np.empty((len(PLACES), len(time)))
    pack = PackCourse(par, load[0], oil)
    for i in range(len(time)):
        if i:
            ends = (load[i - 1], slip[i - 1], oil, load[i], slip[i], oil)
            pack.advance(ends, time[i] - time[i - 1])
        out = pack.show(load[i], slip[i])
        if Status(pack.status).is_failure:
            raise SolveError(f"engagement: {Status(pack.status).advice} (t = {time[i]:g} s)")
        rows[:, i] = [out[k] for k in PLACES]
    return rows


SOURCE = Source(
    clutch_truths, ("clutch_advance", "clutch_outputs", "clutch_steady"), "reference", None,
    (f"{', '.join(map(str, RINGS))} rings, order 2; settled below {HOT_LIMIT:g} K",),
)  # fmt: skip
