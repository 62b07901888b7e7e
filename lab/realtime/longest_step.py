"""Mean, rare and longest times of the steps of a level, and how much work its steps took."""

import math
import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np

from lab.realtime import timed_steps as c
from lab.realtime.host import Host
from lab.realtime.loop_bounds import work_places
from lab.realtime.walk import Piece, Walk
from thrustwasher.errors import EnvironmentProblem, ParameterError, SolveError
from thrustwasher.fmu.description.interface import Interface, interface
from thrustwasher.fmu.running.core import Core
from thrustwasher.model.parameters import as_numbers
from thrustwasher.model.registry import kernel_of
from thrustwasher.model.spec import ModelSpec
from thrustwasher.numerics.jit import way
from thrustwasher.shift.cosim.compiled_layout import wall_clock

RUNS = 3
WARM = 200  # steps before any counts
PIECE = 2000  # steps between two looks from Python
COUNTED, COUNTING = 5000, 10.0  # steps whose work is counted, in so many seconds at most
RARE = 1e-5  # share of steps beyond the rare time
# Share of steps that are done again; more until there were enough to tell.
SLOW, BUSY, ENOUGH = 1e-3, 1e-2, 10_000


@dataclass(frozen=True, kw_only=True)
class Worst:
    """What the steps of one level took; times in s.

    ``mean``, ``rare`` (exceeded by one step in 100 000), ``longest``: of the steps' own work, the
    minimum time of each slow step's repeats; ``raw_longest`` with all that came between. The
    longest step is that of ``point``, ``step`` long. ``work``: what the solver counts -> the most
    in a step, of fewer steps. ``memory``: bytes of an instance, of which ``table`` for a map.
    """

    model: str
    fidelity: str
    steps: int
    failed: int
    not_finite: int
    mean: float
    rare: float
    longest: float
    raw_longest: float
    point: Mapping[str, float]
    step: float
    work: Mapping[str, int] = field(default_factory=dict)
    memory: int | None = None
    table: int = 0
    pinned: bool = False

    @property
    def ratio(self) -> float:
        """The longest time over the mean."""
        return self.longest / self.mean


class _Tally:
    """Times and counts of all pieces of a run."""

    def __init__(self) -> None:
        self.counts, self.times = np.zeros(c.N_COUNTS, np.int64), np.zeros(c.N_TIMES)
        self.raw, self.own = np.zeros(c.N_BINS, np.int64), np.zeros(c.N_BINS, np.int64)
        self.point: list[float] = []
        self.step = 0.0

    def note(self, piece: Piece, longest: float) -> None:
        """Keep the inputs of the longest step if it lies in this piece."""
        if self.times[c.OWN_LONGEST] > longest:
            place = int(self.times[c.OWN_PLACE])
            self.point, self.step = piece.inputs[place].tolist(), float(piece.sizes[place])


def beyond(histogram: Any, share: float) -> float:
    """Return the time [s] that a share of the steps exceeds: the upper end of its bin."""
    above = np.cumsum(histogram[::-1])[::-1]
    allowed = share * above[0]
    place = int(np.argmax(above <= allowed)) if (above <= allowed).any() else len(histogram)
    return float(1e-9 * 2.0 ** (place / c.BINS_PER_OCTAVE))


