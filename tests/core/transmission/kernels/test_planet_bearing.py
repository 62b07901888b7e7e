"""A planet on its needles: limits, equilibrium and what is left to the washers."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize

from thrustwasher.transmission.kernels import layout as L

from test_transmission_step import Gearbox  # isort: skip
from dataclasses import replace

from thrustwasher.errors import ParameterError
from thrustwasher.transmission.bearings import BEARINGS, SHAFT
from thrustwasher.transmission.kernels import dynamics
from thrustwasher.transmission.parameters import TransmissionParams

from test_transmission_step import FREE  # isort: skip


SIMPSON = {"sun_teeth": 38, "planet_teeth": 18, "ring_teeth": 74, "arrangement": "ring-input"}
NEEDLES = {"needle_count": 18, "engine_torque": 250.0, "initial_engine_speed": 360.0}


def first_gear(**params):
    box = Gearbox(**SIMPSON | NEEDLES | params)
    assert box.step(0.0, brake=1e5) == 0
    return box


def place(box):
    """Return shift along tangent and radius [m], tilt in the planes of both [rad]."""
    z = box.work[L.W_SETTLED : L.W_SETTLED + 4].copy()
    z[2:] /= 0.5 * box.params.needle_length
    return z


def carried(p, z):
    """Return forces [N] and couples [N m] of the needles, needle by needle and slice by slice."""
    mm = 1e3 * p.needle_length
    total = np.zeros(4)
    for j in range(p.needle_count):
        angle = 2.0 * math.pi * j / p.needle_count
        direction = np.array([math.cos(angle), math.sin(angle)])
        for k in range(p.needle_slices):
            height = ((k + 0.5) / p.needle_slices - 0.5) * p.needle_length
            delta = direction @ (z[:2] + z[2:] * height) - p.needle_clearance
            if delta > 0.0:
                line = (1e3 * delta / (3.84e-5 * mm**0.1)) ** (1.0 / 0.9)  # N/mm
                force = line * mm / p.needle_slices * direction
                total += np.concatenate((force, force * height))
    return total


def centrifugal(box):
    p = box.params
    centre = 0.5 * p.normal_module / math.cos(p.helix_angle) * (p.sun_teeth + p.planet_teeth)
    return p.planet_mass * centre * box["output_speed"] ** 2


def test_needles_hold_both_tooth_forces_the_centrifugal_force_and_the_couple():
    box = first_gear(planet_mass=0.5)
    expected = [2.0 * box["tooth_force"], centrifugal(box), 0.0, box["tilting_couple"]]
    found = carried(box.params, place(box))
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-9 * expected[0])
    assert box["washer_load"] == 1.0


def test_no_couple_no_tilt():
    box = first_gear(helix_angle=0.0)
    assert box["washer_tilt"] < 1e-15 and box["washer_load"] == 1.0


def test_without_tilt_the_number_of_slices_does_not_matter():
    one, many = (first_gear(helix_angle=0.0, needle_slices=n) for n in (1, 37))
    assert place(one)[:2] == pytest.approx(place(many)[:2], rel=1e-12)


def test_one_slice_has_no_moment_so_that_the_washers_take_the_couple():
    box = first_gear(needle_slices=1)
    couple = box["tilting_couple"] / (2.0 * box.params.washer_radius)
    assert box["washer_load"] == pytest.approx(couple, rel=1e-9)


def test_many_slices_find_the_tilt_of_a_line_contact():
    tilts = [first_gear(needle_slices=n)["washer_tilt"] for n in (6, 12, 24, 48)]
    gaps = np.abs(np.diff(tilts))
    assert gaps[2] < 0.5 * gaps[1] < 0.25 * gaps[0] and gaps[2] < 1e-2 * tilts[-1]


def test_all_needles_pressed_the_moment_is_nearly_that_of_the_linear_law():
    """k L^3/12 per length in the plane of the couple: Palmgren's law is almost linear."""
    box = first_gear(needle_clearance=0.0, planet_mass=0.0, needle_slices=50, helix_angle=0.02)
    p, z = box.params, place(box)
    angles = 2.0 * np.pi * np.arange(18) / 18
    delta = np.maximum(z[0] * np.cos(angles), 0.0)
    scale = (1e3 / (3.84e-5 * (1e3 * p.needle_length) ** 0.1)) ** (1.0 / 0.9) * 1e3
    stiff = np.sum(scale * delta ** (1.0 / 0.9 - 1.0) / 0.9 * np.sin(angles) ** 2)
    moment = stiff * p.needle_length**3 / 12.0 * z[3]
    assert moment == pytest.approx(box["tilting_couple"], rel=2e-2)


