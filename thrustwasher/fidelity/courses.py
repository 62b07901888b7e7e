"""The engagement that clutch rungs are compared in: the force rises, the slip falls."""

from __future__ import annotations

from typing import Any

import numpy as np

from .truths import Values

# s; the film is squeezed out in the first of these points, the lining heats up until the last
TIMES = (0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6)
RISE, HELD, LEFT = 0.1, 0.2, 0.05  # s of the force; s of full slip; share of the slip at the end


def course(load: float, speed: float) -> tuple[Any, Any, Any]:
    """Return time [s], force [N] and slip [rad/s] of the engagement."""
    t = np.array(TIMES)
    fallen = np.clip((t - HELD) / (t[-1] - HELD), 0.0, 1.0)
    return t, load * np.minimum(t / RISE, 1.0), speed * (1.0 - (1.0 - LEFT) * fallen)


def engagement(params: Any, fidelity: str, point: dict[str, float]) -> Values:
    """Return torque, temperature and film over time of a rung."""
    from ..models.clutch_engagement import engage_clutch

    time, load, speed = course(point["load"], point["speed"])
    e = engage_clutch(
        params, time=time, load=load, speed=speed, oil_temperature=point["oil_temperature"],
        fidelity=fidelity,
    )  # fmt: skip
    return {
        "friction_torque": e.friction_torque.tolist(), "temperature": e.temperature.tolist(),
        "film_thickness": e.film_thickness.tolist(), "film_ratio": e.film_ratio.tolist(),
    }  # fmt: skip
