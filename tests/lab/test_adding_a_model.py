"""The files of examples/own_model are a model: command, sweep, FMU and its page."""

import csv
import json
import math
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import needed
import pytest

MODEL = Path(__file__).parents[2] / "examples" / "own_model"
POINT = {"load": 1000.0, "speed": 300.0, "oil_temperature": 330.0}
WORDS = [f"--{name.replace('_', '-')}={value!r}" for name, value in POINT.items()]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the example's files in it, and nothing else."""
    home = tmp_path_factory.mktemp("made-up")
    shutil.copytree(
        MODEL, home, dirs_exist_ok=True, ignore=shutil.ignore_patterns("__pycache__", "fmus")
    )
    return home


@pytest.fixture(scope="module")
def run(folder):
    """What a command of the page prints, or says where it ends with another status."""

    def run(*words, status=0):
        command = [sys.executable, str(folder / "run.py"), *words]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        assert done.returncode == status, done.stderr
        return done.stderr if status else done.stdout

    return run


@pytest.fixture(scope="module")
def solved(run):
    return json.loads(run("journal", *WORDS, "--json"))


def test_the_command_solves_one_point(run, solved):
    petroff = 2.0 * math.pi * 0.02 * 25e-3**3 * 20e-3 / 25e-6 * POINT["speed"]
    assert math.isclose(solved["friction_torque"], petroff, rel_tol=1e-14)
    assert 12.5e-6 < solved["film_thickness"] < 25e-6 and solved["status"] == "OK"
    text = run("journal", "--load", "2 kN", "--speed", "9000 rpm", "--set", "clearance=1e-4")
    assert "minimum film thickness" in text and "OUTSIDE_VERIFIED; " in text


def test_help_comes_from_the_lists(run):
    text = run("journal", "--help")
    assert "radial force, its sign does not matter" in text and "--oil-temperature" in text
    assert "--plot" not in text and "auto" not in text  # it has neither figure nor tables
    assert "radial clearance" in run("journal", "--parameters")
    assert "journal    friction and film of a plain journal bearing" in run("--help")


def test_a_model_without_verification_tables_says_so(run):
    said = run("sweep", "journal", "--over=load=1:2:1", "--fidelity=auto:0.01", status=2)
    assert "model = 'journal' (it has no verification tables), allowed: 'washer'" in said


def test_the_sweep_writes_a_table(run, solved, folder):
    over = "sweep journal --over=load=500:1500:500 --over=viscosity=0.02,0.04"
    run(*over.split(), *WORDS[1:], "--workers=2", "--out=table.csv")
    with (folder / "table.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [row["status"] for row in rows][:2] == ["OK", "OK"]
    same = rows[1]
    assert float(same["friction_torque [N.m]"]) == solved["friction_torque"]
    assert float(same["film_thickness [m]"]) == solved["film_thickness"]


@pytest.fixture(scope="module")
def fmu(run, folder):
    """The native FMU for this machine, without a finding of the validator."""
    needed.linker()
    made = json.loads(run("build", "JournalBearing", "--platforms=local", "--out=fmus", "--json"))
    assert made["findings"] == []
    return folder / made["fmus"][0]


@pytest.mark.slow
def test_the_fmu_gives_the_same_numbers(fmu, solved):
    names = ("friction_torque", "temperature", "film_thickness")
    options = {"stop_time": 2e-3, "output_interval": 1e-3, "start_values": POINT, "output": names}
    series = fmpy.simulate_fmu(fmu, **options)
    assert [series[name][-1] for name in names] == [solved[name] for name in names]


@pytest.mark.slow
def test_the_page_inside_lists_its_variables(fmu):
    page = zipfile.ZipFile(fmu).read("documentation/index.html").decode()
    for name in (*POINT, "clearance", "friction_torque", "film_thickness", "solver_status"):
        assert f"<td>{name}</td>" in page
    assert "DuBois and Ocvirk" in page and "Subtract friction_torque" in page
