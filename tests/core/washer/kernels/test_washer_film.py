"""Film equation: closed forms at their order, complementarity, differences, exact zeros."""

import numpy as np
import pytest
from closed_forms.thin_film import couette_torque, wedge_moment, wedge_pressure

from lab.benchmarks.failures.narrow_ring import narrow_ring_load
from thrustwasher.tribology.flow_factors import flow_conductance, mean_gap, shear_flow
from thrustwasher.washer.kernels.film import (
    _solve_one,
    evaluate_film,
    film_factor,
    film_solve,
    mark_film,
    settle_film,
)
from thrustwasher.washer.kernels.gap import evaluate_gaps
from thrustwasher.washer.kernels.layout import RING

from washer_setup import BASE, bench, order, tilted  # isort: skip

from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.heat import heat_residual
from thrustwasher.washer.kernels.newton import evaluate
from thrustwasher.washer.kernels.throughflow import _leave
from thrustwasher.washer.parameters import WasherParams
from thrustwasher.washer.solve import constants

from washer_setup import bench_of, settle  # isort: skip
import math

from thrustwasher.errors import Status
from thrustwasher.washer.kernels import step as kernel
from thrustwasher.washer.kernels.layout import N_HEAD
from thrustwasher.washer.kernels.workspace import size_of_state, size_of_work
from thrustwasher.washer.solve import solve_washer

MU = 0.06
GRIDS = [(19, 64), (37, 128), (73, 256)]


def at_constant_viscosity(grid, q, pt, **changes):
    b = bench(grid, **changes)
    evaluate_gaps(b.m, pt, q, b.f)
    b.f.mu[:], b.f.dmu[:], b.f.fluidity[:] = MU, 0.0, 1.0 / MU
    evaluate_film(b.m, pt, q, b.f)
    return b


def solve_at_marks(b):
    """Solve the film linearly, its nodes full or cavitated as they are marked."""
    wedge = b.node("wedge")
    b.node("p")[:] = np.roll(wedge, 1, axis=1) - wedge
    assert film_factor(b.m, b.f)
    _solve_one(b.m, b.f, b.f.p)
    return b.node("p").copy()


