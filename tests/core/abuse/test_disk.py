"""A full disk or one that may not be written to: one line, nothing half, nothing lost."""

import json
import sys
from contextlib import closing, suppress
from pathlib import Path

import pytest
from disk import full_disk
from files import chart_record, command

from thrustwasher import WasherParams
from thrustwasher.cli import main
from thrustwasher.native.files import write
from thrustwasher.storage import journal
from thrustwasher.studio.sweep import run_sweep as runs

MEASURED = Path(__file__).with_name("measured.csv")
SWEEP = "sweep gearmesh --over load=10:200:10 --over speed=50:300:50 --workers 1 --out".split()
MAP = (
    "map build --load 300:400 --speed 540:550 --tilt 0.002 --oil-temperature 297.15 "
    "--fidelity field --workers 1 --points 2 --out"
).split()


def refused(folder, *words, left=()):
    """The command ends with one line and status 2, and leaves just this in the folder.

    A line before it says which journal keeps what was solved.
    """
    status, _, said = command(*words)
    lines = [line for line in said.splitlines() if not line.startswith("warning")]
    lines = [line for line in lines if ".journal keeps " not in line]
    assert status == 2 and len(lines) == 1 and "defect" not in said, said
    assert sorted(p.name for p in folder.rglob("*")) == sorted(left)
    if left or "File too large" in lines[0]:
        assert str(folder) in lines[0], "it names the file"
    return lines[0]


@pytest.fixture
def out(tmp_path):
    folder = tmp_path / "out"
    folder.mkdir()
    return folder


def test_curves_engagements_and_plots_on_a_full_disk_leave_nothing(out):
    point = ["--speed", "50", "--load", "9000", "--step", "0.1"]
    assert command("engage", *point)[0] == 0  # compiled while there is room
    for words in (
        ["curve", "--speed", "545", "--tilt", "0.002", "--grid", "5x8", "--out", out / "c.csv"],
        ["engage", *point, "--out", out / "e.csv"],
        ["clutch", "--plot", out / "fit.png"],
    ):
        with full_disk(100):
            assert "File too large" in refused(out, *words)


def test_a_sweep_whose_journal_fills_the_disk_goes_on_later(out, monkeypatch):
    table = out / "map.csv"
    assert command(*SWEEP, table)[0] == 0
    whole = table.read_bytes()
    table.unlink()
    solved = []
    solve = runs.solve_piece
    monkeypatch.setattr(
        runs, "solve_piece", lambda *job: (solved.append(len(job[2].rows)), solve(*job))[1]
    )
    monkeypatch.setattr(journal, "INTERVAL", 0.0)
    with full_disk(20_000):
        refused(out, *SWEEP, table, left=["map.csv.journal"])
    done = sum(solved) - solved[-1]
    assert done > 0
    solved.clear()
    assert command(*SWEEP, table)[0] == 0
    assert sum(solved) == 120 - done and table.read_bytes() == whole
    assert [p.name for p in out.iterdir()] == ["map.csv"]


def test_of_what_waits_a_journal_keeps_what_there_is_room_for(out, monkeypatch):
    monkeypatch.setattr(journal, "INTERVAL", 1e9)
    kept = journal.Journal(out / "x.journal", {})
    for k in range(20):
        kept.put(k, bytes(4000))
    with full_disk(50_000), pytest.raises(OSError, match=r"x\.journal"):
        kept.close()
    with closing(journal.Journal(out / "x.journal", {})) as again:
        found = [k for k, _ in again.entries()]
    assert found == list(range(len(found))) and 5 < len(found) < 12
    assert [p.name for p in out.iterdir()] == ["x.journal"]


def test_a_sweep_whose_table_does_not_fit_is_not_solved_again(out, monkeypatch):
    table = out / "map.csv"
    assert command(*SWEEP, table)[0] == 0
    whole = table.read_bytes()
    table.unlink()
    with full_disk(len(whole) - 1):
        refused(out, *SWEEP, table, left=["map.csv.journal"])
    monkeypatch.setattr(runs, "solve_piece", None)
    assert command(*SWEEP, table)[0] == 0
    assert table.read_bytes() == whole


