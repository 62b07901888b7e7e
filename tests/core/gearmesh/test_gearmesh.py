"""The gear mesh as a library: numbers at the operating points of the paper, ranges, messages."""

from functools import partial

import pytest

from thrustwasher import GearMeshParams, ParameterError, SolveError, solve_gearmesh
from thrustwasher.errors import Status
from thrustwasher.gearmesh.parameters import SPEC
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
