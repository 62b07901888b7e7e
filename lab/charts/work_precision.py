"""Work-precision: error and cost of methods on the same cases, by the same clock.

Errors come from one call per case, costs from other calls. A method that raises or answers with a
failure is a failed sample of that case, counted and kept, never an exit of the run.
"""

import math
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from lab.charts.chart_series import LEVELS, Configuration, Quantity, cases_of, digest
from lab.charts.clutch_chart import CLUTCH
from lab.charts.methods import ChartCase, Method, MethodAnswer
from lab.charts.washer_chart import WASHER
from thrustwasher.errors import ParameterError, Status
from thrustwasher.model.registry import spec_of
from thrustwasher.storage.digests import finite
from thrustwasher.studio.verification.costs import REPEATS, Timing, time_call
from thrustwasher.studio.verification.reference_cache import SOURCES
from thrustwasher.studio.verification.reference_values import ReferenceValues

CHARTS = {"washer": WASHER, "clutch": CLUTCH, "gearmesh": LEVELS}  # by the models' keys

Progress = Callable[[str], None]
OF_SETTING = ("family", "label", "knob", "value", "count_of", "is_rival")
GOOD = (Status.OK, Status.DISTRESS, Status.HOT)


@dataclass(frozen=True)
class Sample:
    """A method at a setting, as measured."""

    family: str
    label: str
    knob: str
    value: str
    cases: str  # digest of the list
    errors: dict[str, dict[str, Any]]  # quantity -> worst, rms, case (that was worst)
    ref_uncertainty: dict[str, float]
    call_median: float  # [s] the median of the cases' medians, as are the next two
    call_iqr: float
    call_min: float
    repeats: int
    first_call_s: float
    setup_s: float
    count: float
    count_of: str
    n_cases: int
    n_failed: int
    failures: dict[str, str] = field(default_factory=dict)  # case -> its message
    is_rival: bool = False
    slowest_call_s: float = math.nan
    slowest_case: str | None = None
    build_s: float = 0.0  # spent once for all, before the set-up: a map

    def as_dict(self) -> dict[str, Any]:
        """Return the sample as JSON types; no number is NaN or infinite."""
        return dict(finite(asdict(self)))


def measure(
    setting: Configuration,
    cases: Sequence[ChartCase],
    known: Sequence[ReferenceValues],
    quantities: Sequence[Quantity],
    *,
    repeats: int = REPEATS,
) -> Sample:
    """Return error and cost of a method at a setting over the cases."""
    began = time.perf_counter()
    method, missing = None, ""
    try:
        method = setting.make()
    except ParameterError as error:  # such as a map that was never built
        missing = f"ParameterError: {error}"
    setup = time.perf_counter() - began
    found: dict[str, list[tuple[float, str]]] = {q.name: [] for q in quantities}
    failures: dict[str, str] = {}
    solved, counts = [], []
    for case, true in zip(cases, known, strict=True):
        answer, why = _ask(method, case) if method else (None, missing)
        if answer is None or why:
            failures[case.name] = why
            continue
        solved.append(case)
        counts.append(answer.count)
        for q in quantities:
            off = q.error(answer.values[q.name], true.values[q.name])
            found[q.name].append((off, case.name))
    timings = _time(method, solved, repeats) if method else {}
    timing = _typical(list(timings.values()))
    slowest = max(timings, key=lambda name: timings[name].median, default=None)
    return Sample(
        **{name: getattr(setting, name) for name in OF_SETTING},
        cases=digest(tuple(cases)),
        errors={name: _errors(pairs) for name, pairs in found.items()},
        ref_uncertainty={
            q.name: max(
                q.error(t.values[q.name] + t.uncertainty[q.name], t.values[q.name]) for t in known
            )
            for q in quantities
        },
        call_median=timing.median,
        call_iqr=timing.iqr,
        call_min=timing.least,
        repeats=timing.repeats,
        first_call_s=timing.first,
        setup_s=setup,
        count=statistics.fmean(counts) if counts else math.nan,
        n_cases=len(cases),
        n_failed=len(failures),
        failures=failures,
        slowest_call_s=timings[slowest].median if slowest else math.nan,
        slowest_case=slowest,
        build_s=float(getattr(method, "build_s", 0.0)),
    )


def _ask(method: Method, case: ChartCase) -> tuple[MethodAnswer | None, str]:
    """Return the answer and what is wrong with it, if anything."""
    try:
        answer = method.solve(case)
    except Exception as error:  # a failure of the method, which is what is looked for
        return None, f"{type(error).__name__}: {error}"
    if answer.status not in GOOD:
        return answer, answer.status.name
    if not all(map(math.isfinite, answer.values.values())):
        return answer, "not finite, silently"
    return answer, ""


def _time(method: Method, cases: Sequence[ChartCase], repeats: int) -> dict[str, Timing]:
    """Return the cost of a warm call of each case.

    It is that of the compiled code, as in an FMU: what the call from Python adds is taken off.
    """
    found = {}
    for case in cases:
        timing = time_call(method.warm(case), repeats=repeats)
        idle = method.idle(case)
        if idle is not None:
            timing = timing.less(time_call(idle, repeats=3).least)
        found[case.name] = timing
    return found


def _typical(timings: Sequence[Timing]) -> Timing:
    """Return the medians over the cases."""
    if not timings:
        return Timing(math.nan, math.nan, math.nan, 0, math.nan)
    parts = ([getattr(t, name) for t in timings] for name in ("median", "iqr", "least", "first"))
    median, iqr, least, first = (statistics.median(values) for values in parts)
    return Timing(median, iqr, least, timings[0].repeats, first)


def _errors(pairs: list[tuple[float, str]]) -> dict[str, Any]:
    if not pairs:
        return {"worst": None, "rms": None, "case": None}
    worst, case = max(pairs)
    rms = math.sqrt(statistics.fmean(e * e for e, _ in pairs))
    return {"worst": worst, "rms": rms, "case": case}


def work_precision(
    model: str, *, quick: bool = False, progress: Progress = print
) -> dict[str, Any]:
    """Measure all series of a model; return cases, true values and samples, as JSON types."""
    cases = cases_of(model, quick=quick)
    progress(f"{model}: reference values of {len(cases)} cases")
    source = SOURCES[model]
    settings = CHARTS[model].series(spec_of(model), quick=quick)
    known = {
        preset: [source.at_case(case.point, case.before, *words) for case in cases]
        for preset, words in {s.preset: [s.preset] if s.preset else [] for s in settings}.items()
    }
    chart = CHARTS[model]
    quantities = chart.quantities
    samples = []
    for setting in settings:
        progress(f"{model}: {setting.label}")
        repeats = 3 if quick else REPEATS
        true = known[setting.preset]
        samples.append(measure(setting, cases, true, quantities, repeats=repeats).as_dict())
    return {
        "cases": [{"name": c.name, "point": c.point, "before": c.before} for c in cases],
        "cases_digest": digest(cases),
        "cost_of": chart.cost_of,
        "quantities": [q.as_dict() for q in quantities],
        "truths": [{q.name: t.values[q.name] for q in quantities} for t in known[""]],
        "samples": samples,
    }
