"""The command behind each mark of the charts is one that runs, and solves the worst case."""

import json
import shlex

import pytest

from lab.charts.chart_page import command_lines
from lab.charts.chart_series import cases_of
from lab.charts.work_precision import CHARTS
from lab.macro_steps import WAYS
from thrustwasher import cli
from thrustwasher.errors import ParameterError
from thrustwasher.model.registry import models_with_error_tables, spec_of


def marks():
    """Yield model, study and sample of every mark that a chart can have, in every case."""
    for model in models_with_error_tables():
        cases = [vars(case) for case in cases_of(model)]
        for one in CHARTS[model].series(spec_of(model)):
            sample = {**vars(one), "errors": {}}
            for case in cases:
                yield model, {"cases": cases}, sample, case["name"]
    for way in WAYS:
        sample = {
            "family": way.name,
            "label": f"{way.name}, 2 ms",
            "knob": "macro step",
            "value": "2 ms",
            "is_rival": False,
        }
        yield "shift", {"scene": "a shift"}, sample, "shift"


def parsed(line):
    """Return what the command's own parser reads of a line; ParameterError if it refuses."""
    program, name, *words = shlex.split(line.removeprefix("command: "))
    assert program == "thrustwasher"
    parser, command = cli._Parser(name), cli._command(name)
    command.add_arguments(parser)
    return name, parser.parse_args(words)


LINES = {
    (model, tuple(command_lines(study, model, sample, worst)))
    for model, study, sample, worst in marks()
}


def test_each_command_of_a_chart_is_understood():
    found = set()
    for model, (line, *_) in LINES:
        if line.startswith("command: "):
            name, arguments = parsed(line)
            found.add(name)
            if name == "shift":
                assert arguments.step and arguments.master and len(arguments.fidelity) == 2
        else:
            assert model == "shift" and "in [transmission]" in line  # a coupling has no option
    assert found == {"washer", "engage", "gearmesh", "shift"}
    with pytest.raises(ParameterError):
        parsed("command: thrustwasher gearmesh --load 40")


WASHER = "washer --load 700 --speed 545 --tilt 0.002 --oil-temperature 297.15 --branch contact"
MESH = "gearmesh --power 21600 --speed 180 --oil-temperature 299.85"
PACK = "engage --load 12000 --speed 350 --oil-temperature 297.15 --ramp 0.1 --duration 0.6"


@pytest.mark.parametrize(
    ("words", "name", "value"),
    [
        (f"{MESH} --fidelity fine", "speed", 180.0),
        (f"{WASHER} --fidelity map", "branch", "contact"),
        (f"{WASHER} --grid 7x20", "branch", "contact"),
        (f'{PACK} --fidelity field --step "20 ms"', "duration", 0.6),
    ],
)
def test_a_command_solves_its_case(words, name, value, capsys):
    assert f"command: thrustwasher {words}" in {lines[0] for _, lines in LINES}
    assert cli.main([*shlex.split(words), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)[name] == value
