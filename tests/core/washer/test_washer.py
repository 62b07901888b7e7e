"""The whole washer: balances out of its fields, symmetries, branches, options, messages."""

import dataclasses
import math
from dataclasses import replace

import numpy as np
import pytest
from sampling import sizes
from scipy.interpolate import CubicSpline

from thrustwasher import BranchError, ParameterError, WasherParams, load_part, solve_washer
from thrustwasher.errors import Status
from thrustwasher.model.parameters import as_numbers
from thrustwasher.model.part_file import preset_part
from thrustwasher.tribology.asperities import contact_pressure
from thrustwasher.tribology.viscosity import viscosity
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.constants import contact_pair, washer_model
from thrustwasher.washer.kernels.gap import dry_friction
from thrustwasher.washer.parameters import SPEC
from thrustwasher.washer.solve import constants

POINTS = {
    "film": ({"load": 300.0, "speed": 953.0}, {}),
    "turning back": ({"load": 300.0, "speed": -953.0}, {}),
    "mixed": ({"load": 600.0, "speed": 136.0}, {}),
    "boundary": ({"load": 1361.0, "speed": 136.0}, {}),
    "past the fold": ({"load": 1100.0, "speed": 545.0}, {}),
    "uneven split": ({"load": 900.0, "speed": 545.0}, {"heat_split": 0.3}),
    "constant friction": ({"load": 900.0, "speed": 300.0}, {"friction_law": "constant"}),
    "unequal surfaces": (
        {"load": 500.0, "speed": 300.0},
        {"roughness_carrier": 9e-7, "roughness_gear": 3e-7},
    ),
    "carrier turns": ({"load": 300.0, "speed": 545.0}, {"conduction": "rotating"}),
    "hot supply": ({"load": 300.0, "speed": 953.0}, {"oil_supply_temperature": 340.0}),
    "liquid alone shears": ({"load": 300.0, "speed": 953.0}, {"cavity_shear": "liquid"}),
    "the paper's": ({"load": 900.0, "speed": 545.0}, preset_part(SPEC, "paper").parameters),
}


def solve(point, **changes):
    return solve_washer(WasherParams(**changes), tilt=0.002, **point)


class Integral:
    """Integration over the washer by a spline in radius and the trapezoid rule around."""

    def __init__(self, result):
        self.f = result.fields()
        angle = np.unwrap(self.f.angle)
        ends = np.append(angle, angle[0] + 2.0 * np.pi)
        s = 2.0 * np.pi * np.arange(len(angle) + 1) / len(angle)
        # the angles are theta(s) with s uniform: dtheta/ds by a periodic spline of theta - s
        slope = CubicSpline(s, ends - s, bc_type="periodic").derivative()(s[:-1]) + 1.0
        self.around = slope * 2.0 * np.pi / len(angle)

    def __call__(self, values, first=0):
        radius = self.f.radius[first:]
        spline = CubicSpline(
            radius, (values * self.around).sum(axis=1) * radius, bc_type="not-a-knot"
        )
        return float(spline.integrate(radius[0], radius[-1]))


def model_of(result):
    return washer_model(constants(result.params, result.grid))


@pytest.mark.parametrize("name", POINTS)
def test_film_and_contact_carry_the_load_without_a_moment_left(name):
    """F1 = load, and both moments of film 1 are those of gap 2 (recomputed from the gaps)."""
    point, changes = POINTS[name]
    r = solve(point, **changes)
    total, m = Integral(r), model_of(r)
    f = total.f
    x, y = np.outer(f.radius, np.cos(f.angle)), np.outer(f.radius, np.sin(f.angle))
    push = f.pressure + f.contact_pressure
    assert total(push) == pytest.approx(point["load"], rel=1e-4)
    assert r.fluid_load + r.contact_load == pytest.approx(point["load"], rel=1e-8)
    assert total(f.pressure) == pytest.approx(r.fluid_load, rel=1e-4, abs=1e-4)
    assert total(f.contact_pressure) == pytest.approx(r.contact_load, rel=1e-3, abs=1e-4)
    z_w, z_g, gx, gy = r._state[10:14]
    second = (z_g - z_w) - x * (r.tilt - gy) - y * gx
    p2 = np.array(
        [
            contact_pressure((h - m.mean_summit2) / m.summit_sigma2, m.table2)[0]
            for h in second[m.i_g :].ravel()
        ]
    ).reshape(second[m.i_g :].shape)
    assert total(p2, m.i_g) == pytest.approx(point["load"], rel=1e-4)
    arm = point["load"] * m.outer_radius
    for lever in (x, y):
        left = total(push * lever) - total(p2 * lever[m.i_g :], m.i_g)
        assert abs(left) < 1e-4 * arm


