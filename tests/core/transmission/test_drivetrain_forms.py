"""Closed forms of the drivetrain at the numbers of the default and the reference set."""

import math

import numpy as np
import pytest
from closed_forms.lock_up import engagement, reduced_inertia, speed_against_quadratic_load
from closed_forms.planetary import pitch_radius, planet_forces, ring_speed
from scipy.integrate import solve_ivp

HELIX = math.radians(20.0)


def test_pitch_radii_of_the_default_set():
    radii = [1e3 * pitch_radius(z, 1.5e-3, HELIX) for z in (30, 18, 66)]
    assert radii == pytest.approx([23.944, 14.366, 52.677], abs=5e-4)


def test_forces_on_a_helical_planet_at_150_n_m():
    sun, planet = (pitch_radius(z, 1.5e-3, HELIX) for z in (30, 18))
    f = planet_forces(150.0, sun, planet, HELIX, 4)
    assert f.tangential == pytest.approx(1566.0, abs=0.5)
    assert f.axial == pytest.approx(570.0, abs=0.5)
    assert f.couple == pytest.approx(16.38, abs=5e-3)
    assert f.couple / (2 * 0.0085) == pytest.approx(963.0, abs=0.5)
    assert f.sun_thrust == pytest.approx(2280.0, abs=0.5)
    assert f.planet_torque == pytest.approx(22.5, rel=1e-12)
    assert f.pin_load == 2.0 * f.tangential


def test_in_first_gear_the_ring_is_at_rest():
    assert ring_speed(2.2, 350.0, 350.0 / 3.2) == pytest.approx(0.0, abs=1e-13)


def test_reduced_inertias():
    assert reduced_inertia(1.5, 1.0, 0.0, 10.0) == pytest.approx(0.3273, abs=5e-5)
    assert reduced_inertia(2.2, 0.25, 0.0, 8.0) == pytest.approx(0.1146, abs=5e-5)
    assert reduced_inertia(2.2, 0.25, 0.01, 8.0) == pytest.approx(0.1157, abs=5e-5)
    assert reduced_inertia(2.2, 0.25, 1e-9, 8.0) == pytest.approx(0.1145833333, rel=1e-6)


def test_engagement_conserves_momentum_and_energy_without_outer_torques():
    e = engagement(100.0, 0.0, 0.0, 0.5, 2.0, 300.0, 50.0)
    assert e.speed == pytest.approx((0.5 * 300.0 + 2.0 * 50.0) / 2.5, rel=1e-14)
    lost = 0.25 * 300.0**2 + 50.0**2 - 1.25 * e.speed**2
    assert e.heat == pytest.approx(lost, rel=1e-14)
    assert engagement(10.0, 20.0, 0.0, 1.0, 1e9, 10.0, 0.0).lock_time == math.inf


def test_speed_against_a_quadratic_load_solves_its_equation():
    args = (20.0, 20.0, 10.471975512, 1.0, 10.0, 2.5)
    a = 20.0 / 2.5 / (2.5 * 10.471975512) ** 2
    run = solve_ivp(
        lambda t, w: (20.0 - a * w * w) / 2.6,
        (0.0, 1.5),
        [0.0],
        rtol=1e-12,
        atol=1e-13,
        method="DOP853",
    )
    assert speed_against_quadratic_load(1.5, *args) == pytest.approx(run.y[0, -1], rel=1e-11)
    assert np.diff([speed_against_quadratic_load(t, *args) for t in (1.0, 2.0, 50.0)]).min() > 0.0


def test_a_helical_planet_in_balance_is_tilted_by_a_couple_and_not_pushed_along_its_axis():
    """Forces of both meshes as vectors: sun at the planet's left, ring at its right, axis z."""
    torque, sun, planet, planets = 150.0, 0.0239, 0.0144, 3
    f = planet_forces(torque, sun, planet, HELIX, planets)
    tangential = torque / (planets * sun)
    axial = tangential * math.tan(HELIX)
    sun_mesh = np.array([0.0, tangential, axial])
    ring_mesh = np.array([0.0, tangential, -axial])
    force = sun_mesh + ring_mesh
    moment = np.cross([-planet, 0.0, 0.0], sun_mesh) + np.cross([planet, 0.0, 0.0], ring_mesh)
    assert force[2] == 0.0
    assert force[1] == pytest.approx(f.pin_load, rel=1e-13)
    assert moment == pytest.approx([0.0, f.couple, 0.0], abs=1e-13 * f.couple)
    assert f.couple == pytest.approx(
        2.0 * torque * planet / (planets * sun) * math.tan(HELIX), rel=1e-13
    )
    assert f.sun_thrust == pytest.approx(torque / sun * math.tan(HELIX), rel=1e-13)
    assert f.planet_torque * planets == pytest.approx(torque * planet / sun, rel=1e-13)


def test_without_helix_there_is_neither_thrust_nor_couple():
    helical = planet_forces(150.0, 0.0239, 0.0144, HELIX, 3)
    spur = planet_forces(150.0, 0.0239, 0.0144, 0.0, 3)
    assert (spur.axial, spur.couple, spur.sun_thrust) == (0.0, 0.0, 0.0)
    assert spur.pin_load == helical.pin_load
