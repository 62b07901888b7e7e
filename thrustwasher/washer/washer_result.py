"""What a washer solve returns, and the error to expect of it."""

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..errors import ParameterError, Status
from ..face_load import Face, OnFaces
from ..ladder.error_table import error_estimate
from ..model.advice import warnings_of
from ..model.idle import idle_warnings
from ..model.sensitivity import chosen_unit
from ..model.solutions import Asked, Late
from ..numerics.jit import Array
from .kernel_arguments import NO_MESH, constants, work_array
from .kernels import layout as L
from .kernels import outputs as kernel
from .kernels.constants import WasherModel, washer_model
from .kernels.newton import evaluate_here
from .kernels.regime_and_status import point_of
from .kernels.workspace import Fields, fields_of, size_of_work, workspace_of
from .mesh_error import OF_FILM, mesh_error
from .parameters import SPEC, WasherParams, face_of, washer_face
from .sensitivities import PLACES, Solved, parameter_derivatives

BRANCHES = {"film": L.FILM_BRANCH, "contact": L.CONTACT_BRANCH}  # that one can ask for
SLIPS = (
    "the gear cannot hold the washer: dry friction between them takes {:.2g} times the friction "
    "torque, so the washer would slip on the gear; here both turn together"
)
OVERLAP = (
    "below 0 the mean surfaces would overlap, asperities alone carry and wear; lower the load or "
    "raise roughness or viscosity"
)
PRESSED = "film_thickness = {:.3g} um: " + OVERLAP
FROM_TABLES = -1.0  # in place of an error: a verification table is looked at when somebody asks
INPUTS = tuple(signal.name for signal in SPEC.inputs)
Inputs = tuple[float, float, float, float, float]  # of a solution, in that order
FULL_FILM = 3.0  # film ratio above which regime and branch are called film
DRY = (
    "film_ratio = {:.3g} is that of a full film, but asperities carry {:.4g} of {:.4g} N: parallel "
    "faces build no pressure; friction and wear are those of dry contact. Give the tilt there is"
)
FAR_FACE = (
    "gear_far_face = 'bulk' without a far_face_temperature: the oil's is taken, as with 'oil'; "
    "give that of the gear"
)
COUNTS = 0.1  # share of the torque from which dry friction counts
BEYOND = (
    "dry friction was measured for mean contact pressures of {low:.3g} .. {high:.3g} Pa; here "
    "{pressure:.3g} Pa: it is held at the end, {friction:.3g}; give data for this pressure "
    "(friction_reference, friction_slope, friction_pressure_min, friction_pressure_max) or "
    "friction_law = 'constant'"
)
LOAD, SPEED, TILT, OIL = (signal.verified for signal in SPEC.inputs[:4])
BRANCH_NAMES = {L.FILM_BRANCH: "film", L.UNSTABLE: "unstable", L.CONTACT_BRANCH: "contact"}


@dataclass(frozen=True, slots=True)
class WasherFields:
    """Fields over the washer; two-dimensional ones are (n_r, n_theta)."""

    radius: Array  # (n_r,) [m]
    angle: Array  # (n_theta,) [rad]
    film_thickness: Array  # [m] separation of the mean surfaces of film 1
    pressure: Array  # [Pa] in the film
    contact_pressure: Array  # [Pa] on the asperities, per nominal area
    carrier_temperature: Array  # [K] towards film 1, as that of the washer
    washer_temperature: Array  # [K]
    gear_temperature: Array  # [K] towards gap 2; nan inside the gear's inner radius
    film_temperature: Array  # [K] of the oil in film 1; without oil cooling that of its walls
    liquid_fraction: Array  # [-] of the gap that liquid fills
    flow_outward: Array  # [m2/s] liquid in film 1 per width, along the radius
    flow_around: Array  # [m2/s] and along the circumference


@dataclass(frozen=True, slots=True)
class Fold:
    """Where two branches meet and end."""

    kind: str  # "film_lost" (load rising) or "film_regained" (load falling)
    load: float  # [N]
    film_ratio: float  # [-]
    temperature: float  # [K]
    friction_torque: float  # [N m]


