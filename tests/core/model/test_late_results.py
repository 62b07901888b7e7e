"""Results fill their fields when they are read; nobody can tell."""

import logging
import pickle
from dataclasses import FrozenInstanceError, fields, replace

import pytest

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    WasherParams,
    solve_clutch,
    solve_gearmesh,
    solve_washer,
)
from thrustwasher.clutch import solve as clutch_solve

SOLVES = {
    "clutch": lambda: solve_clutch(ClutchParams(), load=4000.0, speed=20.0),
    "gearmesh": lambda: solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0),
    "shared": lambda: solve_gearmesh(
        GearMeshParams(load_sharing="elastic"), power=7500.0, speed=180.0
    ),
    "map": lambda: solve_washer(
        WasherParams(), load=300.0, speed=953.0, tilt=0.002, fidelity="map"
    ),
}
each = pytest.mark.parametrize("solve", SOLVES.values(), ids=SOLVES)


def values(result):
    return {f.name: getattr(result, f.name) for f in fields(result) if f.compare}


@each
def test_a_result_that_nobody_has_read_is_pickled_compared_and_replaced_whole(solve):
    read = solve()
    first = values(read)
    assert values(pickle.loads(pickle.dumps(solve()))) == first
    assert solve() == read
    assert replace(solve(), warnings=("said",)).warnings == ("said",)


@each
def test_a_result_is_frozen_and_has_no_other_names(solve):
    result = solve()
    with pytest.raises(FrozenInstanceError):
        result.friction_torque = 0.0
    with pytest.raises(AttributeError, match="has no attribute 'frictiontorque'"):
        _ = result.frictiontorque


def test_fields_are_made_once_and_texts_only_if_they_are_read(monkeypatch):
    monkeypatch.setattr(logging.getLogger("thrustwasher"), "propagate", False)  # nobody listens
    made, plain = [], {n: getattr(clutch_solve, n) for n in ("_fields", "_warnings")}
    for name, function in plain.items():
        monkeypatch.setattr(
            clutch_solve, name, lambda *a, n=name, f=function: made.append(n) or f(*a)
        )
    result = SOLVES["clutch"]()
    assert made == []
    assert result.friction_torque > 0.0 and result.film_ratio > 0.0 and made == ["_fields"]
    assert result.warnings == result.warnings and made == ["_fields", "_warnings"]


def test_parameters_are_prepared_once_for_many_points(monkeypatch):
    made, plain = [], clutch_solve.prepare
    monkeypatch.setattr(clutch_solve, "prepare", lambda *a: made.append(a) or plain(*a))
    pack = ClutchParams(friction_scale=0.987)
    for load in (1e3, 2e3, 3e3):
        solve_clutch(pack, load=load, speed=20.0)
        solve_clutch(replace(pack), load=load, speed=20.0)
    assert len(made) == 1