def test_washers_bear_from_the_tilt_on_at_which_they_touch():
    free = first_gear()
    touch = free["washer_tilt"] * 2.0 * free.params.washer_outer_radius
    assert first_gear(end_play=1.001 * touch)["washer_load"] == 1.0
    box = first_gear(end_play=0.5 * touch)
    assert box["washer_tilt"] == pytest.approx(0.5 * free["washer_tilt"], rel=1e-3)
    z = place(box)
    left = box["tilting_couple"] - carried(box.params, z)[3]
    share = math.hypot(*z[2:]) / z[3]  # washers push back along the tilt
    expected = left * share / (2.0 * box.params.washer_radius)
    assert box["washer_load"] == pytest.approx(expected, rel=1e-6) and expected > 50.0


def test_the_place_is_that_of_least_energy():
    """By a method that knows no derivative, from another start."""
    box = first_gear(planet_mass=2.0, needle_slices=4)
    p, found = box.params, place(box)
    loads = np.array([2.0 * box["tooth_force"], centrifugal(box), 0.0, box["tilting_couple"]])
    scale = np.array([1e-5, 1e-5, 1e-3, 1e-3])
    mm = 1e3 * p.needle_length
    angles = 2.0 * np.pi * np.arange(p.needle_count) / p.needle_count
    height = ((np.arange(4) + 0.5) / 4 - 0.5) * p.needle_length

    def energy(x):
        z = x * scale
        shift = z[:2, None] + z[2:, None] * height
        delta = np.cos(angles)[:, None] * shift[0] + np.sin(angles)[:, None] * shift[1]
        delta = np.maximum(delta - p.needle_clearance, 0.0)
        line = (1e3 / (3.84e-5 * mm**0.1)) ** (1.0 / 0.9) * mm / 4.0
        return np.sum(line * delta ** (1.0 + 1.0 / 0.9)) / (1.0 + 1.0 / 0.9) - loads @ z

    best = minimize(
        energy,
        [1.0, 0.1, 0.0, 0.5],
        method="Nelder-Mead",
        options={"xatol": 1e-7, "fatol": 1e-12, "maxiter": 4000},
    )
    assert best.x * scale == pytest.approx(found, rel=1e-3, abs=1e-3 * abs(found[3]))


def test_it_settles_whatever_bearing_and_load():
    rng = np.random.default_rng(3)
    for _ in range(300):
        box = Gearbox(
            **SIMPSON,
            needle_count=int(rng.integers(3, 101)),
            needle_length=10.0 ** rng.uniform(-2.9, -1.0),
            needle_clearance=float(rng.choice([0.0, 10.0 ** rng.uniform(-7.0, -3.1)])),
            needle_slices=int(rng.integers(1, 30)),
            planet_mass=float(rng.choice([0.0, 0.1, 5.0])),
            end_play=float(rng.choice([0.0, 10.0 ** rng.uniform(-7.0, -2.0)])),
            engine_torque=float(rng.choice([0.0, 1.0, 10.0 ** rng.uniform(-3.0, 4.5)])),
            helix_angle=float(rng.choice([0.0, 0.2, 0.6])),
            initial_engine_speed=float(rng.choice([0.0, 100.0, 2000.0])),
        )
        assert box.step(0.0, brake=1e5) == 0


# Which gear is driven: the ring-driven set of a Simpson transmission beside the sun-driven one.

TEETH = {"sun_teeth": 38, "planet_teeth": 18, "ring_teeth": 74}
ARRANGEMENT_SIMPSON = TEETH | {"arrangement": "ring-input"}
SPEED = 360.0 * 74.0 / 112.0  # of the carrier in first gear


def steady(**more):
    """Return the ring-driven set at 360 rad/s and 250 N m, its load in balance."""
    return Gearbox(
        **ARRANGEMENT_SIMPSON
        | {
            "initial_engine_speed": 360.0,
            "engine_torque": 250.0,
            "load_speed": SPEED,
            "load_torque": 250.0 * 112.0 / 74.0,
        }
        | more
    )


