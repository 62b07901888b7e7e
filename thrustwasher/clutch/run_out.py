"""An engagement in which the slip of an inertia runs out: the load is given."""

from typing import Any, NamedTuple

import numpy as np

from ..errors import SolveError, Status
from ..numerics.jit import Array
from .kernels import advance as clutch_advance
from .kernels import layout as k
from .kernels import pack_outputs, rates


class RunOut(NamedTuple):
    """Points of an engagement, and the real outputs at each, (n, NOUT)."""

    time: Array
    speed: Array
    rows: Array
    locked: bool
    """Whether the slip came to an end."""


def run_out(
    par: Any,
    *,
    load: float,
    speed: float,
    inertia: float,
    ramp: float,
    longest: float,
    step: float,
    oil_temperature: float,
    drum_speed: float = 0.0,
) -> RunOut:
    """Return an engagement of a pack whose slip is that of an inertia, until it has run out.

    Parameters
    ----------
    par : of the kernel, as ``solve.prepare`` returns it
    load : axial force [N] that is reached in ``ramp`` [s], straight from 0
    speed : slip [rad/s] at the start, above 0
    inertia : [kg.m2] that the slip sees, above 0
    longest : time [s] after which it ends, locked or not
    step : distance of points [s]; the last one is where the slip ends
    oil_temperature : [K]; the steel is as warm at the start
    drum_speed : [rad/s], constant

    SolveError : an interval could not be integrated

    Notes
    -----
    inertia x d(speed)/dt = -torque, by the two-step rule of Adams and Bashforth, second order in
    ``step``. Without another drive the heat is inertia x speed^2 / 2.
    """
    work, out = np.zeros(k.NWORK), np.zeros(k.NOUT)
    status = clutch_advance.load_memory(par, 0.0, oil_temperature, np.zeros(k.NSTATE), work)
    force = load if ramp == 0.0 else 0.0
    if status == Status.OK and not rates.moves_film(par):
        work[k.W_NOW + k.Y_FILM] = 1.0
        status = clutch_advance.settle_film(par, force, work)
    faces, now, slip, locked = par[k.P_FACES], 0.0, speed, False
    times, slips, rows = [0.0], [speed], list[Array]()
    before, earlier = 0.0, 0.0  # torque of the point before, and how far that is
    while True:
        if Status(status).is_failure:
            raise SolveError(
                f"t = {now:g} s, load = {force:g} N, speed = {slip:g} rad/s: "
                f"{Status(status).advice}"
            )
        pack_outputs.fill_outputs(par, force, slip, drum_speed, work, out)
        out[k.O_TEMPERATURE], _ = pack_outputs.mean_surface(par, work)
        out[k.O_ENERGY] = faces * work[k.W_NOW + k.Y_ENERGY]
        rows.append(out.copy())
        if locked or now >= longest:
            return RunOut(np.array(times), np.array(slips), np.array(rows), locked)
        torque = abs(out[k.O_TORQUE])
        length = min(step, longest - now)
        if ramp - now > 1e-9 * ramp:  # a point where the ramp ends
            length = min(length, ramp - now)
        mean = torque
        if earlier:
            mean += 0.5 * length / earlier * (torque - before)
        end = slip - max(mean, 0.0) * length / inertia
        if locked := end <= 0.0:
            end, length = 0.0, slip * inertia / mean
        then = now + length
        if longest - then < 1e-9 * longest:
            then = longest
        after = load * min(then / ramp, 1.0) if ramp > 0.0 else load
        ends = (force, slip, oil_temperature, after, end, oil_temperature, drum_speed, drum_speed)
        status = clutch_advance.advance(
            par, ends, length, out[k.O_POWER] / faces, work[k.W_PROPOSED], work
        )
        before, earlier, now, force, slip = torque, length, then, after, end
        times.append(now)
        slips.append(slip)
