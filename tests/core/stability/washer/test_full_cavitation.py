"""No pressure anywhere, and pressure all around.

Hazard: the set of full nodes is empty, or cuts no ring: the banded system has no rows, or wraps.
Formula: p >= 0, residual >= 0, p residual = 0 at every node (Reynolds cavitation).
Cure: columns without a full node are left out; a ring without a dry column is folded.
"""

import pytest

from washer_runs import is_sound, solve  # isort: skip


def test_a_cavitated_film_leaves_the_load_to_the_asperities():
    """At a crawl the film lifts nothing; half of it cavitates all the same."""
    r = solve(load=300.0, speed=1e-9)
    assert is_sound(r) and r.fluid_load < 1e-6


@pytest.mark.parametrize("load", [20.0, 300.0, 700.0])
def test_pressure_is_nowhere_below_zero(load):
    p = solve(load=load).fields().pressure
    assert p.min() >= -1e-9 * p.max()
    assert (p[1:-1] <= 0.0).any() and (p[1:-1] > 0.0).any()


@pytest.mark.parametrize("tilt", [1e-5, 1e-4, 4e-3])
def test_thick_and_thin_wedges_find_their_full_region(tilt):
    r = solve(load=20.0, speed=1000.0, tilt=tilt)
    assert is_sound(r)
    share = (r.fields().pressure[1:-1] > 0.0).mean()
    assert 0.1 < share < 0.9
