"""The washer behind the step ABI: what may change, what must not, and what survives."""

import numpy as np
import pytest

from thrustwasher import solve_washer
from thrustwasher.errors import Status
from thrustwasher.model.parameters import as_numbers
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels import step as kernel
from thrustwasher.washer.kernels.regime_and_status import BOUNDARY, FILM
from thrustwasher.washer.parameters import WasherParams

BASE = np.array([300.0, 545.0, 0.002, 297.15, 0.0])


def parameters(fidelity=float(L.FIELD)):
    par = np.zeros(kernel.NPAR)
    par[: kernel.N_PARAM] = [*as_numbers(WasherParams()), fidelity]
    assert kernel.derive(par) == Status.OK
    return par


PAR = parameters()


class Instance:
    """One washer with its own memory."""

    def __init__(self, state=None, work=0.0):
        self.state = np.zeros(kernel.NSTATE) if state is None else state.copy()
        self.work = np.full(kernel.NWORK, work)

    def step(self, inputs, dt=1e-3):
        out, iout = np.full(kernel.NOUT, np.nan), np.full(kernel.NIOUT, -7, np.int32)
        status = kernel.step(PAR, inputs, self.state, self.work, out, iout, 0.0, dt)
        return status, out, iout


def ramp(k, seed=1):
    """Return inputs that wander over both branches, through standstill and back."""
    rng = np.random.default_rng(seed + k)
    load = [250.0, 800.0, 1100.0, 800.0, 300.0, 20.0][k // 4 % 6] * rng.uniform(0.97, 1.03)
    speed = 545.0 * np.cos(0.05 * k) * rng.uniform(0.99, 1.01)
    tilt, oil = 0.002 * rng.uniform(0.98, 1.02), 297.15 + rng.uniform(-1, 1)
    return np.array([load, speed, tilt, oil, 0.0])


def test_a_look_leaves_the_state_to_the_bit():
    """dt = 0 from nothing, after a solution, and on another branch."""
    washer = Instance()
    for inputs in (BASE, BASE * [3.8, 1, 1, 1, 1], BASE * [0.5, -1, 1, 1, 1]):
        before = washer.state.copy()
        status, out, _ = washer.step(inputs, dt=0.0)
        assert status == Status.OK and np.all(np.isfinite(out))
        assert washer.state.tobytes() == before.tobytes()
        washer.step(inputs)
        assert washer.state.tobytes() != before.tobytes()


@pytest.mark.parametrize("rubbish", [np.nan, np.inf, 1e300, -1.0])
def test_what_work_holds_does_not_matter(rubbish):
    clean, dirty = Instance(), Instance()
    for k in range(12):
        dirty.work[:] = rubbish
        (s1, out1, iout1), (s2, out2, iout2) = clean.step(ramp(k)), dirty.step(ramp(k))
        assert s1 == s2
        assert out1.tobytes() == out2.tobytes() and iout1.tobytes() == iout2.tobytes()
        assert clean.state.tobytes() == dirty.state.tobytes()


def test_work_of_another_washer_does_not_matter():
    """Two washers take turns on one work array; each goes on as if alone."""
    alone = [Instance(), Instance()]
    shared = [Instance(), Instance()]
    shared[1].work = shared[0].work
    for k in range(12):
        for i in range(2):
            expected = alone[i].step(ramp(k, seed=50 * i))[1]
            assert shared[i].step(ramp(k, seed=50 * i))[1].tobytes() == expected.tobytes()


def test_a_saved_state_goes_on_bit_equal_over_twenty_steps():
    washer = Instance()
    for k in range(5):
        washer.step(ramp(k))
    copy = Instance(washer.state, work=np.nan)
    for k in range(5, 25):
        expected, found = washer.step(ramp(k)), copy.step(ramp(k))
        assert expected[0] == found[0]
        assert expected[1].tobytes() == found[1].tobytes()
        assert expected[2].tobytes() == found[2].tobytes()
    assert washer.state.tobytes() == copy.state.tobytes()


def test_looks_in_between_do_not_change_what_follows():
    quiet, looked_at = Instance(), Instance()
    for k in range(16):
        expected = quiet.step(ramp(k))[1]
        looked_at.step(ramp(k + 3), dt=0.0)
        found = looked_at.step(ramp(k))[1]
        looked_at.step(ramp(k), dt=0.0)
        assert expected.tobytes() == found.tobytes()


def test_a_look_at_the_same_inputs_agrees_with_the_step():
    washer = Instance()
    out = washer.step(BASE)[1]
    np.testing.assert_allclose(washer.step(BASE, dt=0.0)[1], out, rtol=1e-6)


@pytest.mark.parametrize("place", range(4))
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_bad_input_changes_nothing(place, value):
    washer = Instance()
    washer.step(BASE)
    before, inputs = washer.state.copy(), BASE.copy()
    inputs[place] = value
    status, _, iout = washer.step(inputs)
    assert status == Status.BAD_INPUT == iout[L.IO_STATUS]
    assert washer.state.tobytes() == before.tobytes()
    assert washer.step(BASE)[0] == Status.OK


@pytest.mark.parametrize("load", [0.0, -50.0, 0.3, 1.0])
def test_an_unloaded_washer_counts_as_loaded_one_newton(load):
    washer, light = Instance(), Instance()
    inputs, one = BASE.copy(), BASE.copy()
    inputs[0], one[0] = load, 1.0
    status, out, _ = washer.step(inputs)
    assert status == Status.OK
    assert out.tobytes() == light.step(one)[1].tobytes()


def test_distress_and_regime_are_told():
    """Past the fold: distress; back below the lower one: none."""
    washer = Instance()
    told = []
    for load in (300.0, 800.0, 1100.0, 800.0, 500.0):
        _, _, iout = washer.step(np.array([load, 545.0, 0.002, 297.15, 0.0]))
        told.append((int(iout[L.IO_REGIME]), int(iout[L.IO_STATUS])))
    film, boundary = (FILM, Status.OK), (BOUNDARY, Status.DISTRESS)
    assert told[0] == film and told[1] == film and told[2] == boundary and told[3] == boundary
    assert told[4] == film


def test_a_spot_above_250_degc_is_hot_unless_the_film_is_lost():
    """On a single-valued curve; the result in Python has the same status."""
    _, out, iout = Instance().step(np.array([1400.0, 300.0, 0.0012, 400.0, 0.0]))
    assert out[L.O_PEAK] > L.HOT_LIMIT and not iout[L.IO_DISTRESS]
    assert iout[L.IO_STATUS] == Status.HOT
    point = {"load": 1400.0, "speed": 300.0, "tilt": 0.0012, "oil_temperature": 400.0}
    r = solve_washer(WasherParams(), **point)
    assert r.status is Status.HOT and r.temperature_max > L.HOT_LIMIT
    assert Status.HOT.advice in " ".join(r.warnings)


def test_outside_the_verified_range_is_told():
    status, _, iout = Instance().step(np.array([5000.0, 545.0, 0.002, 297.15, 0.0]))
    assert status == Status.OK
    assert iout[L.IO_STATUS] in (Status.OUTSIDE_VERIFIED, Status.DISTRESS)
    _, _, iout = Instance().step(np.array([100.0, 545.0, 0.002, 250.0, 0.0]))
    assert iout[L.IO_STATUS] == Status.OUTSIDE_VERIFIED