@pytest.mark.parametrize("name", POINTS)
def test_oil_leaves_with_the_heat_it_carries(name):
    point, changes = POINTS[name]
    r = solve(point, **changes)
    supply = r.params.oil_supply_temperature or r.oil_temperature
    carried = 850.0 * 2000.0 * r.oil_flow * (r.oil_outlet_temperature - supply)
    assert carried == pytest.approx(r.throughflow_heat, rel=1e-9, abs=1e-9)
    assert r.oil_flow > 0.0 and bool(r.throughflow_heat) == r.params.oil_cooling


def test_a_body_that_turns_has_one_temperature_on_each_circle():
    f = solve({"load": 300.0, "speed": 545.0}).fields()
    assert np.ptp(f.washer_temperature, axis=1).max() == 0.0 < np.ptp(f.carrier_temperature)
    has_gear = f.radius >= WasherParams().gear_inner_radius * (1.0 - 1e-12)
    np.testing.assert_array_equal(np.isfinite(f.gear_temperature).all(axis=1), has_gear)
    assert 0.0 < f.liquid_fraction.min() < 0.9
    assert f.liquid_fraction.max() == pytest.approx(1.0, abs=1e-14)
    turned = solve({"load": 300.0, "speed": 545.0}, conduction="rotating").fields()
    assert np.ptp(turned.carrier_temperature, axis=1).max() == 0.0


def test_a_gap_that_cannot_hold_the_washer_is_said():
    held = solve({"load": 300.0, "speed": 953.0})
    loose = solve({"load": 1.0, "speed": 953.0})
    assert held.stick_margin > 1.0 > loose.stick_margin > 0.0
    assert held.warnings == ()
    (told,) = loose.warnings
    assert told.startswith("stick_margin = ") and "the gear cannot hold the washer" in told


@pytest.mark.parametrize("name", POINTS)
def test_torque_and_mean_temperature_come_out_of_the_fields(name):
    point, changes = POINTS[name]
    r = solve(point, **changes | {"pressure_flow_shear": False})
    total, p = Integral(r), r.params
    f = total.f
    liquid = f.liquid_fraction if p.cavity_shear == "liquid" else 1.0
    sigma = math.hypot(p.roughness_carrier or 5.15e-7, p.roughness_washer or 5.15e-7)
    u = f.film_thickness / sigma
    cdf = np.vectorize(lambda v: 0.5 * math.erfc(-v / math.sqrt(2.0)))(u)
    mean_gap = f.film_thickness * cdf + sigma * np.exp(-0.5 * u * u) / math.sqrt(2.0 * math.pi)
    mu = np.vectorize(lambda t: viscosity(t, 6.31e-5, 3.545, 1.053)[0])(f.film_temperature)
    dry = 0.48 - 0.05 * math.log(min(max(r.contact_load, 260.5), 1725.6))
    if p.friction_law == "constant":
        dry = p.dry_friction
    radius = f.radius[:, None]
    shear = liquid * mu * r.speed * radius / mean_gap
    shear = shear + math.copysign(dry, r.speed) * f.contact_pressure
    assert total(shear * radius) == pytest.approx(r.friction_torque, rel=2e-4)
    area = total(np.ones_like(u))
    assert total(f.film_temperature) / area == pytest.approx(r.film_temperature, abs=1e-3)
    walls = 0.5 * (f.carrier_temperature + f.washer_temperature)
    assert total(walls) / area == pytest.approx(r.temperature, abs=1e-3)
    assert r.film_ratio == pytest.approx(r.film_thickness / sigma, rel=1e-12)
    assert r.temperature_max == max(f.carrier_temperature.max(), f.washer_temperature.max())
    assert r.film_thickness <= f.film_thickness.min() + 1e-15


