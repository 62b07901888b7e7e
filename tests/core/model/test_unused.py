"""Every parameter of every model moves an output at one of its points, or is said to do nothing.

What is said of one that is not used is true as well: moved, it leaves every output as it was.
"""

import re
from dataclasses import fields, replace
from itertools import pairwise

import numpy as np
import pytest

from thrustwasher import ClutchParams, GearMeshParams, WasherParams, solve_clutch
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.documentation.reference_results import input_rows
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.model.idle import idle_warnings
from thrustwasher.model.part_file import find_part, preset_parts
from thrustwasher.model.registry import all_models, all_specs, find_spec
from thrustwasher.model.unread import unread
from thrustwasher.shift import load_scene
from thrustwasher.train.parameters import TrainParams
from thrustwasher.transmission.parameters import TransmissionParams

ROWS = 12  # points in time of a run
ROUNDING = 1e-9  # of an output: what steps that are cut elsewhere may move
KEYS = [s.key for s in all_specs()]
QUICK = [(k, k == "train") for k in KEYS if k != "washer"]  # a train's first mesh and shaft
QUICK += [pytest.param(k, False, marks=pytest.mark.slow) for k in ("washer", "train")]
STEPS = (0.05, -0.05, 1e-3, -1e-3)  # of a value; a smaller one where the others are refused
SHARES = (0.05, 1e-3, 1e-5)  # of the range, where a value is 0


def meshes(**values):
    return {f"mesh_{i}_{name}": x for i in (1, 2) for name, x in values.items()}


def between(key, *rows, **others):
    """Return a profile of even rows; of inputs that are not named their usual values."""
    inputs, last = find_spec(key).inputs, len(rows) - 1
    usual = {s.name: s.usual for s in inputs} | others
    return tuple((i / last, *({**usual, **r}[s.name] for s in inputs)) for i, r in enumerate(rows))


def pushed(axial):
    """Return shafts of which one bearing takes all axial force, which counts much there."""
    takes = 1 if axial == "first" else 2
    found = {f"shaft_{i}_axial": axial for i in (1, 2, 3)}
    found |= {f"shaft_{i}_bearing_{k}_induced_factor": 0.0 for i in (1, 2, 3) for k in (1, 2)}
    return found | {f"shaft_{i}_bearing_{takes}_y_factor": 5.0 for i in (1, 2, 3)}


def back_to_back():
    """Return shafts on pairs in O whose bearings induce axial forces, each below its own e."""
    found = {f"shaft_{i}_axial": "O" for i in (1, 2, 3)}
    own = {"induced_factor": 0.3, "e_factor": 0.3}
    ends = [f"shaft_{i}_bearing_{k}" for i in (1, 2, 3) for k in (1, 2)]
    return found | {f"{end}_{name}": x for end in ends for name, x in own.items()}


def scene(name, **changes):
    """Return the transmission of a built-in scene."""
    part = load_scene(name).parts["transmission"]
    return {**part.parameters(), **changes}


