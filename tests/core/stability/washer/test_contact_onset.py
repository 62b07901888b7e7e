"""Where the first asperities touch.

Hazard: contact pressure and its slope start from nothing like exp(-h^2/2): a table that is cut
    off there has a kink, and a step that saw no contact lands deep inside it. On a uniform mesh
    the few nodes that touch carry all the torque: off by half.
Formula: contact pressure ~ F_3/2(d) < 1e-3 of its value at d = 0 beyond d = 3; torque has its
    minimum value at a film ratio of 3.0 to 3.3, and d torque/d load changes sign there.
Cure: the contact law and its slope are continuous to zero; steps are limited to a third of the
    film; nodes lie where the film is thin.
"""

import itertools

import numpy as np
import pytest
from curves import traced

from thrustwasher import WasherParams, solve_washer

from washer_runs import followed, is_sound, solve  # isort: skip

SPEED = 136.0  # the curve has no fold here: contact comes on smoothly
LOADS = np.geomspace(150.0, 700.0, 60)


@pytest.fixture(scope="module")
def onset():
    return followed([{"load": float(w), "speed": SPEED} for w in LOADS])


def test_every_step_into_contact_is_a_solution(onset):
    assert all(is_sound(r) for r in onset)
    assert onset[0].contact_load < 1e-3 * onset[0].load < 0.1 * onset[-1].contact_load


def test_contact_grows_with_every_step_and_the_film_falls(onset):
    for a, b in itertools.pairwise(onset):
        assert b.contact_load > a.contact_load and b.film_ratio < a.film_ratio


def test_friction_is_least_where_contact_begins(onset):
    coefficients = [r.friction_coefficient for r in onset]
    k = int(np.argmin(coefficients))
    assert 0 < k < len(onset) - 1
    assert onset[k].film_ratio == pytest.approx(3.3, abs=0.3)


def test_torque_over_film_ratio_has_no_kink():
    """Over load it is steep here (torque ~ load^31 at its knee); over the film it is smooth."""
    points = traced(speed=SPEED).points
    ratio, torque = np.array([(p.film_ratio, p.friction_torque) for p in points]).T
    near = (ratio < 6.0) & (ratio > 1.0)
    slopes = np.diff(np.log(torque[near])) / np.diff(ratio[near])
    assert np.abs(np.diff(slopes)).max() < 0.12 * np.ptp(slopes)


def test_one_step_from_no_contact_into_it_ends_where_small_ones_do(onset):
    start = solve(load=20.0, speed=SPEED)
    r = solve(load=float(LOADS[-1]), speed=SPEED, start=start)
    assert is_sound(r)
    assert r.friction_torque == pytest.approx(onset[-1].friction_torque, rel=1e-5)


def test_the_default_mesh_is_not_off_by_half():
    """A uniform one of 9 x 67 nodes is, at 320 N."""
    point = {"load": 320.0, "speed": SPEED, "tilt": 0.002}
    ours, fine = (solve_washer(WasherParams(), **point, fidelity=f) for f in ("field", "fine"))
    assert ours.friction_torque == pytest.approx(fine.friction_torque, rel=0.02)
