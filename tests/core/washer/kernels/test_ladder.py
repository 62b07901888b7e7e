"""Heat through the thickness of a body: against the series of a slab, balances, limits."""

from dataclasses import dataclass

import numpy as np
import pytest

from thrustwasher.model.parameters import as_numbers
from thrustwasher.washer.kernels import ladder
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.constants import derive_grid, size_of_par, washer_model
from thrustwasher.washer.kernels.workspace import (
    Point,
    Workspace,
    fields_of,
    size_of_work,
    workspace_of,
)
from thrustwasher.washer.parameters import WasherParams

GRID = (6, 8)
HERE = Point(300.0, 545.0, 2e-3, 297.15, 297.15)  # all as warm as the oil outside
FLUX = 1e5
ODD = np.arange(1, 2001, 2)
RATES = (0.5 * np.pi * ODD) ** 2
SIGNS = np.where(ODD % 4 == 1, 1.0, -1.0)


@dataclass
class Bodies:
    w: Workspace

    @property
    def m(self):
        return washer_model(self.w.par)

    @property
    def f(self):
        return fields_of(self.w)

    @property
    def carrier(self):
        return slice(self.m.carrier_at, self.m.carrier_at + self.m.n_r)

    def go(self, dt, first=FLUX, last=FLUX):
        """Bring all bodies through ``dt`` with a flux that is linear in time."""
        f = self.f
        f.begin[:] = f.temp
        ladder.set_stage(self.w, HERE, dt)
        self.heat(first + ladder.STAGE * (last - first))
        ladder.set_end(self.w, HERE, dt)
        self.heat(last)
        ladder.advance_terms(self.w, dt)

    def heat(self, flux):
        m, f = self.m, self.f
        for at, step, n, out in (
            (m.carrier_at, m.carrier_step, m.n_r, L.OUT_CARRIER),
            (m.washer_at, m.washer_step, m.n_r, L.OUT_WASHER),
            (m.gear_at, m.gear_step, m.n_r - m.i_g, L.OUT_GEAR),
        ):
            for j in range(m.n_t if step else 1):
                part = slice(at + j * step, at + j * step + n)
                f.temp[part] = f.outward[part] + flux / f.small[out]

    def areas(self):
        """Return the areas of film 1 and gap 2 [m^2]."""
        m = self.m
        return 2.0 * np.pi * np.sum(m.weight1), 2.0 * np.pi * np.sum(m.weight2)

    def rise(self):
        """Return the steady rise of the carrier's face [K]."""
        return FLUX * self.m.carrier_thickness / self.m.carrier_conductivity


def bodies(**changes):
    par = np.zeros(size_of_par(*GRID))
    par[: L.N_PARAM] = [*as_numbers(WasherParams(**changes)), L.FIELD]
    assert derive_grid(par, *GRID) == 0
    return Bodies(workspace_of(par, np.zeros(L.N_HEAD + size_of_work(*GRID))))


def number(seconds, m):
    """Return the Fourier number of the carrier."""
    p = WasherParams()
    return seconds * m.carrier_conductivity / (p.density * p.specific_heat) / p.carrier_thickness**2


def heated(fourier):
    """Return the rise of a slab's heated face over its steady one."""
    return 1.0 - np.sum(8.0 / (np.pi * ODD) ** 2 * np.exp(-RATES * fourier))


def remaining(fourier):
    """Return what a slab's face keeps of a uniform rise over its far face."""
    return np.sum(4.0 / (np.pi * ODD) * SIGNS * np.exp(-RATES * fourier))


@pytest.mark.parametrize("steps", [(0.05,), (1e-4, 0.02, 0.0299), (0.01,) * 5])
def test_a_face_warms_as_that_of_a_slab(steps):
    b = bodies()
    now = 0.0
    for h in (*steps, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0):
        b.go(h)
        now += h
        if now > 0.0499:
            exact = b.rise() * heated(number(now, b.m))
            assert b.f.temp[b.carrier] == pytest.approx(exact, rel=5e-3)


def test_it_is_exact_for_a_flux_that_is_linear():
    one, many = bodies(), bodies()
    one.go(0.4, 0.0)
    for k in range(8):
        many.go(0.05, FLUX * k / 8.0, FLUX * (k + 1) / 8.0)
    assert one.f.ladder == pytest.approx(many.f.ladder, rel=1e-12)
    assert one.f.temp[one.carrier] == pytest.approx(many.f.temp[one.carrier], rel=1e-12)


@pytest.mark.parametrize("storage", ["slab", "lumped"])
def test_what_is_not_stored_leaves_through_the_far_faces(storage):
    b = bodies(body_storage=storage)
    for h in (1e-3, 0.2, 2.0):
        b.go(h)
        one, two = b.areas()
        far = ladder.far_heat(b.m, b.f)
        before = b.f.ladder.copy()
        for body in (ladder.body_of(b.m, L.OF_CARRIER), ladder.body_of(b.m, L.OF_GEAR)):
            for k in range(L.N_TERMS):
                t = ladder.term(body, k)
                for j in range(body.columns):
                    at = body.at + j * body.step
                    part = slice(at + body.first, at + b.m.n_r)
                    b.f.ladder[k, part] = (t.resistance * FLUX - before[k, part]) / t.time
        kept = b.f.temp.copy()
        b.f.temp[:] = 0.0
        assert FLUX * (one + two) - ladder.stored_heat(b.w) == pytest.approx(far, rel=1e-12)
        b.f.temp[:] = kept
        b.f.ladder[:] = before


