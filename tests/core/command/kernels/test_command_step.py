"""The command source: the same ramp as a scene's, and nothing remembered."""

from dataclasses import replace

import pytest

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.model.registry import all_specs, find_spec
from thrustwasher.shift import load_scene

SPEC = find_spec("CommandSource")


def source(scene, lead=0.0):
    return DirectInstance(
        SPEC,
        parameters={
            "start": scene.shift_start,
            "duration": scene.shift_duration,
            "before": scene.shift_from,
            "after": scene.shift_to,
            "lead": lead,
        },
    )


@pytest.mark.parametrize("lead", [0.0, 0.004])
@pytest.mark.parametrize("name", ["planetary-sun", "brake-test"])
def test_the_ramp_is_the_scenes_to_the_bit(name, lead):
    scene = load_scene(name)
    h = 1.0 / 256
    with source(scene, lead) as command:
        command.initialize()
        assert command.outputs()[0] == scene.command(lead)
        for i in range(300):
            command.step(i * h, h)
            assert command.outputs()[0] == scene.command((i + 1) * h + lead)


def test_without_a_duration_the_command_jumps():
    scene = replace(load_scene("planetary-sun"), shift_duration=0.0, shift_start=0.25)
    with source(scene) as command:
        command.initialize()
        command.step(0.125, 0.125)
        assert command.outputs()[0] == 0.0
        command.step(0.25, 0.125)
        assert command.outputs()[0] == 1.0


def test_it_is_built_when_named_and_not_with_the_others():
    assert SPEC not in all_specs()
    assert find_spec("command") is SPEC
