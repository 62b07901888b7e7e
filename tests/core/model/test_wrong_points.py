"""A point that cannot be solved is refused by name, in one line, with what is allowed."""

import math

import pytest

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    ParameterError,
    WasherParams,
    load_curve,
    solve_clutch,
    solve_gearmesh,
    solve_washer,
)
from thrustwasher.model.registry import find_spec

CALLS = {
    "washer": (solve_washer, WasherParams(), {"load": 300.0, "speed": 545.0, "tilt": 2e-3}),
    "curve": (load_curve, WasherParams(), {"speed": 545.0, "tilt": 2e-3}),
    "clutch": (solve_clutch, ClutchParams(), {"load": 5e3, "speed": 40.0}),
    "gearmesh": (solve_gearmesh, GearMeshParams(), {"power": 7500.0, "speed": 180.0}),
}
NO_NUMBERS = (math.nan, math.inf, "much")


def rows():
    for call, (_, _, point) in CALLS.items():
        spec = find_spec("washer" if call == "curve" else call)
        ranges = {s.name: (s.low, s.high) for s in spec.inputs} | {"power": (-1e9, 1e9)}
        for name in (*point, "oil_temperature"):
            low, high = ranges[name]
            for value in (*NO_NUMBERS, low - 1e-3, 1.01 * high):
                yield call, name, value
        yield call, "fidelity", "best"


@pytest.mark.parametrize(("call", "name", "value"), rows())
def test_a_wrong_value_is_named_with_what_is_allowed(call, name, value):
    solve, params, point = CALLS[call]
    with pytest.raises(ParameterError) as refused:
        solve(params, **{**point, name: value})
    message = str(refused.value)
    assert message.startswith(f"{name} = {value!r}")
    assert ("a number in" if value == "much" else "allowed: ") in message
    assert "\n" not in message


WRONG = [
    ("washer", {"load": 0.0}, "load = 0.0 N, allowed: 1 .. 200000 N"),
    ("washer", {"grid": (1, 32)}, r"grid = \(1, 32\) .*, allowed: .* 5 x 8"),
    ("washer", {"grid": (10.5, 32)}, r"grid = \(10.5, 32\)"),
    ("washer", {"grid": 10}, "grid = 10"),
    ("washer", {"grid": (10, 32, 4)}, "grid = "),
    ("washer", {"grid": (1000, 32)}, r"grid = \(1000, 32\) .*, allowed: .*129"),
    ("washer", {"branch": "middle"}, "branch = 'middle', allowed: 'film' or 'contact'"),
    ("curve", {"load_min": 0.0}, "load_min"),
    ("curve", {"load_min": 500.0, "load_max": 400.0}, "load_max"),
    ("gearmesh", {"power": 1.0, "speed": 0.0}, "speed = 0.0 rad/s, allowed: from 1e-07"),
    ("gearmesh", {"power": 1e9, "speed": 1.0}, "speed = 1.0 rad/s, allowed: from 100 "),
]


@pytest.mark.parametrize(("call", "change", "message"), WRONG)
def test_what_only_one_function_takes_is_named_too(call, change, message):
    solve, params, point = CALLS[call]
    with pytest.raises(ParameterError, match=message):
        solve(params, **{**point, **change})
