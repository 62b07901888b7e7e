"""The command line answers bad input with one line and good input with one object."""

import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest

from thrustwasher import cli
from thrustwasher.cli import main
from thrustwasher.clutch.parameters import SPEC as CLUTCH
from thrustwasher.errors import BranchError, EnvironmentProblem, ParameterError, SolveError
from thrustwasher.gearmesh.parameters import SPEC as GEARMESH
from thrustwasher.washer.parameters import SPEC as WASHER

DOCS = Path(__file__).parents[2] / "docs"


def one_line(capsys):
    """Return the only line on standard error; standard output must be empty."""
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1 and err.endswith("\n")
    assert "Traceback" not in err
    return err


# Each kind of wrong input once; what only one command knows stands in that command's tests.
@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["gearbox", "--power", "7500"], ["gearbox", "gearmesh", "doctor"]),
        (["--frobnicate"], ["--frobnicate"]),
        (["washer", "--frobnicate"], ["--frobnicate"]),
        (["washer", "--load"], ["--load"]),
        (["washer", "--load", "abc"], ["load", "'abc'", "N"]),
        (["clutch", "--load", "nan"], ["load", "'nan'", "N"]),
        (["clutch", "--load", "-1"], ["load", "-1", "N"]),
        (["curve", "--tilt", "30 deg"], ["tilt", "0.52", "rad"]),
        (["washer", "--oil-temperature", "3 bar"], ["oil_temperature", "'3 bar'", "K", "degC"]),
        (["washer", "--grid", "1x1"], ["grid", "1"]),
        (["curve", "--grid", "nine"], ["grid", "'nine'", "9x32"]),
        (["washer", "--branch", "no"], ["branch", "no", "film", "contact"]),
        (["washer", "--load", "300", "--speed", "953", "--branch", "contact"], ["contact"]),
        (["washer", "--fidelity", "best"], ["fidelity", "best", "field"]),
        (["engage", "--fidelity", "map"], ["fidelity", "map", "field"]),
        (["gearmesh", "--preset", "rosy"], ["preset", "rosy", "literal"]),
        (["washer", "--preset", "rosy"], ["preset", "rosy", "paper"]),
        (["sweep", "washer", "--preset", "rosy"], ["preset", "rosy", "paper"]),
        (["sweep", "clutch", "--preset", "rosy"], ["preset", "rosy", "paper"]),
        (["gearmesh", "--speed", "0"], ["speed", "0", "rad/s"]),
        (["gearmesh", "--power", "1e12"], ["power", "W"]),
        (["washer", "--set", "roughnes=1e-7"], ["roughnes", "roughness?"]),
        (["washer", "--set", "roughness"], ["roughness", "NAME=VALUE"]),
        (["washer", "--set", "roughness=nan"], ["roughness", "nan", "m"]),
        (["washer", "--set", "roughness=3 mm"], ["roughness", "0.003", "m"]),
        (["washer", "--set", "friction_law=magic"], ["friction_law", "magic", "'load'"]),
        (["clutch", "--set", "faces=2.5"], ["faces", "2.5"]),
        (["clutch", "--set", "film_dynamics=perhaps"], ["film_dynamics", "true or false"]),
        (["washer", "--set", "outer_radius=0.012"], ["gear_inner_radius", "outer_radius"]),
        (["gearmesh", "--set", "pinion_teeth=14"], ["pinion_teeth = 14", "15 and more"]),
        (["washer", "--plot", "x.gif"], ["--plot", "x.gif", ".png"]),
        (["curve", "--out", "/proc/none/x.csv"], ["--out", "/proc/none"]),
        (["engage", "--ramp", "-1"], ["ramp", "-1", "s"]),
        (["engage", "--duration", "0"], ["duration", "0", "s"]),
        (["engage", "--step", "1"], ["step", "1.0 s", "duration"]),
        (["build", "Toaster"], ["Toaster", "ThrustWasher"]),
        (["build", "--out", "/proc/none"], ["--out", "/proc/none"]),
        (["shift", "--out", "/proc/none"], ["--out", "/proc/none"]),
        (["chart", "--only", "stability", "--draw", "x.json"], ["--only", "--draw"]),
        (["chart", "--only", "accuracy"], ["--only", "accuracy"]),
        (["chart", "--only", "stability", "--out", "/proc/x.md"], ["--out /proc: cannot"]),
    ],
)
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


def test_help_of_a_mesh_says_what_each_preset_changes(capsys):
    main(["gearmesh", "--help"])
    text = " ".join(capsys.readouterr().out.split())
    assert "[W]; -1e+09 .. 1e+09 W, default 7500" in text
    assert "literal: Atan (2005) at its word, per metre of face width" in text
    main(["curve", "--help"])
    text = " ".join(capsys.readouterr().out.split())
    assert "paper: Washer of Jackson & Green (2006)" in text


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
    from thrustwasher.model.registry import all_specs

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


@pytest.mark.parametrize("command", ["washer", "gearmesh", "--help"])
def test_help_needs_no_compiler(command):
    code = (
        f"import sys; from thrustwasher.cli import main; main(['{command}', '--help']);"
        "sys.exit(any(m in sys.modules for m in ('numpy', 'numba', 'scipy', 'matplotlib', 'fmpy')))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
    assert done.returncode == 0


def test_a_plot_is_written_whole_or_not_at_all(tmp_path, capsys, monkeypatch):
    target = tmp_path / "new" / "clutch.png"
    target.parent.mkdir()
    assert main(["clutch", "--load", "9000", "--speed", "2", "--plot", str(target)]) == 0
    assert target.read_bytes()[:4] == b"\x89PNG"
    assert [p.name for p in target.parent.iterdir()] == ["clutch.png"]
    capsys.readouterr()

    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", fail)
    other = tmp_path / "new" / "other.png"
    assert main(["clutch", "--load", "9000", "--speed", "2", "--plot", str(other)]) == 2
    assert "No space" in one_line(capsys)
    assert [p.name for p in target.parent.iterdir()] == ["clutch.png"]


def test_a_closed_pipe_is_quiet():
    words = [sys.executable, "-m", "thrustwasher", "washer", "--parameters"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 141
