"""The four balances: speed of convergence, exact limits, failures."""

import numpy as np
import pytest

from thrustwasher.model.part_file import preset_part
from thrustwasher.numerics.status import MAX_ITERATIONS, NOT_FINITE, OK, OVER_BUDGET, SINGULAR
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.continuation import cold_start
from thrustwasher.washer.kernels.newton import LOAD, NO_FLOOR, _balance, newton
from thrustwasher.washer.kernels.solve import end_of_budget
from thrustwasher.washer.kernels.workspace import Point, forget_factor, vector
from thrustwasher.washer.parameters import SPEC

from washer_setup import BASE, bench, full_gear, settle, tilted  # isort: skip
from closed_forms.heated_ring import annulus_rise, stack_rise

from thrustwasher.washer.kernels.gap import dry_friction, evaluate_gaps
from thrustwasher.washer.kernels.heat import heat_residual
from thrustwasher.washer.kernels.heat_factor import factor_heat, solve_heat
from thrustwasher.washer.kernels.newton import evaluate
from thrustwasher.washer.parameters import CONDUCTION

from washer_setup import (  # isort: skip
    Bench,
    bodies,
    order,
)
from kernel_part import Part

from thrustwasher import solve_washer
from thrustwasher.errors import Status
from thrustwasher.washer.kernels.regime_and_status import BOUNDARY, FILM
from thrustwasher.washer.parameters import WasherParams

GRID = (5, 12)  # what is tested holds on any mesh; these kernels run as plain Python


def balances(b, pt, q):
    settle(b.m, pt, q, b.f)
    _balance(b.m, b.f)
    return vector(b.f.small, L.BALANCE).copy()


def converged(target, b, pt, ratio=6.0, tolerance=1e-9, limit=60.0):
    b.w.info[:] = 0.0
    cold_start(b.w, pt, ratio)
    settle(b.m, pt, b.w.q, b.f)
    status = newton(b.w, pt, LOAD, target, NO_FLOOR, tolerance, limit)
    return b.w.q.copy(), b.w.info, status


def residuals_from_near_by(**changes):
    """Return the residuals after 1, 2, ... full steps, each with a factor made there."""
    b = bench(GRID, **changes)
    pt = Point(300.0, 953.0, 0.002, 297.15, 297.15)
    q, info, status = converged(300.0, b, pt, ratio=15.0)
    assert status == OK
    b.w.q[:], residuals = q * np.array([1.03, 1.03, 1.0, 1.0]), []
    for _ in range(5):
        forget_factor(b.w)
        newton(b.w, pt, LOAD, 300.0, NO_FLOOR, 1e-16, 1.0)
        residuals.append(info[L.RESIDUAL])
    return np.array(residuals)


def test_convergence_is_quadratic_with_a_fresh_factor():
    residuals = residuals_from_near_by(**preset_part(SPEC, "paper").parameters)
    logs = np.log(residuals[:4])
    assert residuals[3] < 1e-9
    assert (logs[2] - logs[1]) / (logs[1] - logs[0]) > 1.5


def test_each_iteration_gains_a_digit_where_oil_carries_heat():
    residuals = residuals_from_near_by()
    assert np.all(residuals[1:] < 0.1 * residuals[:-1]), residuals


def test_solution_is_the_same_from_thin_and_thick_starts():
    b = bench(GRID)
    found = [converged(300.0, b, BASE, ratio=r) for r in (4.0, 8.0, 20.0)]
    assert [status for _, _, status in found] == [OK] * 3
    for q, _, _ in found[1:]:
        np.testing.assert_allclose(q, found[0][0], rtol=1e-7, atol=1e-11)


def test_equal_annuli_at_rest_share_the_tilt():
    """Without film and with equal faces the washer stands half way: gy/gt = 0.5, gx = 0.

    Contact is summed from nodes in gap 2, integrated between them in film 1: a tilt of a few
    roughnesses, on which both agree.
    """
    b = full_gear((10, 32))
    pt = Point(2000.0, 0.0, 2e-4, 297.15, 297.15)
    q, info, status = converged(2000.0, b, pt, ratio=1.0)
    assert status == OK, info
    assert q[3] / pt.tilt == pytest.approx(0.5, abs=5e-4)
    assert abs(q[2]) < 1e-9 * pt.tilt


