"""The step that a model would like: a property of the motion, whatever step it is asked with."""

import numpy as np
import pytest

from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.registry import find_spec

STEPS = [4e-3, 2e-3, 1e-3]
END = 0.1  # s


def asked(model, step, inputs, until=END, **parameters):
    """Return the advice at the end of a run at equal steps; ``inputs`` of time and step."""
    instance = DirectInstance(find_spec(model), parameters=parameters)
    instance.initialize(0.0, inputs(0.0, step))
    for i in range(round(until / step)):
        given = inputs(i * step, step)
        instance.set_inputs([given.get(name, 0.0) for name in instance.input_names])
        instance.step(i * step, step)
    return instance.get(["advised_step"])[0]


def pressed(rise):
    """A pack at a steady slip; its load rises by ``rise`` N/s and is that of each step's end."""
    return lambda t, h: {"load": 2000.0 + rise * (t + h), "speed": 80.0, "oil_temperature": 300.0}


BEND = 2e4  # N m/s2


def capacity(t):
    return 100.0 + BEND * t * t


def received(t, h):
    """A clutch whose capacity bends, the brake open."""
    return {"clutch_torque": capacity(t), "shift_command": 1.0}


def test_over_the_clutchs_step_the_capacity_moves_by_one_percent():
    """The film settled and the coefficient constant the capacity is in proportion to the load."""
    level = {"fidelity": "closed", "friction_temperature_slope": 0.0}
    for step in STEPS:
        found = asked("clutch", step, pressed(1e4), **level)
        assert found == pytest.approx(0.01 * (2000.0 + 1e4 * END) / 1e4, rel=1e-3)


def test_the_clutchs_advice_does_not_depend_on_the_step_it_is_asked_with():
    found = [asked("clutch", step, pressed(2e4)) for step in STEPS]
    assert np.ptp(found) < 0.1 * min(found)


@pytest.mark.parametrize("model", ["clutch", "transmission"])
def test_where_nothing_moves_the_step_may_grow_fivefold(model):
    warm = {"oil_temperature": 297.15} if model == "clutch" else {}
    assert asked(model, 1e-3, lambda t, h: warm) == pytest.approx(5e-3)


def test_the_transmissions_step_is_that_of_what_extrapolation_leaves():
    """A straight line misses a parabola by 2 BEND h^2; allowed is 1 % of the largest torque."""
    for step in STEPS:
        expected = np.sqrt(0.01 * capacity(END - step) / (2.0 * BEND))
        found = asked("transmission", step, received)
        assert found == pytest.approx(min(expected, 5.0 * step), rel=1e-6)


def test_what_is_held_asks_for_smaller_steps():
    for step in STEPS:
        moved = capacity(END - step) - capacity(END - 2.0 * step)
        expected = 0.01 * capacity(END - step) / moved * step
        found = asked("transmission", step, received, capacity_extrapolation=False)
        assert found == pytest.approx(max(expected, 0.2 * step), rel=1e-6)


@pytest.mark.slow
def test_a_washer_without_memory_wants_no_step_and_one_with_it_does():
    def loaded(t, h):
        return {"load": 300.0, "speed": 545.0, "tilt": 0.002, "oil_temperature": 297.15}

    assert asked("washer", 0.02, loaded) == 0.0
    assert 1e-3 < asked("washer", 0.02, loaded, thermal_mode="transient") < 1.0
