"""The clutch of ``lockup`` by general solvers with error control, friction smoothed."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise

import numpy as np

from .lockup import Clutch, Course, Rewind, Row, begin

TOLERANCE = 1e-8


def _stretch(clutch: Clutch, method: str, y: Row, times: Row) -> tuple[Row, Row, int]:
    """Integrate from the first time to the last; return slips, the state there and the work."""
    from scipy.integrate import solve_ivp

    def rate(t: float, y: Row) -> list[float]:
        torque = clutch.smooth(y[0], y[2], t)
        film = (1.0 - y[2]) / clutch.lag if clutch.lag else 0.0
        return [(clutch.drive - torque) / clutch.inertia, torque * y[0], film]

    found = solve_ivp(
        rate, (times[0], times[-1]), y, method=method, t_eval=times, rtol=TOLERANCE,
        atol=TOLERANCE,
    )  # fmt: skip
    return found.y[0], found.y[:, -1], int(found.nfev)


def adaptive(
    clutch: Clutch, step: float, rewind: Rewind | None = None, method: str = "LSODA"
) -> Course:
    """Integrate with error control; ``step`` is what the slip is looked at with.

    After going back the solver begins anew: what it knows of the past is no state of the problem.
    """
    now, n = begin(clutch), round(clutch.span / step)
    times = np.linspace(0.0, clutch.span, n + 1)
    slip, work = np.empty(n + 1), 0
    y = np.array([now.slip, 0.0, now.film])
    stops = [*range(0, n, rewind.every), n] if rewind else [0, n]
    for first, last in pairwise(stops):
        if rewind and first:
            stop = min(first + rewind.ahead, n)
            _, ahead, spent = _stretch(clutch, method, y, times[first : stop + 1])
            work += spent
            if rewind.forgets:
                y[2] = ahead[2]
        part, y, spent = _stretch(clutch, method, y, times[first : last + 1])
        slip[first : last + 1] = part
        work += spent
    return Course(slip, float(y[1]), work)


lsoda: Callable[..., Course] = partial(adaptive, method="LSODA")
bdf: Callable[..., Course] = partial(adaptive, method="BDF")
