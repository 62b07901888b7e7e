"""What a call of a rung costs: its compiled step, inputs moving a little from call to call.

That is what a step costs in an FMU. A call of ``solve_*`` from Python adds tens of microseconds to
any rung.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

import numpy as np

from ..models._prepare import filled
from ..models._spec import ModelSpec
from ..store.card_parts import Cost
from .timing import Timing, overhead, time_call
from .truths import Truth

WALK = 0.003  # load and speed move by so much from call to call
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
    spec: ModelSpec, params: Any, fidelity: str, truth: Truth
) -> tuple[Callable[[int], object], tuple[Any, ...]]:
    """Return a function of a counter that makes one step of a rung near a point; its arguments."""
    kernel = import_module(f"..kernels.{spec.kernel}", __package__)
    par = prepared(spec, params, fidelity)
    branch = BRANCHES.get(truth.branch or "", 0.0) if spec.key == "washer" else None
    first = np.array([truth.point[s.name] for s in spec.inputs])
    inp = np.array([*first, *([branch] if branch is not None else [])])
    state, work = np.zeros(kernel.NSTATE), np.zeros(kernel.NWORK)
    out, iout = np.zeros(kernel.NOUT), np.zeros(max(kernel.NIOUT, 1), np.int32)
    step = kernel.step

    def call(k: int) -> int:
        moved = 1.0 + WALK * abs(TURN - (k + TURN) % (2 * TURN))
        # away from the fold: a film's load falls, a contact's rises
        inp[0] = first[0] / moved if branch == BRANCHES["film"] else first[0] * moved
        inp[1] = first[1] * moved
        if k == 1 and branch is not None:
            inp[4] = 0.0  # the branch was asked for once, from now on it is remembered
        return int(step(par, inp, state, work, out, iout, k * STEP, STEP))

    return call, (par, inp, state, work, out, iout, 0.0, STEP)


def prepared(spec: ModelSpec, params: Any, fidelity: str) -> Any:
    """Return the parameter array of a rung's kernel."""
    kernel = import_module(f"..kernels.{spec.kernel}", __package__)
    return filled(spec, params, fidelity, kernel.NPAR, kernel.derive)


def call_cost(spec: ModelSpec, params: Any, fidelity: str, truths: Sequence[Truth]) -> Timing:
    """Return the cost of a call: the median of a few points of a chart."""
    away = sorted((t for t in truths if not t.beside_fold), key=lambda t: t.point["load"])
    some = [away[k * (len(away) - 1) // 4] for k in (1, 2, 3)]
    found = []
    for t in some:
        call, arguments = stepper(spec, params, fidelity, t)
        found.append(less(time_call(call), overhead(arguments)))
    return sorted(found, key=lambda t: t.median)[1]


def less(timing: Timing, spent: float) -> Timing:
    """Return a timing without what the call from Python takes; 50 ns are left in any case."""
    return Timing(max(timing.median - spent, 5e-8), timing.iqr, max(timing.least - spent, 5e-8))


def first_call(model: str, fidelity: str, point: dict[str, float]) -> float:
    """Return the seconds of the first solve in a new process, compiled code in the cache."""
    code = FIRST.format(model=model, fidelity=fidelity, point=point)
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=600
    )
    return float(done.stdout.split()[-1])


def cost(timing: Timing, first: float, work: float, has_mesh: bool, build: float = 0.0,
         solves: int = 0) -> Cost:  # fmt: skip
    """Return a card's cost part; times have three digits."""
    what = "iterations x mesh nodes, from nothing" if has_mesh else "iterations"
    median, iqr, least, once = (float(f"{t:.3g}") for t in (*_parts(timing), first))
    return Cost(median, iqr, least, once, build, solves, float(f"{work:.4g}"), what)


def _parts(timing: Timing) -> tuple[float, float, float]:
    return timing.median, timing.iqr, timing.least
