"""Losses from outside: against Newton's law for each body, in the energy book, at standstill."""

import math

import numpy as np
import pytest

from test_transmission_step import FREE, Gearbox  # isort: skip

LOST = {"input_loss": 3.0, "drum_loss": 0.7, "output_loss": 2.0, "planet_loss": 0.05}
SIMPSON = {"sun_teeth": 38, "planet_teeth": 18, "ring_teeth": 74, "arrangement": "ring-input"}


def newton(box, clutch, brake):
    """Return accelerations of driven gear and carrier and the teeth's torque, an equation per body.

    Driven gear and drum on one planet of each mesh: a planet that takes ``planet_loss`` gives its
    carrier the torque that its gears miss.
    """
    p, sign = box.params, np.sign
    r = p.ratio
    driven = p.ring_teeth if p.arrangement == "ring-input" else p.sun_teeth
    spin = driven / p.planet_teeth
    turning = sign(box["washer_speed"]) * p.planets * LOST["planet_loss"] * spin
    rows = np.array([
        [p.input_inertia, 0.0, 0.0, 1.0],
        [0.0, p.drum_inertia, 0.0, r],
        [0.0, 0.0, p.carrier_inertia, -(1.0 + r)],
        [1.0, r, -(1.0 + r), 0.0],
    ])  # fmt: skip
    load = p.load_torque * (box["output_speed"] / p.load_speed) ** 2
    right = [
        p.engine_torque - clutch - sign(box["engine_speed"]) * LOST["input_loss"] - turning,
        clutch + brake - sign(box["drum_speed"]) * LOST["drum_loss"],
        -load - sign(box["output_speed"]) * LOST["output_loss"] + turning,
        0.0,
    ]
    found = np.linalg.solve(rows, right)
    return found[0], found[2], found[3]


@pytest.mark.parametrize("arrangement", [{}, SIMPSON])
@pytest.mark.parametrize("drum", [90.0, -60.0])
def test_losses_act_on_their_bodies_as_newtons_law_has_it(arrangement, drum):
    box = Gearbox(
        engine_torque=150.0, drum_inertia=0.02, washers=0, initial_drum_speed=drum, **arrangement
    )
    box.step(0.0, clutch=60.0, brake=40.0, **LOST)
    held = -math.copysign(40.0, drum)
    _, rate, teeth = newton(box, 60.0, held)
    assert box["input_tooth_torque"] == pytest.approx(teeth, rel=1e-12)
    assert box["output_acceleration"] == pytest.approx(rate, rel=1e-11)


def test_their_heat_is_torque_times_speed_of_every_shaft():
    box = Gearbox(initial_drum_speed=90.0)
    box.step(0.0, clutch=60.0, **LOST)
    speeds = [box[f"{shaft}_speed"] for shaft in ("engine", "drum", "output")]
    heat = sum(t * abs(w) for t, w in zip(LOST.values(), speeds, strict=False))
    heat += box.params.planets * LOST["planet_loss"] * abs(box["washer_speed"])
    assert box["loss_power"] == pytest.approx(heat, rel=1e-12)


def test_power_is_the_mean_of_the_step_and_the_book_closes():
    box, heat = Gearbox(drum_inertia=0.02, sun_bearing_coefficient=0.004), 0.0
    for i in range(80):
        loss = {name: x * (1.0 + 0.01 * i) for name, x in LOST.items()}
        box.step(5e-3, brake=max(0.0, 400.0 - 10.0 * i), clutch=9.0 * i, washer=0.1, **loss)
        heat += 5e-3 * box["loss_power"]
        assert abs(box["energy_residual"]) < 1e-8 * box["engine_work"]
    assert box["loss_heat"] == pytest.approx(heat, rel=1e-12) and heat > 100.0


def test_the_sign_of_a_loss_does_not_matter_and_none_changes_nothing():
    def run(**loss):
        box = Gearbox(drum_inertia=0.02)
        for i in range(50):
            box.step(5e-3, brake=max(0.0, 400.0 - 10.0 * i), clutch=9.0 * i, **loss)
        return box.out.tolist()

    assert run(**LOST) == run(**{name: -x for name, x in LOST.items()})
    assert run() == run(**dict.fromkeys(LOST, 0.0)) == run(**dict.fromkeys(LOST, -0.0))


@pytest.mark.parametrize("start", [3.0, -3.0])
def test_losses_bring_the_shafts_to_rest_and_never_back(start):
    """However large a loss is: over steps of any length no shaft turns the other way."""
    box = Gearbox(**FREE | {"initial_engine_speed": start, "initial_drum_speed": 0.3 * start})
    before = box.step(0.0) or box["kinetic_energy"]
    for _ in range(80):
        assert box.step(0.05, input_loss=80.0, output_loss=50.0, drum_loss=20.0) == 0
        speeds = [box["engine_speed"], box["output_speed"], box["drum_speed"]]
        assert min(x * start for x in speeds) > -1e-10  # the integrator's tolerance
        assert box["kinetic_energy"] < before or before < 1e-20
        before = box["kinetic_energy"]
    assert max(map(abs, speeds)) < 1e-9


def test_an_engine_weaker_than_the_losses_does_not_start_the_set():
    box = Gearbox(**FREE | {"engine_torque": 2.0, "initial_engine_speed": 0.0})
    for _ in range(200):
        box.step(0.05, input_loss=3.0)
    creep = math.atanh(2.0 / 3.0)
    assert box["engine_speed"] == pytest.approx(creep, rel=1e-9)