def measure(
    spec: ModelSpec,
    path: Path,
    fidelity: str,
    *,
    settings: Mapping[str, Any] | None = None,
    steps: int,
    seconds: float,
    seed: int = 1,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> Worst:
    """Time the steps of a level over three walks through its box, the longest of all three.

    Parameters
    ----------
    spec, path : a model and its native FMU
    fidelity : the level
    settings : parameters by name, as the dataclass takes them
    steps : of each walk; it ends before if it takes longer than ``seconds``
    seed : of the first walk
    progress : is called with steps done and all steps

    Raises
    ------
    ParameterError : no number of steps, or parameters that do not go together
    EnvironmentProblem : no compiled code, or an FMU that does not run here
    SolveError : the instance could not be initialized anywhere
    """
    if steps < 1:
        raise ParameterError(f"steps = {steps}, allowed: a whole number from 1 on")
    if way() == "python":
        raise EnvironmentProblem("steps are timed by compiled code; unset NUMBA_DISABLE_JIT")
    shown, tally = interface(spec), _Tally()
    given = _numbers(spec, fidelity, settings or {})
    clock, tick = wall_clock(np.zeros(2, np.int64))
    if tick == 0.0:
        raise EnvironmentProblem("this system has no clock that compiled code can read")
    with pinned_core() as pinned, Host(path, shown, given) as host:
        memory = host.memory()
        for run in range(RUNS):
            _run(Timing(host, spec, seed + run, clock, tick), tally, steps, seconds, progress)
    done = int(tally.counts[c.STEPS])
    if not done:
        raise SolveError(f"{spec.name} {fidelity}: no start was found in its box")
    table = getattr(kernel_of(spec), "TABLE", {})
    return Worst(
        model=spec.key,
        fidelity=fidelity,
        steps=done,
        failed=int(tally.counts[c.FAILED]),
        not_finite=int(tally.counts[c.NOT_FINITE]),
        mean=float(tally.times[c.OWN_TOTAL]) / done,
        rare=min(beyond(tally.own, RARE), float(tally.times[c.OWN_LONGEST])),
        longest=float(tally.times[c.OWN_LONGEST]),
        raw_longest=float(tally.times[c.LONGEST]),
        point=dict(zip((s.name for s in spec.inputs), tally.point, strict=False)),
        step=tally.step,
        work=work_of(spec, given, seed),
        memory=memory,
        table=8 * int(table.get("ROOM", 0)),
        pinned=pinned,
    )


class Timing:
    """A walk of a host's instance, piece by piece."""

    def __init__(self, host: Host, spec: ModelSpec, seed: int, clock: Any, tick: float) -> None:
        self._host, self._clock, self._tick = host, clock, tick
        self._walk = Walk(spec, seed)

    def take(self, n: int, slow: float, tally: _Tally) -> None:
        """Take steps; those longer than ``slow`` [s] are done again."""
        piece, host, longest = self._walk.piece(n), self._host, float(tally.times[c.OWN_LONGEST])
        c.run_steps(
            host.calls,
            host.parameters,
            host.outputs,
            piece.inputs,
            piece.sizes,
            piece.restarts,
            np.zeros(n),
            self._clock,
            self._tick,
            slow,
            tally.counts,
            tally.times,
            tally.raw,
            tally.own,
        )
        tally.note(piece, longest)


def _run(
    walk: Timing,
    tally: _Tally,
    steps: int,
    seconds: float,
    progress: Callable[[int, int], None],
) -> None:
    warm = _Tally()
    walk.take(WARM, math.inf, warm)
    each = float(warm.times[c.TOTAL]) / max(int(warm.counts[c.STEPS]), 1)
    size = max(c.BLOCK, min(PIECE, int(1.0 / max(each, 1e-9))))
    # by the times of repeats: a busy machine would make the limit of what is repeated too high
    slow, done, until = beyond(warm.own, BUSY), 0, time.monotonic() + seconds
    while done < steps and time.monotonic() < until:
        n = min(size, steps - done)
        walk.take(n, slow, tally)
        done += n
        if tally.own.sum() >= ENOUGH:
            slow = beyond(tally.own, SLOW)
        progress(done, steps)


def _numbers(spec: ModelSpec, fidelity: str, settings: Mapping[str, Any]) -> dict[str, float]:
    """Return parameters as an FMU takes them, by name."""
    params = spec.params(**settings)
    names = (*(f.name for f in fields(params)), "fidelity")
    values = (*as_numbers(params), list(spec.fidelities).index(fidelity) + 1)
    return {name: float(value) for name, value in zip(names, values, strict=True)}


@contextmanager
def pinned_core() -> Iterator[bool]:
    """Hold this process on one core, the last it may use; gives whether that could be done."""
    if not hasattr(os, "sched_setaffinity"):
        yield False
        return
    before = os.sched_getaffinity(0)
    try:
        os.sched_setaffinity(0, {max(before)})
    except OSError:
        yield False
        return
    try:
        yield True
    finally:
        os.sched_setaffinity(0, before)


def work_of(
    spec: ModelSpec, parameters: Mapping[str, float], seed: int, n: int = COUNTED
) -> dict[str, int]:
    """Return what the model's solver counts -> the most in a step, of up to ``n`` steps."""
    shown, layout = interface(spec), getattr(kernel_of(spec), "L", None)
    own = {text: getattr(layout, name) for text, name in work_places(spec.key).items()}
    places = {**dict(shown.counts), **own}
    piece, most = Walk(spec, seed).piece(n), dict.fromkeys(places, 0)
    core, t, until = None, 0.0, time.monotonic() + COUNTING
    for row, h, again in zip(piece.inputs, piece.sizes, piece.restarts, strict=True):
        if not places or time.monotonic() > until:
            break
        if again or core is None:
            core, t = _begun(shown, parameters, row), 0.0
        if core is None:
            continue
        core.set([v.reference for v in shown.inputs], row.tolist(), "Real")
        with suppress(SolveError):
            core.advance(t, float(h))
            t += float(h)
        for text, place in places.items():
            most[text] = max(most[text], int(core.work[place]))
    return most


def _begun(shown: Interface, parameters: Mapping[str, float], row: Any) -> Core | None:
    """Return an instance in this process that has been initialized; None if it cannot be."""
    core = Core(shown)
    for v in shown.parameters:
        core.set([v.reference], [parameters[v.name]], v.type)
    core.begin(0.0)
    core.set([v.reference for v in shown.inputs], row.tolist(), "Real")
    try:
        core.leave_initialization()
    except SolveError:
        return None
    return core
