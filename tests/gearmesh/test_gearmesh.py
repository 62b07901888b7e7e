"""The gear mesh as a library: numbers at the operating points of the paper, ranges, messages."""

import itertools
import json
import math
from dataclasses import fields
from functools import partial

import pytest
from closed_forms import flash_temperature, involute_mesh, thermal_fatigue
from closed_forms.flash_temperature import ELLIPTIC, blok_flash

from thrustwasher import GearMeshParams, ParameterError, SolveError, solve_gearmesh
from thrustwasher.errors import Status
from thrustwasher.gearmesh.parameters import SPEC
from thrustwasher.model.part_file import preset_parts

paper = partial(GearMeshParams.preset, "paper")
POINT = {"power": 7500.0, "speed": 180.0}
STEEL = flash_temperature.Body((1 - 0.3**2) / 205e9, 50.2, 7850.0, 475.0)
LIMITS = {
    "AISI1020": thermal_fatigue.Endurance(0.63, 0.77),
    "AISI4340": thermal_fatigue.Endurance(0.53, 0.40),
}
LONG_FORM = 3.0 * math.pi**0.25 * 0.591 / 2.36  # Eq 12 prints the product rounded


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


# inlet viscosity: T_s and T_01 [degC]; viscosity at the surface: the same
FILMS = [
    (2, 20, 27.32, 44.57, 27.31, 43.76),
    (2, 30, 26.89, 34.80, 26.89, 34.69),
    (5, 20, 27.22, 30.60, 27.22, 30.46),
    (5, 30, 26.83, 28.35, 26.83, 28.34),
]


@pytest.mark.parametrize(("ratio", "teeth", "ts", "t01", "ts_warm", "t01_warm"), FILMS)
def test_flank_and_film_temperature_with_both_viscosities(
    ratio, teeth, ts, t01, ts_warm, t01_warm
):  # fmt: skip
    inlet, warm = at(ratio, teeth, viscosity_at="inlet"), at(ratio, teeth)
    found = [inlet.surface_temperature, inlet.film_temperature]
    found += [warm.surface_temperature, warm.film_temperature]
    assert [t - 273.15 for t in found] == pytest.approx([ts, t01, ts_warm, t01_warm], abs=6e-3)


# bounded and literal reading: rise or temperature of asperities, K and allowable ratio, 1020, 4340
STRESSES = [
    (2, 20, 147, 277, 0.856, 0.477, 112.5, 2.48, 0.536, 6.52, 0.365),
    (2, 30, 0.2, 0.2, 1.0, 1.0, 64.9, 0.842, 0.737, 2.21, 0.558),
    (5, 20, 193, 364, 0.941, 0.675, 152.7, 1.09, 0.691, 2.86, 0.509),
    (5, 30, 107, 202, 0.960, 0.745, 73.8, 0.331, 0.867, 0.869, 0.732),
]


@pytest.mark.parametrize(("ratio", "teeth", *"abcdefghi"), STRESSES)
def test_asperities_and_allowable_ratios_of_both_steels(
    ratio, teeth, a, b, c, d, e, f, g, h, i
):  # fmt: skip
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


@pytest.mark.parametrize(("ratio", "teeth"), list(itertools.product((1, 2, 5), (20, 30))))
def test_flash_rise_and_k_are_those_of_the_printed_equations(ratio, teeth):
    """Eq 3 and Eq 12 in full, with the power per metre of face width."""
    r = at(ratio, teeth, "literal")
    mesh = involute_mesh.Mesh(ratio, teeth, 0.254, math.radians(20.0))
    heat = 0.5 * r.friction_coefficient
    printed = flash_temperature.atan_flash(mesh, 7500.0, 180.0, 1.0, heat, STEEL)
    assert r.flash_rise == pytest.approx(printed, rel=1e-12)
    for steel, limits in LIMITS.items():
        k = thermal_fatigue.grouped_factor(
            mesh, 7500.0, 180.0, 1.0, 30.0 * heat, limits, 205e9, 0.3, 12e-6, STEEL.effusivity
        )
        found = getattr(r, f"modification_factor_{steel.lower()}")
        assert k / found == pytest.approx(LONG_FORM**2, rel=1e-11)
    assert LONG_FORM**-2 == pytest.approx(0.99961, abs=5e-6)


def test_a_chain_worked_by_hand():
    """Ratio 2, 30 teeth, 5 cm wide, f = 0.08 and ten times the nominal heat flux."""
    r = at(2, 30, "literal", face_width=0.05, friction_law="constant", constant_friction=0.08,
           area_ratio=10.0)  # fmt: skip
    assert r.asperity_temperature - 299.85 == pytest.approx(100.7493, abs=5e-5)
    assert (r.thermal_stress, r.contact_stress) == pytest.approx((118.0206e6, 178.2393e6), rel=3e-7)
    found = r.modification_factor_aisi1020, r.modification_factor_aisi4340
    assert found == pytest.approx((0.2934999, 0.7697331), abs=5e-8)


