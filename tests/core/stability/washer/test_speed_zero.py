"""A washer that stands still, and one that comes to rest.

Hazard: the film's source, the heat and its scale go to zero together; residuals divided by them
    are 0/0, and a stop test on the relative change of nothing never ends.
Formula: at speed 0 the pressure is 0, T = T_oil, contact load = load, friction torque = 0;
    Coulomb friction has no limit there: f W r for +0 and -f W r for -0.
Cure: residuals are scaled with absolute floors; the torque at rest is 0 by definition, and rest
    is approached, not skipped.
"""

import pytest

from washer_runs import followed, is_sound, solve  # isort: skip


@pytest.mark.parametrize("tilt", [0.0, 0.002, 0.004])
@pytest.mark.parametrize("load", [5.0, 300.0, 3000.0])
def test_at_rest_the_asperities_carry_everything_and_nothing_is_warm(load, tilt):
    r = solve(load=load, speed=0.0, tilt=tilt)
    assert is_sound(r)
    assert r.friction_torque == 0.0 and r.fluid_load == 0.0
    assert r.temperature == r.oil_temperature
    assert r.contact_load == pytest.approx(load, rel=1e-7)
    assert not r.distress


def test_at_rest_the_tilt_is_shared_and_none_is_left_about_x():
    """The washer leans towards the smaller gear: gy/gt lies above a half, by the inner edge."""
    r = solve(load=2000.0, speed=0.0)
    assert abs(r.washer_tilt_x) < 1e-9
    assert 0.4 < r.washer_tilt_y / 0.002 < 0.9


def test_slowing_down_to_rest_loses_the_film_without_a_failure():
    speeds = [545.0 * 0.6**k for k in range(26)] + [0.0]
    results = followed([{"speed": s} for s in speeds])
    assert all(is_sound(r) for r in results)
    shares = [r.fluid_load / 300.0 for r in results]
    assert shares[0] > 0.999 and shares[-1] == 0.0
    assert results[-2].fluid_load < 0.1


@pytest.mark.parametrize("speed", [1e-300, 1e-12, 1e-6, 1e-3])
def test_creeping_is_the_limit_of_rest(speed):
    """Coulomb friction does not depend on how slow it is; the film carries nothing."""
    r, slow = solve(speed=speed), solve(speed=1e-4)
    assert is_sound(r)
    assert r.friction_torque == pytest.approx(slow.friction_torque, rel=1e-3)
    assert r.film_ratio == pytest.approx(solve(speed=0.0).film_ratio, abs=1e-3)
