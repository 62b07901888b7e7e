"""Ways to hold in an unknown driveline compared: one table in Markdown, one chart.

python -m lab.benchmarks.holding.compare [FOLDER] [--plants 200]

Plants, judges and the pack are those of the tests; the chart, holding-methods.svg, goes to FOLDER.

Held: at most 3 reversals of the slip; it is below 1e-6 of the first one for good at most 3 steps
after the exact instant of the sampled plant; 20 steps later the torque is within 0.1 % of capacity
of the true one. Quiet: at most 3 reversals, and 100 steps later torque and slip are within 1 % of
capacity and of the first slip. The plants over the host step are the same at all of them: their
slip lasts 0.12 to 0.6 s. Gains of BoundedGain are the best of 144 sets over the first 30 plants,
noise and walk of KalmanBank the best of 5 over the first 45, so both were seen before they are
judged here. Shafts and hand-over take three tenths of the plants. Operations are counted, not
timed. 200 plants take about 10 minutes of processor time.
"""

import argparse
import math
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[3] / "tests/core/clutch/holding"))

import runs
from drivelines import Case, KnownPlant, exact, outside_steps, released, run, two_inertias
from linear_drivelines import Linear, elastic, handover, run_linear
from unit import Unit

from lab.benchmarks.holding.methods import BoundedGain, KalmanBank, PlainLeastSquares, Tanh
from thrustwasher.tribology.holding import memory as M
from thrustwasher.tribology.holding import torque as law

HOSTS = (1e-4, 3e-4, 1e-3, 2e-3, 5e-3, 1e-2)  # s
COUNTS = (12, 18, 25, 50, 100, 200, 400)  # steps of slip
NOISES = (1e-6, 1e-5, 1e-4, 1e-3)  # of the first slip
DELAYS = (0, 1, 2)
TAIL = 120  # steps
SLIPPING = (0.12, 0.6)  # s
TOLD = "told"  # a unit that knows inertia and age, for what can be reached at all
KERNEL = "LeastSquares"  # the clutch itself
METHODS: dict[str, Callable[[Any], Any]] = {
    "Tanh": lambda case: Tanh(case.gain),
    "BoundedGain": lambda case: BoundedGain(case.gain),
    "KalmanBank": lambda case: KalmanBank(case.gain),
    "PlainLeastSquares": lambda case: PlainLeastSquares(case.gain),
    KERNEL: Unit,
}
Shares = tuple[float, ...]
Results = dict[tuple[str, int], list[Shares]]


def stepped(case: Case, host: float) -> Case:
    """Return the same plant at another host step."""
    time = case.times[-1 - TAIL]
    count = math.ceil(time / host) + TAIL
    return replace(
        case,
        host=host,
        steps=[host] * count,
        torque1=[case.torque1[0]] * count,
        torque2=[case.torque2[0]] * count,
        loads=[case.profile.at(n * host) / case.gain for n in range(count)],
    )


def lasting(count: int, delay: int) -> Iterator[Case]:
    """Plants whose slip lasts as long as engagements do."""
    seed = found = 0
    while found < count:
        case = two_inertias(seed, delay=delay, tail=TAIL)
        seed += 1
        if SLIPPING[0] <= case.times[-1 - TAIL] <= SLIPPING[1]:
            found += 1
            yield case


def judged(case: Case, unit: Any) -> Shares:
    """Tell if the pack holds, and if it is quiet."""
    done, right = run(case, unit), exact(case)
    if runs.reversals(done) > 3:
        return 0.0, 0.0
    torque, slip = runs.late_errors(done, right.sampled, right.holding)
    late = runs.late_errors(done, right.sampled, right.holding, 100)
    prompt = runs.steps_to_lock(done, right.sampled) <= 3
    return float(prompt and torque < 1e-3 and slip < 1e-6), float(max(late) < 1e-2)


def unit_for(method: str, case: Case) -> Any:
    if method == TOLD:
        return KnownPlant(case.inertia, case.delay, case.gain)
    return METHODS[method](case)


def units_for(method: str, case: Linear) -> list[Any]:
    if method == TOLD:
        inertias = [case.inertias[i, i] for i in range(len(case.profiles))]
        return [KnownPlant(inertia, case.delay, case.gain) for inertia in inertias]
    return [METHODS[method](case) for _ in case.profiles]


def share(cases: Iterator[Case], method: str) -> Shares:
    results = [judged(case, unit_for(method, case)) for case in cases]
    return tuple(float(x) for x in np.mean(results, axis=0))


