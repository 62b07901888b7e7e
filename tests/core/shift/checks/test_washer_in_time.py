"""Washers taken as steady are followed in time after a run: what differs is told."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import instances, real_shift, slow_without_jit

from thrustwasher import WasherParams, follow_washer
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.checks.guard import followed_washers
from thrustwasher.shift.checks.washer_in_time import COMPARED, QUICK, follow_recorded
from thrustwasher.washer.solve import GRIDS

pytestmark = slow_without_jit


def relieved():
    """A record of quasi-steady states: 1361 N until 0.1 s, then 500 N."""
    few = np.array([0.0, 0.0999, 0.1])
    c = follow_washer(
        WasherParams(), time=few, load=[1361.0, 1361.0, 500.0], speed=545.0, tilt=2e-3
    )
    time = np.linspace(0.0, 5.0, 2501)
    late = (time >= 0.1).astype(int) + 1
    names = ("load", "speed", "tilt", "oil_temperature", *COMPARED)
    return time, {name: getattr(c, name)[late] for name in names}


@pytest.mark.slow
def test_a_hot_washer_that_is_relieved_is_not_steady():
    time, signals = relieved()
    assert signals["friction_torque"][-1] == pytest.approx(0.250, abs=1e-3)
    found = follow_recorded(WasherParams(), GRIDS["field"], time, signals, 5e-3)
    for after, torque, ratio in ((0.02, 1.63, 0.91), (1.0, 1.44, 0.99), (4.0, 0.66, 1.5)):
        profile = [np.interp(0.1 + after, found.time, column) for column in found.values.T]
        assert profile[0] == pytest.approx(torque, rel=0.06)
        assert profile[1] == pytest.approx(ratio, rel=0.06)
    (words,) = found.warnings("washer", "do this")
    assert "friction torque 0.25 N·m where in time it is 1.6" in words and "do this" in words
    assert "film ratio 8.64 where in time it is 0.93" in words and "hottest spot" in words


@pytest.mark.slow
def test_few_instants_do_what_all_of_them_do():
    run = real_shift("planetary")
    names = ("load", "speed", "tilt", "oil_temperature")
    every = slice(None, 500, 4)
    signals = {n: run.signals[f"washer.{n}"][every] for n in (*names, *COMPARED)}
    params = run.scene.parts["washer"].params
    found = follow_recorded(params, QUICK, run.time[every], signals, 5e-3)
    in_time = replace(params, thermal_mode="transient")
    inputs = {n: signals[n] for n in names}
    full = follow_washer(in_time, time=run.time[every], **inputs, grid=QUICK)
    at = np.searchsorted(full.time, found.time)
    assert len(found.time) < 0.2 * len(full.time)
    assert found.values[:, 0] == pytest.approx(full.friction_torque[at], rel=5e-3)
    assert found.values[:, 1] == pytest.approx(full.film_ratio[at], rel=5e-3)
    assert found.values[:, 2] == pytest.approx(full.temperature_max[at], abs=0.3)


@pytest.mark.slow
def test_the_default_washer_is_steady_and_so_is_one_that_rests():
    run = real_shift("planetary")
    found = followed_washers(run.scene, run.time, run.signals, run.step)["washer"]
    assert found.differences == [] and not found.stopped and found.worst < 0.6
    assert len(found.time) < 40
    time = np.array([0.0, 0.5, 1.0])
    inputs = {"load": 50.0, "speed": 0.0, "tilt": 1e-3, "oil_temperature": 350.0}
    outputs = {"friction_torque": 0.0, "film_ratio": 2.5, "temperature_max": 350.0}
    still = {n: np.full(3, x) for n, x in (inputs | outputs).items()}
    assert follow_recorded(WasherParams(), QUICK, time, still, 5e-3).differences == []


@pytest.mark.slow
def test_a_washer_in_time_is_not_followed_again():
    scene = load_scene("planetary-transient").with_options(stop_time=0.01)
    run = cosimulate(scene, instances(scene), guard=True)
    assert run.in_time == {}
