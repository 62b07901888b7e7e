"""The thrust washer by the method it was published with, to be measured against.

After Jackson & Green (2006): a uniform polar mesh of 9 x 67 nodes for pressure and temperature,
cell areas as weights, Gauss-Seidel over-relaxation for the Reynolds equation with pressures at or
above zero, Newton-Raphson with centred differences for the four balances, Gauss-Seidel for the
temperatures, and temperatures substituted until they stay. The paper's run took 30 minutes for the
first load step, on a processor of 1.8 GHz.

Film, contact and viscosity are the package's own functions, so that the equations are the same.
Set as favourably as can be: over-relaxation 1.65 (best of 1.0 .. 1.9) also for the temperatures
(1.9), steps of Newton limited, a start with the washer on the gear (the paper's own start converges
nowhere), temperatures relaxed where that keeps the branch, and all of it compiled.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ...errors import Status
from ...washer.kernel_arguments import constants
from ...washer.kernels.layout import D_SIGMA1
from ...washer.parameters import WasherParams
from . import plain2006_kernel as kernel
from .plain2006_heat import Settings

Array = NDArray[np.float64]
GRID = (9, 67)
RELAXATION, HEAT_RELAXATION = 1.65, 1.9
DIFFERENCE = 0.1  # [sigma]; less is lost in the pressures' stop test
SHARE = 0.3  # 1 lands on the contact branch up to 28 % below the fold
MOST_ROUNDS = 400


@dataclass
class Plain2006:
    """A washer with the memory of its last solution, as the original keeps it between loads."""

    params: WasherParams = field(default_factory=WasherParams)
    grid: tuple[int, int] = GRID
    tolerance: float = 1e-6
    relaxation: float = RELAXATION
    share: float = SHARE
    limited: bool = True  # Newton's steps
    level: bool = False  # the paper's start: washer level, 3 sigma off everything

    def __post_init__(self) -> None:
        n_r, n_t = self.grid
        self._par = constants(self.params, (10, 32))  # scalars and contact tables; not its mesh
        self.memory = np.zeros(kernel.N_Q + 4 * n_r * n_t)
        self.out = np.zeros(kernel.N_OUT)

    def solve(self, load: float, speed: float, tilt: float, oil_temperature: float) -> Status:
        """Solve one point, warm if there was one before; the results are the properties below."""
        settings = Settings(
            self.relaxation,
            HEAT_RELAXATION,
            self.tolerance,
            DIFFERENCE,
            self.share,
            MOST_ROUNDS,
            1.0 if self.limited else 1e300,
        )
        if self.level and self.memory[0] == 0.0:
            gap = 3.0 * float(self._par[D_SIGMA1])
            self.memory[0] = gap
            self.memory[1] = 2.0 * gap + tilt * self.params.outer_radius
        status = kernel.solve(
            self._par, *self.grid, float(load), float(speed), float(tilt), float(oil_temperature),
            settings, self.memory, self.out,
        )  # fmt: skip
        return Status(status)

    def forget(self) -> None:
        """Start the next solve from nothing."""
        self.memory[:] = 0.0

    @property
    def friction_torque(self) -> float:
        """[N m] of the last solve."""
        return float(self.out[kernel.TORQUE])

    @property
    def temperature(self) -> float:
        """[K] mean of the film."""
        return float(self.out[kernel.TEMPERATURE])

    @property
    def film_thickness(self) -> float:
        """[m] least separation."""
        return float(self.out[kernel.FILM])

    @property
    def film_ratio(self) -> float:
        """[-] least separation over sigma."""
        return float(self.out[kernel.RATIO])

    @property
    def sweeps(self) -> int:
        """Sweeps over a field, of pressure and of temperature."""
        return int(self.out[kernel.SWEEPS])
