"""The state is complete: restored or carried to another process, the run goes on to the bit."""

import random

import pytest
from toy.places import TOY_START
from toy.spec import SPEC as TOY

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.stepper import DirectInstance, Instance

H = 1e-3

CONTINUE = """
import sys
from toy.spec import SPEC
from thrustwasher.fmu.stepper import Instance
from test_state import run
with Instance(sys.argv[1]) as fmu:
    fmu.initialize()
    state = fmu.deserialize(open(sys.argv[2], "rb").read())
    fmu.set_state(state)
    fmu.free_state(state)
    print(run(fmu, 20, 40))
"""


def run(instance, first, last):
    rng = random.Random(first)
    for i in range(first, last):
        instance.set_inputs([rng.uniform(0, 8000), rng.uniform(-900, 900), 300.0])
        instance.step(i * H, H)
    return instance.outputs()


@pytest.fixture(params=["fmu", "direct"])
def instance(request, toy_fmu):
    made = Instance(toy_fmu) if request.param == "fmu" else DirectInstance(TOY)
    with made:
        made.initialize(inputs=TOY_START)
        run(made, 0, 20)
        yield made


def test_a_state_that_is_set_again_gives_the_same_run(instance):
    state = instance.get_state()
    first = run(instance, 20, 40)
    instance.set_state(state)
    assert run(instance, 20, 40) == first
    instance.set_state(state)  # more than once
    assert run(instance, 20, 40) == first
    instance.free_state(state)


def test_a_state_keeps_unread_inputs_and_the_time(instance):
    instance.set_inputs([1.0, 2.0, 300.0])
    state = instance.get_state()
    instance.set_inputs([3.0, 4.0, 301.0])
    instance.step(0.02, H)
    instance.set_state(state)
    assert instance.get(["load", "speed", "time"]) == [1.0, 2.0, 19 * H + H]


def test_serialized_bytes_carry_the_run_to_another_process(toy, toy_fmu, tmp_path, run_child):
    run(toy, 0, 20)
    state = toy.get_state()
    file = tmp_path / "state.bin"
    file.write_bytes(toy.serialize(state))
    expected = run(toy, 20, 40)
    assert run_child(CONTINUE, toy_fmu, file) == str(expected)


def test_a_refused_value_is_still_missing_in_a_state_that_is_set_again(toy):
    with pytest.raises(ParameterError):
        toy.set_inputs([500.0, float("nan"), 300.0])
    state = toy.get_state()
    data = toy.serialize(state)
    toy.set_inputs([500.0, 20.0, 310.0])
    toy.step(0.0, H)
    for kept in (state, toy.deserialize(data)):
        toy.set_state(kept)
        with pytest.raises((SolveError, ParameterError), match="was refused before"):
            toy.step(0.0, H)
        toy.set_inputs([500.0, 20.0, 310.0])
        toy.step(0.0, H)


def test_bytes_are_the_same_for_the_same_state(instance):
    state = instance.get_state()
    again = instance.deserialize(instance.serialize(state))
    assert instance.serialize(again) == instance.serialize(state)


def damaged(data):
    flipped = bytearray(data)
    flipped[len(data) // 2] ^= 1
    return {
        "empty": b"", "short": data[:40], "truncated": data[:-1], "longer": data + b"0",
        "flipped": bytes(flipped), "text": b"{}" * 200,
    }  # fmt: skip


@pytest.mark.parametrize("kind", ["empty", "short", "truncated", "longer", "flipped", "text"])
def test_damaged_bytes_are_refused_and_the_run_goes_on(kind, instance):
    data = damaged(instance.serialize(instance.get_state()))[kind]
    before = instance.outputs()
    with pytest.raises((ParameterError, SolveError), match="FMU state"):
        instance.set_state(instance.deserialize(data))
    assert instance.outputs()[:-1] == before[:-1]  # the last is solver_status
    instance.step(0.02, H)


def test_a_state_of_another_model_is_refused(direct_toy):
    from dataclasses import replace

    foreign = replace(direct_toy.get_state(), identity="0" * 16)
    with pytest.raises(ParameterError, match="another model or version"):
        direct_toy.set_state(foreign)
