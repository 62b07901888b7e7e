"""The main job from the command line: one folder with a report, or nothing at all."""

import csv
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from built import built_fmu

from thrustwasher.cli import main
from thrustwasher.errors import SolveError
from thrustwasher.native import link

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def msl(tmp_path_factory):
    """Run the scene with a known answer once, with FMUs that are there already."""
    for model in ("ShiftTransmission", "WetClutch"):
        built_fmu(model, local=True)
    folder = tmp_path_factory.mktemp("shift") / "report"
    words = ["shift", "--scene", "msl", "--out", str(folder), "--json"]
    command = [sys.executable, "-m", "thrustwasher", *words]
    return folder, subprocess.run(command, capture_output=True, text=True, cwd=ROOT)


def test_json_is_one_object_and_nothing_else(msl):
    _, done = msl
    record = json.loads(done.stdout)
    assert done.returncode == 0
    assert done.stderr.splitlines() == [f"warning: {text}" for text in record["warnings"]]
    assert 0.0 < record["step_error"] < 1e-3 and record["step_advice"] == record["step"]
    assert {"lock_time", "energy", "energy_residual", "events", "cost", "wall_time"} <= set(record)
    assert record["lock_time"] == pytest.approx(2.1107904, abs=2e-4)
    assert [text[:6] for text in record["warnings"]] == ["Tie-up"]
    assert abs(record["energy_residual"]) < 1e-6 * record["energy"]["engine_work"]


def test_folder_holds_page_picture_and_series(msl):
    folder, _ = msl
    names = {path.name for path in folder.iterdir()}
    assert names == {"report.html", "try.html", "shift.csv", "overview.png"}
    with (folder / "shift.csv").open(encoding="utf-8") as stream:
        rows = csv.reader(stream)
        head = next(rows)
        assert head[0] == "time [s]" and all("[" in name for name in head)
        assert sum(1 for _ in rows) == 5001


def test_a_braking_test_is_compared_with_its_source(tmp_path, capsys):
    words = f"shift --scene brake-test-sample --step 4ms --out {tmp_path / 'r'} --json"
    assert main(words.split()) == 0
    told = json.loads(capsys.readouterr().out)
    said = {entry["name"]: entry for entry in told["published"]}
    assert said["friction_mean"]["published"] == 0.053
    assert said["friction_mean"]["run"] == told["friction_mean"] == pytest.approx(0.053, rel=2e-3)
    assert told["peak_brake_temperature"] > 350.0 and told["peak_brake_temperature_time"] > 1.0
    page = (tmp_path / "r" / "report.html").read_text("utf-8")
    assert "published and computed" in page and "engine" not in page.partition("<section")[0]


