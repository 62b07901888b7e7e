"""The gear mesh as a library: numbers at the operating points of the paper, ranges, messages."""

import math
import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from scipy.optimize import brentq

from lab.jumps import find_jumps
from lab.mesh_jumps import CAUSES, LEFT, QUANTITIES, Asked, pairs, scan_all
from lab.tables import PAGES, blocks, jumps_table
from thrustwasher import GearMeshParams, ParameterError, SolveError, solve_gearmesh, solve_losses
from thrustwasher.errors import Status
from thrustwasher.gearmesh import law_ranges as mesh
from thrustwasher.gearmesh.kernels import constants
from thrustwasher.gearmesh.parameters import SPEC
from thrustwasher.losses import loss_ranges as losses
from thrustwasher.losses.parameters import LossesParams
from thrustwasher.model.advice import LawRange
from thrustwasher.model.part_file import preset_parts

paper = partial(GearMeshParams.preset, "paper")
POINT = {"power": 7500.0, "speed": 180.0}


def at(ratio, teeth, preset="bounded", **changes):
    params = GearMeshParams.preset(preset, gear_ratio=ratio, pinion_teeth=teeth, **changes)
    return solve_gearmesh(params, **POINT)


# gear ratio, teeth: x_s, V_s [m/s], p0 [MPa], film ratio rough and fine, flash rise rough and fine
CONTACT = [
    (2, 20, 0.08683, 5.782, 233.5, 1.397, 5.580, 27.14, 15.37),
    (2, 30, 0.16217, 4.015, 178.4, 1.846, 7.372, 12.12, 6.82),
    (5, 20, 0.03342, 2.500, 517.4, 0.471, 1.880, 39.98, 22.55),
    (5, 30, 0.07598, 1.702, 350.9, 0.725, 2.895, 15.06, 8.38),
]


@pytest.mark.parametrize(("ratio", "teeth", "xs", "slide", "p0", "lr", "lf", "fr", "ff"), CONTACT)
def test_contact_film_and_flash_at_the_papers_points(ratio, teeth, xs, slide, p0, lr, lf, fr, ff):
    rough = at(ratio, teeth, viscosity_at="inlet")
    fine = at(ratio, teeth, viscosity_at="inlet", surface="fine")
    assert rough.start_of_contact == pytest.approx(xs, abs=6e-6)
    assert rough.sliding_speed == pytest.approx(slide, abs=6e-4)
    assert rough.hertz_pressure == pytest.approx(p0 * 1e6, abs=6e4)
    assert (rough.film_ratio, fine.film_ratio) == pytest.approx((lr, lf), abs=6e-4)
    assert (rough.flash_rise, fine.flash_rise) == pytest.approx((fr, ff), abs=6e-3)


# bounded and literal reading: rise or temperature of asperities, K and allowable ratio, 1020, 4340
STRESSES = [
    (2, 20, 147, 277, 0.856, 0.477, 112.5, 2.48, 0.536, 6.52, 0.365),
    (2, 30, 0.2, 0.2, 1.0, 1.0, 64.9, 0.842, 0.737, 2.21, 0.558),
    (5, 20, 193, 364, 0.941, 0.675, 152.7, 1.09, 0.691, 2.86, 0.509),
    (5, 30, 107, 202, 0.960, 0.745, 73.8, 0.331, 0.867, 0.869, 0.732),
]


@pytest.mark.parametrize(("ratio", "teeth", *"abcdefghi"), STRESSES)
def test_asperities_and_allowable_ratios_of_both_steels(ratio, teeth, a, b, c, d, e, f, g, h, i):
    for steel, rise, share in (("AISI1020", a, c), ("AISI4340", b, d)):
        r = at(ratio, teeth, viscosity_at="inlet", steel=steel)
        assert r.asperity_temperature - 299.85 == pytest.approx(rise, abs=0.5 if rise > 1 else 0.05)
        assert r.allowable_ratio == pytest.approx(share, abs=6e-4)
        assert r.allowable_ratio == getattr(r, f"allowable_ratio_{steel.lower()}")
        assert r.modification_factor == getattr(r, f"modification_factor_{steel.lower()}")
    r = at(ratio, teeth, "literal")
    assert r.asperity_temperature - 273.15 == pytest.approx(e, abs=0.06)
    found = r.modification_factor_aisi1020, r.modification_factor_aisi4340
    assert found == pytest.approx((f, h), rel=4e-3)
    assert (r.allowable_ratio_aisi1020, r.allowable_ratio_aisi4340) == pytest.approx(
        (g, i), abs=6e-4
    )


