"""Contact, film, friction and stress of the gear mesh against closed forms and checked numbers."""

import math

import pytest
from closed_forms import line_contact, thermal_fatigue

from thrustwasher.gearmesh.kernels import contact

E, NU = 205e9, 0.3
THETA = contact.compliance(E, NU, E, NU)
W, R = 9423.0, 6.89e-3


def test_contact_stress_is_the_peak_pressure_but_for_the_rounded_factor():
    p0 = math.sqrt(W / (math.pi * R * THETA))
    exact = 1.0 / math.sqrt(math.pi * (1.0 - NU * NU))
    assert contact.surface_stress(W, R, E) / p0 == pytest.approx(0.591 / exact, rel=1e-14)
    assert exact == pytest.approx(0.5914, abs=5e-5)


def test_li_seireg_friction_at_a_checked_point_and_its_limits():
    assert contact.li_seireg(1e-6, 0.01, 0.12, 3e-5)[0] == pytest.approx(0.08441831, abs=5e-9)
    assert contact.li_seireg(0.0, 0.01, 0.12, 4.5e-5)[0] == 0.12
    for roughness, thick in ((4.5e-5, 0.0953), (1.5e-5, 0.0542)):
        found = contact.li_seireg(1.0, 0.01, 0.12, roughness)[0]
        assert found == pytest.approx(thick, abs=5e-5)
    wanted = line_contact.li_seireg(4e-4, 2e-5, 0.1)
    assert contact.li_seireg(4e-6, 0.01, 0.1, 2e-5)[0] == pytest.approx(wanted, rel=1e-14)


def test_stresses_and_modification_of_a_chain_worked_by_hand():
    """100.7493 K on a contact of 178.2393 MPa; seven digits in, squared: good to 2e-6."""
    thermal = contact.thermal_stress(100.7493, E, NU, 12e-6)
    assert thermal == pytest.approx(118.0206e6, rel=1e-6)
    soft = contact.modification(thermal, 178.2393e6, 0.77, 0.63)
    hard = contact.modification(thermal, 178.2393e6, 0.40, 0.53)
    assert (soft[0], hard[0]) == pytest.approx((0.2934999, 0.7697331), rel=2e-6)
    assert hard[0] / soft[0] == pytest.approx(2.62, abs=5e-3)
    assert hard[1] == pytest.approx(thermal_fatigue.allowable_ratio(hard[0]), rel=1e-15)


def test_at_the_allowable_ratio_the_endurance_is_used_up_exactly():
    """Scale both stresses until the contact stress is that share of its limit: utilization 1."""
    k, share = contact.modification(118e6, 178e6, 0.40, 0.53)
    scale = share * 0.53 * 1301e6 / 178e6
    used = contact.utilization(scale * 118e6, scale * 178e6, 0.40, 0.53, 1301e6)
    assert used == pytest.approx(1.0, rel=1e-14) and k > 0.0
