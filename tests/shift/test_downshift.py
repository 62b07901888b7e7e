"""The command may run the other way: a 2 -> 1 downshift is told with the roles changed."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import NO_DRAG, instances

from thrustwasher.shift import load_scene, run_shift


@pytest.fixture(scope="module")
def downshift():
    """Second gear at 150 rad/s, engine on: the clutch opens, the engine rises, the brake holds."""
    scene = replace(load_scene("planetary-sun"), shift_from=1.0, shift_to=0.0, stop_time=1.5)
    gearbox = scene.parts["transmission"]
    start = {"initial_engine_speed": 80.0, "initial_drum_speed": 80.0, **NO_DRAG["transmission"]}
    parts = {n: p for n, p in scene.parts.items() if n in ("transmission", "clutch", "brake")}
    parts["transmission"] = replace(gearbox, params=replace(gearbox.params, **start))
    scene = replace(scene, parts=parts)
    return run_shift(scene, instances(scene))


def test_the_phases_begin_in_second_gear(downshift):
    assert [p.name for p in downshift.phases] == [
        "second gear",
        "torque phase",
        "inertia phase",
        "locked",
    ]
    assert downshift.scene.engaging == "brake" and not downshift.scene.alone


def test_the_brake_is_what_the_figures_are_about(downshift):
    f, last = downshift.figures, downshift.signals["transmission.brake_heat"][-1]
    assert f["slip_energy"] == last > 0.0
    words = {k.name: k.text for k in downshift.key_figures}
    assert words["lock_time"] == "brake locks" and words["release_time"] == "clutch lets go"
    after = int(np.searchsorted(downshift.time, f["lock_time"]))
    engine = downshift.signals["transmission.engine_speed"][after]
    assert f["lock_speed"] == pytest.approx(engine, rel=2e-3)


def test_mean_friction_is_torque_over_what_presses(downshift):
    params = downshift.scene.parts["brake"].params
    assert params.friction_radius == pytest.approx(74.9933e-3, rel=1e-6)
    assert 0.03 < downshift.figures["friction_mean"] < 0.12
