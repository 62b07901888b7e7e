"""Measure all lines of a model: what the chart of error against cost is made from."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from .cases import Case, cases_of, digest
from .lines import QUANTITIES, lines_of
from .measure import REPEATS, Truth, measure

Progress = Callable[[str], None]
MODELS = ("washer", "clutch", "gearmesh")
COST_OF = {"washer": "warm call, 1 % away [s]", "clutch": "engagement of 0.6 s [s]"}
BEST_2006 = 1e-5  # tolerance of the method of 2006 beyond which its answers do not change
LOADS = tuple(range(50, 1851, 50))  # of the washer's whole curve


def survey(model: str, *, quick: bool = False, progress: Progress = print) -> dict[str, Any]:
    """Return cases, truths and samples of a model, as JSON types."""
    cases = cases_of(model, quick=quick)
    progress(f"{model}: reference values of {len(cases)} cases")
    truths = truths_of(model, cases)
    quantities = QUANTITIES[model]
    samples = []
    for rung in lines_of(model, quick=quick):
        progress(f"{model}: {rung.label}")
        repeats = 3 if quick else REPEATS
        samples.append(measure(rung, cases, truths, quantities, repeats=repeats).as_dict())
    found: dict[str, Any] = {
        "cases": [{"name": c.name, "point": c.point, "before": c.before} for c in cases],
        "cases_digest": digest(cases), "cost_of": COST_OF.get(model, COST_OF["washer"]),
        "quantities": [
            {"name": q.name, "kind": "relative" if q.relative else "absolute", "unit": q.unit,
             "floor": q.floor if q.relative else None}
            for q in quantities
        ],
        "truths": [dict(t.values) for t in truths],
        "samples": samples,
    }  # fmt: skip
    if model == "washer":
        progress("washer: the whole curve by the method of 2006")
        found["curve"] = whole_curve(quick=quick)
    return found


def truths_of(model: str, cases: tuple[Case, ...]) -> list[Truth]:
    """Return the truth of every case."""
    from . import truth

    found = {
        "washer": truth.washer_truth, "clutch": truth.clutch_truth,
        "gearmesh": truth.gearmesh_truth,
    }[model]  # fmt: skip
    return [found(case) for case in cases]


def whole_curve(*, quick: bool = False) -> dict[str, float]:
    """Return the seconds that one curve up in load takes, by the method of 2006 and by ours.

    545 rad/s, tilt 0.002 rad, 24 degC, 50 .. 1850 N in steps of 50 N; and the first load step of
    the method of 2006 alone, which took 30 minutes then.
    """
    from ..models.washer_params import SPEC
    from ..rivals.plain2006 import Plain2006
    from .ways import KernelWay

    loads = LOADS[::4] if quick else LOADS
    washer = Plain2006(tolerance=BEST_2006)
    began = time.perf_counter()
    washer.solve(loads[0], 545.0, 2e-3, 297.15)
    first = time.perf_counter() - began
    for load in loads[1:]:
        washer.solve(load, 545.0, 2e-3, 297.15)
    whole = time.perf_counter() - began
    ours = KernelWay(SPEC, "field")
    points = tuple((float(load), 545.0, 2e-3, 297.15) for load in loads)
    ours.solve(Case("curve", points[-1], points[:-1]))
    began = time.perf_counter()
    ours.solve(Case("curve", points[-1], points[:-1]))
    return {
        "points": len(loads), "first_step_2006_s": first, "curve_2006_s": whole,
        "curve_field_s": time.perf_counter() - began, "first_step_then_s": 1800.0,
    }  # fmt: skip
