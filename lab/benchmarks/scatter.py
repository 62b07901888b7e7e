"""How often confidence intervals of small studies hold what they are intervals of.

``python -m lab.benchmarks.scatter [--studies 100] [--runs 64 128 256]`` repeats studies of
functions whose quantiles, probabilities and Sobol' indices are known, each with another seed,
and prints how many per cent of the intervals hold the true value.
"""

import argparse
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import norm

from thrustwasher.studio.scatter.design import make_design
from thrustwasher.studio.scatter.estimates import (
    LEVELS,
    index_confidence,
    probability_bounds,
    quantile_bounds,
    sobol_indices,
)

MANY = 2**20  # points that tell the true quantiles
TENTH = 1.2815515655446004  # standard deviations beyond which there is a tenth


@dataclass(frozen=True)
class Known:
    """A function of independent sources, with its indices; ``limit``: P(y > limit) is requested."""

    value: Callable[[Any], Any]  # (n, k) uniforms -> (n,)
    first: tuple[float, ...]
    total: tuple[float, ...]
    limit: float


def linear(weights: Iterable[float]) -> Known:
    """Return a sum of normal sources."""
    c = np.array(list(weights))
    share = tuple(c**2 / (c @ c))
    return Known(
        lambda u: norm.ppf(u) @ c, share, share, 1.2815515655446004 * float(np.sqrt(c @ c))
    )


def ishigami(a: float = 7.0, b: float = 0.1) -> Known:
    """Return Ishigami's function on +-pi; indices in closed form."""

    def value(u: Any) -> Any:
        x = np.pi * (2.0 * u - 1.0)
        return np.sin(x[:, 0]) * (1.0 + b * x[:, 2] ** 4) + a * np.sin(x[:, 1]) ** 2

    alone = 0.5 * (1.0 + b * np.pi**4 / 5.0) ** 2
    joined = b**2 * np.pi**8 * (1.0 / 18.0 - 1.0 / 50.0)
    v = alone + a**2 / 8.0 + joined
    first = alone / v, a**2 / 8.0 / v, 0.0
    total = (alone + joined) / v, a**2 / 8.0 / v, joined / v
    return Known(value, first, total, 8.0)


def fold() -> Known:
    """Return a film that is lost: y = 1 + x1 / 5 below a load of x2 = 0.9, else 6 + x1."""

    def value(u: Any) -> Any:
        lost = u[:, 1] > 0.9
        return np.where(lost, 6.0 + u[:, 0], 1.0 + 0.2 * u[:, 0])

    # y = m(x2) + s(x2) (x1 - 1/2): m = 1.1 or 6.5, s = 0.2 or 1
    p, s = 0.1, np.array([0.2, 1.0])
    of_load = p * (1.0 - p) * 5.4**2
    mean_s = (1.0 - p) * s[0] + p * s[1]
    alone, both = mean_s**2 / 12.0, ((1.0 - p) * s[0] ** 2 + p * s[1] ** 2) / 12.0
    v = of_load + both
    joined = both - alone
    return Known(
        value, (alone / v, of_load / v), ((alone + joined) / v, (of_load + joined) / v), 3.0
    )


def product(spreads: Iterable[float] = (0.4, 0.3, 0.2)) -> Known:
    """Return a product of lognormal sources: skewed, all interactions."""
    s = np.array(list(spreads))
    w = np.exp(s**2) - 1.0
    v = np.prod(1.0 + w) - 1.0
    first, total = w / v, w / (1.0 + w) * (1.0 + v) / v
    limit = float(np.exp(TENTH * np.sqrt(s @ s)))
    return Known(lambda u: np.exp(norm.ppf(u) @ s), tuple(first), tuple(total), limit)


FUNCTIONS: dict[str, Callable[[], Known]] = {
    "linear": lambda: linear((3.0, 2.0, 1.0)),
    "linear, 8 sources": lambda: linear((3.0, 2.0, 1.0, 1.0, 0.5, 0.5, 0.2, 0.1)),
    "Ishigami": ishigami,
    "fold": fold,
    "product": product,
}


def coverage(known: Known, runs: int, studies: int, truth: Mapping[str, float]) -> dict[str, float]:
    """Return the share of studies (seeds 1, 2 ...) whose interval holds each true value."""
    k = len(known.first)
    hits: dict[str, list[bool]] = {}
    for seed in range(1, studies + 1):
        design = make_design(runs, k, [(i,) for i in range(k)], seed)
        rows = np.concatenate([u for _, u in design.batches()])
        y = known.value(rows).reshape(runs, -1, 1)
        base = y[:, 0, 0]
        for level in LEVELS:
            low, high = quantile_bounds(base, level)
            hits.setdefault(f"{level:g}", []).append(low <= truth[f"{level:g}"] <= high)
        low, high = probability_bounds((base > known.limit) * 1.0)
        hits.setdefault("P", []).append(low <= truth["P"] <= high)
        parts = y[:, 0], y[:, 1], np.moveaxis(y[:, 2:], 1, 0)
        first, total, _ = sobol_indices(*parts)
        halves = index_confidence(*parts)
        for i in range(k):
            hits.setdefault(f"S{i + 1}", []).append(
                bool(abs(first[i, 0] - known.first[i]) <= halves[0][i, 0])
            )
            hits.setdefault(f"T{i + 1}", []).append(
                bool(abs(total[i, 0] - known.total[i]) <= halves[1][i, 0])
            )
    return {name: float(np.mean(found)) for name, found in hits.items()}


def truth(known: Known, points: int = MANY) -> dict[str, float]:
    """Return quantiles and P(y > limit) of many points."""
    from scipy.stats import qmc

    y = known.value(qmc.Sobol(len(known.first), seed=np.random.default_rng(0)).random(points))
    found = dict(zip((f"{level:g}" for level in LEVELS), np.quantile(y, LEVELS), strict=True))
    return found | {"P": float((y > known.limit).mean())}


def main() -> None:
    """Print a table per size of the studies."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--studies", type=int, default=100)
    parser.add_argument("--runs", type=int, nargs="+", default=[64, 128, 256])
    arguments = parser.parse_args()
    for name, make in FUNCTIONS.items():
        known = make()
        true = truth(known)
        for runs in arguments.runs:
            found = coverage(known, runs, arguments.studies, true)
            cells = "  ".join(f"{what} {100.0 * share:.0f}" for what, share in found.items())
            print(f"{name}, {runs} base points: {cells}", flush=True)


if __name__ == "__main__":
    main()
