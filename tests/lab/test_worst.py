"""Timing of single steps: what is walked through, what is counted, what is refused."""

import json
import math

import needed
import numpy as np
import pytest
from scene_runs import slow_without_jit

from lab import macro_steps
from lab.benchmarks.corrections import corrections
from lab.charts.chart_page import corrections_section
from lab.macro_steps import Way, complaint, figures, run
from lab.realtime import timed_steps as c
from lab.realtime.longest_step import beyond
from lab.realtime.walk import LONGEST, SHORTEST, Walk, ranges
from lab.worst import main
from thrustwasher.model.registry import all_specs, find_spec


def histogram(*times):
    found = np.zeros(c.N_BINS, np.int64)
    for t in times:
        found[int(c.BINS_PER_OCTAVE * np.log2(t * 1e9))] += 1
    return found


def test_the_rare_time_is_exceeded_by_just_that_share():
    found = histogram(*[1e-6] * 990, *[1e-3] * 10)
    assert beyond(found, 0.02) == pytest.approx(1e-6, rel=0.03)
    assert beyond(found, 0.005) == pytest.approx(1e-3, rel=0.03)


def test_a_seed_is_a_walk():
    one, two, other = (Walk(find_spec("clutch"), seed).piece(500) for seed in (1, 1, 2))
    assert all((a == b).all() for a, b in zip(one, two, strict=True))
    assert not (one.inputs == other.inputs).all()


@pytest.mark.parametrize("spec", all_specs(), ids=lambda spec: spec.key)
def test_a_walk_goes_all_over_its_box_and_stays_in_what_the_fmu_allows(spec):
    piece, known = Walk(spec, 1).piece(20_000), ranges()[spec.key]
    assert set(known) <= {s.name for s in spec.inputs}
    for k, s in enumerate(spec.inputs):
        values = piece.inputs[:, k]
        assert (s.low <= values).all() and (values <= s.high).all()
        low, high, law = known.get(s.name, (s.start, s.start, ""))
        assert values.max() == pytest.approx(high)
        assert values.min() == pytest.approx(-high if law in ("signed", "either") else low)
        if law == "signed":
            assert (values == 0.0).any() and (np.diff(np.sign(values)) != 0.0).sum() > 50
        if law:
            assert (np.diff(values) == 0.0).mean() > 0.3
    assert piece.sizes.min() < 1.5 * SHORTEST and piece.sizes.max() > 0.7 * LONGEST
    assert piece.restarts[0] == 1 and 3 <= piece.restarts.sum() <= 30


@pytest.mark.slow
def test_the_command_times_every_step_of_three_walks(capsys):
    needed.linker()
    assert main(["sump", "--steps", "3000", "--json"]) == 0
    (found,) = json.loads(capsys.readouterr().out)["steps"]
    assert (found["model"], found["fidelity"], found["steps"]) == ("sump", "lumped", 9000)
    assert found["failed"] == found["not_finite"] == 0
    assert 0.0 < found["mean"] <= found["rare"] <= found["longest"] <= found["raw_longest"]
    assert found["bound"] == "explicit: no solve" and len(found["point"]) == 17


@pytest.mark.slow
def test_the_table_says_how_much_work_the_steps_took(capsys):
    needed.linker()
    assert main(["clutch", "--fidelity", "field", "--steps", "300"]) == 0
    out = capsys.readouterr().out
    for words in ("clutch field: 900 steps", "mean", "99.999 %", "x mean", "substeps", "memory"):
        assert words in out


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--steps", "0"], "--steps 0, allowed: a whole number from 1 on"),
        (["--fidelity", "crude"], "--fidelity crude: no such fidelity level"),
        (["nothing"], "model = 'nothing'"),
        (["--set", "friction_scale=2"], "--set: for one model"),
    ],
)
def test_wrong_words_are_refused_before_anything_is_built(words, told, capsys):
    assert main([*words]) == 2
    assert told in capsys.readouterr().err


# Slopes over the macro step: what the coupling of packs and driveline is worth.

NAMES = ("lock_time", "slip_energy", "peak_temperature")


@pytest.fixture(scope="module")
def limit():
    return macro_steps.small_step_limit(quick=True)


def errors(way, step, limit):
    found = figures(run(way, step))
    return [abs(found[name] - limit[0][name]) for name in NAMES]


def slopes(way, steps, limit):
    coarse, fine = (errors(way, step, limit) for step in steps)
    ratio = math.log(steps[0] / steps[1])
    return [math.log(a / b) / ratio for a, b in zip(coarse, fine, strict=True)]


@pytest.mark.slow
def test_both_masters_tend_to_one_limit(limit):
    truth, apart = limit
    assert apart["lock_time"] < 1e-5 * truth["lock_time"]
    assert apart["slip_energy"] < 5e-5 * truth["slip_energy"]


@pytest.mark.slow
@pytest.mark.parametrize("master", ["gauss-seidel", "jacobi"])
def test_held_capacities_couple_with_order_one(master, limit):
    lock, _, peak = slopes(Way(master, extrapolation=False), (8e-3, 2e-3), limit)
    assert lock == pytest.approx(1.0, abs=0.15) and peak == pytest.approx(1.0, abs=0.15)


@pytest.mark.slow
def test_extrapolated_capacities_couple_with_order_two_nearly(limit):
    """Lock-up and the release are corners: each run meets them elsewhere in its steps."""
    found = slopes(Way("jacobi"), (2e-3, 1e-3), limit)
    assert all(1.6 < slope < 2.4 for slope in found)


def test_a_handed_friction_torque_chatters_after_lock_up():
    result = run(Way("gauss-seidel", "torque"), 1e-3)
    assert "turns round" in complaint(result, figures(result))
    located = run(Way("gauss-seidel"), 1e-3)
    assert complaint(located, figures(located)) == ""


@pytest.mark.slow
def test_torques_that_look_ahead_hand_over_without_chatter(limit):
    """An eighth of the step, less than a twentieth of the error in lock-up."""
    way = Way("linearly-implicit", "torque")
    result = run(way, 2e-3)
    assert complaint(result, figures(result)) == ""
    found = [abs(errors(way, step, limit)[0]) for step in (8e-3, 1e-3)]
    assert found[1] < 0.05 * found[0] < 0.002


# What the corrections of the physics moved: the figures, and how the page shows them.


@pytest.fixture(scope="module")
def rows():
    return corrections()


@pytest.mark.slow
@slow_without_jit
def test_a_settled_pack_has_the_friction_that_the_rig_measured(rows):
    means = [r for r in rows if r["figure"].startswith("mean friction")]
    assert [r["after"] for r in means] == pytest.approx([0.053, 0.053], abs=1e-4)
    assert all(r["recorded"] and r["before"] > 1.2 * r["after"] for r in means)


@pytest.mark.slow
@slow_without_jit
def test_a_watt_of_loss_warms_the_flank_more_than_ten_times_as_much(rows):
    (flank,) = (r for r in rows if r["unit"] == "K/kW")
    assert flank["after"] > 10.0 * flank["before"] > 0.0


@pytest.mark.slow
@slow_without_jit
def test_the_chapter_has_a_line_for_each_figure_and_marks_recorded_ones(rows):
    (table,) = corrections_section(rows).tables
    assert len(table.rows) == len(rows)
    assert [row[3].endswith("*") for row in table.rows] == [r["recorded"] for r in rows]
