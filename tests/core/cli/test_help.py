"""The help: commands in groups, a line each; examples that run; names of before."""

import shlex
import shutil
from pathlib import Path

import pytest

from thrustwasher import cli
from thrustwasher.cli import main

EXAMPLES = Path(__file__).parents[3] / "examples"
LONG = {"scatter", "map", "fidelity", "compare"}  # some ten seconds and more


def test_every_command_stands_in_one_group_and_on_one_line(capsys):
    assert main(["--help"]) == 0
    text = capsys.readouterr().out
    assert sorted(cli.COMMANDS) == sorted({*cli.COMMANDS}) and len(cli.GROUPS) == 4
    assert {*cli.OF_MODELS} <= {*cli.COMMANDS}
    listed = text.partition("\noptions:")[0].splitlines()
    assert max(map(len, listed)) <= 80
    assert [line[:-1] for line in listed if line.endswith(":")] == [*cli.GROUPS]


def parts(line):
    """Return the commands of an example."""
    return [shlex.split(part)[1:] for part in line.split("&&")]


@pytest.mark.parametrize(
    "command", [pytest.param(c, marks=[pytest.mark.slow] * (c in LONG)) for c in cli.COMMANDS]
)
@pytest.mark.slow
def test_help_of_a_command_ends_with_examples_that_run(command, tmp_path, monkeypatch, capsys):
    assert main([command, "--help"]) == 0
    text = capsys.readouterr().out
    lines = [part.strip() for part in text.partition("examples:\n")[2].split("\n\n")[0].split("\n")]
    assert len(lines) >= 2
    shutil.copytree(EXAMPLES, tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    if command == "fidelity":  # what it measures is kept for the user
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    for line in lines:
        assert any(words[0] == command for words in parts(line))
        for words in parts(line):
            assert main(words) == 0, (words, capsys.readouterr().err)