PACK = ({"load": 2e3, "speed": 2.0}, {"load": 4e3, "speed": 0.0}, *({"load": 0.0},) * 4)
FROM_REST = ({"load": 40.0, "speed": 0.0}, {"load": 40.0, "speed": 2.0})
AT_WORK = ({"load": 200.0, "speed": 300.0},) * 2
LOADED = ({"torque": 150.0, "speed": 300.0}, {"torque": 250.0, "speed": 20.0})
LOADED = (*LOADED, {"torque": -150.0, "speed": 300.0})
SPUR = {"film_heat": "atan", "helix_angle": 0.0, "friction_law": "li-seireg"}
SIZE = {"normal_module": 2e-3, "pinion_teeth": 20, "gear_ratio": 3.0}
TIPS = {"tip_diameter_pinion": 0.044, "tip_diameter_gear": 0.124, "addendum_gear": 1.0}
MOUNTED = {"profile_shift_gear_from_distance": True, "working_centre_distance": 0.0802}
HEATS = {f"heat_{i}": 1e3 * i for i in range(1, 8)} | {f"energy_{i}": 0.0 for i in range(1, 8)}
PISTONS = {"piston_inner_radius": 0.03, "piston_outer_radius": 0.05, "piston_supply_radius": 0.02}
# Points beside the model's own example, where what has no effect there acts.
POINTS = {
    "washer": [
        ({}, between("washer", {"load": 20.0}, {"load": 3e3}, speed=100.0)),
        ({"thermal_mode": "transient", "conduction": "all"}, None),
        ({"friction_law": "constant"}, between("washer", {"load": 3e3}, {"load": 1e3})),
        ({"holding": "off"}, between("washer", {"speed": 5.0}, {"speed": -5.0})),
        ({"fidelity": "map"}, between("washer", {"load": 3e3}, {"load": 2e4})),
    ],
    "clutch": [
        ({"holding": "off"}, between("clutch", *PACK)),
        ({"fidelity": "closed", "friction_law": "wang", "groove_count": 0}, None),
        ({"fidelity": "stribeck", "viscosity_constant": 0.0, "viscosity_scale": 0.02}, None),
        ({"film_dynamics": False}, None),
        ({"contact_rise": True, "holding": "given", "starts_pressed": True}, None),
    ],
    "gearmesh": [
        ({}, between("gearmesh", *FROM_REST)),
        ({}, between("gearmesh", *AT_WORK)),
        ({"root_limit": 4e8, "f0": 0.02, "boundary_friction": 0.02}, None),
        ({**SIZE, "internal": True, "addendum_gear": 0.8}, None),
        ({**SIZE, **TIPS}, None),
        ({**SIZE, **MOUNTED}, None),
        ({"permissible_film_ratio": 0.5}, between("gearmesh", *AT_WORK)),
        ({"holding": "off"}, between("gearmesh", *FROM_REST)),
    ],
    "transmission": [
        (scene("planetary"), None),
        (scene("msl"), None),
        ({"helix_angle": 0.0, "coupling": "torque"}, None),
        (scene("planetary", shaft_stiffness=1e4, **PISTONS), None),
        (scene("planetary", clutch_fill_volume=1e-4, brake_fill_volume=1e-4), None),
        ({"planet_teeth": 17, "profile_shifted": True}, None),
        ({"needle_count": 18, "ring_mesh": True}, None),
        ({"sun_bearing_coefficient": 0.01, "ring_bearing_coefficient": 0.01}, None),
    ],
    "sump": [({}, between("sump", HEATS, HEATS))],
    "losses": [
        ({f"{shaft}_bearing_count": 0 for shaft in ("input", "output", "drum")}, None),
        ({f"{shaft}_immersion": 0.1 for shaft in ("input", "drum")}, None),
    ],
    "train": [
        ({}, between("train", *LOADED)),
        ({"meshes": 3}, between("train", *LOADED)),
        (pushed("first"), between("train", *LOADED)),
        (pushed("second"), between("train", *LOADED)),
        (back_to_back(), between("train", *LOADED)),
        (meshes(**SPUR) | {"thermal_mode": "quasi_steady"}, between("train", *LOADED)),
    ],
}


def outputs(spec, parameters, profile):
    """Return all outputs at even times over a profile."""
    table = np.array(profile or input_rows(spec))
    times = np.linspace(table[0, 0], table[-1, 0], ROWS + 1)
    points = np.array([np.interp(times, table[:, 0], column) for column in table.T[1:]]).T.tolist()
    with DirectInstance(spec, parameters=parameters) as model:
        model.initialize(times[0], dict(zip(model.input_names, points[0], strict=True)))
        found = [model.outputs()]
        for i, (a, b) in enumerate(pairwise(times)):
            model.set_inputs(points[i])
            model.step(a, b - a)
            found.append(model.outputs())
    return np.array(found)


def moved(meta, value):
    """Return other values of a parameter, 5 % away, or of its range where it is 0."""
    if "options" in meta:
        return [name for name in meta["options"] if name != value]
    if meta["kind"] == "boolean":
        return [not value]
    low, high = meta["min"], meta["max"]
    if meta["kind"] == "integer":
        near = [value + 1, value - 1]
    else:
        near = [(1.0 + x) * value for x in STEPS] if value else [x * high for x in SHARES]
    return [x for x in near if low <= x <= high]


def scanned(spec, parameters, profile, names):
    """Give name, "moves", "said" or "refused", which names it, and how far it moves outputs."""
    values = {k: x for k, x in parameters.items() if k != "fidelity"}
    level = parameters.get("fidelity", spec.default_fidelity)
    params, before = spec.params(**values), outputs(spec, parameters, profile)
    size = np.abs(before).max(axis=0) + 1e-300
    for name in names:
        found, far, errors = "", 0.0, []
        for value in moved(type(params).__dataclass_fields__[name].metadata, getattr(params, name)):
            try:
                after = outputs(spec, {**parameters, name: value}, profile)
            except (ParameterError, SolveError) as error:
                errors.append(str(error))
                continue
            far = max(far, float(np.nanmax(np.abs(after - before) / size)))
            if unread(replace(params, **{name: value}), name, level):
                found = "said"
            elif not np.array_equal(before, after, equal_nan=True):
                found = "moves"
                break
        named = re.sub(r"^mesh_\d_", "", name)
        yield name, found or ("refused" if any(named in text for text in errors) else ""), far


def points(key):
    """Return parameters and profile of the model's own example, then of the others."""
    return [({}, None), *POINTS.get(key, [])]


