"""An engagement of the wet clutch over time: load and slip are given, torque and heat follow."""

from dataclasses import dataclass, fields
from typing import ClassVar

from numpy.typing import ArrayLike

from ..errors import Status
from ..face_load import face_loads
from ..model.levels import level_named
from ..model.parameters import check_number
from ..model.prepare import profile_of, rising
from ..model.solutions import OverTime
from ..model.spec import REGIMES
from ..numerics.jit import Array
from .kernels import pack_friction
from .parameters import DRUM, LOAD, OIL, SPEC, SPEED, ClutchParams
from .profile import outputs_over
from .release import cold_release
from .solve import (
    doubts_of_lining,
    doubts_of_pack,
    doubts_of_warmth,
    heat_status,
    pack_warnings,
    prepare,
)


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
    face_pressure: Array
    face_pressure_max: Array
    sliding_speed: Array
    pressure_velocity: Array
    power_per_area: Array
    energy_per_area: Array
    regime: list[str]
    status: Status  # EXTRAPOLATED if the interface passed 600 degC, HOT 523 K, OK otherwise
    substeps: int  # Implicit substeps that all intervals together took
    fidelity: str
    warnings: tuple[str, ...] = ()
    """What a reader must not miss, a line each."""


def engage_clutch(
    params: ClutchParams,
    *,
    time: "ArrayLike",
    load: "ArrayLike",
    speed: "ArrayLike",
    oil_temperature: float = 297.15,
    drum_speed: "ArrayLike" = 0.0,
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
    Substeps are chosen inside each interval; points need only be as close as the profiles of load
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
    forces = profile_of("load", load, "N", *LOAD.range, len(points))
    slips = profile_of("speed", speed, "rad/s", *SPEED.range, len(points))
    oil = check_number("oil_temperature", oil_temperature, "K", *OIL.range)
    drums = profile_of("drum_speed", drum_speed, "rad/s", *DRUM.range, len(points))
    par = prepare(params, fidelity)
    rows, substeps = outputs_over(par, points, forces, slips, oil, drums)
    kept, stages = {f.name for f in fields(Engagement)}, list(REGIMES)
    columns = {n: rows[:, i].copy() for i, n in enumerate(SPEC.real_outputs) if n in kept}
    columns |= face_loads(params.face, forces, slips, columns["friction_power"])
    columns["energy_per_area"] = columns["energy"] / params.lining_area
    hottest = float(columns["temperature"].max())
    status = heat_status(hottest)
    return Engagement(
        time=points,
        load=forces,
        speed=slips,
        **columns,
        substeps=substeps,
        fidelity=level_named(SPEC, fidelity),
        regime=[
            stages[pack_friction.regime_of(par, u, slip) - 1]
            for u, slip in zip(columns["film_ratio"], slips, strict=True)
        ],
        status=status,
        warnings=(
            *doubts_of_pack(params, fidelity),
            *doubts_of_lining(params, float(forces.max())),
            *(
                f"The pack is {line}"
                for line in cold_release(
                    params,
                    level_named(SPEC, fidelity),
                    time=points,
                    load=forces,
                    speed=slips,
                    torque=columns["friction_torque"],
                    film_ratio=columns["film_ratio"],
                    energy=columns["energy"],
                    oil_temperature=oil,
                )
            ),
            *doubts_of_warmth(params, float(columns["temperature"].min()), hottest, fidelity),
            *pack_warnings(status, float(columns["film_ratio"].min()), hottest, hottest),
        ),
    )
