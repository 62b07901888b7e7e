"""Methods for the clutch of ``lockup``: steps between communication points, and general solvers."""

import math
from collections.abc import Callable
from functools import partial
from itertools import pairwise

import numpy as np

from .lockup import Advance, Clutch, Now, Rewind, Row, Run, begin, walk

LEAST_SHARE = 1e-6  # of a macro step, the smallest step of step doubling
TOLERANCE = 1e-4  # of step doubling, of the slip at the start
SOLVERS = 1e-8  # tolerance of the general solvers


def _method(advance: Advance) -> Callable[..., Run]:
    """Return the method that goes from point to point by ``advance``."""

    def run(clutch: Clutch, step: float, rewind: Rewind | None = None) -> Run:
        return walk(clutch, step, advance, rewind)

    run.__doc__ = advance.__doc__
    return run


def _moved(c: Clutch, now: Now, h: float, torque: float, own: float) -> Now:
    """Return what follows from a torque that is held over a step."""
    slip = now.slip + h * (c.drive - torque) / c.inertia
    heat = now.heat + h * torque * 0.5 * (now.slip + slip)
    return Now(now.time + h, slip, heat, c.film_after(now.film, h), own, now.work + 1)


def _held(c: Clutch, now: Now, h: float) -> Now:
    """Friction torque handed over, fresh in each step, held while the driveline steps."""
    return _moved(c, now, h, c.smooth(now.slip, now.film), now.own)


def _late(c: Clutch, now: Now, h: float) -> Now:
    """Friction torque handed over, one step old."""
    return _moved(c, now, h, now.own, c.smooth(now.slip, now.film))


def _stages(c: Clutch, now: Now, h: float) -> Now:
    """Classical Runge-Kutta steps of fixed length on smoothed friction."""
    w = now.slip
    half, end = c.film_after(now.film, 0.5 * h), c.film_after(now.film, h)

    def rate(slip: float, film: float) -> float:
        return (c.drive - c.smooth(slip, film)) / c.inertia

    k1 = rate(w, now.film)
    k2 = rate(w + 0.5 * h * k1, half)
    k3 = rate(w + 0.5 * h * k2, half)
    k4 = rate(w + h * k3, end)
    new = w + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    middle = 0.5 * (w + new)
    power = c.smooth(w, now.film) * w + 4.0 * c.smooth(middle, half) * middle
    power += c.smooth(new, end) * new
    return Now(now.time + h, new, now.heat + h / 6.0 * power, end, now.own, now.work + 4)


def _stick_slip(c: Clutch, now: Now, h: float) -> Now:
    """Stick and slip as modes, lock-up located inside the step, as the package's driveline does."""
    film, end = c.film_after(now.film, 0.5 * h), c.film_after(now.film, h)
    level = c.friction * film
    stuck = abs(c.drive) <= level
    after = now._replace(time=now.time + h, film=end, work=now.work + 1)
    if now.slip == 0.0 and stuck:
        return after
    torque = math.copysign(level, now.slip)
    rate = (c.drive - torque) / c.inertia
    new = now.slip + h * rate
    if new * now.slip <= 0.0 and stuck:
        until = -now.slip / rate
        return after._replace(slip=0.0, heat=now.heat + 0.5 * torque * now.slip * until)
    return after._replace(slip=new, heat=now.heat + h * torque * 0.5 * (now.slip + new))


def _sloped(c: Clutch, now: Now, h: float) -> Now:
    """Friction torque with its slope over the slip, both handed over."""
    level = c.friction * now.film
    torque = c.smooth(now.slip, now.film)
    slope = (level - torque * torque / level) / c.width if level else 0.0
    change = h * (c.drive - torque) / (c.inertia + h * slope)
    heat = now.heat + h * (torque + 0.5 * slope * change) * (now.slip + 0.5 * change)
    film = c.film_after(now.film, h)
    return Now(now.time + h, now.slip + change, heat, film, now.own, now.work + 1)


def _doubled(c: Clutch, now: Now, h: float) -> Now:
    """Held torque, a step against two half ones; given back and halved where they disagree."""
    end, least = now.time + h, LEAST_SHARE * h
    known = now.time > 0.0 and now.own > 0.0  # what `lockup.begin` keeps is a torque, no step
    size = min(h, now.own) if known else h
    while end - now.time > 1e-9 * h:
        size = min(size, end - now.time)
        once = _held(c, now, size)
        half = _held(c, now, 0.5 * size)
        twice = _held(c, half, 0.5 * size)
        error = abs(twice.slip - once.slip) / (TOLERANCE * c.slip)
        work = now.work + 3
        if error <= 1.0 or size <= least:
            now = twice._replace(work=work)
            size *= 2.0 if error < 0.2 else 1.0
        else:
            now = now._replace(work=work)
            size *= 0.5
    return now._replace(time=end, own=size)


runge_kutta, located, step_doubling = _method(_stages), _method(_stick_slip), _method(_doubled)
gauss_seidel, jacobi, linearly_implicit = _method(_held), _method(_late), _method(_sloped)


def _stretch(clutch: Clutch, method: str, y: Row, times: Row) -> tuple[Row, Row, int]:
    """Integrate from the first time to the last; return slips, the state there and the work."""
    from scipy.integrate import solve_ivp

    def rate(t: float, y: Row) -> list[float]:
        torque = clutch.smooth(y[0], y[2])
        film = (1.0 - y[2]) / clutch.lag if clutch.lag else 0.0
        return [(clutch.drive - torque) / clutch.inertia, torque * y[0], film]

    found = solve_ivp(
        rate, (times[0], times[-1]), y, method=method, t_eval=times, rtol=SOLVERS,
        atol=SOLVERS,
    )  # fmt: skip
    return found.y[0], found.y[:, -1], int(found.nfev)


def adaptive(
    clutch: Clutch, step: float, rewind: Rewind | None = None, method: str = "LSODA"
) -> Run:
    """Integrate with error control, friction smoothed; the slip is looked at every ``step``.

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
    return Run(slip, float(y[1]), work)


lsoda: Callable[..., Run] = partial(adaptive, method="LSODA")
bdf: Callable[..., Run] = partial(adaptive, method="BDF")