def solve_without_cavitation(b):
    b.f.wet.reshape(b.m.n_t, b.m.n_r)[:, 1:-1] = 1.0
    n_t = b.m.n_t
    b.f.place[: (n_t + 1) // 2] = np.arange(0, n_t, 2)
    b.f.place[(n_t + 1) // 2 :] = np.arange(1, n_t, 2)[::-1]
    b.f.small[RING] = 1.0
    return solve_at_marks(b)


def solve_with_cavitation(b):
    assert settle_film(b.m, b.f) <= 1e-12
    return b.node("p")


def moment_about_x(b, p):
    weight = np.outer(b.m.weight1 * b.m.r, b.m.weight_t * b.m.sin)
    return (weight * p).sum()


def smooth_wedge():
    """Return positions and tilt of a film so thick (1000 sigma) that roughness does not count."""
    gap, tilt = 7.28e-4, 1e-7
    return gap, tilt, np.array([gap, 2.0 * gap, 0.0, tilt])


def test_parallel_gap_drives_no_flow_at_all():
    b = at_constant_viscosity((10, 32), np.array([3e-6, 6e-6, 0.0, 0.0]), BASE)
    assert mark_film(b.m, b.f) == (0.0, 0.0, 0)


@pytest.mark.parametrize("grid", [(7, 16), (10, 32), (19, 64)])
def test_torque_of_a_parallel_film_is_couettes(grid):
    """Spline weights integrate r^3 exactly."""
    b = at_constant_viscosity(grid, np.array([1e-5, 2e-5, 0.0, 0.0]), BASE)
    w = np.outer(b.m.weight1, b.m.weight_t)
    torque = (w * b.radius**2 * MU * BASE.speed / b.node("ht")).sum()
    exact = couette_torque(MU, BASE.speed, 1e-5, b.m.inner_radius, b.m.outer_radius)
    assert torque == pytest.approx(exact, rel=1e-13)


@pytest.mark.slow
def test_small_tilt_pressure_converges_with_order_two():
    gap, tilt, q = smooth_wedge()
    pressures, moments = [], []
    for grid in GRIDS:
        b = at_constant_viscosity(grid, q, BASE)
        p = solve_without_cavitation(b)
        args = (MU, BASE.speed, tilt, gap, b.m.inner_radius, b.m.outer_radius)
        angle = np.arctan2(b.m.sin, b.m.cos)
        exact = np.array([[wedge_pressure(r, a, *args) for a in angle] for r in b.m.r])
        pressures.append(np.abs(p - exact).max() / np.abs(exact).max())
        moments.append(abs(moment_about_x(b, p) / wedge_moment(*args) - 1.0))
    assert order(pressures) == pytest.approx([2.0, 2.0], abs=0.2)
    assert order(moments) == pytest.approx([2.0, 2.0], abs=0.2)
    assert pressures[-1] < 2e-4 and moments[-1] < 2e-4


@pytest.mark.slow
def test_a_wide_ring_shows_where_the_faces_are():
    """With r_o = 5 r_i a face radius wrong by half a cell spoils the order."""
    gap, tilt, q = smooth_wedge()
    # inside the gear's radius 4, 8 and 16 intervals: one family
    wide = {"inner_radius": 0.005, "outer_radius": 0.025, "gear_inner_radius": 0.0124}
    errors = []
    for grid in GRIDS:
        b = at_constant_viscosity(grid, q, BASE, **wide)
        moment = moment_about_x(b, solve_without_cavitation(b))
        errors.append(abs(moment / wedge_moment(MU, BASE.speed, tilt, gap, 0.005, 0.025) - 1.0))
    assert order(errors) == pytest.approx([2.0, 2.0], abs=0.2)


@pytest.mark.slow
def test_narrow_ring_carries_the_closed_form_load():
    """The error falls with the square of width over radius, at the same relative mesh."""
    errors = []
    h0, e = 1e-3, 4e-4
    for width in (0.002, 0.001, 0.0005):
        ri, ro = 0.02 - width / 2, 0.02 + width / 2
        b = at_constant_viscosity(
            (25, 256),
            np.array([h0, 2 * h0, 0.0, e / 0.02]),
            BASE,
            inner_radius=ri,
            gear_inner_radius=ri + width / 3,
            outer_radius=ro,
        )
        load = (np.outer(b.m.weight1, b.m.weight_t) * solve_with_cavitation(b)).sum()
        errors.append(abs(load / narrow_ring_load(MU, BASE.speed, ri, ro, h0 - e, h0 + e) - 1.0))
    assert errors[-1] < 3e-3
    assert errors[0] > errors[1] > errors[2]


def independent_flows(b, q, pt, p):
    """Return the net outflow of each inner node, written again as whole-array formulas."""
    m = b.m
    r, n_t = np.asarray(m.r), m.n_t
    face = 0.5 * (r[1:] + r[:-1])
    inner, outer = np.append(r[0], face), np.append(face, r[-1])
    middle = 2.0 / 3.0 * (outer**3 - inner**3) / (outer**2 - inner**2)  # of a cell's area
    theta = np.unwrap(np.arctan2(m.sin, m.cos))
    ahead = np.append(theta[1:], theta[0] + 2 * np.pi)
    half = np.unwrap(np.arctan2(m.sin_face, m.cos_face))  # between the nodes in the parameter s
    width = half - np.concatenate(([half[-1] - 2 * np.pi], half[:-1]))

    def gap(radius, angle):
        tilt = np.sin(angle) * q[2] - np.cos(angle) * q[3]
        return q[0] + radius[:, None] * tilt[None, :]

    def conductance(h):
        return np.array([flow_conductance(x, m.sigma1)[0] for x in h.ravel()]).reshape(h.shape)

    def wedge(h):
        flat = [
            mean_gap(x, m.sigma1)[0] - m.sigma1 * m.shear * shear_flow(x, m.sigma1)[0]
            for x in h.ravel()
        ]
        return np.array(flat).reshape(h.shape)

    fluid = 1.0 / b.node("mu")
    at_nodes = 1.0 / (r[:, None] * conductance(gap(r, theta)))
    at_faces = 1.0 / (face[:, None] * conductance(gap(face, theta)))
    resistance = 0.07 * (at_nodes[1:] + at_nodes[:-1]) + 0.86 * at_faces
    across = 0.5 * (fluid[1:] + fluid[:-1]) / (12.0 * resistance)
    q_r = -across * (p[1:] - p[:-1]) / (r[1:] - r[:-1])[:, None] * width
    around = conductance(gap(middle, half)) / 12.0 * 0.5 * (fluid + np.roll(fluid, -1, axis=1))
    log_width = np.log(face[1:] / face[:-1])
    q_t = -around * (np.roll(p, -1, axis=1) - p) / (ahead - theta)
    area = 0.5 * (face[1:] ** 2 - face[:-1] ** 2)[:, None]
    q_t = q_t[1:-1] * log_width[:, None] + 0.5 * pt.speed * area * wedge(gap(middle, half))[1:-1]
    assert q_t.shape == (m.n_r - 2, n_t)
    return q_r[1:] - q_r[:-1] + q_t - np.roll(q_t, 1, axis=1)


@pytest.mark.parametrize("surfaces", [{}, {"roughness_carrier": 1e-6, "roughness_washer": 3e-7}])
@pytest.mark.parametrize("ratio", [0.4, 3.0, 15.0])
def test_solution_is_full_or_cavitated_everywhere(surfaces, ratio):
    """p >= 0, outflow >= 0, one of them zero: Reynolds cavitation, with uneven viscosity."""
    b = bench((10, 32), **surfaces)
    q = tilted(b.m, ratio)
    rng = np.random.default_rng(7)
    evaluate_gaps(b.m, BASE, q, b.f)
    b.f.mu[:] = MU * rng.uniform(0.3, 1.0, b.f.mu.size)
    b.f.fluidity[:] = 1.0 / b.f.mu
    evaluate_film(b.m, BASE, q, b.f)
    p = solve_with_cavitation(b)
    flow = independent_flows(b, q, BASE, p)
    full = p[1:-1] > 0.0
    scale = np.abs(flow).max()
    assert np.all(p >= 0.0) and np.all(p[[0, -1]] == 0.0)
    assert full.any() and (~full).any()
    assert np.all(flow >= -1e-11 * scale)
    assert np.all(np.abs(flow[full]) <= 1e-11 * scale)


def test_a_rough_moving_surface_weakens_the_wedge():
    """It carries along most oil where the gap is least; beyond 1 sigma the shear factor falls."""
    rough = {"carrier": (1e-6, 2e-7), "even": (7.2111e-7,) * 2, "washer": (2e-7, 1e-6)}
    loads = {}
    for name, (carrier, washer) in rough.items():
        b = bench((10, 32), roughness_carrier=carrier, roughness_washer=washer)
        q = tilted(b.m, 3.0)
        evaluate_gaps(b.m, BASE, q, b.f)
        b.f.mu[:], b.f.fluidity[:] = MU, 1.0 / MU
        evaluate_film(b.m, BASE, q, b.f)
        loads[name] = (np.outer(b.m.weight1, b.m.weight_t) * solve_with_cavitation(b)).sum()
    assert loads["washer"] < 0.99 * loads["even"] < 0.98 * loads["carrier"]


def test_film_that_only_opens_cavitates_everywhere():
    """All around: no column is left, the pressure is zero, nothing fails."""
    b = at_constant_viscosity((10, 32), np.array([1e-5, 2e-5, 0.0, 2e-4]), BASE._replace(speed=0.0))
    assert settle_film(b.m, b.f) == 0.0 and not b.f.p.any()
    film_solve(b.m, b.f)
    assert np.all(b.f.film_rhs == 0.0)


# Oil through film 1: closed forms along a stream, limits of its heat capacity, continuity.


def stream(n_t, source):
    """Return angles and rises of oil that turns with a stream between walls held at 0.

    ``source`` (n_t,) scales the heat made. Exchange per radian over what flows is about 1.
    """
    b = bench((5, n_t))
    m, f = b.m, b.f
    f.ht[:], f.ht2[:], f.liquid[:], f.fluidity[:] = 1e-5, 1e-5, 1.0, 1.0
    f.mu[:] = (source * 1e-5 / (BASE.speed * b.radius) ** 2).T.ravel()
    per_angle = m.film_exchange * np.asarray(m.weight1) / 1e-5
    b.node("flow_t")[:] = (per_angle / m.oil_storage)[:, None]
    f.flow_r[:] = 0.0
    _leave(m, f)
    at = (m.film_at + np.arange(n_t) * m.film_step)[None, :] + np.arange(m.n_r)[:, None]
    f.temp[:] = 0.0
    heat_residual(m, BASE, f.temp, f)
    made, i = f.heat[at[2]].copy(), 2
    matrix = np.empty((n_t, n_t))
    for j in range(n_t):
        f.temp[:] = 0.0
        f.temp[at[:, j]] = 1.0
        heat_residual(m, BASE, f.temp, f)
        matrix[:, j] = f.heat[at[i]] - made
    angle = np.unwrap(np.arctan2(m.sin, m.cos))
    rise = np.linalg.solve(matrix, -made) * m.film_exchange / 1e-5
    return angle, rise


@pytest.mark.slow
def test_heat_made_in_waves_warms_a_turning_stream_in_waves():
    """dT/da + T = cos a has T = (cos a + sin a)/2; second order in the mesh."""
    errors = []
    for n_t in (32, 64, 128):
        angle = np.unwrap(np.arctan2(bench((5, n_t)).m.sin, bench((5, n_t)).m.cos))
        angle, rise = stream(n_t, np.cos(angle))
        errors.append(np.abs(rise - 0.5 * (np.cos(angle) + np.sin(angle))).max())
    assert order(errors) == pytest.approx([2.0, 2.0], abs=0.3)
    assert errors[-1] < 1e-3


@pytest.mark.parametrize("speed", [545.0, -545.0])
@pytest.mark.parametrize("ratio", [2.0, 12.0])
def test_oil_that_enters_a_node_leaves_it(ratio, speed):
    """Where the film is full all of it; where the gap opens the liquid; full where it closes."""
    b = bench((10, 32))
    m, f = b.m, b.f
    pt, q = BASE._replace(speed=speed), tilted(b.m, ratio, gx=0.0)
    evaluate(m, pt, q, f, False)
    liquid, on, up = b.node("liquid"), b.node("flow_t"), b.node("flow_r")
    down = np.vstack((np.zeros(32), up[:-1]))
    back = np.roll(on, 1, axis=1)
    full = b.node("p") > 0.0
    net = on - back + up - down
    assert np.abs(net[full]).max() < 1e-9 * np.abs(on).max()
    assert liquid.min() > 0.0 and liquid.max() <= 1.0 + 1e-12
    closes = np.sin(np.arctan2(m.sin, m.cos)) * np.sign(speed) < -0.3
    assert np.all(liquid[:, closes] == 1.0) and liquid.min() < 0.9


def cooled(**changes):
    """Return a bench settled at fixed gaps, some oil constants changed beyond their ranges."""
    par = constants(WasherParams(oil_supply_temperature=310.0), (10, 32)).copy()
    for place, value in changes.items():
        par[getattr(L, place)] = value
    b = bench_of(par, (10, 32))
    settle(b.m, BASE, tilted(b.m, 9.0), b.f)
    return b


@pytest.mark.slow
def test_oil_without_heat_capacity_is_warmer_than_the_walls_by_its_heat():
    b = cooled(P_OIL_DENSITY=1e-7)
    film = b.f.temp[: b.m.film_step * 32].reshape(32, -1)
    washer = b.f.temp[b.m.washer_at :][:10]
    walls = 0.5 * (film[:, 10:20] + washer)
    np.testing.assert_allclose((film[:, :10] - walls).ravel(), b.f.made / b.f.exchange, rtol=1e-5)


# The washer on a mesh of 5 x 8 nodes: small enough to run as plain Python, whole all the same.

GRID = (5, 8)
PARAMS = WasherParams()
FILM = {"load": 300.0, "speed": 545.0, "tilt": 2e-3}
CONTACT = {"load": 1500.0, "speed": 545.0, "tilt": 2e-3}


def solve(**changes):
    return solve_washer(PARAMS, grid=GRID, **{**FILM, **changes})


@pytest.mark.parametrize(("point", "branch"), [(FILM, "film"), (CONTACT, "contact")])
def test_both_branches_carry_their_load(point, branch):
    r = solve(**point)
    said = Status.DISTRESS if branch == "contact" else Status.OK
    assert (r.status, r.branch) == (said, branch)
    assert r.fluid_load + r.contact_load == pytest.approx(r.load, rel=1e-6)
    assert r.temperature_max > r.temperature > r.oil_temperature


def test_a_warm_start_ends_where_a_cold_one_does():
    """Both stop where the load is balanced to some 1e-6."""
    warm = solve(load=330.0, start=solve())
    assert warm.friction_torque == pytest.approx(solve(load=330.0).friction_torque, rel=1e-5)


@pytest.mark.parametrize(
    "law",
    [
        {"conduction": "all"},
        {"conduction": "rotating"},
        {"oil_cooling": False},
        {"cavity_shear": "liquid"},
        {"friction_law": "constant"},
        {"asperity_height_law": "summit"},
    ],
)
def test_other_laws_balance_too(law):
    r = solve_washer(WasherParams(**law), grid=GRID, **CONTACT)
    assert r.fluid_load + r.contact_load == pytest.approx(r.load, rel=1e-6)


def test_steps_go_on_from_their_memory_and_fail_without_harming_it():
    par = constants(PARAMS, GRID)
    state, work = np.zeros(size_of_state(*GRID)), np.zeros(N_HEAD + size_of_work(*GRID))
    out, iout = np.zeros(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)
    loads = []
    for load in (300.0, 320.0):
        inp = np.array([load, 545.0, 2e-3, 297.15, 0.0, 0.0])
        assert kernel.step(par, inp, state, work, out, iout, 0.0, 1e-3) == Status.OK
        loads.append(out[0])
    assert loads[0] != loads[1]
    before = state.copy()
    inp[0] = math.nan
    assert kernel.step(par, inp, state, work, out, iout, 0.0, 1e-3) >= Status.MAX_ITERATIONS
    assert np.array_equal(state, before)


def test_the_curve_has_its_folds():
    from thrustwasher.washer.load_curve import load_curve

    curve = load_curve(PARAMS, speed=545.0, tilt=2e-3, grid=GRID)
    assert [f.kind for f in curve.folds] == ["film_lost", "film_regained"]
