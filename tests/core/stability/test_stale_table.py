"""Errors that were measured for other kernels or other parameters.

Hazard: a promise outlives what it was made for. Numbers are still looked up, look as good as new,
    and speak for a solver that is gone.
Formula: measured errors hold if the digests of kernels and parameters are those that run now.
Cure: stale errors do not count: a choice passes the level over and names the command that renews
    them, or compares with the level above where all are stale; an error estimate is None.
"""

from dataclasses import replace

import pytest

from thrustwasher import WasherParams, choose, solve_washer
from thrustwasher.ladder import error_table as home

POINT = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 300.0}
RENEW = "renew it: python -m lab.verify washer"


@pytest.fixture
def put(tmp_path, monkeypatch):
    """Return a function that writes the default washer's table with these levels stale."""
    (shipped,) = home.load_tables("washer", WasherParams())

    def write(*stale):
        levels = [
            replace(
                level,
                sources="0" * 64
                if level.fidelity in stale
                else home.sources_of("washer", level.fidelity, level.files),
            )
            for level in shipped.levels
        ]
        home.write_tables([replace(shipped, levels=tuple(levels))], tmp_path / "washer.json")
        home.forget()

    monkeypatch.setattr(home, "table_folders", lambda: [tmp_path])
    write()
    yield write
    home.forget()


def test_fresh_errors_choose_and_estimate(put):
    choice = choose("washer", POINT, tol=0.01)
    assert choice.is_verified and choice.error <= 0.01
    assert solve_washer(WasherParams(), **POINT).error_estimate < 0.01


def test_one_stale_level_is_passed_over_and_the_next_one_serves(put):
    first = choose("washer", POINT, tol=0.01).fidelity
    put(first)
    second = choose("washer", POINT, tol=0.01)
    assert second.fidelity != first and second.is_verified
    assert any(first in why and RENEW in why for why in second.reasons)


def test_nothing_is_promised_by_stale_errors_and_the_command_is_named(put):
    put("map", "field", "fine")
    choice = choose("washer", POINT, tol=0.01)
    assert not choice.is_verified and RENEW in str(choice)
    assert solve_washer(WasherParams(), **POINT).error_estimate is None


def test_errors_with_other_parameters_are_not_stretched_over_these(put):
    other = WasherParams(heat_split=0.3)
    assert solve_washer(other, **POINT).error_estimate is None
    assert not choose("washer", POINT, tol=0.01, params=other).is_verified
