"""Steps taken back: a master that rejects one sets the state it saved before.

Hazard: what a model keeps and does not save goes on where it was: a film squeezed further, a branch
    kept, a size of substep, a warm start. The run repeated differs, by a little, and says nothing.
Formula: step(save, restore, ...) = step(...), to the last bit, whatever was done in between.
Cure: all memory of a model is one array; an instance's snapshot holds it with inputs, outputs, time
    and status.
"""

import random

import pytest

from thrustwasher.clutch import parameters as clutch_params
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.gearmesh import parameters as gearmesh_params
from thrustwasher.transmission import parameters as transmission_params
from thrustwasher.washer import parameters as washer_params

H = 2e-3
COLD = 297.15


def washer(rnd):
    return [
        rnd.choice((1.0, 300.0, 800.0, 1100.0, 3000.0)),
        rnd.uniform(-900.0, 900.0),
        rnd.choice((0.0, 1e-3, 2e-3)),
        rnd.uniform(260.0, 400.0),
    ]


def pack(rnd):
    return [rnd.choice((0.0, 50.0, 5898.0)), rnd.uniform(-300.0, 300.0), rnd.uniform(280.0, 380.0)]


def mesh(rnd):
    return [rnd.uniform(0.0, 50.0), rnd.uniform(-300.0, 400.0), rnd.uniform(280.0, 380.0)]


def gearbox(rnd):
    return [
        rnd.uniform(0.0, 400.0),
        rnd.uniform(0.0, 400.0),
        rnd.uniform(0.0, 0.5),
        rnd.uniform(0.0, 0.5),
        rnd.random(),
    ]


MODELS = {
    "washer": (washer_params.SPEC, washer, {}),
    "washer, map": (washer_params.SPEC, washer, {"fidelity": "map"}),
    "washer, storing heat": (washer_params.SPEC, washer, {"thermal_mode": "transient"}),
    "pack": (clutch_params.SPEC, pack, {}),
    "pack, looking ahead": (clutch_params.SPEC, pack, {"input_profile": "linear"}),
    "pack, rings": (clutch_params.SPEC, pack, {"fidelity": "fine"}),
    "mesh": (gearmesh_params.SPEC, mesh, {}),
    "gearbox": (transmission_params.SPEC, gearbox, {}),
    "gearbox, elastic": (
        transmission_params.SPEC,
        gearbox,
        {"shaft_stiffness": 2e4, "shaft_damping": 5.0, "vehicle_inertia": 6.0},
    ),
}


def begun(name, seed):
    spec, draw, parameters = MODELS[name]
    rnd = random.Random(seed)
    made = DirectInstance(spec, parameters=parameters)
    made.initialize(0.0, dict(zip(made.input_names, draw(rnd), strict=False)))
    return made, [draw(rnd) for _ in range(12)]


def run(made, points, first=0):
    """Return all outputs after each step."""
    shown = []
    for i, point in enumerate(points, first):
        made.set_inputs(point)
        made.step(i * H, H)
        shown.append(made.outputs())
    return shown


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.slow
def test_a_profile_gone_back_over_is_the_profile_gone_straight(name):
    made, points = begun(name, 1)
    straight = run(made, points)
    back, _ = begun(name, 1)
    again = run(back, points[:4])
    for first, ahead in ((4, 3), (7, 1), (8, 4)):
        saved = back.get_state()
        run(back, [*reversed(points)][:ahead], first)  # somewhere else altogether
        back.outputs()
        back.set_state(saved)
        stop = {4: 7, 7: 8, 8: 12}[first]
        again += run(back, points[first:stop], first)
    assert again == straight


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.slow
def test_a_state_written_to_bytes_goes_on_in_another_instance(name):
    made, points = begun(name, 2)
    run(made, points[:6])
    written = made.serialize(made.get_state())
    rest = run(made, points[6:], 6)
    other, _ = begun(name, 3)
    run(other, points[:3])
    other.set_state(other.deserialize(written))
    assert run(other, points[6:], 6) == rest


@pytest.mark.parametrize("name", ["washer, storing heat", "pack", "pack, rings", "gearbox"])
def test_memory_that_is_not_put_back_shows(name):
    """So the tests above could fail: these models cannot do without theirs."""
    made, points = begun(name, 4)
    run(made, points[:6])
    saved = made.get_state()
    straight = run(made, points[6:], 6)
    made.set_state(saved)
    made.core.state[:] = 0.0
    assert run(made, points[6:], 6) != straight