def at_host(method: str, plants: int, delay: int, host: float) -> Shares:
    return share((stepped(case, host) for case in lasting(plants, delay)), method)


def at_count(method: str, plants: int, delay: int, count: int) -> Shares:
    drawn = (two_inertias(seed, delay=delay, tail=TAIL) for seed in range(plants))
    return share((stepped(c, c.times[-1 - TAIL] / count) for c in drawn), method)


def at_noise(method: str, plants: int, delay: int, sigma: float) -> Shares:
    return stays(method, plants, delay, sigma=sigma)


def varying(method: str, plants: int) -> Shares:
    return share((two_inertias(seed, vary=True) for seed in range(plants)), method)


def again(method: str, plants: int, ratio: float) -> Shares:
    """Engage; open for 110 steps; engage again in a driveline with ``ratio`` times the inertia.

    The open pack slips as the outside torques want, then its slip goes smoothly to the first one.
    """
    results = []
    for seed in range(plants):
        case = two_inertias(seed, delay=seed % 3, tail=TAIL)
        other = replace(
            case,
            inertia1=ratio * case.inertia1,
            inertia2=ratio * case.inertia2,
            profile=replace(
                case.profile, top=ratio * case.profile.top, low=ratio * case.profile.low
            ),
            torque1=[ratio * x for x in case.torque1],
            torque2=[ratio * x for x in case.torque2],
            loads=[ratio * x for x in case.loads],
        )
        if method == TOLD:
            unit = unit_for(method, other)
        else:
            unit = unit_for(method, case if ratio < 1.0 else other)
            done, outside = run(case, unit), case.holding[-1] / case.inertia
            slip, acting = done.slip[-1], [*done.given[len(done.given) - case.delay :], *[0.0] * 10]
            for torque in acting:
                unit.step(slip, case.host, 0.0)
                slip += case.host * (outside - torque / case.inertia)
            rate = 100.0 * case.host * outside
            for x in np.arange(100) / 100.0:
                rest = case.slip - rate - slip
                unit.step(slip + rate * x + rest * x * x * (3.0 - 2.0 * x), case.host, 0.0)
        results.append(judged(other, unit))
    return tuple(float(x) for x in np.mean(results, axis=0))


def stays(method: str, plants: int, delay: int | None = None, **disturbed: float) -> Shares:
    """Slips over a bound reverse at most 3 times, and end for good within 20 steps of the lock.

    With noise or a swinging torque no way holds exactly. The bound: 4 times the largest late slip
    of a unit that is told the plant, at least 1e-3 of the first slip.
    """
    good = 0
    for seed in range(plants):
        case = two_inertias(seed, delay=seed % 3 if delay is None else delay, **disturbed)
        right = exact(case).sampled
        known = run(case, KnownPlant(case.inertia, case.delay, case.gain))
        done = run(case, unit_for(method, case))
        bound = max(1e-3, 4.0 * runs.max_late_slip(known, right))
        calm = runs.reversals(done, level=bound) <= 3
        good += calm and runs.max_late_slip(done, right) < bound
    return (good / plants,)


def found_again(method: str, plants: int, make: Callable[..., Case]) -> Shares:
    """At most 2 more reversals than the known plant, and at the end below 1e-6 of the first."""
    good = 0
    for seed in range(plants):
        case = make(seed)
        known = run(case, KnownPlant(case.inertia, case.delay, case.gain))
        done = run(case, unit_for(method, case))
        more = runs.reversals(done) - runs.reversals(known)
        good += more <= 2 and abs(done.slip[-1]) < 1e-6 * done.first
    return (good / plants,)


def behind_a_shaft(method: str, plants: int, frequency: float) -> Shares:
    """Over the last 300 of 3000 steps after the lock the slip stays below 1e-3 of the first."""
    good = 0
    for seed in range(plants):
        case = elastic(seed, frequency, host=1e-3, tail=3000)
        (done,) = run_linear(case, units_for(method, case))
        good += bool(np.max(np.abs(done.slip[-300:])) < 1e-3 * done.first)
    return (good / plants,)


def handed_over(method: str, plants: int) -> Shares:
    """Both packs reverse at most 3 times, and the one that takes over holds at the end."""
    good = 0
    for seed in range(plants):
        case = handover(seed)
        done = run_linear(case, units_for(method, case))
        calm = max(map(runs.reversals, done)) <= 3
        good += bool(calm and np.max(np.abs(done[1].slip[-50:])) < 1e-3 * done[1].first)
    return (good / plants,)


