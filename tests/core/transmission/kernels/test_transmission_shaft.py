"""The elastic output shaft: closed forms of a two-mass oscillator, energy, and the rigid limit."""

import math

import pytest

from test_transmission_step import FREE, Gearbox  # isort: skip

import numpy as np

SHAFT = {
    "carrier_inertia": 0.4,
    "vehicle_inertia": 8.0,
    "shaft_stiffness": 2000.0,
    "shaft_damping": 1.5,
}


def free_twist(inertia, t, start=0.02):
    """Return twist, its rate and the frequency of two inertias on the shaft, released at rest."""
    per = 1.0 / inertia + 1.0 / SHAFT["vehicle_inertia"]
    decay = 0.5 * SHAFT["shaft_damping"] * per
    frequency = math.sqrt(SHAFT["shaft_stiffness"] * per - decay**2)
    fade, angle = start * math.exp(-decay * t), frequency * t
    twist = fade * (math.cos(angle) + decay / frequency * math.sin(angle))
    rate = -fade * (frequency + decay**2 / frequency) * math.sin(angle)
    return twist, rate, frequency, decay


CASES = {  # packs that hold, and the inertia before the shaft (ring inertia 0.05, ratio 2.2)
    "brake holds": ({"brake": 1e4}, 0.4 + 3.2**2 * 0.25),
    "clutch holds": ({"clutch": 1e4}, 0.4 + 0.25 + 0.05),
    "both hold": ({"clutch": 1e4, "brake": 1e4}, math.inf),
    "both open": ({}, 0.4 + 3.2**2 / (2.2**2 / 0.05 + 1 / 0.25)),
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("step", [1e-3, 0.05])
def test_two_inertias_on_the_shaft_swing_as_the_closed_form_says(case, step):
    held, inertia = CASES[case]
    box = Gearbox(**FREE | SHAFT, drum_inertia=0.05, initial_engine_speed=0.0, initial_twist=0.02)
    while box.time < 0.3:
        assert box.step(step, **held) == 0
        twist, rate, *_ = free_twist(inertia, box.time)
        assert box["shaft_twist"] == pytest.approx(twist, abs=1e-10)
        torque = SHAFT["shaft_stiffness"] * twist + SHAFT["shaft_damping"] * rate
        assert box["shaft_torque"] == pytest.approx(torque, abs=1e-6)
        assert box["output_speed"] - box["vehicle_speed"] == pytest.approx(rate, abs=1e-8)


def test_what_the_spring_loses_the_damper_and_the_motion_take():
    box = Gearbox(**FREE | SHAFT, drum_inertia=0.01, initial_engine_speed=0.0, initial_twist=0.1)
    spring = 0.5 * SHAFT["shaft_stiffness"] * 0.1**2
    last = 0.0
    for _ in range(1200):
        box.step(0.01, brake=1e4)
        assert box["shaft_heat"] > last
        last = box["shaft_heat"]
        left = 0.5 * SHAFT["shaft_stiffness"] * box["shaft_twist"] ** 2
        assert box["shaft_energy"] == pytest.approx(left - spring, abs=1e-12)
        assert abs(box["energy_residual"]) < 1e-8 * spring
    assert box["shaft_heat"] == pytest.approx(spring, rel=1e-3)


def shift(**params):
    """Return a gearbox after a shift: brake open, clutch locking, load on the vehicle."""
    box = Gearbox(drum_inertia=0.01, washers=8, **params)
    for i in range(300):
        assert (
            box.step(
                5e-3,
                clutch=350.0 if i > 20 else 0.0,
                brake=380.0 if i <= 20 else 0.0,
                washer=0.03,
                mesh=0.2,
            )
            == 0
        )
    return box


def test_a_very_stiff_shaft_is_a_rigid_one():
    rigid = shift(carrier_inertia=8.4)
    known = ("lock_time", "lock_speed", "clutch_heat", "engine_work", "vehicle_speed")
    errors = []
    for stiffness in (2e4, 2e6):
        box = shift(**SHAFT | {"shaft_stiffness": stiffness, "shaft_damping": stiffness * 1e-3})
        errors.append(max(abs(box[n] / rigid[n] - 1.0) for n in known))
    assert errors[0] < 0.02 and errors[1] < errors[0] / 50.0


def test_a_rigid_shaft_hands_the_load_on_and_takes_nothing():
    box = shift()
    assert box["vehicle_speed"] == box["output_speed"] > 0.0
    assert box["shaft_torque"] == box["resistance_torque"] > 0.0
    assert box["shaft_twist"] == box["shaft_heat"] == box["shaft_energy"] == 0.0


def test_the_vehicle_meets_the_load():
    box = shift(**SHAFT)
    assert box["vehicle_speed"] != box["output_speed"]
    load = 250.0 * (box["vehicle_speed"] / 100.0) ** 2
    assert box["resistance_torque"] == pytest.approx(load, rel=1e-13)


def test_a_winding_shaft_breaks_a_stuck_clutch_away_and_lets_it_lock_again():
    """The twist swings the torque in the locked clutch above its capacity and back, each period."""
    box = Gearbox(
        **FREE | SHAFT | {"shaft_damping": 0.0},
        drum_inertia=0.0,
        initial_engine_speed=100.0,
        initial_drum_speed=100.0,
        initial_twist=0.15,
    )
    for _ in range(4000):
        assert box.step(1e-3, clutch=75.0) == 0
    assert box["events"] >= 4.0
    assert box["clutch_heat"] > 0.0
    assert abs(box["energy_residual"]) < 1e-6 * box["clutch_heat"]
    # It ends where the swing needs no more than the clutch holds.
    share = 0.25 / (0.25 + 0.4) * 2.2 / 3.2
    assert abs(box["shaft_torque"]) * share < 75.0 and box["clutch_locked"] == 1.0


def test_events_on_the_shaft_do_not_depend_on_the_communication_step():
    ends = []
    for n in (40, 400):
        box = Gearbox(
            **FREE | SHAFT,
            drum_inertia=0.01,
            initial_engine_speed=101.0,
            initial_drum_speed=100.0,
            initial_twist=0.15,
        )
        for _ in range(n):
            assert box.step(0.4 / n, clutch=60.0) == 0
        ends.append([box[name] for name in ("lock_time", "events", "shaft_twist", "clutch_heat")])
    assert ends[0] == pytest.approx(ends[1], rel=1e-8) and ends[0][1] >= 2.0


# Losses from outside: against Newton's law for each body, in the energy book, at standstill.

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
