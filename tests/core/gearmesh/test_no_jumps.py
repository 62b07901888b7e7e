"""No number of a mesh jumps where a parameter passes its standard value, or is typed as that."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from lab.jumps import find_jumps
from lab.mesh_jumps import CAUSES, LEFT, QUANTITIES, Asked, pairs, scan_all
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


def test_nothing_jumps_at_a_contact_ratio_of_2():
    """A pair more takes over within a twentieth of a base pitch; pitting and loss have no such."""

    def pair(addendum):
        return replace(SPUR, pinion_teeth=60, addendum=addendum)

    def off(addendum):
        return outputs(pair(addendum))["contact_ratio"] - 2.0

    two = brentq(off, 1.0, 1.4, xtol=1e-14)
    below, above = (outputs(pair(two + d)) for d in (-1e-12, 1e-12))
    assert below["contact_ratio"] < 2.0 < above["contact_ratio"]
    assert_same(below, above)


def test_the_end_of_the_path_counts_for_the_film_of_spur_teeth_too():
    """Rounding put E beyond its own end at some ratios: its film was left out, 2.5 times too thick.

    Neighbours of the pinion's 20 teeth, whose gear has 13.766 teeth and interferes nearly.
    """
    films = [
        outputs(replace(SPUR, gear_ratio=x, root_limit=0.0))["film_ratio_gf"]
        for x in (0.6883, 0.688314, 0.68833, 0.6884)
    ]
    assert films == pytest.approx([films[0]] * 4, rel=5e-3)


def test_every_quantity_has_numbers_where_its_scan_begins():
    asked = [Asked(name) for name in ("spur", "spur, distance given", "paper")]

    def most(quantity):
        return max(
            sum(pair.numbers(quantity, x) is not None for x in pair.start(quantity))
            for pair in asked
        )

    found = {q: most(q) for q in QUANTITIES}
    assert {q: n for q, n in found.items() if n < 4} == {}


def test_a_few_scans_over_whole_ranges_find_no_jump():
    """``python -m lab.mesh_jumps`` has all pairs and quantities."""
    names = ("spur, contact ratio about 2", "ring, helical")
    for name, values, _, jumps in scan_all(names, ("addendum", "profile_shift_pinion")):
        assert values > 500 and jumps == [], name


@pytest.mark.slow
@pytest.mark.parametrize("name", pairs())
def test_over_whole_ranges_only_what_is_listed_jumps(name):
    """Else: docs/accuracy.md, python -m lab.tables mesh-jumps."""
    ((_, values, _, jumps),) = scan_all([name])
    assert values > 10_000
    assert {j.cause for j in jumps} == LEFT.get(name, set()) <= set(CAUSES)


@pytest.mark.parametrize("step", [0.0, 1e-3, 0.3])
def test_a_jump_is_found_where_it_is_and_a_steep_slope_is_none(step):
    """A step of the second of two numbers at 0.3; the first has a root's slope without bound."""

    def numbers(x):
        return None if x > 0.9 else np.array([math.sqrt(x), 1.0 + step * (x >= 0.3)])

    found = find_jumps(numbers, [0.0, 0.25, 0.5, 1.0], 1e-4, np.full(2, 1e-9))
    assert [j.which for j in found.jumps] == ([(1,)] if step else [])
    assert all(j.low < 0.3 <= j.high and j.high - j.low < 1e-15 for j in found.jumps)
    assert found.refused > 0


def test_a_value_that_stands_alone_is_found():
    def numbers(x):
        return np.array([1.1 if x == 0.5 else 1.0])

    found = find_jumps(numbers, [0.0, 0.5, 1.0], 1e-4, np.full(1, 1e-9))
    assert len(found.jumps) == 2  # on both sides of it
