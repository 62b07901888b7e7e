"""Points and runs of the washer that the stability tests share."""

import math

import numpy as np

from thrustwasher import WasherParams, solve_washer
from thrustwasher.errors import Status
from thrustwasher.model.parameters import as_numbers
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels import step as kernel


def solve(load=300.0, speed=545.0, tilt=0.002, **more):
    return solve_washer(WasherParams(), load=load, speed=speed, tilt=tilt, **more)


def followed(points, start=None):
    """Solve a list of points (dicts), each from the one before."""
    results = []
    for point in points:
        start = solve(**point, start=start)
        results.append(start)
    return results


def stepped(loads):
    """Return (status, torque) of one instance's steps of 1 ms under loads, one after the other."""
    par = np.zeros(kernel.NPAR)
    par[: kernel.N_PARAM] = [*as_numbers(WasherParams()), L.FIELD]
    assert kernel.derive(par) == Status.OK
    state, work = np.zeros(kernel.NSTATE), np.zeros(kernel.NWORK)
    out, iout = np.zeros(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)
    found = []
    for load in loads:
        inp = np.array([load, 545.0, 0.002, 297.15, 0.0])
        status = kernel.step(par, inp, state, work, out, iout, 0.0, 1e-3)
        found.append((status, float(out[0])))
    return found


def is_sound(r):
    """Tell if a result is a solution that obeys what every solution must."""
    numbers = (r.friction_torque, r.temperature, r.temperature_max, r.film_thickness, r.fluid_load)
    return (
        not r.status.is_failure
        and all(math.isfinite(x) for x in numbers)
        and r.friction_torque * r.speed >= 0.0
        and r.temperature_max >= r.temperature >= r.oil_temperature - 1e-9
        and abs(r.fluid_load + r.contact_load - r.load) <= 1e-5 * r.load
    )
