"""Two units that rub on one shaft: it comes to rest, then none chatters, and none drives."""

import numpy as np
import pytest

from thrustwasher.errors import Status
from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.registry import find_spec

H, INERTIA, STEPS = 1e-3, 0.03, 500  # s, kg m2
# model: name of the speed, of the torque; inputs; parameters
UNITS = {
    "clutch": (
        "speed",
        "friction_torque",
        {"load": 6000.0, "oil_temperature": 353.15},
        {"friction_law": "constant", "fidelity": "stribeck"},
    ),
    "washer": (
        "speed",
        "friction_torque",
        {"load": 300.0, "tilt": 2e-3, "oil_temperature": 363.15},
        {"fidelity": "map"},
    ),
    "losses": ("input_speed", "input_torque", {"oil_temperature": 313.15}, {}),
}


def turned(pair, ages, first, outside, steps=STEPS):
    """Return speed and torques at every step, and statuses; torques act ``ages`` steps later."""
    speed, rows, told = first, [], []
    units, waiting = [], [[0.0] * age for age in ages]
    for name in pair:
        place, torque, inputs, parameters = UNITS[name]
        unit = DirectInstance(find_spec(name), parameters=parameters)
        unit.initialize(0.0, {**inputs, place: speed})
        units.append((unit, place, torque, inputs))
    for n in range(steps):
        new, now = [], []
        for unit, place, torque, inputs in units:
            given = {**inputs, place: speed}
            unit.set_inputs([given.get(key, 0.0) for key in unit.input_names])
            unit.step(n * H, H)
            found, status = unit.get([torque, "solver_status"])
            new.append(found)
            now.append(status)
        rows.append((speed, *new))
        told.append(now)
        for queue, one in zip(waiting, new, strict=True):
            queue.append(one)
        speed += H * (outside - sum(queue.pop(0) for queue in waiting)) / INERTIA
    return np.array(rows), np.array(told)


@pytest.mark.parametrize("first", [0.0, 8.0], ids=["at rest", "through zero"])
@pytest.mark.parametrize(
    "ages",
    [(0, 0), (0, 1), *(pytest.param(x, marks=pytest.mark.slow) for x in ((1, 1), (1, 0)))],
    ids=str,
)
@pytest.mark.parametrize("other", ["washer", "losses"])
def test_a_pack_and_a_unit_that_drags_bring_their_shaft_to_rest(other, ages, first):
    """The pack holds it against an outside torque; torques act at once, or one or both late."""
    pair = ("clutch", other)
    rows, told = turned(pair, ages, first, -2.0)
    late = rows[-100:]
    assert np.abs(late[:, 0]).max() < 1e-3 and np.ptp(late[:, 1:], axis=0).max() < 1e-3
    for name, torque, status in zip(pair, rows[:, 1:].T, told.T, strict=True):
        assert (status[-100:] != Status.CHATTER).all(), name
        if name != "clutch":  # a pack that holds gives what the shaft needs
            assert (torque * rows[:, 0] >= 0.0).all(), name
