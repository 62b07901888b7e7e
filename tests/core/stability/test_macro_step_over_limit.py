"""A communication step ten times as long as the coupling bears.

Hazard: a friction torque held over a step of H > 2 J/c pushes the slip further than it was, back
    and forth for ever: every part says OK, every number is finite, and the speeds look locked.
Formula: kappa = H c/J; torque fresh in each step: stable to 2, torque a step old: to 1. Smoothed
    Coulomb friction has c = T_k/w_0 at lock-up: H < 2 J w_0/T_k.
Cure: the default coupling hands over capacities, which know no c: ten times the step moves the
    heat by a quarter of a per cent. A run that hands over torques and chatters says so, with the
    step that would end it.
"""

import numpy as np
import pytest
from closed_forms.lock_up import reduced_inertia

from lab.benchmarks.failures.failure_cells import OK, SAYS, SLOW
from lab.benchmarks.failures.failure_masters import masters
from lab.macro_steps import Way, scene_of
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift.run import cosimulate


def instances(scene):
    return {n: DirectInstance(p.spec, parameters=p.parameters()) for n, p in scene.parts.items()}


def shift(step, coupling="capacity", master="gauss-seidel", stop_time=0.9):
    scene = scene_of(Way(master, coupling), step).with_options(stop_time=stop_time)
    return cosimulate(scene, instances(scene))


def turns(result):
    """Return how often the clutch's slip turns round after lock-up."""
    slip = result.signals["transmission.clutch_speed"][result.time > 0.7]
    return int(np.count_nonzero(np.diff(np.sign(slip[np.abs(slip) > 1e-3]))))


@pytest.fixture(scope="module")
def fine():
    return shift(5e-4)


@pytest.mark.parametrize("master", ["gauss-seidel", "jacobi"])
def test_capacities_in_ten_times_the_step_stay_right(fine, master):
    r, name = shift(1e-2, master=master), "transmission.clutch_heat"
    limit = 0.01 if master == "gauss-seidel" else 0.02
    assert r.signals[name][-1] == pytest.approx(fine.signals[name][-1], rel=limit)
    assert r.figures["lock_time"] == pytest.approx(fine.figures["lock_time"], abs=5e-3)
    assert turns(r) == 0 and r.signals["transmission.clutch_speed"][-1] == 0.0
    assert r.chatter == []


@pytest.mark.parametrize("master", ["gauss-seidel", "jacobi"])
def test_torques_over_the_limit_chatter_and_the_run_says_so_with_the_limit(master):
    r = shift(1e-3, "torque", master)
    assert turns(r) > 20
    said = {c.pack: c for c in r.chatter}["clutch"]
    assert said.kappa > 10.0 * said.limit and said.good_step < 1e-4
    assert said.inertia == pytest.approx(reduced_inertia(2.2, 0.25, 0.01, 8.0), rel=1e-12)


@pytest.mark.parametrize("step", [5e-3, 1e-2])
def test_torques_a_step_old_swing_slower_and_are_found_all_the_same(step):
    """Their cycle is lopsided: two steps on one side, four or five on the other."""
    r = shift(step, "torque", "jacobi", stop_time=1.5)
    assert turns(r) > 5
    assert "clutch" in {c.pack for c in r.chatter}


@pytest.mark.slow
def test_every_master_is_right_below_its_limit_and_never_silent_above_it():
    found = masters(quick=True)
    for row in found.cells:
        for hazard, cell in zip(found.hazards, row, strict=True):
            assert cell.verdict in (OK, SLOW) or (
                hazard.startswith("torque") and cell.verdict == SAYS
            )
