"""Timing of single steps: what is walked through, what is counted, what is refused."""

import json

import needed
import numpy as np
import pytest

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
