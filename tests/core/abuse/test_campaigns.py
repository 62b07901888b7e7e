"""Spoiled files are refused by name or mean what they say; nothing in between."""

import json
from pathlib import Path

import calls
import files
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sampling import sizes

from examples import examples
from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.registry import find_spec

randoms = st.randoms(use_true_random=False)
MEASURED = Path(__file__).with_name("measured.csv")


def spoil(deed, n):
    """Try ``n`` spoiled files."""

    @examples(n)
    @given(rng=randoms)
    def one(rng):
        deed(rng)

    one()


KINDS = [
    (files.Scenes, 150),
    (files.Cards, 100),
    (files.Maps, 150),
    (files.SweepJournals, 30),
    (files.MapJournals, 50),
]


@pytest.mark.parametrize(
    ("kind", "n"),
    [
        *((kind, n // 10) for kind, n in KINDS),
        *(pytest.param(kind, n, marks=pytest.mark.abuse) for kind, n in KINDS),
    ],
)
def test_a_spoiled_file_is_refused_by_name_or_means_what_it_says(kind, n, tmp_path):
    spoil(kind(tmp_path), n)


@sizes(2, 6, pytest.mark.abuse)
def test_a_spoiled_calibration_file_is_refused_or_fitted(tmp_path, n):
    spoil(files.Calibrations(tmp_path, MEASURED.read_bytes()), n)


@sizes(10, 60, pytest.mark.abuse)
def test_a_chart_that_was_changed_is_not_drawn(tmp_path, n):
    spoil(files.Charts(tmp_path, files.chart_record(), draw=False), n)


def test_half_a_chart_is_refused_in_one_line(tmp_path):
    record = files.chart_record()
    for key in ("models", "machine"):
        half = {k: v for k, v in record.items() if k != key}
        (tmp_path / "half.json").write_text(json.dumps(half))
        status, _, said = files.command(
            "chart", "--draw", tmp_path / "half.json", "--out", tmp_path
        )
        assert (status, said.count("\n")) == (2, 1) and f"'{key}'" in said and "half.json" in said


@sizes(5, 30, pytest.mark.abuse)
def test_a_spoiled_fmu_is_refused_by_name(tmp_path, fmu_of, n):
    spoil(files.Archives(tmp_path, fmu_of("gearmesh", "native-fmi2")), n)


# Whatever a master does to an instance: right outputs or a named error, and it lives on.

MOVES = 12
LEVELS = {"map": 10, "field": 1}  # of the washer: examples
walks = st.lists(st.randoms(use_true_random=False), min_size=MOVES, max_size=MOVES)


NATIVE, PYTHON = "native-fmi2", "python-fmi2"
MASTERS = [  # model, kind, parameters, examples; the first by default
    *((m, k, {}, 12) for m in ("clutch", "gearmesh", "transmission") for k in (NATIVE, PYTHON)),
    ("clutch", "native-fmi3", {}, 12),
    *(("washer", k, {"fidelity": r}, n) for k in (NATIVE, PYTHON) for r, n in LEVELS.items()),
]


@pytest.mark.parametrize(
    ("model", "kind", "parameters", "n"),
    [MASTERS[0], *(pytest.param(*one, marks=pytest.mark.abuse) for one in MASTERS[1:])],
)
def test_a_wild_master_gets_right_outputs_or_named_errors(model, kind, parameters, n, instance_of):
    instance = instance_of(model, kind, parameters)

    @examples(n)
    @given(rngs=walks)
    def wild(rngs):
        instance.reset()
        judged = calls.Walk(find_spec(model), instance)
        for rng in rngs:
            judged.move(rng)
        assert sum(judged.counts.values()) == len(rngs)

    wild()


@sizes(8, 40, pytest.mark.abuse)
@pytest.mark.parametrize("model", ["clutch", "gearmesh", "transmission"])
def test_any_parameters_run_or_are_refused_by_name(model, n):
    @examples(n)
    @given(rng=st.randoms(use_true_random=False))
    def one(rng):
        calls.run_once(model, rng, lambda spec, changed: DirectInstance(spec, parameters=changed))

    one()


# Whatever is asked of the Python functions: a right answer, or a refusal by name.


@pytest.fixture(scope="module", params=["clutch", "gearmesh", "washer"])
def model(request):
    """A model that answers a sane call after all the others as it did before."""
    before = calls.sane_bits(request.param)
    yield request.param
    assert calls.sane_bits(request.param) == before


@sizes(20, 80, pytest.mark.abuse)
def test_any_call_is_answered_right_or_refused_by_name(model, n):
    @examples(n)
    @given(rng=randoms)
    def one(rng):
        calls.solve_once(model, rng)

    one()
