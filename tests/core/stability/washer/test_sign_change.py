"""Turning through standstill and back.

Hazard: cavities change sides, so that a sweep now runs the wrong way and a warm start holds
    pressure where the film opens.
Formula: speed -> -speed mirrors the film about the tilt's axis; torque is odd, all else even.
Cure: the active set is corrected until it stays, from any start; no sweep has a direction.
"""

import pytest

from washer_runs import followed, is_sound, solve  # isort: skip


@pytest.mark.parametrize("load", [50.0, 300.0, 1500.0])
def test_a_sweep_through_zero_is_odd(load):
    speeds = [200.0, 60.0, 10.0, 1.0, 0.0, -1.0, -10.0, -60.0, -200.0]
    results = followed([{"speed": s, "load": load} for s in speeds])
    assert all(is_sound(r) for r in results)
    torques = [r.friction_torque for r in results]
    for there, back in zip(torques[:4], torques[:-5:-1], strict=True):
        assert back == pytest.approx(-there, rel=2e-5)
    assert torques[4] == 0.0


def test_one_jump_from_forwards_to_backwards():
    r = solve(speed=-1200.0, start=solve(speed=1200.0))
    assert is_sound(r)
    assert r.friction_torque == pytest.approx(solve(speed=-1200.0).friction_torque, rel=1e-5)


def test_the_contact_branch_survives_a_small_step_only_forwards():
    """Beyond the fold and turned round: still the contact branch, which alone exists."""
    hot = solve(load=1100.0)
    back = solve(load=1100.0, speed=-545.0, start=hot)
    assert is_sound(back) and back.branch == "contact" and back.distress
