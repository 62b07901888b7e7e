"""The plants that judge how units hold a driveline are right themselves."""

import math

import numpy as np
import pytest

from lab.benchmarks.holding.judge.plants import elastic, ideal_slips, lock_time, two_shafts
from lab.benchmarks.holding.judge.units import tells
from lab.benchmarks.holding.judge.verdict import reversals, stays

STEP = 1e-3


@pytest.mark.parametrize(("slip", "held"), [(30.0, 40.0), (-30.0, 40.0), (80.0, -55.0)])
@pytest.mark.parametrize("packs", [1, 2])  # two: in fractions of a step, each half of the capacity
def test_an_ideal_pack_locks_at_the_closed_form_time(slip: float, held: float, packs: int) -> None:
    """Coulomb friction of constant capacity stops the slip at J w / (C - held), then holds."""
    j1, j2, capacity = 0.15, 1.0, 165.0
    inertia = j1 * j2 / (j1 + j2)
    plant = two_shafts(j1, j2, 20.0 + slip, 20.0, packs)
    push = (held * j1 / inertia, 0.0)  # accelerates the slip as `held` on the inertia does
    times = STEP * np.arange(400)
    slips, torques = ideal_slips(
        plant, lambda t: push, lambda t, s: [capacity / packs] * packs, times
    )
    right = lock_time(inertia, abs(slip), capacity, held * np.sign(slip))
    found = stays(slips[:, 0], 1e-9) * STEP
    assert right <= found <= right + STEP
    assert torques[-1].sum() == pytest.approx(held)
    before = int(right / STEP)
    line = slip - before * STEP * (np.sign(slip) * capacity - held) / inertia
    assert slips[before, 0] == pytest.approx(line, abs=1e-9)


def test_a_loaded_shaft_swings_with_its_period() -> None:
    """A step with held torques is exact: after a period of hub and vehicle all is as before."""
    hub, vehicle, stiffness = 0.3, 1.0, 11e3
    period = 2 * math.pi * math.sqrt(hub * vehicle / (hub + vehicle) / stiffness)
    start = np.array([0.0, 3.0, -0.9, 0.0])  # the shaft's ends against each other, at rest in all
    plant = elastic(0.15, hub, vehicle, stiffness, 0.0, start)
    for _ in range(7):
        plant.advance((0.0, 0.0), (0.0,), period / 7)
    assert plant.state == pytest.approx(start, abs=1e-12)


def test_only_words_about_the_lock_count_as_told() -> None:
    """Reversals leave small ones out; a parameter that is not used tells nothing of the lock."""
    assert reversals(np.array([1.0, -1.0, 0.01, -0.01, 1.0]), 0.1) == 2
    assert tells("WetClutch at t = 0.1 s: CHATTER: the slip reverses again and again")
    assert not tells("coupling_age = 1 is not used: holding = identified")
