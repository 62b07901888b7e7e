"""Films thinner than the roughness, and nothing left of them.

Hazard: 1/h and 1/h^3 where the mean surfaces touch and pass: infinite shear, no flow, a log of a
    negative number.
Formula: the mean gap of rough surfaces h_T = E[max(h + s, 0)] is above 0 for every h, and so is
    the flow that Patir & Cheng's phi h^3 leaves.
Cure: shear and flow are taken from h_T and a bounded flow factor; film ratios below 0 are
    answers.
"""

import pytest

from thrustwasher import WasherParams, solve_washer

from washer_runs import is_sound, solve  # isort: skip


@pytest.mark.parametrize("load", [1000.0, 3000.0, 10000.0])
@pytest.mark.parametrize("speed", [0.0, 1.0, 136.0])
def test_the_mean_surfaces_may_touch_and_pass(load, speed):
    r = solve(load=load, speed=speed)
    assert is_sound(r)
    assert r.contact_load > 0.5 * load


def test_a_soft_washer_is_pressed_through_the_mean_plane():
    r = solve_washer(WasherParams(yield_strength=4e8), load=3000.0, speed=20.0, tilt=0.004)
    assert is_sound(r) and r.film_ratio < -1.0


@pytest.mark.parametrize("change", [{"yield_strength": 2e8}, {"roughness": 1.5e-7}])
def test_the_softest_and_the_smoothest_washers_are_answered(change):
    """Both are the ends of the parameters' ranges."""
    r = solve_washer(WasherParams(**change), load=3000.0, speed=100.0, tilt=0.002)
    assert is_sound(r)


def test_hot_oil_carries_less():
    films = [solve(load=100.0, oil_temperature=t).film_thickness for t in (270.0, 300.0, 350.0)]
    assert films[0] > films[1] > films[2]
