"""What a washer solve returns, and the error to expect of it."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..errors import ParameterError, Status
from ..ladder.card import error_estimate
from ..numerics.jit import Array
from ..tribology.asperities import contact_pressure
from .kernel_arguments import NO_MESH, SIMPLE, constants
from .kernels import layout as L
from .kernels.constants import WasherModel, washer_model
from .parameters import WasherParams

BRANCHES = {"film": L.FILM_BRANCH, "contact": L.CONTACT_BRANCH}  # that one can ask for
BRANCH_NAMES = {L.FILM_BRANCH: "film", L.UNSTABLE: "unstable", L.CONTACT_BRANCH: "contact"}


@dataclass(frozen=True, slots=True)
class WasherFields:
    """Fields over the washer; two-dimensional ones are (n_r, n_theta)."""

    radius: Array  # (n_r,) [m]
    angle: Array  # (n_theta,) [rad]
    film_thickness: Array  # [m] separation of the mean surfaces of film 1
    pressure: Array  # [Pa] in the film
    contact_pressure: Array  # [Pa] on the asperities, per nominal area
    carrier_temperature: Array  # [K]
    washer_temperature: Array  # [K]
    film_temperature: Array  # [K] mean of carrier and washer


@dataclass(frozen=True, slots=True)
class Fold:
    """Where two branches meet and end."""

    kind: str  # "film_lost" (load rising) or "film_regained" (load falling)
    load: float  # [N]
    film_ratio: float  # [-]
    temperature: float  # [K]
    friction_torque: float  # [N m]


@dataclass(frozen=True, slots=True)
class WasherResult:
    """Steady state of the washer at one operating point; SI units."""

    friction_torque: float  # [N m] sign of speed
    temperature: float  # [K] area mean of the film temperature
    temperature_max: float  # [K] of carrier and washer
    film_thickness: float  # [m] least separation of the mean surfaces of film 1
    film_ratio: float  # [-] film_thickness over sigma
    fluid_load: float  # [N]
    contact_load: float  # [N]
    friction_coefficient: float  # [-]
    washer_tilt_x: float  # [rad]
    washer_tilt_y: float  # [rad]
    branch: str  # "film", "unstable" or "contact"
    distress: bool
    status: Status
    iterations: int
    fidelity: str
    grid: tuple[int, int]
    error_estimate: float  # [-] relative, of friction_torque; see ErrorEstimate
    load: float  # [N] as solved for
    speed: float  # [rad/s]
    tilt: float  # [rad]
    oil_temperature: float  # [K]
    params: WasherParams = field(repr=False, compare=False)
    _state: Array = field(repr=False, compare=False)

    def fields(self) -> WasherFields:
        """Return gap, pressures and temperatures over the washer; it takes a rung with a mesh."""
        if self.grid == NO_MESH:
            raise ParameterError(
                f"fidelity = {self.fidelity!r} has no fields; allowed: 'coarse', 'field' or 'fine'"
            )
        m = washer_model(constants(self.params, self.grid))
        n_r, n_t = self.grid
        m_t = 3 * n_r - m.i_g
        kept = self._state[L.S_FIELDS :]
        column = kept[: m_t * n_t].reshape(n_t, m_t).T
        pressure = kept[m_t * n_t :][: n_r * n_t].reshape(n_t, n_r).T
        gap = film_gap(m.r, m.cos, m.sin, self._state[L.S_POSITIONS :])
        carrier = self.oil_temperature + column[:n_r]
        washer = self.oil_temperature + column[n_r : 2 * n_r]
        return WasherFields(
            radius=m.r.copy(),
            angle=np.mod(np.arctan2(m.sin, m.cos), 2.0 * np.pi),
            film_thickness=gap,
            pressure=pressure.copy(),
            contact_pressure=contact_field(gap, m),
            carrier_temperature=carrier,
            washer_temperature=washer,
            film_temperature=0.5 * (carrier + washer),
        )


class Unread(float):
    """The error of a rung in general; the card may know better for the point at hand."""


class ErrorEstimate:
    """The field ``error_estimate`` of a result: its card is asked when somebody wants to know.

    That takes longer than many a solve, and most solves in a loop are never asked.
    """

    def __init__(self, field: Any) -> None:
        self.field = field

    def __get__(self, result: WasherResult | None, owner: object = None) -> Any:
        """Return the error; the card is looked at once."""
        if result is None:
            return self.field
        value = self.field.__get__(result)
        if type(value) is Unread:
            known = card_error(result)
            value = float(value) if known is None else known
            self.field.__set__(result, value)
        return value

    def __set__(self, result: WasherResult, value: float) -> None:
        """Keep the error."""
        self.field.__set__(result, value)


_field = WasherResult.__dict__["error_estimate"]
setattr(WasherResult, "error_estimate", ErrorEstimate(_field))  # noqa: B010


def card_error(result: WasherResult) -> float | None:
    """Return the error that the card of a result's rung gives for its point.

    None without a fresh card for these parameters, and outside its box. Rungs that know one branch
    only are judged by the worst of all branches.
    """
    point = {
        "load": result.load, "speed": result.speed, "tilt": result.tilt,
        "oil_temperature": result.oil_temperature,
    }  # fmt: skip
    branch = None if result.fidelity in SIMPLE else result.branch
    return error_estimate(
        "washer", result.fidelity, result.params, point, branch=branch,
        film_ratio=None if branch is None else result.film_ratio,
    )  # fmt: skip


def result_of(
    params: WasherParams, point: tuple[float, float, float, float], x: Sequence[float],
    tilts: Sequence[float], branch: str, distress: bool, status: Status, iterations: int,
    fidelity: str, grid: tuple[int, int], error: float, state: Array,
) -> WasherResult:  # fmt: skip
    """Return the result with the kernels' outputs ``x`` and the washer's tilts about x and y."""
    return WasherResult(
        x[L.O_TORQUE], x[L.O_MEAN], x[L.O_PEAK], x[L.O_FILM], x[L.O_RATIO], x[L.O_FLUID_LOAD],
        x[L.O_CONTACT_LOAD], x[L.O_COEFFICIENT], tilts[0], tilts[1], branch, distress, status,
        iterations, fidelity, grid, error, *point, params, state,
    )  # fmt: skip


def film_gap(radius: Array, cos: Array, sin: Array, q: Array) -> Array:
    """Return h1 [m] (n_r, n_theta) at the positions q."""
    slope = sin * q[L.TILT_X] - cos * q[L.TILT_Y]
    return np.asarray(q[L.Z_WASHER] + np.outer(radius, slope))


def contact_field(gap: Array, m: WasherModel) -> Array:
    """Return the asperity pressure [Pa] at the gaps of film 1."""
    flat = [
        contact_pressure((h - m.mean_summit1) / m.summit_sigma1, m.table1)[0] for h in gap.ravel()
    ]
    return np.array(flat).reshape(gap.shape)
