"""The whole washer: balances out of its fields, symmetries, branches, options, messages."""

import dataclasses
import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sampling import sizes
from scipy.interpolate import CubicSpline

from thrustwasher import BranchError, ParameterError, Status, WasherParams, solve_washer
from thrustwasher.model.part_file import preset_part
from thrustwasher.tribology.asperities import contact_pressure
from thrustwasher.tribology.viscosity import viscosity
from thrustwasher.washer.kernels.constants import washer_model
from thrustwasher.washer.parameters import CONDUCTION, SPEC
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
        spline = CubicSpline(radius, (values * self.around).sum(axis=1) * radius,
                             bc_type="not-a-knot")  # fmt: skip
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
    p2 = np.array([
        contact_pressure((h - m.mean_summit2) / m.summit_sigma2, m.table2)[0]
        for h in second[m.i_g :].ravel()
    ]).reshape(second[m.i_g :].shape)  # fmt: skip
    assert total(p2, m.i_g) == pytest.approx(point["load"], rel=1e-4)
    arm = point["load"] * m.outer_radius
    for lever in (x, y):
        left = total(push * lever) - total(p2 * lever[m.i_g :], m.i_g)
        assert abs(left) < 1e-4 * arm


@pytest.mark.parametrize("name", POINTS)
def test_torque_times_speed_is_the_heat_that_leaves(name):
    """Through the far faces of carrier and gear, and with the oil that leaves."""
    point, changes = POINTS[name]
    r = solve(point, **changes)
    i_g = model_of(r).i_g
    total = Integral(r)
    out = total(total.f.carrier_temperature - r.oil_temperature) * 60.5 / 0.01
    out += total(total.f.gear_temperature[i_g:] - r.oil_temperature, i_g) * 60.5 / 0.01
    assert out + r.throughflow_heat == pytest.approx(r.friction_power, rel=2e-5)
    assert r.oil_heat == pytest.approx(r.friction_power, rel=2e-5)
    assert r.friction_power == pytest.approx(r.friction_torque * r.speed, rel=1e-12)


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


def test_the_flow_of_the_fields_is_what_leaves():
    """Liquid that leaves over a rim comes from the last cells before it; a mesh's error is left."""
    r = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002, fidelity="fine")
    f = r.fields()
    assert (f.flow_around > 0.0).mean() > 0.9
    angle = np.append(f.angle, f.angle[0] + 2.0 * np.pi)
    middle = np.unwrap(angle)
    width = 0.5 * (np.roll(np.diff(middle), 1) + np.diff(middle))
    out = f.radius[-1] * np.maximum(f.flow_outward[-1], 0.0) @ width
    out -= f.radius[0] * np.minimum(f.flow_outward[0], 0.0) @ width
    assert out == pytest.approx(r.oil_flow, rel=0.3)


def test_a_gap_that_cannot_hold_the_washer_is_said():
    held = solve({"load": 300.0, "speed": 953.0})
    loose = solve({"load": 1.0, "speed": 953.0})
    assert held.stick_margin > 1.0 > loose.stick_margin > 0.0
    assert held.warnings == ()
    (told,) = loose.warnings
    assert told.startswith("stick_margin = ") and "gap 2 cannot hold the washer" in told


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


@pytest.mark.parametrize("name", POINTS)
def test_turning_back_mirrors_everything(name):
    point, changes = POINTS[name]
    r = solve(point, **changes)
    back = solve({**point, "speed": -point["speed"]}, **changes)
    assert back.friction_torque == pytest.approx(-r.friction_torque, rel=1e-7)
    assert back.washer_tilt_x == pytest.approx(-r.washer_tilt_x, rel=1e-5, abs=1e-12)
    for same in ("temperature", "temperature_max", "film_thickness", "washer_tilt_y", "fluid_load"):
        assert getattr(back, same) == pytest.approx(getattr(r, same), rel=1e-6, abs=1e-4)
    assert (back.branch, back.distress) == (r.branch, r.distress)


box = {
    "load": st.floats(5.0, 3000.0), "speed": st.floats(-1500.0, 1500.0),
    # between zero and 10 urad see test_a_tilt_next_to_nothing_is_answered
    "tilt": st.one_of(st.just(0.0), st.floats(1e-5, 0.004)),
    "oil_temperature": st.floats(260.0, 420.0),
}  # fmt: skip