CONSTANT = {"friction_law": "constant", "switch": "none", "viscosity_at": "inlet"}


def test_flash_rise_grows_with_torque_and_speed_as_eq_3_says():
    """T^(3/4) om^(1/2), so P^(3/4) om^(-1/4) at a given power; C^(-1/2) at a given power."""

    def rise(power, speed, **changes):
        params = paper(**CONSTANT, **changes)
        return solve_gearmesh(params, power=power, speed=speed).flash_rise

    base = rise(7500.0, 180.0)
    assert rise(15000.0, 180.0) / base == pytest.approx(2.0**0.75, rel=1e-12)
    assert rise(15000.0, 360.0) / base == pytest.approx(2.0**0.5, rel=1e-12)
    assert rise(7500.0, 360.0) / base == pytest.approx(2.0**-0.25, rel=1e-12)
    assert rise(7500.0, 180.0, centre_distance=0.508) / base == pytest.approx(2.0**-0.5, rel=1e-12)
    assert rise(7500.0, 180.0, face_width=0.1) / base == pytest.approx(2.0**-0.75, rel=1e-12)
    assert rise(7500.0, 180.0, youngs_modulus=410e9) / base == pytest.approx(2**0.25, rel=1e-12)


def blok(params, r):
    """Return Blok's flash temperature where contact starts, from the result's load and speeds."""
    rolling, load = r.sliding_speed / r.slide_roll_ratio, math.pi / 4.0 * r.hertz_pressure
    speeds = rolling - 0.5 * r.sliding_speed, rolling + 0.5 * r.sliding_speed
    effusivity = math.sqrt(params.conductivity * params.density * params.heat_capacity)
    load *= r.hertz_width
    return blok_flash(load, r.friction_coefficient, *speeds, r.hertz_width, effusivity, ELLIPTIC)


@pytest.mark.parametrize(("ratio", "teeth", "over"), [(2, 20, 1.67), (2, 30, 1.32), (5, 20, 1.73)])
def test_half_the_heat_overheats_the_slow_pinion_against_blok(ratio, teeth, over):
    r = at(ratio, teeth, **CONSTANT)
    flash = blok(paper(gear_ratio=ratio, pinion_teeth=teeth, **CONSTANT), r)
    assert r.flash_rise / flash == pytest.approx(over, abs=6e-3)
    shared = at(ratio, teeth, **CONSTANT, heat_partition="velocity")
    assert shared.flash_rise / flash == pytest.approx(1.0151, abs=1e-4)


@pytest.mark.parametrize(
    ("ratio", "surface", "f"),
    [(2, "fine", 0.020), (2, "rough", 0.028), (5, "fine", 0.029), (5, "rough", 0.041)],
)
def test_iso_friction_is_two_to_three_times_below_boundary_friction(ratio, surface, f):
    iso = at(ratio, 30, "iso", surface=surface).friction_coefficient
    assert iso == pytest.approx(f, abs=5e-4)
    assert 1.5 < at(ratio, 30, surface=surface).friction_coefficient / iso < 4.0


def test_loss_is_friction_times_loss_factor_times_torque():
    r = at(2, 20)
    assert r.contact_ratio == pytest.approx(1.63519, abs=5e-6)
    wanted = r.friction_coefficient * 0.166065 * 7500.0 / 180.0
    assert r.friction_torque == pytest.approx(wanted, rel=3e-6)
    assert r.friction_power == pytest.approx(r.friction_torque * 180.0, rel=1e-15)
    turned = solve_gearmesh(paper(), power=7500.0, speed=-180.0)
    assert turned.friction_torque == -r.friction_torque
    assert turned.as_dict() | {"friction_torque": 0} == r.as_dict() | {"friction_torque": 0}


def test_no_power_is_no_loss_at_any_speed():
    for speed in (0.0, 180.0):
        r = solve_gearmesh(paper(), power=0.0, speed=speed)
        assert r.friction_torque == r.friction_power == 0.0 and r.status == Status.OK
        assert all(math.isfinite(v) for v in r.as_dict().values() if isinstance(v, float))


SWEEP = list(itertools.product((17, 18, 20, 25, 32, 45, 60), (1.0, 1.5, 2.0, 3.0, 5.0, 8.0)))
OILS = [
    {}, {"viscosity_scale": 3e-5}, {"viscosity_b": 1100.0, "viscosity_scale": 5e-5},
    {"traction_law": "limited"}, {"film_viscosity": "inlet"},
]  # fmt: skip


