"""Made-up washer results with the face of the real ones: fast input for plots and commands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from thrustwasher.errors import Status

SIGMA = 7.2832e-7


@dataclass(frozen=True)
class Fields:
    radius: np.ndarray
    angle: np.ndarray
    film_thickness: np.ndarray
    pressure: np.ndarray
    contact_pressure: np.ndarray
    carrier_temperature: np.ndarray
    washer_temperature: np.ndarray
    film_temperature: np.ndarray
    liquid_fraction: np.ndarray
    flow_outward: np.ndarray
    flow_around: np.ndarray


@dataclass(frozen=True)
class Washer:
    load: float = 300.0
    friction_torque: float = 0.232072
    temperature: float = 316.6217
    temperature_max: float = 330.391
    film_thickness: float = 15.389 * SIGMA
    film_ratio: float = 15.389
    fluid_load: float = 300.0
    contact_load: float = 0.0
    friction_coefficient: float = 0.0440443
    friction_power: float = 221.2
    oil_flow: float = 6.4e-6
    throughflow_heat: float = 99.5
    oil_heat: float = 221.2
    oil_outlet_temperature: float = 306.3
    film_temperature: float = 312.0
    stick_margin: float = 3.9
    washer_tilt_x: float = -1.9e-5
    washer_tilt_y: float = 1.98e-3
    branch: str = "film"
    distress: bool = False
    status: Status = Status.OK
    iterations: int = 5
    fidelity: str = "field"
    grid: tuple[int, int] = (9, 32)
    error_estimate: float = 0.006

    def fields(self) -> Fields:
        r = np.linspace(0.0111, 0.0227, 9)
        a = np.arange(32) * 2.0 * np.pi / 32
        h = self.film_thickness + 2e-4 * (r[-1] - r[:, None] * np.cos(a))
        p = 2e6 * np.sin(np.pi * (r - r[0]) / (r[-1] - r[0]))[:, None] * np.maximum(np.sin(a), 0.0)
        t = self.temperature + 10.0 * np.cos(a) * (r / r[-1])[:, None] ** 2
        liquid = np.ones((9, 1)) * np.where(np.sin(a) < 0.0, 0.6, 1.0)
        around = 0.5 * 953.0 * r[:, None] * h * liquid
        contact = np.where(h < 3 * SIGMA, 1e6, 0.0)
        return Fields(r, a, h, p, contact, t, t, t, liquid, 0.2 * around, around)


@dataclass(frozen=True)
class Fold:
    kind: str
    load: float
    film_ratio: float
    temperature: float
    friction_torque: float


@dataclass(frozen=True)
class Curve:
    points: tuple[Washer, ...]
    folds: tuple[Fold, ...]


def curve() -> Curve:
    """Return an S-shaped curve with the published shape of the one at 545 rad/s."""
    points = []
    for x in np.linspace(2.6, -1.6, 61):  # x: logarithm of the film ratio
        ratio = float(np.exp(x))
        load = 600.0 - 420.0 * np.sin(1.9 * (x - 0.25)) + 350 * max(-x, 0)
        load = float(max(load, 20.0)) if x < 1.9 else float(700.0 * np.exp(-(x - 1.0)))
        branch = "film" if x > 0.97 else ("unstable" if x > 0.2 else "contact")
        points.append(
            Washer(
                load=load,
                film_ratio=ratio,
                film_thickness=ratio * SIGMA,
                branch=branch,
                friction_torque=0.1 + 2.0 / (1 + ratio),
                temperature=300 + 80 / (1 + ratio),
                friction_coefficient=0.02 + 0.1 / (1 + ratio**2),
            )
        )
    folds = (
        Fold("film_lost", 775.2, 2.65, 310.2, 0.2787),
        Fold("film_regained", 441.3, 1.22, 345.0, 1.072),
    )
    return Curve(tuple(points), folds)
