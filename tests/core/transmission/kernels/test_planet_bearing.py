"""A planet on its needles: limits, equilibrium and what is left to the washers."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize

from thrustwasher.transmission.kernels import layout as L

from test_transmission_step import Gearbox  # isort: skip

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