@pytest.mark.parametrize("tilt", [1e-12, 1e-9, 1.1e-9, 1e-8])
def test_a_tilt_next_to_nothing_is_answered(tilt):
    """It is the washer without tilt but for rounding; a tilt that grows from zero passes here."""
    point = {"load": 300.0, "speed": 545.0}
    r = solve_washer(WasherParams(), tilt=tilt, **point)
    level = solve_washer(WasherParams(), tilt=0.0, **point)
    assert r.friction_torque == pytest.approx(level.friction_torque, rel=1e-3)


def test_a_film_that_heats_nothing_is_isothermal():
    r = solve({"load": 300.0, "speed": 953.0}, film_heat_fraction=0.0, oil_cooling=False)
    assert r.temperature == pytest.approx(297.15, abs=1e-6)
    assert r.friction_torque > 1.4 * solve({"load": 300.0, "speed": 953.0}).friction_torque


def test_constant_dry_friction_is_the_friction_of_a_film_that_is_gone():
    """At a crawl the torque is f times the moment of the contact pressure."""
    r = solve({"load": 1500.0, "speed": 0.01}, friction_law="constant", dry_friction=0.12)
    total = Integral(r)
    rub = total(total.f.contact_pressure * total.f.radius[:, None])
    assert r.contact_load == pytest.approx(1500.0, rel=1e-3)
    assert r.friction_torque == pytest.approx(0.12 * rub, rel=2e-3)


def test_results_are_frozen_and_say_where_they_come_from():
    r = solve({"load": 300.0, "speed": 953.0})
    with pytest.raises(dataclasses.FrozenInstanceError):
        r.friction_torque = 0.0
    assert (r.load, r.speed, r.tilt, r.oil_temperature) == (300.0, 953.0, 0.002, 297.15)
    assert r.fidelity == "field" and r.grid == (10, 32) and 0.0 < r.error_estimate < 0.01


def test_fields_are_copies_that_belong_to_the_result():
    r = solve({"load": 300.0, "speed": 953.0})
    before = r.fields().pressure.copy()
    r.fields().pressure[:] = -1.0
    solve({"load": 900.0, "speed": 545.0})
    np.testing.assert_array_equal(r.fields().pressure, before)


def test_a_film_that_cannot_exist_is_said_not_hidden():
    with pytest.raises(BranchError) as caught:
        solve({"load": 1100.0, "speed": 545.0, "branch": "film"})
    message = str(caught.value)
    assert all(w in message for w in ("branch", "'film'", "1100", "N", "'contact'", "545", "0.002"))
    with pytest.raises(BranchError, match="'contact'"):
        solve({"load": 300.0, "speed": 545.0, "branch": "contact"})


# What no two outputs of a solve may contradict: heat, torque, flow and materials, anywhere.

LAWS = {
    "default": WasherParams(),
    "paper": WasherParams.preset("paper"),
    "carrier turns": WasherParams(conduction="rotating", heat_split=0.3),
    "everywhere": WasherParams(conduction="all", heat_split=0.8),
    "liquid alone": WasherParams(cavity_shear="liquid", oil_supply_temperature=330.0),
    "heat kept out": WasherParams(oil_cooling=False, film_heat_fraction=0.6),
    "insulated gear": WasherParams(gear_far_face="insulated"),
    "warm gear": WasherParams(gear_far_face="bulk"),
}
BASE = {"load": 300.0, "speed": 545.0, "tilt": 2e-3}


@sizes(10, 250)
@pytest.mark.parametrize("name", LAWS)
def test_friction_power_reaches_the_oil_at_every_point_of_the_box(name, n):
    rng = np.random.default_rng(11)
    worst = 0.0
    for _ in range(n):
        r = solve_washer(
            LAWS[name],
            load=10.0 ** rng.uniform(0.0, 3.7),
            speed=rng.uniform(-2000.0, 2000.0),
            tilt=rng.uniform(0.0, 4e-3),
            oil_temperature=rng.uniform(240.0, 420.0),
            far_face_temperature=345.0 if name == "warm gear" else 0.0,
        )
        assert r.friction_power == pytest.approx(r.friction_torque * r.speed, rel=1e-14)
        worst = max(worst, abs(r.oil_heat / r.friction_power - 1.0))
    assert worst < (1e-7 if name == "warm gear" else 1e-8)  # whose own heat flows next to it


