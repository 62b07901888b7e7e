"""Does a choice keep its word? Random requests, judged at points that no table was made with.

python -m lab.benchmarks.choices [--requests N] [--points N] [--own N] [MODEL ...]

Each request is a box around a random point of a parameter set, with a tolerance of 0.3 to 5 %. The
parameter sets are those with tables and, per model, some of random parameters without one. The
answer's true error is the largest difference from the reference at the points in the box. Each
request is made a second time with half the tolerance: that must not give a cheaper level. Prints
Markdown. Reference values are kept: a run that is stopped goes on where it was.
"""

import argparse
import dataclasses
import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from thrustwasher import Choice, SolveError, choose
from thrustwasher.errors import ParameterError
from thrustwasher.ladder.choose import levels_of
from thrustwasher.ladder.error_table import Interval, fresh_levels
from thrustwasher.model.part_file import preset_params
from thrustwasher.model.registry import spec_of
from thrustwasher.studio.verification.cases import Case, cases, own_case
from thrustwasher.studio.verification.measured_chart import deviation, floor_of
from thrustwasher.studio.verification.reference_cache import SOURCES, answer, reference_points
from thrustwasher.studio.verification.reference_values import OK, ReferencePoint

SEED = 2026
QUANTITY = "friction_torque"
TOLERANCES = (0.003, 0.05)
# Parameters that random parts differ by, with the factors between which they lie.
VARIED = {
    "washer": ("roughness", "dry_friction", "outer_radius", "viscosity_scale"),
    "clutch": ("roughness", "permeability", "constant_friction", "friction_scale"),
    "gearmesh": ("face_width", "viscosity_scale", "centre_distance"),
}
FACTORS = (0.8, 1.25)
PRESETS = {"gearmesh": "paper"}  # that every second part begins with


class Points(NamedTuple):
    """Points of a parameter set with the error of every level; infinite where one has no answer."""

    case: Case
    known: list[ReferencePoint]
    errors: dict[str, list[float]]

    def worst(self, level: str, box: dict[str, Interval]) -> float:
        """Return a level's largest error at the points in a box."""
        inside = (
            e
            for t, e in zip(self.known, self.errors[level], strict=True)
            if all(low <= t.point[name] <= high for name, (low, high) in box.items())
        )
        return max(inside, default=0.0)


def points_of(case: Case, n: int, charts: Iterable[str] | None = None) -> Points:
    """Return the points of a case and all errors there; of some charts if they are named."""
    case = dataclasses.replace(case, seed=SEED)
    known = [
        t
        for t in reference_points(case, SOURCES[case.spec.key], n)
        if not t.beside_fold and (charts is None or t.chart in charts)
    ]
    floors = {c: floor_of([t for t in known if t.chart == c]) for c in {t.chart for t in known}}
    errors = {
        level: [error_at(case, level, t, floors[t.chart]) for t in known]
        for level in levels_of(case.spec, case.params)
    }
    return Points(case, known, errors)


def error_at(case: Case, level: str, known: ReferencePoint, floor: float) -> float:
    """Return a level's error at a point as tables measure it."""
    found = answer(case.spec.key, case.params, level, known)
    if found.verdict != OK:
        return math.inf
    return deviation(QUANTITY, known, found.values[QUANTITY], floor)


def random_case(model: str, number: int, points: int) -> Case | None:
    """Return a part of random parameters that has no table; None if they do not fit together."""
    rng, spec = np.random.default_rng([SEED, number]), spec_of(model)
    start = preset_params(spec, PRESETS.get(model) if number % 2 else None, {})
    changes = {n: getattr(start, n) * float(rng.uniform(*FACTORS)) for n in VARIED[model]}
    try:
        return own_case(spec, dataclasses.replace(start, **changes), {}, points)
    except ParameterError:
        return None


def random_box(points: Points, rng: np.random.Generator) -> dict[str, Interval]:
    """Return a box of random size around a random point, inside the case's own."""
    middle = points.known[rng.integers(len(points.known))].point
    box = {}
    for name, axis in points.case.box.items():
        half = 0.5 * rng.random()
        if axis.scale == "log":
            span = (axis.max / axis.min) ** half
            low, high = middle[name] / span, middle[name] * span
        else:
            span = (axis.max - axis.min) * half
            low, high = middle[name] - span, middle[name] + span
        box[name] = (max(low, axis.min), min(high, axis.max))
    return box


class Outcome(NamedTuple):
    """What came of a request; the error is in units of the tolerance.

    ``promised``: the choice says an error; the last level without a table has none.
    """

    group: str
    level: str | None
    promised: bool
    error: float
    in_order: bool


def ask(points: Points, rng: np.random.Generator) -> Outcome:
    """Make one random request and judge the answer."""
    case, box = points.case, random_box(points, rng)
    tol = float(np.exp(rng.uniform(*np.log(TOLERANCES))))
    levels = [*points.errors, None]
    choice, strict = (_chosen(case, box, t) for t in (tol, 0.5 * tol))
    taken, stricter = (c and c.fidelity for c in (choice, strict))
    error = 0.0 if taken is None else points.worst(taken, box) / tol
    promised = choice is not None and math.isfinite(choice.error)
    known = "table" if fresh_levels(case.spec.key, case.params) else "no table"
    group = f"{case.spec.key}, {known}"
    order = levels.index(taken) <= levels.index(stricter)
    return Outcome(group, taken, promised, error, order)


def _chosen(case: Case, box: dict[str, Interval], tol: float) -> Choice | None:
    try:
        return choose(case.spec.key, box, tol=tol, params=case.params)
    except SolveError:
        return None


def report(outcomes: list[Outcome]) -> None:
    """Print how often the word was kept, by model."""
    print(
        "| model | requests | with a promise | kept | largest error / tolerance | last "
        "fidelity level "
        "without one | refused | none costlier than a stricter one | fidelity levels taken |"
    )
    print("|" + "---|" * 9)
    for group in [*dict.fromkeys(o.group for o in outcomes), "all"]:
        mine = [o for o in outcomes if group in (o.group, "all")]
        promised = [o for o in mine if o.promised]
        kept = sum(o.error <= 1.0 for o in promised)
        worst = max((o.error for o in promised), default=0.0)
        taken = {r: sum(o.level == r for o in mine) for r in dict.fromkeys(o.level for o in mine)}
        last, refused = (
            sum(o.level is not None and not o.promised for o in mine),
            sum(o.level is None for o in mine),
        )
        levels = ", ".join(f"{r} {n}" for r, n in taken.items() if r)
        order = sum(o.in_order for o in mine)
        print(
            f"| {group} | {len(mine)} | {len(promised)} | {kept} | {worst:.2g} | {last} "
            f"| {refused} | {order} | {levels} |"
        )


def main() -> None:
    """Ask and report."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("models", nargs="*", default=list(VARIED))
    parser.add_argument("--requests", type=int, default=400)
    parser.add_argument("--points", type=int, default=120, help="per parameter set with a table")
    parser.add_argument("--own", type=int, default=3, help="parts of random parameters per model")
    options = parser.parse_args()
    groups = []
    for model in options.models:
        groups += [points_of(case, options.points) for case in cases(model)]
        parts = (random_case(model, k, options.points // 3) for k in range(options.own))
        charts = ("settled",) if model == "clutch" else None  # what ``choose`` compares
        groups += [points_of(case, case.n, charts) for case in parts if case]
    rng = np.random.default_rng(SEED)
    report([ask(groups[k % len(groups)], rng) for k in range(options.requests)])


if __name__ == "__main__":
    main()
