"""A pack brought along a course of load and slip, lumped over the radius or in rings."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import Status
from ..kernels import clutch_advance, clutch_outputs, clutch_rates
from ..kernels import clutch_layout as k

Array = NDArray[np.float64]
Course = tuple[float, float, float, float, float, float]


class PackCourse:
    """A pack on its way; ``status`` tells how the last call went."""

    def __init__(self, par: Any, load: float, oil: float) -> None:
        self.par, self.work, self.out = par, np.zeros(k.NWORK), np.zeros(k.NOUT)
        self.status = int(clutch_advance.load_memory(par, load, oil, np.zeros(k.NSTATE), self.work))
        if self.status == Status.OK and not clutch_rates.moves_film(par):
            self.work[k.W_NOW + k.Y_FILM] = 1.0
            self.status = int(clutch_advance.settle_film(par, load, self.work))

    def advance(self, course: Course, duration: float) -> int:
        """Go along a stretch; return the number of substeps."""
        power = self.out[k.O_POWER] / self.par[k.P_FACES]
        self.status = int(clutch_advance.advance(
            self.par, course, duration, power, self.work[k.W_PROPOSED], self.work
        ))  # fmt: skip
        return int(self.work[k.W_SUBSTEPS])

    def show(self, load: float, slip: float) -> Array:
        """Return the real outputs at the present point."""
        clutch_outputs.fill_outputs(self.par, load, slip, self.work, self.out)
        self.out[k.O_TEMPERATURE], _ = clutch_outputs.mean_surface(self.par, self.work)
        self.out[k.O_ENERGY] = self.par[k.P_FACES] * self.work[k.W_NOW + k.Y_ENERGY]
        return self.out