@dataclass(frozen=True, slots=True)
class WasherResult(Late, OnFaces):
    """Steady state of the washer at one operating point; SI units."""

    friction_torque: float  # [N m] sign of speed
    temperature: float  # [K] area mean of carrier and washer
    temperature_max: float  # [K] of carrier and washer
    film_thickness: float  # [m] minimum separation of the mean surfaces of film 1
    film_ratio: float  # [-] film_thickness over sigma
    fluid_load: float  # [N]
    contact_load: float  # [N]
    friction_coefficient: float  # [-]
    friction_power: float  # [W]
    oil_flow: float  # [m3/s] liquid that leaves film 1 at its rims
    throughflow_heat: float  # [W] that it carries; negative if it is supplied hotter
    oil_heat: float  # [W] that reaches the oil, by throughflow and far faces
    oil_outlet_temperature: float  # [K] mean of what leaves
    film_temperature: float  # [K] area mean of the oil in film 1
    stick_margin: float  # [-] torque that gap 2 can hold over friction_torque, at most 1000
    washer_tilt_x: float  # [rad]
    washer_tilt_y: float  # [rad]
    branch: str  # "film", "unstable" or "contact"
    distress: bool
    status: Status
    iterations: int
    fidelity: str
    grid: tuple[int, int]
    _error: float | None = field(repr=False)  # as error_estimate, or FROM_TABLES
    load: float  # [N] as solved for
    speed: float  # [rad/s]
    tilt: float  # [rad]
    oil_temperature: float  # [K]
    far_face_temperature: float  # [K] at the gear's far face; 0: the oil's
    params: WasherParams = field(repr=False, compare=False)
    _state: Array = field(repr=False, compare=False)
    warnings: tuple[str, ...] = ()
    """What a reader must not miss, a line each."""

    @property
    def error_estimate(self) -> float | None:
        """[-] relative, of friction_torque, at most 1; with ``grid`` by a second solve.

        On the named meshes it follows from how steeply the torque follows the load (some
        milliseconds), with the map from its verification table. Both hold for the parameters and
        the box that a verification table was measured for; elsewhere it is None.
        """
        if self._error != FROM_TABLES:
            return self._error
        known = self._by_table()
        if known is None or self.fidelity not in OF_FILM:
            return known
        share = self.fluid_load / (self.fluid_load + self.contact_load)
        return mesh_error(self.solved(), self.fidelity, share, self.film_ratio)

    def _on_faces(self) -> tuple[Face, float, float]:
        return washer_face(self.params), self.load, self.speed

    def _by_table(self) -> float | None:
        names = ("load", "speed", "tilt", "oil_temperature")
        return error_estimate(
            "washer",
            self.fidelity,
            self.params,
            {n: getattr(self, n) for n in names},
            branch=self.branch,
            film_ratio=self.film_ratio,
        )

    def point(self) -> Inputs:
        """Return the inputs: load, speed, tilt, oil temperature, that of the gear's far face."""
        return (self.load, self.speed, self.tilt, self.oil_temperature, self.far_face_temperature)

    def request(self) -> Asked:
        """Return model, parameters and point that it is the solution of."""
        point = dict(zip(INPUTS, self.point(), strict=True))
        return Asked(SPEC.key, self.params, {**point, "fidelity": self.fidelity})

    def sensitivities(
        self,
        outputs: Collection[str] | None = None,
        parameters: Collection[str] | None = None,
        *,
        per_percent: bool = False,
    ) -> dict[str, dict[str, float]]:
        """Return {output: {parameter: derivative}}, SI, on this branch and mesh.

        Exact, from one factorisation of the solved equations and no solve per parameter.

        Parameters
        ----------
        outputs : names of real results; by default all
        parameters : names; by default all real ones but those whose 0 stands for a value from
            elsewhere, and those that a rule holds where they are
        per_percent : return the change of the output for one percent of the parameter instead

        Raises
        ------
        ParameterError : a name is none of them, or the level has no mesh
        SolveError : at a fold, where results have no derivatives

        Notes
        -----
        Source and error: docs/theory/sensitivity.md.

        Examples
        --------
        >>> from thrustwasher import solve_washer
        >>> result = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002)
        >>> found = result.sensitivities(["friction_torque"], per_percent=True)["friction_torque"]
        >>> f"{found['viscosity_constant']:.2g} N m for one percent more viscosity"
        '0.0077 N m for one percent more viscosity'
        """
        if self.grid == NO_MESH:
            raise ParameterError(
                f"fidelity = {self.fidelity!r} is a table, without derivatives over parameters; "
                "allowed: 'field' or 'fine'"
            )
        found = parameter_derivatives(self.solved(), outputs, parameters)
        return chosen_unit(self.params, per_percent, found)

    def solved(self) -> Solved:
        """Return what derivatives are taken of."""
        return Solved(self.params, self.grid, self.point(), self._state)

    def fields(self) -> WasherFields:
        """Return gap, pressures, temperatures and oil flow; it takes a level with a mesh."""
        if self.grid == NO_MESH:
            raise ParameterError(
                f"fidelity = {self.fidelity!r} has no fields; allowed: 'field' or 'fine'"
            )
        par = constants(self.params, self.grid)
        m = washer_model(par)
        (n_r, n_t), kept = self.grid, self._state
        work = work_array(("fields", self.grid), L.N_HEAD + size_of_work(n_r, n_t))
        w, inputs = workspace_of(par, work), np.array(self.point())
        f = fields_of(w)
        pressure = L.S_FIELDS + f.temp.size
        f.temp[:], f.p[:] = kept[L.S_FIELDS : pressure], kept[pressure:][: f.p.size]
        w.q[:] = kept[L.S_POSITIONS :][:4]
        point = point_of(par, inputs)
        evaluate_here(w, point)
        kernel.outputs_at(w, point)
        rows = np.empty(kernel.N_FIELDS * n_r * n_t + n_t)
        kernel.fill_fields(par, inputs, work, rows)
        over = rows[:-n_t].reshape(kernel.N_FIELDS, n_t, n_r).transpose(0, 2, 1).copy()
        outward, around = _liquid_flow(m, f)
        return WasherFields(
            radius=m.r.copy(),
            angle=rows[-n_t:].copy(),
            film_thickness=over[kernel.F_FILM],
            pressure=over[kernel.F_PRESSURE],
            contact_pressure=over[kernel.F_CONTACT],
            carrier_temperature=over[kernel.F_CARRIER],
            washer_temperature=over[kernel.F_WASHER],
            gear_temperature=over[kernel.F_GEAR],
            film_temperature=over[kernel.F_OIL],
            liquid_fraction=over[kernel.F_LIQUID],
            flow_outward=outward,
            flow_around=around,
        )


