# mypy: disable-error-code="no-any-return"
"""What driveline a unit sits in, found from the slip that answers its torque.

The slip of a unit between two shafts obeys ds/dt = a - T/J: J is the inertia that the slip sees,
J1 J2/(J1 + J2) of two shafts, a what all other torques do to it. The torque given in step n acts d
steps later: at once where a host passes fresh values, a step late where it passes old ones. Both
are told by second differences, which smooth outside torques hardly touch:

    y = D2[(s_n - s_(n-1))/H_(n-1)],  x_d = -D2[T_(n-1-d)],  y = x_d/J for the true d.

1/J comes by least squares for d = 0, 1, 2 side by side. A sample counts where the torque moves at
all, and is forgotten only by others. No sample counts more than one of a tenth of the capacity: a
larger jump of the torque tends to come with one of the outside torque. Derived in
docs/theory/holding.md.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from . import memory as M

N_AGES = 3
EXCITED = 0.004  # of the largest capacity: smaller changes of the torque say nothing
LEVER = 0.1  # of the largest capacity: larger changes count as this
KEPT = 0.97  # of what was known, at each new sample
ENOUGH, MANY = 2.5, 20.0  # weight of the samples to judge by; from which on less contrast will do
CONTRAST, CONTRAST_OF_MANY = 0.25, 0.5  # squares left at the best age over those at the next one
EXPLAINED = 0.5  # squares left at the best age over all
FAINT = 1e-6  # of the largest slip: a step that moves it by less is not that of a plant
ROUNDING = 1e-12  # of the largest slip: a host that takes it from two speeds rounds it by less
UNSURE = 0.03  # relative standard deviation of the inertia
SEEN = 4.0  # steps that a sample is made of
STRANGE = 0.2  # of what the capacity does to the slip: more that is not explained is a new plant
CHANGED = 0.05  # of what was known stays where the plant may be another one
DEAF = 0.1  # squares explained over all: below it the slip does not answer


@kernel
def _second_difference(mem: Array, at: int) -> float:
    """Return that of the torque whose last value lies at ``at``."""
    return mem[np.uintp(at)] - 2.0 * mem[np.uintp(at + 1)] + mem[np.uintp(at + 2)]


@kernel
def _left(mem: Array, d: int) -> float:
    """Return the squares that the age ``d`` does not explain."""
    xx, xy = mem[np.uintp(M.XX + d)], mem[np.uintp(M.XY + d)]
    left = mem[M.YY]
    if xx > 0.0 and xy > 0.0:
        left -= xy * xy / xx
    return max(left, 1e-13 * mem[M.YY])


@kernel
def doubt(mem: Array) -> None:
    """Forget most of what was identified: the plant may be another one. It holds until then."""
    for i in range(2 * N_AGES + 1):
        mem[np.uintp(M.XX + i)] *= CHANGED
    mem[M.WEIGHT] *= 0.5
    if mem[M.AGE] > 0.0:
        mem[M.ERROR] = max(mem[M.ERROR], 1.3 * UNSURE)


@kernel
def forget(mem: Array) -> None:
    """Forget the samples: a new engagement follows, perhaps in another driveline."""
    doubt(mem)
    for i in range(2 * N_AGES + 1):
        mem[np.uintp(M.XX + i)] = 0.0
    mem[M.WEIGHT] = mem[M.CLOSED] = 0.0


@kernel
def is_deaf(mem: Array) -> bool:
    """Tell if the slip does not answer the torque at any age, as one that is prescribed."""
    for d in range(N_AGES):
        xx, xy = mem[np.uintp(M.XX + d)], mem[np.uintp(M.XY + d)]
        if xx > 0.0 and xy > 0.0 and xy * xy > DEAF * mem[M.YY] * xx:
            return False
    return True


@kernel
def largest_answer(mem: Array) -> float:
    """Return the largest 1/J [1/(kg m2)] that the samples do not exclude."""
    most = 0.0
    for d in range(N_AGES):
        xx = mem[np.uintp(M.XX + d)]
        if xx > 0.0:
            spread = math.sqrt(mem[M.YY] / xx / mem[M.WEIGHT])
            most = max(most, mem[np.uintp(M.XY + d)] / xx + 2.0 * spread)
    return most


@kernel
def identify(mem: Array, slip: float) -> None:
    """Learn from the slip [rad/s] at the start of a step; age, inertia and error go to ``mem``."""
    if mem[M.CLOSED] < SEEN:
        return
    rate_1 = (mem[M.SLIP] - mem[M.SLIP + 1]) / mem[M.STEP + 1]
    rate_2 = (mem[M.SLIP + 1] - mem[M.SLIP + 2]) / mem[M.STEP + 2]
    y = (slip - mem[M.SLIP]) / mem[M.STEP] - 2.0 * rate_1 + rate_2
    most, unit = 0.0, mem[M.MOST_CAPACITY]
    for d in range(N_AGES):
        most = max(most, abs(_second_difference(mem, M.TORQUE + d)))
    if mem[M.AGE] > 0.0 and mem[M.ERROR] < UNSURE:
        known = _second_difference(mem, M.TORQUE + int(mem[M.AGE]) - 1)
        strange = abs(y + known / mem[M.INERTIA])
        if strange > STRANGE * unit / mem[M.INERTIA] and strange > 0.3 * abs(y):
            doubt(mem)
            mem[M.DIPS] = 0.0
            return
    if not most > EXCITED * unit:
        return
    scale = min(1.0, LEVER * unit / most)
    if abs(y) * mem[M.STEP] < ROUNDING * mem[M.MOST_SLIP]:  # rounding answers no torque
        y = 0.0
    y *= scale
    for d in range(N_AGES):
        x = -scale * _second_difference(mem, M.TORQUE + d)
        mem[np.uintp(M.XX + d)] = KEPT * mem[np.uintp(M.XX + d)] + x * x
        mem[np.uintp(M.XY + d)] = KEPT * mem[np.uintp(M.XY + d)] + x * y
    mem[M.YY] = KEPT * mem[M.YY] + y * y
    mem[M.WEIGHT] = KEPT * mem[M.WEIGHT] + 1.0
    if mem[M.WEIGHT] >= ENOUGH:
        _decide(mem)


@kernel
def _decide(mem: Array) -> None:
    """Take over the age that explains the slip best, if it does so clearly, and its inertia."""
    best, second, age = 1e300, 1e300, 0
    for d in range(N_AGES):
        left = _left(mem, d)
        if left < best:
            best, second, age = left, best, d
        elif left < second:
            second = left
    xx, xy = mem[np.uintp(M.XX + age)], mem[np.uintp(M.XY + age)]
    contrast = CONTRAST if mem[M.WEIGHT] < MANY else CONTRAST_OF_MANY
    if not (xy > 0.0 and best < contrast * second and best < EXPLAINED * mem[M.YY]):
        return
    answer = xy / xx
    if not answer * mem[M.MOST_CAPACITY] * mem[M.STEP] > FAINT * mem[M.MOST_SLIP]:
        return
    if not 0.0 < 1.0 / answer < 1e300:
        return
    mem[M.AGE], mem[M.INERTIA] = float(age + 1), 1.0 / answer
    mem[M.ERROR] = math.sqrt(best / max(mem[M.WEIGHT] - 1.0, 0.5) / xx) / answer
