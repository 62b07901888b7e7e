"""Inputs that move within a step: FMI 2 by their derivatives, FMI 3 by what the host gives then.

The toy takes no rates: the shell steps it with the inputs at the middle of the step.
"""

import random

import pytest
from shell_runs import BEGUN, GUID, SANITIZED, needs_gcc, putting, ref, run, taking, toy_library
from toy.spec import SPEC as TOY
from twin import Twin

pytestmark = needs_gcc
LOAD, SPEED = ref("load"), ref("speed")
START = putting(load=500.0, speed=20.0, oil_temperature=310.0)
H = 0.25
STEP = f"step 0 {H}\n"
OUTPUTS = taking(["friction_torque", "temperature", "temperature_rise", "energy", "film_ratio"])
INPUTS = taking(["load", "speed", "oil_temperature"])


def values(fmi, script, **options):
    """Return what each reading of a script gave; every command has to succeed."""
    replies = run(fmi, toy_library(), script, **options)
    assert {r.status for r in replies} == {0}, [r.messages for r in replies if r.status]
    return [r.values for r in replies if r.values]


def moving(kind="derivative", **given):
    return f"put {kind} " + " ".join(f"{ref(n)} {x.hex()}" for n, x in given.items()) + "\n"


@pytest.mark.slow
def test_a_rate_moves_an_input_straight_through_the_next_step_and_no_further():
    rates = moving(load=400.0, speed=-8.0)
    got = values(2, BEGUN + START + rates + STEP + INPUTS + OUTPUTS + f"step {H} {H}\n" + OUTPUTS)
    middle = putting(load=550.0, speed=19.0)
    end = putting(load=600.0, speed=18.0)
    steps = START + middle + STEP + end + OUTPUTS + f"step {H} {H}\n" + OUTPUTS
    assert got[0] == [600.0, 18.0, 310.0]
    assert got[1:] == values(2, BEGUN + steps)


@pytest.mark.slow
def test_what_would_leave_its_range_ends_where_the_range_does():
    rates = moving(load=-1e7, speed=1e300, oil_temperature=1.0)
    (load, speed, oil), _ = values(2, BEGUN + START + rates + STEP + INPUTS + OUTPUTS)
    assert 0.0 <= load <= 1e-9 and 1000.0 - 1e-9 <= speed <= 1000.0 and oil == 310.25


@pytest.mark.parametrize(
    ("command", "text"),
    [
        (f"put derivative {LOAD} 1 99 1", "value reference 99 is unknown in ToyClutch"),
        (f"put derivative {LOAD} 1 {ref('discs')} 1", "discs: only Real inputs have a rate"),
        (f"put derivative {ref('energy')} 1", "energy: only Real inputs have a rate of change"),
        (f"put derivative {SPEED} nan", "speed: rate of change = nan rad/s/s, allowed: a finite"),
        (f"put derivative {LOAD} -inf", "load: rate of change = -inf N/s, allowed: a finite"),
        (f"put curve {LOAD} 1", "load: derivative of order 2, allowed: 1"),
    ],
)
def test_a_refused_rate_is_named_and_none_of_its_call_is_taken_over(command, text):
    before = BEGUN + START
    refused, status, *_, last = run(
        2, toy_library(), before + command + "\n" + taking(["solver_status"]) + STEP + OUTPUTS
    )[-4:]
    assert refused.status == 3 and text in refused.messages[0]
    assert status.values == [15.0]
    assert last.values == values(2, before + STEP + OUTPUTS)[-1]


def test_rates_are_part_of_the_state_and_gone_after_a_reset(tmp_path):
    move = moving(load=400.0, speed=-8.0)
    saved = f"save 0\nwrite 0 {tmp_path}/a\n"
    again = f"restore 0\n{STEP}{OUTPUTS}read 1 {tmp_path}/a\nrestore 1\n{STEP}{OUTPUTS}"
    first, second, third = values(2, BEGUN + START + move + saved + STEP + OUTPUTS + again)
    assert first == second == third
    held = BEGUN + START + STEP + OUTPUTS
    anew = "reset\nsetup 0\nenter 0\nleave\n"
    assert values(2, BEGUN + move + anew + START + STEP + OUTPUTS) == values(2, held)
    assert values(2, held)[0] != first


def test_a_step_that_fails_leaves_inputs_and_rates_as_they_were():
    steep = BEGUN + putting(load=8500.0, speed=20.0) + moving(load=8000.0)
    replies = run(2, toy_library(), steep + STEP + INPUTS + STEP.replace("0.25", "0.1") + INPUTS)
    assert replies[-4].status == 3 and "MAX_ITERATIONS" in replies[-4].messages[-1]
    assert replies[-3].values == [8500.0, 20.0, 300.0]
    assert replies[-2].status == 0 and replies[-1].values == [9300.0, 20.0, 300.0]


def test_fmi_3_asks_for_the_inputs_at_the_end_and_steps_as_with_their_rates():
    begun = f"make toy {GUID} 1 u\nenter 0\nleave\n" + START
    ends = moving(load=600.0, speed=18.0)
    replies = run(3, toy_library(), begun + ends + STEP + "extra asked-for\n" + INPUTS + OUTPUTS)
    said, asked, inputs, outputs = replies[-4:]
    assert "set within the step: 0, also done: 0" in "".join(said.messages)
    assert sum("return from it first" in text for text in said.messages) == 2
    assert asked.values == [H] and inputs.values == [600.0, 18.0, 310.0]
    rates = moving(load=400.0, speed=-8.0)
    assert outputs.values == values(2, BEGUN + START + rates + STEP + OUTPUTS)[-1]


def test_fmi_3_steps_with_held_inputs_where_the_host_gives_none_or_a_bad_one():
    begun = f"make toy {GUID} 1 u\nenter 0\nleave\n" + START
    held = values(2, BEGUN + START + STEP + OUTPUTS)[-1]
    assert run(3, toy_library(), begun + STEP + OUTPUTS)[-1].values == held
    bad = begun + moving(load=-1.0) + STEP + INPUTS + putting(load=500.0) + STEP + OUTPUTS
    step, inputs, *_, outputs = run(3, toy_library(), bad)[-5:]
    assert step.status == 3 and "no step at t = 0 s: load = -1 N" in step.messages[-1]
    assert inputs.values == [500.0, 20.0, 310.0] and outputs.values == held


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.slow
def test_the_core_and_the_shell_move_inputs_alike(seed):
    twin, rng, t = Twin(TOY, GUID), random.Random(seed), 0.0
    twin.begin()
    twin.leave()
    for _ in range(200):
        names = rng.sample(["load", "speed", "oil_temperature", "energy", "discs"], 2)
        if rng.random() < 0.5:
            twin.put(load=rng.uniform(0.0, 9100.0), speed=rng.uniform(-1e3, 1e3))
        rates = [0.0, 10.0, -1e4, 1e6, float("nan")]
        weights = [3, 3, 3, 3, 1]
        if "discs" not in names:
            twin.move(**dict(zip(names, rng.choices(rates, weights, k=2), strict=True)))
        h = rng.choice([1e-3, 0.1])
        twin.step(t, h)
        t = twin.core.time
        twin.take()
        if rng.random() < 0.1:
            twin.save(0)
        elif twin.states and rng.random() < 0.1:
            twin.restore(0)
            t = twin.core.time
    replies = run(2, toy_library(SANITIZED), twin.script, flags=SANITIZED)
    twin.check(replies)
    assert sum(r.status == 3 for r in replies) > 20
