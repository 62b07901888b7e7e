"""What a calibration may be asked: names, points and confidence, checked one by one."""

import difflib
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...errors import ParameterError
from ...numerics.jit import Array
from ..parameters import LOAD, SPEED, ClutchParams
from .friction_law import CONSTANT_LAW, constants_of, friction_radius, law_values
from .least_squares import Problem, bounds_of

LARGEST_FRICTION = 2.0
SPEEDS = ("stick_speed", "decay_speed")


class Points(NamedTuple):
    """Measured points, all arrays of one length."""

    slip_speed: Array
    """[m/s] at the friction radius, not negative."""
    load: Array
    friction: Array
    weight: Array


def checked_names(params: ClutchParams, fit: Sequence[str]) -> tuple[str, ...]:
    """Return the names to fit, or say which one cannot be."""
    names = (fit,) if isinstance(fit, str) else tuple(fit)
    acting = constants_of(params)
    if not acting:
        raise ParameterError(
            f"friction_law = {params.friction_law!r}: its points are the measurement itself, there "
            "is nothing to fit; allowed: 'wang' or 'constant'"
        )
    allowed = f"allowed under friction_law {params.friction_law!r}: {', '.join(acting)}"
    if not names:
        raise ParameterError(f"fit names nothing, {allowed}")
    for name in names:
        if name == "load":
            raise ParameterError(
                f"fit = 'load': the friction law does not depend on load; {allowed}"
            )
        if name not in acting:
            near = difflib.get_close_matches(str(name), acting, n=1)
            hint = f"did you mean {near[0]}? " if near else ""
            raise ParameterError(f"fit = {name!r}, {hint}{allowed}")
        if names.count(name) > 1:
            raise ParameterError(f"fit names {name} twice")
    return names


def checked_points(
    params: ClutchParams,
    speed: ArrayLike,
    load: ArrayLike,
    friction: ArrayLike,
    friction_error: ArrayLike | None,
) -> Points:
    """Return the points as arrays, or name the first value that cannot be used."""
    mu = _column("friction", friction, "", -LARGEST_FRICTION, LARGEST_FRICTION)
    count = len(mu)
    slip = _column("speed", speed, "rad/s", SPEED.low or 0.0, SPEED.high or 0.0, count, False)
    force = _column("load", load, "N", 0.0, LOAD.high or 0.0, count)
    weight = np.ones(count)
    if friction_error is not None:
        error = _column("friction_error", friction_error, "", 0.0, LARGEST_FRICTION, count)
        weight = 1.0 / _above_zero("friction_error", error, "")
    if mu.mean() <= 0.0:
        raise ParameterError(
            f"friction is {mu.mean():.3g} on average, allowed: above 0 (for either sign of speed)"
        )
    return Points(
        np.abs(slip) * friction_radius(params), _above_zero("load", force, "N"), mu, weight
    )


def checked_start(
    params: ClutchParams, names: tuple[str, ...], points: Points, confidence: float
) -> tuple[Problem, Array]:
    """Return the problem to solve and the values to start from."""
    if not isinstance(confidence, int | float) or not 0.0 < confidence < 1.0:
        raise ParameterError(f"confidence = {confidence!r}, allowed: above 0 and below 1")
    low, high = bounds_of(names)
    base = law_values(params)
    fastest = float(points.slip_speed.max()) or 1.0
    scale = np.array([fastest if name in SPEEDS else 1.0 for name in names])
    if names == CONSTANT_LAW:
        scale[0] = float(points.friction.mean())
    problem = Problem(
        base, names, points.slip_speed, points.friction, points.weight, low, high, scale,
        names == CONSTANT_LAW,
    )  # fmt: skip
    return problem, np.array([base[name] for name in names])


def _column(
    name: str, values: ArrayLike, unit: str, low: float, high: float, count: int = 0,
    scalar: bool = True,
) -> Array:  # fmt: skip
    """Return a finite one-dimensional array in range; one value serves all points if allowed."""
    try:
        array = np.asarray(values, float)
    except (TypeError, ValueError):
        raise ParameterError(f"{name}: numbers{_in(unit, ' in')} are wanted") from None
    if array.ndim == 0 and count and scalar:
        array = np.full(count, float(array))
    if array.ndim != 1 or len(array) == 0:
        raise ParameterError(f"{name} has shape {array.shape}, allowed: one value per point")
    if count and len(array) != count:
        raise ParameterError(f"{name} has {len(array)} values, friction has {count}")
    bad = ~((array >= low) & (array <= high))
    if bad.any():
        i = int(np.argmax(bad))
        span = f"allowed: {low:g} .. {high:g} {unit}".rstrip()
        raise ParameterError(f"{name}[{i}] = {float(array[i])!r}{_in(unit)}, {span}")
    return array


def _above_zero(name: str, array: Array, unit: str) -> Array:
    """Return the array, or name its first zero."""
    if (array == 0.0).any():
        i = int(np.argmax(array == 0.0))
        raise ParameterError(f"{name}[{i}] = 0{_in(unit)}, allowed: above 0")
    return array


def _in(unit: str, word: str = "") -> str:
    return f"{word} {unit}" if unit else ""
