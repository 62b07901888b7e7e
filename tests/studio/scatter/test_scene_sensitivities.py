"""Derivatives of a shift's figures: those of wider differences, none at a corner."""

import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.shift import load_scene
from thrustwasher.studio.evaluators.scene import scene_evaluator
from thrustwasher.studio.scatter.scene_sensitivities import _checked, scene_sensitivities


def test_they_are_those_of_wider_differences():
    scene, path = load_scene("msl"), "clutch.friction_scale"
    found = scene_sensitivities(scene, ["lock_time", "slip_energy"], [path])
    ends = scene_evaluator(scene).evaluate([{path: 0.99}, {path: 1.01}], list(found)).values
    difference = (ends[1] - ends[0]) / 0.02
    assert [row[path] for row in found.values()] == pytest.approx(difference.tolist(), rel=0.01)
    assert found["lock_time"][path] < 0.0


def test_slopes_of_two_steps_that_differ_are_none():
    assert _checked(1.0, 1.005, 0.0) == pytest.approx(1.0 + 4.0 * 0.005 / 3.0)
    assert _checked(1.0, 1.1, 0.0) is None and _checked(float("nan"), 1.0, 0.0) is None
    assert _checked(1e-9, -1e-9, 1e-8) == -1e-9  # does not move


@pytest.mark.slow
def test_unknown_figures_and_paths_are_named():
    scene = load_scene("msl")
    with pytest.raises(ParameterError, match=r"figure 'lock_tim': .* did you mean lock_time"):
        scene_sensitivities(scene, ["lock_tim"])
    with pytest.raises(ParameterError, match=r"clutch\.friction: is no real number of the scene"):
        scene_sensitivities(scene, paths=["clutch.friction"])
    with pytest.raises(ParameterError, match=r"brake\.points\.4: is 0, of which there is no step"):
        scene_sensitivities(load_scene("planetary"), paths=["pressure.brake.points.4"])