def test_isothermal_film_scales_with_viscosity_times_speed():
    """At given gaps, all heat left out: pressure forces go with mu omega."""
    loads = []
    for speed, scale in ((200.0, 6.31e-5), (800.0, 6.31e-5), (200.0, 2 * 6.31e-5)):
        b = bench(GRID, film_heat_fraction=0.0, oil_cooling=False, viscosity_scale=scale)
        pt = BASE._replace(speed=speed)
        q = tilted(b.m, 12.0, second=9.0)
        loads.append(balances(b, pt, q)[0] - b.f.small[L.FORCES])
        assert b.f.small[L.CONTACT] < 1e-9 * loads[0]
    assert loads[1] == pytest.approx(4.0 * loads[0], rel=1e-9)
    assert loads[2] == pytest.approx(2.0 * loads[0], rel=1e-9)


@pytest.mark.parametrize("name", ["q", "temp"])
def test_a_start_that_is_no_number_is_a_failure(name):
    b = bench(GRID)
    converged(300.0, b, BASE)
    {"q": b.w.q, "temp": b.f.temp}[name][1] = np.nan
    status = newton(b.w, BASE, LOAD, 300.0, NO_FLOOR, 1e-9, 10.0)
    assert status in (NOT_FINITE, SINGULAR, MAX_ITERATIONS)


def test_a_pressure_that_is_no_number_is_solved_for_again():
    b = bench(GRID)
    q, _, _ = converged(300.0, b, BASE)
    b.f.p[1:-1] = np.nan
    assert newton(b.w, BASE, LOAD, 300.0, NO_FLOOR, 1e-9, 10.0) == OK
    np.testing.assert_allclose(b.w.q, q, rtol=1e-8, atol=1e-11)


def test_iterations_end_at_their_limit():
    b = bench(GRID)
    _, info, status = converged(300.0, b, BASE, limit=2.0)
    assert status == MAX_ITERATIONS and info[L.ITERATIONS] == 2.0 and info[L.FACTORED] >= 1.0


def test_newton_starts_from_a_thick_film():
    """Thicker than 8.3 sigma everywhere it has no stiffness unless it starts with a pressure."""
    b = bench(GRID)
    pt = Point(300.0, 953.0, 0.002, 297.15, 297.15)
    cold_start(b.w, pt, 15.0)
    assert newton(b.w, pt, LOAD, 300.0, NO_FLOOR, 1e-9, 40.0) == OK


def test_iterations_end_with_the_budget_and_the_status_says_so():
    b, pt = bench(GRID), Point(300.0, 953.0, 0.002, 297.15, 297.15)
    b.w.info[:] = 0.0
    b.w.info[L.BUDGET] = 3.0
    cold_start(b.w, pt, 6.0)
    settle(b.m, pt, b.w.q, b.f)
    for _ in range(2):  # a second try begins none
        status = newton(b.w, pt, LOAD, 300.0, NO_FLOOR, 1e-9, 60.0)
        assert status == MAX_ITERATIONS and b.w.info[L.ITERATIONS] == 3.0
    assert end_of_budget(b.w, status) == OVER_BUDGET
    assert newton(b.w, pt, LOAD, 300.0, NO_FLOOR, 1e-9, 60.0) == OK, "what follows has no budget"


def test_a_solution_found_with_the_last_iteration_counts():
    b = bench(GRID)
    b.w.info[L.ITERATIONS] = b.w.info[L.BUDGET] = 3.0
    assert end_of_budget(b.w, OK) == OK


# Heat balance: exact stack, Bessel annulus at its order, conservation, differences, options.

HEAT_GRID = (7, 20)  # what is tested holds on any mesh; some of these kernels run as plain Python
CONDUCTIVITY, OIL = 60.5, 0.145
PAPER = preset_part(SPEC, "paper").parameters
DRY = {"oil_cooling": False, "pressure_flow_shear": False}  # the oil carries no heat
LAWS = {
    "default": {},
    "paper": PAPER,
    "carrier turns": {"conduction": "rotating", "heat_split": 0.3},
    "everywhere": {"conduction": "all", "friction_law": "constant"},
    "liquid alone": {"cavity_shear": "liquid", "heat_split": 0.8},
    "no pressure flow": {"pressure_flow_shear": False, "oil_supply_temperature": 330.0},
    "rings without flow": {**DRY, "film_heat_fraction": 0.7, "heat_split": 0.3},
}


