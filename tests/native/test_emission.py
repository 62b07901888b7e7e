"""Compiled ahead of time, the kernels give the numbers of the JIT to the last bit.

The JIT would compile the washer's kernels for minutes: they give the numbers of their source, run
as plain Python, and at every level of processors the same ones to the last bit.
"""

import os
import platform
import subprocess
import sys

import needed
import numpy as np
import pytest
from kernel_runs import MODELS, Jit, Native, Run, anything, course, parameters

from thrustwasher.native.link import this_level, this_platform

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or platform.machine() != "x86_64",
    reason="compares libraries for Linux on x86-64 with the JIT on the same machine",
)
HERE = this_level(this_platform()).name
# The level of processors that suits this machine; the others count as other platforms.
each_level = pytest.mark.parametrize(
    "level",
    [
        level if level == HERE else pytest.param(level, marks=pytest.mark.platforms)
        for level in ("v2", "v3")
    ],
)
JITTED = [model for model in MODELS if model != "washer"]
STEPS, TRIES = 300, 60


# To compile the others takes the JIT a quarter of a minute each.
@pytest.fixture(
    scope="module",  # all tests of a model one after the other: one process compiles it
    params=[m if m == "sump" else pytest.param(m, marks=pytest.mark.slow) for m in JITTED],
)
def model(request):
    return request.param


def has_v3() -> bool:
    with open("/proc/cpuinfo") as file:
        return " avx2 " in file.read()


def pair(model, level, other=None):
    """Return runs by the JIT, or by another level, and by a level."""
    if "v3" in (level, other) and not has_v3():
        pytest.skip("this CPU has no AVX2")
    runs = Run(Native(model, other) if other else Jit(model)), Run(Native(model, level))
    assert [run.start(parameters(model)) for run in runs] == [0, 0]
    return runs


def follow_the_course(model, runs):
    rows, dt = course(model, STEPS)
    for i, row in enumerate(rows):
        status = [run.step(row, i * dt, dt) for run in runs]
        assert status == [0, 0]
        assert runs[0].memory() == runs[1].memory(), i


def go_anywhere(model, runs):
    t, (_, dt) = 0.0, course(model, STEPS)
    for i, row in enumerate(anything(model, TRIES)):
        for h in (0.0, dt):
            status = [run.step(row, t, h) for run in runs]
            assert status[0] == status[1] >= 0
            assert runs[0].memory() == runs[1].memory(), (i, h)
        t += dt


@each_level
def test_a_reference_run_is_equal_to_the_bit(model, level):
    follow_the_course(model, pair(model, level))


@each_level
def test_inputs_from_all_over_are_equal_to_the_bit_failures_too(model, level):
    go_anywhere(model, pair(model, level))


@pytest.mark.platforms
def test_the_washer_is_the_same_at_both_levels_to_the_bit():
    follow_the_course("washer", pair("washer", "v2", "v3"))
    go_anywhere("washer", pair("washer", "v2", "v3"))


SOURCE = """
import sys
sys.path[:0] = {path!r}
import numpy as np
from kernel_runs import Native, Python, Run, course, parameters
from thrustwasher.numerics.jit import way
assert way() == "python"
runs = Run(Python("washer")), Run(Native("washer", {level!r}))
assert [run.start(parameters("washer")) for run in runs] == [0, 0]
rows, dt = course("washer", 10)
def same(what):
    a, b = (getattr(run, what) for run in runs)
    return np.allclose(a, b, rtol=1e-10, atol=0.0, equal_nan=True)
for i, row in enumerate(rows):
    status = [run.step(row, i * dt, dt) for run in runs]
    assert status == [0, 0], i
    assert same("par") and same("out") and (runs[0].iout == runs[1].iout).all(), i
    if i == 3:
        for k in range(len(row)):
            seed, found = np.eye(len(row))[k], [np.zeros(len(run.out)) for run in runs]
            for run, dout in zip(runs, found):
                assert run.entries.call(
                    "sens", run.par, row.copy(), run.state, run.work, seed, dout) == 0
            assert np.allclose(*found, rtol=1e-7, atol=1e-9 * np.abs(found[1]).max()), k
print("same")
"""


@pytest.mark.slow
def test_the_washers_numbers_are_those_of_its_source():
    code = SOURCE.format(path=sys.path, level=HERE)
    plain = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=plain)
    assert done.stdout == "same\n", done.stderr


@each_level
def test_derivatives_are_equal_to_the_bit(model, level):
    jit, native = pair(model, level)
    if not hasattr(jit.entries.module, "sens"):
        pytest.skip("this model has no derivatives")
    rows, dt = course(model, 20)
    for i, row in enumerate(rows):
        answers = []
        for run in (jit, native):
            assert run.step(row, i * dt, dt) == run.step(row, (i + 1) * dt, 0.0) == 0
            for k in range(len(row)):
                seed, dout = np.eye(len(row))[k], np.zeros(len(run.out))
                status = run.entries.call(
                    "sens", run.par, row.copy(), run.state, run.work, seed, dout
                )
                answers.append((k, status, dout.tobytes()))
        assert answers[: len(row)] == answers[len(row) :]


HARSH = """
import ctypes, sys
sys.path[:0] = {path!r}
from kernel_runs import Native, Run, course, parameters
libm = ctypes.CDLL("libm.so.6")
native, (rows, dt) = Native("gearmesh", {level!r}), course("gearmesh", 3)
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


def test_the_hosts_rounding_and_traps_neither_act_nor_change():
    needed.linker()
    code = HARSH.format(path=sys.path, level=HERE)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout == "same\n", done.stderr
