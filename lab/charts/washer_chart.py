"""The chart of the washer: levels and meshes."""

from functools import partial

import numpy as np

from lab.charts.chart_series import KELVIN, WARM, Chart, Configuration, Quantity, levels
from lab.charts.methods import KernelMethod
from thrustwasher.model.spec import ModelSpec
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels.layout import N_HEAD
from thrustwasher.washer.kernels.workspace import size_of_state, size_of_work

GRIDS = ((7, 20), (9, 24), (10, 32), (13, 40), (16, 48), (19, 64), (28, 96))


class MeshMethod(KernelMethod):
    """The washer's kernel on a mesh of your own."""

    def __init__(self, spec: ModelSpec, grid: tuple[int, int]) -> None:
        super().__init__(spec, "field")
        self._par, self._n_state = constants(spec.params(), grid), size_of_state(*grid)
        self._work = np.zeros(N_HEAD + size_of_work(*grid))
        self._nodes = grid[0] * grid[1]


def _washer(spec: ModelSpec, *, quick: bool = False) -> list[Configuration]:
    """Return levels, and meshes from coarse to fine."""
    meshes = [
        Configuration(
            "mesh of the package",
            f"{r} x {t}",
            "grid",
            f"{r}x{t}",
            partial(MeshMethod, spec, (r, t)),
            "Newton iterations x nodes",
        )
        for r, t in (GRIDS[::3] if quick else GRIDS)
    ]
    return [*levels(spec), *meshes]


WASHER = Chart((Quantity("friction_torque", True, 1e-3), KELVIN), WARM, _washer)
