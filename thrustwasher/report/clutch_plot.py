"""Friction of a wet pack against slip speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.figure import Figure

from ..units import format_quantity
from .style import BLACK, BLUE, RED, label, new_figure, styled


@styled
def clutch_figure(
    speeds: Sequence[float], sweep: Sequence[Any], result: Any, point: Mapping[str, float]
) -> Figure:
    """Return coefficient and torque over slip speed, with the operating point marked.

    Parameters
    ----------
    speeds : slip speeds [rad/s]
    sweep : clutch results at these speeds
    result : the clutch result at ``point``
    point : load [N], speed [rad/s], oil_temperature [K]
    """
    figure, axes = new_figure(9.6, 4.0, 1, 2)
    panels = (
        ("friction_coefficient", "Friction coefficient", "friction coefficient [1]", BLUE),
        ("friction_torque", "Friction torque of the pack", "friction torque [N·m]", RED),
    )
    for axis, (name, title, up, colour) in zip(axes, panels, strict=True):
        axis.plot(speeds, [getattr(r, name) for r in sweep], color=colour)
        axis.plot([abs(point["speed"])], [abs(getattr(result, name))], "o", color=BLACK, zorder=5)
        label(axis, title, "slip speed [rad/s]", up)
        axis.set_xlim(left=0.0)
        axis.set_ylim(bottom=0.0)
        axis.margins(y=0.1)
    figure.suptitle(
        f"Wet friction pack pressed with {format_quantity(point['load'], 'N')}, "
        f"oil {format_quantity(point['oil_temperature'], 'K')}; "
        f"dot: {abs(point['speed']):.4g} rad/s, {format_quantity(result.friction_torque, 'N.m')}"
    )
    return figure
