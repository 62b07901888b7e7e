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


@pytest.fixture(scope="module")
def msl(tmp_path_factory):
    """Run the scene with a known answer once, with FMUs that are there already."""
    for model in ("ShiftTransmission", "WetClutch"):
        built_fmu(model, local=True)
    folder = tmp_path_factory.mktemp("shift") / "report"
    words = ["shift", "--scene", "msl", "--out", str(folder), "--json"]
    done = subprocess.run(
        [sys.executable, "-m", "thrustwasher", *words],
        capture_output=True,
        text=True,
        check=False,
        cwd=Path(__file__).parents[2],
    )
    return folder, done


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
    assert names == {"report.html", "shift.csv", "overview.png"}
    with (folder / "shift.csv").open(encoding="utf-8") as stream:
        rows = csv.reader(stream)
        head = next(rows)
        assert head[0] == "time [s]" and all("[" in name for name in head)
        assert sum(1 for _ in rows) == 5001


def test_a_braking_test_is_compared_with_its_source(tmp_path, capsys):
    words = [
        "shift",
        "--scene",
        "brake-test-sample",
        "--step",
        "4 ms",
        "--out",
        str(tmp_path / "r"),
    ]
    assert main([*words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    said = {entry["name"]: entry for entry in told["published"]}
    assert said["friction_mean"]["published"] == 0.053
    assert said["friction_mean"]["run"] == told["friction_mean"] == pytest.approx(0.053, rel=2e-3)
    assert told["peak_brake_temperature"] > 350.0 and told["peak_brake_temperature_time"] > 1.0
    page = (tmp_path / "r" / "report.html").read_text("utf-8")
    assert "published and computed" in page and "engine" not in page.partition("<section")[0]


def test_summary_names_lock_and_report(tmp_path, capsys):
    out = tmp_path / "r"
    assert main(["shift", "--scene", "msl", "--step", "4 ms", "--out", str(out)]) == 0
    text, err = capsys.readouterr()
    assert err.startswith("warning: Tie-up") and err.count("\n") == 1, "no progress bar in a pipe"
    assert "the clutch locked at 2.11" in text and str(out / "report.html") in text


def test_what_a_run_left_out_or_changed_is_said_on_the_screen(tmp_path, capsys):
    scene = tmp_path / "mine.toml"
    scene.write_text('base = "planetary"\n[sun_bearing]\ncoefficient = 0.0\n', "utf-8")
    words = ["shift", "--scene", str(scene), "--step", "20 ms", "--no-guard", "--no-report"]
    assert main(words) == 0
    assert "the sun's thrust of up to" in capsys.readouterr().out
    assert main([*words, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["messages"][0].startswith("the sun's thrust")


def test_numbers_alone_leave_no_file_and_load_no_tables(tmp_path):
    for model in ("ShiftTransmission", "WetClutch"):
        built_fmu(model, local=True)
    words = ["shift", "--scene", "msl", "--step", "5 ms", "--no-report", "--json"]
    code = (
        "import sys; from thrustwasher.cli import main; "
        f"status = main({words!r}); "
        "sys.exit(status or ', '.join({'pyarrow', 'matplotlib'} & set(sys.modules)) or 0)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])},
    )
    assert done.returncode == 0 and done.stderr.startswith("warning: Tie-up")
    assert json.loads(done.stdout)["out"] is None
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "[transmission]\nplanets = 14",
            "planets = 14, allowed: so many that their tips do not meet",
        ),
        (
            "[pressure.clutch]\npoints = [[0.2, 0.0], [0.1, 1e5]]",
            "clutch_pressure_time_2 = 0.1 s, allowed: above",
        ),
        (
            "[pressure.clutch]\npoints = [[0.2, -1.0]]",
            "clutch_pressure_1 = -1.0 Pa, allowed: 0 .. ",
        ),
        ("[shift]\nstart = 0.1", "[shift] beside [pressure], allowed: a ramp or profiles"),
        ("[transmission]\ncarrier_inertia = 8.0", "carrier_inertia = 8.0 beside a table"),
        (
            '[oil]\nviscosity = [["40 degC", "5 mPa.s"], ["100 degC", "15 mPa.s"]]',
            "viscosity = 0.015 Pa.s at 100 degC, allowed: above 0 and below that at 40 degC",
        ),
        ('[clutch]\ngroove_width = "30 mm"', "groove_width = 0.03 m, allowed: below"),
        ("[sump]\nvolume = 0.0", "volume = 0.0 m3, allowed: 1e-06 .. 100 m3"),
        ('[transmission]\nhelix_angle = "45.5 deg"', " rad, allowed: 0 .. 0.785398 rad"),
        ('[mesh]\nhelix_angle = "45.5 deg"', " rad, allowed: 0 .. 0.785398 rad"),
        ("[mesh]\naddendum = 0.3", "the contact ratio is 0.4984, allowed: 1 and more"),
    ],
)
def test_a_scene_that_cannot_be_is_refused_in_one_line(text, said, tmp_path, capsys):
    scene = tmp_path / "mine.toml"
    scene.write_text(f'base = "planetary"\n{text}\n', "utf-8")
    assert main(["shift", "--scene", str(scene), "--out", str(tmp_path / "report")]) == 2
    out, err = capsys.readouterr()
    assert said in err and err.count("\n") == 1 and out == ""
    assert list(tmp_path.iterdir()) == [scene]


def test_a_failure_leaves_nothing_behind(tmp_path, capsys, monkeypatch):
    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("thrustwasher.shift.ShiftResult.write_csv", fail)
    out = tmp_path / "new" / "r"
    assert main(["shift", "--scene", "msl", "--step", "5 ms", "--out", str(out)]) == 2
    assert "No space left" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_files_that_were_there_stay(tmp_path, capsys):
    (tmp_path / "notes.txt").write_text("mine")
    assert main(["shift", "--scene", "msl", "--step", "5 ms", "--out", str(tmp_path)]) == 0
    assert (tmp_path / "notes.txt").read_text() == "mine"
    capsys.readouterr()


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--scene", "planetray"], ["planetray", "planetary"]),
        (["--scene", "none.toml"], ["none.toml"]),
        (["--master", "magic"], ["master", "magic", "jacobi"]),
        (["--step", "1 h"], ["step", "'1 h'", "ms"]),
        (["--step", "10 s"], ["step", "10", "s"]),
        (["--fmu", "stone"], ["stone", "native", "python"]),
        (["--platforms", "linux64"], ["--platforms", "--ssp"]),
        (["--ssp", "shift.zip"], ["shift.zip", ".ssp"]),
        (["--ssp", "/proc/none/x.ssp"], ["--ssp", "/proc/none"]),
        (["--ssp", "x.ssp", "--fmu", "python"], ["--fmu python", "native"]),
        (["--ssp", "x.ssp", "--master", "gauss-seidel"], ["gauss-seidel", "parallel"]),
        (["--ssp", "x.ssp", "--platforms", "linux64,amiga"], ["amiga", "win64", "local"]),
        (["--out", "file"], ["file", "folder"]),
    ],
)
def test_wrong_words_are_refused_before_any_work(words, named, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("file").write_text("x")
    monkeypatch.setattr("thrustwasher.cli.shift._fmu_instances", lambda *_: pytest.fail("it began"))
    assert main(["shift", *words]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1
    assert [text for text in named if text not in err] == []
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


def test_a_tolerance_is_answered_with_a_rung_and_its_reason_for_every_part(tmp_path, capsys):
    words = ["shift", "--scene", "msl", "--step", "4 ms", "--out", str(tmp_path / "r")]
    assert main([*words, "--fidelity", "auto:0.01"]) == 0
    text, err = capsys.readouterr()
    said = [line for line in err.splitlines() if not re.fullmatch(r"built [\w, ]+ in \d+ s", line)]
    assert [line.split()[1] for line in said] == ["[clutch]", "[brake]", "Tie-up:"]
    for part in ("clutch", "brake"):
        assert any(line.startswith(f"{part}: ") for line in text.splitlines()), part
    assert "clutch: field, compared with fine at" in text
    page = (tmp_path / "r" / "report.html").read_text("utf-8")
    assert 'id="rungs"' in page


def test_json_says_what_was_checked_how_far_off_it_was_and_what_ran_again(capsys):
    words = ["shift", "--scene", "planetary", "--step", "4 ms", "--no-report", "--json"]
    words += ["--fidelity", "auto:0.05"]
    assert main(words) == 0
    told = json.loads(capsys.readouterr().out)["guard"]
    assert [c["part"] for c in told["checks"]] == ["clutch", "brake", "washer"]
    assert told["run_again"] == []
    check = told["checks"][-1]
    assert check["holds"] and 20 <= check["points"] <= 40 and check["failed"] == []
    assert 0.0 < check["worst"]["share"] < check["tolerance"] == 0.05


@pytest.mark.parametrize(
    ("wish", "told"),
    [("auto:9", "auto:TOLERANCE"), ("map=field", "no part 'map'"), ("quick", "'quick', allowed")],
)
def test_a_wrong_fidelity_is_refused_before_any_work(wish, told, tmp_path, capsys):
    assert main(["shift", "--fidelity", wish, "--out", str(tmp_path / "r")]) == 2
    assert told in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_package_takes_rungs_by_name_only(tmp_path, capsys):
    words = ["shift", "--scene", "msl", "--ssp", str(tmp_path / "s.ssp")]
    assert main([*words, "--fidelity", "auto"]) == 2
    assert "a rung by name" in capsys.readouterr().err


def test_a_step_that_is_too_long_is_a_warning_before_the_figures(capsys):
    words = ["shift", "--scene", "planetary", "--step", "25 ms", "--no-report"]
    assert main([*words, "--json"]) == 0
    out, err = capsys.readouterr()
    told = json.loads(out)
    (said,) = [text for text in told["warnings"] if text.startswith("The communication step")]
    assert f"warning: {said}" in err and told["step_advice"] < told["step"] == 0.025
    assert 0.01 < told["step_error"] < 0.03
    assert main([*words, "--no-guard", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["step_error"] is None and told["warnings"] == []


def test_a_step_above_a_twentieth_of_the_shift_is_refused(capsys):
    assert main(["shift", "--step", "0.5", "--no-report"]) == 2
    assert "up to 41.75 ms, a twentieth of the shift" in capsys.readouterr().err


def test_two_shifts_are_compared_a_report_and_a_scene(msl, tmp_path, capsys):
    folder, _ = msl
    out = tmp_path / "both"
    words = ["shift", "--compare", str(folder), "msl", "--step", "4 ms", "--out", str(out)]
    assert main(words) == 0
    text, err = capsys.readouterr()
    assert [line[:18] for line in err.splitlines()] == [f"warning: {n}: Tie-up" for n in "AB"]
    assert [path.name for path in out.iterdir()] == ["compare.html"]
    locks = next(line for line in text.splitlines() if line.startswith("clutch locks: "))
    assert locks.startswith("clutch locks: A 2.11") and ", B 2.11" in locks
    page = (out / "compare.html").read_text("utf-8")
    assert page.count("<img") == 2 and str(out / "compare.html") in text


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (["{tmp}", "msl"], "the folder has no report.html"),
        (["msl", "duty-cycle"], "--compare duty-cycle: has several shifts, allowed: one each"),
        (["msl", "msl", "--no-report"], "--compare: not together with --no-report"),
        (["msl", "msl", "--ssp", "a.ssp"], "--compare: not together with --ssp"),
    ],
)
def test_what_cannot_be_compared_is_said_before_anything_is_written(given, words, tmp_path, capsys):
    given = [word.format(tmp=tmp_path) for word in given]
    out = tmp_path / "out"
    assert main(["shift", "--compare", *given, "--out", str(out)]) == 2
    assert words in capsys.readouterr().err
    assert not out.exists()