ROWS: dict[str, tuple[Callable[..., Shares], float]] = {  # with their share of the plants
    "steps vary by 4": (varying, 1.0),
    "again, 4 times the inertia": (partial(again, ratio=4.0), 1.0),
    "again, a quarter of it": (partial(again, ratio=0.25), 1.0),
    "swinging engine": (partial(stays, swing=1.0 / 3.0), 1.0),
    "swinging, all felt": (partial(stays, swing=1.0 / 3.0, felt=True), 1.0),
    "outside steps": (partial(found_again, make=outside_steps), 1.0),
    "load released and back": (partial(found_again, make=released), 1.0),
    "shaft of 10 Hz": (partial(behind_a_shaft, frequency=10.0), 0.3),
    "shaft of 30 Hz": (partial(behind_a_shaft, frequency=30.0), 0.3),
    "shaft of 100 Hz": (partial(behind_a_shaft, frequency=100.0), 0.3),
    "hand-over of two packs": (handed_over, 0.3),
}


class Counted(float):
    """A number that counts the floating operations made with it."""

    count = 0


def counting(name: str) -> Callable[..., Any]:
    plain = getattr(float, name)

    def counted(*numbers: Any) -> Any:
        Counted.count += 1
        result = plain(*map(float, numbers))
        return result if result is NotImplemented else Counted(result)

    return counted


for _name in ("add", "sub", "mul", "truediv", "pow"):
    for _side in ("", "r"):
        setattr(Counted, f"__{_side}{_name}__", counting(f"__{_side}{_name}__"))
Counted.__neg__ = lambda x: Counted(-float(x))  # type: ignore[method-assign]
Counted.__abs__ = lambda x: Counted(abs(float(x)))  # type: ignore[method-assign]


class Memory(list):  # type: ignore[type-arg]
    """A memory of counted numbers, with parts that are written through."""

    def __getitem__(self, place: Any) -> Any:
        return Counted(list.__getitem__(self, place))


def counted(value: Any) -> Any:
    if isinstance(value, list):
        return [counted(x) for x in value]
    return Counted(value) if type(value) is float else value


class KernelLaw:
    """The part of the kernel that identifies and holds, as plain Python on counted numbers."""

    def __init__(self, gain: float) -> None:
        self.gain, self.memory = gain, Memory([0.0] * M.N_MEMORY)
        self.coupling = (M.IDENTIFIED, 0.0, 0, 0.1, True)

    def step(self, slip: float, h: float, load: float) -> float:
        """Return the torque for a step."""
        memory, coupling, capacity = self.memory, self.coupling, self.gain * load
        memory[M.CAPACITY] = capacity
        law.notice.py_func(coupling, memory, slip)
        law.book_heat.py_func(coupling, memory, slip)
        slides, number, _, coded = law.decide.py_func(coupling, memory, slip, h, capacity)
        torque = number * capacity if slides else min(capacity, max(-capacity, number))
        holds = not slides and abs(number) < capacity
        asked = coded * capacity if slides else Counted(0.0)
        law.note.py_func(coupling, memory, slip, h, torque, asked, capacity, holds)
        return torque


class Count:
    """A unit of counted numbers, with the operations of its steps."""

    capacity = energy = 0.0
    locked = warned = False

    def __init__(self, unit: Any) -> None:
        self.unit, self.numbers = unit, []

    def step(self, slip: float, h: float, load: float) -> float:
        """Return the torque for a step, with what was counted kept."""
        for name, value in vars(self.unit).items():
            if not isinstance(value, Memory):
                setattr(self.unit, name, counted(value))
        before = Counted.count
        torque = self.unit.step(Counted(slip), Counted(h), Counted(load))
        self.numbers.append(Counted.count - before)
        self.capacity = float(self.unit.gain) * load
        return float(torque)


def operations(method: str) -> Shares:
    """Return the mean number of floating operations in a step, and the largest.

    + - * / of what identifies and holds, functions and comparisons left out, and what the kernel
    does for its heat.
    """
    numbers = []
    for seed in range(12):
        case = two_inertias(seed, delay=seed % 3, tail=TAIL)
        made = KernelLaw(case.gain) if method == KERNEL else unit_for(method, case)
        unit = Count(made)
        done = run(case, unit)
        numbers += unit.numbers
        if isinstance(made, KernelLaw):  # what was counted is what the kernel does
            same = run(case, unit_for(method, case))
            assert np.allclose(done.slip, same.slip, rtol=0.0, atol=1e-6 * done.first)
    return float(np.mean(numbers)), float(max(numbers))