def test_heat_stored_is_that_of_a_slab_but_for_a_few_percent():
    b = bodies()
    p, now = WasherParams(), 0.0
    for h in (0.05, 0.05, 0.2, 0.7, 2.0, 10.0):
        b.go(h)
        now += h
        left = np.sum(4.0 / (np.pi * ODD) * SIGNS / RATES * np.exp(-RATES * number(now, b.m)))
        slab = p.density * p.specific_heat * p.carrier_thickness * b.rise() * (0.5 - left)
        one, _ = b.areas()
        _, stored = ladder._through(b.m, ladder.body_of(b.m, L.OF_CARRIER), b.f)
        assert stored / one == pytest.approx(slab, rel=0.065 if now < 10.0 else 5e-3)


def test_a_lumped_body_follows_the_exponential_of_its_time():
    b = bodies(body_storage="lumped")
    for h in (0.5, 1.0, 1.5):
        b.go(h)
    exact = b.rise() * -np.expm1(-number(3.0, b.m))
    assert b.f.temp[b.carrier] == pytest.approx(exact, rel=1e-12)
    p = WasherParams()
    _, stored = ladder._through(b.m, ladder.body_of(b.m, L.OF_CARRIER), b.f)
    heat = p.density * p.specific_heat * p.carrier_thickness * exact * b.areas()[0]
    assert stored == pytest.approx(heat, rel=1e-12)


def test_a_face_follows_warmer_oil_as_that_of_a_slab():
    b = bodies()
    ladder.shift_terms(b.w, 10.0, 10.0)
    assert b.f.temp[b.carrier] == pytest.approx(-10.0)
    assert b.f.ladder[:, b.carrier].sum(axis=0) == pytest.approx(-10.0, rel=1e-12)
    now = 0.0
    for h in (0.05, 0.2, 0.5, 1.0, 3.0):
        b.go(h, 0.0, 0.0)
        now += h
        loose = 0.8 if now < 0.5 else 0.25
        exact = -10.0 * remaining(number(now, b.m))
        assert b.f.temp[b.carrier] == pytest.approx(exact, abs=loose)


def test_the_washer_stores_all_it_takes():
    b = bodies()
    p = WasherParams()
    for h in (1e-6, 1e-2, 1.0):
        before = b.f.temp[b.m.washer_at]
        b.go(h, 0.0)
        gain = 0.5 * FLUX * h / (p.density * p.specific_heat * p.washer_thickness)
        assert b.f.temp[b.m.washer_at] - before == pytest.approx(gain, rel=1e-9)


def test_a_change_that_lasts_for_a_long_step_is_a_steady_one():
    b = bodies()
    ladder.set_held(b.w, 1e4)
    steady = b.m.carrier_conductivity / b.m.carrier_thickness
    assert b.f.small[L.OUT_CARRIER] == pytest.approx(steady, rel=1e-3)
    assert b.f.small[L.OUT_OIL] == pytest.approx(0.0, abs=1e-12)
    ladder.set_held(b.w, 1e-6)
    assert b.f.small[L.OUT_OIL : L.OUT_OIL + 3] == pytest.approx(1.0, abs=1e-3)


# A gear whose far face is insulated: all heat stays in it.
WHOLE = np.arange(1, 2001)


def kept(fourier):
    """Return the rise of an insulated slab's heated face over flux x thickness/conductivity."""
    shape = np.exp(-((np.pi * WHOLE) ** 2) * fourier) / WHOLE**2
    return fourier + 1.0 / 3.0 - 2.0 / np.pi**2 * np.sum(shape)


def gear(b):
    return slice(b.m.gear_at, b.m.gear_at + b.m.n_r - b.m.i_g)


@pytest.mark.parametrize("steps", [(0.062,), (1e-4, 0.02, 0.0419), (0.0124,) * 5])
def test_the_face_of_an_insulated_slab_warms_as_the_series_says(steps):
    b = bodies(gear_far_face="insulated")
    now, per_flux = 0.0, b.m.gear_thickness / b.m.gear_conductivity
    for h in (*steps, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 300.0):
        b.go(h)
        now += h
        if number(now, b.m) > 0.01:
            exact = FLUX * per_flux * kept(number(now, b.m))
            assert b.f.temp[gear(b)] == pytest.approx(exact, rel=1.5e-3)


@pytest.mark.parametrize("storage", ["slab", "lumped"])
def test_an_insulated_body_stores_all_that_enters(storage):
    b, entered = bodies(gear_far_face="insulated", body_storage=storage), 0.0
    body = ladder.body_of(b.m, L.OF_GEAR)
    for h, first, last in ((1e-3, FLUX, FLUX), (0.2, 0.0, FLUX), (2.0, FLUX, -FLUX / 2)):
        b.go(h, first, last)
        entered += 0.5 * h * (first + last) * b.areas()[1]
        flow, stored = ladder._through(b.m, body, b.f)
        assert flow == 0.0
        assert stored == pytest.approx(entered, rel=1e-12)


def test_an_insulated_body_stays_as_warm_when_the_oil_warms_up():
    b = bodies(gear_far_face="insulated")
    b.go(1.0)
    before = b.f.temp[gear(b)].copy()
    ladder.shift_terms(b.w, 10.0, 10.0)
    b.go(0.5, 0.0, 0.0)
    mean = b.f.ladder[0, gear(b)]
    warmed = FLUX * 1.0 / ladder.body_of(b.m, L.OF_GEAR).storage
    assert mean == pytest.approx(warmed - 10.0, rel=1e-12)
    assert np.all(b.f.temp[gear(b)] < before - 10.0)  # heat goes on into the body's depth
