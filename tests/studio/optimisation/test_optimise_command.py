"""``thrustwasher optimise``: one object or a table, files, one line for what is wrong."""

import json
import signal
from pathlib import Path

import pytest
from children import started, stopped

from thrustwasher import load_part
from thrustwasher.cli import main
from thrustwasher.studio.optimisation.whole_search import JOURNAL

CLUTCH = ["clutch", "--load", "9 kN", "--speed", "5", "--vary", "land_share=0.5:0.95"]
STOPPABLE = ["optimise", *CLUTCH, "--vary", "groove_width=1 mm:3 mm", "--minimise", "temperature"]
EXAMPLES = Path(__file__).parents[3] / "examples"
KEPT = "thrustwasher.storage.journal.Journal.put"


@pytest.fixture
def said(tmp_path, capsys, monkeypatch):
    """Return status, standard output and error of the command."""
    monkeypatch.chdir(tmp_path)

    def run(*words):
        status = main(["optimise", *words])
        return status, *capsys.readouterr()

    return run


def test_json_is_the_object_that_the_contract_has(said, tmp_path):
    status, out, _ = said(*CLUTCH, "--minimise", "temperature", "--json", "--workers", "1")
    record = json.loads(out)
    assert status == 0 and record["front"] == []
    assert record["best"] == {"land_share": pytest.approx(0.5)}
    assert record["figures"]["temperature"] < record["start"]["temperature"]
    assert record["binding"] == ["land_share >= 0.5"]
    folder = tmp_path / "optimum"
    assert sorted(p.name for p in folder.iterdir()) == ["best.toml", "optimum.png"]
    assert load_part(folder / "best.toml").params.land_share == record["best"]["land_share"]


def test_a_front_is_shown_as_a_table(said, tmp_path):
    words = ["--vary", "friction_scale=0.8:1.2", "--minimise", "temperature"]
    status, out, _ = said(*CLUTCH, *words, "--maximise", "friction_torque", "--points", "4")
    assert status == 0 and "Front of 4 designs: temperature, friction_torque" in out
    assert (tmp_path / "optimum" / "front-04.toml").exists()


def test_figures_of_the_target_are_listed(said):
    status, out, _ = said("washer", "--figures")
    assert status == 0 and "film_lost_load [N]: load at which the oil film is lost" in out


def test_figures_of_a_train_are_told_without_what_an_fmu_has_for_none(said):
    status, out, _ = said("ev-reducer", "--figures")
    assert status == 0 and "first.loss [W]: first: tooth friction\n" in out
    assert "no such" not in out


def test_a_limit_by_a_figure_without_a_value_says_why(said, tmp_path):
    scene = (EXAMPLES / "ev-reducer.toml").read_text("utf-8")
    (tmp_path / "mine.toml").write_text(scene.replace('root_limit = "430 MPa"\n', ""), "utf-8")
    vary = ("--vary", "first.helix_angle=20 deg:24 deg", "--minimise", "loss")
    for name in ("root_safety", "second.root_safety"):
        status, _, err = said(str(tmp_path / "mine.toml"), *vary, "--limit", f"{name}>=1.4")
        assert status == 2 and f"limit {name}: has no value with these parameters" in err
        assert "root_limit" in err


@pytest.mark.parametrize(
    ("words", "status", "text"),
    [
        (["--minimise", "temperature", "--limit", "friction_torque>=1e6"], 3, "cannot be met: "),
        (["--minimise", "temperature", "--robust", "much"], 2, "--robust much: allowed"),
        (["--minimise", "temperature", "--points", "x"], 2, "--points x: allowed"),
        (["--minimise", "temperature", "--vary", "land_share"], 2, "--vary land_share: allowed"),
        ([], 2, "minimise, maximise: 0 figures"),
    ],
)
def test_what_is_wrong_is_one_line_and_leaves_no_folder(said, tmp_path, words, status, text):
    found, out, err = said(*CLUTCH, *words)
    assert found == status and out == "" and text in err and err.count("\n") == 1
    assert not (tmp_path / "optimum").exists()


@pytest.mark.parametrize(
    ("number", "status"),
    [(signal.SIGINT, 130), pytest.param(signal.SIGTERM, 143, marks=pytest.mark.abuse)],
)
@pytest.mark.slow
def test_stopped_it_says_what_is_kept_and_goes_on(tmp_path, number, status):
    ended, lines = stopped(STOPPABLE, tmp_path, KEPT, "len(calls) == 2", number)
    assert ended == status and "to go on: thrustwasher optimise " in lines[0] and len(lines) == 2
    assert [p.name for p in (tmp_path / "optimum").iterdir()] == [JOURNAL]
    again = started(STOPPABLE, tmp_path)
    again.communicate(timeout=60)
    assert again.returncode == 0
    assert (tmp_path / "optimum" / "best.toml").exists()
    assert not (tmp_path / "optimum" / JOURNAL).exists()
