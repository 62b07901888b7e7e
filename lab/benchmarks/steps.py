"""What a co-simulation step of the clutch and of the gear mesh costs.

python -m lab.benchmarks.steps

One process, one thread. "kernel": microseconds of the compiled step itself, from a compiled loop
over a whole profile of inputs; "call": with the call from Python. Medians over repeats, minima in
brackets. Substeps and iterations need no machine.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import numba
import numpy as np
from numpy.typing import NDArray

from lab.benchmarks.printed import median_and_least, table_head, table_row
from thrustwasher.clutch.kernels import layout
from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.registry import find_spec, kernel_of

Array = NDArray[np.float64]
H = 1e-3


def runner(model: str) -> Callable[..., int]:
    """Return a compiled loop over the rows of a profile."""
    step = kernel_of(find_spec(model)).step

    @numba.njit
    def run(
        par: Array, profile: Array, state: Array, work: Array, out: Array, iout: Array, h: float
    ) -> int:
        worst = 0
        for i in range(len(profile)):
            worst = max(worst, step(par, profile[i], state, work, out, iout, i * h, h))
        return worst

    return run  # type: ignore[no-any-return]


def measure(
    name: str, run: Callable[..., int], spec: str, profile: Array, parameters: dict[str, object]
) -> None:
    """Print a row: kernel and call time of one profile, worst step, substeps."""
    with DirectInstance(find_spec(spec), parameters=parameters) as direct:
        direct.initialize(inputs=dict(zip(direct.input_names, profile[0].tolist(), strict=True)))
        core = direct.core
        fresh = core.state.copy()
        arrays = (core.par, profile, core.state, core.work, core.out, core.iout)
        assert run(*arrays, H) == 0
        kernel, call = [], []
        for _ in range(25):
            core.state[:] = fresh
            begin = time.perf_counter()
            run(*arrays, H)
            kernel.append((time.perf_counter() - begin) / len(profile))
        step = kernel_of(find_spec(spec)).step
        substeps = []
        for _ in range(9):
            core.state[:] = fresh
            begin = time.perf_counter()
            for i, row in enumerate(profile):
                step(core.par, row, core.state, core.work, core.out, core.iout, i * H, H)
            call.append((time.perf_counter() - begin) / len(profile))
        if spec == "WetClutch":
            core.state[:] = fresh
            for i, row in enumerate(profile):
                step(core.par, row, core.state, core.work, core.out, core.iout, i * H, H)
                substeps.append(core.work[layout.W_SUBSTEPS])
        count = f"{np.mean(substeps):.2f} ({max(substeps):.0f})" if substeps else "-"
        times = ((statistics.median(own), min(own)) for own in (kernel, call))
        table_row(name, *(median_and_least(t, 1e6, ".2f") for t in times), count)


def engagement() -> Array:
    """Return 400 ms of load, slip, oil temperature, drum: pressure with 50 ms, slip to zero."""
    t = np.arange(400) * H
    load = 5898.0 * (1.0 - np.exp(-t / 0.05))
    return np.column_stack([load, 350.0 * (1.0 - t / 0.4), np.full_like(t, 297.15), 0.0 * t])


def mesh_profile() -> Array:
    """Return torque, speed, oil temperature of a planet through an upshift."""
    t = np.linspace(0.0, 1.0, 400)
    return np.column_stack([22.5 * (1.2 - t), 400.0 * (1.0 - t) + 1.0, np.full_like(t, 297.15)])


def main() -> None:
    """Print the table."""
    table_head("step", "kernel us", "call us", "substeps, mean (most)")
    run = runner("WetClutch")
    sudden = engagement()
    sudden[:, 0], sudden[:, 1] = 5898.0, 350.0
    cases: list[tuple[str, Array, dict[str, object]]] = [
        ("clutch field, engagement, inputs held", engagement(), {}),
        ("clutch field, engagement, inputs linear", engagement(), {"input_profile": "linear"}),
        ("clutch field, sudden load", sudden, {}),
        ("clutch field, contact rise", engagement(), {"contact_rise": True}),
        ("clutch field, impermeable lining", engagement(), {"permeability": 0.0}),
    ]
    cases += [(f"clutch {f}", engagement(), {"fidelity": f}) for f in ("fine", "stribeck")]
    for name, profile, parameters in cases:
        measure(name, run, "WetClutch", profile, parameters)
    run = runner("GearMesh")
    for name, parameters in (
        ("gear mesh field", {}),
        ("gear mesh, viscosity at the inlet", {"viscosity_at": "inlet"}),
    ):
        measure(name, run, "GearMesh", mesh_profile(), dict(parameters))


if __name__ == "__main__":
    main()