@pytest.mark.parametrize(
    ("ratio", "surface", "f"),
    [(2, "fine", 0.020), (2, "rough", 0.028), (5, "fine", 0.029), (5, "rough", 0.041)],
)
def test_iso_friction_is_two_to_three_times_below_boundary_friction(ratio, surface, f):
    iso = at(ratio, 30, "iso", surface=surface).friction_coefficient
    assert iso == pytest.approx(f, abs=5e-4)
    assert 1.5 < at(ratio, 30, surface=surface).friction_coefficient / iso < 4.0


def test_sharp_switch_jumps_at_1_4_and_the_smooth_one_is_half_way_there():
    # the film ratio of the base case with the viscosity of the inlet is 1.397
    found = {s: at(2, 20, viscosity_at="inlet", switch=s) for s in ("sharp", "smooth", "none")}
    rises = {s: r.asperity_temperature - r.surface_temperature for s, r in found.items()}
    assert rises["sharp"] == rises["none"] == pytest.approx(2.0 * rises["smooth"], rel=0.02)
    above = at(2, 20, viscosity_at="inlet", switch="sharp", sigma_rms=2.25e-6)
    assert above.asperity_temperature == above.surface_temperature
    literal = at(2, 20, "literal", switch="sharp", sigma_rms=1e-6)
    assert literal.asperity_temperature == literal.film_temperature


def test_overrides_of_the_surface_replace_its_values():
    rough = at(2, 20, mean_roughness=1.6e-6)
    same = at(
        2, 20, surface="fine", sigma_rms=2.26e-6, effective_roughness=4.5e-5, mean_roughness=1.6e-6
    )
    assert same == rough
    assert at(2, 20, "iso", mean_roughness=3.2e-6).friction_coefficient == pytest.approx(
        2**0.25 * at(2, 20, "iso", mean_roughness=1.6e-6).friction_coefficient, rel=1e-12
    )


def test_presets_are_named_sets_of_changes():
    assert paper() == GearMeshParams.preset("bounded")
    literal = GearMeshParams.preset("literal", pinion_teeth=25)
    assert (literal.face_width, literal.area_law, literal.pinion_teeth) == (1.0, "constant", 25)
    assert set(preset_parts(SPEC)) == {"paper", "bounded", "literal", "iso", "planet"}
    with pytest.raises(ParameterError, match="preset = 'atan', allowed: 'bounded' or 'iso'"):
        GearMeshParams.preset("atan")


P = paper()


def test_the_way_out_of_li_seireg_works():
    r = solve_gearmesh(paper(pinion_teeth=200, friction_law="iso"), **POINT)
    assert r.status == Status.OK and r.slide_roll_ratio < 0.27


def test_a_flank_that_is_not_found_is_a_solve_error(monkeypatch):
    from thrustwasher.gearmesh import solve

    monkeypatch.setattr(solve, "solve_point", lambda *_: int(Status.MAX_ITERATIONS))
    with pytest.raises(SolveError, match=r"power = 7500 W.*not converged"):
        solve_gearmesh(P, **POINT)
    r = solve_gearmesh(P, **POINT, throw=False)
    assert r.status == Status.MAX_ITERATIONS


@pytest.mark.parametrize("preset", preset_parts(SPEC))
def test_without_load_nothing_is_heated_and_no_stress_is_modified(preset):
    r = solve_gearmesh(GearMeshParams.preset(preset), power=0.0, speed=180.0)
    assert (r.flash_rise, r.friction_torque) == (0.0, 0.0)
    if preset != "planet":
        assert r.modification_factor < 1e-3 and r.allowable_ratio > 0.999


# Every empirical law of mesh and losses says where it is outside its range, with the limit.

