"""Rules between parameters: one test in the kernel, one text each, for every surrounding."""

import math
from dataclasses import fields
from string import Formatter

import numpy as np
import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.gearmesh import parameters as gearmesh_params
from thrustwasher.model.parameters import as_numbers
from thrustwasher.model.registry import find_spec, kernel_of
from thrustwasher.transmission import parameters as transmission_params
from thrustwasher.washer import parameters as washer_params

SPECS = [find_spec(key) for key in ("washer", "clutch", "gearmesh", "transmission")]
POINTS = {
    "friction_temperature": "points",
    "point_temperature_1": 300.0,
    "point_friction_1": 0.1,
    "point_temperature_2": 310.0,
    "point_friction_2": 0.1,
}


def warmer(k):
    """Return temperatures of points that rise before the k-th."""
    return {f"point_temperature_{n}": 300.0 + 10.0 * (n - 1) for n in range(3, k)}


BROKEN = {
    "washer": (
        {"gear_inner_radius": 0.01},
        {"inner_radius": 0.002, "outer_radius": 0.05},
        {"roughness_carrier": 1e-7},
        {"roughness_washer": 1e-9},
        {"roughness_gear": 1.4e-7},
        {"friction_pressure_min": 2e6},
        {"asperity_height_law": "summit", "asperity_density": 1e9},
        *(
            {f"{name}_{body}": value}
            for name, value in (
                ("youngs_modulus", 1e8),
                ("yield_strength", 1e6),
                ("conductivity", 0.01),
                ("density", 100.0),
                ("specific_heat", 10.0),
            )
            for body in washer_params.BODIES
        ),
        {"yield_strength": 5e10, "youngs_modulus": 1e9},
        {"yield_strength": 5e9, "youngs_modulus_gear": 1e9},
        {"oil_supply_temperature": 100.0},
        {"film_heat_fraction": 0.5},
        {"oil_cooling": False, "cavity_shear": "liquid"},
        {"thermal_mode": "transient"},  # without a level that has bodies
        {"gear_far_face": "bulk"},  # likewise
    ),
    "clutch": (
        {"inner_radius": 0.085},
        {"friction_law": "table", "table_speed_1": 0.0},
        {"friction_law": "table", "table_speed_2": 0.1},
        {"friction_law": "table", "table_speed_3": 0.2},
        {"friction_law": "table", "table_speed_4": 1.0},
        {"friction_law": "table", "table_speed_5": 8.0},
        {"groove_width": 0.02},
        {**POINTS, "point_friction_2": 0.0},
        {**POINTS, "point_friction_4": 0.1},
        {**POINTS, "point_temperature_1": 223.15},
        {**POINTS, "point_temperature_2": 300.0},
        *(
            {**POINTS, **{f"point_friction_{n}": 0.1 for n in range(3, k + 1)}, **warmer(k)}
            for k in (3, 4, 5)
        ),
    ),
    "gearmesh": (
        {"pinion_teeth": 14},
        {"addendum": 0.4},
        {"effective_roughness": 7e-5, "friction_law": "li-seireg"},
        {"f0": 0.02, "friction_law": "li-seireg"},
        {"pinion_teeth": 200, "friction_law": "li-seireg"},
        {"addendum": 1.5, "addendum_gear": 0.3, "gear_ratio": 1.0, "pinion_teeth": 12},
        {"film_heat": "atan", "helix_angle": 0.3},
        {"contact_limit": 1e7},
        {"addendum_gear": 0.1},
        {"normal_module": 1e-5},
        {"permissible_film_ratio": 1e-3},
        {"working_centre_distance": 1e-4},
        {"tip_diameter_pinion": 1e-4},
        {"tip_diameter_gear": 1e-4},
        {"profile_shift_gear_from_distance": True},
        {"working_centre_distance": 0.26},
        {"profile_shift_pinion": -2.0, "profile_shift_gear": -5.0},
        {"profile_shift_pinion": 2.0},
        {"root_limit": 1e6},
        {"root_limit": 1e8, "tool_tip_radius": 0.6},
        {"load_sharing": "elastic", "film_heat": "atan"},
        {"load_sharing": "elastic", "addendum": 1.5, "pinion_teeth": 200, "pressure_angle": 0.25},
        {"load_sharing": "elastic", "tip_relief_pinion": 1e-5},
        {"youngs_modulus_gear": 1e6},
        {"density_gear": 1.0},
        {"pressure_viscosity": 1e-12},
        {"efficiency_back": 0.005, "friction_law": "efficiency"},
    ),
    "transmission": (
        {"ring_teeth": 30, "planet_teeth": 0},
        {"planet_teeth": 20},
        {"shaft_damping": 1.0},
        {"initial_twist": -0.1},
        {"planets": 5},
        {"planets": 8},
        {"piston_inner_radius": 0.05},
        {"piston_supply_radius": 0.05},
        *({f"{name}_points": 2} for name in transmission_params.PROFILES),
        {"sun_bearing_shaft_2": "sun"},
        {"ring_bearing_shaft_1": "case"},
        {"sun_bearing_coefficient": 0.1, "sun_bearing_mean_radius": 0.5},
        {"ring_bearing_coefficient": 0.1, "ring_bearing_mean_radius": 0.5},
    ),
}
CASES = [(spec, n, change) for spec in SPECS for n, change in enumerate(BROKEN[spec.key], 1)]
OF_A_MAP = {"thermal_mode", "gear_far_face"}  # Python knows of no fidelity yet
IN_PYTHON = [case for case in CASES if not OF_A_MAP & set(case[2])]


