"""Steps much shorter than the last one: what changes in them vanishes with their length."""

import pytest
from kernel_part import Part

from thrustwasher.transmission.parameters import SPEC, TransmissionParams

H = 1e-3
NAMES = [s.name for s in SPEC.inputs]
BEFORE = {"clutch_torque": 100.0, "brake_torque": 300.0, "mesh_torque": 0.1, "shift_command": 0.2}
AFTER = {"clutch_torque": 120.0, "brake_torque": 280.0, "mesh_torque": 0.2, "shift_command": 0.3}
FORCE = TransmissionParams().clutch_force
SHOWN = ("clutch_load", "brake_load", "mesh_load", "washer_load", "clutch_reaction")


def box(*steps, **params):
    """Return a transmission after steps of these lengths with the inputs before."""
    part = Part("transmission", "rigid", **params)
    for dt in steps:
        assert move(part, BEFORE, dt) == 0
    return part


def move(part, inputs, dt):
    return part.step([inputs.get(n, 0.0) for n in NAMES], dt)


def changes(part, *steps):
    """Return how the outputs change over steps with the inputs after."""
    start = [part[n] for n in SHOWN]
    for dt in steps:
        assert move(part, AFTER, dt) == 0
    return [part[n] - x for n, x in zip(SHOWN, start, strict=True)]


def test_a_change_of_inputs_arrives_in_proportion_to_a_short_step():
    long, short = (changes(box(H, H), h) for h in (1e-7, 1e-9))
    assert min(abs(x) for x in long) > 1e-3
    assert short == pytest.approx([1e-2 * x for x in long], rel=2e-3)


def test_two_halves_of_a_short_step_go_as_far_as_the_whole():
    """What a master compares that doubles its steps."""
    whole, halves = (
        changes(box(H, H, capacity_extrapolation=False), *steps)
        for steps in ((1e-7,), (5e-8, 5e-8))
    )
    assert halves == pytest.approx(whole, rel=2e-3)


@pytest.mark.parametrize("steps", [(H,), (1e-3 * H,), (2.0 * H,), (2e-4 * H,) * 5])
def test_a_change_of_inputs_has_arrived_after_a_thousandth_of_the_last_step(steps):
    part = box(H, H)
    changes(part, *steps)
    assert part["clutch_load"] == pytest.approx(0.3 * FORCE, rel=1e-12)


def test_without_a_step_an_output_follows_a_changed_input_at_once():
    part = box(H, H)
    changes(part, 1e-7)
    reached = part["clutch_load"]
    move(part, AFTER, 0.0)
    assert part["clutch_load"] == reached  # nothing was changed
    move(part, {**AFTER, "shift_command": 0.4}, 0.0)
    assert part["clutch_load"] == pytest.approx(0.4 * FORCE, rel=1e-15)


def test_a_tiny_last_step_does_not_carry_the_capacity_away():
    """A change of 0.1 N m in 1 ns goes on for 50 ns at most, over whatever step."""
    part = box(1e-9, 1e-9)
    move(part, BEFORE | {"clutch_torque": 100.1}, H)
    assert part["clutch_locked"] == 0.0
    assert part["clutch_reaction"] == pytest.approx(100.1 + 50 * 0.1, rel=1e-9)


def test_a_pack_answers_its_load_without_a_step_as_in_a_vanishing_one():
    """Command, force and capacity belong together after one exchange in this order."""
    inputs = [3000.0, 100.0, 320.0, 0.0]
    part = Part("clutch", "field")
    for _ in range(3):
        assert part.step(inputs, H) == 0
    before = part["torque_capacity"]
    loaded = [4000.0, *inputs[1:]]
    part.step(loaded, 0.0)
    now = part["torque_capacity"]
    part.step(loaded, 1e-12)
    assert part["torque_capacity"] == pytest.approx(now, rel=1e-9)
    assert now == pytest.approx(before, rel=1e-9) or now > before