PAIR = GearMeshParams(normal_module=4e-3, face_width=0.02)
HIGH = {"pinion_teeth": 120, "addendum": 1.4, "normal_module": 2e-3}
SHIFTED = {"profile_shift_pinion": 1.1, "profile_shift_gear": 1.1, "pinion_teeth": 60}
ELASTIC = {"load_sharing": "elastic"}
INSIDE = {"power": 40e3, "speed": 200.0}  # 266 N/mm, 8 m/s
OUTSIDE = [  # range; pair and point outside of it; pair inside
    (mesh.LOAD, {}, {"power": 20e3}, {}),
    (mesh.LOAD, {"friction_law": "iso"}, {"power": 20e3}, {}),
    (mesh.LOAD, {"friction_law": "mixed"}, {"power": 20e3}, {}),
    (mesh.SLOW, {}, {"speed": 1300.0, "power": 300e3}, {}),
    (mesh.SLOW, {"friction_law": "iso"}, {"speed": 20.0, "power": 4e3}, {}),
    (mesh.STIFF, ELASTIC, {"power": 9e3}, ELASTIC),
    (mesh.STIFF, ELASTIC, {"power": 300e3}, ELASTIC),
    (mesh.SHIFTS, {**SHIFTED, **ELASTIC}, {}, {**SHIFTED, **ELASTIC, "profile_shift_gear": 0.5}),
    (mesh.CONTACT, HIGH, {}, {**HIGH, "addendum": 1.1}),
    (mesh.HELIX, {"helix_angle": math.radians(35.0)}, {}, {"helix_angle": math.radians(25.0)}),
    (mesh.ANGLE, {"pressure_angle": math.radians(27.0)}, {}, {}),
]


def said_of(limits: LawRange, lines):
    return [s for s in lines if f"{limits.quantity} = " in s and f"the range of {limits.law}" in s]


@pytest.mark.parametrize(("limits", "changes", "point", "inside"), OUTSIDE)
def test_a_mesh_outside_the_range_of_a_law_says_so_with_the_limit(limits, changes, point, inside):
    lines = solve_gearmesh(replace(PAIR, **changes), **{**INSIDE, **point}).warnings
    (line,) = said_of(limits, lines)
    assert any(f"{side:g}" in line for side in (limits.low, limits.high))
    near = solve_gearmesh(replace(PAIR, **inside), **INSIDE).warnings
    assert said_of(limits, near) == []


USUAL = {"input_speed": 209.4, "output_speed": 100.0, "oil_temperature": 353.15}
LOSSES = [
    ("Froude number", {"output_speed": 900.0}),
    ("Reynolds number", {"output_speed": 100.0, "oil_temperature": 253.15}),
    ("depth over diameter", {"output_immersion": 0.05}),
    ("heated and starved", {"output_speed": 240.0, "oil_temperature": 253.15}),
    ("speed times mean diameter", {"input_speed": 2200.0}),
    ("their formula falls below", {"oil_temperature": 405.0}),
    ("speed of the lip", {"input_speed": 1800.0}),
    ("viscosity ratio kappa", {}),
]


@pytest.mark.parametrize(("words", "point"), LOSSES)
def test_losses_outside_the_range_of_a_law_say_so(words, point):
    changes = {k: v for k, v in point.items() if k == "output_immersion"}
    at = {k: v for k, v in point.items() if k not in changes}
    said = solve_losses(LossesParams(**changes), **{**USUAL, **at}).warnings
    assert any(words in line for line in said)
    cool = {**USUAL, "oil_temperature": 323.15}  # kappa above 1
    assert solve_losses(LossesParams(), **cool).warnings == ()


def test_every_range_of_a_law_is_tried_here():
    assert {id(r) for r in mesh.LAW_RANGES} == {id(r) for r, *_ in OUTSIDE}
    of_trains = {id(losses.LIGHT_LOAD)}  # which know a bearing's C: tests/core/train
    assert len({id(r) for r in losses.LAW_RANGES} - of_trains) == len(LOSSES)


# A gear mesh says what it doubts: teeth, size, load factor, thick films, speed, limits.

