"""A parameter given as it is without being given changes nothing and is not told."""

import json
from dataclasses import fields, replace

import pytest

from thrustwasher import ClutchParams, solve_clutch, solve_gearmesh
from thrustwasher.cli.common._options import read_settings
from thrustwasher.model.idle import idle_warnings, kept_warnings
from thrustwasher.model.parameters import as_numbers
from thrustwasher.model.part_file import find_part, load_part, preset_parts
from thrustwasher.model.quantity import other_of
from thrustwasher.model.registry import all_models
from thrustwasher.model.unread import unread

MODELS = pytest.mark.parametrize("model", all_models(), ids=lambda m: m.key)
OF_PINION = ("conductivity_gear", "heat_capacity_gear", "density_gear")
NUMBERS = ("friction_power", "film_thickness", "film_ratio_gf", "flash_max", "pitting_safety")


@MODELS
def test_each_start_value_given_is_the_same_to_the_bit(model):
    """In Python and by ``--set``; a kernel sees the numbers alone."""
    spec = model.spec
    plain = spec.params()
    told = idle_warnings(spec.key, plain)
    for f in fields(spec.params):
        value = getattr(plain, f.name)
        given = spec.params(**{f.name: value})
        assert as_numbers(given) == as_numbers(plain), f.name
        assert idle_warnings(spec.key, given) == told, f.name
        if f.metadata["kind"] != "boolean":
            assert read_settings([f"{f.name}={value}"], spec) == {f.name: value}


@MODELS
def test_a_part_file_of_start_values_is_the_model_itself(model, tmp_path):
    spec, path = model.spec, tmp_path / "part.toml"
    plain = find_part(spec.key)
    head = f'model = "{spec.key}"\nname = "Given"\n[parameters]\n'
    for f in fields(spec.params)[:: max(1, len(fields(spec.params)) // 130)]:
        path.write_text(f"{head}{f.name} = {json.dumps(getattr(plain.params, f.name))}\n")
        part = load_part(path)
        assert as_numbers(part.params) == as_numbers(plain.params), f.name
        assert kept_warnings(part) == kept_warnings(plain), f.name


def gear_meshes():
    """Yield default and presets of the gear mesh with each value that stands behind a 0 given."""
    default = find_part("gearmesh")
    parts = {"default": default, **preset_parts(default.spec)}
    for preset, part in parts.items():
        params = part.params
        for f in fields(params):
            other = other_of(f.metadata)
            if getattr(params, f.name) == 0.0 and other and not unread(params, f.name, "field"):
                value = other(params) if callable(other) else getattr(params, other)
                yield pytest.param(params, f.name, value, id=f"{preset}-{f.name}")
        for f in fields(params):
            own = f.name.removesuffix("_gear")
            if f.name.endswith("_gear") and f.name in OF_PINION and not getattr(params, f.name):
                yield pytest.param(params, f.name, getattr(params, own), id=f"{preset}-{f.name}")


@pytest.mark.parametrize(("params", "name", "value"), gear_meshes())
def test_what_stands_behind_a_zero_is_the_same_when_given(params, name, value):
    """Module, distance, tips, roughness, limits, materials equal to the pinion's, alpha."""
    point = {"power": 7500.0, "speed": 180.0, "oil_temperature": 340.0}
    plain, given = (solve_gearmesh(p, **point) for p in (params, replace(params, **{name: value})))
    for number in NUMBERS:
        found = getattr(given, number)
        assert found == pytest.approx(getattr(plain, number), rel=1e-9), number
    assert given.warnings == plain.warnings


def test_the_clutchs_own_radius_given_is_the_same():
    plain = ClutchParams()
    given = replace(plain, effective_radius=plain.friction_radius)
    point = {"load": 3000.0, "speed": 5.0}
    torques = [solve_clutch(p, **point).friction_torque for p in (plain, given)]
    assert torques[0] == pytest.approx(torques[1], rel=1e-12)
