"""Coverage of a calibration's 95 % intervals, by simulated measurements with 2 % scatter.

    python -m lab.benchmarks.calibration [SETS] [MODEL ...]

Prints for each parameter in how many of SETS (200) data sets its interval holds the true value, and
between which counts chance alone leaves it; five minutes. Some of them are done
by tests/studio/calibration.
"""

import sys
import time
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np
from scipy.stats import binom

from thrustwasher import ClutchParams, GearMeshParams, WasherParams, calibrate, run_sweep

SCATTER = 0.02  # of each value
SETS = 200


@dataclass(frozen=True)
class Rig:
    """A part with known constants, where it is measured, and what is fitted from which start."""

    model: str
    start: Any
    truth: dict[str, float]
    points: dict[str, list[float]]
    outputs: tuple[str, ...]
    fidelity: str

    def exact(self) -> dict[str, Any]:
        """Return the outputs without scatter."""
        table = run_sweep(
            self.model,
            points=self.points,
            params=replace(self.start, **self.truth),
            fidelity=self.fidelity,
            workers=1,
        )
        return {name: table[name] for name in self.outputs}

    def fit(self, exact: dict[str, Any], seed: int) -> Any:
        """Return the calibration on one data set."""
        draw = np.random.default_rng(seed).standard_normal
        noisy = {name: (x * (1.0 + SCATTER * draw(len(x)))).tolist() for name, x in exact.items()}
        return calibrate(
            self.start,
            {**self.points, **noisy},
            fit=tuple(self.truth),
            fidelity=self.fidelity,
            errors=dict.fromkeys(self.outputs, f"{100 * SCATTER:g} %"),
        )


def grid(**axes: list[float]) -> dict[str, list[float]]:
    """Return the columns of all combinations of inputs."""
    rows = list(product(*axes.values()))
    return {name: [row[i] for row in rows] for i, name in enumerate(axes)}


RIGS = (
    Rig(
        "washer",
        WasherParams(),
        {"viscosity_scale": 7e-5, "viscosity_exponent": 1.1},
        grid(load=[50.0, 200.0], speed=[400.0, 953.0], oil_temperature=[300.0, 330.0], tilt=[2e-3]),
        ("friction_torque",),
        "field",
    ),
    Rig(
        "clutch",
        ClutchParams(friction_law="wang"),
        {"shear_floor": 0.4, "decay_speed": 2.0},
        grid(
            load=[50.0, 125.0],  # light: slip that lasts
            speed=[5.0, 20.0, 30.0, 45.0, 60.0, 80.0, 120.0, 160.0],
            oil_temperature=[350.0],
        ),
        ("friction_torque",),
        "field",
    ),
    Rig(
        "gearmesh",
        GearMeshParams(mean_roughness=5e-7),
        {"viscosity_scale": 1.2e-4, "mean_roughness": 8e-7},
        grid(load=[10.0, 40.0, 100.0], speed=[50.0, 300.0], oil_temperature=[350.0]),
        ("friction_torque", "film_thickness"),
        "field",
    ),
)


def held(rig: Rig, n: int) -> dict[str, int]:
    """Return in how many of ``n`` data sets the interval of each parameter holds the truth."""
    exact, counts = rig.exact(), dict.fromkeys(rig.truth, 0)
    for seed in range(n):
        found = rig.fit(exact, seed)
        for name, value in rig.truth.items():
            low, high = found[name].interval
            counts[name] += found[name].identifiable and low <= value <= high
    return counts


def main(sets: str = str(SETS), *models: str) -> None:
    """Print the table."""
    n = int(sets)
    low, high = binom.interval(0.999, n, 0.95)
    print(f"95 % intervals that hold the truth, of {n}; by chance {low:.0f} .. {high:.0f}")
    for rig in RIGS:
        if models and rig.model not in models:
            continue
        began = time.perf_counter()
        for name, count in held(rig, n).items():
            print(f"{rig.model:10} {name:20} {count:5}  {100 * count / n:.1f} %", flush=True)
        print(f"{'':10} {(time.perf_counter() - began) / n:.2f} s each", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
