"""Thrust bearings of sun and ring: against Newton's law for each body, and in the energy book."""

import math

import numpy as np
import pytest

from thrustwasher.transmission.bearings import BEARINGS, SHAFT
from thrustwasher.transmission.kernels import dynamics
from thrustwasher.transmission.kernels import layout as L

from test_transmission_step import FREE, Gearbox  # isort: skip

SIMPSON = {"sun_teeth": 38, "planet_teeth": 18, "ring_teeth": 74, "arrangement": "ring-input"}
BOTH = {"sun_bearing_coefficient": 0.004, "ring_bearing_coefficient": 0.004}


def between(name, one, other, coefficient=0.004):
    return {f"{name}_shaft_1": one, f"{name}_shaft_2": other, f"{name}_coefficient": coefficient}


def newton(box, clutch, brake, engine=150.0, load=250.0):
    """Return (tooth torque, clutch, brake) from an equation per body, solved by fixed point.

    ``clutch`` and ``brake``: torque of a slipping pack, None for one that sticks. Bodies: driven
    gear, drum, carrier; their torques in the teeth are as 1 : r : -(1 + r).
    """
    p = box.params
    r, ring_driven = p.ratio, p.arrangement == "ring-input"
    speed = {"carrier": box["output_speed"], "case": 0.0}
    bodies = ("ring", "sun", "carrier") if ring_driven else ("sun", "ring", "carrier")
    speed |= {bodies[0]: box["engine_speed"], bodies[1]: box["drum_speed"]}
    driven_teeth = p.ring_teeth if ring_driven else p.sun_teeth
    radius = 0.5 * p.normal_module * driven_teeth / math.cos(p.helix_angle)
    load = load * (box["output_speed"] / p.load_speed) ** 2
    teeth = 0.0
    for _ in range(40):
        thrust, takes = abs(teeth) * math.tan(p.helix_angle) / radius, dict.fromkeys(SHAFT, 0.0)
        for name in BEARINGS:
            one, other = (getattr(p, f"{name}_shaft_{i}") for i in (1, 2))
            rubs = getattr(p, f"{name}_coefficient") * getattr(p, f"{name}_mean_radius") * thrust
            torque = rubs * math.tanh(speed[one] - speed[other])
            takes[one] += torque
            takes[other] -= torque
        # Unknown: three accelerations, tooth torque, clutch, brake.
        rows = np.array([
            [p.input_inertia, 0.0, 0.0, 1.0, 1.0, 0.0],
            [0.0, p.drum_inertia, 0.0, r, -1.0, 1.0],
            [0.0, 0.0, p.carrier_inertia, -(1.0 + r), 0.0, 0.0],
            [1.0, r, -(1.0 + r), 0.0, 0.0, 0.0],
            [1.0, -1.0, 0.0, 0.0, 0.0, 0.0] if clutch is None else [0, 0, 0, 0, 1.0, 0],
            [0.0, 1.0, 0.0, 0.0, 0.0, 0.0] if brake is None else [0, 0, 0, 0, 0, 1.0],
        ])  # fmt: skip
        right = np.array(
            [
                engine - takes[bodies[0]],
                -takes[bodies[1]],
                -load - takes["carrier"],
                0.0,
                clutch or 0.0,
                brake or 0.0,
            ]
        )
        found = np.linalg.solve(rows, right)
        teeth = float(found[3])
    return teeth, float(found[4]), float(found[5])


@pytest.mark.parametrize("arrangement", [{}, SIMPSON])
@pytest.mark.parametrize(
    "ends", [("sun", "carrier"), ("ring", "case"), ("carrier", "ring"), ("case", "sun")]
)
@pytest.mark.parametrize("modes", ["brake sticks", "both slip", "clutch sticks"])
def test_torques_are_those_of_newtons_law_for_every_body(arrangement, ends, modes):
    """With friction 0.05 the bearings matter; the drum has an inertia of its own."""
    more = {
        "drum_inertia": 0.02,
        **between("sun_bearing", *ends, 0.05),
        **between("ring_bearing", "ring", "case", 0.05),
    }
    more["initial_drum_speed"] = {"brake sticks": 0.0, "both slip": 90.0, "clutch sticks": 350.0}[
        modes
    ]
    box = Gearbox(**arrangement | more)
    given = {"clutch": 60.0, "brake": 40.0}
    free = {"clutch": 60.0, "brake": 40.0}
    if modes != "both slip":
        pack = modes.split()[0]
        given[pack], free[pack] = 900.0, None
    box.step(0.0, **given)
    teeth, clutch, brake = newton(box, **free)
    assert box["input_tooth_torque"] == pytest.approx(teeth, rel=1e-12)
    assert box["clutch_reaction"] == pytest.approx(clutch, rel=1e-12)
    assert box["brake_reaction"] == pytest.approx(brake, rel=1e-12)


