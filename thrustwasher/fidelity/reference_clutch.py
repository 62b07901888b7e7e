"""Reference values of the wet clutch: more rings, another integrator at tight tolerance."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, SolveError, Status
from ..kernels import clutch_advance, clutch_outputs, clutch_rates
from ..kernels import clutch_layout as k
from ..kernels.clutch_constants import derive_rings
from ..models.clutch import prepare, solve_clutch, steady_pack
from ..models.clutch_params import ClutchParams
from .reference_values import ReferenceValues, extrapolated

Array = NDArray[np.float64]
RINGS = (2, 4, 8)
TOLERANCE = 1e-9


def reference_clutch(
    params: ClutchParams, *, load: float, speed: float, oil_temperature: float = 297.15
) -> ReferenceValues:
    """Return the steady state of a pack that slips, extrapolated over 2, 4 and 8 rings.

    Parameters
    ----------
    params, load [N], speed [rad/s], oil_temperature [K] : as in solve_clutch

    Raises
    ------
    ParameterError : an argument is outside its range
    SolveError : no film or temperature was found
    """
    whole = solve_clutch(params, load=load, speed=speed, oil_temperature=oil_temperature,
                         fidelity="fine")  # fmt: skip
    sign = float(np.sign(speed))
    rows = []
    for n in RINGS:
        par = prepare(params, "fine")
        derive_rings(par, n)
        s = steady_pack(par, load, speed, oil_temperature, whole.film_ratio)
        rows.append({
            "friction_torque": sign * (s.contact + s.viscous), "temperature": s.temperature,
            "contact_torque": sign * s.contact, "viscous_torque": sign * s.viscous,
            "friction_coefficient": s.coefficient, "film_ratio": whole.film_ratio,
            "film_thickness": whole.film_thickness,
        })  # fmt: skip
    values, uncertainty = extrapolated(rows, (2.0, 2.0), 2.0)
    return ReferenceValues(values, uncertainty, ("2, 4, 8 rings, order 2",))


def reference_engagement(
    params: ClutchParams, *, time: Any, load: Any, speed: Any, oil_temperature: float = 297.15
) -> ReferenceValues:
    """Return torque, temperature, film ratio and heat at the end of a course of load and slip.

    Radau's method of order 5 at 1e-9 in place of the package's own integrator, on 2, 4 and 8 rings,
    extrapolated; for a pack with a moving film and without ``contact_rise``.

    Parameters
    ----------
    params : the pack
    time, load, speed : points [s], force [N] and slip [rad/s] there, straight in between
    oil_temperature : [K]

    Raises
    ------
    ParameterError : the pack has ``contact_rise``, or no ``film_dynamics``
    SolveError : the course could not be integrated
    """
    if params.contact_rise or not params.film_dynamics:
        raise ParameterError(
            f"contact_rise = {params.contact_rise}, film_dynamics = {params.film_dynamics}, "
            "allowed for a reference: False and True"
        )
    t, force, slip = (np.asarray(x, float) for x in np.broadcast_arrays(time, load, speed))
    rows = [_course(params, n, t, force, slip, oil_temperature) for n in RINGS]
    values, uncertainty = extrapolated(rows, (2.0, 2.0), 2.0)
    return ReferenceValues(values, uncertainty, ("Radau at 1e-9", "2, 4, 8 rings, order 2"))


def _course(
    params: ClutchParams, n: int, t: Array, force: Array, slip: Array, oil: float
) -> dict[str, float]:
    """Integrate film, rings and energy of a face over the course."""
    from scipy.integrate import solve_ivp

    par, work = prepare(params, "fine"), np.zeros(k.NWORK)
    derive_rings(par, n)
    status = int(clutch_advance.load_memory(par, force[0], oil, np.zeros(k.NSTATE), work))
    gains = [par[k.D_GAIN] * par[k.D_AREA] / clutch_rates.ring_of(par, i)[k.D_AREA]
             for i in range(n)]  # fmt: skip

    def rates(at: float, y: Array, a: int) -> Array:
        x = (at - t[a]) / (t[a + 1] - t[a])
        work[k.W_SURFACE : k.W_SURFACE + n] = y[2:]
        here = force[a] + (force[a + 1] - force[a]) * x, slip[a] + (slip[a + 1] - slip[a]) * x
        clutch_rates.pack_rates(par, *here, y[0], work, k.W_KEPT)
        film, first = work[k.W_KEPT + k.R_RATE], k.W_KEPT + k.R_RINGS + k.R_POWER
        powers = work[first : first + n * k.N_OF_RING : k.N_OF_RING]
        heat = np.array(gains) * powers - par[k.D_DECAY] * (y[2:] - oil)
        return np.concatenate(([film, powers.sum()], heat))

    y = np.concatenate(([work[k.W_NOW + k.Y_FILM], 0.0], np.full(n, oil)))
    for a in range(len(t) - 1):  # courses have corners at their points
        found = solve_ivp(rates, (t[a], t[a + 1]), y, method="Radau", args=(a,), rtol=TOLERANCE,
                          atol=TOLERANCE * np.r_[1.0, 1e3, np.full(n, 10.0)])  # fmt: skip
        if status or not found.success:
            raise SolveError(
                f"reference_engagement: not integrated beyond t = {t[a]:g} s; "
                f"{Status(status).advice if status else found.message}; use shorter stretches"
            )
        y = found.y[:, -1]
    out = np.zeros(k.NOUT)
    work[k.W_SURFACE : k.W_SURFACE + n] = y[2:]
    work[k.W_SURFACE_CHANGE : k.W_SURFACE_CHANGE + n] = 0.0
    point = (float(force[-1]), float(slip[-1]), float(y[0]))
    clutch_outputs.ring_outputs(par, point, (0.0, 0.0, 0.0), work, out, np.zeros(k.NOUT))
    return {
        "friction_torque": float(out[k.O_TORQUE]), "film_ratio": float(y[0]),
        "temperature": float(clutch_outputs.mean_surface(par, work)[0]),
        "energy": float(params.faces * y[1]),
    }  # fmt: skip
