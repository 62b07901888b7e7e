"""What is logged: warnings of results, builds, and what worker processes log."""

import inspect
import logging
import pickle
import subprocess
import sys

import pytest

import thrustwasher
from thrustwasher import ClutchParams, propagate, solve_clutch
from thrustwasher.model.part_file import find_part
from thrustwasher.native.files import to_stderr
from thrustwasher.processes import runner

HOT = {"load": 9000.0, "speed": 5.0}


def test_the_package_leaves_levels_and_writing_to_its_user():
    own = logging.getLogger("thrustwasher")
    assert own.level == logging.NOTSET
    assert [type(handler) for handler in own.handlers] == [logging.NullHandler]


def test_what_a_result_warns_of_is_logged_by_its_module_where_it_was_asked_for(caplog):
    result = solve_clutch(ClutchParams(), **HOT)
    found = [(r.name, r.levelname, r.getMessage()) for r in caplog.records]
    assert result.warnings
    assert found == [("thrustwasher.clutch.solve", "WARNING", text) for text in result.warnings]
    assert {record.filename for record in caplog.records} == {"test_logs.py"}


def test_the_warnings_of_a_part_are_logged_once(caplog):
    result = find_part("clutch").solve(**HOT)
    assert [r.getMessage() for r in caplog.records] == list(result.warnings)


def test_nothing_is_written_where_nobody_listens():
    code = (
        "from thrustwasher import ClutchParams, solve_clutch\n"
        f"assert solve_clutch(ClutchParams(), **{HOT}).warnings"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("", "")


def test_progress_of_builds_goes_to_stderr_until_somebody_listens(capsys, caplog):
    to_stderr("compiles")
    assert capsys.readouterr().err == "compiles\n"
    with caplog.at_level(logging.INFO, "thrustwasher"), caplog.at_level(logging.INFO, __name__):
        to_stderr("builds")
    assert capsys.readouterr().err == ""
    assert [(r.levelname, r.getMessage()) for r in caplog.records] == [("INFO", "builds")]


def warm(slip: float) -> float:
    """Return the temperature of a slipping pack [K], with all that is logged on the way."""
    logging.getLogger("thrustwasher.of_worker").info("slip %g", slip)
    return float(thrustwasher.solve_clutch(ClutchParams(), load=9000.0, speed=slip).temperature)


def test_records_of_workers_come_back_with_what_they_did(caplog):
    with caplog.at_level(logging.INFO, "thrustwasher"), runner(2) as run:
        found = list(run(warm, [4.5, 5.0], 1))
    said = [(r.name.rpartition(".")[2], r.getMessage()) for r in caplog.records]
    assert said.count(("of_worker", "slip 4.5")) == said.count(("of_worker", "slip 5")) == 1
    assert sum(name == "solve" for name, _ in said) >= 2
    assert found == [warm(4.5), warm(5.0)]


def test_workers_keep_what_nobody_asked_for(caplog):
    with caplog.at_level(logging.CRITICAL, "thrustwasher"), runner(2) as run:
        list(run(warm, [4.5, 5.0], 1))
    assert not caplog.records


def test_records_of_a_study_come_back(caplog):
    caplog.set_level(logging.INFO, "thrustwasher")
    scatter = {"slip": {"normal": 0.01, "nominal": 4.5, "source": "chosen"}}
    propagate(warm, scatter=scatter, runs=8, workers=2, indices=False)
    assert sum(r.name == "thrustwasher.of_worker" for r in caplog.records) >= 8


def test_public_functions_can_be_pickled():
    for name in ("solve_clutch", "load_curve", "propagate"):
        function = getattr(thrustwasher, name)
        assert pickle.loads(pickle.dumps(function)) is function


@pytest.mark.parametrize("name", ["solve_washer", "run_sweep"])
def test_help_on_a_public_function_is_its_own(name):
    function = getattr(thrustwasher, name)
    assert function.__name__ == name
    assert function.__doc__
    assert "args" not in str(inspect.signature(function))
