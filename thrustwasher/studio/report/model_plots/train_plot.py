"""A gear train: losses by source at a point, and over torque of either sign."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ....errors import SolveError
from ....train.solve import solve_train
from ....units import format_quantity
from ..palette import BLACK, BLUE, GREEN, ORANGE, PURPLE
from ..style import heading, label, new_figure, styled

SOURCES = {
    "mesh_loss": ("meshes", BLUE),
    "churning_loss": ("churning", ORANGE),
    "bearing_loss": ("bearings", GREEN),
    "seal_loss": ("seals", PURPLE),
}
MESHES, SHAFTS, BEARINGS = range(1, 4), range(1, 5), (1, 2)
SHARES = np.linspace(-1.25, 1.25, 51)  # of the torque


@styled
def train_figure(result: Any, point: Mapping[str, float], params: object) -> Figure:
    """Return the losses of each mesh, each shaft's bearings, seals, churning; all over torque."""
    figure, axes = new_figure(9.6, 4.3, 1, 2, head=1, left=1.6)
    bars = _bars(result)
    axes[0].barh(range(len(bars)), list(bars.values()), color=BLUE)
    axes[0].set_yticks(range(len(bars)), list(bars))
    axes[0].invert_yaxis()
    label(axes[0], "Losses by source", "loss [W]", "")
    torques = SHARES * (abs(point["torque"]) or 100.0)
    rows = [_losses(params, dict(point) | {"torque": torque}) for torque in torques.tolist()]
    names, colours = zip(*SOURCES.values(), strict=True)
    axes[1].stackplot(torques, np.transpose(rows), labels=names, colors=colours, alpha=0.6)
    axes[1].plot([point["torque"]], [result.loss], "o", color=BLACK)
    axes[1].set(xlim=(torques[0], torques[-1]), ylim=(0.0, None))
    axes[1].legend(loc="upper center")
    label(axes[1], "Over torque", "torque of the input shaft [N·m]", "loss [W]")
    loss, torque, speed, oil = (
        format_quantity(value, unit)
        for value, unit in (
            (result.loss, "W"),
            (point["torque"], "N.m"),
            (point["speed"], "rad/s"),
            (point["oil_temperature"], "K"),
        )
    )
    heading(figure, f"Gear train: {loss} at {torque}, {speed}, oil {oil}")
    return figure


def _bars(result: Any) -> dict[str, float]:
    """Return the loss of each source that is there."""
    meshes = {f"mesh {m}": getattr(result, f"mesh_{m}_loss") for m in MESHES}
    pairs = {
        f"bearings of shaft {s}": [getattr(result, f"shaft_{s}_bearing_{b}_loss") for b in BEARINGS]
        for s in SHAFTS
    }
    found = {name: loss for name, loss in meshes.items() if loss is not None}
    found |= {name: sum(pair) for name, pair in pairs.items() if None not in pair}
    return found | {"seals": result.seal_loss, "churning": result.churning_loss}


def _losses(params: object, point: Mapping[str, Any]) -> list[float]:
    """Return the losses by source at a point, NaN where the train locks itself."""
    try:
        result = solve_train(params, **point)
    except SolveError:
        return [np.nan] * len(SOURCES)
    return [getattr(result, name) for name in SOURCES]
