"""A parameter that the choices next to it leave unread is told; nothing of the package's own is."""

import pytest

from thrustwasher import ClutchParams, GearMeshParams, WasherParams, solve_clutch
from thrustwasher.model.idle import idle_warnings
from thrustwasher.model.part_file import find_part, preset_parts
from thrustwasher.model.registry import all_models


@pytest.mark.parametrize("model", [m.key for m in all_models()])
def test_defaults_and_presets_have_nothing_idle_on_any_level(model):
    spec = find_part(model).spec
    for part in (find_part(model), *preset_parts(spec).values()):
        for level in ("", *spec.levels):
            assert idle_warnings(model, part.params, level) == ()


PLOUGHED = ClutchParams(plough_weight=0.2, stick_speed=2.0)
DRY = WasherParams(dry_friction=0.05)
IDLE = [
    ("washer", DRY, "", "dry_friction = 0.05", "friction_law = constant only"),
    ("clutch", PLOUGHED, "field", "plough_weight = 0.2, stick_speed = 2 m/s", "law = wang"),
    ("clutch", ClutchParams(table_friction_0=0.05), "closed", "table_friction_0", "stribeck or"),
    ("gearmesh", GearMeshParams(partition_share=0.3), "field", "partition_share", "is loss"),
]


@pytest.mark.parametrize(("model", "params", "level", "value", "reader"), IDLE)
def test_a_value_nobody_reads_is_told_with_what_would_read_it(model, params, level, value, reader):
    (line,) = idle_warnings(model, params, level)
    assert line.startswith(value) and reader in line and "has no effect: read by" in line


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
