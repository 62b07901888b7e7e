"""The chart of the washer: operating points on both branches, meshes, the whole curve in load."""

import time
from functools import partial

import numpy as np

from ...model.spec import ModelSpec
from ...washer.kernel_arguments import constants
from ...washer.kernels.layout import N_HEAD
from ...washer.kernels.workspace import size_of_state, size_of_work
from ...washer.parameters import SPEC
from ..rivals.plain2006 import Plain2006
from .chart_series import KELVIN, WARM, Chart, Configuration, Quantity, Settings, rungs, series
from .methods import ChartCase, KernelMethod

GRIDS = ((7, 20), (9, 24), (10, 32), (13, 40), (16, 48), (19, 64), (28, 96))
BEST_2006 = 1e-5  # tolerance of the method of 2006 beyond which its answers do not change
LOADS = tuple(range(50, 1851, 50))  # of the washer's whole curve
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


def whole_curve(*, quick: bool = False) -> dict[str, float]:
    """Return the seconds that one curve up in load takes, by the method of 2006 and by ours.

    545 rad/s, tilt 0.002 rad, 24 degC, 50 .. 1850 N in steps of 50 N; and the first load step of
    the method of 2006 alone, which took 30 minutes then.
    """
    loads = LOADS[::4] if quick else LOADS
    washer = Plain2006(tolerance=BEST_2006)
    began = time.perf_counter()
    washer.solve(loads[0], 545.0, 2e-3, OIL)
    first = time.perf_counter() - began
    for load in loads[1:]:
        washer.solve(load, 545.0, 2e-3, OIL)
    whole = time.perf_counter() - began
    ours = KernelMethod(SPEC, "field")
    points = tuple((float(load), 545.0, 2e-3, OIL) for load in loads)
    ours.solve(ChartCase("curve", points[-1], points[:-1]))
    began = time.perf_counter()
    ours.solve(ChartCase("curve", points[-1], points[:-1]))
    return {
        "points": len(loads), "first_step_2006_s": first, "curve_2006_s": whole,
        "curve_field_s": time.perf_counter() - began, "first_step_then_s": 1800.0,
    }  # fmt: skip


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
    CASES, (0, 1, 8, 11, 12), {"curve": whole_curve},
)  # fmt: skip