def numbers(spec, change):
    """Return the parameters as the kernel takes them, whether they go together or not."""
    par = np.zeros(kernel_of(spec).NPAR)
    good = as_numbers(spec.params())
    par[: len(good)] = good
    for place, f in enumerate(fields(spec.params)):
        if f.name in change:
            value = change[f.name]
            if f.metadata["kind"] == "enumeration":
                value = list(f.metadata["options"]).index(value) + 1
            par[place] = value
    return par


@pytest.mark.parametrize("spec", SPECS, ids=lambda s: s.key)
def test_default_parameters_keep_all_rules(spec):
    assert kernel_of(spec).broken_rule(numbers(spec, {})) == 0
    assert len(spec.rules) == len(BROKEN[spec.key])


@pytest.mark.parametrize(("spec", "number", "change"), CASES)
def test_the_kernel_gives_the_number_of_the_broken_rule(spec, number, change):
    assert kernel_of(spec).broken_rule(numbers(spec, change)) == number


@pytest.mark.parametrize(("spec", "number", "change"), IN_PYTHON)
def test_python_refuses_with_the_text_of_that_rule(spec, number, change):
    rule = spec.rules[number - 1]
    with pytest.raises(ParameterError) as said:
        spec.params(**change)
    first = rule.text.partition(" ")[0]
    assert str(said.value).startswith(first)
    if rule.exact is None:
        values = {f.name: repr(change.get(f.name, f.default)) for f in fields(spec.params)}
        assert str(said.value) == rule.text.format(**values)


def test_bodies_store_heat_in_levels_that_have_bodies():
    spec = washer_params.SPEC
    par = numbers(spec, {"thermal_mode": "transient"})
    for number, level in enumerate(spec.fidelities, 1):
        par[kernel_of(spec).N_PARAM - 1] = number
        assert (kernel_of(spec).broken_rule(par) == 0) == (level != "map")


@pytest.mark.parametrize("spec", SPECS, ids=lambda s: s.key)
def test_texts_hold_plain_names_of_parameters_only(spec):
    known = {f.name for f in fields(spec.params)}
    for rule in spec.rules:
        parts = [p[1:] for p in Formatter().parse(rule.text) if p[1] is not None]
        assert {name for name, _, _ in parts} <= known
        assert all(not form and not conversion for _, form, conversion in parts)


@pytest.mark.parametrize("spec", SPECS, ids=lambda s: s.key)
def test_rules_and_constants_do_not_read_each_other(spec):
    """Rules hold before the constants are there, and may be asked again afterwards."""
    par = numbers(spec, {})
    par[kernel_of(spec).N_PARAM :] = math.nan
    assert kernel_of(spec).broken_rule(par) == 0


def test_limits_in_texts_are_those_of_the_kernels():
    from thrustwasher.gearmesh.kernels import constants
    from thrustwasher.washer.kernels import regime_and_status as washer_rules

    assert washer_params.LEAST_ROUGHNESS == washer_rules.LEAST_ROUGHNESS
    assert f"{washer_rules.LARGEST_SPREAD:g} x" in washer_params.RULES[1].text
    span = f"{constants.LEAST_EFFECTIVE:.4g} .. {constants.LARGEST_EFFECTIVE:.4g}"
    assert span in gearmesh_params.RULES[2].text
    assert f"above {constants.LEAST_SLIDE_ROLL} " in gearmesh_params.RULES[4].text