@pytest.mark.slow  # a sweep shows it in short
def test_a_map_whose_lines_fill_the_disk_goes_on_later(out, tmp_path, monkeypatch):
    from thrustwasher.washer.kernels.map import map_layout as L
    from thrustwasher.washer.map.look_up import WasherMap
    from thrustwasher.washer.map.map_file import read_map

    file, kept, append = out / "x.twm", [], journal.Journal.append
    assert command(*MAP, tmp_path / "whole.twm")[0] == 0
    whole = read_map(tmp_path / "whole.twm")
    lines, numbers = whole.metadata["lines"], whole.data.size - L.DATA
    monkeypatch.setattr(
        journal.Journal, "append", lambda *given: (append(*given), kept.append(given[1]))
    )
    monkeypatch.setattr(journal, "INTERVAL", 0.0)
    with full_disk(12_288 + int(2.9 * 8 * numbers / lines)):
        refused(out, *MAP, file, left=["x.twm.journal"])
    assert 0 < len(kept) < lines
    assert command(*MAP, file)[0] == 0
    assert sorted(kept) == list(range(lines)) and [p.name for p in out.iterdir()] == ["x.twm"]
    # a line begins from its neighbour where that is known: equal to what solutions converge to
    again, at_once = (
        WasherMap(WasherParams(), path).torque(350.0, 545.0, 2e-3, 297.15)
        for path in (file, tmp_path / "whole.twm")
    )
    assert again == pytest.approx(at_once, rel=1e-5)


def test_a_chart_that_does_not_fit_is_not_half_written(out, tmp_path):
    (tmp_path / "in.json").write_text(json.dumps(chart_record()))
    with full_disk(200):
        refused(out, "chart", "--draw", tmp_path / "in.json", "--out", out)


def test_an_fmu_that_does_not_fit_is_not_half_written(out):
    made = out / "A.fmu"
    made.write_bytes(b"of an earlier build")
    with full_disk(60_000), pytest.raises(OSError, match="too large") as full:
        write(made, b"x" * 70_000)
    assert full.value.filename == str(made) and [p.name for p in out.iterdir()] == ["A.fmu"]
    assert made.read_bytes() == b"of an earlier build"


@pytest.mark.abuse
def test_a_report_that_does_not_fit_leaves_the_folder_as_it_was(out, tmp_path):
    words = ["shift", "--scene", "msl", "--step", "5 ms", "--out"]
    assert command(*words, tmp_path / "first")[0] == 0  # built and compiled while there is room
    (out / "overview.png").write_text("of an earlier run")
    with full_disk(20_000):
        refused(out, *words, out, left=["overview.png"])
    assert (out / "overview.png").read_text() == "of an earlier run"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize("words", [["clutch", "--json"], ["clutch", "--help"], ["--version"]])
def test_standard_output_that_cannot_be_written_is_said(words, monkeypatch, capsys):
    full = open("/dev/full", "w")  # its end fails as its flush does
    monkeypatch.setattr(sys, "stdout", full)
    assert main(words) == 2
    monkeypatch.undo()
    with suppress(OSError):
        full.close()
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "standard output: No space left" in said


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="needs a folder nobody can write to")
@pytest.mark.parametrize(
    "words",
    [
        "curve --speed 545 --tilt 0.002 --out /proc/x/c.csv",
        f"calibrate {MEASURED} --plot /proc/x/fit.png",
        "shift --out /proc/x",
        "shift --ssp /proc/x/s.ssp",
        "build --out /proc/x",
        "chart --out /proc/x",
        f"{' '.join(SWEEP)} /proc/x/t.csv",
        f"{' '.join(MAP)} /proc/x/m.twm",
    ],
)
def test_where_nothing_may_be_written_no_work_begins(words, tmp_path):
    assert "/proc/x" in refused(tmp_path, *words.split())