STYLES = {
    "Tanh": ("#888888", "s", 5),
    "BoundedGain": ("#d55e00", "^", 5),
    "KalmanBank": ("#0072b2", "o", 10),
    "PlainLeastSquares": ("#009e73", "D", 6),
    KERNEL: ("#000000", "x", 5),
}
LATE = ("torque acts at once", "torque acts 1 step late", "torque acts 2 steps late")
SWEEPS: dict[str, Any] = {  # what is run, points, their scale and name in the chart, in the table
    "host": (at_host, HOSTS, 1e3, "host step [ms]", "{:g} ms"),
    "count": (at_count, COUNTS, 1, "steps of slip", "{:g} steps of slip"),
    "noise": (at_noise, NOISES, 1, "noise of the slip seen, share of the first", "noise of {:g}"),
}


def draw(swept: dict[str, Results], folder: Path) -> None:
    """Write the chart: shares of the plants over what is swept, a panel per delay."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams |= {"svg.hashsalt": "holding", "svg.fonttype": "none", "font.size": 9}
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(3, 3, figsize=(10.5, 9.5), sharey=True, sharex="row")
    for (name, results), line in zip(swept.items(), axes, strict=True):
        _, points, scale, label, _ = SWEEPS[name]
        for delay, panel in zip(DELAYS, line, strict=True):
            for method, (color, marker, size) in STYLES.items():
                shares = 100.0 * np.array(results[method, delay])
                kept = {"color": color, "marker": marker, "ms": size, "mfc": "none"}
                shown = [scale * x for x in points]
                panel.plot(shown, shares[:, 0], label=method, **kept)
                if method in ("Tanh", "BoundedGain") and shares.shape[1] > 1:
                    panel.plot(shown, shares[:, 1], ls=":", label=f"{method}, only quiet", **kept)
            panel.set_xscale("log")
            panel.set_xticks(shown, [f"{x:g}" for x in shown])
            panel.minorticks_off()
            panel.grid(alpha=0.3)
            panel.set_ylim(-5.0, 107.0)
            panel.set_title(LATE[delay], fontsize=9)
            panel.set_xlabel(label)
        line[0].set_ylabel("share of plants that hold [%]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncols=4, frameon=False)
    figure.tight_layout(rect=(0.0, 0.0, 1.0, 0.94))
    figure.savefig(folder / "holding-methods.svg", metadata={"Date": None})


def percent(shares: Shares) -> str:
    """Held, and in brackets quiet where that is told apart."""
    first = f"{100.0 * shares[0]:.3g}"
    return f"{first} ({100.0 * shares[1]:.3g})" if len(shares) > 1 else first


def main() -> None:
    parser = argparse.ArgumentParser(description="Compare ways to hold.")
    parser.add_argument("folder", nargs="?", type=Path, default=Path("."))
    parser.add_argument("--plants", type=int, default=200)
    given = parser.parse_args()
    everyone = [*METHODS, TOLD]
    points = [(m, given.plants, d) for m in everyone for d in DELAYS]
    with ProcessPoolExecutor(2) as pool:
        sweeps = {
            name: {p: [pool.submit(sweep[0], *p, x) for x in sweep[1]] for p in points}
            for name, sweep in SWEEPS.items()
        }
        others = {
            name: [pool.submit(row, m, max(1, round(part * given.plants))) for m in everyone]
            for name, (row, part) in ROWS.items()
        }
        swept = {
            name: {(p[0], p[2]): [x.result() for x in got] for p, got in results.items()}
            for name, results in sweeps.items()
        }
    print("Share of plants in %: held; in brackets quiet.\n")
    print(f"| | {' | '.join(everyone)} |\n|---{'|---:' * len(everyone)}|")
    for name, (_, values, scale, _, text) in SWEEPS.items():
        for d in DELAYS:
            for i, value in enumerate(values):
                row = " | ".join(percent(swept[name][m, d][i]) for m in everyone)
                print(f"| {text.format(scale * value)}, delay {d} | {row} |")
    for name, got in others.items():
        print(f"| {name} | {' | '.join(percent(x.result()) for x in got)} |")
    costs = {m: operations(m) for m in METHODS}
    row = " | ".join(f"{mean:.0f} (at most {most:.0f})" for mean, most in costs.values())
    print(f"| floating operations in a step | {row} | |")
    draw(swept, given.folder)


if __name__ == "__main__":
    main()
