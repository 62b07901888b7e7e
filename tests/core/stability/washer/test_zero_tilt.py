"""No tilt, no wedge: the asperities carry all.

Hazard: Newton's method started level has a singular matrix: no tilt changes nothing. The minimum
    film thickness has a kink (a norm) at zero tilt.
Formula: tilt 0: pressure 0, contact load = load, torque = f W (2/3)(r_o^3 - r_i^3)/(r_o^2 -
    r_i^2).
Cure: started from the washer lying on the gear; continued in the mean gap where the norm has its
    kink.
"""

import math

import pytest

from washer_runs import followed, is_sound, solve  # isort: skip


@pytest.mark.parametrize("speed", [0.0, 10.0, 545.0, -1500.0])
@pytest.mark.parametrize("load", [5.0, 300.0, 3000.0])
def test_without_tilt_the_film_carries_nothing(load, speed):
    r = solve(load=load, speed=speed, tilt=0.0)
    assert is_sound(r)
    assert abs(r.fluid_load) <= 1e-9 * load
    assert math.hypot(r.washer_tilt_x, r.washer_tilt_y) < 1e-9


def test_friction_without_tilt_is_that_of_the_dry_law_at_a_crawl():
    """f times load times the mean radius of an even pressure."""
    r = solve(load=800.0, speed=1e-3, tilt=0.0)
    ri, ro = 0.0111, 0.0227
    mean = 2.0 / 3.0 * (ro**3 - ri**3) / (ro**2 - ri**2)
    dry = 0.48 - 0.05 * math.log(800.0)
    assert r.friction_torque == pytest.approx(dry * 800.0 * mean, rel=1e-4)
    assert r.friction_coefficient == pytest.approx(dry, rel=1e-4)


def test_tilt_that_shrinks_to_zero_is_followed():
    tilts = [0.002, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 0.0]
    results = followed([{"tilt": t, "load": 100.0} for t in tilts])
    assert all(is_sound(r) for r in results)
    assert results[-1].fluid_load == pytest.approx(0.0, abs=1e-7)
    again = followed([{"tilt": t, "load": 100.0} for t in reversed(tilts)])
    assert all(is_sound(r) for r in again)
    assert again[-1].film_ratio == pytest.approx(results[0].film_ratio, abs=1e-3)
