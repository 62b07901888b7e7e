"""Levels that are gone: their names run the next better one, give its numbers and say so."""

import json

import pytest

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    WasherParams,
    load_part,
    run_sweep,
    solve_clutch,
    solve_gearmesh,
    solve_washer,
)
from thrustwasher.cli import main
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.running.core import Core
from thrustwasher.model.registry import find_spec
from thrustwasher.shift import load_scene, with_fidelities

SOLVED = {
    "washer": (solve_washer, WasherParams(), {"load": 300.0, "speed": 545.0, "tilt": 2e-3}),
    "clutch": (solve_clutch, ClutchParams(), {"load": 5e3, "speed": 4.0}),
    "gearmesh": (solve_gearmesh, GearMeshParams(), {"power": 7500.0, "speed": 180.0}),
}
GONE = [
    ("washer", "coarse", 2, "field"),
    ("clutch", "boundary", 2, "stribeck"),
    ("gearmesh", "closed", 1, "field"),
    ("gearmesh", "stribeck", 2, "field"),
]
each = pytest.mark.parametrize(("model", "name", "number", "level"), GONE)


def line(name, level):
    return (
        f"fidelity = {name!r} is gone: {level!r}, the next better fidelity level, runs in its place"
    )


def test_no_other_level_is_gone():
    found = [
        (key, name, list(find_spec(key).fidelities).index(name) + 1, level)
        for key in SOLVED
        for name, level in find_spec(key).successors.items()
    ]
    assert found == GONE


@each
def test_in_python_and_part_files(model, name, number, level, tmp_path):
    solve, params, point = SOLVED[model]
    found, better = (solve(params, **point, fidelity=f) for f in (name, level))
    assert found.friction_torque == better.friction_torque and found.fidelity == level
    assert found.warnings == (line(name, level), *better.warnings)
    path = tmp_path / "mine.toml"
    path.write_text(f'model = "{model}"\nname = "Mine"\nfidelity = "{name}"\n')
    part = load_part(path)
    assert part.model.default_fidelity == level
    for made in (part.solve(**point), run_sweep(part, {"speed": [point["speed"]]})):
        assert made.fidelity == level and line(name, level) in made.warnings


def test_on_the_command_line_and_in_scenes(tmp_path, capsys):
    assert main(["washer", "--load", "300", "--fidelity", "coarse", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["fidelity"] == "field" and line("coarse", "field") in told["warnings"]
    path = tmp_path / "mine.toml"
    path.write_text('base = "planetary-sun"\n[mesh]\nfidelity = "stribeck"\n')
    asked = with_fidelities(load_scene("planetary-sun"), ["mesh=stribeck"])
    for scene in (load_scene(path), asked):
        assert scene.parts["mesh"].fidelity == "field"
    assert f"[mesh] {line('stribeck', 'field')}" in load_scene(path).warnings


@each
def test_in_an_fmu(model, name, number, level):
    spec = find_spec(model)
    cores = []
    for code in (number, list(spec.fidelities).index(level) + 1):
        core = Core(interface(spec))
        known = {v.name: v.reference for v in core.variables}
        core.set([known["fidelity"]], [code], "Enumeration")
        core.set([known[s.name] for s in spec.inputs[:2]], [50.0, 100.0], "Real")
        core.begin(0.0)
        core.leave_initialization()
        said = core.advice()
        core.advance(0.0, 1e-3)
        cores.append((core.out.tobytes(), said, core.advice()))
        assert core.get([known["fidelity"]], "Enumeration") == [code]
    (out, said, later), (better, plain, _) = cores
    assert out == better and said == [f"{spec.name} at t = 0 s: {line(name, level)}", *plain]
    assert not any("gone" in text for text in later)
