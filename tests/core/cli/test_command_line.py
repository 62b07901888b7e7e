"""The command line answers bad input with one line and good input with one object."""

import os
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest

from thrustwasher import cli
from thrustwasher.cli import main
from thrustwasher.clutch.parameters import SPEC as CLUTCH
from thrustwasher.errors import BranchError, EnvironmentProblem, SolveError
from thrustwasher.gearmesh.parameters import SPEC as GEARMESH
from thrustwasher.washer.parameters import SPEC as WASHER

DOCS = Path(__file__).parents[3] / "docs"


@pytest.mark.parametrize(
    ("error", "status"),
    [
        (BranchError("no such branch"), 2),
        (EnvironmentProblem("no fmpy"), 2),
        (SolveError("tried\neverything"), 3),
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
    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", fail)
    assert main(["clutch", "--plot", str(tmp_path / "other.png")]) == 2
    out, err = capsys.readouterr()
    assert "No space" in err and out == "" and err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_closed_pipe_is_quiet():
    words = [sys.executable, "-m", "thrustwasher", "washer", "--parameters"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 141


@pytest.mark.parametrize(
    ("variable", "value", "says"),
    [("NUMBA_DISABLE_JIT", "1", True), ("NUMBA_DISABLE_JIT", "0", False),
     ("THRUSTWASHER_KERNELS", "python", True)],
)  # fmt: skip
def test_kernels_in_plain_python_are_said_at_the_start(variable, value, says):
    words = [sys.executable, "-m", "thrustwasher", "part", "list", "washer"]
    ways = {"NUMBA_DISABLE_JIT", "THRUSTWASHER_KERNELS"}
    plain = {n: x for n, x in os.environ.items() if n not in ways}
    done = subprocess.run(words, env=plain | {variable: value}, capture_output=True, text=True)
    assert done.returncode == 0 and len(done.stderr.splitlines()) == says
    assert (f"{variable} = {value}: kernels run as plain Python" in done.stderr) == says
