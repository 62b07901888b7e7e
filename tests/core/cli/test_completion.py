"""The shell completes words where argcomplete is installed; without it nothing changes."""

import os
import subprocess
import sys

import pytest

from thrustwasher import cli


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
        ("thrustwasher washer --lo", {"--load"}),
        ("thrustwasher clutch --preset ", {"automatic", "paper"}),
        ("thrustwasher clutch --set friction_sc", {"friction_scale="}),
        ("thrustwasher shift --scene planetary-h", {"planetary-hot-oil"}),
        ("thrustwasher explore planetary-h", {"planetary-hot-oil"}),
        ("thrustwasher part new gear", {"gearmesh"}),
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
