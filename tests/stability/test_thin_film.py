"""Films thinner than the roughness, and nothing left of them."""

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


@pytest.mark.parametrize("kelvin", [233.15, 260.0, 420.0, 473.15])
@pytest.mark.parametrize("load", [1.0, 300.0, 3000.0])
def test_oil_at_both_ends_of_its_range(kelvin, load):
    """From a viscosity a hundred times that of base to one fifty times below it."""
    r = solve(load=load, oil_temperature=kelvin)
    assert is_sound(r)
    if load == 1.0:
        assert r.branch == "film"


def test_hot_oil_carries_less():
    films = [solve(load=100.0, oil_temperature=t).film_thickness for t in (270.0, 300.0, 350.0)]
    assert films[0] > films[1] > films[2]