PAPER, AT_ONE = GearMeshParams.preset("paper"), {"pinion_teeth": 21, "gear_ratio": 43 / 21}
DOUBTS = [
    ({**AT_ONE, "gear_ratio": 2.03}, {}, "42.63 teeth.*42 teeth.*43 teeth", AT_ONE, {}),
    ({"normal_module": 4e-3, "centre_distance": 0.1}, {}, "0.12 m", {"normal_module": 4e-3}, {}),
    ({}, {"oil_temperature": 253.15}, "film_thickness", {}, {"oil_temperature": 283.15}),
    ({}, {"speed": 1300.0}, "m/s at the pitch line", {}, {"speed": 500.0}),
    ({"mean_roughness": 3e-7}, {}, "3e-07 m against .*2.26e-06 m .surface 'r", {}, {}),
    ({"load_share": 0.5}, {}, "load_share = 0.5 has no effect: read by film_heat = atan", {}, {}),
    (
        {"bulk_conductance": 9.0, "lubrication_factor": 1.2},
        {},
        "lubrication_factor = 1.2 has",
        {},
        {},
    ),
    ({}, {"power": 0.0}, "power = 0 W: hardly any load", {}, {}),
    ({}, {"speed": 0.2, "power": 10.0}, "0.2 rad/s: the flanks roll .* takes 0.1 m/s", {}, {}),
    ({}, {"power": 20.0}, "scuffing_safety counts a rise of 1 K.*read scuffing_margin", {}, {}),
    (
        {"fzg_stage": 1, "structural_factor": 0.1},
        {"oil_temperature": 420.0},
        "scuffing_safety = -.*hotter than what scuffs",
        {},
        {},
    ),
]


@pytest.mark.parametrize(("changes", "point", "words", "sound", "near"), DOUBTS)
def test_what_is_doubtful_is_said_and_what_is_sound_is_not(changes, point, words, sound, near):
    warnings = solve_gearmesh(GearMeshParams(**changes), **(POINT | point)).warnings
    assert any(re.search(words, line) for line in warnings), warnings
    assert all("\n" not in line for line in warnings)
    sound = solve_gearmesh(GearMeshParams(**sound), **(POINT | near)).warnings
    assert [line for line in sound if not line.startswith("load F_bt/b")] == []


@pytest.mark.parametrize("internal", [False, True])
def test_a_result_shows_the_size_of_the_pair(internal):
    helix = 0.3 if internal else 0.0
    params = GearMeshParams(
        internal=internal, pinion_teeth=20, gear_ratio=3.0, normal_module=2e-3, helix_angle=helix
    )
    r = solve_gearmesh(params, **POINT)
    apart = r.gear_diameter - r.pinion_diameter if internal else r.gear_diameter + r.pinion_diameter
    assert r.normal_module == pytest.approx(2e-3, rel=1e-14)
    assert 0.5 * apart == pytest.approx(r.centre_distance, rel=1e-14)


def test_the_papers_heat_has_no_load_factor_but_of_the_pitting_stress():
    a, b = (solve_gearmesh(replace(PAPER, load_factor=x), **POINT) for x in (1.0, 2.0))
    assert "load_factor = 2" in b.warnings[0] and not a.warnings
    assert a.contact_pressure_max == b.contact_pressure_max and a.pitting_stress < b.pitting_stress


def test_safeties_name_the_limits_nobody_gave():
    assert solve_gearmesh(GearMeshParams(), **POINT).limits == (
        "contact limit 1500 MPa (assumed, case-hardened), FZG stage 10 (assumed)"
    )
    given = GearMeshParams(contact_limit=1.3e9, fzg_stage=12)
    assert solve_gearmesh(given, **POINT).limits == "contact limit 1300 MPa, FZG stage 12"


# No number of a mesh jumps where a parameter passes its standard value, or is typed as that.

SPUR = GearMeshParams(normal_module=2e-3, face_width=0.02, root_limit=430e6)
PLANET = GearMeshParams.preset("planet", root_limit=430e6, permissible_film_ratio=0.1)
RING = replace(PLANET, gear_ratio=74 / 18, internal=True, addendum_gear=0.8)
JUMPS_ELASTIC = replace(PLANET, helix_angle=0.0, load_sharing="elastic")
PAIRS = {"spur": SPUR, "planet": PLANET, "ring": RING, "elastic": JUMPS_ELASTIC}
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
def test_over_whole_ranges_only_what_is_listed_jumps_and_the_page_tells_it():
    """Else: docs/accuracy.md, python -m lab.tables mesh-jumps."""
    told = [found for page in PAGES for n, found in blocks(page).items() if n == "mesh-jumps"]
    scans = list(scan_all())
    assert [pair for pair, *_ in scans] == list(pairs())
    assert min(values for _, values, _, _ in scans) > 10_000
    causes = {pair: {j.cause for j in jumps} for pair, _, _, jumps in scans if jumps}
    assert causes == LEFT and set().union(*causes.values()) <= set(CAUSES)
    assert told == [jumps_table((pair, jumps) for pair, _, _, jumps in scans)]


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
