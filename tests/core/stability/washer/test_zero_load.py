"""An unloaded washer, and one that is let go.

Hazard: without a load there is no balance: the film grows without end, and a scene that lifts its
    load for one step stops with an exception.
Formula: film thickness ~ load^(-1/2) as the load goes to 0.
Cure: the library refuses loads below 1 N by name; a washer in a scene takes less as 1 N and goes
    on.
"""

import itertools

import pytest

from thrustwasher import ParameterError
from thrustwasher.errors import Status

from washer_runs import followed, is_sound, solve, stepped  # isort: skip


def test_the_least_load_is_answered():
    r = solve(load=1.0)
    assert is_sound(r) and r.branch == "film" and r.film_ratio > 20.0


def test_unloading_makes_the_film_thicker_without_end():
    results = followed([{"load": w} for w in (3000.0, 700.0, 300.0, 100.0, 30.0, 10.0, 3.0, 1.0)])
    assert all(is_sound(r) for r in results)
    film = [r.film_thickness for r in results if r.branch == "film"]
    assert len(film) >= 6
    assert all(b > a for a, b in itertools.pairwise(film))


def test_no_load_is_refused_in_words_by_the_library():
    for load in (0.0, -1.0):
        with pytest.raises(ParameterError, match="load"):
            solve(load=load)


def test_a_washer_in_a_scene_goes_on_when_the_load_is_gone():
    """The step takes a load below 1 N, even a negative one, as 1 N."""
    found = stepped((300.0, 20.0, 1.0, 0.0, -30.0, 1.0, 20.0, 300.0))
    assert {status for status, _ in found} == {Status.OK}
    torques = [torque for _, torque in found]
    assert torques[2:6] == pytest.approx([torques[2]] * 4, rel=1e-6)
    assert torques[::-1] == pytest.approx(torques, rel=1e-5)
