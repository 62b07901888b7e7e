"""A parameter that the choices next to it leave unread is told; nothing of the package's own is."""

from dataclasses import fields

import pytest

from thrustwasher import ClutchParams, GearMeshParams, WasherParams, solve_clutch
from thrustwasher.model.idle import idle_warnings
from thrustwasher.model.part_file import find_part, preset_parts
from thrustwasher.model.registry import all_models
from thrustwasher.shift import load_scene
from thrustwasher.train.parameters import TrainParams
from thrustwasher.transmission.parameters import TransmissionParams


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
