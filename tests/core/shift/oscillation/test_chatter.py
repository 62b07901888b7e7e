"""Chatter: found where a step is too long for a torque loop, and the step named ends it."""

import pytest
from scene_runs import shift, slow_without_jit

from thrustwasher.shift.account.shift_record import record_of
from thrustwasher.shift.account.swing_texts import chatter_texts

BARE = {"washer": None, "mesh": None}


def bare(stop_time=0.9, coupling="torque", **options):
    parts = BARE | {"transmission": {"washers": 0, "coupling": coupling}}
    return shift("planetary-sun", parts=parts, stop_time=stop_time, **options)


@pytest.mark.parametrize(("master", "limit"), [("gauss-seidel", 2.0), ("jacobi", 1.0)])
def test_a_torque_loop_over_its_limit_chatters_and_says_why(master, limit):
    r = bare(master=master)
    found = {c.pack: c for c in r.chatter}["clutch"]
    assert found.limit == limit < found.kappa and found.turns > 40
    assert found.inertia == pytest.approx(0.1157, abs=1e-4)
    assert r.as_dict()["chatter"][0]["kappa"] > 1.0
    text = " ".join(chatter_texts(record_of(r)))
    for words in ("Numerical", "kappa", f"below {limit:g}", 'coupling = "capacity"', master):
        assert words in text


@slow_without_jit
@pytest.mark.parametrize("master", ["gauss-seidel", pytest.param("jacobi", marks=pytest.mark.slow)])
def test_the_step_that_is_named_ends_the_chatter(master):
    """With ten times the smoothing, so that the step is not tiny."""
    smooth = {"speed_smoothing": 1.0}
    parts = BARE | {"transmission": {"washers": 0, "coupling": "torque"}}
    parts |= {"clutch": smooth, "brake": smooth}
    wrong = shift("planetary-sun", parts=parts, stop_time=1.0, master=master, step=2e-3)
    clutch = {c.pack: c for c in wrong.chatter}["clutch"]
    right = shift("planetary-sun", parts=parts, stop_time=0.8, master=master, step=clutch.good_step)
    assert right.chatter == []


def test_nothing_chatters_where_packs_stick_or_torques_are_corrected():
    assert bare(coupling="capacity").chatter == []
    assert bare(master="linearly-implicit").chatter == []
