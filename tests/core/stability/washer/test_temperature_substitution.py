"""Temperatures substituted whole find distress where there is none.

Hazard: film, then heat, then film again, until nothing moves: near the fold this walks over the
    unstable branch and ends on the contact branch, with status OK: false distress, up to 28 %
    below the load at which the film is lost.
Formula: the substitution's spectral radius is some 0.5 on the film branch, 2.4 on the unstable
    one and 0.25 on the contact branch; one step from a cold start crosses what it cannot stay on.
Cure: temperatures are functions of the gaps and enter the derivatives: one Newton method for all,
    and the first crossing from the light side decides.
"""

import pytest
from curves import traced

from thrustwasher import Status, WasherParams, solve_washer

from washer_runs import is_sound, solve  # isort: skip


@pytest.mark.parametrize("load", [700.0, 800.0, 945.0])
def test_a_hot_start_does_not_stay_hot_when_the_film_is_asked_for(load):
    hot = solve(load=1100.0)
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


@pytest.mark.parametrize("share", [0.72, 0.8, 0.9, 0.97, 0.999])
@pytest.mark.parametrize("speed", [400.0, 545.0, 953.0])
def test_up_to_the_fold_a_cold_solve_calls_no_distress(speed, share):
    """Where substitution loses the film: from 28 % below the fold on."""
    lost = traced(speed=speed).folds[0].load
    r = solve(load=share * lost, speed=speed)
    assert is_sound(r) and r.branch == "film" and not r.distress


@pytest.mark.slow
def test_substituted_whole_the_film_is_lost_where_ours_and_the_relaxed_one_keep_it():
    """The method of 2006 on the paper's equations; its loops compile for half a minute."""
    from lab.benchmarks.failures.plain2006 import Plain2006

    paper, ratios = WasherParams.preset("paper"), {}
    for share in (0.3, 1.0):
        washer = Plain2006(paper, grid=(17, 67), tolerance=1e-4, share=share)
        assert washer.solve(690.0, 545.0, 0.002, 297.15) is Status.OK
        ratios[share] = washer.found.film_ratio
    ours = solve_washer(paper, load=690.0, speed=545.0, tilt=0.002)
    assert ratios[0.3] == pytest.approx(ours.film_ratio, abs=0.5)
    assert ratios[1.0] < 2.0 < ours.film_ratio
