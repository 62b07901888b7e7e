"""The guard's decisions, one look after another."""

import math

from thrustwasher.drivetrain.guard_rules import CALM_CHECKS, Memory, decide

TOL = 0.006


def looks(memory, differences, outside=False):
    return [decide(memory, d, outside, TOL) for d in differences]


def test_small_differences_change_nothing_and_the_worst_is_kept():
    memory = Memory()
    assert looks(memory, [0.0, 0.005, 0.001]) == [None] * 3
    assert (memory.up, memory.checks, memory.worst) == (False, 3, 0.005)


def test_a_difference_above_the_tolerance_goes_up_at_once():
    memory = Memory()
    assert looks(memory, [0.001, 0.0061]) == [None, "difference"]
    assert memory.up


def test_a_difference_that_is_no_number_goes_up():
    assert looks(Memory(), [math.nan]) == ["difference"]


def test_outside_goes_up_without_a_comparison():
    memory = Memory()
    assert decide(memory, None, True, TOL) == "outside"
    assert memory.up and memory.checks == 0


def test_it_comes_back_after_ten_calm_looks_running_and_not_before():
    memory = Memory(up=True)
    assert looks(memory, [0.0019] * (CALM_CHECKS - 1)) == [None] * (CALM_CHECKS - 1)
    assert looks(memory, [0.0021]) == [None], "not calm: the count begins again"
    assert looks(memory, [0.0019] * CALM_CHECKS) == [None] * (CALM_CHECKS - 1) + ["calm"]
    assert not memory.up


def test_it_does_not_come_back_while_outside():
    memory = Memory(up=True)
    assert looks(memory, [0.0] * 50, outside=True) == [None] * 50
    assert memory.up


def test_a_difference_around_the_tolerance_does_not_chatter():
    memory = Memory()
    changes = [c for c in looks(memory, [0.0059, 0.0061] * 200) if c]
    assert changes == ["difference"]


def test_each_return_takes_ten_looks_so_that_changes_are_few():
    memory = Memory()
    changes = [c for c in looks(memory, ([0.01] + [0.0] * CALM_CHECKS) * 20) if c]
    assert changes == ["difference", "calm"] * 20


def test_what_is_seen_above_is_not_charged_to_the_cheap_rung():
    memory = Memory(up=True)
    looks(memory, [0.5])
    assert memory.worst == 0.0 and memory.checks == 1
