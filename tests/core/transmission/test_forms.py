"""Closed forms of the drivetrain at the numbers of the default and the reference set."""

import math

import numpy as np
import pytest
from closed_forms.lock_up import engagement, reduced_inertia, speed_against_quadratic_load
from closed_forms.planetary import pitch_radius, planet_forces, ring_speed
from closed_forms.torsional_stability import characteristic, damping_limit
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from thrustwasher.transmission.mobility import Mobility, planetary

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


# The damping limit of judder: closed form against roots, and its plain limits.


def mode(m, slope, stiffness, damping):
    """Return the root of the mode: the one with the maximum frequency."""
    return max(np.roots(characteristic(m, slope, stiffness, damping)), key=lambda s: s.imag)


inertias = st.floats(0.05, 50.0)


@given(
    inertias,
    st.one_of(st.just(0.0), st.floats(0.001, 1.0)),
    inertias,
    inertias,
    st.sampled_from(["clutch", "brake"]),
    st.floats(-20.0, -0.01),
    st.floats(100.0, 1e5),
)
def test_the_mode_neither_grows_nor_decays_at_the_limit(
    sun, ring, carrier, vehicle, pack, slope, stiffness
):
    m = planetary(2.2, sun, ring, carrier, vehicle, pack)
    limit = damping_limit(m, slope, stiffness)
    at = mode(m, slope, stiffness, limit.damping)
    size = m.slip * abs(slope) + m.twist * limit.damping
    if at.imag > 1e-3 * size:
        assert abs(at.real) < 1e-9 * abs(at) + 1e-9 * size
        assert at.imag == pytest.approx(limit.frequency, rel=1e-7)
        assert mode(m, slope, stiffness, 0.99 * limit.damping).real > 0.0
        assert mode(m, slope, stiffness, 1.01 * limit.damping).real < 0.0


def test_between_a_held_engine_and_a_heavy_vehicle_the_damper_balances_the_clutch():
    m = Mobility(1e-9 + 2.5, -2.5, 2.5 + 1e-9)
    assert damping_limit(m, -0.7, 2000.0).damping == pytest.approx(0.7, rel=1e-6)
    # With the planetary's kinematics the slope counts (1 + 1/r)^2.
    m = planetary(2.2, 1e9, 0.0, 0.4, 1e9)
    assert damping_limit(m, -0.7, 2000.0).damping == pytest.approx(0.7 * (1 + 1 / 2.2) ** 2)


def test_friction_that_does_not_fall_needs_no_damping():
    m = Mobility(1.0 / 20.0 + 1.0 / 0.3, -1.0 / 0.3, 1.0 / 0.3 + 1.0 / 8.0)
    assert damping_limit(m, 0.0, 1e3).damping == damping_limit(m, 5.0, 1e3).damping == 0.0


def test_small_slopes_grow_by_the_first_order_formula():
    m = planetary(2.2, 20.0, 0.01, 0.3, 8.0)
    for damping in (0.0, 1e-3, 1e-2):
        exact = mode(m, -2e-3, 1200.0, damping).real
        first_order = -0.5 * (m.twist * damping - 2e-3 * m.cross**2 / m.twist)
        assert exact == pytest.approx(first_order, rel=1e-3)


@pytest.mark.parametrize("ring", [0.0, 0.01, 0.4])
def test_the_slip_of_the_clutch_sees_the_reduced_inertia(ring):
    m = planetary(2.2, 0.25, ring, 8.0, 1.0)
    assert 1.0 / m.slip == pytest.approx(reduced_inertia(2.2, 0.25, ring, 8.0), rel=1e-12)


def test_without_a_shaft_falling_friction_drives_the_slip_away_at_its_own_rate():
    m = Mobility(8.0, -3.0, 4.0)
    roots = np.roots(characteristic(m, -0.5, 1e-9, 0.0))
    assert max(roots.real) == pytest.approx(4.0, rel=1e-6)
