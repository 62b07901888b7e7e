"""A washer whose bodies store heat: against exponentials, limits, balances and differences."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from thrustwasher import WasherParams, solve_washer
from thrustwasher.errors import Status
from thrustwasher.model.parameters import as_numbers
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels import step as k
from thrustwasher.washer.kernels.constants import washer_model
from thrustwasher.washer.kernels.heat import conduct, store
from thrustwasher.washer.kernels.workspace import (
    fields_of,
    size_of_state,
    size_of_work,
    workspace_of,
)

GRID = (5, 8)
OIL = 297.15
IN_TIME = WasherParams(thermal_mode="transient")
TORQUE, MEAN, FILM, TOP, RATIO, SHARE, _, POWER = range(k.NOUT)


class Washer:
    """The kernel with its arrays."""

    def __init__(self, params=IN_TIME, grid=GRID):
        self.par = constants(params, grid, "field", True).copy()
        numbers = as_numbers(params)
        self.par[: len(numbers)] = numbers
        self.m = washer_model(self.par)
        self.state = np.zeros(size_of_state(*grid))
        self.work = np.zeros(L.N_HEAD + size_of_work(*grid))
        self.out, self.iout = np.zeros(k.NOUT), np.zeros(3, np.int32)

    def go(self, dt, load=300.0, speed=545.0, tilt=2e-3, oil=OIL):
        inp = np.array((load, speed, tilt, oil))
        return k.step(self.par, inp, self.state, self.work, self.out, self.iout, 0.0, dt)

    def fields(self):
        return fields_of(workspace_of(self.par, self.work))

    def rises(self):
        n_temp = self.m.n_t * (3 * self.m.n_r - self.m.i_g)
        return self.state[L.S_FIELDS :][:n_temp].copy()


def steady(load=300.0, speed=545.0, tilt=2e-3, oil=OIL, grid=GRID):
    return solve_washer(WasherParams(), load=load, speed=speed, tilt=tilt, oil_temperature=oil,
                        grid=grid)  # fmt: skip


def matrices(w):
    """Return the conductances [W/K] and capacities [J/K] of the present gaps."""
    f, n = w.fields(), w.rises().size
    conductances, capacities = np.empty((n, n)), np.empty(n)
    for i in range(n):
        unit, heat = np.zeros(n), np.zeros(n)
        unit[i] = 1.0
        conduct(w.m, unit, f, heat)
        conductances[:, i] = heat
        before, f.small[L.RATE] = f.small[L.RATE], 1.0
        heat[:] = 0.0
        store(w.m, unit, np.zeros(n), 0.0, f, heat)
        f.small[L.RATE] = before
        capacities[i] = heat[i]
    return conductances, capacities


def test_capacities_are_those_of_three_annuli():
    w = Washer()
    assert w.go(1e-3) == 0
    _, capacities = matrices(w)
    p = WasherParams()
    outer = np.pi * (p.outer_radius**2 - p.inner_radius**2)
    gear = np.pi * (p.outer_radius**2 - p.gear_inner_radius**2)
    volume = outer * (p.carrier_thickness + p.washer_thickness) + gear * p.gear_thickness
    assert capacities.sum() == pytest.approx(volume * p.density * p.specific_heat, rel=1e-12)


def test_a_washer_at_rest_cools_as_the_exponential_of_its_matrix():
    """At rest and at one load the gaps stay: what remains is linear."""
    w = Washer()
    assert w.go(1e-3, load=900.0) == 0
    assert w.go(1e-9, load=900.0, speed=0.0) == 0
    start = w.rises()
    conductances, capacities = matrices(w)
    exact = expm(-conductances / capacities[:, None]) @ start
    assert w.go(1.0, load=900.0, speed=0.0) == 0
    assert np.abs(w.rises() - exact).max() < 0.02 + 2e-3 * start.max()
    assert exact.max() < 0.9 * start.max()


def test_substeps_are_of_second_order():
    """Warming up from cold; equal steps too short to be cut."""
    ends = []
    for n in (4, 8, 16, 64):
        w = Washer(replace(IN_TIME, thermal_start="oil"))
        for _ in range(n):
            w.state[L.S_SUBSTEP] = 1.0
            assert w.go(0.02 / n) == 0
        ends.append(w.rises())
    errors = [np.abs(e - ends[-1]).max() for e in ends[:-1]]
    assert errors[0] > 1e-4
    assert 3.2 < errors[0] / errors[1] < 5.0


def test_heat_made_is_heat_stored_and_heat_lost():
    w = Washer(replace(IN_TIME, thermal_start="oil"))
    assert w.go(1e-6) == 0
    _, capacities = matrices(w)
    made, before, work = w.out[POWER], w.rises(), 0.0
    lost = (matrices(w)[0] @ before).sum()
    h = 2e-3
    for _ in range(25):
        assert w.go(h) == 0
        now, away = w.out[POWER], (matrices(w)[0] @ w.rises()).sum()
        work += 0.5 * h * (made - lost + now - away)
        made, lost = now, away
    stored = capacities @ (w.rises() - before)
    assert stored == pytest.approx(work, rel=2e-3)


@pytest.mark.parametrize(("load", "speed"), [(300.0, 545.0), (900.0, 545.0), (200.0, -1367.0)])
def test_the_steady_state_is_the_limit_of_long_steps(load, speed):
    w = Washer()
    assert w.go(1e-3, load=200.0, speed=speed) == 0
    for _ in range(4):
        assert w.go(1e3, load=load, speed=speed) == 0
    s = steady(load=load, speed=speed)
    assert w.out[TORQUE] == pytest.approx(s.friction_torque, rel=1e-4)
    assert w.out[MEAN] == pytest.approx(s.temperature, abs=0.01)
    assert bool(w.iout[1]) == s.distress


def test_it_starts_steady_or_as_cold_as_the_oil():
    warm, cold = Washer(), Washer(replace(IN_TIME, thermal_start="oil"))
    assert warm.go(1e-6) == 0 and cold.go(1e-6) == 0
    assert warm.out[MEAN] == pytest.approx(steady().temperature, abs=1e-3)
    assert cold.out[MEAN] == pytest.approx(OIL, abs=1e-2)
    assert cold.out[TORQUE] > warm.out[TORQUE]  # cold oil is thicker


def test_a_load_beyond_the_fold_is_borne_until_the_bodies_are_warm():
    w, load = Washer(grid=(8, 20)), 1.3 * 773.0
    assert w.go(1e-3, load=700.0) == 0
    before = w.out[MEAN]
    assert not w.iout[1] and w.go(1e-3, load=load) == 0
    assert not w.iout[1] and w.out[MEAN] < before + 0.5
    assert steady(load=load, grid=(8, 20)).distress
    lost_at, now = None, 0.0
    for _ in range(200):
        assert w.go(0.1, load=load) == 0
        now += 0.1
        if w.iout[1]:
            lost_at = now
            break
    assert lost_at is not None and 0.1 < lost_at < 20.0
    assert w.iout[2] == Status.DISTRESS


def test_a_look_without_time_moves_no_temperature_and_no_memory():
    w = Washer()
    assert w.go(1e-3) == 0
    mean, kept = w.out[MEAN], w.state.copy()
    assert w.go(0.0, load=600.0) == 0
    assert w.out[MEAN] == pytest.approx(mean, abs=1e-2)
    assert w.out[RATIO] < steady(load=300.0).film_ratio
    assert (w.state == kept).all()


def test_bodies_stay_as_warm_as_they_are_when_the_oil_changes():
    w = Washer()
    assert w.go(1e-3) == 0
    mean = w.out[MEAN]
    assert w.go(1e-6, oil=OIL + 40.0) == 0
    assert w.out[MEAN] == pytest.approx(mean, abs=0.1)
    for _ in range(3):
        assert w.go(1e3, oil=OIL + 40.0) == 0
    assert w.out[MEAN] == pytest.approx(steady(oil=OIL + 40.0).temperature, abs=0.01)


def test_results_do_not_depend_on_what_the_work_happens_to_hold():
    one, other = Washer(), Washer()
    for _ in range(3):
        assert one.go(0.01, load=800.0) == 0
    other.state[:] = one.state
    other.work[: L.N_HEAD] = 7.0
    assert one.go(0.01, load=820.0) == 0 and other.go(0.01, load=820.0) == 0
    assert (one.out == other.out).all() and (one.state == other.state).all()


@pytest.mark.parametrize("place", range(4))
def test_directional_derivatives_are_slopes_over_a_short_step(place):
    h, inputs = 1e-4, [600.0, 545.0, 2e-3, OIL]
    base = Washer()
    assert base.go(1e-3, *inputs) == 0
    kept = base.state.copy()

    def outputs(shift):
        w = Washer()
        w.state[:] = kept
        at = list(inputs)
        at[place] += shift
        assert w.go(h, *at) == 0
        return w, w.out.copy()

    size = (0.6, 0.5, 2e-6, 0.3)[place]
    w, _ = outputs(0.0)
    seed, slope = np.zeros(4), np.zeros(k.NOUT)
    seed[place] = 1.0
    assert k.sens(w.par, np.array(inputs), w.state, w.work, seed, slope) == 0
    difference = (outputs(size)[1] - outputs(-size)[1]) / (2.0 * size)
    for i in (TORQUE, FILM, SHARE, MEAN):
        assert slope[i] == pytest.approx(difference[i], rel=1e-2), i
