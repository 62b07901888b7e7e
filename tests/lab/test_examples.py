"""Every example runs and returns the number it is known for; so do the notebooks."""

import importlib.util
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import needed
import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
PINNED = {  # value; relative tolerance
    "ex01_washer": (0.25810, 6e-3),  # N m
    "ex02_load_curve": (957.7, 0.02),  # N
    "ex03_clutch": (-1.9868212651952575, 1e-9),  # N m s/rad: friction falls with slip
    "ex04_shift": (2.1107904, 1e-5),  # s
    "ex05_gearmesh": (0.6747259775410824, 1e-9),  # of the contact stress allowed without heat
    "ex06_calibrate": (1.9784950022118957, 1e-6),  # m/s
    "ex07_braking_test": (1.2004398, 1e-7),  # s, from the middle of the ramp
    "ex08_native_washer": (957.81, 3e-4),  # N, the fold of ex02 as the default mesh has it
    "ex09_package": (2.1107706965, 1e-9),  # s
    "ex10_sweep": (940.0, 1e-9),  # N, the last step of 20 N below the fold of ex08
    "ex11_overload": ([3.675, 0.55, 0.1], 0.05),  # s
    "ex12_engine_and_vehicle": (0.825546, 2e-4),  # s, as the scene's own engine and vehicle
    "ex13_engine_and_vehicle_ssp": (0.825546, 5e-4),  # s
    "ex14_jackson_green": (0.15734, 1e-3),  # share of the film's heat that the solids take
    "ex15_design": (0.257116, 1e-4),  # N m, at the film ratio of the limit
    "ex16_own_driveline": (91.724138, 1e-6),  # N m, the torque of rigid shafts
    "ex18_reducer": (0.983808, 1e-5),  # efficiency at 150 N m and 500 rad/s
    "ex17_engagement": (0.918238, 1e-4),  # factor on friction; the recording was made with 0.92
}
IN_SHORT = {"ex14_jackson_green": {"most": 1}}  # CI runs every example as it stands
OWN_FMUS = ("ex12_engine_and_vehicle", "ex13_engine_and_vehicle_ssp")
NATIVE = ("ex08_native_washer", "ex09_package", "ex16_own_driveline", *OWN_FMUS)


def load(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _alone(name):
    """Run an example in a process of its own: FMPy keeps one logger per process, the last one.

    A logger that an earlier test gave to ``simulate_fmu`` is gone when FMPy calls it again.
    """
    script = f"import {name}\nprint(repr({name}.main()))"
    how = {"cwd": EXAMPLES, "text": True, "capture_output": True, "timeout": 900}
    done = subprocess.run([sys.executable, "-c", script], check=True, **how)
    *printed, found = done.stdout.splitlines()
    return float(found), printed


def test_every_example_is_pinned():
    assert {path.stem for path in EXAMPLES.glob("ex*.py")} == set(PINNED)


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=pytest.mark.slow) if n in OWN_FMUS else n for n in PINNED]
)
@pytest.mark.slow
def test_example_returns_its_number(name, capsys):
    if name in NATIVE:
        needed.linker()
        found, printed = _alone(name)
    else:
        found, printed = load(name).main(**IN_SHORT.get(name, {})), capsys.readouterr().out
    value, tolerance = PINNED[name]
    assert found == pytest.approx(value, rel=tolerance)
    assert printed


@pytest.mark.parametrize("name", PINNED)
def test_example_is_short(name):
    assert len((EXAMPLES / f"{name}.py").read_text("utf-8").splitlines()) <= 75


def test_a_vehicle_of_ones_own_is_the_scenes():
    """The reference of ex12 and ex13: the same shift with the scene's own engine and load."""
    from dataclasses import replace

    from scene_runs import instances

    from thrustwasher.shift import cosimulate, load_scene

    scene = load_scene("planetary").with_options(master="jacobi")
    parts = {n: scene.parts[n] for n in ("transmission", "clutch", "brake")}
    scene = replace(scene, parts=parts)
    lock = cosimulate(scene, instances(scene)).figures["lock_time"]
    for value, tolerance in map(PINNED.get, OWN_FMUS):
        assert lock == pytest.approx(value, rel=tolerance)


# Notebooks

NOTEBOOKS = sorted((EXAMPLES / "notebooks").glob("*.ipynb"))
SAID = {  # among what each one prints
    "1_washer": "0.2584 N m at a film ratio of 20.8",
    "2_own_part": "Python at 300 N: 0.08755 N m",
    "3_calibrate": "stick_speed    not determined",
    "4_shift": "as it is   locks at 0.7974 s",
    "5_scatter": "locks at 0.797 s",
}
each_notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)


def cells(path, kind):
    return [c for c in json.loads(path.read_text("utf-8"))["cells"] if c["cell_type"] == kind]


def test_there_is_a_notebook_for_every_job():
    assert [path.stem for path in NOTEBOOKS] == list(SAID)


@each_notebook
def test_a_notebook_is_kept_without_outputs(path):
    code = cells(path, "code")
    assert [c["outputs"] for c in code] == [[]] * len(code)
    assert {c["execution_count"] for c in code} == {None}


@each_notebook
def test_a_notebook_begins_with_a_title_and_explains_itself(path):
    text = ["".join(c["source"]) for c in cells(path, "markdown")]
    assert text[0].startswith("# ") and len(text) >= 5
    code = ["".join(c["source"]) for c in cells(path, "code")]
    assert max(len(c.splitlines()) for c in code) <= 25


@each_notebook
def test_links_of_a_notebook_lead_somewhere(path):
    text = "".join("".join(c["source"]) for c in cells(path, "markdown"))
    links = re.findall(r"\]\(([^)\s#]+)", text)
    assert [link for link in links if not (path.parent / link).exists()] == []


def run_notebook(path):
    """Return a notebook with its outputs: run by the site's build if that was told where to."""
    nbformat, folder = needed.package("nbformat"), os.environ.get("THRUSTWASHER_NOTEBOOKS_RUN")
    if folder and Path(folder, path.name).exists():
        return nbformat.read(Path(folder, path.name), as_version=4)
    client = needed.package("nbclient")
    needed.package("ipykernel"), needed.package("pandas")
    book = nbformat.read(path, as_version=4)
    where = {"metadata": {"path": str(path.parent)}}
    client.NotebookClient(book, timeout=600, kernel_name="python3", resources=where).execute()
    return book


@pytest.mark.slow
@each_notebook
def test_a_notebook_runs(path):
    book = run_notebook(path)
    outputs = [o for c in book.cells if c.cell_type == "code" for o in c.outputs]
    printed = "".join(o.text for o in outputs if o.output_type == "stream" and o.name == "stdout")
    assert SAID[path.stem] in printed
    shown = {kind for o in outputs if "data" in o for kind in o.data}
    assert {"text/html", "image/png"} <= shown
