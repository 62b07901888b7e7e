"""The models' own libraries: the same bits and words as the Python core, bare in a C host."""

import importlib
import math
import random

import numpy as np
import pytest
from sampling import jump
from shell_runs import GUID, model_library, needs_linux, run
from twin import Twin

from thrustwasher.errors import SolveError
from thrustwasher.fmu.description.interface import interface
from thrustwasher.model.registry import find_spec

pytestmark = needs_linux
CHEAP = ["clutch", "gearmesh", "transmission", "command"]
H = 1e-3


def vary_parameters(twin, rng):
    """Set some parameters a little off their start, and the fidelity; a bare library has no map."""
    found = [v for v in interface(twin.spec).variables if v.causality == "parameter"]
    values = {}
    for v in rng.sample(found, min(5, len(found))):
        if v.type == "Real" and v.low <= v.start * 1.01 <= v.high:
            values[v.name] = v.start * 1.01
    rungs = [i for i, name in enumerate(twin.spec.fidelities, 1) if name != "map"]
    twin.put(**values, fidelity=rng.choice(rungs))


def run_of(spec, seed, n):
    """Return a twin that has asked for a run with everything that happens to instances."""
    twin, rng = Twin(spec, GUID), random.Random(seed)
    for part in range(3):
        vary_parameters(twin, rng)
        twin.begin(0.5 * part)
        twin.put(**jump(spec, rng))
        twin.leave()
        for i in range(n // 3):
            if spec.inputs and i % 10 == 3:
                twin.put(**{**jump(spec, rng), spec.inputs[0].name: math.nan})
                twin.step(0.5 * part + i * H, H)
            twin.put(**jump(spec, rng))
            if i % 4 == 0:
                twin.take()  # readings between setting and stepping change nothing that follows
            twin.step(0.5 * part + i * H, H)
            twin.take()
            if i == 20:
                twin.save(0)
            if i == 40:
                twin.restore(0)
        twin.reset()
    return twin


@pytest.mark.parametrize(
    ("model", "fmi"),
    [
        *((m, 2) for m in CHEAP),
        ("clutch", 3),
        *(pytest.param(m, 3, marks=pytest.mark.fmi3) for m in CHEAP if m != "clutch"),
    ],
)
def test_300_steps_are_the_cores_to_the_bit(model, fmi):
    twin = run_of(find_spec(model), 7, 300)
    replies = run(fmi, model_library(model), twin.script)
    twin.check(replies)


@pytest.mark.slow
def test_the_washers_steps_are_the_cores_to_the_bit():
    twin = run_of(find_spec("washer"), 7, 30)
    twin.check(run(2, model_library("washer"), twin.script))


@pytest.mark.parametrize("model", ["clutch", "gearmesh", "transmission"])
def test_derivatives_are_the_kernels_to_the_bit_after_steps_and_after_sets(model):
    spec, rng = find_spec(model), random.Random(11)
    kernel = importlib.import_module(spec.kernel)
    if not hasattr(kernel, "sens"):
        pytest.skip(f"the kernel of {model} has no derivatives")
    twin = Twin(spec, GUID)
    outputs = [v for v in interface(spec).variables if v.store == "out" and v.depends]
    inputs = [v for v in interface(spec).variables if v.causality == "input"]

    def slope(unknown, seed):
        core = twin.core
        core.refresh()
        core.solve_aside()
        dout = np.zeros(kernel.NOUT)
        status = kernel.sens(core.par, core.inp, core.state, core.work, np.array(seed), dout)
        if status >= 10:
            raise SolveError(status)
        return [float(dout[unknown.slot])]

    def ask():
        for unknown in outputs:
            known = rng.choice([v for v in inputs if v.name in unknown.depends])
            seed = [float(v is known) for v in inputs]
            twin._ask(
                f"derive {unknown.reference} {known.reference} 1",
                lambda u=unknown, s=seed: slope(u, s),
            )

    twin.begin()
    twin.leave()
    for i in range(40):
        twin.put(**jump(spec, rng))
        ask()
        twin.step(i * H, H)
        ask()
    twin.check(run(2, model_library(model), twin.script), words=False)