@pytest.mark.slow
def test_what_a_run_left_out_or_changed_is_said_on_the_screen(tmp_path, capsys):
    scene = tmp_path / "mine.toml"
    scene.write_text('base = "planetary"\n[sun_bearing]\ncoefficient = 0.0\n', "utf-8")
    words = ["shift", "--scene", str(scene), "--step", "25 ms", "--no-report"]
    assert main(words) == 0
    out, err = capsys.readouterr()
    assert "the sun's thrust of up to" in out and "warning: The communication step" in err
    assert main([*words, "--no-guard", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["messages"][0].startswith("the sun's thrust")
    assert told["step_error"] is None and told["warnings"] == []  # not looked at


@pytest.mark.slow
def test_numbers_alone_leave_no_file_and_load_no_tables(tmp_path):
    for model in ("ShiftTransmission", "WetClutch"):
        built_fmu(model, local=True)
    words = ["shift", "--scene", "msl", "--step", "5 ms", "--no-report", "--json"]
    code = (
        "import sys; from thrustwasher.cli import main; "
        f"status = main({words!r}); "
        "sys.exit(status or ', '.join({'pyarrow', 'matplotlib'} & set(sys.modules)) or 0)"
    )
    how = {"cwd": tmp_path, "env": {**os.environ, "PYTHONPATH": str(ROOT)}}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, **how)
    assert done.returncode == 0 and done.stderr.startswith("warning: Tie-up")
    assert json.loads(done.stdout)["out"] is None
    assert list(tmp_path.iterdir()) == []


def test_a_failure_leaves_nothing_behind(tmp_path, capsys, monkeypatch):
    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("thrustwasher.shift.ShiftResult.write_csv", fail)
    out = tmp_path / "new" / "r"
    assert main(["shift", "--scene", "msl", "--step", "5 ms", "--out", str(out)]) == 2
    assert "No space left" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def beside_builds(err):
    """Return what was said next to the FMUs that were built."""
    return [line for line in err.splitlines() if not re.fullmatch(r"built [\w, ]+ in \d+ s", line)]


def test_a_summary_names_lock_and_report_and_files_that_were_there_stay(tmp_path, capsys):
    (tmp_path / "notes.txt").write_text("mine")
    assert main(["shift", "msl", "--step", "4 ms", "--out", str(tmp_path)]) == 0
    text, err = capsys.readouterr()
    (said,) = beside_builds(err)
    assert said.startswith("warning: Tie-up"), "no progress bar in a pipe"
    assert "the clutch locked at 2.11" in text and str(tmp_path / "report.html") in text
    assert (tmp_path / "notes.txt").read_text() == "mine"


def test_a_tolerance_is_answered_with_a_level_and_its_reason_for_every_part(tmp_path, capsys):
    words = ["shift", "--scene", "msl", "--step", "4 ms", "--out", str(tmp_path / "r")]
    assert main([*words, "--fidelity", "auto:0.01"]) == 0
    text, err = capsys.readouterr()
    said = beside_builds(err)
    assert [line.split()[1] for line in said] == ["Tie-up:", "[clutch]", "[brake]"]
    for part in ("clutch", "brake"):
        assert any(line.startswith(f"{part}: ") for line in text.splitlines()), part
    assert "clutch: field, compared with fine at" in text
    page = (tmp_path / "r" / "report.html").read_text("utf-8")
    assert 'id="levels"' in page


SCATTERED = """
base = "msl"
[scatter]
"clutch.friction_scale" = { normal = "5 %", source = "estimate" }
"""


@pytest.fixture
def scattered(tmp_path):
    """Write a scene of which one input scatters."""
    scene = tmp_path / "scattered.toml"
    scene.write_text(SCATTERED, encoding="utf-8")
    return f"shift --scene {scene} --step 4ms --scatter 8 --out {tmp_path / 'r'}".split()


@pytest.mark.slow
def test_a_study_stands_in_report_and_json_and_beside_them(scattered, tmp_path, capsys):
    assert main([*scattered, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    study = told["scatter"]
    assert (study["runs"], study["solves"], study["failed"]) == (8, 24, 0)
    band = study["figures"]["lock_time"]
    assert band["quantiles"]["0.05"] < told["lock_time"] < band["quantiles"]["0.95"]
    report = (tmp_path / "r" / "report.html").read_text(encoding="utf-8")
    live, link = re.findall(r'href="([^"#]+)"', report)
    assert live == "try.html"
    page = (tmp_path / "r" / link).read_text(encoding="utf-8")
    assert 'id="how-sure"' in report and "clutch: friction scale" in page
    links = re.findall(r'href="([^"#]+)"', page)
    assert links and all((tmp_path / "r" / link).with_name(name).is_file() for name in links)
    assert {p.suffix for p in (tmp_path / "r").iterdir()} == {".html", ".png", ".csv", ""}


@pytest.mark.slow
def test_a_report_that_cannot_be_written_loses_no_run_of_its_study(scattered, tmp_path, capsys):
    (tmp_path / "r" / "shift.csv").mkdir(parents=True)
    assert main(scattered) == 2 and "keeps 24 of 24 runs" in capsys.readouterr().err
    (tmp_path / "r" / "shift.csv").rmdir()
    assert main(scattered) == 0 and "24 of them done before" in capsys.readouterr().err


def test_a_study_that_fails_leaves_the_shift(scattered, tmp_path, capsys, monkeypatch):
    def fails(*_, **__):
        raise SolveError("none of the runs has a solution")

    monkeypatch.setattr("thrustwasher.studio.scatter.propagate.propagate", fails)
    assert main(scattered) == 3
    assert capsys.readouterr().err.endswith("none of the runs has a solution\n")
    report = (tmp_path / "r" / "report.html").read_text(encoding="utf-8")
    assert "Key figures" in report and 'id="how-sure"' not in report
    assert (tmp_path / "r" / "shift.csv").is_file()


def test_a_missing_linker_is_said_before_anything_is_compiled(monkeypatch, capsys, tmp_path):
    made = []
    monkeypatch.setattr("thrustwasher.fmu.shell.platform_libraries.is_shipped", lambda spec: False)
    monkeypatch.setattr("thrustwasher.native.link._of_this_machine", lambda: None)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    monkeypatch.setattr("thrustwasher.cli.shift._scene", lambda *given: made.append(given))
    link.find_linker.cache_clear()
    link.local_linker.cache_clear()
    assert main(["shift", "--out", str(tmp_path / "r")]) == 2
    assert "need a C compiler to be built" in capsys.readouterr().err and not made
