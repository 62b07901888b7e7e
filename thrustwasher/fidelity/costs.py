"""What a call of a rung costs: its compiled step, inputs moving a little from call to call.

That is what a step costs in an FMU. A call of ``solve_*`` from Python adds tens of microseconds to
any rung.
"""

from __future__ import annotations

import dataclasses
import itertools
import subprocess
import sys
from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from ..models._prepare import filled
from ..models._spec import ModelSpec
from ..models._tables import fill_table
from .envelopes import cases
from .measure import Timing, time_call
from .timing import empty_step
from .truths import Truth

WALK = 0.003  # load and speed move by so much from call to call
LEAST = 5e-8  # s
TURN = 20  # calls in one direction
STEP = 1e-3  # s, for parts that have states
BRANCHES = {"film": 1.0, "contact": 3.0}
FIRST = """
import time, json, sys
import thrustwasher
began = time.perf_counter()
from thrustwasher.fidelity.answers import answer
from thrustwasher.fidelity.models import spec_of
from thrustwasher.fidelity.truths import Truth
point = Truth({point!r}, None, None, {{}}, {{}})
answer({model!r}, spec_of({model!r}).params(), {fidelity!r}, point)
print(time.perf_counter() - began)
"""


def stepper(
    spec: ModelSpec, params: Any, fidelity: str, truth: Truth, step: Any = None
) -> Callable[[], int]:
    """Return a call that makes one step of a rung near a point, load and speed a little further.

    ``step`` replaces the kernel's.
    """
    kernel = import_module(f"..kernels.{spec.kernel}", __package__)
    step = step or kernel.step
    par = prepared(spec, params, fidelity)
    branch = BRANCHES.get(truth.branch or "", 0.0) if spec.key == "washer" else None
    first = [truth.point[s.name] for s in spec.inputs]
    inp = np.array([*first, *([branch] if branch is not None else [])])
    state, work = np.zeros(kernel.NSTATE), np.zeros(kernel.NWORK)
    out, iout = np.zeros(kernel.NOUT), np.zeros(max(kernel.NIOUT, 1), np.int32)
    fill_table(spec, params, par, work)
    walk = itertools.cycle(_walk(first[0], first[1], branch == BRANCHES["film"]))

    def call() -> int:
        inp[0], inp[1] = next(walk)
        return int(step(par, inp, state, work, out, iout, 0.0, STEP))

    call()
    if branch is not None:
        inp[4] = 0.0  # the branch was asked for once, from now on it is remembered
    return call


def _walk(load: float, speed: float, falls: bool) -> list[tuple[float, float]]:
    """Return loads and speeds up and down again; away from the fold, a film's load falls."""
    factors = [1.0 + WALK * (TURN - abs(TURN - k)) for k in range(2 * TURN)]
    return [(load / f if falls else load * f, speed * f) for f in factors]


def prepared(spec: ModelSpec, params: Any, fidelity: str) -> Any:
    """Return the parameter array of a rung's kernel."""
    kernel = import_module(f"..kernels.{spec.kernel}", __package__)
    return filled(spec, params, fidelity, kernel.NPAR, kernel.derive)


def call_cost(spec: ModelSpec, params: Any, fidelity: str, truths: Sequence[Truth]) -> Timing:
    """Return the cost of a call: the median of a few points of a chart."""
    away = sorted((t for t in truths if not t.beside_fold), key=lambda t: t.point["load"])
    some = [away[k * (len(away) - 1) // 4] for k in (1, 2, 3)]
    empty, found = empty_step(), []
    for t in some:
        spent = time_call(stepper(spec, params, fidelity, t, empty)).least
        found.append(less(time_call(stepper(spec, params, fidelity, t)), spent))
    return sorted(found, key=lambda t: t.median)[1]


def less(timing: Timing, spent: float) -> Timing:
    """Return a timing without what the call from Python takes; some is left in any case."""
    median, least = max(timing.median - spent, LEAST), max(timing.least - spent, LEAST)
    return dataclasses.replace(timing, median=median, least=least)


@cache
def first_call(model: str, fidelity: str) -> float:
    """Return the seconds of the first solve in a new process, compiled code in the cache.

    Default parameters, the first held-out point; all parameter sets of a rung have this value.
    """
    code = FIRST.format(model=model, fidelity=fidelity, point=cases(model)[0].point(0))
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=600
    )
    return float(done.stdout.split()[-1])
