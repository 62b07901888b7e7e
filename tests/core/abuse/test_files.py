"""Spoiled files are refused by name or mean what they say; nothing in between."""

import json
from pathlib import Path

import files
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sampling import sizes

from examples import examples

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
