"""Units that brake one shaft: model exchange against co-simulation; rest; what a solver needs."""

from functools import cache
from importlib.metadata import version
from itertools import pairwise

import numpy as np
import pytest
from built import built_fmu
from exchanged import unit
from fmpy import simulate_fmu
from packaging.version import Version
from shafts import HEATS, SHAFTS, WARM, Shaft, exchanged, stepped, stop_of

from thrustwasher.model.registry import find_spec

each_shaft = pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] * n.startswith("train")) for n in SHAFTS]
)


@cache
def run_of(name, tolerance=1e-6, method="Radau"):
    """Return a run, which tests share: they only read it."""
    key, shaft, parameters = SHAFTS[name]
    with unit(key) as u:
        return exchanged(u, shaft, 1.0, *HEATS[key], tolerance, method, **parameters)


@each_shaft
def test_a_shaft_stops_as_in_co_simulation(name):
    """At 0.1 ms: when it stands, the heat, within 0.2 %; then it is held."""
    key, shaft, parameters = SHAFTS[name]
    with unit(key, kind="CoSimulation") as c:
        one, two = run_of(name), stepped(c, shaft, 1.0, *HEATS[key], **parameters)
    assert stop_of(one) == pytest.approx(stop_of(two), rel=2e-3)
    assert one["heat"] == pytest.approx(two["heat"], rel=2e-3)
    assert abs(one["speed"][-1]) < 1e-6
    assert one["torque"][-1] == pytest.approx(shaft.driven(1.0), abs=1e-6)


@each_shaft
@pytest.mark.parametrize(
    "tolerance", [1e-3, *(pytest.param(x, marks=pytest.mark.slow) for x in (1e-4, 1e-5))]
)
def test_every_tolerance_ends_alike(name, tolerance):
    fine, run = run_of(name), run_of(name, tolerance)
    part = 2e-3 if tolerance < 1e-3 else 1e-2
    assert stop_of(run) == pytest.approx(stop_of(fine), rel=part)
    assert run["heat"] == pytest.approx(fine["heat"], rel=part)
    assert run["steps"] < 600 and run["events"] < 20


@pytest.mark.parametrize("name", [n for n in SHAFTS if n != "train, warm bodies"])
@pytest.mark.slow
def test_what_the_shaft_loses_is_heat(name):
    run, shaft = run_of(name), SHAFTS[name][1]
    energy = 0.5 * shaft.inertia * (shaft.speed**2 - run["speed"][-1] ** 2)
    work = np.trapezoid(shaft.driven(0.0) * run["speed"], run["time"])
    assert run["heat"] == pytest.approx(energy + work, rel=2e-3)


REST = {"gearmesh": ({"load": 400.0}, 0.5), "train": ({"torque": 150.0}, 0.8)}


@pytest.mark.parametrize("key", ["gearmesh", pytest.param("train", marks=pytest.mark.slow)])
def test_at_rest_nothing_creeps(key):
    """Under a part of the friction for 100 s a shaft gives way by the bristle's bending alone."""
    given, drive = REST[key]
    with unit(key) as u:
        shaft = Shaft(0.02, 0.0, drive, **given, **WARM)
        run = exchanged(u, shaft, 100.0, *HEATS[key])
    late = run["time"] > 1.0
    assert np.abs(run["speed"][late]).max() < 1e-6
    assert np.trapezoid(run["speed"], run["time"]) < 3e-3
    assert run["torque"][-1] == pytest.approx(drive, rel=1e-6)


@pytest.mark.parametrize("key", ["gearmesh", pytest.param("train", marks=pytest.mark.slow)])
def test_a_torque_above_the_friction_turns_it_back(key):
    given, _ = REST[key]
    with unit(key) as u:
        shaft = Shaft(0.02, 20.0, -20.0, **given, **WARM)
        run = exchanged(u, shaft, 0.5, *HEATS[key])
    assert run["speed"][-1] < -100.0 and run["torque"][-1] < 0.0


# Time and inputs, which jump.
PROFILES = {
    "gearmesh": [
        (0.0, 0.0, 0.0, 300.0),
        (0.1, 40.0, 180.0, 300.0),
        (0.4, 60.0, 120.0, 330.0),
        (0.6, 20.0, 5.0, 330.0),
        (0.7, 20.0, -30.0, 330.0),
        (0.9, 0.0, 50.0, 330.0),
        (0.95, 400.0, 50.0, 330.0),
        (1.0, 400.0, 50.0, 330.0),
    ],
    "train": [
        (0.0, 0.0, 5.0, 300.0),
        (0.1, 100.0, 300.0, 300.0),
        (0.4, 200.0, 500.0, 340.0),
        (0.6, -100.0, 500.0, 340.0),
        (0.7, -20.0, 10.0, 340.0),
        (0.8, 30.0, -30.0, 340.0),
        (1.0, 30.0, -30.0, 340.0),
    ],
}


@pytest.mark.skipif(
    Version(version("fmpy")) < Version("0.3.32"), reason="CVode of FMPy 0.3.28 stops at a jump"
)
@pytest.mark.parametrize("key", ["gearmesh", pytest.param("train", marks=pytest.mark.slow)])
@pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.slow)])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6])
def test_cvode_of_fmpy_follows_jumps(key, fmi, tolerance):
    """Torque in the middle of the rows and heat within 0.2 % of co-simulation at 0.1 ms."""
    brake, heat = HEATS[key]
    path, rows = str(built_fmu(key, fmi=fmi, local=True)), PROFILES[key]
    flat = [r for a, b in pairwise(rows) for r in (a, (b[0], *a[1:]))]
    names = ["time", *(v.name for v in find_spec(key).inputs)]
    given = np.array(flat, dtype=[(n, float) for n in names])
    same = {"stop_time": 1.0, "input": given, "output": [brake, *heat]}
    one = simulate_fmu(
        path,
        fmi_type="ModelExchange",
        solver="CVode",
        relative_tolerance=tolerance,
        output_interval=0.01,
        **same,
    )
    two = simulate_fmu(path, step_size=1e-4, output_interval=1e-4, **same)
    total = [sum(float(r[n][-1]) for n in heat) for r in (one, two)]
    assert total[0] == pytest.approx(total[1], rel=2e-3)
    for a, b in pairwise(rows):
        middle = 0.5 * (a[0] + b[0])
        torques = [np.interp(middle, r["time"], r[brake]) for r in (one, two)]
        assert torques[0] == pytest.approx(torques[1], rel=2e-3, abs=1e-6)
