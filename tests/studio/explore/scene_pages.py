"""Scenes as their pages have them, run by node, and the same scenes run by Python."""

import json
import subprocess
from functools import cache
from pathlib import Path

from pages import NODE, WEB

from thrustwasher.shift import cosimulate, load_scene, with_fidelities
from thrustwasher.studio.explore.scene_data import instance_of, modules, scene_data, started
from thrustwasher.studio.explore.scene_page import scene_page

HERE = Path(__file__).parent
SCRIPTS = [
    (WEB / name).as_uri() for name in ("kernel.js", "../scene/system.js", "../scene/quantity.js")
]
PATHS = {
    "clutch_pressure": ("pressure", "clutch"),
    "brake_pressure": ("pressure", "brake"),
    "engine_torque": ("engine",),
}


@cache
def nominal(name):
    scene = load_scene(name)
    return cosimulate(scene, {n: instance_of(n, p) for n, p in scene.parts.items()})


@cache
def told(name):
    """What the page's scripts read."""
    return scene_data(nominal(name))


@cache
def html(name):
    return scene_page(load_scene(name), nominal(name))


def page_runs(name, runs):
    """Return the figures of runs {"profiles", "washers", "draw"} as the page's worker has them."""
    given = {
        "scripts": SCRIPTS,
        "about": told(name),
        "modules": modules(load_scene(name)),
        "runs": runs,
    }
    done = subprocess.run(
        ["node", *NODE, str(HERE / "scene_run.mjs")],
        input=json.dumps(given),
        text=True,
        capture_output=True,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def scene_file(folder, base, profiles):
    """Write a scene file with other profiles; return its path."""
    lines = [f'base = "{base}"']
    for name, points in profiles.items():
        lines += [f"[{'.'.join(PATHS[name])}]", f"points = {json.dumps(points)}"]
    path = Path(folder) / "own.toml"
    path.write_text("\n".join(lines), "utf-8")
    return path


def python_run(path, levels):
    """Return the run of Python's loop, without the checks after it."""
    scene = with_fidelities(load_scene(str(path)), levels)
    return cosimulate(scene, {n: instance_of(n, p) for n, p in scene.parts.items()})


def python_figures(path, levels):
    """Return the figures that Python's loop gives."""
    return started(python_run(path, levels))
