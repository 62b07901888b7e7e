"""The chart of the washer: operating points on both branches, meshes."""

from functools import partial

import numpy as np

from ...model.spec import ModelSpec
from ...washer.kernel_arguments import constants
from ...washer.kernels.layout import N_HEAD
from ...washer.kernels.workspace import size_of_state, size_of_work
from .chart_series import KELVIN, WARM, Chart, Configuration, Quantity, Settings, rungs, series
from .methods import ChartCase, KernelMethod

GRIDS = ((7, 20), (9, 24), (10, 32), (13, 40), (16, 48), (19, 64), (28, 96))
OIL = 297.15


class MeshMethod(KernelMethod):
    """The washer's kernel on a mesh of one's own."""

    def __init__(self, spec: ModelSpec, grid: tuple[int, int]) -> None:
        super().__init__(spec, "field")
        self._par, self._n_state = constants(spec.params(), grid), size_of_state(*grid)
        self._work = np.zeros(N_HEAD + size_of_work(*grid))
        self._nodes = grid[0] * grid[1]


def _washer(spec: ModelSpec, *, quick: bool = False) -> list[Configuration]:
    """Return rungs, and meshes from coarse to fine."""
    meshes: Settings = (
        (f"{r} x {t}", f"{r}x{t}", partial(MeshMethod, spec, (r, t)))
        for r, t in (GRIDS[::3] if quick else GRIDS)
    )
    count_of = "Newton iterations x nodes"
    return [*rungs(spec), *series("mesh of the package", "grid", meshes, count_of)]


def _case(name: str, load: float, speed: float, tilt: float = 2e-3, oil: float = OIL,
          down_from: float = 0.0) -> ChartCase:  # fmt: skip
    before = ((down_from, speed, tilt, oil),) if down_from else ()
    return ChartCase(name, (load, speed, tilt, oil), before)


# load N, speed rad/s, tilt rad, oil K
CASES = (
    _case("centre", 300.0, 545.0),
    _case("full film, fast", 300.0, 953.0),
    _case("edge: fastest, heavy", 600.0, 1367.0),
    _case("edge: slow, light", 50.0, 136.0),
    _case("light load", 20.0, 545.0),
    _case("small tilt", 300.0, 545.0, tilt=2e-4),
    _case("large tilt", 200.0, 545.0, tilt=4e-3),
    _case("hot oil", 200.0, 545.0, oil=353.15),
    _case("transition", 320.0, 136.0),
    _case("below the fold", 700.0, 545.0),
    _case("mixed", 450.0, 136.0),
    _case("boundary", 1361.0, 136.0),
    _case("contact branch below the fold", 700.0, 545.0, down_from=1200.0),
    _case("film lost", 1200.0, 545.0),
)
WASHER = Chart(
    (Quantity("friction_torque", True, 1e-3), KELVIN), WARM, _washer,
    CASES, (0, 1, 8, 11, 12),
)  # fmt: skip
