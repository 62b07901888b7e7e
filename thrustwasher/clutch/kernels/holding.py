# mypy: disable-error-code="no-any-return"
"""The torque that holds a pack in a driveline which is not ours, and the heat it makes there.

Between its two shafts a pack that sticks gives the torque which ends the slip with the step: with
inertia J and age d of the torque (``plant``), a the outside acceleration of the last step,

    a = (s_n - s_(n-1))/H_(n-1) + T_(n-1-d)/J,
    s_p = s_n + sum over the d torques still to act of H (a - T/J),
    T_n = J (a + g s_p/H),  at most the capacity,

with H the longest of the last four steps where d > 0: which one the torque will act over is not
known yet. While the plant is known badly, or the slip reverses again and again, a is filtered and
the slip ended in part (g < 1). A pack whose slip is out of a few steps' reach slides, whatever the
law says: false knowledge never drives it. Derived in docs/theory.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from . import layout as L
from .plant import N_AGES, UNSURE, doubt, identify, is_deaf, largest_answer

PATTERN = np.array([0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 0.0])  # of the dips
DIP = 0.02  # of the torque
FIRST_DIPS, DEAF_DIPS, MOST_DIPS = 20.0, 100.0, 400.0  # steps with the pattern: at least, at most
SURE = 0.02  # relative standard deviation of the inertia: no more dips
VAGUE = 0.15  # ... above it the slip is ended slowest
STEADY, CAREFUL, SLOW = 1.0, 0.5, 0.3  # share of the slip that is ended in a step
REACH = 4.0  # steps of the last slips' kind in which a slip that is to be ended must be gone
LARGE = 0.1  # of the largest slip: too much for a pack that sticks
OPEN = 0.02  # of the largest capacity: below it the pack is open, and a new engagement follows
COUNTED = 1e-3  # of the largest slip: a smaller one has no sign
SWUNG = 0.5  # of the capacity: a reversal by less is no chatter
ROW = 30.0  # steps in which three reversals are chatter
BROAD = 0.02  # of the largest slip: the slip over which an unknown plant's torque rises
NARROWED = 0.95  # of it after each step that stays within


@kernel
def age_of(par: Array, mem: Array) -> int:
    """Return how many steps late the torque acts, -1 while nobody knows."""
    if par[L.P_HOLDING] == L.GIVEN:
        return int(par[L.P_COUPLING_AGE])
    return int(mem[L.M_AGE]) - 1


@kernel
def inertia_of(par: Array, mem: Array) -> float:
    """Return the inertia that the slip sees [kg m2], 0 while nobody knows."""
    return par[L.P_COUPLING_INERTIA] if par[L.P_HOLDING] == L.GIVEN else mem[L.M_INERTIA]


@kernel
def notice(par: Array, mem: Array, slip: float, capacity: float) -> None:
    """Take in the slip [rad/s] at the start of a step: reversals, a new engagement, the plant."""
    mem[L.M_MOST_CAPACITY] = max(mem[L.M_MOST_CAPACITY], capacity)
    mem[L.M_MOST_SLIP] = max(mem[L.M_MOST_SLIP], abs(slip))
    _watch(mem, slip, capacity)
    if par[L.P_HOLDING] == L.OFF:
        return
    if mem[L.M_COUNT] == 0.0 and abs(slip) <= par[L.P_SPEED_SMOOTHING]:
        mem[L.M_STUCK] = 1.0
    if capacity < OPEN * mem[L.M_MOST_CAPACITY]:
        if mem[L.M_DIPS] > 0.0:
            doubt(mem)
        mem[L.M_DIPS] = mem[L.M_CAUTION] = 0.0
    if par[L.P_HOLDING] == L.IDENTIFIED:
        unsure = mem[L.M_AGE] == 0.0 or mem[L.M_ERROR] > UNSURE or mem[L.M_CAUTION] > 0.0
        if unsure or mem[L.M_HELD] <= 3.0 + mem[L.M_AGE]:  # what held says nothing of the plant
            identify(mem, slip)
        if mem[L.M_AGE] == 0.0 and abs(slip) < 3.0 * _broad(par, mem):
            mem[L.M_NARROWED] = 1.0 - NARROWED * (1.0 - mem[L.M_NARROWED])


@kernel
def _watch(mem: Array, slip: float, capacity: float) -> None:
    """Count reversals of the slip that the torque went along with; three in a row are chatter."""
    n = mem[L.M_COUNT]
    if n > 1.0:
        mem[L.M_SWING] = max(mem[L.M_SWING], abs(mem[L.M_TORQUE] - mem[L.M_TORQUE + 1]))
    mem[L.M_REVERSES] = 0.0
    if abs(slip) <= COUNTED * mem[L.M_MOST_SLIP]:
        return
    side = sign_of(slip)
    if side == -mem[L.M_SIGN]:
        if mem[L.M_SWING] > SWUNG * capacity:
            mem[L.M_REVERSES] = 1.0
            mem[L.M_NARROWED] = max(0.0, 2.0 * mem[L.M_NARROWED] - 1.0)
            if mem[L.M_REVERSED + 1] > 0.0 and n - mem[L.M_REVERSED + 1] < ROW:
                mem[L.M_CHATTER] = n + ROW
                mem[L.M_CAUTION] = min(1.0 - SLOW, 0.4 + 0.6 * mem[L.M_CAUTION])
                doubt(mem)
                mem[L.M_REVERSED + 1] = mem[L.M_REVERSED] = 0.0
            else:
                mem[L.M_REVERSED + 1], mem[L.M_REVERSED] = mem[L.M_REVERSED], n
        mem[L.M_SWING] = 0.0
    mem[L.M_SIGN] = side


@kernel
def chatters(mem: Array) -> bool:
    """Tell if the slip has lately reversed again and again."""
    return mem[L.M_COUNT] < mem[L.M_CHATTER]


@kernel
def _broad(par: Array, mem: Array) -> float:
    """Return the slip [rad/s] over which the torque of a pack in an unknown plant rises."""
    broad = BROAD * mem[L.M_MOST_SLIP] * (1.0 - mem[L.M_NARROWED])
    return max(par[L.P_SPEED_SMOOTHING], broad)


@kernel
def _width(par: Array, mem: Array, h: float) -> float:
    """Return the same, narrower where the slip is known to answer little."""
    width = _broad(par, mem)
    if mem[L.M_WEIGHT] > 10.0:
        move = 4.0 * largest_answer(mem) * mem[L.M_MOST_CAPACITY] * h
        width = min(width, max(par[L.P_SPEED_SMOOTHING], move))
    return width


@kernel
def _in_unknown_plant(
    par: Array, mem: Array, slip: float, h: float, dry: float, wet: float
) -> tuple[float, float, float, float]:
    """Return torque [N m], its slopes over slip, dry and wet: smooth through zero."""
    width = _width(par, mem, h)
    smooth, side = math.tanh(slip / width), sign_of(slip)
    torque = dry * smooth + side * wet
    if mem[L.M_STUCK] > 0.0 and mem[L.M_COUNT] > 0.0:
        most = 2.0 * abs(mem[L.M_TORQUE]) + DIP * (dry + wet)
        if abs(torque) > most:
            side = sign_of(torque)
            return side * most, 0.0, side * DIP, side * DIP
    return torque, dry * (1.0 - smooth) * (1.0 + smooth) / width, smooth, side


@kernel
def gain_of(par: Array, mem: Array) -> float:
    """Return the share of the slip that is ended in a step."""
    if par[L.P_HOLDING] == L.GIVEN:
        return STEADY
    gain = STEADY
    if mem[L.M_ERROR] > UNSURE:
        gain = CAREFUL if mem[L.M_ERROR] <= VAGUE else SLOW
    return min(gain, 1.0 - mem[L.M_CAUTION])


@kernel
def hold(
    par: Array, mem: Array, slip: float, h: float, dry: float, wet: float
) -> tuple[float, bool, float, float, float, float]:
    """Return the torque [N m] for a step of ``h`` [s]; if it holds; slopes; outside acceleration.

    ``dry``, ``wet``: what asperities and oil can give [N m >= 0]. The slopes are those of the
    torque over slip, dry and wet; the last number [rad/s2] is to be kept.
    """
    age, inertia, capacity = age_of(par, mem), inertia_of(par, mem), dry + wet
    if age < 0 or not h > 0.0:
        torque, by_slip, by_dry, by_wet = _in_unknown_plant(par, mem, slip, h, dry, wet)
        return torque, False, by_slip, by_dry, by_wet, mem[L.M_OUTSIDE]
    gain, outside, by_rate = gain_of(par, mem), 0.0, 0.0
    if mem[L.M_COUNT] > 0.0:
        acting = mem[np.uintp(L.M_TORQUE + age)]
        outside, by_rate = (slip - mem[L.M_SLIP]) / mem[L.M_STEP] + acting / inertia, 1.0
        if gain < STEADY and mem[L.M_FOLLOWS] > 0.0:
            outside, by_rate = mem[L.M_OUTSIDE] + gain * (outside - mem[L.M_OUTSIDE]), gain
        by_rate /= mem[L.M_STEP]
    ahead, by_ahead, longest = slip, 1.0, h
    for k in range(age):  # torques that were given and have still to act
        ahead += h * (outside - mem[np.uintp(L.M_TORQUE + age - 1 - k)] / inertia)
        by_ahead += h * by_rate
    if age > 0:
        for k in range(3):
            longest = max(longest, mem[np.uintp(L.M_STEP + k)])
    torque = inertia * (outside + gain * ahead / longest)
    most = mem[L.M_MOST_SLIP]
    drives = torque * slip < 0.0 and abs(slip) > LARGE * most
    reach = REACH * (1.0 + age) * _nearest(mem, slip) + COUNTED * most
    if (mem[L.M_HELD] == 0.0 or drives) and abs(slip) > reach:
        side = sign_of(slip)
        return side * capacity, False, 0.0, side, side, outside
    if abs(torque) < capacity:
        return torque, True, inertia * (by_rate + gain * by_ahead / longest), 0.0, 0.0, outside
    side = sign_of(torque)
    return side * capacity, False, 0.0, side, side, outside


@kernel
def _nearest(mem: Array, slip: float) -> float:
    """Return the largest change of the slip over one of the last three steps [rad/s]."""
    change = max(abs(slip - mem[L.M_SLIP]), abs(mem[L.M_SLIP] - mem[L.M_SLIP + 1]))
    return max(change, abs(mem[L.M_SLIP + 1] - mem[L.M_SLIP + 2]))


@kernel
def dip_of(par: Array, mem: Array, torque: float, capacity: float) -> float:
    """Return the share of the torque that is left out in this step, -1 where none is asked for.

    A pack that slides in a plant which is not known yet gives a little less by a fixed pattern.
    """
    if par[L.P_HOLDING] != L.IDENTIFIED or par[L.P_PROBING] == 0.0:
        return -1.0
    if abs(torque) < (1.0 - DIP) * capacity or capacity == 0.0:
        return -1.0
    dips = mem[L.M_DIPS]
    wanted = dips < FIRST_DIPS
    if mem[L.M_AGE] == 0.0:
        wanted = wanted or dips < (DEAF_DIPS if is_deaf(mem) else MOST_DIPS)
    else:
        wanted = wanted or mem[L.M_ERROR] > SURE
    return DIP * PATTERN[np.uintp(int(dips) % 10)] if wanted else -1.0


@kernel
def note(
    mem: Array, slip: float, h: float, torque: float, holds: bool, outside: float, dips: bool
) -> None:
    """Keep what was seen and given in a step."""
    for k in range(4, 0, -1):
        mem[np.uintp(L.M_TORQUE + k)] = mem[np.uintp(L.M_TORQUE + k - 1)]
    for k in range(2, 0, -1):
        mem[np.uintp(L.M_SLIP + k)] = mem[np.uintp(L.M_SLIP + k - 1)]
        mem[np.uintp(L.M_STEP + k)] = mem[np.uintp(L.M_STEP + k - 1)]
    mem[L.M_TORQUE], mem[L.M_SLIP], mem[L.M_STEP] = torque, slip, h
    mem[L.M_COUNT] += 1.0
    mem[L.M_HELD] = mem[L.M_HELD] + 1.0 if holds else 0.0
    mem[L.M_OUTSIDE] = outside
    mem[L.M_FOLLOWS] = 1.0 if mem[L.M_AGE] > 0.0 else 0.0
    if dips:
        mem[L.M_DIPS] += 1.0


@kernel
def work_done(par: Array, mem: Array, slip: float) -> float:
    """Return what the shafts did to the pack since the start [J], now that the slip is known.

    It is kept for all ages side by side, for the one that turns out to be true.
    """
    turned = 0.0
    if mem[L.M_COUNT] > 0.0:
        turned = 0.5 * (mem[L.M_SLIP] + slip) * mem[L.M_STEP]
    for d in range(N_AGES):
        mem[np.uintp(L.M_WORK + d)] += mem[np.uintp(L.M_TORQUE + d)] * turned
    return mem[np.uintp(L.M_WORK + max(age_of(par, mem), 0))]


@kernel
def work_foreseen(par: Array, mem: Array, slip: float, h: float, torque: float) -> float:
    """Return what they will do over a step of ``h`` [s] in which ``torque`` is given [J]."""
    age, inertia = age_of(par, mem), inertia_of(par, mem)
    acting = torque if age <= 0 else mem[np.uintp(L.M_TORQUE + age - 1)]
    change = 0.0
    if mem[L.M_COUNT] > 0.0:
        change = (slip - mem[L.M_SLIP]) / mem[L.M_STEP] * h
        if inertia > 0.0:
            change -= (acting - mem[np.uintp(L.M_TORQUE + max(age, 0))]) / inertia * h
    return acting * (slip + 0.5 * change) * h