def test_a_bearing_rubs_with_the_thrust_at_its_mean_radius():
    box = Gearbox(**BOTH)
    box.step(0.0, brake=900.0)
    torque = 0.004 * box["sun_thrust"] * 0.025
    assert box["sun_bearing_torque"] == pytest.approx(torque, rel=1e-13)
    assert box["ring_bearing_torque"] == 0.0  # the drum is held, and so is the ring
    slip = box["engine_speed"] - box["output_speed"]
    assert box["bearing_power"] == pytest.approx(torque * slip, rel=1e-12)


def test_no_torque_in_the_teeth_is_passed_without_a_corner():
    """From drive to coasting: exact from 0.1 N m on, its slope continuous between."""
    box = Gearbox(**BOTH, engine_torque=0.0, load_torque=0.0)

    def at(torque):
        assert box.step(0.0, brake=900.0, engine_torque_input=torque) == 0
        return box["bearing_power"], box["input_tooth_torque"]

    ends = [at(t)[1] for t in (-1.0, 1.0)]
    none = -1.0 - 2.0 * ends[0] / (ends[1] - ends[0])  # the engine's, where the teeth bear nothing
    found = np.array([at(none + t) for t in np.linspace(-0.5, 0.5, 401)])
    power, teeth = found.T
    assert power.min() < 1e-4 * power.max() and teeth[0] < -0.15 and teeth[-1] > 0.15
    far = abs(teeth) > dynamics.LIGHT
    assert power[far] / abs(teeth[far]) == pytest.approx(power[-1] / teeth[-1], rel=1e-9)
    slopes = np.diff(power) / np.diff(teeth)
    assert abs(np.diff(slopes)).max() < 0.1 * abs(slopes).max()


def test_power_is_the_mean_of_the_step_and_heat_their_sum():
    box, heat = Gearbox(**BOTH), 0.0
    for i in range(40):
        box.step(5e-3, brake=400.0 - 10.0 * i, clutch=9.0 * i)
        heat += 5e-3 * box["bearing_power"]
        shown = box.out.copy()
        box.step(0.0, brake=400.0 - 10.0 * i, clutch=9.0 * i)
        assert box.out == pytest.approx(shown, rel=1e-12, abs=1e-9)
    assert box["bearing_heat"] == pytest.approx(heat, rel=1e-12) and heat > 1.0


def test_a_drum_that_a_bearing_turns_breaks_away_where_the_reaction_says():
    """At constant torques the stuck brake carries the teeth and the bearing on its drum."""
    box = Gearbox(
        **FREE
        | {
            "engine_torque": 150.0,
            "initial_engine_speed": 300.0,
            **between("ring_bearing", "ring", "carrier", 0.05),
        }
    )
    box.step(0.01, brake=404.0)
    reaction = abs(newton(box, 0.0, None, load=0.0)[2])
    plain = abs(box.params.ratio * box["input_tooth_torque"])
    assert abs(reaction - plain) > 0.1
    n = 0
    while box["brake_locked"]:
        n += 1
        assert n < 60 and box.step(0.01, brake=404.0 - 10.0 * n) == 0
    assert box["release_time"] == pytest.approx((404.0 - reaction) / 1000.0, rel=1e-9)


def test_a_tooth_torque_that_is_not_found_is_no_number(monkeypatch):
    """Then a step has the status NOT_FINITE, and nothing is made of it."""
    box = Gearbox(**BOTH)
    box.step(1e-3, brake=900.0)
    solve = getattr(dynamics.solve_torques, "py_func", dynamics.solve_torques)
    solve(box.par, box.work, 0.0, L.W_Y)
    assert np.isfinite(box.work[L.W_INPUT_RATE])
    monkeypatch.setattr(dynamics, "MAX_SECANTS", 1)
    solve(box.par, box.work, 0.0, L.W_Y)
    assert np.isnan(box.work[[L.W_INPUT_RATE, L.W_CARRIER_RATE]]).all()