def heat_given(b, heat, first=1e-5, second=5e-6):
    """Prescribe gaps and a heat flow [W/m2] (n_r, n_theta) that depends on no temperature."""
    f, m = b.f, b.m
    f.ht[:], f.ht2[:] = first, second
    f.pc[:], f.dmu[:], f.small[L.FRICTION] = 0.0, 0.0, 0.0
    f.mu[:] = (heat * first / (BASE.speed * b.radius) ** 2).T.ravel()
    f.fluidity[:] = 1.0
    f.temp[:] = 0.0
    heat_residual(m, BASE, f.temp, f)
    assert factor_heat(m, BASE, f)
    f.heat[:] *= -1.0
    solve_heat(m, f.heat, f.temp, f)


def touching(b, first=0.3, second=1.2):
    """Return positions where film 1 carries contact within the range of the friction law."""
    q = tilted(b.m, first, gy=0.00166, gx=-1.2e-5, second=second)
    evaluate_gaps(b.m, BASE, q, b.f)
    assert 260.5 < b.f.small[L.CONTACT] < 1725.6
    return q


@pytest.mark.parametrize("oil", [{}, DRY])
@pytest.mark.parametrize("conduction", CONDUCTION)
@pytest.mark.parametrize("split", [0.5, 0.0, 0.3, 1.0])
@pytest.mark.parametrize("grid", [(5, 8), pytest.param((10, 32), marks=pytest.mark.slow)])
def test_an_evenly_heated_stack_is_exact_on_every_grid(grid, split, conduction, oil):
    b = full_gear(grid, heat_split=split, conduction=conduction, **oil)
    heat_given(b, np.full((grid[0], grid[1]), 1e5))
    half = 6.35e-4 / (2.0 * CONDUCTIVITY)
    back = 0.01 / CONDUCTIVITY
    expected = stack_rise(1e5, split, 1e-5 / OIL + half, 5e-6 / OIL + half, back, back)
    for found, rise in zip(bodies(b), expected, strict=True):
        np.testing.assert_allclose(found, rise, rtol=1e-10)
    if split == 0.5:
        tabled = (33.00312669, 33.33478041, 31.52579893)
        assert [24.0 + x[0, 0] for x in bodies(b)] == pytest.approx(tabled, abs=1e-8)


