"""Ways to step the clutch of ``lockup`` from one communication point to the next."""

from __future__ import annotations

import math
from collections.abc import Callable

from .lockup import Advance, Clutch, Course, Now, Rewind, walk

LEAST_SHARE = 1e-6  # of a macro step, the smallest step of step doubling
TOLERANCE = 1e-4  # of step doubling, of the slip at the start


def _way(advance: Advance) -> Callable[..., Course]:
    """Return the way that goes from point to point by ``advance``."""

    def run(clutch: Clutch, step: float, rewind: Rewind | None = None) -> Course:
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
    return _moved(c, now, h, c.smooth(now.slip, now.film, now.time), now.own)


def _late(c: Clutch, now: Now, h: float) -> Now:
    """Friction torque handed over, one step old."""
    return _moved(c, now, h, now.own, c.smooth(now.slip, now.film, now.time))


def _stages(c: Clutch, now: Now, h: float) -> Now:
    """Classical Runge-Kutta steps of fixed length on smoothed friction."""
    t, w = now.time, now.slip
    half, end = c.film_after(now.film, 0.5 * h), c.film_after(now.film, h)

    def rate(slip: float, film: float, at: float) -> float:
        return (c.drive - c.smooth(slip, film, at)) / c.inertia

    k1 = rate(w, now.film, t)
    k2 = rate(w + 0.5 * h * k1, half, t + 0.5 * h)
    k3 = rate(w + 0.5 * h * k2, half, t + 0.5 * h)
    k4 = rate(w + h * k3, end, t + h)
    new = w + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    middle = 0.5 * (w + new)
    power = c.smooth(w, now.film, t) * w + 4.0 * c.smooth(middle, half, t + 0.5 * h) * middle
    power += c.smooth(new, end, t + h) * new
    return Now(t + h, new, now.heat + h / 6.0 * power, end, now.own, now.work + 4)


def _modes(c: Clutch, now: Now, h: float) -> Now:
    """Stick and slip as modes, lock-up located inside the step, as the package's driveline does."""
    film, end = c.film_after(now.film, 0.5 * h), c.film_after(now.film, h)
    level = c.level(film, now.time + 0.5 * h)
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
    level = c.level(now.film, now.time)
    torque = c.smooth(now.slip, now.film, now.time)
    slope = (level - torque * torque / level) / c.width if level else 0.0
    change = h * (c.drive - torque) / (c.inertia + h * slope)
    heat = now.heat + h * (torque + 0.5 * slope * change) * (now.slip + 0.5 * change)
    film = c.film_after(now.film, h)
    return Now(now.time + h, now.slip + change, heat, film, now.own, now.work + 1)


def _doubled(c: Clutch, now: Now, h: float) -> Now:
    """Held torque, a step against two half ones; given back and halved where they disagree."""
    end, least = now.time + h, LEAST_SHARE * h
    size = min(h, now.own) if now.own > 0.0 else h
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


def step_doubling(clutch: Clutch, step: float, rewind: Rewind | None = None) -> Course:
    """Held torque, a step against two half ones; given back and halved where they disagree."""

    def advance(c: Clutch, now: Now, h: float) -> Now:
        # what `lockup.begin` keeps is a torque, which is no step
        return _doubled(c, now if now.time > 0.0 else now._replace(own=h), h)

    return walk(clutch, step, advance, rewind)


runge_kutta, located = _way(_stages), _way(_modes)
gauss_seidel, jacobi, linearly_implicit = _way(_held), _way(_late), _way(_sloped)
