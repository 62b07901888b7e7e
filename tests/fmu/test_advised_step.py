"""The step that a model would like: a property of the motion, whatever step it is asked with."""

import numpy as np
import pytest

from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.registry import find_spec

STEPS = [4e-3, 2e-3, 1e-3]


def asked(model, step, inputs, until=0.1, **parameters):
    """Return the advice at a time, of a run at equal steps; ``inputs`` of (time, step)."""
    instance = DirectInstance(find_spec(model), parameters=parameters)
    instance.initialize(0.0, inputs(0.0, step))
    for i in range(round(until / step)):
        names = {**inputs(i * step, step)}
        instance.set_inputs([names.get(n, 0.0) for n in instance.input_names])
        instance.step(i * step, step)
    return instance.get(["advised_step"])[0]


def pressed(rise):
    """A pack whose load rises by ``rise`` N/s, at the end of each step, at a steady slip."""
    return lambda t, h: {"load": 2000.0 + rise * (t + h), "speed": 80.0, "oil_temperature": 300.0}


def received(t, h):
    """A clutch's capacity that bends: 100 + 2000 t^2; the brake is open."""
    return {"clutch_torque": 100.0 + 2000.0 * t * t, "shift_command": 1.0}


def test_over_the_clutchs_step_the_capacity_moves_by_one_percent():
    """A settled film and a coefficient that is constant: capacity in proportion to the load."""
    plain = {"fidelity": "stribeck", "friction_law": "constant"}
    for step in STEPS:
        found = asked("clutch", step, pressed(1e4), **plain)
        assert found == pytest.approx(0.01 * (2000.0 + 1e4 * 0.1) / 1e4, rel=1e-3)


def test_the_clutchs_advice_does_not_depend_on_the_step_it_is_asked_with():
    found = [asked("clutch", step, pressed(2e4)) for step in STEPS]
    assert np.ptp(found) < 0.1 * min(found)


@pytest.mark.parametrize("model", ["clutch", "transmission"])
def test_where_nothing_moves_the_step_may_grow_fivefold(model):
    found = asked(model, 1e-3, lambda t, h: {"oil_temperature": 297.15})
    assert found == pytest.approx(5e-3)


def test_the_transmissions_step_is_that_of_what_extrapolation_leaves():
    """A straight line carried on misses a t^2 by 2 a h^2; allowed: 1 % of the largest torque."""
    for step in STEPS:
        at = 0.1 - step
        largest = max(150.0, 100.0 + 2000.0 * at * at)
        found = asked("transmission", step, received)
        expected = np.sqrt(0.01 * largest / (2.0 * 2000.0))
        assert found == pytest.approx(expected, rel=0.01)


def test_what_is_held_asks_for_smaller_steps():
    for step in STEPS:
        expected = 0.01 * 150.0 / (2.0 * 2000.0 * 0.1)
        found = asked("transmission", step, received, capacity_extrapolation=False)
        assert found == pytest.approx(expected, rel=0.1)


@pytest.mark.slow
def test_a_washer_without_memory_wants_no_step_and_one_with_it_does():
    def loaded(t, h):
        return {"load": 300.0, "speed": 545.0, "tilt": 0.002, "oil_temperature": 297.15}

    assert asked("washer", 0.02, loaded, until=0.04) == 0.0
    assert asked("washer", 0.02, loaded, until=0.04, thermal_mode="transient") > 0.0
