# mypy: disable-error-code="no-any-return"
"""The torque that holds a unit between two shafts of a driveline that it does not know.

A unit that sticks gives the torque which ends the slip with the step: with
inertia J and age d of the torque (``plant``), a the outside acceleration of the last step,

    a = (s_n - s_(n-1))/H_(n-1) + T_(n-1-d)/J,
    s_p = s_n + sum over the d torques still to act of H (a - T/J),
    T_n = J (a + g s_p/H),  at most the capacity,

with H the longest of the last four steps where d > 0: which one the torque will act over is not
known yet. A host that judges its steps by the outputs may shorten them at will: H is not less than
a tenth of the longest step, so that the torque does not jump with the step.

While the driveline is known badly, or the slip reverses again and again, a is filtered and the slip
ended in part (g < 1). A unit whose slip is out of a few steps' reach slides, whatever the law says:
false knowledge never drives it. Derived in docs/theory/holding.md.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from . import memory as M
from .memory import Coupling
from .plant import UNSURE, forget, identify, is_deaf, largest_answer
from .reversals import COUNTED, SLOWEST, watch

DIP = 0.02  # of the torque, at most
LEAST_STEP = 0.1  # of the longest step: over less no slip is ended
LASTS = 0.995  # of the longest step, at each step
ROUND = 10.0  # steps after which the dips begin again
SLOW_WAVE, FAST_WAVE, SLOW_SHARE = 1.0, 3.0, 0.3  # waves in a round, what the slow one makes up
FIRST_DIPS, DEAF_DIPS, MOST_DIPS = 20.0, 100.0, 400.0  # steps with dips: at least, at most
SURE = 0.02  # relative standard deviation of the inertia: no more dips
VAGUE = 0.15  # ... above it the slip is ended slowest
STEADY, CAREFUL = 1.0, 0.5  # share of the slip that is ended in a step
REACH = 4.0  # steps of the last slips' kind in which a slip that is to be ended must be gone
LARGE = 0.1  # of the largest slip: too much for a pack that sticks
OPEN = 0.02  # of the largest capacity: below it the pack is open, and a new engagement follows
BROAD = 0.02  # of the largest slip: the slip over which an unknown plant's torque rises
NARROWED = 0.95  # of it after each step that stays within


@kernel
def age_of(coupling: Coupling, mem: Array) -> int:
    """Return how many steps late the torque acts, -1 while nobody knows."""
    mode, _, age, _, _ = coupling
    return age if mode == M.GIVEN else int(mem[M.AGE]) - 1


@kernel
def knows(coupling: Coupling, mem: Array, h: float) -> bool:
    """Tell if the driveline is known, and the step [s] that the torque is for."""
    return age_of(coupling, mem) >= 0 and h > 0.0


@kernel
def inertia_of(coupling: Coupling, mem: Array) -> float:
    """Return the inertia that the slip sees [kg m2], 0 while nobody knows."""
    mode, inertia, _, _, _ = coupling
    return inertia if mode == M.GIVEN else mem[M.INERTIA]


@kernel
def notice(coupling: Coupling, mem: Array, slip: float, capacity: float) -> None:
    """Take in the slip [rad/s] at the start of a step: reversals, a new engagement, the plant."""
    mode, _, _, smoothing, _ = coupling
    mem[M.MOST_CAPACITY] = max(mem[M.MOST_CAPACITY], capacity)
    mem[M.MOST_SLIP] = max(mem[M.MOST_SLIP], abs(slip))
    watch(mem, slip, capacity)
    if mode == M.OFF:
        return
    if mem[M.COUNT] == 0.0 and abs(slip) <= smoothing:
        mem[M.STUCK] = 1.0
    if capacity < OPEN * mem[M.MOST_CAPACITY]:
        forget(mem)
        mem[M.DIPS] = mem[M.CAUTION] = 0.0
    if mode == M.IDENTIFIED:
        unsure = mem[M.AGE] == 0.0 or mem[M.ERROR] > UNSURE or mem[M.CAUTION] > 0.0
        if unsure or mem[M.HELD] <= 3.0 + mem[M.AGE]:  # what held says nothing of the plant
            identify(mem, slip)
        if mem[M.AGE] == 0.0 and abs(slip) < 3.0 * _broad(coupling, mem):
            mem[M.NARROWED] = 1.0 - NARROWED * (1.0 - mem[M.NARROWED])


@kernel
def _broad(coupling: Coupling, mem: Array) -> float:
    """Return the slip [rad/s] over which the torque of a pack in an unknown plant rises."""
    _, _, _, smoothing, _ = coupling
    broad = BROAD * mem[M.MOST_SLIP] * (1.0 - mem[M.NARROWED])
    return max(smoothing, broad)


@kernel
def _width(coupling: Coupling, mem: Array, h: float) -> float:
    """Return the same, narrower where the slip is known to answer little."""
    _, _, _, smoothing, _ = coupling
    width = _broad(coupling, mem)
    if mem[M.WEIGHT] > 10.0:
        move = 4.0 * largest_answer(mem) * mem[M.MOST_CAPACITY] * h
        width = min(width, max(smoothing, move))
    return width


@kernel
def _in_unknown_plant(
    coupling: Coupling, mem: Array, slip: float, h: float, dry: float, wet: float
) -> tuple[float, float, float, float]:
    """Return torque [N m], its slopes over slip, dry and wet: smooth through zero."""
    width = _width(coupling, mem, h)
    smooth, side = math.tanh(slip / width), sign_of(slip)
    torque = dry * smooth + side * wet
    if mem[M.STUCK] > 0.0 and mem[M.COUNT] > 0.0:
        most = 2.0 * abs(mem[M.TORQUE]) + DIP * (dry + wet)
        if abs(torque) > most:
            side = sign_of(torque)
            return side * most, 0.0, side * DIP, side * DIP
    return torque, dry * (1.0 - smooth) * (1.0 + smooth) / width, smooth, side


@kernel
def gain_of(coupling: Coupling, mem: Array) -> float:
    """Return the share of the slip that is ended in a step."""
    mode, _, _, _, _ = coupling
    if mode == M.GIVEN:
        return STEADY
    gain = STEADY
    if mem[M.ERROR] > UNSURE:
        gain = CAREFUL if mem[M.ERROR] <= VAGUE else SLOWEST
    return min(gain, 1.0 - mem[M.CAUTION])


@kernel
def hold(
    coupling: Coupling, mem: Array, slip: float, h: float, dry: float, wet: float
) -> tuple[float, bool, float, float, float, float]:
    """Return the torque [N m] for a step of ``h`` [s]; if it holds; slopes; outside acceleration.

    ``dry``, ``wet``: what asperities and oil can give [N m >= 0]. The slopes are those of the
    torque over slip, dry and wet; the last number [rad/s2] is to be kept.
    """
    age, inertia, capacity = age_of(coupling, mem), inertia_of(coupling, mem), dry + wet
    if not knows(coupling, mem, h):
        torque, by_slip, by_dry, by_wet = _in_unknown_plant(coupling, mem, slip, h, dry, wet)
        return torque, False, by_slip, by_dry, by_wet, mem[M.OUTSIDE]
    gain, outside, by_rate = gain_of(coupling, mem), 0.0, 0.0
    if mem[M.COUNT] > 0.0:
        acting = mem[np.uintp(M.TORQUE + age)]
        outside, by_rate = (slip - mem[M.SLIP]) / mem[M.STEP] + acting / inertia, 1.0
        if gain < STEADY and mem[M.FOLLOWS] > 0.0:
            outside, by_rate = mem[M.OUTSIDE] + gain * (outside - mem[M.OUTSIDE]), gain
        by_rate /= mem[M.STEP]
    ahead, by_ahead, longest = slip, 1.0, max(h, LEAST_STEP * mem[M.LONGEST])
    for k in range(age):  # torques that were given and have still to act
        ahead += h * (outside - mem[np.uintp(M.TORQUE + age - 1 - k)] / inertia)
        by_ahead += h * by_rate
    if age > 0:
        for k in range(3):
            longest = max(longest, mem[np.uintp(M.STEP + k)])
    torque = inertia * (outside + gain * ahead / longest)
    most = mem[M.MOST_SLIP]
    drives = torque * slip < 0.0 and abs(slip) > LARGE * most
    reach = REACH * (1.0 + age) * _nearest(mem, slip) + COUNTED * most
    if (mem[M.HELD] == 0.0 or drives) and abs(slip) > reach:
        side = sign_of(slip)
        return side * capacity, False, 0.0, side, side, outside
    if abs(torque) < capacity:
        return torque, True, inertia * (by_rate + gain * by_ahead / longest), 0.0, 0.0, outside
    side = sign_of(torque)
    return side * capacity, False, 0.0, side, side, outside


@kernel
def _nearest(mem: Array, slip: float) -> float:
    """Return the largest change of the slip over one of the last three steps [rad/s]."""
    change = max(abs(slip - mem[M.SLIP]), abs(mem[M.SLIP] - mem[M.SLIP + 1]))
    return max(change, abs(mem[M.SLIP + 1] - mem[M.SLIP + 2]))


@kernel
def dip_of(coupling: Coupling, mem: Array, torque: float, capacity: float) -> float:
    """Return the share of the torque that is left out in this step, -1 where none is asked for.

    A pack that slides in a driveline which is not known gives a little less, in two waves. They
    run on with the steps' length, a step of the longest seen being one: a host that judges its
    steps by the outputs finds no jump.
    """
    mode, _, _, _, probing = coupling
    if mode != M.IDENTIFIED or not probing:
        return -1.0
    if abs(torque) < (1.0 - DIP) * capacity or capacity == 0.0:
        return -1.0
    if mem[M.DIPS] % ROUND == 0.0 and not _wants_dips(mem):
        return -1.0
    turn = 2.0 * math.pi / ROUND * mem[M.DIPS]
    slow, fast = 1.0 - math.cos(SLOW_WAVE * turn), 1.0 - math.cos(FAST_WAVE * turn)
    return 0.5 * DIP * (SLOW_SHARE * slow + (1.0 - SLOW_SHARE) * fast)


@kernel
def _wants_dips(mem: Array) -> bool:
    """Tell if dips are to go on: at first, while the driveline is not known, or not well."""
    if mem[M.DIPS] < FIRST_DIPS:
        return True
    if mem[M.AGE] == 0.0:
        return mem[M.DIPS] < (DEAF_DIPS if is_deaf(mem) else MOST_DIPS)
    return mem[M.ERROR] > SURE


@kernel
def _go_on(mem: Array, h: float) -> None:
    """Count a step with dips, a short one in part; a round ends where none are wanted."""
    now = mem[M.DIPS]
    after = now + min(1.0, h / mem[M.LONGEST])
    end = ROUND * (math.floor(now / ROUND) + 1.0)
    mem[M.DIPS] = after
    if after >= end - 1e-9 and not (_wants_dips(mem) and after > end):
        mem[M.DIPS] = end


@kernel
def note(
    mem: Array, slip: float, h: float, torque: float, holds: bool, outside: float, dips: bool
) -> None:
    """Keep what was seen and given in a step."""
    for k in range(4, 0, -1):
        mem[np.uintp(M.TORQUE + k)] = mem[np.uintp(M.TORQUE + k - 1)]
    for k in range(2, 0, -1):
        mem[np.uintp(M.SLIP + k)] = mem[np.uintp(M.SLIP + k - 1)]
        mem[np.uintp(M.STEP + k)] = mem[np.uintp(M.STEP + k - 1)]
    mem[M.TORQUE], mem[M.SLIP], mem[M.STEP] = torque, slip, h
    mem[M.COUNT] += 1.0
    mem[M.CLOSED] += 1.0
    mem[M.HELD] = mem[M.HELD] + 1.0 if holds else 0.0
    mem[M.OUTSIDE] = outside
    mem[M.FOLLOWS] = 1.0 if mem[M.AGE] > 0.0 else 0.0
    mem[M.LONGEST] = max(LASTS * mem[M.LONGEST], h)
    if dips:
        _go_on(mem, h)
