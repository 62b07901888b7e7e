"""Why the film is not found by substituting temperatures, and that it is found all the same."""

import pytest

from washer_runs import is_sound, solve  # isort: skip


@pytest.mark.parametrize("load", [600.0, 700.0, 760.0])
def test_a_hot_start_does_not_stay_hot_when_the_film_is_asked_for(load):
    """Plain substitution of temperatures lands on the contact branch up to 28 % below the fold."""
    hot = solve(load=900.0)
    assert hot.branch == "contact"
    film = solve(load=load, start=hot, branch="film")
    assert is_sound(film) and film.branch == "film" and not film.distress
    cold = solve(load=load)
    assert film.film_ratio == pytest.approx(cold.film_ratio, abs=1e-3)
    assert film.temperature == pytest.approx(cold.temperature, abs=1e-2)


@pytest.mark.parametrize("speed", [900.0, 1500.0])
def test_thousands_of_kelvin_are_a_number_with_a_warning(speed):
    """Mathematically the branch goes on; no real film survives there."""
    r = solve(load=3000.0, speed=speed)
    assert is_sound(r) and r.distress
    assert r.temperature_max > 1000.0
    assert r.temperature_max < 1e5
