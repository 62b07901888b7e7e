"""The washer behind the step ABI: what may change, what must not, and what survives."""

import numpy as np

from thrustwasher import solve_washer
from thrustwasher.errors import Status
from thrustwasher.model.parameters import as_numbers
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels import step as kernel
from thrustwasher.washer.kernels.regime_and_status import BOUNDARY, FILM
from thrustwasher.washer.parameters import WasherParams


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
