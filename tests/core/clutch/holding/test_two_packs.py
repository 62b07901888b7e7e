"""Two packs that both ask, on the same shafts or in two gears: both find it, and hold."""

import numpy as np
import pytest
from unit import Unit

from thrustwasher.errors import Status
from thrustwasher.tribology.holding.torque import SLOWEST

H, INERTIA = 1e-3, (0.15, 1.0)  # s, kg m2
WHOLE = INERTIA[0] * INERTIA[1] / sum(INERTIA)


class Case:
    """What a unit needs to know of a driveline."""

    def __init__(self, capacity):
        self.gain, self.loads = capacity, (1.0,)


def difference_of(age, gain):
    """Return the matrix of the difference of two packs' torques while the slip stays zero.

    State: the last three differences, and that of the outside torques that the packs see.
    """

    def after(state):
        last, outside = state[:3], state[3]
        outside = outside + gain * (last[age] - outside)
        new = outside + gain * sum(outside - last[age - 1 - k] for k in range(age))
        return [new, last[0], last[1], outside]

    return np.array([after(unit) for unit in np.eye(4)]).T


@pytest.mark.parametrize("age", [1, 2])
def test_at_the_smallest_gain_the_torques_of_two_packs_do_not_swing_against_each_other(age):
    """One root is 1, a share that stays. The others: -2 g, or with a product of 2 g + g^2."""
    roots = np.sort(np.abs(np.linalg.eigvals(difference_of(age, SLOWEST))))[::-1]
    assert abs(roots[0] - 1.0) < 1e-12
    others = {1: 2.0 * SLOWEST, 2: np.sqrt(2.0 * SLOWEST + SLOWEST**2)}
    assert abs(roots[1] - others[age]) < 1e-12 and roots[1] < 0.85
    at_once = np.abs(np.linalg.eigvals(difference_of(age, 1.0)))
    assert at_once.max() > 1.7


@pytest.mark.parametrize("age", [0, 1, 2])
@pytest.mark.parametrize("known", [False, True], ids=["identified", "given"])
@pytest.mark.parametrize("capacities", [(115.0, 65.0), (97.0, 83.0)], ids=str)
def test_two_packs_in_parallel_share_what_is_to_be_held(capacities, known, age):
    """Their sum is that of one pack, neither torque swings, and no status is told."""
    shares = [c / sum(capacities) for c in capacities]
    units = [
        Unit(Case(c), (WHOLE * share, age) if known else None)
        for c, share in zip(capacities, shares, strict=True)
    ]
    slip, waiting, rows = 200.0, [[0.0, 0.0]] * age, []
    outside = (100.0 / INERTIA[0] + 20.0 / INERTIA[1]) * WHOLE
    for n in range(1500):
        load = min(1.0, n * H / 0.1)
        torques = [unit.step(slip, H, load) for unit in units]
        waiting.append(torques)
        slip += H * (outside - sum(waiting.pop(0))) / WHOLE
        rows.append(torques)
    late = np.array(rows[-300:])
    assert np.abs(late.sum(axis=1) - outside).max() < 1e-6 * outside
    assert np.abs(np.diff(late, axis=0)).max() < 1e-6 * outside
    assert all(unit.locked for unit in units)
    assert not any(unit.told & {Status.CHATTER, Status.REFUTED} for unit in units)


@pytest.mark.parametrize("age", [0, 1, 2])
@pytest.mark.parametrize("ramp", [20, 40, 90])
def test_a_pack_that_takes_over_from_another_one_that_asked_locks(age, ramp):
    """Gear 2.8 hands over to 1.2; the first pack holds from the start, both ask."""
    engine, vehicle, low, high, torque = 0.1, 2.0, 2.8, 1.2, 90.0
    packs = Unit(Case(3.0 * torque)), Unit(Case(1.3 * torque))
    w1, w2, waiting, slips = low * 10.0, 10.0, [(0.0, 0.0)] * age, []
    for n in range(900):
        loads = max(0.0, 1.0 - max(0, n - 10) / ramp), min(1.0, max(0, n - 10) / ramp)
        seen = w1 - low * w2, w1 - high * w2
        waiting.append(
            tuple(unit.step(s, H, x) for unit, s, x in zip(packs, seen, loads, strict=True))
        )
        first, second = waiting.pop(0)
        w1 += H * (torque - first - second) / engine
        w2 += H * (low * first + high * second) / vehicle
        slips.append(seen[1])
    assert packs[1].locked and np.abs(slips[-300:]).max() < 1e-6 * max(slips)
    whole = 1.0 / (1.0 / engine + high**2 / vehicle)
    assert abs(packs[1].inertia - whole) < 0.02 * whole and packs[1].age == age