def test_at_rest_nothing_is_made_and_nothing_flows():
    r = solve_washer(WasherParams(), **{**BASE, "speed": 0.0})
    assert (r.friction_power, r.oil_heat, r.oil_flow) == (0.0, 0.0, 0.0)
    assert r.film_temperature == r.oil_outlet_temperature == r.oil_temperature


def test_without_tilt_no_oil_leaves_and_the_gap_is_full():
    r = solve_washer(WasherParams(), **{**BASE, "tilt": 0.0})
    assert r.status is Status.OK and r.fields().liquid_fraction.min() > 1.0 - 1e-12
    assert r.oil_heat == pytest.approx(r.friction_power, rel=1e-8)


def test_a_hotter_supply_warms_the_film_and_not_the_outer_faces():
    cool, hot = (
        solve_washer(WasherParams(oil_supply_temperature=t), **BASE) for t in (297.15, 337.15)
    )
    assert solve_washer(WasherParams(), **BASE).friction_torque == pytest.approx(
        cool.friction_torque, rel=1e-9
    )
    assert cool.film_temperature + 5.0 < hot.film_temperature < cool.film_temperature + 40.0
    assert hot.friction_torque < cool.friction_torque
    assert hot.oil_heat == pytest.approx(hot.friction_power, rel=1e-8)


def test_values_of_each_body_that_are_equal_are_the_common_ones():
    common = WasherParams(youngs_modulus=1.1e11, conductivity=45.0, yield_strength=6e8)
    own = {
        f"{name}_{body}": getattr(common, name)
        for name in ("youngs_modulus", "poisson_ratio", "yield_strength", "conductivity")
        for body in ("carrier", "washer", "gear")
    }
    at = {**BASE, "load": 900.0, "speed": 136.0}
    one, other = solve_washer(common, **at), solve_washer(WasherParams(**own), **at)
    assert one.friction_torque == other.friction_torque
    assert one.temperature == other.temperature


def test_a_bronze_washer_is_softer_in_both_contacts():
    """1/E' = sum of (1 - nu^2)/E; strength, modulus and Poisson's ratio are the softer body's."""
    bronze = {"youngs_modulus_washer": 1.1e11, "poisson_ratio_washer": 0.34}
    p = WasherParams(**bronze, yield_strength_washer=2.5e8, yield_strength_gear=2e8)
    par = constants(p, (10, 32))
    modulus = 1.0 / ((1.0 - 0.296**2) / 201e9 + (1.0 - 0.34**2) / 1.1e11)
    assert contact_pair(par, L.OF_CARRIER) == pytest.approx((modulus, 1.1e11, 0.34, 2.5e8))
    assert contact_pair(par, L.OF_GEAR) == pytest.approx((modulus, 201e9, 0.296, 2e8))
    at = {**BASE, "load": 1361.0, "speed": 136.0}
    steel = solve_washer(WasherParams(), **at)
    assert solve_washer(p, **at).film_ratio < steel.film_ratio


# What the gear's far face borders on: the oil, nothing, or the bulk of the gear.

OIL = 297.15
INSULATED = WasherParams(gear_far_face="insulated")
BULK = WasherParams(gear_far_face="bulk")


def test_a_far_face_as_warm_as_the_oil_is_that_of_the_oil():
    oil, bulk, told = (
        solve_washer(params, **BASE, **more)
        for params, more in (
            (WasherParams(), {}),
            (BULK, {}),
            (BULK, {"far_face_temperature": OIL}),
        )
    )
    assert bulk.friction_torque == told.friction_torque
    assert bulk.friction_torque == pytest.approx(oil.friction_torque, rel=3e-9)
    assert bulk.temperature == told.temperature == pytest.approx(oil.temperature, rel=1e-9)
    said = "without a far_face_temperature: the oil's is taken"
    assert said in bulk.warnings[0] and not oil.warnings and not told.warnings


def test_an_insulated_gear_is_between_none_and_one_as_warm_as_it_would_become():
    """With the far face as warm as the insulated gear no heat passes it: the same washer."""
    params = replace(INSULATED, conductivity_gear=400.0)  # its radial differences are small
    free = solve_washer(params, **BASE)
    gear = free.fields().gear_temperature
    told = float(np.nanmean(gear))
    bulk = solve_washer(replace(params, gear_far_face="bulk"), **BASE, far_face_temperature=told)
    assert np.nanmax(gear) - np.nanmin(gear) < 0.5
    assert bulk.friction_torque == pytest.approx(free.friction_torque, rel=2e-3)
    assert free.temperature > solve_washer(WasherParams(), **BASE).temperature


