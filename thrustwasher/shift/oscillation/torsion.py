"""The torsional mode of a scene's driveline: eigenvalues of its small motions.

Small changes of sun, carrier and vehicle speed and of the shaft's twist, with the packs' torques
as slope times slip. What a master adds by handing capacities over once per step counts as a
complex factor on the slopes. A pack's slope is that of its own friction law, at states that a run
has recorded.
"""

import cmath
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...clutch.kernels.pack_friction import coefficient_slopes, viscous_slopes
from ...clutch.solve import prepare
from ...numerics.jit import Array

Matrix = NDArray[np.complex128]
HALVINGS = 40


def matrix(
    params: Any, slopes: Mapping[str, complex], held: tuple[str, ...] = (), vehicle: float = 0.0
) -> Matrix:
    """Return the matrix of small motions: rates of (gear set's speeds, vehicle, twist).

    Parameters
    ----------
    params : those of the transmission, with an elastic shaft
    slopes : change of a slipping pack's torque over its slip [N m s/rad]
    held : packs that stick
    vehicle : speed of the vehicle [rad/s], for the slope of the load; 0: it has none
    """
    r = params.ratio
    rows = {  # of each pack its slip, as a row over (sun, carrier)
        "clutch": np.array([(1.0 + r) / r, -(1.0 + r) / r]),
        "brake": np.array([-1.0 / r, (1.0 + r) / r]),
    }
    ring = params.drum_inertia * np.outer(rows["brake"], rows["brake"])
    mass = np.diag([params.input_inertia, params.carrier_inertia]) + ring
    basis = _free(rows, held)
    rub = sum((c * np.outer(rows[p], rows[p]) for p, c in slopes.items()), np.zeros((2, 2)))
    mass, rub = basis.T @ mass @ basis, basis.T @ rub @ basis
    carrier = basis[1]
    k, d, n = params.shaft_stiffness, params.shaft_damping, basis.shape[1]
    load = 2.0 * params.load_torque * abs(vehicle) / params.load_speed**2
    whole = np.zeros((n + 2, n + 2), complex)
    if n:
        shaft = np.linalg.solve(mass, carrier)
        whole[:n, :n] = -np.linalg.solve(mass, rub) - d * np.outer(shaft, carrier)
        whole[:n, n], whole[:n, n + 1] = d * shaft, -k * shaft
    whole[n, :n] = d * carrier / params.vehicle_inertia
    whole[n, n] = -(d + load) / params.vehicle_inertia
    whole[n, n + 1] = k / params.vehicle_inertia
    whole[n + 1, :n], whole[n + 1, n] = carrier, -1.0
    return whole


def _free(rows: Mapping[str, Array], held: tuple[str, ...]) -> Array:
    """Return the motions of (sun, carrier) that leave the packs held without slip, as columns."""
    if not held:
        return np.eye(2)
    if len(held) == 2:
        return np.zeros((2, 0))
    a, b = rows[held[0]]
    return np.array([[-b / a], [1.0]])


def torsional_mode(found: Matrix) -> complex | None:
    """Return the eigenvalue [1/s] of the mode, growth and frequency; None if there is none."""
    values = np.linalg.eigvals(found)
    top = values[int(np.argmax(values.imag))]
    return complex(top) if top.imag > 1e-9 * abs(top) else None


def damping_limit_of(
    params: Any, slopes: Mapping[str, float], held: tuple[str, ...] = (), vehicle: float = 0.0
) -> float:
    """Return the damping of the shaft [N m s/rad] at which the mode neither grows nor decays.

    0 if no damping is needed. For one slipping pack with the other open and no load there is a
    closed form (``tests/closed_forms/torsional_stability.py``).
    """

    def grows(damping: float) -> bool:
        mode = torsional_mode(matrix(replace(params, shaft_damping=damping), slopes, held, vehicle))
        return mode is not None and mode.real > 0.0

    if not grows(0.0):
        return 0.0
    low, high = 0.0, 1e-3
    while grows(high):
        low, high = high, 2.0 * high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if grows(middle) else (low, middle)
    return 0.5 * (low + high)


def handed_over(angle: float, age: int, extrapolated: bool) -> complex:
    """Return how a signal that oscillates arrives when it is handed over once per step.

    Of an oscillation exp(i angle n) at the points n, ``age`` steps old, the part of the same
    frequency in what the receiver makes of it between the points: the last value, or a straight
    line through the last two. 1 in the limit of short steps; the real part acts as friction, the
    imaginary one as a spring.
    """
    mean, first = _moments(angle)
    late = cmath.exp(-1j * angle * age)
    if not extrapolated:
        return late * mean
    return late * (mean + (1.0 - cmath.exp(-1j * angle)) * (first + age * mean))


def _moments(angle: float) -> tuple[complex, complex]:
    """Return the means of exp(-i angle x) and of x exp(-i angle x) over x from 0 to 1."""
    if abs(angle) < 1e-3:  # series: the closed forms lose their digits
        return 1.0 - 0.5j * angle - angle**2 / 6.0, 0.5 - 1j * angle / 3.0 - angle**2 / 8.0
    z = -1j * angle
    whole = (cmath.exp(z) - 1.0) / z
    return whole, (cmath.exp(z) - whole) / z


def capacity_slopes(
    params: Any, fidelity: str, pack: str, signals: Mapping[str, Array], where: NDArray[np.intp]
) -> Array:
    """Return the slope of the capacity over the size of the slip [N m s/rad] at recorded points.

    Film and temperature are those of the record and do not follow within a period: they are slower.
    With the level ``fine``, whose rings have speeds and temperatures of their own, it is the slope
    at the mean radius and the mean temperature.
    """
    par = prepare(params, fidelity)
    names = ("speed", "temperature", "film_ratio", "torque_capacity", "viscous_torque")
    columns = (signals[f"{pack}.{name}"][where].tolist() for name in names)
    slopes = []
    for slip, temperature, film, capacity, viscous in zip(*columns, strict=True):
        mu, _, steepness = coefficient_slopes(par, slip, temperature)
        slope = (capacity - abs(viscous)) * steepness / mu if mu > 0.0 else 0.0
        if viscous:
            full, _, _, by_slip, *_ = viscous_slopes(par, slip, 0.0, film, temperature)
            slope += abs(viscous) / full * by_slip
        slopes.append(slope)
    return np.array(slopes)
