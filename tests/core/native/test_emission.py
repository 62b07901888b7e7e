"""Compiled, the kernels give the numbers of their source, at every level of processors the same."""

import platform
import sys

import needed
import pytest
from children import child
from kernel_runs import MODELS, Native, Run, anything, parameters, profile

from thrustwasher.native.link import this_level, this_platform

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or platform.machine() != "x86_64",
    reason="compares libraries for Linux on x86-64 with Python on the same machine",
)
HERE = this_level(this_platform()).name
STEPS, TRIES = 300, 60


def has_v3() -> bool:
    with open("/proc/cpuinfo") as file:
        return " avx2 " in file.read()


@pytest.mark.platforms
@pytest.mark.parametrize("model", MODELS)
def test_both_levels_are_equal_to_the_bit_failures_too(model):
    """On the way of the reference run, and with inputs from all over."""
    if not has_v3():
        pytest.skip("this CPU has no AVX2")
    runs = [Run(Native(model, level)) for level in ("v2", "v3")]
    assert [run.start(parameters(model)) for run in runs] == [0, 0]
    rows, dt = profile(model, STEPS)
    for i, row in enumerate([*rows, *anything(model, TRIES)]):
        for h in (dt,) if i < STEPS else (0.0, dt):
            status = [run.step(row, i * dt, h) for run in runs]
            assert status[0] == status[1] >= 0 and (i >= STEPS or status == [0, 0])
            assert runs[0].memory() == runs[1].memory(), (i, h)


# 1e-12: an output next to nothing is a difference of large numbers, and rounding differs with the
# version of numpy.
SOURCE = """
import sys
sys.path[:0] = {path!r}
import numpy as np
from kernel_runs import Native, Python, Run, profile, parameters
from thrustwasher.numerics.jit import way
assert way() == "python"
model = {model!r}
runs = Run(Python(model)), Run(Native(model, {level!r}))
assert [run.start(parameters(model)) for run in runs] == [0, 0]
rows, dt = profile(model, 10)
rows = rows[:{steps}]
def same(what):
    a, b = (getattr(run, what) for run in runs)
    return np.allclose(a, b, rtol=1e-9, atol=1e-12, equal_nan=True)
for i, row in enumerate(rows):
    status = [run.step(row, i * dt, dt) for run in runs]
    assert status == [0, 0], i
    assert same("par") and same("out") and (runs[0].iout == runs[1].iout).all(), i
    for k in range(len(row) if i == 3 and hasattr(runs[0].entries.module, "sens") else 0):
        seed = np.zeros(getattr(runs[0].entries.module, "NSEED", len(row)))
        seed[k], found = 1.0, [np.zeros(len(run.out)) for run in runs]
        for run, dout in zip(runs, found):
            given = run.par, row.copy(), run.state, run.work, seed, dout
            assert run.entries.call("sens", *given) == 0
        assert np.allclose(*found, rtol=1e-7, atol=1e-9 * np.abs(found[1]).max()), k
print("same")
"""


# Steps of a tenth of the profile, the fourth with derivatives; plain Python takes minutes for some.
LONG = {"washer", "clutch"}


@pytest.mark.parametrize(
    ("model", "steps"),
    [
        *((m, 4 if m in LONG else 10) for m in MODELS if m != "washer"),
        *(pytest.param(m, 10, marks=pytest.mark.slow) for m in sorted(LONG)),
    ],
)
@pytest.mark.slow
def test_the_numbers_are_those_of_the_source(model, steps):
    needed.linker()
    code = SOURCE.format(path=sys.path, level=HERE, model=model, steps=steps)
    done = child(code, NUMBA_DISABLE_JIT="1")
    assert done.stdout == "same\n", done.stderr


HARSH = """
import ctypes, sys
sys.path[:0] = {path!r}
from kernel_runs import Native, Run, profile, parameters
libm = ctypes.CDLL("libm.so.6")
native, (rows, dt) = Native("gearmesh", {level!r}), profile("gearmesh", 3)
def results():
    run = Run(native)
    run.start(parameters("gearmesh"))
    return [(run.step(row, 0.0, dt), run.memory())[1] for row in rows]
plain = results()
UPWARD, ALL = 0x800, 0x3D
rounding, traps, trap_not = libm.fegetround, libm.fegetexcept, libm.fedisableexcept
assert libm.fesetround(UPWARD) == 0
libm.feclearexcept(ALL)  # old numpy leaves some behind when it is imported
libm.feenableexcept(ALL)
found, left = results(), (rounding(), traps())
trap_not(ALL)  # what Python does itself is not exact now and then
assert found == plain and left == (UPWARD, ALL)
print("same")
"""


@pytest.mark.slow
def test_the_hosts_rounding_and_traps_neither_act_nor_change():
    needed.linker()
    done = child(HARSH.format(path=sys.path, level=HERE))
    assert done.stdout == "same\n", done.stderr
