"""An engagement of the wet clutch over time: load and slip are given, torque and heat follow."""

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..errors import SolveError, Status
from ..model.parameters import check_number
from ..model.prepare import course_of, rising
from ..model.rungs import rung_named
from ..model.spec import REGIMES
from ..numerics.jit import Array
from .kernels import advance as clutch_advance
from .kernels import layout as k
from .kernels import pack_friction, pack_outputs, rates
from .parameters import DRUM, LOAD, OIL, SPEC, SPEED, ClutchParams
from .solve import doubts_of_pack, pack_warnings, prepare

Course = tuple[float, float, float, float, float, float, float, float]


class PackCourse:
    """A pack on its way; ``status`` tells how the last call went."""

    def __init__(self, par: Any, load: float, oil: float) -> None:
        self.par, self.work, self.out = par, np.zeros(k.NWORK), np.zeros(k.NOUT)
        self.first, self.to_oil = oil, 0.0  # temperature at the start [K]; heat in the oil [J]
        self.status = int(clutch_advance.load_memory(par, load, oil, np.zeros(k.NSTATE), self.work))
        if self.status == Status.OK and not rates.moves_film(par):
            self.work[k.W_NOW + k.Y_FILM] = 1.0
            self.status = int(clutch_advance.settle_film(par, load, self.work))

    def advance(self, course: Course, duration: float) -> int:
        """Go along a stretch; return the number of substeps."""
        power = self.out[k.O_POWER] / self.par[k.P_FACES]
        self.status = int(
            clutch_advance.advance(
                self.par, course, duration, power, self.work[k.W_PROPOSED], self.work
            )
        )
        return int(self.work[k.W_SUBSTEPS])

    def show(self, load: float, slip: float, drum: float, duration: float = 0.0) -> Array:
        """Return the real outputs at the present point, ``duration`` [s] after the last one."""
        pack_outputs.fill_outputs(self.par, load, slip, drum, self.work, self.out)
        self.out[k.O_TEMPERATURE], _ = pack_outputs.mean_surface(self.par, self.work)
        self.out[k.O_ENERGY] = self.par[k.P_FACES] * self.work[k.W_NOW + k.Y_ENERGY]
        self.out[k.O_STORED_HEAT] = pack_outputs.stored_heat(self.par, self.work, self.first)
        before, self.to_oil = self.to_oil, self.out[k.O_ENERGY] - self.out[k.O_STORED_HEAT]
        self.out[k.O_OIL_HEAT] = (self.to_oil - before) / duration if duration > 0.0 else 0.0
        return self.out


def outputs_over(
    par: Any, time: Array, load: Array, slip: Array, oil: float, drum: Array
) -> tuple[Array, int]:
    """Return the real outputs of a pack at the points of its course, (n, NOUT), and all substeps.

    ``par`` is that of the kernel, the rest as in ``engage_clutch``; SolveError too.
    """
    rows, substeps, pack = np.empty((len(time), k.NOUT)), 0, PackCourse(par, load[0], oil)
    for i in range(len(time)):
        duration = time[i] - time[i - 1] if i else 0.0
        if i and pack.status == Status.OK:
            ends = (load[i - 1], slip[i - 1], oil, load[i], slip[i], oil, drum[i - 1], drum[i])
            substeps += pack.advance(ends, duration)
        if Status(pack.status).is_failure:
            raise SolveError(
                f"t = {time[i]:g} s, load = {load[i]:g} N, speed = {slip[i]:g} rad/s: "
                f"{Status(pack.status).advice}"
            )
        rows[i] = pack.show(load[i], slip[i], drum[i], duration)
    return rows, substeps


@dataclass(frozen=True, slots=True)
class Engagement:
    """An engagement at the points ``time``; arrays of one length, SI units."""

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

    def as_dict(self) -> dict[str, Any]:
        """Return the fields as a dictionary that JSON can hold; status by name."""
        found = {f.name: getattr(self, f.name) for f in fields(self)}
        lists = {n: v.tolist() for n, v in found.items() if isinstance(v, np.ndarray)}
        return found | lists | {"status": self.status.name}


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
            *pack_warnings(status, float(columns["film_ratio"].min()), hottest, hottest),
        ),
    )
