"""The same steps by Python and by compiled libraries."""

import ctypes
import tempfile
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.shell import c_tables, platform_libraries
from thrustwasher.model.registry import all_specs, find_spec, kernel_of
from thrustwasher.native.compiling.objects import objects
from thrustwasher.native.library import linked_objects
from thrustwasher.native.targets import PLATFORMS

HERE = Path(__file__).parent
EXPORTS = ("probe_derive", "probe_rule", "probe_step", "probe_sens")
MODELS = [spec.key for spec in all_specs()]
_folder = tempfile.TemporaryDirectory(prefix="probe")


@cache
def probe(model: str, level: str) -> ctypes.CDLL:
    """Return the compiled kernels of one CPU level for this machine, without the shell."""
    spec = find_spec(model)
    linux = PLATFORMS["linux64"]
    platform = replace(linux, levels=tuple(one for one in linux.levels if one.name == level))
    files = {**c_tables.sources(interface(spec)), "probe.c": (HERE / "probe.c").read_bytes()}
    name = f"{model}_{level}"
    files |= platform_libraries.dispatch()
    made = linked_objects(files, objects(spec.kernel, [platform]), platform, name, EXPORTS)
    path = Path(_folder.name) / f"{name}.so"
    path.write_bytes(made)
    return ctypes.CDLL(str(path))


class Python:
    """The entries as Python calls them."""

    def __init__(self, model: str) -> None:
        self.module = kernel_of(find_spec(model))

    def call(self, entry: str, *given):
        return getattr(self.module, entry)(*given)


class Native(Python):
    """The same entries in a compiled library."""

    def __init__(self, model: str, level: str) -> None:
        super().__init__(model)
        self.library = probe(model, level)

    def call(self, entry: str, *given):
        function = getattr(self.library, f"probe_{entry.replace('broken_', '')}")
        return function(
            *[
                ctypes.c_double(v) if isinstance(v, float) else ctypes.c_void_p(v.ctypes.data)
                for v in given
            ]
        )


class Run:
    """One instance: parameters at their start values, memory empty."""

    def __init__(self, entries: Python) -> None:
        self.entries, k = entries, entries.module
        self.par, self.state, self.work = np.zeros(k.NPAR), np.zeros(k.NSTATE), np.zeros(k.NWORK)
        self.out, self.iout = np.zeros(k.NOUT), np.zeros(k.NIOUT, np.int32)

    def start(self, values) -> int:
        self.par[: len(values)] = values
        return self.entries.call("derive", self.par)

    def step(self, inputs, t: float, dt: float) -> int:
        inp = np.zeros(2 * len(inputs))  # the shell's has rates behind the inputs
        inp[: len(inputs)] = inputs
        inp = inp if hasattr(self.entries.module, "NRATES") else inp[: len(inputs)]
        return self.entries.call(
            "step", self.par, inp, self.state, self.work, self.out, self.iout, t, dt
        )

    def memory(self) -> list[bytes]:
        """Everything a step writes that counts, to the bit."""
        return [part.tobytes() for part in (self.par, self.state, self.out, self.iout)]


def parameters(model: str) -> list[float]:
    """Return the start values of all parameters, the fidelity last."""
    return [v.start for v in interface(find_spec(model)).parameters]


def profile(model: str, steps: int) -> tuple[np.ndarray, float]:
    """Return inputs (steps, n) along the model's reference run, and the step size [s]."""
    spec = find_spec(model)
    rows = np.array(spec.profile or [(0.0, *(s.start for s in spec.inputs))])
    dt = spec.stop_time / steps
    times = dt * np.arange(1, steps + 1)
    return np.column_stack([np.interp(times, rows[:, 0], row) for row in rows.T[1:]]), dt


def anything(model: str, steps: int) -> np.ndarray:
    """Return inputs (steps, n) from all over their ranges, at random but always the same."""
    spec = find_spec(model)
    low = np.array([-1e3 if s.low is None else s.low for s in spec.inputs])
    high = np.array([1e3 if s.high is None else s.high for s in spec.inputs])
    share = np.random.default_rng(7).random((steps, len(spec.inputs)))
    return low + (high - low) * share**2
