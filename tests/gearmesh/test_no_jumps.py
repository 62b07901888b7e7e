"""No number of a mesh jumps where a parameter passes its standard value, or is typed as that."""

import math
from dataclasses import replace

import pytest
from scipy.optimize import brentq

from thrustwasher import GearMeshParams, ParameterError, solve_gearmesh
from thrustwasher.gearmesh.kernels import constants
from thrustwasher.gearmesh.parameters import SPEC

SPUR = GearMeshParams(normal_module=2e-3, face_width=0.02, root_limit=430e6)
PLANET = GearMeshParams.preset("planet", root_limit=430e6, permissible_film_ratio=0.1)
RING = replace(PLANET, gear_ratio=74 / 18, internal=True, addendum_gear=0.8)
ELASTIC = replace(PLANET, helix_angle=0.0, load_sharing="elastic")
PAIRS = {"spur": SPUR, "planet": PLANET, "ring": RING, "elastic": ELASTIC}
STEP = 1e-9
PASSED = {  # parameter: what a step of it is over STEP
    "profile_shift_pinion": 1.0,
    "profile_shift_gear": 1.0,
    "tip_shortening": 1.0,
    "helix_angle": 1.0,
    "addendum": 1.0,
    "gear_ratio": 1.0,
    "pressure_angle": 1.0,
    "face_width": 1e-2,
    "normal_module": 1e-3,
    "load_factor": 1.0,
    "face_load_factor": 1.0,
    "mesh_load_factor": 1.0,
    "friction_scale": 1.0,
    "boundary_friction": 0.1,
    "f0": 0.1,
    "lubrication_factor": 1.0,
    "stiffness_at_ends": 1.0,
}


def outputs(params, **point):
    place = {"power": 7140.0, "speed": 510.0, "oil_temperature": 358.15} | point
    r = solve_gearmesh(params, **place)
    names = (*SPEC.real_outputs, "loss_factor", "contact_ratio")
    found = {n: getattr(r, n) for n in names if hasattr(r, n)}
    return {n: x for n, x in found.items() if x is not None}


def assert_same(a, b, rel=1e-6):
    assert a.keys() == b.keys()
    assert {n: (a[n], b[n]) for n in a if b[n] != pytest.approx(a[n], rel=rel, abs=1e-12)} == {}


@pytest.mark.parametrize("pair", PAIRS)
@pytest.mark.parametrize("name", PASSED)
def test_a_little_off_the_standard_value_changes_little(pair, name):
    params, tried = PAIRS[pair], 0
    held = outputs(params)
    for step in (STEP * PASSED[name], -STEP * PASSED[name]):
        try:
            near = replace(params, **{name: getattr(params, name) + step})
        except ParameterError:  # beyond its range
            continue
        assert_same(held, outputs(near))
        tried += 1
    assert tried


@pytest.mark.parametrize("pair", PAIRS)
def test_what_is_not_given_is_the_same_typed_in(pair):
    params = PAIRS[pair]
    held, r = outputs(params), solve_gearmesh(params, power=7140.0, speed=510.0)
    for changes in (
        {"tip_diameter_pinion": r.pinion_tip_diameter},
        {"tip_diameter_gear": r.gear_tip_diameter},
        {"working_centre_distance": r.centre_distance},
        {"addendum_gear": params.addendum_gear or params.addendum},
        {"contact_limit": 1500e6},
        {"contact_limit_gear": 1500e6},
        {"root_limit_gear": params.root_limit},
        {"mean_roughness": constants.MEAN_OVER_RMS * constants.SIGMA_ROUGH}
        if not params.mean_roughness
        else {"sigma_rms": constants.SIGMA_FINE},
        *({f"{name}_gear": getattr(params, name)} for name in ("youngs_modulus", "conductivity")),
        *({f"{name}_gear": getattr(params, name)} for name in ("poisson_ratio", "density")),
    ):
        assert_same(held, outputs(replace(params, **changes)), rel=1e-9)
    lengths = {"tip_relief_length_pinion": 1e-3, "tip_relief_length_gear": 1e-3}
    relief = {"tip_relief_pinion": 1e-15, "tip_relief_gear": 1e-15}
    # relief adds places to the sums over the path: the mean flash moves by its quadrature
    assert_same(held, outputs(replace(params, **relief, **lengths)), rel=2e-5)


@pytest.mark.parametrize("total", [2.0, 3.5])
def test_the_helical_factor_does_not_jump_where_it_begins_and_ends(total):
    below, above = (constants.helical_factor(total + d) for d in (-1e-12, 1e-12))
    assert below == pytest.approx(above, abs=1e-6)


def test_nothing_jumps_where_boundary_friction_begins_to_limit():
    turning = 1.0 / 18e-3
    pairs = [outputs(SPUR, speed=turning * (1.0 + d), power=500.0) for d in (-1e-9, 1e-9)]
    assert_same(*pairs)


def test_pitting_does_not_jump_at_a_contact_ratio_of_2():
    """Nor the loss; what the pairs share equally does: pressure, flash and film at A and E."""

    def pair(addendum):
        return replace(SPUR, pinion_teeth=60, addendum=addendum)

    def off(addendum):
        return outputs(pair(addendum))["contact_ratio"] - 2.0

    two = brentq(off, 1.0, 1.4, xtol=1e-14)
    below, above = (outputs(pair(two + d)) for d in (-1e-9, 1e-9))
    assert below["contact_ratio"] < 2.0 < above["contact_ratio"]
    for name in ("pitting_stress", "friction_power", "mean_friction", "root_stress"):
        assert below[name] == pytest.approx(above[name], rel=1e-6), name
    assert math.sqrt(0.5) < above["contact_pressure_max"] / below["contact_pressure_max"] < 1.0