def result_of(
    params: WasherParams,
    point: Inputs,
    x: Sequence[float],
    tilts: Sequence[float],
    branch: str,
    distress: bool,
    status: Status,
    iterations: int,
    fidelity: str,
    grid: tuple[int, int],
    error: float | None,
    state: Array,
) -> WasherResult:
    """Return the result with the kernels' outputs ``x`` and the washer's tilts about x and y."""
    own = advised(point, x[L.O_PEAK], distress, status)

    def fill() -> dict[str, Any]:
        return {
            **{name: x[place] for name, place in PLACES.items()},
            "washer_tilt_x": tilts[0],
            "washer_tilt_y": tilts[1],
            "branch": branch,
            "distress": distress,
            "status": own,
            "iterations": iterations,
            "fidelity": fidelity,
            "grid": grid,
            "_error": error,
            **dict(zip(INPUTS, point, strict=True)),
            "params": params,
            "_state": state,
        }

    def say() -> tuple[str, ...]:
        return washer_warnings(params, point, x, distress, status)

    return WasherResult.later(fill, say, own)


def advised(point: Sequence[float], peak: float, distress: bool, status: Status) -> Status:
    """Return a status, or the advice in its place, as the kernel gives it in a step.

    ``peak`` is the temperature of the hottest spot [K].
    """
    if status is not Status.OK:
        return status
    if distress:
        return Status.DISTRESS
    if peak > L.HOT_LIMIT:
        return Status.HOT
    return Status.OK if _verified(point) else Status.OUTSIDE_VERIFIED


