"""Does the chooser keep its word? Random requests on the shipped cards, judged by new points.

python benchmarks/chooser.py [--requests N] [--points N] [MODEL ...]

The points are others than those the cards were made with; each has its own reference value. A
request is a box around one of them, with a random tolerance and number of calls. Its true error is
the largest at the new points in the box. Which rung is the cheapest that holds is judged by all
points known, old and new. Prints Markdown.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
from dataclasses import dataclass

import numpy as np

from thrustwasher import Choice, SolveError, choose
from thrustwasher.ladder.card import Card, fresh_cards
from thrustwasher.study.card_cases import Case, cases
from thrustwasher.study.error_tables import deviation
from thrustwasher.study.reference_cache import answer, reference_points, source_of
from thrustwasher.study.reference_values import OK, ReferencePoint

SEED = 2026
SAFETY = 1.5
QUANTITY = "friction_torque"


@dataclass
class Pool:
    """Points of one case: reference values and every rung's error at them; new points first."""

    case: Case
    known: list[ReferencePoint]
    new: int
    errors: dict[str, list[float]]  # nan: the rung is not verified there

    def inside(self, box: dict[str, tuple[float, float]], old: bool = False) -> list[int]:
        """Return the new points in a box, away from folds; with ``old`` the others too."""
        return [
            k for k, t in enumerate(self.known[: None if old else self.new])
            if not t.beside_fold and all(lo <= t.point[n] <= hi for n, (lo, hi) in box.items())
        ]  # fmt: skip

    def worst(self, rung: str, points: list[int]) -> float:
        """Return a rung's largest error at points; infinite if it fails at one of them."""
        found = [self.errors[rung][k] for k in points]
        return math.inf if any(map(math.isnan, found)) else max(found)

    def served(self, choice: Choice | None, k: int) -> float:
        """Return the error at a point of the rung that serves it; 0 where nothing is promised."""
        while choice is not None and math.isfinite(choice.error):
            error = self.errors[choice.fidelity][k]
            if not math.isnan(error):
                return error
            choice = choice.outside
        return 0.0


def pool_of(case: Case, n: int) -> Pool:
    """Return new points of a case with the errors of all rungs that have cards."""
    source = source_of(case.spec.key)
    new = reference_points(dataclasses.replace(case, seed=SEED), source, n)
    known = new + reference_points(case, source, case.n)
    errors = {}
    for rung in case.spec.rungs:
        cards = {c.chart: c for c in fresh_cards(case.spec.key, rung, case.params)}
        if cards:
            errors[rung] = [error_at(case, rung, t, cards.get(t.chart)) for t in known]
    return Pool(case, known, len(new), errors)


def error_at(case: Case, rung: str, known: ReferencePoint, card: Card | None) -> float:
    """Return a rung's error at a point, as its card measures it."""
    if card is None or not card.covers(known.point):
        return math.nan
    found = answer(case.spec.key, case.params, rung, known)
    if found.verdict != OK:
        return math.nan
    floor = card.errors[QUANTITY].floor or 0.0
    return deviation(QUANTITY, known, found.values[QUANTITY], floor)


@dataclass
class Outcome:
    """What came of a request."""

    model: str
    tol: float
    chosen: str | None
    error: float  # true, of the rung chosen
    cheapest: str | None  # whose true error in the box is within tol
    guarded: str | None  # whose true error in the cells touched, with safety, is within tol


def ask(pool: Pool, rng: np.random.Generator) -> Outcome:
    """Make one random request and judge the answer."""
    box = random_box(pool, rng)
    tol, n_calls = 10.0 ** rng.uniform(-4.0, 0.0), 10.0 ** rng.uniform(2.0, 6.0)
    try:
        choice = choose(
            pool.case.spec.key, box, tol=tol, n_calls=n_calls, safety=SAFETY,
            params=pool.case.params,
        )  # fmt: skip
    except SolveError:
        choice = None
    points = pool.inside(box)
    around = pool.inside(cells_around(pool, box), old=True)
    order = sorted(pool.errors, key=lambda r: cost(pool.case, r, n_calls))
    cheapest = next((r for r in order if pool.worst(r, points) <= tol), None)
    guarded = next((r for r in order if SAFETY * pool.worst(r, around) <= tol), None)
    error = max((pool.served(choice, k) for k in points), default=0.0) if choice else math.nan
    chosen = choice.fidelity if choice else None
    return Outcome(pool.case.spec.key, tol, chosen, error, cheapest, guarded)


