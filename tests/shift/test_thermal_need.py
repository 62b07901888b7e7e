"""The scene says whether its washer's bodies have time to follow."""

import math
from dataclasses import replace

import numpy as np
import pytest

from thrustwasher import ParameterError, WasherParams
from thrustwasher.shift.run import model_remarks
from thrustwasher.shift.scene.scene import with_fidelities
from thrustwasher.shift.scene.scene_file import load_scene
from thrustwasher.shift.thermal_need import body_times, change_time, thermal_need
from thrustwasher.shift.tolerance.run_to_tolerance import _without_choice


def said(duration, mode="quasi_steady", scene="planetary-sun"):
    params = replace(load_scene(scene).parts["washer"].params, thermal_mode=mode)
    time = np.linspace(0.0, 10.0 * duration, 1001)
    power = 10.0 + 90.0 * np.clip(time / (duration / 0.8), 0.0, 1.0)
    film = np.full_like(time, 2e-6)
    return thermal_need(params, time, {"friction_power": power, "film_thickness": film})


def test_bodies_settle_within_their_own_times():
    p = WasherParams(body_storage="lumped")
    quickest, slowest = body_times(p, 2e-6)
    alone = p.density * p.specific_heat * p.carrier_thickness**2 / p.conductivity
    assert slowest == pytest.approx(alone, rel=0.1)  # two thick bodies, held together by the film
    assert 0.01 < quickest < 0.3
    quickest, slowest = body_times(WasherParams(), 2e-6)
    assert slowest == pytest.approx(0.4 * alone, rel=0.1)
    assert 0.01 < quickest < 0.1


def test_time_of_change_is_that_of_the_middle_eighty_percent():
    time = np.linspace(0.0, 1.0, 1001)
    assert change_time(time, np.clip(time / 0.5, 0.0, 1.0)) == pytest.approx(0.4, abs=3e-3)
    assert change_time(time, np.ones_like(time)) == math.inf
    assert change_time(time, np.where(time > 0.3, 1.0, 0.0)) == pytest.approx(1e-3)


def test_quick_courses_need_stored_heat_and_slow_ones_do_not():
    assert "upper bound" in said(0.5) and "transient" in said(0.5)
    assert said(0.5, "transient").endswith("needed here, and it ran")
    assert said(500.0).endswith("steady temperatures are right")
    assert "would do" in said(500.0, "transient")


def test_a_scene_without_a_washer_needs_neither():
    scene, time = load_scene("msl"), np.array([0.0, 1.0])
    signals = {f"{n}.{s.name}": time for n, p in scene.parts.items() for s in p.spec.outputs}
    assert model_remarks(scene, time, signals) == []


def test_the_transient_scene_asks_for_bodies_as_cold_as_the_oil():
    params = load_scene("planetary-transient").parts["washer"].params
    assert (params.thermal_mode, params.thermal_start) == ("transient", "oil")


def test_a_rung_without_bodies_is_refused_before_anything_is_built():
    scene = load_scene("planetary-transient")
    with pytest.raises(ParameterError, match=r"\[washer\]: thermal_mode = transient, allowed"):
        with_fidelities(scene, ["washer=map"])


def test_no_rung_is_chosen_for_bodies_that_store_heat():
    asked = with_fidelities(load_scene("planetary-transient"), ["auto:0.01"])
    scene, remarks = _without_choice(asked)
    assert scene.parts["washer"].tolerance is None and scene.parts["clutch"].tolerance == 0.01
    assert scene.parts["washer"].fidelity == "field"
    assert remarks == ["washer: field, its default; cards speak of steady states, and "
                       "thermal_mode is transient"]  # fmt: skip