def _verified(point: Sequence[float]) -> bool:
    load, speed, tilt, oil, _ = point
    return (
        load <= LOAD[1] and abs(speed) <= SPEED[1] and tilt <= TILT[1] and OIL[0] <= oil <= OIL[1]
    )


def lost_text(ratio: float, rise: float) -> str:
    """Return the warning of a washer without a film: its film ratio and mean rise [K]."""
    return f"film_ratio = {ratio:.3g}, mean rise {rise:.0f} K: {Status.DISTRESS.advice}"


def washer_warnings(
    params: WasherParams, point: Sequence[float], x: Sequence[float], distress: bool, status: Status
) -> tuple[str, ...]:
    """Return the warnings of a solution with these outputs of the kernels."""
    load, speed, _, oil, far = point
    hot, ratio, margin = x[L.O_PEAK] > L.HOT_LIMIT, x[L.O_RATIO], x[L.O_STICK_MARGIN]
    dry = speed != 0.0 and ratio > FULL_FILM and x[L.O_CONTACT_LOAD] > 0.5 * load
    friction = friction_warning(params, x[L.O_CONTACT_LOAD], abs(x[L.O_TORQUE]))
    idle = idle_warnings(SPEC.key, params)
    if params.gear_far_face == "bulk" and far == 0.0:
        idle = (*idle, FAR_FACE)
    plain = not (hot or dry or distress or ratio < 0.0 or margin < 1.0)
    if plain and _verified(point) and not (status or friction):
        return idle
    more = [friction] if friction else []
    if distress:
        more.append(lost_text(ratio, x[L.O_MEAN] - oil))
    if dry:
        more.append(DRY.format(ratio, x[L.O_CONTACT_LOAD], load))
    if ratio < 0.0:
        more.append(PRESSED.format(1e6 * x[L.O_FILM]))
    if margin < 1.0:
        more.append(f"stick_margin = {margin:.3g}: {SLIPS.format(margin)}")
    inputs = dict(zip(INPUTS, point, strict=False))
    outputs = {"temperature_max": x[L.O_PEAK]}
    return (*idle, *warnings_of(SPEC, status, inputs, outputs, more))


def friction_warning(params: WasherParams, contact: float, torque: float) -> str:
    """Return a warning if contacts that count press outside the data of their dry friction.

    ``contact`` is the load that asperities carry [N], ``torque`` that of the washer [N m].
    """
    if params.friction_law != "load" or not contact > 0.0:
        return ""
    face = face_of(params.inner_radius, params.outer_radius)
    low, high = params.friction_pressure_min, params.friction_pressure_max
    pressure = contact / face
    if low * (1.0 - 1e-9) <= pressure <= high * (1.0 + 1e-9):
        return ""
    held = min(max(pressure, low), high)
    friction = params.friction_reference - params.friction_slope * math.log(held / 1e6)
    mean_radius = 0.5 * (params.inner_radius + params.outer_radius)
    if friction * contact * mean_radius < COUNTS * torque:
        return ""
    return BEYOND.format(low=low, high=high, pressure=pressure, friction=friction)


def _liquid_flow(m: WasherModel, f: Fields) -> tuple[Array, Array]:
    """Return the liquid's flow per width [m2/s] (n_r, n_theta) outward and around.

    It is the mean of the two faces next to a node; a node at a rim has one.
    """
    shape = len(m.cos), len(m.r)
    liquid = f.liquid.reshape(shape)
    heights = np.diff(m.r_face, prepend=m.r[0])
    around = f.flow_t.reshape(shape) / heights
    around = 0.5 * (around + np.roll(around, 1, axis=0))
    faces = f.flow_r.reshape(shape)[:, :-1] / (m.r_face[:-1] * m.width_t[:, None])
    outward = 0.5 * (faces[:, [0, *range(faces.shape[1])]] + faces[:, [*range(faces.shape[1]), -1]])
    return (liquid * outward).T.copy(), (liquid * around).T.copy()
