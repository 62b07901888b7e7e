"""The command line answers bad input with one line and good input with one object."""

import json
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest

from thrustwasher import cli
from thrustwasher.cli import main
from thrustwasher.errors import BranchError, EnvironmentProblem, ParameterError, SolveError
from thrustwasher.models.clutch_params import SPEC as CLUTCH
from thrustwasher.models.gearmesh_params import SPEC as GEARMESH
from thrustwasher.models.washer_params import SPEC as WASHER

DOCS = Path(__file__).parents[2] / "docs"


def one_line(capsys):
    """Return the only line on standard error; standard output must be empty."""
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1 and err.endswith("\n")
    assert "Traceback" not in err
    return err


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["frobnicate"], ["frobnicate", "washer", "doctor"]),
        (["gearbox", "--power", "7500"], ["gearbox", "gearmesh"]),
        (["--frobnicate"], ["--frobnicate"]),
        (["washer", "--load", "abc"], ["load", "'abc'", "N"]),
        (["washer", "--load", "nan"], ["load", "'nan'", "N"]),
        (["washer", "--load"], ["--load"]),
        (["washer", "--load", "-300 N"], ["load", "-300", "N"]),
        (["washer", "--tilt", "30 deg"], ["tilt", "0.52", "rad"]),
        (["washer", "--oil-temperature", "3 bar"], ["oil_temperature", "'3 bar'", "K", "degC"]),
        (["washer", "--frobnicate"], ["--frobnicate"]),
        (["washer", "--grid", "1x1"], ["grid", "1"]),
        (["washer", "--grid", "nine"], ["grid", "'nine'", "9x32"]),
        (["washer", "--branch", "no"], ["branch", "no", "film", "contact"]),
        (["washer", "--fidelity", "best"], ["fidelity", "best", "field"]),
        (["washer", "--set", "roughnes=1e-7"], ["roughnes", "roughness?"]),
        (["washer", "--set", "roughness"], ["roughness", "NAME=VALUE"]),
        (["washer", "--set", "roughness=nan"], ["roughness", "nan", "m"]),
        (["washer", "--set", "roughness=3 mm"], ["roughness", "0.003", "m"]),
        (["washer", "--set", "friction_law=magic"], ["friction_law", "magic", "'load'"]),
        (["washer", "--set", "outer_radius=0.012"], ["gear_inner_radius", "outer_radius"]),
        (["washer", "--plot", "x.gif"], ["--plot", "x.gif", ".png"]),
        (["washer", "--plot", "/proc/none/x.png"], ["--plot", "/proc/none"]),
        (["curve", "--out", "/proc/none/x.csv"], ["--out", "/proc/none"]),
        (["curve", "--speed", "fast"], ["speed", "'fast'", "rpm"]),
        (["clutch", "--load", "-1"], ["load", "-1", "N"]),
        (["clutch", "--set", "faces=2.5"], ["faces", "2.5"]),
        (["clutch", "--set", "film_dynamics=perhaps"], ["film_dynamics", "true or false"]),
        (["build", "Toaster"], ["Toaster", "ThrustWasher"]),
        (["build", "--out", "/proc/none"], ["--out", "/proc/none"]),
        (["shift", "--out", "/proc/none"], ["--out", "/proc/none"]),
        (["shift", "--scene", "nowhere.toml"], ["scene", "nowhere.toml"]),
        (["shift", "--step", "-1 ms"], ["step", "-0.001", "s"]),
    ],
)  # fmt: skip
def test_wrong_input_is_one_line_that_names_it(words, named, capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert main(words) == 2
    line = one_line(capsys)
    assert [text for text in named if text not in line] == []
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("error", "status"),
    [
        (ParameterError("load = 1 N"), 2),
        (BranchError("no such branch"), 2),
        (EnvironmentProblem("no fmpy"), 2),
        (SolveError("tried\neverything"), 3),
        (PermissionError(13, "Permission denied", "/locked/x"), 2),
        (OSError(28, "No space left on device"), 2),
        (KeyboardInterrupt(), 130),
        (BrokenPipeError(), 141),
        (ZeroDivisionError("a defect"), 1),
    ],
)
def test_every_failure_has_its_exit_status(error, status, capsys, monkeypatch):
    def fail(_):
        raise error

    monkeypatch.delenv("THRUSTWASHER_TRACEBACK", raising=False)
    monkeypatch.setattr("thrustwasher.cli.doctor.run", fail)
    assert main(["doctor"]) == status
    out, err = capsys.readouterr()
    assert out == "" and "Traceback" not in err
    assert err.count("\n") == (0 if status == 141 else 1)


@pytest.mark.parametrize("command", cli.COMMANDS)
def test_every_command_explains_itself(command, capsys):
    assert main([command, "--help"]) == 0
    out, err = capsys.readouterr()
    assert command in out and err == ""


