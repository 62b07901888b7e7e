# mypy: disable-error-code="no-any-return"
"""One step: intervals of smooth motion between the instants where something changes.

An interval ends where the engine is turned on or its profile has a point, where an extrapolated
capacity reaches zero, or where a pack locks or breaks away; the instant is located on the local
solution.
"""

import numpy as np

from ...numerics.arrays import copy
from ...numerics.jit import Array, kernel
from ...numerics.status import MAX_ITERATIONS, NO_EVENT, NOT_FINITE, OK
from . import layout as L
from .dynamics import trial_step
from .piston import next_point, profile
from .stick_slip import decide, dip, guard, locate, slip_of

MAX_TRIALS = 20000
MAX_EVENTS = 200
LEAST_SHARE = 1e-9  # of the step: shorter returns to zero slip are rounding


@kernel
def next_break(par: Array, work: Array, t: float, s: float, end: float) -> float:
    """Return the end of the interval that begins at ``s``: the next instant known beforehand."""
    found = end
    instant = par[L.D_RUN_START] + par[L.P_ENGINE_START_TIME] - t
    if s < instant < found:
        found = instant
    point = next_point(par, L.P_ENGINE_PROFILE, t + s, t + end)
    if point < t + end and s < point - t < found:
        found = point - t
    for k in range(2):
        start = work[np.uintp(L.W_CLUTCH_START + 2 * k)]
        slope = work[np.uintp(L.W_CLUTCH_SLOPE + 2 * k)]
        if slope != 0.0:
            instant = -start / slope
            if s < instant < found:
                found = instant
    return found


@kernel
def begin_stretch(par: Array, work: Array, t: float, s: float, end: float) -> None:
    """Set what holds from ``s`` to ``end``: engine torque, which packs can hold, modes."""
    middle = 0.5 * (s + end)
    if par[L.P_ENGINE_PROFILE] > 0.0:
        start, slope = profile(par, L.P_ENGINE_PROFILE, t + s), 0.0
        if end > s:
            slope = (profile(par, L.P_ENGINE_PROFILE, t + end) - start) / (end - s)
        start -= slope * s
    else:
        on = t + middle >= par[L.D_RUN_START] + par[L.P_ENGINE_START_TIME]
        start, slope = par[L.P_ENGINE_TORQUE] if on else 0.0, 0.0
    slope += work[L.W_ENGINE_RATE]
    work[L.W_ENGINE_START], work[L.W_ENGINE_SLOPE] = start + work[L.W_ENGINE_GIVEN], slope
    work[L.W_ENGINE] = work[L.W_ENGINE_START] + slope * middle
    clutch = work[L.W_CLUTCH_START] + work[L.W_CLUTCH_SLOPE] * middle
    brake = work[L.W_BRAKE_START] + work[L.W_BRAKE_SLOPE] * middle
    work[L.W_CLUTCH_ACTIVE] = 1.0 if clutch > 0.0 or work[L.W_DRAG] > 0.0 else 0.0
    work[L.W_BRAKE_ACTIVE] = 1.0 if brake > 0.0 else 0.0


@kernel
def note_events(
    par: Array, work: Array, clutch_before: float, brake_before: float, now: float
) -> None:
    """Keep times and counts of lock-up and break-away; a pack without capacity does not count."""
    clutch, brake = work[L.W_CLUTCH_MODE], work[L.W_BRAKE_MODE]
    if (clutch == L.STUCK) != (clutch_before == L.STUCK):
        work[L.W_EVENTS + 3] += 1.0
        if clutch == L.STUCK:
            work[L.W_EVENTS] = now
            work[L.W_EVENTS + 1] = work[L.W_Y + L.Y_INPUT]
    if (brake == L.STUCK) != (brake_before == L.STUCK):
        work[L.W_EVENTS + 3] += 1.0
        if brake != L.STUCK:
            work[L.W_EVENTS + 2] = now


@kernel
def project(par: Array, work: Array, clutch: bool, brake: bool) -> None:
    """Remove the rounding from speeds that must agree, so that a stuck slip is exactly zero."""
    carrier = work[L.W_Y + L.Y_CARRIER]
    if clutch and brake:
        work[L.W_Y + L.Y_INPUT] = 0.0
        work[L.W_Y + L.Y_CARRIER] = 0.0
    elif clutch:
        work[L.W_Y + L.Y_INPUT] = carrier
    elif brake:
        work[L.W_Y + L.Y_INPUT] = (1.0 + par[L.D_RATIO]) * carrier


