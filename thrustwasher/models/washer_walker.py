"""Walking along a washer's curve of solutions from Python: the film thickness is prescribed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import SolveError, Status
from ..kernels import washer_step as kernel
from ..kernels.washer_curve import ACCURACY, N_WALK, S, W, enter_curve, find_fold, walk_to
from ..kernels.washer_fields import Bench, Point, size_of_work, washer_fields
from ..kernels.washer_memory import (
    RATIO_THEN,
    SCAN_OIL,
    SCAN_SPEED,
    SCAN_TILT,
    remember_state,
    size_of_state,
)  # fmt: skip
from ..kernels.washer_model import washer_model
from ..kernels.washer_newton import N_INFO
from ..kernels.washer_outputs import MEAN_TEMPERATURE, RATIO, TORQUE, outputs_at
from ._buffers import work_array
from .washer import ERRORS, result_from
from .washer_constants import constants
from .washer_params import WasherParams
from .washer_result import WasherResult


@dataclass(frozen=True, slots=True)
class Fold:
    """Where two branches meet and end."""

    kind: str  # "film_lost" (load rising) or "film_regained" (load falling)
    load: float  # [N]
    film_ratio: float  # [-]
    temperature: float  # [K]
    friction_torque: float  # [N m]


class Walker:
    """The kernels' walker with its arrays."""

    def __init__(self, params: WasherParams, point: Point, nodes: tuple[int, int]) -> None:
        self.params, self.pt, self.nodes = params, point, nodes
        self.par = constants(params, nodes)
        self.work = work_array(("washer", nodes), kernel.N_HEAD + size_of_work(*nodes))
        self.m = washer_model(self.par)
        self.bench = Bench(self.par, self.work[kernel.N_HEAD :])
        self.f = washer_fields(self.m, self.bench.work)
        a = N_INFO + kernel.N_FOUND
        b = a + N_WALK
        self.info, self.walk = self.work[:N_INFO], self.work[a:b]
        self.out = self.work[b : b + kernel.N_ALL]
        self.q = self.work[kernel.N_HEAD - 4 : kernel.N_HEAD]
        self.walk[ACCURACY] = 1e-8

    def _check(self, code: int, where: str) -> None:
        if code:
            raise SolveError(
                f"load_curve: {Status(code).advice} ({where}, film of "
                f"{self.walk[S] / self.m.sigma1:.2f} sigma, speed = {self.pt.speed:g} rad/s, "
                f"tilt = {self.pt.tilt:g} rad; tried: steps down to 1e-4 of the first); "
                "use another grid"
            )

    def start(self, ratio: float) -> None:
        """Solve from nothing at a film ratio."""
        self._check(enter_curve(self.bench, self.pt, ratio, self.q, self.info, self.walk), "entry")

    def enter(self, load: float) -> None:
        """Go to where the washer carries less than ``load`` [N]."""
        self.start(6.0)
        while self.walk[W] > load and self.walk[S] < 1e3 * self.m.sigma1:
            self.to(1.25 * self.walk[S])

    def to(self, s: float) -> None:
        """Walk to a film thickness [m]."""
        self._check(walk_to(self.bench, self.pt, s, self.q, self.info, self.walk), "walking")

    def fold(self, kind: str, upper: float, lower: float) -> Fold:
        """Locate a fold between two film thicknesses and come back."""
        kept = [a.copy() for a in (self.q, self.f.temp, self.f.p, self.walk)]
        self._check(
            find_fold(self.bench, self.pt, upper, lower, self.q, self.info, self.walk), kind
        )
        load = float(self.walk[W])
        out = self.outputs()
        for a, b in zip((self.q, self.f.temp, self.f.p, self.walk), kept, strict=True):
            a[:] = b
        self.f.tag[0] = 0.0
        return Fold(kind, load, out[RATIO], out[MEAN_TEMPERATURE], out[TORQUE])

    def outputs(self) -> list[float]:
        """Return all outputs where the walker stands."""
        pt = self.pt._replace(load=float(self.walk[W]))
        outputs_at(self.bench, pt, self.q, self.out)
        return [float(x) for x in self.out]

    def result(self, fidelity: str) -> WasherResult:
        """Return a result where the walker stands; its branch is not known yet."""
        pt = self.pt._replace(load=float(self.walk[W]))
        self.outputs()
        state = np.zeros(size_of_state(*self.nodes))
        remember_state(self.bench, pt, self.q, state)
        state[RATIO_THEN] = self.out[RATIO]
        state[SCAN_SPEED], state[SCAN_TILT], state[SCAN_OIL] = pt.speed, pt.tilt, pt.oil_temperature
        point = (pt.load, pt.speed, pt.tilt, pt.oil_temperature)
        return result_from(
            self.params, point, fidelity, self.nodes, state, self.work, Status.OK, 1.0, False,
            ERRORS[fidelity],
        )  # fmt: skip
