"""The washer over time: inputs are given at points, friction and heat follow."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from dataclasses import fields as dataclass_fields
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import ParameterError, SolveError, Status
from ..face_load import face_loads
from ..model.levels import gone_level, level_named
from ..model.parameters import as_numbers
from ..model.prepare import profile_of, rising
from ..model.solutions import OverTime
from ..numerics.jit import Array
from ..plugins import called
from .kernel_arguments import constants
from .kernels import layout as L
from .kernels import step as kernel
from .kernels.workspace import size_of_state, size_of_work
from .parameters import BODIES, SPEC, WasherParams, property_of, washer_face
from .solve import RANGES, TILT, check_far_face, resolve_grid

__all__ = ["HistoryError", "WasherHistory", "follow_washer"]

PIECE = 0.1  # of the slowest body's time: how long inputs are held on their way between points
MOST_PIECES = 32


@dataclass(frozen=True, slots=True)
class WasherHistory(OverTime):
    """A washer at the points ``time``; arrays of one length, SI units."""

    _model: ClassVar[str] = SPEC.key
    time: Array
    load: Array
    speed: Array
    tilt: Array
    oil_temperature: Array
    far_face_temperature: Array
    friction_torque: Array
    temperature: Array
    film_thickness: Array
    temperature_max: Array
    film_ratio: Array
    fluid_load_share: Array
    friction_coefficient: Array
    friction_power: Array
    oil_flow: Array
    throughflow_heat: Array
    oil_heat: Array
    oil_outlet_temperature: Array
    film_temperature: Array
    stick_margin: Array
    energy: Array
    stored_heat: Array
    oil_energy: Array
    face_pressure: Array
    face_pressure_max: Array
    sliding_speed: Array
    pressure_velocity: Array
    power_per_area: Array
    energy_per_area: Array
    distress: NDArray[np.bool_]
    status: list[Status]
    """Per point: OK or an advice."""
    thermal_mode: str
    fidelity: str
    grid: tuple[int, int]
    warnings: tuple[str, ...] = ()
    """What a reader must not miss, a line each."""


class HistoryError(SolveError):
    """A time history that could not be computed to its end; ``history`` is the part before."""

    def __init__(self, text: str, history: WasherHistory) -> None:
        super().__init__(text)
        self.history = history


def follow_washer(
    params: WasherParams,
    *,
    time: "ArrayLike",
    load: "ArrayLike",
    speed: "ArrayLike",
    tilt: "ArrayLike" = TILT,
    oil_temperature: "ArrayLike" = 297.15,
    far_face_temperature: "ArrayLike" = 0.0,
    fidelity: str = "field",
    grid: tuple[int, int] | None = None,
    progress: bool | Callable[[int, int], None] | None = None,
) -> WasherHistory:
    """Return friction, temperature and film of a washer whose inputs are given over time.

    Parameters
    ----------
    params : the washer; ``thermal_mode`` says if its bodies store heat, ``thermal_start`` how warm
        they are at the first point
    time : (n,) points [s], rising, at least two
    load, speed, tilt, oil_temperature, far_face_temperature : (n,) values [N], [rad/s], [rad], [K],
        [K] at the points, or one number each; the last with ``gear_far_face = "bulk"``, all or none
        of it 0 (the oil's)
    fidelity : "field" or "fine"
    grid : (n_r, n_theta), overrides the nodes of the fidelity
    progress : True: a bar of tqdm, or a line, on the terminal; or called with points done and all

    Raises
    ------
    ParameterError : an argument has the wrong shape or range; the message names it
    HistoryError : an interval could not be solved; its ``history`` holds what was computed before

    Notes
    -----
    Quasi-steady: every point is the steady state there, on the branch that its past leads to.
    Transient: the heat balance of Jackson & Green Eq 19-29 with what carrier, washer and gear
    store, density x specific heat x thickness each. Inputs run straight from point to point, in
    stairs that are short compared with the bodies' time; substeps keep temperatures within 0.02 K +
    0.2 %.

    Examples
    --------
    >>> import numpy as np
    >>> hot = WasherParams(thermal_mode="transient")
    >>> c = follow_washer(hot, time=np.linspace(0.0, 9.0, 10), load=[300.0] + 9 * [1200.0],
    ...                   speed=545.0, tilt=2e-3)
    >>> c.distress.tolist().index(True)
    2
    """
    points = rising(time)
    columns = [
        profile_of(name, given, unit, low, high, len(points))
        for (name, unit, low, high), given in zip(
            RANGES, (load, speed, tilt, oil_temperature, far_face_temperature), strict=True
        )
    ]
    far_face = columns[-1]
    check_far_face(params, float(far_face.max()))
    check_far_face(params, float(far_face.min()))
    if far_face.min() == 0.0 < far_face.max():
        raise ParameterError(
            "far_face_temperature = 0 at some points, allowed: at all of them (the oil's) or none"
        )
    if fidelity == "map":
        raise ParameterError(f"fidelity = {fidelity!r}, allowed: 'field' or 'fine'")
    inputs, level = np.column_stack(columns), level_named(SPEC, fidelity)
    run = Follower(params, resolve_grid(level, grid))
    rows, lost = np.empty((len(points), kernel.NOUT)), np.zeros(len(points), bool)
    statuses: list[Status] = []

    shown = {f.name for f in dataclass_fields(WasherHistory)}

    def packed(n: int) -> WasherHistory:
        """Return the first points."""
        given = {s.name: inputs[:n, k].copy() for k, s in enumerate(SPEC.inputs)}
        made = {
            name: rows[:n, k].copy() for k, name in enumerate(SPEC.real_outputs) if name in shown
        }
        face = washer_face(params)
        loads = face_loads(face, given["load"], given["speed"], made["friction_power"])
        return WasherHistory(
            time=points[:n],
            distress=lost[:n].copy(),
            status=statuses,
            fidelity=level,
            thermal_mode=params.thermal_mode,
            grid=run.grid,
            warnings=gone_level(SPEC, fidelity),
            **given,
            **made,
            **loads,
            energy_per_area=made["energy"] / face.area,
        )

    show = called("shown_progress")(progress, "washer") if progress else None
    for i in range(len(points)):
        duration = points[i] - points[i - 1] if i else 0.0
        code = run.go(inputs[max(i - 1, 0)], inputs[i], duration)
        if Status(code).is_failure:
            values = ", ".join(
                f"{s.name} = {x:g} {s.unit}" for s, x in zip(SPEC.inputs, inputs[i], strict=True)
            )
            text = f"t = {points[i]:g} s, {values}: {Status(code).advice}"
            raise HistoryError(text, packed(i))
        rows[i], lost[i] = run.out, bool(run.iout[L.IO_DISTRESS])
        statuses.append(Status(int(run.iout[L.IO_STATUS])))
        if show is not None:
            show(i + 1, len(points))
    return packed(len(points))


def _settling(params: WasherParams, body: str) -> float:
    """Return density x specific heat x thickness^2 over conductivity of a body [s]."""
    density, heat, conductivity = (
        property_of(params, name, body) for name in ("density", "specific_heat", "conductivity")
    )
    thickness: float = getattr(params, f"{body}_thickness")
    return density * heat * thickness**2 / conductivity


class Follower:
    """A washer with its memory, stepped by the kernel from point to point.

    ``state`` is all that it remembers: a copy of it is a point to go back to.
    """

    def __init__(self, params: WasherParams, grid: tuple[int, int]) -> None:
        self.grid, self.in_time = grid, params.thermal_mode == "transient"
        numbers = as_numbers(params)
        self.par = constants(params, grid, self.in_time).copy()
        self.par[: len(numbers)] = numbers
        self.state = np.zeros(size_of_state(*grid))
        self.work = np.zeros(L.N_HEAD + size_of_work(*grid))
        self.out, self.iout = np.empty(kernel.NOUT), np.zeros(kernel.NIOUT, np.int32)
        self.piece = PIECE * max(_settling(params, body) for body in BODIES)

    def go(self, before: Array, now: Array, duration: float) -> int:
        """Come to the inputs ``now``; return the status. The first point takes no time."""
        if duration == 0.0 or not self.in_time:
            code = self._step(now, duration or 1e-12)
            self.state[L.S_SUBSTEP] = 0.0  # that of the first point is none to go on with
            return code
        if (before == now).all():
            return self._step(now, duration)
        n = min(max(math.ceil(duration / self.piece), 1), MOST_PIECES)
        for i in range(n):
            code = self._step(before + (now - before) * ((i + 0.5) / n), duration / n)
            if Status(code).is_failure:
                return code
        return self._step(now, 0.0)

    def _step(self, inputs: Array, duration: float) -> int:
        code = int(
            kernel.step(self.par, inputs, self.state, self.work, self.out, self.iout, 0.0, duration)
        )
        self.out[L.O_OIL_HEAT] = self.work[L.AT_OUTPUTS + L.O_OIL_HEAT]  # at the point
        return code