def random_box(pool: Pool, rng: np.random.Generator) -> dict[str, tuple[float, float]]:
    """Return a box of random size around a random point, inside the envelope."""
    away = [t for t in pool.known[: pool.new] if not t.beside_fold]
    middle = away[rng.integers(len(away))].point
    box = {}
    for name, axis in pool.case.envelope.items():
        half = 0.5 * rng.random()
        if axis.scale == "log":
            span = (axis.max / axis.min) ** half
            box[name] = (middle[name] / span, middle[name] * span)
        else:
            span = (axis.max - axis.min) * half
            box[name] = (middle[name] - span, middle[name] + span)
        box[name] = (max(box[name][0], axis.min), min(box[name][1], axis.max))
    return box


def cells_around(pool: Pool, box: dict[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
    """Return the box grown to whole cells of the cards, and to the envelope in other inputs."""
    grown = {n: (a.min, a.max) for n, a in pool.case.envelope.items()}
    some = next(iter(pool.errors))
    for card in fresh_cards(pool.case.spec.key, some, pool.case.params):
        for k, name in enumerate(card.cells.axes):
            edges = card.cells.edges[k]
            met = card.cells.touched(k, *box[name])
            low, high = edges[met[0]], edges[met[-1] + 1]
            known = grown[name] if grown[name] != (edges[0], edges[-1]) else (low, high)
            grown[name] = (min(low, known[0]), max(high, known[1]))
    return grown


def cost(case: Case, rung: str, n_calls: float) -> float:
    """Return the seconds that a rung's calls take, as the chooser counts them."""
    cards = fresh_cards(case.spec.key, rung, case.params)
    return max(n_calls * c.cost.call_median_s + c.cost.first_call_s for c in cards)


def report(outcomes: list[Outcome], order: dict[str, list[str]]) -> None:
    """Print how often the word was kept, and how often a cheaper rung would have done."""
    print("| model | requests | answered | true error within tolerance | cheapest that holds with "
          "safety, or cheaper | cheapest by the points in the box alone |")  # fmt: skip
    print("|---|---|---|---|---|---|")
    for model in [*dict.fromkeys(o.model for o in outcomes), "all"]:
        mine = [o for o in outcomes if model in (o.model, "all")]
        kept = [o.error <= o.tol for o in mine if o.chosen]
        right = [is_right(o, order[o.model]) for o in mine]
        strict = [o.chosen == o.cheapest for o in mine]
        shares = " | ".join(
            f"{100.0 * sum(x) / max(len(x), 1):.1f} %" for x in (kept, right, strict)
        )
        print(f"| {model} | {len(mine)} | {len(kept)} | {shares} |")


def is_right(o: Outcome, order: list[str]) -> bool:
    """Tell if the choice holds and none cheaper does so with safety in the cells touched."""
    rank = {**{r: k for k, r in enumerate(order)}, None: len(order)}
    holds = o.chosen is None or o.error <= o.tol
    return holds and rank[o.chosen] <= rank[o.guarded]


def main() -> None:
    """Ask and report."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("models", nargs="*", default=["washer", "clutch", "gearmesh"])
    parser.add_argument("--requests", type=int, default=500)
    parser.add_argument("--points", type=int, default=120, help="new points per parameter set")
    options = parser.parse_args()
    pools = [pool_of(c, options.points) for m in options.models for c in cases(m)]
    pools = [p for p in pools if p.errors and p.known]
    rng = np.random.default_rng(SEED)
    outcomes = [ask(pools[k % len(pools)], rng) for k in range(options.requests)]
    order = {p.case.spec.key: list(p.errors) for p in pools}
    report(outcomes, order)


if __name__ == "__main__":
    main()
