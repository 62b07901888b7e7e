# mypy: disable-error-code="no-any-return"
"""The heat of a unit between two shafts: the work that they do to it.

While nobody knows when a torque acts it is the power that the torque had where it was given
(trapezoidal rule), less what a driveline makes of the delay: a torque that acts d steps late misses
sum (C_k - C_(k-d)) |s_k| H. It is the capacity's, so the swings of a slip through zero lessen
nothing, at most two steps of the largest capacity at the largest slip, and half of the heat. Where
no driveline answers nothing is late. Once the age is known a difference is owed, and paid by heat
to come: heat never falls. Negative work is a debt that positive work pays first.

The torque of the initialization may have acted over the first steps, or not: their slip tells.
"""

import numpy as np

from ...numerics.jit import Array, kernel
from ...numerics.smoothing import sign_of
from . import memory as M
from .asking import N_AGES

MOST_LATE = 0.5  # of the heat: what a late torque has not made yet, at most


@kernel
def _due(mem: Array, given: float, missed: float) -> float:
    """Return the heat that is due while the age is unknown [J].

    ``given``: by the power where it was given; ``missed``: of it, if the torque acts late.
    """
    if mem[M.ALONE] > 0.0 or mem[M.COUNT] <= 1.0:
        return given
    most = (N_AGES - 1) * mem[M.LONGEST] * mem[M.MOST_CAPACITY] * mem[M.MOST_SLIP]
    return given - max(0.0, min(missed, min(most, MOST_LATE * given)))


@kernel
def _count_late(mem: Array, slip: float) -> float:
    """Count what a late torque missed in the step that ended; return the most of any age [J]."""
    turned = 0.5 * (abs(mem[M.SLIP]) + abs(slip)) * mem[M.STEP]
    span, acting, most = 0.5 * (mem[M.STEP] + mem[M.STEP + 1]), mem[M.CAPACITY], 0.0
    for k in range(N_AGES):
        late = mem[M.CAPACITY] * abs(mem[M.SLIP]) * span - acting * turned
        mem[np.uintp(M.LATE + k)] = 0.0 if mem[M.ALONE] > 0.0 else mem[np.uintp(M.LATE + k)] + late
        most = max(most, mem[np.uintp(M.LATE + k)])
        acting = mem[np.uintp(M.BEFORE + min(k, N_AGES - 2))]
    return most


@kernel
def _latest(mem: Array) -> float:
    """Return the torque that acted in the last step at the age that missed most [N m]."""
    acting, found, most = mem[M.CAPACITY], 0.0, 0.0
    for k in range(N_AGES):
        if mem[np.uintp(M.LATE + k)] > most:
            most, found = mem[np.uintp(M.LATE + k)], acting
        acting = mem[np.uintp(M.BEFORE + min(k, N_AGES - 2))]
    return found * sign_of(mem[M.SLIP])


@kernel
def _note_first(mem: Array, slip: float) -> None:
    """Note rates and turns of the first three steps; the torque that was given before them."""
    n = int(mem[M.COUNT])
    if n == 1:
        mem[M.FIRST] = sign_of(mem[M.SLIP]) * mem[M.CAPACITY]
        mem[M.FIRST + 1] = mem[M.TORQUE]
    mem[np.uintp(M.FIRST + 1 + n)] = (slip - mem[M.SLIP]) / mem[M.STEP]
    mem[np.uintp(M.FIRST + 4 + n)] = 0.5 * (mem[M.SLIP] + slip) * mem[M.STEP]


@kernel
def _before_the_start(mem: Array, age: int, inertia: float) -> None:
    """Count the torque of the initialization where the slip of the first steps says it acted."""
    first = mem[M.FIRST]
    mem[M.FIRST] = 0.0
    for k in range(age):  # step k, over which the torque of step k - age acts
        rates = mem[np.uintp(M.FIRST + 2 + k)] - mem[np.uintp(M.FIRST + 2 + age)]
        acted = mem[M.FIRST + 1] - inertia * rates
        if abs(acted - first) < abs(acted):
            made = first * mem[np.uintp(M.FIRST + 5 + k)]
            mem[np.uintp(M.WORK + age)] += made
            mem[M.WORK + N_AGES + 1] += made
            mem[M.OWED] -= made


