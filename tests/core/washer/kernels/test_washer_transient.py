"""A washer whose bodies store heat: against exponentials, limits, balances and differences."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from thrustwasher import WasherParams, load_curve, solve_washer
from thrustwasher.model.parameters import as_numbers
from thrustwasher.washer.follow import Follower
from thrustwasher.washer.kernels import ladder
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels import step as k
from thrustwasher.washer.kernels.constants import derive_grid, size_of_par, washer_model
from thrustwasher.washer.kernels.heat import conduct, set_steady
from thrustwasher.washer.kernels.regime_and_status import point_of
from thrustwasher.washer.kernels.workspace import (
    fields_of,
    size_of_state,
    size_of_work,
    workspace_of,
)

GRID = (5, 8)
OIL = 297.15
IN_TIME = WasherParams(thermal_mode="transient")
DRY = replace(IN_TIME, oil_cooling=False, pressure_flow_shear=False)  # the oil carries no heat
TORQUE, MEAN, RATIO, POWER = L.O_TORQUE, L.O_MEAN, L.O_RATIO, L.O_POWER


class Washer:
    """The kernel with its arrays."""

    def __init__(self, params=IN_TIME, grid=GRID):
        self.par = np.zeros(size_of_par(*grid))
        self.par[: L.N_PARAM] = [*as_numbers(params), L.FIELD]
        assert derive_grid(self.par, *grid) == 0
        self.m = washer_model(self.par)
        self.state = np.zeros(size_of_state(*grid))
        self.work = np.zeros(L.N_HEAD + size_of_work(*grid))
        self.out, self.iout = np.zeros(k.NOUT), np.zeros(3, np.int32)

    def go(self, dt, load=300.0, speed=545.0, tilt=2e-3, oil=OIL, far_face=0.0):
        inp = self.inp = np.array((load, speed, tilt, oil, far_face))
        return k.step(self.par, inp, self.state, self.work, self.out, self.iout, 0.0, dt)

    def fields(self):
        return fields_of(workspace_of(self.par, self.work))

    def rises(self):
        return self.fields().temp.copy()

    def stored(self):
        return ladder.stored_heat(workspace_of(self.par, self.work))

    def leaving(self):
        """Return the heat that reaches the oil at the end of the step [W]."""
        return self.work[L.AT_OUTPUTS + L.O_OIL_HEAT]

    def taken(self):
        """Return the heat that flows into the bodies [W]."""
        f, total = self.fields(), 0.0
        for b in bodies_of(self.m):
            for j in range(b.columns):
                part = slice(b.at + j * b.step + b.first, b.at + j * b.step + self.m.n_r)
                total += ladder.angle_of(self.m, b, j) * (b.weight[b.first :] @ f.flux[part])
        return total


def bodies_of(m):
    return [ladder.body_of(m, body) for body in ladder.BODIES]


def steady(params=IN_TIME, load=300.0, speed=545.0):
    at = {"load": load, "speed": speed, "tilt": 2e-3, "oil_temperature": OIL, "grid": GRID}
    return solve_washer(replace(params, thermal_mode="quasi_steady"), **at)


def matrices(w):
    """Return the conductances [W/K] and capacities [J/K] of the present gaps, bodies lumped."""
    f, n = w.fields(), w.rises().size
    conductances, capacities = np.empty((n, n)), np.zeros(n)
    set_steady(w.m, point_of(w.par, w.inp), f)
    for i in range(n):
        unit, heat = np.zeros(n), np.zeros(n)
        unit[i] = 1.0
        conduct(w.m, unit, f, heat)
        conductances[:, i] = heat
    for b in bodies_of(w.m):
        for j in range(b.columns):
            part = slice(b.at + j * b.step + b.first, b.at + j * b.step + w.m.n_r)
            capacities[part] = b.storage * b.weight[b.first :] * ladder.angle_of(w.m, b, j)
    return conductances, capacities


@pytest.mark.parametrize("conduction", ["carrier", "all"])
def test_a_washer_at_rest_cools_as_the_exponential_of_its_matrix(conduction):
    """At rest and at one load the gaps stay: what remains is linear."""
    w = Washer(replace(DRY, body_storage="lumped", conduction=conduction))
    assert w.go(1e-3, load=900.0) == 0
    assert w.go(1e-9, load=900.0, speed=0.0) == 0
    start = w.rises()
    conductances, capacities = matrices(w)
    exact = expm(-conductances / capacities[:, None]) @ start
    assert w.go(1.0, load=900.0, speed=0.0) == 0
    assert np.abs(w.rises() - exact).max() < 0.02 + 2e-3 * start.max()
    assert exact.max() < 0.9 * start.max()


@pytest.mark.parametrize("params", [IN_TIME, DRY, replace(DRY, conduction="all")])
def test_substeps_are_of_second_order(params):
    """Warming up from cold; equal steps too short to be cut."""
    ends = []
    for n in (8, 16, 128):
        w = Washer(replace(params, thermal_start="oil"))
        for _ in range(n):
            w.state[L.S_SUBSTEP] = 1.0
            assert w.go(0.02 / n) == 0
        ends.append(w.rises())
    errors = [np.abs(e - ends[-1]).max() for e in ends[:-1]]
    assert errors[0] > 1e-4
    assert 3.2 < errors[0] / errors[1] < 5.0


def test_near_rest_few_substeps_are_as_good_as_many():
    """Each step begins with a jump of the speed; the fine one is cut in 32."""
    coarse, fine, iterations = Washer(), Washer(), 0.0
    assert coarse.go(1e-6, load=500.0, speed=50.0) == 0
    assert fine.go(1e-6, load=500.0, speed=50.0) == 0
    for speed in np.geomspace(46.0, 10.0, 8):
        assert coarse.go(0.01, load=500.0, speed=speed) == 0
        iterations += coarse.work[L.ITERATIONS]
        for _ in range(32):
            assert fine.go(0.01 / 32, load=500.0, speed=speed) == 0
        allowed = 0.02 + 2e-3 * fine.rises().max()
        assert np.abs(coarse.rises() - fine.rises()).max() < allowed
        assert coarse.out[TORQUE] == pytest.approx(fine.out[TORQUE], rel=1e-5)
    assert iterations < 320


def test_oil_that_becomes_hot_at_once_leaves_each_node_within_its_tolerance():
    """A jump of 40 K, whose first step is the one that an estimate misjudges most."""
    coarse, fine = Washer(grid=(10, 32)), Washer(grid=(10, 32))
    for washer in (coarse, fine):
        assert washer.go(1e-6, load=85.0, speed=294.0) == 0
    hot = OIL + 40.0
    for _ in range(3):
        assert coarse.go(0.1, load=85.0, speed=294.0, oil=hot) == 0
        for _ in range(64):
            assert fine.go(0.1 / 64, load=85.0, speed=294.0, oil=hot) == 0
        allowed = 0.02 + 2e-3 * np.abs(fine.rises()).max()
        assert np.abs(coarse.rises() - fine.rises()).max() < 0.5 * allowed


@pytest.mark.parametrize(
    "params",
    [
        IN_TIME,
        replace(IN_TIME, thermal_mode="quasi_steady"),
        replace(DRY, thermal_start="oil"),
        replace(IN_TIME, gear_far_face="insulated"),
        replace(IN_TIME, gear_far_face="bulk"),
    ],
)
def test_energy_is_what_is_stored_and_all_that_reached_the_oil(params):
    """While load, speed and oil change, in steps of any length."""
    w, sent, by_rule = Washer(params), 0.0, 0.0
    assert w.go(1e-6) == 0
    first, last = w.out[L.O_OIL_HEAT] * 1e-6, w.leaving()
    for i in range(200):
        h = (1e-3, 2e-4, 5e-3)[i % 3]
        assert w.go(h, load=300.0 + 5.0 * i, speed=545.0 - i, oil=OIL + 0.01 * i) == 0
        sent += w.out[L.O_OIL_HEAT] * h
        by_rule += 0.5 * (last + w.leaving()) * h
        last = w.leaving()
    assert w.out[L.O_ENERGY] == pytest.approx(w.out[L.O_STORED_HEAT] + sent + first, rel=1e-12)
    assert w.out[L.O_OIL_ENERGY] == w.out[L.O_ENERGY] - w.out[L.O_STORED_HEAT]
    assert sent == pytest.approx(by_rule, rel=0.02)


@pytest.mark.parametrize("params", [IN_TIME, DRY])
@pytest.mark.parametrize(("load", "speed"), [(300.0, 545.0), (900.0, 545.0), (200.0, -1367.0)])
def test_the_steady_state_is_the_limit_of_long_steps(params, load, speed):
    w = Washer(params)
    assert w.go(1e-3, load=200.0, speed=speed) == 0
    for _ in range(4):
        assert w.go(1e3, load=load, speed=speed) == 0
    s = steady(params, load=load, speed=speed)
    assert w.out[TORQUE] == pytest.approx(s.friction_torque, rel=1e-4)
    assert w.out[MEAN] == pytest.approx(s.temperature, abs=0.01)
    assert w.out[L.O_OIL_HEAT] == pytest.approx(w.out[POWER], rel=1e-4)
    assert bool(w.iout[1]) == s.distress


def test_it_starts_steady_or_as_cold_as_the_oil():
    warm, cold = Washer(), Washer(replace(IN_TIME, thermal_start="oil"))
    assert warm.go(1e-6) == 0 and cold.go(1e-6) == 0
    assert warm.out[MEAN] == pytest.approx(steady().temperature, abs=1e-3)
    assert warm.out[L.O_OIL_HEAT] == pytest.approx(warm.out[POWER], rel=1e-3)
    assert cold.out[MEAN] == pytest.approx(OIL, abs=1e-2)
    assert cold.out[TORQUE] > warm.out[TORQUE]  # cold oil is thicker


@pytest.mark.slow
def test_a_lost_film_takes_its_time():
    """300 -> 1200 N at 545 rad/s: an independent solution, extrapolated over its meshes."""
    reached = {}
    for storage in ("slab", "lumped"):
        w = Washer(replace(DRY, body_storage=storage), grid=(19, 64))
        assert w.go(1e-3) == 0
        assert w.go(0.0, load=1200.0) == 0
        at, last = {}, w.out[RATIO]
        assert last == pytest.approx(2.07, rel=0.01)
        now, h = 0.0, 4e-3 if storage == "slab" else 0.02
        while 1.0 not in at:
            assert w.go(h, load=1200.0) == 0
            now += h
            for level in (1.5, 1.0):
                if last > level >= w.out[RATIO]:
                    at[level] = now - h * (level - w.out[RATIO]) / (last - w.out[RATIO])
            last = w.out[RATIO]
        reached[storage] = at
    assert reached["slab"][1.5] == pytest.approx(0.097, rel=0.03)
    assert reached["slab"][1.0] == pytest.approx(0.2325, rel=0.03)
    assert reached["lumped"][1.0] == pytest.approx(1.26, rel=0.03)


@pytest.mark.parametrize(
    ("load", "speed"), [(1200.0, 545.0), (1500.0, 1000.0), (1361.0, 136.0), (900.0, 90.0)]
)
def test_a_lost_film_knows_if_its_steady_curve_has_folds(load, speed):
    washer = Follower(IN_TIME, (10, 32))
    for force, duration in ((300.0, 1e-12), (load, 0.5), (load, 0.5)):
        assert washer._step(np.array([force, speed, 2e-3, OIL, 0.0]), duration) == 0
    folds = load_curve(WasherParams(), speed=speed, tilt=2e-3).folds
    assert washer.state[L.S_MULTIPLICITY] == (L.MULTIPLE if folds else L.SINGLE)
    if speed == 545.0:  # the curve is followed to its first fold, no further: else 118 iterations
        assert washer.work[L.ITERATIONS] <= 110.0


def test_a_look_without_time_moves_no_temperature_and_no_memory():
    w = Washer()
    assert w.go(1e-3) == 0
    mean, kept = w.out[MEAN], w.state.copy()
    assert w.go(0.0, load=600.0) == 0
    assert w.out[MEAN] == pytest.approx(mean, abs=1e-2)
    assert w.out[RATIO] < steady(load=300.0).film_ratio
    assert (w.state == kept).all()


@pytest.mark.parametrize("params", [IN_TIME, DRY, replace(IN_TIME, conduction="rotating")])
def test_it_goes_through_whatever_comes(params):
    rng, w = np.random.default_rng(7), Washer(params)
    inputs = [300.0, 545.0, 2e-3, OIL]
    for _ in range(80):
        place = rng.integers(4)
        inputs[place] = (
            10.0 ** rng.uniform(0.0, 3.4),
            rng.choice((0.0, 1e-3, 50.0, 545.0, -545.0, 1300.0)),
            rng.choice((0.0, 1e-4, 1e-3, 4e-3)),
            rng.uniform(260.0, 400.0),
        )[place]
        assert w.go(10.0 ** rng.uniform(-5.0, 0.5), *inputs) == 0, inputs
        kept = w.taken() - ladder.far_heat(w.m, w.fields())
        flow = max(np.abs(w.fields().flux).max() * 1e-3, w.out[POWER])
        assert w.out[POWER] - w.leaving() == pytest.approx(kept, abs=1e-4 * flow)


@pytest.mark.parametrize("h", [0.0, 1e-4, 1e3])
@pytest.mark.parametrize("params", [IN_TIME, DRY])
@pytest.mark.parametrize("place", range(4))
def test_directional_derivatives_are_slopes_over_a_short_or_long_step(place, params, h):
    inputs = [700.0, 545.0, 2e-3, OIL]
    base = Washer(params)
    assert base.go(1e-3, *inputs) == 0
    kept = base.state.copy()

    def outputs(shift):
        w = Washer(params)
        w.state[:] = kept
        at = list(inputs)
        at[place] += shift
        assert w.go(h, *at) == 0
        return w, w.out.copy()

    size = (0.6, 0.5, 1e-5, 0.3)[place]
    w, _ = outputs(0.0)
    seed, slope = np.zeros(4), np.zeros(k.NOUT)
    seed[place] = 1.0
    assert k.sens(w.par, np.array(inputs), w.state, w.work, seed, slope) == 0
    difference = (outputs(size)[1] - outputs(-size)[1]) / (2.0 * size)
    scale = np.array((1.0, 10.0, 1e-6, 1.0, 100.0)) * 1e-6 / size  # [N m, K, m, 1, W]
    for i, least in zip(
        (TORQUE, MEAN, L.O_FILM, L.O_FLUID_SHARE, L.O_OIL_HEAT), scale, strict=True
    ):
        assert slope[i] == pytest.approx(difference[i], rel=3e-2, abs=least), i