@pytest.mark.parametrize("conduction", CONDUCTION)
def test_with_an_insulated_gear_all_heat_leaves_through_the_carrier(conduction):
    b = full_gear(
        HEAT_GRID, heat_split=0.3, conduction=conduction, gear_far_face="insulated", **DRY
    )
    heat_given(b, np.full(HEAT_GRID, 1e5))
    first = 1e5 * 0.01 / CONDUCTIVITY
    last = first + 0.7 * 1e5 * (1e-5 / OIL + 6.35e-4 / (2.0 * CONDUCTIVITY))
    for found, rise in zip(bodies(b), (first, last, last), strict=True):
        np.testing.assert_allclose(found, rise, rtol=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("changes", [PAPER, {}])
def test_an_annulus_alone_converges_with_order_two(changes):
    """Oil that conducts from wall to wall no more leaves the carrier on its own: Bessel."""
    errors = []
    for grid in ((16, 48), (31, 96)):
        b = bench(grid, **{**changes, "heat_split": 1.0})
        b = Bench(b.m._replace(oil_conductivity=1e-14), b.f)
        angle = np.arctan2(b.m.sin, b.m.cos)
        heat_given(b, 1e5 * (b.radius / b.m.outer_radius) ** 2 * np.cos(2.0 * angle))
        amplitude = annulus_rise(
            np.asarray(b.m.r), 1e5, 2, CONDUCTIVITY, 0.01, b.m.inner_radius, b.m.outer_radius
        )
        exact = np.outer(amplitude, np.cos(2.0 * angle))
        errors.append(np.abs(bodies(b)[0] - exact).max() / np.abs(exact).max())
    assert order(errors) == pytest.approx([2.0], abs=0.15)
    assert errors[-1] < 1.5e-3


def at_random(b, seed=1):
    """Evaluate everything where film 1 touches, at temperatures drawn at random."""
    q = touching(b)
    b.f.temp[:] = np.random.default_rng(seed).uniform(0.0, 80.0, b.f.temp.size)
    return q, evaluate(b.m, BASE, q, b.f, False)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.slow
def test_heat_made_is_heat_out_at_any_temperature(name):
    """What the residual adds up to is heat out less heat made: nothing is lost in between."""
    b = bench(HEAT_GRID, **LAWS[name])
    m, f = b.m, b.f
    q, made = at_random(b)
    carrier, _, gear = bodies(b)
    out = (np.outer(m.weight1, m.weight_t) * carrier).sum() * CONDUCTIVITY / m.carrier_thickness
    out += (np.outer(m.weight2[m.i_g :], m.weight_t) * gear).sum() * CONDUCTIVITY / m.gear_thickness
    out += m.oil_storage * (f.rim * f.liquid) @ f.edge
    assert f.heat.sum() == pytest.approx(out - made, rel=1e-10)
    settle(m, BASE, q, f)
    assert np.abs(f.heat).sum() < 1e-9 * made


@pytest.mark.parametrize("name", LAWS)
def test_torque_times_speed_is_the_heat_made(name):
    """Pressure flow included: what it makes in all faces is its share of the torque."""
    b = bench(HEAT_GRID, **LAWS[name])
    m, f = b.m, b.f
    _, made = at_random(b)
    area = np.outer(m.weight1, m.weight_t)
    liquid = b.node("liquid") if m.only_liquid else 1.0
    torque = (area * liquid * BASE.speed * b.radius**2 * b.node("mu") / b.node("ht")).sum()
    p = b.node("p")
    if m.pressure_shear:
        torque += (b.node("wedge") * (np.roll(p, -1, axis=1) - p)).sum() / BASE.speed
    friction = dry_friction(m.par, f.small[L.CONTACT])[0]
    rub = friction * (area * b.radius * b.node("pc")).sum()
    assert made == pytest.approx((m.film_heat_fraction * torque + rub) * BASE.speed, rel=1e-9)
    assert p.max() > 1e5


def test_dry_friction_has_its_published_ends_and_its_slope():
    m = bench((5, 8)).m
    assert dry_friction(m.par, 260.5)[0] == pytest.approx(0.201870, abs=5e-7)
    assert dry_friction(m.par, 1725.6)[0] == pytest.approx(0.107333, abs=5e-7)
    assert dry_friction(m.par, 0.0) == (dry_friction(m.par, 260.5)[0], 0.0)
    assert dry_friction(m.par, 1e5) == (dry_friction(m.par, 1725.6)[0], 0.0)
    value, slope = dry_friction(m.par, 900.0)
    assert value == pytest.approx(0.48 - 0.05 * np.log(900.0), rel=1e-14)
    differences = (dry_friction(m.par, 900.01)[0] - dry_friction(m.par, 899.99)[0]) / 0.02
    assert slope == pytest.approx(differences, rel=1e-7)
    assert dry_friction(bench((5, 8), friction_law="constant").m.par, 900.0) == (0.15, 0.0)


# The washer behind the step ABI: what may change, what must not, and what survives.


def stepped(*inputs):
    """Return a washer after a step of 1 ms from nothing."""
    washer = Part("washer", "field")
    assert washer.step(inputs, 1e-3) == Status.OK
    return washer


def test_distress_and_regime_are_told():
    """Past the fold: distress; back below the lower one: none."""
    washer, told = Part("washer", "field"), []
    for load in (300.0, 800.0, 1100.0, 800.0, 500.0):
        assert washer.step((load, 545.0, 0.002, 297.15), 1e-3) == Status.OK
        told.append((washer.iout[L.IO_REGIME], washer.iout[L.IO_STATUS]))
    film, boundary = (FILM, Status.OK), (BOUNDARY, Status.DISTRESS)
    assert told == [film, film, boundary, boundary, film]


def test_a_spot_above_250_degc_is_hot_unless_the_film_is_lost():
    """On a single-valued curve; the result in Python has the same status."""
    washer = stepped(1400.0, 300.0, 0.0012, 400.0)
    assert washer.out[L.O_PEAK] > L.HOT_LIMIT and not washer.iout[L.IO_DISTRESS]
    assert washer.iout[L.IO_STATUS] == Status.HOT
    point = {"load": 1400.0, "speed": 300.0, "tilt": 0.0012, "oil_temperature": 400.0}
    r = solve_washer(WasherParams(), **point)
    assert r.status is Status.HOT and r.temperature_max > L.HOT_LIMIT
    assert Status.HOT.advice in " ".join(r.warnings)


def test_outside_the_verified_range_is_told():
    heavy, cold = stepped(5000.0, 545.0, 0.002, 297.15), stepped(100.0, 545.0, 0.002, 250.0)
    assert heavy.iout[L.IO_STATUS] in (Status.OUTSIDE_VERIFIED, Status.DISTRESS)
    assert cold.iout[L.IO_STATUS] == Status.OUTSIDE_VERIFIED