@pytest.mark.parametrize(
    ("params", "more", "said"),
    [
        (WasherParams(), {"far_face_temperature": 330.0}, "with gear_far_face = 'bulk'"),
        (BULK, {"far_face_temperature": 80.0}, r"0 \(the oil's\) or 233.15.*353.15 K \(80 degC\)"),
        (BULK, {"fidelity": "map"}, "a map has no far_face_temperature"),
    ],
)
def test_a_far_face_in_vain_is_refused(params, more, said):
    with pytest.raises(ParameterError, match=said):
        solve_washer(params, **BASE, **more)


# Dry friction over the mean contact pressure, and its earlier form over the load.

GRID = (10, 32)
HALF = {"inner_radius": 0.00555, "outer_radius": 0.01135, "gear_inner_radius": 0.0078}


def friction(params, load):
    return dry_friction(constants(params, GRID), load)[0]


def test_washers_of_different_size_have_the_same_friction_at_the_same_pressure():
    for load in (100.0, 300.0, 900.0):
        small = friction(WasherParams(**HALF), load / 4.0)
        own = math.pi * (0.01135**2 - 0.00555**2) / (math.pi * (0.0227**2 - 0.0111**2))
        assert own == pytest.approx(0.25, rel=1e-12)
        assert small == pytest.approx(friction(WasherParams(), load), rel=1e-12)


OVER_LOAD = {"friction_constant": 0.4, "friction_load_min": 50.0, "friction_load_max": 900.0}


@pytest.mark.parametrize("size", [{}, HALF])
def test_a_law_over_the_load_holds_for_the_washer_it_is_given_for(size):
    params = WasherParams(**size, **OVER_LOAD, friction_slope=0.04)
    for load in (10.0, 50.0, 300.0, 2000.0):
        expected = 0.4 - 0.04 * math.log(min(max(load, 50.0), 900.0))
        assert friction(params, load) == pytest.approx(expected, rel=1e-13)


def test_a_part_file_of_the_earlier_form_reads_as_before(tmp_path):
    file = tmp_path / "old.toml"
    file.write_text(
        'model = "washer"\nname = "Old"\n[parameters]\ninner_radius = "5.55 mm"\n'
        'outer_radius = "11.35 mm"\ngear_inner_radius = "7.8 mm"\nfriction_constant = 0.48\n'
        'friction_slope = 0.05\nfriction_load_min = "260.5 N"\nfriction_load_max = "1725.6 N"\n'
    )
    part = load_part(file)
    assert "friction_load_min" not in part.parameters
    assert part.params == WasherParams(**HALF, friction_load_min=260.5)
    assert as_numbers(part.model.params()) == as_numbers(part.params)
    assert friction(part.params, 300.0) == pytest.approx(0.48 - 0.05 * math.log(300.0), rel=1e-13)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"friction_load_min": 2000.0}, "friction_load_min = 2000 N, allowed: below"),
        ({"friction_load_min": -1.0}, "friction_load_min"),
        (
            {"friction_load_min": 100.0, "friction_pressure_min": 1e5},
            "together with friction_pressure_min",
        ),
        ({"friction_pressure_min": 2e6}, "friction_pressure_min"),
    ],
)
def test_friction_data_that_contradict_each_other_are_refused(given, said):
    with pytest.raises(ParameterError, match=said):
        WasherParams(**given)


def test_pressures_outside_the_data_are_told():
    inside = solve_washer(WasherParams(), load=1361.0, speed=136.0, tilt=2e-3)
    below = solve_washer(WasherParams(**HALF), load=40.0, speed=5.0, tilt=1e-3)
    full = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=2e-3)
    assert not any("dry friction" in line for line in (*inside.warnings, *full.warnings))
    (line,) = (line for line in below.warnings if "dry friction" in line)
    assert "held" in line


def test_tilt_is_that_of_the_command_and_the_fmu_unless_given():
    start = next(s.start for s in SPEC.inputs if s.name == "tilt")
    point = {"load": 300.0, "speed": 953.0}
    plain = solve_washer(WasherParams(), tilt=start, **point)
    short = solve_washer(WasherParams(), **point)
    assert short.tilt == start and short.friction_torque == plain.friction_torque
