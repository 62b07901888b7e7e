"""The page of where methods fail is written from the record, and only when it can be."""

import pytest

from thrustwasher.cli import main
from thrustwasher.report.stability_page import stability_markdown

GROUP = {
    "name": "films", "judged": "load off", "methods": ["good", "bad"], "hazards": ["a", "b"],
    "cells": [
        [{"verdict": "ok", "figure": "", "words": ""},
         {"verdict": "says", "figure": "", "words": "SolveError: no way"}],
        [{"verdict": "LIES", "figure": "-20 %", "words": "load off"},
         {"verdict": "slow", "figure": "9 sweeps", "words": ""}],
    ],
}  # fmt: skip
RECORD = {
    "stability": [GROUP],
    "limits": [{"loop": "held", "formula": "H < 2 J/c", "predicted": 2.0, "measured": 2.002,
                "deviation": 1e-3}],
    "machine": {"cpu": "a cpu", "cores": 2, "os": "an os", "python": "3", "numpy": "2",
                "numba": "1", "load": 0.1},
    "package": {"version": "0", "commit": "abc", "dirty": False}, "date": "today",
}  # fmt: skip


def test_cells_legend_limits_and_machine_are_there():
    page = stability_markdown(RECORD)
    assert "| good | ok | says SolveError |" in page
    assert "| bad | **LIES** -20 % | slow 9 sweeps |" in page
    assert "1 of 4 answers are wrong without a word." in page
    assert "| held | H < 2 J/c | 2 | 2.002 | +0.10 % |" in page
    assert "a cpu" in page and "commit abc" in page


def test_a_table_row_has_as_many_cells_as_its_head():
    rows = [r for r in stability_markdown(RECORD).splitlines() if r.startswith("|")]
    assert {r.count("|") for r in rows} == {3, 4, 6}


@pytest.mark.parametrize(
    "words",
    [("--only", "stability", "--draw", "x.json"), ("--only", "accuracy"),
     ("--only", "stability", "--out", "/proc/x.md")],
)  # fmt: skip
def test_what_cannot_be_written_is_refused_before_anything_is_measured(words, capsys):
    try:
        code = main(["chart", *words])
    except SystemExit as refused:
        code = refused.code
    assert code == 2
    assert "Traceback" not in capsys.readouterr().err
