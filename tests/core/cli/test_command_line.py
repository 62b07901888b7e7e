"""The command line answers bad input with one line and good input with one object."""

import math
import os
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from types import SimpleNamespace

import pytest

from thrustwasher import cli
from thrustwasher.cli import main
from thrustwasher.cli.common._output import duration, going_on
from thrustwasher.cli.common._progress import TimeLeft
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


SOLVE = """from thrustwasher import WasherParams, solve_washer
solve_washer(WasherParams(), load=300.0, speed=900.0, tilt=2e-3)
"""
HELP = "from thrustwasher.cli import main; main(['--help'])"


@pytest.mark.parametrize(
    ("does", "spared"),
    [
        (HELP, {"tempfile", "importlib.resources", "html", "statistics", "secrets"}),
        (SOLVE, {"importlib.metadata", "email", "html", "statistics", "secrets", "numba"}),
    ],
)
def test_what_starts_often_leaves_slow_modules_alone(does, spared):
    code = f"import sys\n{does}\nprint(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not spared & {*done.stdout.split()}


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


# The shell completes words where argcomplete is installed; without it nothing changes.


def answers(line, *, code="from thrustwasher.cli import main; main()"):
    """Return what the shell is offered for the last word of a line."""
    # the program answers on number 8, as the shell has it
    script = f"import os; os.dup2(1, 8); os.dup2(os.open(os.devnull, os.O_WRONLY), 9); {code}"
    given = {"COMP_LINE": line, "COMP_POINT": str(len(line)), "_ARGCOMPLETE": "1"}
    done = subprocess.run(
        [sys.executable, "-c", script],
        env={**os.environ, **given, "_ARGCOMPLETE_IFS": "\n"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert "Traceback" not in done.stderr
    return {word.strip() for word in done.stdout.splitlines()}


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("thrustwasher sw", {"sweep"}),
        pytest.param("thrustwasher washer --lo", {"--load"}, marks=pytest.mark.slow),
        pytest.param(
            "thrustwasher clutch --preset ", {"automatic", "paper"}, marks=pytest.mark.slow
        ),
        ("thrustwasher clutch --set friction_sc", {"friction_scale="}),
        ("thrustwasher shift --scene planetary-h", {"planetary-hot-oil"}),
        pytest.param(
            "thrustwasher explore planetary-h", {"planetary-hot-oil"}, marks=pytest.mark.slow
        ),
        pytest.param("thrustwasher part new gear", {"gearmesh"}, marks=pytest.mark.slow),
    ],
)
def test_words_are_completed(line, found):
    pytest.importorskip("argcomplete")
    assert answers(line) == found


def test_every_command_is_offered():
    pytest.importorskip("argcomplete")
    assert {*cli.COMMANDS} <= answers("thrustwasher ")


def test_without_the_package_the_shell_gets_no_answer_and_the_command_runs():
    code = (
        "import sys; sys.modules['argcomplete'] = None; sys.argv = ['thrustwasher', '--version'];"
        "from thrustwasher.cli import main; sys.exit(main())"
    )
    assert {word.split()[0] for word in answers("thrustwasher sw", code=code)} == {"thrustwasher"}


# The time left changes smoothly; a command that was stopped says how it goes on.


def test_the_time_left_forgets_a_slow_start_and_does_not_jump():
    left, shown = TimeLeft(), []
    done, now = 0.0, 0.0
    while done < 1000.0:  # 20 s for the first five, then two each second
        shown.append((now, left.after(now, int(done), 1000)))
        now += 0.5
        done += 0.125 if done < 5.0 else 1.0
    end = now
    known = [(t, x) for t, x in shown if math.isfinite(x)]
    for (t, x), (then, y) in zip(known[1:], known, strict=False):
        assert abs(x - (y - (t - then))) <= 0.06 * max(x, y)  # 6 % in half a second
    for t, x in known:
        if t > 120.0:
            assert x == pytest.approx(end - t, rel=0.15, abs=2.0)


def test_nothing_is_named_before_it_is_known():
    left = TimeLeft()
    assert [math.isnan(left.after(t, n, 100)) for t, n in [(0, 40), (1, 50), (4, 60)]] == [
        True,
        True,
        False,
    ]


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.31, "0.3 s"), (40.0, "40 s"), (310.0, "5 min"), (7800.0, "2 h 10 min")],
)
def test_durations_are_read_at_a_glance(seconds, words):
    assert duration(seconds) == words


@pytest.mark.parametrize(("done", "there"), [(3, True), (0, True), (3, False)])
def test_a_stopped_command_names_its_journal_and_the_command_that_goes_on(
    done, there, tmp_path, capsys
):
    journal = tmp_path / "a.csv.journal"
    if there:
        journal.write_text("")
    given = SimpleNamespace(command_line="thrustwasher sweep clutch --out a.csv")
    with pytest.raises(KeyboardInterrupt), going_on(given, journal, lambda *_: None) as progress:
        progress(done, 10)
        raise KeyboardInterrupt
    told = capsys.readouterr().err
    if done and there:
        line = f"{journal} keeps 3 of 10 points; to go on: {given.command_line}\n"
        assert told == line
    else:
        assert told == ""
