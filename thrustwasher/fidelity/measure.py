"""Measure error and cost of ways to solve a model, on the same cases, by the same clock.

Errors come from one call per case, costs from other calls. A way that raises or answers with a
failure is a failed sample of that case, counted and kept, never an exit of the run.
"""

from __future__ import annotations

import math
import statistics
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any, Protocol

from ..errors import ParameterError, Status
from .cases import Case, digest

BATCH = 10e-3  # [s] least time between two looks at the clock
REPEATS = 9
LEAST = 5e-8  # [s] a call is never taken for less
FLAGGED = 0.10  # spread over median from which a cost is not to be trusted
GOOD = (Status.OK, Status.DISTRESS, Status.HOT)


@dataclass(frozen=True)
class Answer:
    """What a way says about a case."""

    values: Mapping[str, float]
    status: Status
    count: float  # of what the way counts


class Method(Protocol):
    """A way to solve a model, set up and with a memory of its own."""

    def solve(self, case: Case) -> Answer:
        """Solve a case the way it is reached."""

    def warm(self, case: Case) -> Callable[[], object]:
        """Return a call that solves one per cent away from the last such call."""

    def idle(self, case: Case) -> Callable[[], object] | None:
        """Return the same call without the solving, or None if that is nothing beside it."""


@dataclass(frozen=True)
class Rung:
    """One way at one setting of its knob."""

    family: str  # line of the chart
    label: str
    knob: str  # what changes along the line: "grid", "tolerance", "rung"
    value: str
    make: Callable[[], Method]
    count_of: str = ""
    is_rival: bool = False


@dataclass(frozen=True)
class Truth:
    """Converged values of a case and how far to trust them; by quantity."""

    values: Mapping[str, float]
    uncertainty: Mapping[str, float]  # absolute


@dataclass(frozen=True)
class Quantity:
    """What is judged: relative errors have a floor, absolute ones a unit."""

    name: str
    relative: bool
    floor: float = 0.0  # least size an error is referred to
    unit: str = "1"

    def error(self, found: float, true: float) -> float:
        """Return the error of a value."""
        size = max(abs(true), self.floor) if self.relative else 1.0
        return abs(found - true) / size


@dataclass(frozen=True)
class Timing:
    """Seconds per call over repeats."""

    median: float
    iqr: float
    least: float
    repeats: int
    first: float

    def less(self, spent: float) -> Timing:
        """Return it without what a call costs that does nothing; some is left in any case."""
        median, least = max(self.median - spent, LEAST), max(self.least - spent, LEAST)
        return replace(self, median=median, least=least)

    @property
    def is_noisy(self) -> bool:
        """True where the spread is too large for a comparison."""
        return self.iqr > FLAGGED * self.median


@dataclass(frozen=True)
class Sample:
    """A rung as measured."""

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
    failures: dict[str, str] = field(default_factory=dict)  # case -> what it said
    is_rival: bool = False
    slowest_call_s: float = math.nan
    slowest_case: str | None = None
    build_s: float = 0.0  # spent once for all, before the set-up: a map

    def as_dict(self) -> dict[str, Any]:
        """Return the sample as JSON types; no number is NaN or infinite."""
        return {k: _plain(v) for k, v in asdict(self).items()}


def time_call(
    call: Callable[[], object], *, repeats: int = REPEATS, batch: float = BATCH, calls: int = 1
) -> Timing:
    """Return the time of a call that does ``calls`` things, per thing; the first call is apart."""
    first = _seconds(call, 1)
    once = _seconds(call, 1)
    n = max(1, math.ceil(batch / max(once, 1e-7)))
    times = [_seconds(call, n) / calls for _ in range(repeats)]
    low, _, high = statistics.quantiles(times, n=4)
    return Timing(statistics.median(times), high - low, min(times), repeats, first / calls)


def _seconds(call: Callable[[], object], n: int) -> float:
    began = time.perf_counter()
    for _ in range(n):
        call()
    return (time.perf_counter() - began) / n


def measure(
    rung: Rung, cases: Sequence[Case], truths: Sequence[Truth], quantities: Sequence[Quantity], *,
    repeats: int = REPEATS,
) -> Sample:  # fmt: skip
    """Return error and cost of a rung over the cases."""
    began = time.perf_counter()
    try:
        method: Method = rung.make()
    except ParameterError as missing:  # such as a map that was never built
        method = _Nothing(str(missing))
    setup = time.perf_counter() - began
    found: dict[str, list[tuple[float, str]]] = {q.name: [] for q in quantities}
    failures: dict[str, str] = {}
    solved, counts = [], []
    for case, truth in zip(cases, truths, strict=True):
        answer, why = _ask(method, case)
        if answer is None or why:
            failures[case.name] = why
            continue
        solved.append(case)
        counts.append(answer.count)
        for q in quantities:
            error = q.error(answer.values[q.name], truth.values[q.name])
            found[q.name].append((error, case.name))
    timings = _time(method, solved, repeats)
    timing = _typical(list(timings.values()))
    slowest = max(timings, key=lambda name: timings[name].median, default=None)
    errors = {name: _errors(pairs) for name, pairs in found.items()}
    return Sample(
        rung.family, rung.label, rung.knob, rung.value, digest(tuple(cases)), errors,
        uncertainty_of(truths, quantities), timing.median, timing.iqr, timing.least,
        timing.repeats, timing.first, setup, statistics.fmean(counts) if counts else math.nan,
        rung.count_of, len(cases), len(failures), failures, rung.is_rival,
        timings[slowest].median if slowest else math.nan, slowest,
        float(getattr(method, "build_s", 0.0)),
    )  # fmt: skip


class _Nothing:
    """A way that could not be set up: it fails in every case, and says why."""

    def __init__(self, why: str) -> None:
        self._why = why

    def solve(self, case: Case) -> Answer:
        """Fail."""
        raise ParameterError(self._why)

    def warm(self, case: Case) -> Callable[[], object]:
        """Do nothing: it is never asked."""
        return lambda: None

    def idle(self, case: Case) -> None:
        """Do nothing: it is never asked."""


def _ask(method: Method, case: Case) -> tuple[Answer | None, str]:
    """Return the answer and what is wrong with it, if anything."""
    try:
        answer = method.solve(case)
    except Exception as error:  # a failure of the way, which is what is looked for
        return None, f"{type(error).__name__}: {error}"
    if answer.status not in GOOD:
        return answer, answer.status.name
    if not all(map(math.isfinite, answer.values.values())):
        return answer, "not finite, without a word"
    return answer, ""


def _time(method: Method, cases: Sequence[Case], repeats: int) -> dict[str, Timing]:
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


def uncertainty_of(truths: Sequence[Truth], quantities: Sequence[Quantity]) -> dict[str, float]:
    """Return the largest uncertainty of the truths, as an error of each quantity."""
    return {
        q.name: max(
            q.error(t.values[q.name] + t.uncertainty[q.name], t.values[q.name]) for t in truths
        )
        for q in quantities
    }


def statuses(samples: Sequence[Sample]) -> Counter[str]:
    """Count what failed samples said."""
    return Counter(why for s in samples for why in s.failures.values())


def _plain(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    return value
