"""Models, FMUs and shifts run where the folder ``studio`` is missing; what lies there says so."""

import json
import shutil
import tomllib

import pytest
from children import ROOT, child

from thrustwasher import plugins

PACKAGE = ROOT / "thrustwasher"
ABOVE = {"studio"}
STUDIO = [name for name, home in plugins.COMMANDS.items() if home.split(".")[1] == "studio"]
RUN = "import sys; from thrustwasher.cli import main; sys.exit(main(sys.argv[1:]))"
SOLVED = """
import sys
from thrustwasher import ClutchParams, GearMeshParams, WasherParams
from thrustwasher import run_shift, solve_clutch, solve_gearmesh, solve_washer
w = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002).friction_torque
c = solve_clutch(ClutchParams(), load=1000.0, speed=10.0).friction_torque
m = solve_gearmesh(GearMeshParams(), power=5e3, speed=180.0).friction_torque
shift = run_shift("msl")
assert shift.warnings and shift._repr_html_()
assert not [name for name in sys.modules if name.startswith("thrustwasher.stud")]
print([x.hex() for x in (w, c, m, shift.figures["lock_time"])])
"""


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """Copy the package without the studio; return what runs a command of it."""
    folder = tmp_path_factory.mktemp("core")
    without = shutil.ignore_patterns("studio", "__pycache__")
    shutil.copytree(PACKAGE, folder / "thrustwasher", ignore=without)
    shutil.copytree(ROOT / "fmu_src", folder / "fmu_src")
    return folder


@pytest.mark.slow
def test_what_is_solved_and_run_is_the_same(alone):
    found = child(SOLVED, path=[alone], PYTHONSAFEPATH="1", check=True)
    there = "import thrustwasher; print(thrustwasher.__file__)"
    assert child(there, path=[alone], PYTHONSAFEPATH="1").stdout.startswith(str(alone))
    with_it = child(SOLVED, check=True, PYTHONSAFEPATH="1")
    assert found.stdout == with_it.stdout


@pytest.mark.parametrize(
    "words", ["washer --load 300 --speed 953", "shift --scene msl --no-report"]
)
@pytest.mark.slow
def test_a_command_of_the_core_runs(words, alone):
    done = child(RUN, *words.split(), "--json", path=[alone], PYTHONSAFEPATH="1", check=True)
    assert json.loads(done.stdout)["warnings"] is not None


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] * (i > 1)) for i, n in enumerate(STUDIO)]
)
def test_a_command_of_the_studio_says_that_it_is_missing(name, alone):
    done = child(RUN, name, "--help", path=[alone], PYTHONSAFEPATH="1")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        f"thrustwasher {name}: the command {name} is part of thrustwasher.studio, which is "
        "missing here\n"
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("washer --plot w.png", "--plot is part of"),
        ("shift --scene msl", "the report (a run without one: --no-report) is part of"),
        ("shift --no-report --scatter 8", "a study of scatter is part of"),
        ("shift --no-report --sensitivities", "--sensitivities of a shift is part of"),
    ],
)
@pytest.mark.slow
def test_what_needs_the_studio_says_so_before_anything_is_written(words, said, alone):
    run = f"import os; os.chdir({str(alone)!r}); {RUN}"
    before = sorted(alone.iterdir())
    done = child(run, *words.split(), path=[alone], PYTHONSAFEPATH="1")
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    assert f"{said} thrustwasher.studio, which is missing here" in done.stderr
    assert sorted(alone.iterdir()) == before


def test_the_list_of_commands_says_which_are_missing(alone):
    lines = child(RUN, "--help", path=[alone], PYTHONSAFEPATH="1", check=True).stdout.splitlines()
    assert len([x for x in lines if x.endswith("which is missing here)")]) == len(STUDIO) == 8


def test_the_contract_names_all_of_the_core():
    tool = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]
    core = next(c for c in tool["contracts"] if c["name"] == "core sees no studio")
    there = {p.stem for p in PACKAGE.iterdir() if p.suffix == ".py" and p.stem[0] != "_"}
    there |= {p.parent.name for p in PACKAGE.glob("*/__init__.py")} - ABOVE
    assert {name.partition(".")[2] for name in core["source_modules"]} == there
    assert set(core["forbidden_modules"]) == {"thrustwasher.studio", "lab"}
