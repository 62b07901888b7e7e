"""An engagement of the wet clutch over time: load and slip are given, torque and heat follow."""

from dataclasses import dataclass, fields
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..errors import SolveError, Status
from ..model.parameters import check_number
from ..model.prepare import course_of, rising
from ..model.rungs import rung_named
from ..model.solutions import OverTime
from ..model.spec import REGIMES
from ..numerics.jit import Array
from .kernels import advance as clutch_advance
from .kernels import layout as k
from .kernels import pack_friction, pack_outputs, rates
from .parameters import DRUM, LOAD, OIL, SPEC, SPEED, ClutchParams
from .solve import doubts_of_lining, doubts_of_pack, pack_warnings, prepare


def outputs_over(
    par: Any, time: Array, load: Array, slip: Array, oil: float, drum: Array
) -> tuple[Array, int]:
    """Return the real outputs of a pack at the points in time, (n, NOUT), and all substeps.

    ``par`` is that of the kernel, the rest as in ``engage_clutch``; SolveError too.
    """
    work, out, rows = np.zeros(k.NWORK), np.zeros(k.NOUT), np.empty((len(time), k.NOUT))
    substeps, to_oil, faces = 0, 0.0, par[k.P_FACES]  # to_oil: heat that reached the oil [J]
    status = clutch_advance.load_memory(par, load[0], oil, np.zeros(k.NSTATE), work)
    if status == Status.OK and not rates.moves_film(par):
        work[k.W_NOW + k.Y_FILM] = 1.0
        status = clutch_advance.settle_film(par, load[0], work)
    for i, (now, force, speed, turns) in enumerate(zip(time, load, slip, drum, strict=True)):
        if i and status == Status.OK:
            ends = (load[i - 1], slip[i - 1], oil, force, speed, oil, drum[i - 1], turns)
            status = clutch_advance.advance(
                par, ends, now - time[i - 1], out[k.O_POWER] / faces, work[k.W_PROPOSED], work
            )
            substeps += int(work[k.W_SUBSTEPS])
        if Status(status).is_failure:
            raise SolveError(
                f"t = {now:g} s, load = {force:g} N, speed = {speed:g} rad/s: "
                f"{Status(status).advice}"
            )
        pack_outputs.fill_outputs(par, force, speed, turns, work, out)
        out[k.O_TEMPERATURE], _ = pack_outputs.mean_surface(par, work)
        out[k.O_ENERGY] = faces * work[k.W_NOW + k.Y_ENERGY]
        out[k.O_STORED_HEAT] = pack_outputs.stored_heat(par, work, oil)
        before, to_oil = to_oil, out[k.O_ENERGY] - out[k.O_STORED_HEAT]
        out[k.O_OIL_ENERGY] = to_oil
        out[k.O_OIL_HEAT] = (to_oil - before) / (now - time[i - 1]) if i else 0.0
        rows[i] = out
    return rows, substeps


@dataclass(frozen=True, slots=True)
class Engagement(OverTime):
    """An engagement at the points ``time``; arrays of one length, SI units."""

    _model: ClassVar[str] = SPEC.key
    time: Array
    load: Array
    speed: Array
    friction_torque: Array
    contact_torque: Array
    viscous_torque: Array
    torque_capacity: Array
    temperature: Array
    film_thickness: Array
    film_ratio: Array
    friction_coefficient: Array
    contact_share: Array
    friction_power: Array
    heat_flux: Array
    energy: Array
    oil_heat: Array  # [W] heat that reached the oil, mean since the point before; 0 at the first
    stored_heat: Array
    regime: list[str]
    status: Status  # HOT if the interface passed 523 K, OK otherwise
    substeps: int  # Implicit substeps that all intervals together took
    fidelity: str
    warnings: tuple[str, ...] = ()
    """What a reader must not miss, a line each."""


def engage_clutch(
    params: ClutchParams,
    *,
    time: ArrayLike,
    load: ArrayLike,
    speed: ArrayLike,
    oil_temperature: float = 297.15,
    drum_speed: ArrayLike = 0.0,
    fidelity: str = "field",
) -> Engagement:
    """Return film, temperature and torque of a pack whose load and slip are given over time.

    Parameters
    ----------
    params : the pack; ``starts_pressed`` says if the film is settled at the first point or open
    time : (n,) points [s], rising, at least two
    load : (n,) axial force [N] at the points, or one number; straight in between
    speed : (n,) slip [rad/s] at the points, or one number; straight in between
    oil_temperature : [K]; the steel is as warm at the start
    drum_speed : (n,) speed [rad/s] of the drum, or one number; the hub turns by the slip faster
    fidelity : as in ``solve_clutch``

    Raises
    ------
    ParameterError : an argument has the wrong shape or range; the message names it
    SolveError : an interval could not be integrated

    Notes
    -----
    Substeps are chosen inside each interval; points need only be as close as the courses of load
    and slip ask for.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.linspace(0.0, 0.3, 31)
    >>> e = engage_clutch(ClutchParams(), time=t, load=5898.0 * np.minimum(t / 0.1, 1.0),
    ...                   speed=100.0, oil_temperature=353.15)
    >>> e.regime[0], e.regime[-1]
    ('film', 'boundary')
    """
    points = rising(time)
    forces = course_of("load", load, "N", *LOAD.range, len(points))
    slips = course_of("speed", speed, "rad/s", *SPEED.range, len(points))
    oil = check_number("oil_temperature", oil_temperature, "K", *OIL.range)
    drums = course_of("drum_speed", drum_speed, "rad/s", *DRUM.range, len(points))
    par = prepare(params, fidelity)
    rows, substeps = outputs_over(par, points, forces, slips, oil, drums)
    kept, stages = {f.name for f in fields(Engagement)}, list(REGIMES)
    columns = {n: rows[:, i].copy() for i, n in enumerate(SPEC.real_outputs) if n in kept}
    hottest = float(columns["temperature"].max())
    status = Status.HOT if hottest > k.HOT_LIMIT else Status.OK
    return Engagement(
        time=points,
        load=forces,
        speed=slips,
        **columns,
        substeps=substeps,
        fidelity=rung_named(SPEC, fidelity),
        regime=[
            stages[pack_friction.regime_of(par, u, slip) - 1]
            for u, slip in zip(columns["film_ratio"], slips, strict=True)
        ],
        status=status,
        warnings=(
            *doubts_of_pack(params, fidelity),
            *doubts_of_lining(params, float(forces.max())),
            *pack_warnings(status, float(columns["film_ratio"].min()), hottest, hottest),
        ),
    )
