"""A slip that is prescribed answers no torque; what it does in its rounding is no answer."""

import numpy as np
import pytest

from thrustwasher.tribology.holding import memory as M
from thrustwasher.tribology.holding.torque import DEAF_DIPS, dip_of, note, notice

STEP, CAPACITY = 1e-3, 50.0  # s, N m
IDENTIFIED = (M.IDENTIFIED, 0.0, 0, 0.1, True)


def memory_after(profile, answer=0.0, steps=160):
    """Let a pack slide along a profile of its slip that answers by ``answer`` [1/(kg m2)]."""
    memory, moved = np.zeros(M.N_MEMORY), 0.0
    for k in range(steps):
        slip = profile(k) + moved
        notice(IDENTIFIED, memory, slip, CAPACITY)
        dip = dip_of(IDENTIFIED, memory, CAPACITY, CAPACITY)
        torque = CAPACITY * (1.0 - max(dip, 0.0))
        note(memory, slip, STEP, torque, False, 0.0, dip >= 0.0)
        moved += answer * (CAPACITY - torque) * STEP
    return memory


@pytest.mark.parametrize("seed", [8, 35, 55, 63, 68])  # where rounding looked like an answer
def test_a_slip_that_a_host_takes_from_two_speeds_answers_nothing_by_its_rounding(seed):
    rng = np.random.default_rng(seed)
    first, other = rng.uniform(20.0, 100.0), rng.uniform(200.0, 600.0)  # rad/s
    memory = memory_after(lambda k: (other + first * (1.0 - k / 4000.0)) - other)
    assert memory[M.DIPS] == DEAF_DIPS and memory[M.AGE] == 0.0


@pytest.mark.parametrize("seed", range(3))
def test_a_faint_answer_is_one(seed):
    """The slip moves by 1e-5 of its size where the torque fails for a step."""
    first = np.random.default_rng(seed).uniform(20.0, 100.0)
    answer = 1e-5 * first / CAPACITY / STEP
    memory = memory_after(lambda k: first, answer)
    assert memory[M.AGE] == 1.0 and memory[M.INERTIA] == pytest.approx(1.0 / answer, rel=1e-3)