def test_a_ring_driven_set_turns_and_holds_as_its_teeth_say():
    box = steady()
    box.step(0.0, brake=1e4)
    assert box["output_speed"] == pytest.approx(237.857, abs=5e-4)
    assert box["mesh_speed"] == pytest.approx(502.143, abs=5e-4)
    assert box["brake_reaction"] == pytest.approx(-128.378, abs=5e-4)
    assert box["tooth_force"] == pytest.approx(1058.212, abs=5e-4)
    assert box["tilting_couple"] == pytest.approx(11.06666, abs=5e-6)
    assert box["mesh_load"] == pytest.approx(1058.212 * 9e-3 * 1.5 / math.cos(math.radians(20)))


def test_the_clutch_unloads_the_brake_at_r_over_1_plus_r_of_the_engine():
    box = steady(load_torque=250.0)  # without the brake the output has what the input has
    box.step(0.0, clutch=84.8214, brake=1e4)
    assert box["brake_reaction"] == pytest.approx(0.0, abs=2e-4)
    assert box["clutch_reaction"] == 84.8214


def test_loss_of_a_mesh_is_that_of_the_true_teeth_whichever_gear_is_driven():
    """Friction of all meshes: sun meshes as given, ring meshes by their slide-roll ratio."""
    ring = (1.0 / 18.0 - 1.0 / 74.0) / (1.0 / 18.0 + 1.0 / 38.0)
    for arrangement in ("sun-input", "ring-input"):
        box = Gearbox(
            **TEETH | {"arrangement": arrangement, "load_torque": 0.0, "engine_torque": 0.0}
        )
        box.step(1e-5, brake=1e4, mesh=0.25)
        power = 4.0 * (1.0 + ring) * 0.25 * box["mesh_speed"]
        assert box["mesh_heat"] == pytest.approx(power * 1e-5, rel=1e-4)
        assert box["drag_torque"] * (box["engine_speed"] - box["output_speed"]) == pytest.approx(
            power, rel=1e-12
        )


def test_an_arrangement_is_the_other_one_with_sun_and_ring_exchanged_but_for_the_teeth():
    """r is all that the motion knows: 1.5 sun-driven, and its inverse with the ring driven."""
    teeth = {"sun_teeth": 30, "ring_teeth": 45, "planet_teeth": 0, "washers": 0}
    ring = Gearbox(**teeth, arrangement="ring-input", load_torque=50.0)
    plain = Gearbox(**teeth, load_torque=50.0)
    assert ring.par[2:8] == pytest.approx(plain.par[2:8])
    for box, ratio in ((ring, 1.0 + 30.0 / 45.0), (plain, 2.5)):
        box.step(1e-3, brake=1e4)
        assert box["engine_speed"] == pytest.approx(ratio * box["output_speed"], rel=1e-14)


def test_a_profile_shift_lets_the_planet_differ_by_a_tooth_and_no_more():
    TransmissionParams(**ARRANGEMENT_SIMPSON | {"planet_teeth": 17, "profile_shifted": True})
    with pytest.raises(ParameterError, match="planet_teeth"):
        TransmissionParams(**ARRANGEMENT_SIMPSON | {"planet_teeth": 16, "profile_shifted": True})


def test_inertias_answer_to_the_names_of_the_sun_driven_set_as_well():
    params = TransmissionParams(sun_inertia=0.3, ring_inertia=0.02)
    assert (params.input_inertia, params.drum_inertia) == (0.3, 0.02)
    assert params.sun_inertia == 0.3 and replace(params, washers=0).ring_inertia == 0.02
    with pytest.raises(ParameterError, match="sun_inertia"):
        TransmissionParams(sun_inertia=0.3, input_inertia=0.3)


def test_ring_meshes_of_their_own_lose_what_their_torque_says():
    box = Gearbox(**TEETH | {"load_torque": 0.0, "engine_torque": 0.0, "ring_mesh": True})
    box.step(1e-5, brake=1e4, mesh=0.25, ring_mesh=0.1)
    assert box["mesh_heat"] == pytest.approx(4.0 * 0.35 * box["mesh_speed"] * 1e-5, rel=1e-4)


# Thrust bearings of sun and ring: against Newton's law for each body, and in the energy book.

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
