"""The whole washer: balances out of its fields, symmetries, branches, options, messages."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from thrustwasher import BranchError, WasherParams, solve_washer
from thrustwasher.model.part_file import preset_part
from thrustwasher.tribology.asperities import contact_pressure
from thrustwasher.tribology.viscosity import viscosity
from thrustwasher.washer.kernels.constants import washer_model
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
