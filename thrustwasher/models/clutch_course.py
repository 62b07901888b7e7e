"""A pack brought along a course of load and slip, lumped over the radius or in rings."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..kernels import clutch_fine, clutch_point, clutch_stage
from ..kernels import clutch_layout as k
from ..kernels.clutch_friction import settled_ratio
from ..kernels.clutch_ring_time import advance_rings
from ..kernels.clutch_rings import mean_surface, ring_outputs, surfaces

Array = NDArray[np.float64]
Course = tuple[float, float, float, float, float, float]
STILL = (0.0, 0.0, 0.0)


class Lumped:
    """A pack with one temperature; ``status`` tells how the last call went."""

    def __init__(self, par: Any, load: float, oil: float) -> None:
        self.par, self.work, self.out = par, np.zeros(k.NWORK), np.zeros(k.NOUT)
        self.status = int(clutch_point.load_memory(par, load, oil, np.zeros(k.NSTATE), self.work))
        if self.status == k.OK and not clutch_point.moves_film(par):
            self.work[k.W_NOW], self.status, _ = settled_ratio(par, load, 1.0)

    def advance(self, course: Course, duration: float) -> int:
        """Go along a stretch; return the number of substeps."""
        power = self.out[k.O_POWER] / self.par[k.P_FACES]
        self.status = int(clutch_point.advance(
            self.par, course, duration, power, self.work[k.W_PROPOSED], self.work
        ))  # fmt: skip
        return int(self.work[k.W_SUBSTEPS])

    def show(self, load: float, slip: float) -> Array:
        """Return the real outputs at the present point."""
        clutch_point.fill_outputs(self.par, load, slip, self.work, self.out)
        self.out[k.O_TEMPERATURE] = clutch_stage.surface_temperature(self.par, self.work, k.W_NOW)
        self.out[k.O_ENERGY] = self.par[k.P_FACES] * self.work[k.W_NOW + k.Y_ENERGY]
        return self.out


class Rings(Lumped):
    """A pack in rings."""

    def __init__(self, par: Any, load: float, oil: float) -> None:
        self.par, self.work, self.out = par, np.zeros(k.NWORK), np.zeros(k.NOUT)
        self.status = int(clutch_fine.load_rings(par, load, oil, np.zeros(k.NSTATE), self.work))

    def advance(self, course: Course, duration: float) -> int:
        """Go along a stretch; return the number of substeps."""
        self.status = int(advance_rings(
            self.par, course, STILL, duration, self.work[k.W_PROPOSED], False, self.work
        ))  # fmt: skip
        return int(self.work[k.W_SUBSTEPS])

    def show(self, load: float, slip: float) -> Array:
        """Return the real outputs at the present point."""
        self.status = max(self.status, int(clutch_fine.settle_film(self.par, load, self.work)))
        surfaces(self.par, self.work, k.W_Z, k.W_SURFACE)
        surfaces(self.par, self.work, k.W_DZ, k.W_SURFACE + k.MAX_RINGS)
        point = (load, slip, float(self.work[k.W_Z + k.Z_FILM]))
        ring_outputs(self.par, point, STILL, self.work, self.out, np.zeros(k.NOUT))
        self.out[k.O_TEMPERATURE], _ = mean_surface(self.par, self.work)
        self.out[k.O_ENERGY] = self.par[k.P_FACES] * self.work[k.W_Z + k.Z_ENERGY]
        return self.out