@sizes(40, 120)
def test_every_point_of_the_box_has_an_answer_that_obeys(n):
    settings(derandomize=True, deadline=None, max_examples=n)(given(**box)(obeys))()


def obeys(**point):
    r = solve_washer(WasherParams(), **point)
    good = Status.HOT if r.temperature_max > 523.0 else Status.OK
    assert r.status is (Status.DISTRESS if r.distress else good)
    assert r.branch in ("film", "contact")
    assert r.friction_torque * r.speed >= 0.0
    assert r.temperature_max >= r.temperature >= r.oil_temperature - 1e-9
    assert r.fluid_load >= -1e-12 * r.load and r.contact_load >= 0.0  # rounding
    assert r.fluid_load + r.contact_load == pytest.approx(r.load, rel=1e-7)
    assert abs(r.washer_tilt_y) <= r.tilt + 1e-9


@settings(derandomize=True, deadline=None, max_examples=40)
@given(change=st.floats(0.5, 2.0), oil=st.floats(-15.0, 15.0), **box)
def test_a_start_from_elsewhere_leads_to_the_same_answer_on_the_branch(change, oil, **point):
    """Same branch, same numbers: from nothing and from another result."""
    cold = solve_washer(WasherParams(), **point)
    other = solve_washer(
        WasherParams(), load=min(3000.0, max(5.0, point["load"] * change)), speed=point["speed"],
        tilt=point["tilt"], oil_temperature=min(420.0, max(260.0, point["oil_temperature"] + oil)),
    )  # fmt: skip
    warm = solve_washer(WasherParams(), start=other, branch=cold.branch, **point)
    assert warm.branch == cold.branch
    # a warm solve stops at 5e-6 of load and heat
    assert warm.friction_torque == pytest.approx(cold.friction_torque, rel=2e-5, abs=1e-9)
    assert warm.film_ratio == pytest.approx(cold.film_ratio, abs=2e-4, rel=1e-5)
    rise = cold.temperature - cold.oil_temperature
    assert warm.temperature == pytest.approx(cold.temperature, rel=0.0, abs=1e-3 + 1e-5 * rise)


@pytest.mark.parametrize("speed", [5e-324, 2.3e-308, -1e-304, 1e-200])
def test_a_speed_next_to_nothing_is_answered(speed):
    point = {"load": 5.0, "tilt": 0.004, "oil_temperature": 260.0}
    r = solve_washer(WasherParams(), speed=speed, **point)
    slow = solve_washer(WasherParams(), speed=math.copysign(1e-9, speed), **point)
    assert r.friction_torque == pytest.approx(slow.friction_torque, rel=1e-6)
    assert r.fluid_load + r.contact_load == pytest.approx(r.load, rel=1e-8)


@pytest.mark.parametrize("tilt", [1e-12, 1e-9, 1.1e-9, 1e-8])
def test_a_tilt_next_to_nothing_is_answered(tilt):
    """It is the washer without tilt but for rounding; a tilt that grows from zero passes here."""
    point = {"load": 300.0, "speed": 545.0}
    r = solve_washer(WasherParams(), tilt=tilt, **point)
    level = solve_washer(WasherParams(), tilt=0.0, **point)
    assert r.friction_torque == pytest.approx(level.friction_torque, rel=1e-3)


def test_more_load_makes_the_film_thinner_on_the_film_branch():
    r = [solve({"load": w, "speed": 545.0}) for w in (20.0, 80.0, 200.0, 400.0, 600.0, 760.0)]
    assert all(b.film_thickness < a.film_thickness for a, b in itertools.pairwise(r))
    assert all(b.friction_torque > a.friction_torque for a, b in itertools.pairwise(r))


def test_both_branches_are_answered_between_the_folds():
    film = solve({"load": 800.0, "speed": 545.0, "branch": "film"})
    contact = solve({"load": 800.0, "speed": 545.0, "branch": "contact"})
    assert (film.branch, contact.branch) == ("film", "contact")
    assert (film.distress, contact.distress) == (False, True)
    assert film.film_ratio > 2.33 and contact.film_ratio < 1.10
    assert contact.friction_torque > 3.0 * film.friction_torque
    # without a wish: loaded up from light load
    assert solve({"load": 800.0, "speed": 545.0}).film_ratio == pytest.approx(film.film_ratio)
    # from a start: its branch
    followed = solve({"load": 810.0, "speed": 545.0, "start": contact})
    assert followed.branch == "contact"