@kernel
def _of_age(mem: Array, at: int, age: float) -> float:
    """Return what lies at ``at`` for each age, between two of them in proportion."""
    d = int(age)
    of_age = mem[np.uintp(at + d)]
    if age > d:
        of_age += (age - d) * (mem[np.uintp(at + d + 1)] - of_age)
    return of_age


@kernel
def book(mem: Array, slip: float, age: float, inertia: float) -> None:
    """Book the step that ended at ``slip`` [rad/s]; ``age`` of the torque, -1 if not known.

    ``inertia`` [kg m2]: the one that was known last, 0 if none was.
    """
    mem[M.HEAT_INERTIA], mem[M.RISES] = inertia, 0.0
    if mem[M.COUNT] == 0.0:
        return
    if age != mem[M.HEAT_AGE] - 1.0:
        if age >= 0.0:
            mem[M.OWED] += mem[M.WORK + N_AGES + 1] - _of_age(mem, M.WORK, age)
            mem[M.WORK + N_AGES + 1] = _of_age(mem, M.WORK, age)
        mem[M.HEAT_AGE] = age + 1.0
    turned = 0.5 * (mem[M.SLIP] + slip) * mem[M.STEP]
    for k in range(N_AGES):
        mem[np.uintp(M.WORK + k)] += mem[np.uintp(M.TORQUE + k)] * turned
    if mem[M.COUNT] <= 3.0:
        _note_first(mem, slip)
    elif age > 0.0 and mem[M.FIRST] != 0.0:
        _before_the_start(mem, int(age), inertia)
    power = mem[M.TORQUE] * mem[M.SLIP]
    mem[M.WORK + N_AGES] += 0.5 * (mem[M.STEP] + mem[M.STEP + 1]) * power
    missed = _count_late(mem, slip)
    if age >= 0.0:
        made = _of_age(mem, M.TORQUE, age) * turned
    else:
        due = _due(mem, mem[M.WORK + N_AGES], missed)
        made = max(0.0, due - mem[M.WORK + N_AGES + 1])
        if abs(mem[M.WORK + N_AGES] - due - missed) <= 1e-9 * missed:
            mem[M.RISES] = _latest(mem)
    mem[M.WORK + N_AGES + 1] += made
    paid = min(max(made, 0.0), mem[M.DEBT])
    mem[M.DEBT] += max(-made, 0.0) - paid
    rest = max(made, 0.0) - paid - mem[M.OWED]
    mem[M.HEAT] += max(rest, 0.0)
    if age >= 0.0:
        mem[M.RISES] = _of_age(mem, M.TORQUE, age)
    if rest <= 0.0:
        mem[M.RISES] = 0.0
    mem[M.OWED] = max(-rest, 0.0)


@kernel
def foreseen(mem: Array, slip: float, h: float, torque: float) -> float:
    """Return the heat of a step of ``h`` [s] in which ``torque`` is given [J >= 0]."""
    age, inertia = int(mem[M.HEAT_AGE]) - 1, mem[M.HEAT_INERTIA]
    acting = torque if age <= 0 else mem[np.uintp(M.TORQUE + age - 1)]
    change = 0.0
    if mem[M.COUNT] > 0.0:
        change = (slip - mem[M.SLIP]) / mem[M.STEP] * h
        if inertia > 0.0 and age >= 0:
            change -= (acting - mem[np.uintp(M.TORQUE + age)]) / inertia * h
    change = min(abs(slip), max(-abs(slip), change))  # a short step says little of a long one
    made = max(acting * (slip + 0.5 * change) * h, 0.0)
    if age < 0 and mem[M.COUNT] > 0.0:
        made = _foreseen_due(mem, slip, h, torque, made) - mem[M.WORK + N_AGES + 1]
    return max(made - mem[M.DEBT] - mem[M.OWED], 0.0)


@kernel
def _foreseen_due(mem: Array, slip: float, h: float, torque: float, made: float) -> float:
    """Return what is due after that step while the age is unknown, ``made`` in it [J]."""
    size, late, most = abs(slip), mem[M.STEP] * 0.5, 0.0  # half of the last step is not booked yet
    acting = abs(torque)
    for k in range(N_AGES):
        missed = (late + h) * abs(torque) * size - acting * size * h
        most = max(most, mem[np.uintp(M.LATE + k)] + missed)
        acting = mem[M.CAPACITY] if k == 0 else mem[M.BEFORE]
    given = mem[M.WORK + N_AGES] + late * max(torque * slip, 0.0) + made
    return _due(mem, given, most)
