"""The damping limit of judder: closed form against roots, and its plain limits."""

import numpy as np
import pytest
from closed_forms.lock_up import reduced_inertia
from closed_forms.torsional_stability import characteristic, damping_limit
from hypothesis import given
from hypothesis import strategies as st

from thrustwasher.transmission.mobility import Mobility, planetary


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