@pytest.mark.parametrize("split", [0.0, 0.3, 1.0])
def test_heat_split_moves_heat_to_the_body_named(split):
    """More heat into the carrier makes it the warmer one; the default is in between."""
    even = solve({"load": 300.0, "speed": 545.0})
    r = solve({"load": 300.0, "speed": 545.0}, heat_split=split)

    def difference(result):
        f = result.fields()
        return (f.carrier_temperature - f.washer_temperature).mean()

    assert (difference(r) > difference(even)) == (split > 0.5)
    assert r.friction_torque == pytest.approx(even.friction_torque, rel=0.05)


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


def test_summits_that_scatter_less_touch_later():
    base = solve({"load": 1361.0, "speed": 136.0})
    summit = solve({"load": 1361.0, "speed": 136.0}, asperity_height_law="summit")
    assert summit.film_ratio < base.film_ratio
    assert summit.branch == base.branch == "contact"


@pytest.mark.parametrize("option", CONDUCTION)
def test_every_conduction_option_keeps_the_energy(option):
    point = {"load": 900.0, "speed": 545.0}
    r = solve(point, conduction=option)
    assert r.status is (Status.DISTRESS if r.distress else Status.OK)
    total = Integral(r)
    walls = 0.5 * (total.f.carrier_temperature + total.f.washer_temperature)
    mean = total(walls) / total(np.ones_like(walls))
    assert mean == pytest.approx(r.temperature, abs=0.05)


@pytest.mark.parametrize("gear", [0.0112, 0.0125, 0.0200, 0.0220])
def test_any_size_of_the_gear_face_is_meshed(gear):
    r = solve({"load": 200.0, "speed": 300.0}, gear_inner_radius=gear)
    assert r.status is Status.OK
    assert r.fluid_load + r.contact_load == pytest.approx(200.0, rel=1e-7)


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


BAD = [
    ({"load": math.nan}, ["load", "nan", "N", "10000"]),
    ({"load": -5.0}, ["load", "-5", "N"]),
    ({"load": 0.0}, ["load", "0", "N"]),
    ({"load": "much"}, ["load", "much", "N"]),
    ({"load": 1e5}, ["load", "100000", "N", "10000"]),
    ({"speed": math.inf}, ["speed", "inf", "rad/s", "2000"]),
    ({"tilt": 0.5}, ["tilt", "0.5", "rad", "0.01"]),
    ({"tilt": -0.001}, ["tilt", "-0.001", "rad"]),
    ({"oil_temperature": 24.0}, ["oil_temperature", "24", "K", "233.15"]),
    ({"fidelity": "best"}, ["fidelity", "best", "field", "fine"]),
    ({"grid": (1, 32)}, ["grid", "(1, 32)", "5 x 8"]),
    ({"grid": (10, 1)}, ["grid", "(10, 1)"]),
    ({"grid": (10.5, 32)}, ["grid", "10.5"]),
    ({"grid": 10}, ["grid", "10"]),
    ({"grid": (10, 32, 4)}, ["grid"]),
    ({"grid": (1000, 32)}, ["grid", "1000", "129"]),
    ({"branch": "middle"}, ["branch", "middle", "film", "contact"]),
]


@pytest.mark.parametrize(("change", "words"), BAD, ids=[str(change) for change, _ in BAD])
def test_bad_input_is_named_with_its_value_and_what_is_allowed(change, words):
    point = {"load": 300.0, "speed": 545.0, "tilt": 0.002, **change}
    with pytest.raises(ParameterError) as caught:
        solve_washer(WasherParams(), **point)
    message = str(caught.value)
    assert "\n" not in message
    assert [w for w in words if w not in message] == []


def test_a_film_that_cannot_exist_is_said_not_hidden():
    with pytest.raises(BranchError) as caught:
        solve({"load": 1100.0, "speed": 545.0, "branch": "film"})
    message = str(caught.value)
    assert all(w in message for w in ("branch", "'film'", "1100", "N", "'contact'", "545", "0.002"))
    with pytest.raises(BranchError, match="'contact'"):
        solve({"load": 300.0, "speed": 545.0, "branch": "contact"})


def test_without_throw_the_other_branch_comes_with_its_status():
    r = solve({"load": 1100.0, "speed": 545.0, "branch": "film", "throw": False})
    assert r.status is Status.NO_BRANCH and r.branch == "contact"
    assert r.friction_torque == pytest.approx(
        solve({"load": 1100.0, "speed": 545.0}).friction_torque, rel=1e-6
    )
