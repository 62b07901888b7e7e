"""Which thermal mode a washer needs in a shift: its time constants beside the shift's."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ..units import format_quantity as say
from ..washer.closed_forms import stack_times
from ..washer.kernels.ladder import SHARES, TIMES
from ..washer.parameters import WasherParams

SLOW = 5.0  # a change that takes so many of the slowest time constants is followed by steady states
MIDDLE = (0.1, 0.9)  # share of all change of power that counts


def body_times(params: WasherParams, gap: float) -> tuple[float, float]:
    """Return the shortest and the longest time [s] in which a washer's bodies settle.

    The films are ``gap`` [m] thick.
    """
    p = params

    def of(body: str, name: str) -> float:
        """Return a body's own property, that of all bodies if it has none."""
        return float(getattr(p, f"{name}_{body}") or getattr(p, name))

    across = gap / p.oil_conductivity + 0.5 * p.washer_thickness / of("washer", "conductivity")
    times = stack_times(
        tuple(of(b, "conductivity") / getattr(p, f"{b}_thickness") for b in ("carrier", "gear")),
        tuple(of(b, "density") * of(b, "specific_heat") * getattr(p, f"{b}_thickness")
              for b in ("carrier", "washer", "gear")),
        across, across,
        ((1.0, 1.0),) if p.body_storage == "lumped" else tuple(zip(SHARES, TIMES, strict=True)),
    )  # fmt: skip
    return times[0], times[-1]


def change_time(time: NDArray[np.float64], power: NDArray[np.float64]) -> float:
    """Return the time [s] that the middle 80 % of all changes of a power take; inf without any."""
    steps = np.abs(np.diff(power))
    total = float(steps.sum())
    if not total > 0.0:
        return float("inf")
    share = np.concatenate(([0.0], np.cumsum(steps) / total))
    first, last = (int(np.argmax(share >= x)) for x in MIDDLE)
    return float(max(time[last] - time[max(first - 1, 0)], time[1] - time[0]))


def thermal_need(
    params: WasherParams, time: NDArray[np.float64], signals: Mapping[str, NDArray[np.float64]]
) -> str:
    """Say which thermal mode the washer needs and which one ran."""
    gap = max(float(np.median(signals["film_thickness"])), params.roughness)
    quickest, slowest = body_times(params, gap)
    change = change_time(time, signals["friction_power"])
    transient = params.thermal_mode == "transient"
    span = f"the washer's bodies settle within {quickest:.2g} .. {slowest:.2g} s"
    if not np.isfinite(change):
        return f"{span}; its friction power does not change: steady temperatures are right"
    stretch = f"{span}, its friction power changes within {say(change, 's', digits=2)}"
    if change < SLOW * slowest:
        if transient:
            return f"{stretch}: thermal_mode transient is needed here, and it ran"
        return (
            f"{stretch}: its temperatures here are those of steady states, an upper bound while it "
            'warms up; [washer] thermal_mode = "transient" follows them'
        )
    if transient:
        return f"{stretch}: thermal_mode quasi_steady would do here, and costs less"
    return f"{stretch}: steady temperatures are right"