@kernel
def first_event(par: Array, work: Array, s: float, h: float) -> tuple[float, int]:
    """Return (fraction of the trial step, pack) of the first change of mode; pack -1 for none.

    Expects the trial step of length ``h`` in ``work``; leaves it overwritten if there is an event.
    """
    reach_c, reach_b = reach(par, work, 0, s, h), reach(par, work, 1, s, h)
    best, pack = 1.0, -1
    for k in range(2):
        share = reach_c if k == 0 else reach_b
        if share > 0.0:
            trial_step(par, work, s, share * h)
            g = guard(par, work, k, s, L.W_Y)
            fraction = share * locate(par, work, k, s, share * h, g)
            if pack < 0 or fraction < best:
                best, pack = fraction, k
    return best, pack


@kernel
def reach(par: Array, work: Array, pack: int, s: float, h: float) -> float:
    """Return a fraction of the trial step by which the mode of a pack has ended, or 0."""
    if work[np.uintp(L.W_CLUTCH_ACTIVE + pack)] == 0.0:
        return 0.0
    if guard(par, work, pack, s + h, L.W_NEW) < 0.0:
        return 1.0
    if work[np.uintp(L.W_CLUTCH_MODE + pack)] != L.STUCK:
        x = dip(par, work, pack, h)
        if x < 1.0:
            return x
    return 0.0


@kernel
def returns(par: Array, work: Array, s: float, h: float) -> bool:
    """Return True if a pack that starts slipping from zero has come back across zero after ``h``.

    Its slip then has two zeros in the trial step; a shorter one has none or, later, one.
    """
    for pack in range(2):
        slips = work[np.uintp(L.W_CLUTCH_MODE + pack)] != L.STUCK
        if slips and work[np.uintp(L.W_CLUTCH_ACTIVE + pack)] > 0.0:
            if slip_of(par, work, pack, L.W_Y) == 0.0:
                if guard(par, work, pack, s + h, L.W_NEW) < 0.0:
                    return True
    return False


@kernel
def run(par: Array, work: Array, t: float, dt: float, started: bool) -> int:
    """Carry the vector at ``work[W_Y:]`` from ``t`` to ``t + dt``; return a status.

    ``dt`` may be 0: then only the modes for the present torques are found.
    """
    s, end, h = 0.0, next_break(par, work, t, 0.0, dt), dt
    begin_stretch(par, work, t, s, end)
    clutch, brake = work[L.W_CLUTCH_MODE], work[L.W_BRAKE_MODE]
    decide(par, work, s, -1)
    if started:
        note_events(par, work, clutch, brake, t)
    events = 0
    for _ in range(MAX_TRIALS):
        if s >= dt:
            return OK
        clutch, brake = work[L.W_CLUTCH_MODE], work[L.W_BRAKE_MODE]
        h = min(h, end - s)
        ratio = trial_step(par, work, s, h)
        if not ratio <= 1.0:
            if not h > 1e-12 * dt:
                return NOT_FINITE
            h *= max(0.1, 0.9 * ratio**-0.2) if ratio < 1e30 else 0.1
            continue
        if h > LEAST_SHARE * dt and returns(par, work, s, h):
            h *= 0.25
            continue
        fraction, pack = first_event(par, work, s, h)
        if pack >= 0:
            events += 1
            if events > MAX_EVENTS:
                return NO_EVENT
            trial_step(par, work, s, fraction * h)
            s += fraction * h
        else:
            s = end if h >= end - s else s + h
            h *= min(5.0, 0.9 * max(ratio, 1e-6) ** -0.2)
        copy(work[L.W_NEW :], work[L.W_Y : L.W_NEW])
        project(par, work, clutch == L.STUCK or (pack == 0), brake == L.STUCK or (pack == 1))
        broke_away = (clutch if pack == 0 else brake) == L.STUCK
        exclude = pack if broke_away else -1
        if pack >= 0 or s >= end:
            if s >= end and s < dt:
                end = next_break(par, work, t, s, dt)
                begin_stretch(par, work, t, s, end)
                h = end - s
            if pack >= 0 or s < dt:
                decide(par, work, s, exclude)
                note_events(par, work, clutch, brake, t + s)
    return MAX_ITERATIONS


@kernel
def is_at_rest(par: Array, work: Array) -> bool:
    """Return True if both packs stick: nothing of the set can turn."""
    return (
        work[L.W_CLUTCH_MODE] == L.STUCK
        and work[L.W_BRAKE_MODE] == L.STUCK
        and slip_of(par, work, 0, L.W_Y) == 0.0
        and slip_of(par, work, 1, L.W_Y) == 0.0
    )