def test_bare_call_lists_every_command(capsys):
    assert main([]) == 0
    bare = capsys.readouterr().out
    assert main(["--help"]) == 0
    assert capsys.readouterr().out == bare
    assert [c for c in cli.COMMANDS if f"\n  {c} " not in bare] == []


@pytest.mark.parametrize(("command", "spec"), [("washer", WASHER), ("clutch", CLUTCH)])
def test_help_shows_unit_range_and_default_of_every_input(command, spec, capsys):
    main([command, "--help"])
    text = " ".join(capsys.readouterr().out.split())
    for s in spec.inputs:
        assert f"[{s.unit}]; {s.low:g} .. {s.high:g} {s.unit}, default" in text


@pytest.mark.parametrize(
    ("command", "spec"), [("washer", WASHER), ("clutch", CLUTCH), ("gearmesh", GEARMESH)]
)
def test_parameter_list_is_the_dataclass(command, spec, capsys):
    assert main([command, "--parameters"]) == 0
    lines = capsys.readouterr().out.splitlines()[1:]
    assert [line.split()[0] for line in lines] == [f.name for f in fields(spec.params)]
    for line, f in zip(lines, fields(spec.params), strict=True):
        assert f.metadata["help"] in line


def test_help_of_build_names_every_fmu(capsys):
    from thrustwasher.fmu.registry import all_specs

    main(["build", "--help"])
    text = capsys.readouterr().out
    assert [s.name for s in all_specs() if s.name not in text] == []


def test_what_cannot_be_built_sends_nobody_in_a_circle(tmp_path, capsys):
    for words, named in (
        (["--target", "python", "--fmi", "3"], "native"),
        (["--target", "python", "--platforms", "all"], "native"),
        (["--platforms", "linux64,amiga"], "'amiga'"),
        (["--target", "stone"], "stone"),
    ):
        assert main(["build", *words, "--out", str(tmp_path)]) == 2
        assert named in one_line(capsys)


@pytest.mark.skipif(not DOCS.is_dir(), reason="the documents are in the source tree only")
def test_the_document_knows_every_command():
    text = (DOCS / "command-line.md").read_text("utf-8")
    assert [c for c in cli.COMMANDS if f"\n| `{c}` |" not in text] == []


@pytest.mark.parametrize("command", ["washer", "gearmesh"])
def test_help_needs_no_compiler(command):
    code = (
        f"import sys; from thrustwasher.cli import main; main(['{command}', '--help']);"
        "sys.exit(any(m in sys.modules for m in ('numba', 'scipy', 'matplotlib', 'fmpy')))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
    assert done.returncode == 0


def test_clutch_json_is_one_object_with_fields_inputs_and_time(capsys):
    words = ["clutch", "--load", "9 kN", "--speed", "-50", "--set", "faces=4", "--json"]
    assert main(words) == 0
    out, err = capsys.readouterr()
    record = json.loads(out)
    assert err == ""
    wanted = {"friction_torque", "friction_coefficient", "temperature", "film_thickness",
              "film_ratio", "shear_ratio", "regime", "status", "load", "speed",
              "oil_temperature", "wall_time"}  # fmt: skip
    assert wanted <= set(record)
    assert (record["load"], record["speed"]) == (9000.0, -50.0)
    assert record["parameters"]["faces"] == 4
    assert record["friction_torque"] < 0.0


def test_clutch_numbers_are_those_of_the_api(capsys):
    from thrustwasher.models.clutch import ClutchParams, solve_clutch

    main(["clutch", "--load", "9000", "--speed", "50", "--json"])
    record = json.loads(capsys.readouterr().out)
    result = solve_clutch(ClutchParams(), load=9000.0, speed=50.0)
    assert record["friction_torque"] == result.friction_torque
    assert record["film_ratio"] == result.film_ratio


def test_a_plot_is_written_whole_or_not_at_all(tmp_path, capsys, monkeypatch):
    target = tmp_path / "new" / "clutch.png"
    assert main(["clutch", "--load", "9000", "--speed", "50", "--plot", str(target)]) == 0
    assert target.read_bytes()[:4] == b"\x89PNG"
    assert [p.name for p in target.parent.iterdir()] == ["clutch.png"]
    capsys.readouterr()

    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", fail)
    other = tmp_path / "new" / "other.png"
    assert main(["clutch", "--load", "9000", "--speed", "50", "--plot", str(other)]) == 2
    assert "No space" in one_line(capsys)
    assert [p.name for p in target.parent.iterdir()] == ["clutch.png"]


def test_a_closed_pipe_is_quiet():
    words = [sys.executable, "-m", "thrustwasher", "washer", "--parameters"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 141
