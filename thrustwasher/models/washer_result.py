"""What a washer solve returns."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, Status
from ..kernels.asperities import contact_pressure
from ..kernels.washer_memory import FIELDS, Q
from ..kernels.washer_model import WasherModel, washer_model
from .washer_constants import NO_MESH, constants
from .washer_error import ErrorEstimate
from .washer_params import WasherParams

Array = NDArray[np.float64]


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
    error_estimate: float  # [-] relative, of friction_torque; see washer_error.ErrorEstimate
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
        column = self._state[FIELDS : FIELDS + m_t * n_t].reshape(n_t, m_t).T
        pressure = self._state[FIELDS + m_t * n_t :][: n_r * n_t].reshape(n_t, n_r).T
        gap = film_gap(m.r, m.cos, m.sin, self._state[Q : Q + 4])
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


_field = WasherResult.__dict__["error_estimate"]
setattr(WasherResult, "error_estimate", ErrorEstimate(_field))  # noqa: B010


def film_gap(radius: Array, cos: Array, sin: Array, q: Array) -> Array:
    """Return h1 [m] (n_r, n_theta) at the positions q = (z_w, z_g, gx, gy)."""
    return np.asarray(q[0] + np.outer(radius, sin * q[2] - cos * q[3]))


def contact_field(gap: Array, m: WasherModel) -> Array:
    """Return the asperity pressure [Pa] at the gaps of film 1."""
    flat = [
        contact_pressure((h - m.mean_summit1) / m.summit_sigma1, m.table1)[0] for h in gap.ravel()
    ]
    return np.array(flat).reshape(gap.shape)
