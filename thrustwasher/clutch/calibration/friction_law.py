"""The clutch's friction law over its constants: values, derivatives, shear of the settled film."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...numerics.jit import Array
from ..kernels.pack_friction import ploughing, settled_slope, viscous_slopes
from ..parameters import ClutchParams
from ..solve import prepare

SHAPE = ("plough_weight", "shear_floor", "stick_speed", "decay_speed")
WANG_CONSTANTS = (*SHAPE, "hardness_ratio", "indentation")
CONSTANT_LAW = ("constant_friction",)
STEEPEST = 1.0 - 1e-9  # the derivative over the indentation is infinite at 1


def law_values(params: ClutchParams) -> dict[str, float]:
    """Return every number the law depends on, by the name of its parameter."""
    names = (*WANG_CONSTANTS, *CONSTANT_LAW, "kink_width", "adhesion_factor")
    return {name: float(getattr(params, name)) for name in names}


def settled_shear(params: ClutchParams, slip: Array, load: Array, oil: Array) -> Array:
    """Return what shear of the settled film's oil adds to the coefficient [-] of a pack.

    ``slip`` [rad/s], ``load`` [N], temperature of the oil [K], one value per point.
    """
    par = prepare(params, "field")
    lever = params.faces * params.friction_radius * load
    points = zip(slip.tolist(), load.tolist(), oil.tolist(), strict=True)
    torque = [
        viscous_slopes(par, w, 0.0, settled_slope(par, f, 1.0)[0], t)[0] for w, f, t in points
    ]
    return np.asarray(np.array(torque) / lever)


def shares(values: Mapping[str, float]) -> tuple[float, float]:
    """Return (ploughing share P(x) for weight 1, adhesive share D at full shear strength) [-]."""
    x = values["indentation"]
    root = math.sqrt((1.0 - x) * (1.0 + x))
    hardness = values["hardness_ratio"] / values["adhesion_factor"]
    return float(ploughing(x)), 4.0 / (math.pi * hardness * (1.0 + root))


def end_frictions(values: Mapping[str, float]) -> tuple[float, float]:
    """Return the coefficient at rest and the one at very high slip [-].

    These two numbers are all that plough weight, shear floor, hardness ratio and indentation do to
    the curve: k P(x) + D(x, N) and k P(x) + D(x, N) S_inf.
    """
    plough, adhesion = shares(values)
    base = values["plough_weight"] * plough
    return base + adhesion, base + adhesion * values["shear_floor"]


def friction_over(values: Mapping[str, float], speed: Array, constant: bool = False) -> Array:
    """Return the coefficient [-] at slip speeds [m/s] at the friction radius, none negative.

    Notes
    -----
    Source: Wang, Wei & Wu (2012), Eq 12; the same numbers as the kernels' at the reference
    temperature, over arrays.
    """
    if constant:
        return np.full(speed.shape, values["constant_friction"])
    at_rest, at_speed = end_frictions(values)
    return at_speed + (at_rest - at_speed) * _decay(values, speed)[0]


def friction_slopes(values: Mapping[str, float], speed: Array, names: Sequence[str]) -> Array:
    """Return the derivatives of ``friction_over`` over the named constants, (points, names).

    At the sharp corner the derivative over stick_speed is that from below it.
    """
    if tuple(names) == CONSTANT_LAW:
        return np.ones((len(speed), 1))
    x, floor, hardness = (values[n] for n in ("indentation", "shear_floor", "hardness_ratio"))
    plough, adhesion = shares(values)
    decay, by_stick, by_decay = _decay(values, speed)
    shear = floor + (1.0 - floor) * decay
    x = min(x, STEEPEST)
    root = math.sqrt((1.0 - x) * (1.0 + x))
    plough_by_x = 4.0 / (math.pi * root) - 2.0 * plough / x
    fall = adhesion * (1.0 - floor)
    slopes: dict[str, Any] = {
        "plough_weight": plough,
        "shear_floor": adhesion * (1.0 - decay),
        "stick_speed": fall * by_stick,
        "decay_speed": fall * by_decay,
        "hardness_ratio": -adhesion * shear / hardness,
        "indentation": values["plough_weight"] * plough_by_x
        + adhesion * shear * x / (root * (1.0 + root)),
    }
    return np.column_stack([np.broadcast_to(slopes[name], speed.shape) for name in names])


def _decay(values: Mapping[str, float], speed: Array) -> tuple[Array, Array, Array]:
    """Return exp(-beyond/decay_speed) and its derivatives over stick_speed and decay_speed."""
    width, length = values["kink_width"], values["decay_speed"]
    beyond = speed - values["stick_speed"]
    if width > 0.0:
        u = beyond / width
        beyond = np.where(u < 30.0, width * np.logaddexp(0.0, np.minimum(u, 30.0)), beyond)
        active = 1.0 / (1.0 + np.exp(-np.clip(u, -700.0, 700.0)))
    else:
        active = (beyond > 0.0).astype(float)
        beyond = np.maximum(beyond, 0.0)
    decay = np.exp(-np.minimum(beyond / length, 700.0))
    return decay, decay * active / length, decay * beyond / length**2
