"""Reference values of the wet clutch: more rings, another integrator at tight tolerance.

Chart `settled` is slip that lasts for ever, as ``solve_clutch`` takes it; chart `engagement` is a
pack that closes while its slip runs out, as in a shift, at points of time. The drum stands still.
"""

from contextlib import suppress
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...clutch.engagement import engage_clutch
from ...clutch.kernels import advance, pack_outputs, steady
from ...clutch.kernels import layout as k
from ...clutch.kernels import rates as clutch_rates
from ...clutch.kernels.constants import derive_rings
from ...clutch.parameters import ClutchParams
from ...clutch.profile import outputs_over
from ...clutch.solve import prepare, solve_clutch
from ...errors import ParameterError, SolveError, Status
from ...ladder.error_table import QUANTITIES
from . import reference_values as ref
from .reference_values import Answer, Point, ReferencePoint, ReferenceValues, Source, Values

Array = NDArray[np.float64]
RINGS = (2, 4, 8)
TOLERANCE = 1e-9
PLACES = (k.O_TORQUE, k.O_TEMPERATURE, k.O_FILM, k.O_RATIO)  # of QUANTITIES, among the outputs
# The engagement that levels are compared in: the force rises, the slip falls. Its film is squeezed
# out in the first of these times [s], the lining heats up until the last.
TIMES = (0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6)
RISE, HELD, LEFT = 0.1, 0.2, 0.05  # s of the force; s of full slip; share of the slip at the end


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
    whole = solve_clutch(
        params, load=load, speed=speed, oil_temperature=oil_temperature, fidelity="fine"
    )
    sign = float(np.sign(speed))
    rows = []
    for n in RINGS:
        par = prepare(params, "fine")
        derive_rings(par, n)
        contact, viscous, temperature, _, coefficient, *_ = steady.steady_pack(
            par, load, speed, 0.0, oil_temperature, whole.film_ratio, steady.NOT_HELD
        )
        rows.append(
            {
                "friction_torque": sign * (contact + viscous),
                "temperature": temperature,
                "contact_torque": sign * contact,
                "viscous_torque": sign * viscous,
                "friction_coefficient": coefficient,
                "film_ratio": whole.film_ratio,
                "film_thickness": whole.film_thickness,
            }
        )
    values, uncertainty = ref.extrapolated(rows, (2.0, 2.0), 2.0)
    return ReferenceValues(values, uncertainty, ("2, 4, 8 rings, order 2",))


def reference_engagement(
    params: ClutchParams, *, time: Any, load: Any, speed: Any, oil_temperature: float = 297.15
) -> ReferenceValues:
    """Return torque, temperature, film ratio and heat at the end of a profile of load and slip.

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
    SolveError : the profile could not be integrated
    """
    if params.contact_rise or not params.film_dynamics:
        raise ParameterError(
            f"contact_rise = {params.contact_rise}, film_dynamics = {params.film_dynamics}, "
            "allowed for a reference: False and True"
        )
    t, force, slip = (np.asarray(x, float) for x in np.broadcast_arrays(time, load, speed))
    rows = [_by_radau(params, n, t, force, slip, oil_temperature) for n in RINGS]
    values, uncertainty = ref.extrapolated(rows, (2.0, 2.0), 2.0)
    return ReferenceValues(values, uncertainty, ("Radau at 1e-9", "2, 4, 8 rings, order 2"))


def _by_radau(
    params: ClutchParams, n: int, t: Array, force: Array, slip: Array, oil: float
) -> dict[str, float]:
    """Integrate film, rings and energy of a face over the profile."""
    from scipy.integrate import solve_ivp

    par, work = prepare(params, "fine"), np.zeros(k.NWORK)
    derive_rings(par, n)
    status = int(advance.load_memory(par, force[0], oil, np.zeros(k.NSTATE), work))
    gains = [
        par[k.D_GAIN] * par[k.D_AREA] / clutch_rates.ring_of(par, i)[k.D_AREA] for i in range(n)
    ]

    def rates(at: float, y: Array, a: int) -> Array:
        x = (at - t[a]) / (t[a + 1] - t[a])
        work[k.W_SURFACE : k.W_SURFACE + n] = y[2:]
        here = force[a] + (force[a + 1] - force[a]) * x, slip[a] + (slip[a + 1] - slip[a]) * x
        clutch_rates.pack_rates(par, *here, 0.0, y[0], work, k.W_KEPT)
        film, first = work[k.W_KEPT + k.R_RATE], k.W_KEPT + k.R_RINGS
        rings = work[first : first + n * k.N_OF_RING].reshape(n, k.N_OF_RING)
        powers, cooling = rings[:, k.R_POWER], rings[:, k.R_COOL]
        heat = np.array(gains) * (powers - cooling * (y[2:] - oil))
        return np.concatenate(([film, powers.sum()], heat))

    y = np.concatenate(([work[k.W_NOW + k.Y_FILM], 0.0], np.full(n, oil)))
    for a in range(len(t) - 1):  # profiles have corners at their points
        found = solve_ivp(
            rates,
            (t[a], t[a + 1]),
            y,
            method="Radau",
            args=(a,),
            rtol=TOLERANCE,
            atol=TOLERANCE * np.r_[1.0, 1e3, np.full(n, 10.0)],
        )
        if status or not found.success:
            raise SolveError(
                f"reference_engagement: not integrated beyond t = {t[a]:g} s; "
                f"{Status(status).advice if status else found.message}; use shorter intervals"
            )
        y = found.y[:, -1]
    out = np.zeros(k.NOUT)
    work[k.W_SURFACE : k.W_SURFACE + n] = y[2:]
    work[k.W_SURFACE_CHANGE : k.W_SURFACE_CHANGE + n] = 0.0
    point = (float(force[-1]), float(slip[-1]), float(y[0]), 0.0)
    pack_outputs.ring_outputs(par, point, (0.0,) * 4, work, out, np.zeros(k.NOUT))
    return {
        "friction_torque": float(out[k.O_TORQUE]),
        "film_ratio": float(y[0]),
        "temperature": float(pack_outputs.mean_surface(par, work)[0]),
        "energy": float(params.faces * y[1]),
    }


