"""What a scene and its signals show to be doubtful is a warning, without a further run."""

from dataclasses import replace

import pytest
from scene_runs import instances, shift

from thrustwasher.shift import cosimulate, load_scene


def said(name="msl", **changes):
    scene = replace(load_scene(name), **changes).checked()
    return " ".join(cosimulate(scene, instances(scene)).warnings)


def test_a_shift_that_the_run_does_not_hold_is_told():
    assert "after the run ends at 0.05 s: nothing shifts" in said(stop_time=0.05)
    assert "before the pressures of the shift have settled at 2.1 s" in said(stop_time=2.05)
    assert "before the run does at 2.05 s" in said(start_time=2.05, stop_time=2.2)


def test_a_step_adapted_by_more_than_a_percent_is_told():
    assert "The step is 3.333 ms, not 4.9 ms" in said(stop_time=0.01, step=4.9e-3)
    assert "The step is" not in said(stop_time=0.1, step=0.1 / 33 * 1.001)


def test_inputs_that_leave_the_box_of_a_part_file_are_told():
    scene = load_scene("msl").with_options(stop_time=0.05)
    narrow = replace(scene.parts["brake"], labels={"box": {"load": (0.0, 10.0)}})
    words = said(stop_time=0.05, parts={**scene.parts, "brake": narrow})
    assert "brake: load of 100 N .. 100 N in this run leaves the 0 N .. 10 N" in words
    wide = replace(narrow, labels={"box": {"load": (0.0, 100.0)}})
    assert "[box]" not in said(stop_time=0.05, parts={**scene.parts, "brake": wide})


def test_a_shift_that_does_not_happen_comes_before_what_its_scene_has_no_use_for():
    scene = replace(load_scene("msl").with_options(stop_time=0.05), warnings=("look here",))
    first, *others = cosimulate(scene, instances(scene)).warnings
    assert "nothing shifts" in first and "look here" in others
    assert shift("msl", stop_time=0.05).as_dict()["warnings"][0] != "look here"


@pytest.mark.slow
def test_a_guarded_run_needs_instances_that_can_be_reset():
    scene = load_scene("msl").with_options(stop_time=0.05)
    found = cosimulate(scene, instances(scene), guard=True)
    assert found.step_error is not None and found.step_error.suffices


def test_contacts_outside_the_data_of_their_dry_friction_are_told():
    words = said("planetary-distressed", stop_time=0.02)
    assert "points, first at 0 s: dry friction was measured for mean contact pressures" in words
    assert "dry friction was" not in said("planetary", stop_time=0.02)
