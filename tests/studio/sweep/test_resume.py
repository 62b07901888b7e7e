"""A stopped sweep goes on; another one is refused; files are whole or not there."""

import csv
import time

import needed
import numpy as np
import pytest
from stopping import Stop, stopping_after

from thrustwasher import ParameterError, run_sweep
from thrustwasher.storage.journal import Journal
from thrustwasher.studio.sweep import run_sweep as runs
from thrustwasher.studio.sweep.run_sweep import journal_of

OVER = {"load": "10:200:10", "speed": "50:300:50"}


def stopped(out, over=OVER, after=60):
    with pytest.raises(Stop):
        run_sweep("gearmesh", over, out=out, workers=1, progress=stopping_after(after))


@pytest.fixture
def solved(monkeypatch):
    """Count the points that are solved."""
    counts = []

    solve = runs.solve_piece

    def counting(evaluator, figures, piece):
        counts.append(len(piece.rows))
        return solve(evaluator, figures, piece)

    monkeypatch.setattr(runs, "solve_piece", counting)
    return counts


def test_a_stopped_sweep_goes_on_and_ends_as_if_never_stopped(tmp_path, solved):
    run_sweep("gearmesh", OVER, out=tmp_path / "whole.csv", workers=1)
    out = tmp_path / "stopped.csv"
    stopped(out)
    assert journal_of(out).exists() and not out.exists()
    solved.clear()
    run_sweep("gearmesh", OVER, out=out, workers=1)
    assert sum(solved) == 120 - 60
    assert out.read_bytes() == (tmp_path / "whole.csv").read_bytes()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["stopped.csv", "whole.csv"]


@pytest.mark.parametrize("spoil", ["cut", "changed"])
def test_a_spoiled_journal_is_refused_by_name(tmp_path, spoil):
    out = tmp_path / "map.csv"
    stopped(out)
    data = bytearray(journal_of(out).read_bytes())
    if spoil == "cut":
        del data[-5000:]
    else:
        data[-7] ^= 0xFF
    journal_of(out).write_bytes(data)
    with pytest.raises(ParameterError, match=r"map\.csv\.journal: .*spoiled.*; remove it"):
        run_sweep("gearmesh", OVER, out=out, workers=1)
    assert journal_of(out).read_bytes() == data


def test_a_journal_is_on_disk_after_a_second_and_a_crash_costs_no_more(tmp_path, monkeypatch):
    path, rows = tmp_path / "x.journal", np.ones((2, 3))
    now = time.monotonic()
    monkeypatch.setattr(time, "monotonic", lambda: now)
    crashed = Journal(path, {"of": "a test"})
    assert list(crashed.blocks(3, 1)) == []
    crashed.append(0, rows, np.ones((2, 1), np.int32))  # committed: the first
    assert crashed._waiting == []
    crashed.append(2, rows, np.ones((2, 1), np.int32))
    now += 1.0
    crashed.append(4, rows, np.ones((2, 1), np.int32))  # and a second later
    crashed.append(6, rows, np.ones((2, 1), np.int32))
    crashed._db.close()
    numbers, flags = np.zeros((8, 3)), np.zeros((8, 1), np.int32)
    again = Journal(path, {"of": "a test"})
    assert again.load(numbers, flags).tolist() == [True] * 6 + [False] * 2
    assert numbers.sum() == 18.0 and flags.sum() == 6
    again.close(finished=True)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("changed", "says"),
    [
        ({"over": {**OVER, "speed": "50:300:25"}}, "speed"),
        ({"at": {"oil_temperature": 320.0}}, "oil_temperature"),
        ({"at": {"steel": "AISI1020"}}, "parameters"),
        ({"fidelity": "fine"}, "fidelity"),
    ],
)
def test_another_sweep_is_refused_and_what_differs_is_named(tmp_path, changed, says):
    out = tmp_path / "map.csv"
    stopped(out)
    before = journal_of(out).read_bytes()
    with pytest.raises(ParameterError) as caught:
        run_sweep("gearmesh", **{"over": OVER, "out": out, "workers": 1, **changed})
    assert says in str(caught.value) and "another sweep" in str(caught.value)
    assert journal_of(out).read_bytes() == before


def test_a_foreign_file_in_the_journals_place_is_refused(tmp_path):
    out = tmp_path / "map.csv"
    journal_of(out).write_text("my notes\nmore\n")
    with pytest.raises(ParameterError, match="no journal"):
        run_sweep("gearmesh", OVER, out=out, workers=1)
    assert journal_of(out).read_text() == "my notes\nmore\n"


def test_a_journal_that_another_run_writes_is_refused(tmp_path):
    out = tmp_path / "map.csv"

    def second(done, total):
        if done:
            with pytest.raises(ParameterError, match="another run"):
                run_sweep("gearmesh", OVER, out=out, workers=1)
            raise Stop

    with pytest.raises(Stop):
        run_sweep("gearmesh", OVER, out=out, workers=1, progress=second)


def test_csv_has_units_in_its_head_full_precision_and_empty_cells_for_failures(tmp_path):
    out = tmp_path / "map.csv"
    table = run_sweep("gearmesh", {"speed": [0.0, 100.0]}, at={"power": 1e4}, out=out, workers=1)
    with out.open(newline="") as stream:
        head, failed, good = csv.reader(stream)
    assert head[:4] == ["power [W]", "load [N.m]", "speed [rad/s]", "oil_temperature [K]"]
    assert head[-1] == "status" and "friction_coefficient" in head
    cells = dict(zip(head, failed, strict=True))
    assert cells["status"] == "BAD_INPUT" and cells["friction_torque [N.m]"] == ""
    assert float(good[head.index("friction_torque [N.m]")]) == table["friction_torque"][1]


@pytest.mark.slow
def test_polars_reads_the_parquet_file(tmp_path):
    needed.package("pyarrow")
    polars = pytest.importorskip("polars")
    out = tmp_path / "map.parquet"
    table = run_sweep("clutch", {"load": (1e3, 2e3)}, at={"speed": 2.0}, out=out)
    read = polars.read_parquet(out)
    assert read["friction_torque"].to_list() == table["friction_torque"].tolist()
    assert read["status"].to_list() == ["OK", "OK"]


def test_parquet_holds_the_same_numbers_and_null_for_failures(tmp_path):
    parquet = needed.package("pyarrow.parquet")
    out = tmp_path / "map.parquet"
    over = {"speed": [0.0, 100.0, 200.0]}
    table = run_sweep("gearmesh", over, at={"power": 1e4}, out=out, workers=1)
    read = parquet.read_table(out)
    assert read.column_names == list(table.columns)
    assert read.schema.field("load").metadata == {b"unit": b"N.m"}
    for name in ("friction_torque", "film_ratio"):
        first, *rest = read[name].to_pylist()
        assert first is None and rest == table[name][1:].tolist()
    assert read["status"].to_pylist() == table["status"].tolist()


def test_a_run_that_was_killed_when_all_was_solved_leaves_no_file_of_the_journal(tmp_path):
    """SQLite leaves its own journal behind then; a run with nothing to add does not open it."""
    out = tmp_path / "map.csv"
    stopped(out, after=120)
    (tmp_path / "map.csv.journal-journal").write_bytes(bytes(512))
    run_sweep("gearmesh", OVER, out=out, workers=1)
    assert [p.name for p in tmp_path.iterdir()] == ["map.csv"]
