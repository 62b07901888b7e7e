"""Every level of every model: the same inputs and outputs, the same signs, the same statuses."""

import json
import math

import numpy as np
import pytest
from kernel_part import Part

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    WasherParams,
    engage_clutch,
    load_part,
    run_sweep,
    solve_clutch,
    solve_gearmesh,
    solve_washer,
)
from thrustwasher.cli import main
from thrustwasher.clutch.kernels import layout
from thrustwasher.clutch.kernels.constants import derive_rings
from thrustwasher.errors import Status
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.running.core import Core
from thrustwasher.model.parameters import as_numbers
from thrustwasher.model.registry import find_spec, kernel_of
from thrustwasher.shift import load_scene, with_fidelities
from thrustwasher.washer.map.map_file import find_map

LADDER = {
    "washer": ["map", "field", "fine"],
    "clutch": ["closed", "stribeck", "field", "fine"],
    "gearmesh": ["field", "fine"],
}
HAS_MAP = find_map(as_numbers(WasherParams())) is not None
LEVELS = [(model, level) for model, levels in LADDER.items() for level in levels]
# load, speed, (tilt), oil temperature, (drum's speed): light, ordinary, heavy
POINTS = {
    "washer": [
        (60.0, 900.0, 2e-3, 300.0, 0.0), (300.0, 545.0, 1.5e-3, 330.0, 0.0),
        (1361.0, 136.0, 2e-3, 297.15, 0.0),
    ],
    "clutch": [(500.0, 150.0, 330.0, 0.0), (5e3, 40.0, 353.15, 0.0), (2e4, 5.0, 353.15, 0.0)],
    "gearmesh": [(5.0, 300.0, 300.0), (40.0, 180.0, 299.85), (400.0, 40.0, 350.0)],
}  # fmt: skip


def settled(model, level, **changes):
    """Return a part that has reached its steady state at every call."""
    if level == "map" and not HAS_MAP:
        pytest.skip("no map of the default washer is shipped")
    if model == "clutch":
        changes = {"starts_pressed": True, **changes}
    return Part(model, level, **changes)


def test_the_ladder_has_its_levels_in_this_order():
    assert {model: list(find_spec(model).levels) for model in LADDER} == LADDER


def test_kernels_count_levels_as_the_fmu_does():
    for model, level in LEVELS:
        spec = find_spec(model)
        items = {i.name: i.value for i in interface(spec).enumerations["Fidelity"]}
        assert items[level] == getattr(kernel_of(spec).L, level.upper())


@pytest.mark.parametrize(("model", "level"), LEVELS)
def test_every_output_is_finite_and_passive(model, level):
    part = settled(model, level)
    for point in POINTS[model]:
        for side in (1.0, -1.0):
            inputs = np.array(point)
            inputs[1] *= side
            assert part.step(inputs) == Status.OK
            assert np.all(np.isfinite(part.out)) and np.all(part.iout >= -1)
            assert part["friction_torque"] * side > 0.0
            assert part["friction_power"] == pytest.approx(part["friction_torque"] * inputs[1])
            assert part["friction_coefficient"] > 0.0
            oil = [s.name for s in part.spec.inputs].index("oil_temperature")
            assert part["temperature"] >= inputs[oil] - 1e-9


@pytest.mark.parametrize(("model", "level"), LEVELS)
def test_the_torque_is_odd_in_speed_and_all_else_even(model, level):
    one, other = settled(model, level), settled(model, level)
    odd = {"friction_torque", "contact_torque", "viscous_torque"}
    for point in POINTS[model]:
        inputs = np.array(point)
        one.step(inputs)
        inputs[1] *= -1.0
        other.step(inputs)
        for name in one.reals:
            assert other[name] == pytest.approx(-one[name] if name in odd else one[name], rel=1e-5)


@pytest.mark.parametrize(("model", "level"), LEVELS)
def test_standstill_gives_no_torque_and_no_load_gives_numbers(model, level):
    part = settled(model, level)
    for load, speed in ((POINTS[model][1][0], 0.0), (0.0, 100.0), (0.0, 0.0)):
        inputs = np.array(POINTS[model][1])
        inputs[0], inputs[1] = load, speed
        assert part.step(inputs) == Status.OK
        assert np.all(np.isfinite(part.out))
        if speed == 0.0:
            assert part["friction_torque"] == 0.0 == part["friction_power"]


@pytest.mark.parametrize(("model", "level"), LEVELS)
def test_levels_agree_on_the_torque_of_an_ordinary_point_within_their_class(model, level):
    """A constant coefficient within a factor of three, all others within a third of the finest."""
    top = settled(model, LADDER[model][-1])
    part = settled(model, level)
    top.step(POINTS[model][1])
    part.step(POINTS[model][1])
    ratio = part["friction_torque"] / top["friction_torque"]
    low = 1.0 / 3.0 if level == "closed" else 2.0 / 3.0
    assert low < ratio < 1.0 / low


def washer(level, params=None, **changes):
    at = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 297.15, **changes}
    return solve_washer(params or WasherParams(), **at, fidelity=level)


def test_a_level_washer_lies_on_its_asperities_at_every_level():
    for level in LADDER["washer"]:
        if level == "map" and not HAS_MAP:
            continue
        r = washer(level, tilt=0.0, speed=0.1)
        assert r.fluid_load == pytest.approx(0.0, abs=1e-9)
        mean = 2.0 / 3.0 * (0.0227**3 - 0.0111**3) / (0.0227**2 - 0.0111**2)
        dry = (0.48 - 0.05 * math.log(300.0)) * 300.0 * mean
        assert r.friction_torque == pytest.approx(dry, rel=0.005)