def engagement_points(load: float, speed: float) -> tuple[Any, Any, Any]:
    """Return time [s], force [N] and slip [rad/s] of the engagement."""
    t = np.array(TIMES)
    fallen = np.clip((t - HELD) / (t[-1] - HELD), 0.0, 1.0)
    return t, load * np.minimum(t / RISE, 1.0), speed * (1.0 - (1.0 - LEFT) * fallen)


def engagement_corners(load: float, speed: float) -> tuple[list[float], list[float], list[float]]:
    """Return the points [s] between which force [N] and slip [rad/s] are straight, and both."""
    times = [0.0, RISE, HELD, TIMES[-1]]
    return times, [0.0, load, load, load], [speed, speed, speed, LEFT * speed]


def _at_points(params: Any, point: Point) -> list[ReferencePoint]:
    """Return the reference's answers at a held-out point, settled and in an engagement.

    Both are extrapolated over the number of rings. A chart on which the equations have no solution
    is left out, and slip that would burn the lining before it settles.
    """
    given: Any = point
    found = []
    with suppress(SolveError):
        settled = reference_clutch(params, **given)
        if settled.values["temperature"] <= k.HOT_LIMIT:
            found.append(ReferencePoint(point, "settled", None, *settled.of(QUANTITIES)))
    with suppress(SolveError):
        found.append(ReferencePoint(point, "engagement", None, *_engagement(params, point)))
    return found


def _engagement(params: Any, point: Point) -> tuple[Values, dict[str, float]]:
    """Return the quantities over the profile, and what they may be off by at worst."""
    time, load, slip = engagement_points(point["load"], point["speed"])
    rows = []
    for n in RINGS:
        par = prepare(params, "fine")
        derive_rings(par, n)
        outputs, _ = outputs_over(par, time, load, slip, point["oil_temperature"], 0.0 * time)
        rows.append(dict(zip(QUANTITIES, outputs.T[list(PLACES)], strict=True)))
    values, uncertainty = ref.extrapolated(rows, (2.0, 2.0), 2.0)
    return {name: value.tolist() for name, value in values.items()}, uncertainty


def _at_case(point: tuple[float, ...], _before: object = ()) -> ReferenceValues:
    """Return slip energy and temperature at the end of an engagement, of a case of the charts."""
    time, load, speed = engagement_corners(*point[:2])
    r = reference_engagement(
        ClutchParams(), time=time, load=load, speed=speed, oil_temperature=point[2]
    )
    values, off = (
        {"slip_energy": x["energy"], "end_temperature": x["temperature"]}
        for x in (r.values, r.uncertainty)
    )
    return ReferenceValues(values, off, r.routes)


def _answer(params: Any, fidelity: str, known: ReferencePoint) -> Answer:
    point: Any = known.point
    if known.chart == "engagement":
        time, load, speed = engagement_points(point["load"], point["speed"])
        e = engage_clutch(
            params,
            time=time,
            load=load,
            speed=speed,
            oil_temperature=point["oil_temperature"],
            fidelity=fidelity,
        )
        return Answer({name: getattr(e, name).tolist() for name in QUANTITIES}, ref.OK)
    c = solve_clutch(params, **point, fidelity=fidelity)
    return Answer({name: getattr(c, name) for name in QUANTITIES}, ref.OK)


SOURCE = Source(
    _at_points,
    _answer,
    _at_case,
    tuple(f"thrustwasher.clutch.kernels.{name}" for name in ("advance", "pack_outputs", "steady")),
    None,
    (f"{', '.join(map(str, RINGS))} rings, order 2; settled below {k.HOT_LIMIT:g} K",),
)