@pytest.mark.parametrize("surface", ["rough", "fine"])
@pytest.mark.parametrize("oil", OILS, ids=str)
def test_every_pair_of_a_wide_sweep_is_solved_and_consistent(surface, oil):
    for (teeth, ratio), degc in itertools.product(SWEEP, (-10.0, 27.0, 60.0, 120.0)):
        params = paper(pinion_teeth=teeth, gear_ratio=ratio, surface=surface, **oil)
        r = solve_gearmesh(params, **POINT, oil_temperature=degc + 273.15)
        assert not r.status.is_failure and r.iterations <= 30
        bulk = degc + 273.15
        assert bulk <= r.surface_temperature <= r.film_temperature
        assert r.surface_temperature <= r.asperity_temperature
        assert 0.0 < r.allowable_ratio_aisi4340 <= r.allowable_ratio_aisi1020 <= 1.0
        share = r.contact_stress / 689.5e6  # of the mechanical endurance limit
        assert r.stress_utilization_aisi4340 == pytest.approx(
            share / r.allowable_ratio_aisi4340, rel=1e-12
        )


def test_the_flanks_temperature_is_a_fixed_point_of_its_equation():
    """The rise equals the heat of a film with the viscosity at that very temperature."""
    for oil in OILS:
        warm = solve_gearmesh(paper(**oil), power=2e5, speed=900.0)
        base = {k: v for k, v in oil.items() if k != "film_viscosity"}
        cold = solve_gearmesh(paper(**base, viscosity_at="inlet"), power=2e5, speed=900.0)
        exponent = 1.0 if oil == {"film_viscosity": "inlet"} else 0.3
        if "traction_law" in oil:
            continue
        ratio = (warm.viscosity / cold.viscosity) ** exponent
        rise = warm.surface_temperature - 299.85
        assert rise > 1.0
        assert rise == pytest.approx((cold.surface_temperature - 299.85) * ratio, rel=1e-10)


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
    same = at(2, 20, surface="fine", sigma_rms=2.26e-6, effective_roughness=4.5e-5,
              mean_roughness=1.6e-6)  # fmt: skip
    assert same == rough
    assert at(2, 20, "iso", mean_roughness=3.2e-6).friction_coefficient == pytest.approx(
        2**0.25 * at(2, 20, "iso", mean_roughness=1.6e-6).friction_coefficient, rel=1e-12
    )


def test_load_share_and_face_width_enter_the_line_load_alike():
    half = at(2, 20, load_share=0.5)
    wide = at(2, 20, face_width=0.1)
    assert half.contact_stress == pytest.approx(wide.contact_stress, rel=1e-14)
    assert half.asperity_temperature == pytest.approx(wide.asperity_temperature, rel=1e-13)


def test_presets_are_named_sets_of_changes():
    assert paper() == GearMeshParams.preset("bounded")
    literal = GearMeshParams.preset("literal", pinion_teeth=25)
    assert (literal.face_width, literal.area_law, literal.pinion_teeth) == (1.0, "constant", 25)
    assert set(preset_parts(SPEC)) == {"paper", "bounded", "literal", "iso", "planet"}
    with pytest.raises(ParameterError, match="preset = 'atan', allowed: 'bounded' or 'iso'"):
        GearMeshParams.preset("atan")


def test_result_is_json():
    assert json.loads(json.dumps(at(2, 20).as_dict()))["status"] == "OK"


def test_no_parameter_is_called_like_an_input_or_an_output():
    names = {f.name for f in fields(GearMeshParams)}
    assert names.isdisjoint(s.name for s in (*SPEC.inputs, *SPEC.outputs))


@pytest.mark.parametrize("f", fields(GearMeshParams), ids=lambda f: f.name)
def test_values_out_of_range_are_refused_by_name(f):
    bad = "other" if f.metadata["kind"] == "enumeration" else math.nan
    with pytest.raises(ParameterError, match=f"^{f.name} = .*allowed"):
        GearMeshParams(**{f.name: bad})


P = paper()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: solve_gearmesh(P, power=1.0, speed=0.0), "speed = 0.0 rad/s, allowed: from 1e-05"),
        (lambda: solve_gearmesh(P, power=1e9, speed=1.0), "speed = 1.0 rad/s, allowed: from 10000"),
        (lambda: solve_gearmesh(P, power=math.nan, speed=1.0), "power = nan W, allowed"),
        (lambda: solve_gearmesh(P, power=1.0, speed=6e3), "speed = 6000.0 rad/s, allowed"),
        (lambda: solve_gearmesh(P, **POINT, oil_temperature=27.0), "oil_temperature = 27.0 K"),
        (lambda: solve_gearmesh(P, **POINT, fidelity="best"), "fidelity = 'best', allowed: 'fie"),
        (lambda: paper(addendum=0.4), "addendum = 0.4, .* contact ratio is 0.72"),
        (lambda: paper(effective_roughness=7e-5), "effective_roughness = 7e-05, allowed"),
        (lambda: paper(effective_roughness=7e-6), "effective_roughness = 7e-06, allowed"),
        (lambda: paper(f0=0.02), "f0 = 0.02, allowed: 0.02466 .. 1"),
        (lambda: paper(pinion_teeth=200), "friction_law = 'li-seireg'.*0.2.*= 'iso'"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(ParameterError, match=message):
        call()


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