@pytest.mark.parametrize(("key", "first"), QUICK)
def test_every_parameter_moves_an_output_or_is_said_to_do_nothing(key, first):
    spec = find_spec(key)
    silent = [f.name for f in fields(spec.params) if "only_for" not in f.metadata]
    if first:
        silent = [name for name in silent if not re.match(r"(mesh|shaft)_[2-9]", name)]
    for number, (parameters, profile) in enumerate(points(key)):
        acts = {"moves", "refused", *(["said"] if number == 0 else [])}
        found = {n: what for n, what, _ in scanned(spec, parameters, profile, silent)}
        silent = [name for name in silent if found[name] not in acts]
    assert silent == []


@pytest.mark.slow
@pytest.mark.parametrize("key", KEYS)
def test_what_is_said_not_to_be_used_leaves_every_output_as_it_is(key):
    spec = find_spec(key)
    names = [f.name for f in fields(spec.params)]
    for parameters, profile in points(key):
        for name, what, far in scanned(spec, parameters, profile, names):
            assert what != "said" or far < ROUNDING, f"{name} moves outputs by {far:g}"


# A parameter that the choices next to it leave unread is told; nothing of the package's own is.


@pytest.mark.parametrize("model", [m.key for m in all_models()])
def test_defaults_and_presets_have_nothing_idle_on_any_level(model):
    spec = find_part(model).spec
    for part in (find_part(model), *preset_parts(spec).values()):
        for level in ("", *spec.levels):
            assert idle_warnings(model, part.params, level) == ()


TIMES = {f"engine_torque_time_{i}": 0.1 * i for i in range(1, 7)}
PLOUGHED = ClutchParams(plough_weight=0.2, stick_speed=2.0)
DRY = WasherParams(dry_friction=0.05)
IDLE = [
    ("washer", DRY, "", "dry_friction = 0.05", "friction_law = constant only"),
    ("clutch", PLOUGHED, "field", "plough_weight = 0.2, stick_speed = 2 m/s", "law = wang"),
    ("clutch", ClutchParams(table_friction_0=0.05), "closed", "table_friction_0", "stribeck or"),
    ("gearmesh", GearMeshParams(partition_share=0.3), "field", "partition_share", "is loss"),
    (
        "transmission",
        TransmissionParams(engine_torque=120.0, engine_torque_points=6, **TIMES),
        "",
        "engine_torque = 120 N·m",
        "engine_torque_points = 0 only; engine_torque_points is 6",
    ),
    (
        "train",
        TrainParams(mesh_3_partition_share=0.3),
        "",
        "mesh_3_partition_share = 0.3",
        "meshes >= 3 only; meshes is 2",
    ),
    (
        "train",
        TrainParams(shaft_2_seals=1),
        "",
        "shaft_2_seals = 1",
        "shaft_2_seal_diameter > 0 only; shaft_2_seal_diameter is 0",
    ),
]


@pytest.mark.parametrize(("model", "params", "level", "value", "reader"), IDLE)
def test_a_value_nobody_reads_is_told_with_what_would_read_it(model, params, level, value, reader):
    (line,) = idle_warnings(model, params, level)
    assert line.startswith(value) and reader in line and "has no effect: read by" in line


def test_a_description_names_the_condition():
    """Of one that is required in addition, of one that no model uses, of one that does little."""
    known = {f.name: f for params in (TransmissionParams, TrainParams) for f in fields(params)}
    words = {
        "engine_torque": "; used if engine_torque_points = 0",
        "thrust_share": "; used if needle_count = 0 and helix_angle > 0",
        "mesh_3_limiting_traction": "; used if mesh_3_friction_law = mixed or "
        "mesh_3_traction_law = limited, and meshes >= 3",
        "mesh_1_thermal_expansion": "; not used in this model",
        "required_life": "; only for warnings of results in Python",
    }
    for name, ending in words.items():
        assert known[name].metadata["help"].endswith(ending)


def test_what_the_scene_gives_a_part_is_not_told():
    """Planets' teeth bend both ways, the oil fills the pistons: of no effect, and nobody's."""
    part = load_scene("planetary").parts["mesh"]
    assert part.params.reversed_bending == 0.7 and part.params.root_limit == 0.0
    assert idle_warnings("gearmesh", part.params, part.fidelity, part.usual) == ()
    assert len(idle_warnings("gearmesh", part.params, part.fidelity)) == 1


def test_a_value_that_is_read_is_not_told():
    params = WasherParams(dry_friction=0.05, friction_law="constant")
    assert idle_warnings("washer", params) == ()
    params = ClutchParams(friction_law="constant", constant_friction=0.05)
    assert (
        idle_warnings("clutch", params, "closed") == idle_warnings("clutch", params, "field") == ()
    )


def test_a_level_that_passes_the_law_over_says_so_in_its_result():
    params = ClutchParams(table_friction_0=0.05)
    assert solve_clutch(params, load=1e3, speed=2.0, fidelity="field").warnings == ()
    (line,) = solve_clutch(params, load=1e3, speed=2.0, fidelity="closed").warnings
    assert "fidelity is closed" in line