# --- the gear mesh, resolved along the line of action


def mesh(level, power=7500.0, speed=180.0, **changes):
    params = GearMeshParams.preset("paper", **changes)
    return solve_gearmesh(params, power=power, speed=speed, fidelity=level)


@pytest.mark.parametrize(
    ("ratio", "teeth", "addendum"), [(2.0, 20, 1.0), (5.0, 30, 1.0), (1.0, 60, 1.0), (1.5, 80, 1.3)]
)
def test_with_one_coefficient_the_resolved_loss_is_the_closed_form(ratio, teeth, addendum):
    """Two pairs, three pairs, the pitch point where two share: Ohlendorf's factor to rounding."""
    like = {
        "gear_ratio": ratio,
        "pinion_teeth": teeth,
        "addendum": addendum,
        "friction_law": "constant",
    }
    fine, field = mesh("fine", **like), mesh("field", **like)
    assert fine.friction_torque == pytest.approx(field.friction_torque, rel=1e-12)


def test_the_hottest_position_of_an_ordinary_pair_is_the_start_of_contact():
    fine, field = mesh("fine"), mesh("field")
    for name in ("asperity_temperature", "surface_temperature", "film_thickness", "flash_rise"):
        assert getattr(fine, name) == pytest.approx(getattr(field, name), rel=1e-12)


def test_where_the_start_bears_little_the_hottest_position_lies_further_on():
    """A twentieth of the load at the start: the pair is hotter where it is alone."""
    changes = {"load_share": 0.05, "switch": "none", "area_law": "constant", "area_ratio": 5.0}
    fine, field = mesh("fine", **changes), mesh("field", **changes)
    assert fine.asperity_temperature > field.asperity_temperature + 1.0
    assert fine.hertz_pressure > field.hertz_pressure


# --- the clutch


SMOOTH = {"friction_law": "wang"}  # over slip, above its stick speed
NARROW = {"inner_radius": 0.0795, "outer_radius": 0.08}
PROFILE = np.linspace(0.0, 0.3, 31)


def engaged(level, rings=None, **changes):
    """Return an engagement: pressure rises over 0.1 s, the slip falls to nothing over 0.4 s."""
    params = ClutchParams(**changes)
    if rings is None:
        return engage_clutch(
            params,
            time=PROFILE,
            load=6e3 * np.minimum(PROFILE / 0.1, 1.0),
            speed=120.0 * (1.0 - PROFILE / 0.4),
            oil_temperature=350.0,
            fidelity=level,
        )
    part = Part("clutch", level, input_profile="linear", **changes)
    derive_rings(part.par, rings)
    for t in PROFILE:
        part.step([6e3 * min(t / 0.1, 1.0), 120.0 * (1.0 - t / 0.4), 350.0, 0.0], 0.01)
    return part


@pytest.mark.parametrize("changes", [{}, {"contact_rise": True}])
def test_one_ring_steps_as_the_lumped_pack_does(changes):
    """Steps so short that each is one substep of both: what is left is rounding."""
    lumped = Part("clutch", "field", starts_pressed=True, **changes)
    one = Part("clutch", "fine", starts_pressed=True, **changes)
    derive_rings(one.par, 1)
    for n in range(200):
        for part in (one, lumped):
            part.step([6e3, 120.0 - 0.1 * n, 350.0, 0.0], 1e-5)
            assert part.work[layout.W_SUBSTEPS] == 1.0
    np.testing.assert_allclose(one.out, lumped.out, rtol=1e-9)


def test_rings_converge_with_second_order():
    torques = [engaged("fine", n, **SMOOTH)["friction_torque"] for n in (1, 2, 4, 8)]
    changes = np.abs(np.diff(torques))
    assert changes[0] / changes[1] == pytest.approx(4.0, rel=0.05)
    assert changes[1] / changes[2] == pytest.approx(4.0, rel=0.05)


def test_a_narrow_pack_is_as_good_lumped_as_in_rings():
    wide = [engaged(level, **SMOOTH).friction_torque[-1] for level in ("fine", "field")]
    narrow = [engaged(level, **NARROW, **SMOOTH).friction_torque[-1] for level in ("fine", "field")]
    assert abs(wide[0] / wide[1] - 1.0) > 1e-3
    assert narrow[0] == pytest.approx(narrow[1], rel=2e-6)


def test_outer_rings_are_hotter_and_their_mean_is_shown():
    part = Part("clutch", "fine")
    for _ in range(50):
        part.step([6e3, 120.0, 350.0, 0.0], 2e-3)
    surface = part.work[layout.W_SURFACE :][: layout.N_RINGS]
    assert np.all(np.diff(surface) > 0.4)
    assert surface[0] < part["temperature"] < surface[-1]


def test_clutch_levels_hold_the_same_static_torque():
    held = [
        solve_clutch(ClutchParams(), load=5e3, speed=0.0, fidelity=level).torque_capacity
        for level in LADDER["clutch"][1:]
    ]
    assert held == pytest.approx([held[0]] * len(held), rel=1e-9)


# Levels that are gone: their names run the next better one, give its numbers and say so.

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
