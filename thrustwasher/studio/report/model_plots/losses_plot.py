"""Driveline losses: heat by source while all speeds change together, and over the oil."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ....losses.solve import solve_losses
from ....units import format_quantity
from ..palette import BLACK, BLUE, CELSIUS, GREEN, ORANGE, PURPLE
from ..style import heading, label, new_figure, styled

SOURCES = {
    "pump_power": ("pump", BLUE),
    "churning_power": ("churning", ORANGE),
    "bearing_power": ("bearings", GREEN),
    "seal_power": ("seals", PURPLE),
}
FACTORS = np.linspace(0.0, 1.5, 61)
OILS = np.linspace(253.15, 423.15, 69)


@styled
def losses_figure(result: Any, point: Mapping[str, float], params: object) -> Figure:
    """Return heat by source, stacked, over all speeds together and over the oil's temperature."""
    speeds = [name for name in point if name.endswith("_speed")]
    given: dict[str, Any] = dict(point)
    faster = [given | {name: f * point[name] for name in speeds} for f in FACTORS]
    warmer = [given | {"oil_temperature": t} for t in OILS]
    oil = point["oil_temperature"] - CELSIUS
    figure, axes = new_figure(9.6, 4.3, 1, 2, head=1)
    for axis, x, points, here, words, over in (
        (axes[0], FACTORS, faster, 1.0, "all speeds over those given [1]", "Over speed"),
        (axes[1], OILS - CELSIUS, warmer, oil, "oil temperature [°C]", "Over the oil"),
    ):
        rows = [solve_losses(params, **p) for p in points]
        heats = [[getattr(r, name) for r in rows] for name in SOURCES]
        names, colours = zip(*SOURCES.values(), strict=True)
        axis.stackplot(x, heats, labels=names, colors=colours, alpha=0.6)
        axis.plot([here], [result.oil_heat], "o", color=BLACK)
        axis.set(xlim=(x[0], x[-1]), ylim=(0.0, None), xlabel=words)
        label(axis, over, "", "heat [W]")
    axes[0].legend(loc="upper left")
    heading(
        figure,
        f"Driveline losses: {format_quantity(result.oil_heat, 'W')} at input speed "
        f"{format_quantity(point['input_speed'], 'rad/s')}, tooth force "
        f"{format_quantity(point['tooth_force'], 'N')}, oil "
        f"{format_quantity(point['oil_temperature'], 'K')}",
    )
    return figure
