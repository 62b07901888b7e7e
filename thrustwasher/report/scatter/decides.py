"""What decides a figure: total Sobol' indices, else rank correlations of the sample."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .words import joined, percent, probability, title_of, varies

Array = NDArray[np.float64]
LEAST = 0.02  # an index or the square of a correlation below this decides nothing
LEAST_PAIRS = 8  # of values, for a correlation
INDEX, RANK = "total index", "rank correlation"


class Share(NamedTuple):
    """How much of a figure a source decides, by one measure."""

    source: str
    value: float
    """A total index, or a rank correlation, which has a sign where the source is a number."""
    half: float
    """Half its 95 % confidence interval."""
    by: str

    @property
    def weight(self) -> float:
        """Its share of the variance, of the ranks' variance for a correlation."""
        return self.value if self.by == INDEX else self.value**2


def shares(result: Any, name: str) -> list[Share]:
    """Return what every source decides of a figure, the largest first.

    By total indices where the study has them, else by rank correlations (Spearman's; of a choice
    the correlation ratio of ranks); [] where the figure does not scatter.
    """
    band = result.figures[name]
    found = [
        Share(source, index.total, _half(index), INDEX)
        for source, index in band.indices.items()
        if index is not None and index.total is not None and math.isfinite(index.total)
    ]
    if not band.indices and varies(band):
        found = _correlations(result, name)
    return sorted(found, key=lambda share: -share.weight)


def _half(index: Any) -> float:
    """Return half the confidence interval of a total index."""
    half = index.confidence if index.total_confidence is None else index.total_confidence
    return float(half) if half is not None and math.isfinite(half) else math.inf


def column(sample: Mapping[str, Any], name: str) -> Array | None:
    """Return a figure's column of the sample, None if there is none."""
    values = sample.get(f"{name} (result)", sample.get(name))
    return None if values is None else np.asarray(values, dtype=float)


def _correlations(result: Any, name: str) -> list[Share]:
    values = column(result.sample, name)
    if values is None:
        return []
    there = np.isfinite(values)
    n = int(there.sum())
    if n < LEAST_PAIRS or not np.ptp(values[there]):
        return []
    ranks, found = _ranks(values[there]), []
    for source in result.sources:
        drawn = np.asarray(result.sample[source.name])[there]
        is_choice = isinstance(source.nominal, str | bool)
        r = _ratio(drawn, ranks) if is_choice else _correlation(_ranks(drawn), ranks)
        # Fisher's transformation; the factor is that of ranks (Bonett & Wright 2000)
        half = 1.96 * math.sqrt((1.0 + 0.5 * r * r) / (n - 3)) * (1.0 - r * r)
        found.append(Share(source.name, r, half, RANK))
    return found


def _ranks(values: Array) -> Array:
    """Return the ranks of values, equal ones share theirs."""
    from scipy.stats import rankdata

    found: Array = rankdata(np.asarray(values, dtype=float))
    return found


def _correlation(x: Array, y: Array) -> float:
    x, y = x - x.mean(), y - y.mean()
    size = math.sqrt(float(x @ x) * float(y @ y))
    return float(x @ y) / size if size else 0.0


def _ratio(choices: NDArray[Any], y: Array) -> float:
    """Return the correlation ratio: what the means of the choices explain."""
    means = y.copy()
    for choice in set(choices.tolist()):
        means[choices == choice] = y[choices == choice].mean()
    whole = float(((y - y.mean()) ** 2).sum())
    return math.sqrt(float(((means - y.mean()) ** 2).sum()) / whole) if whole else 0.0


def share_words(share: Share, words: Callable[[str], str] = joined) -> str:
    """Return what a source decides in words."""
    if share.by == RANK:
        return f"{words(share.source)} (rank correlation {signed(share.value)})"
    half = f" ± {share.half:.2f}" if math.isfinite(share.half) else ""
    return f"{words(share.source)} (total index {share.value:.2f}{half})"


def signed(value: float) -> str:
    """Return two decimals with a sign that is one."""
    return f"{value:.2f}".replace("-", "\N{MINUS SIGN}")


def most_decided(result: Any, names: Sequence[str]) -> tuple[str, Share] | None:
    """Return the figure of these that one source decides most, and that source; None if none is."""
    found = [(name, of[0]) for name in names if (of := shares(result, name))]
    found = [item for item in found if item[1].weight >= LEAST]
    return max(found, key=lambda item: item[1].weight, default=None)


def verdict(
    result: Any, of: str, names: Sequence[str], words: Callable[[str], str] = joined
) -> list[str]:
    """Return what the verdict on something rests on; [] where none of its figures scatters.

    Parameters
    ----------
    of : what is judged, as "the washers"
    names : its figures; the one that a single source decides most speaks for all
    words : what a source is, by its name
    """
    names = [name for name in names if name in result.figures and varies(result.figures[name])]
    top = most_decided(result, names)
    if top is None:
        return [f"No single input decides the figures of {of}."] if names else []
    name, first = top
    title = title_of(name, result.figures[name])
    others = [s for s in shares(result, name)[1:3] if s.weight >= 0.1]
    if first.by == INDEX:
        share = percent(min(first.value, 1.0))
        what = f"alone or with others it makes {share} of the variance of “{title}”"
        what += f" (± {100.0 * first.half:.0f} %)" if first.half < math.inf else ""
    else:
        what = f"its rank correlation with “{title}” is {signed(first.value)}"
    is_sure = first.half < 0.5 * abs(first.value)
    doubt = "" if is_sure else " These runs are too few to be sure of it."
    then = f"; then {' and '.join(share_words(s, words) for s in others)}" if others else ""
    return [f"The verdict on {of} rests most on {words(first.source)}: {what}{then}.{doubt}"]


def chances(result: Any, names: Sequence[str] = ()) -> list[str]:
    """Return the probabilities of yes and no in words, of these names or all."""
    return [
        f"{name.replace('_', ' ')}: probability {probability(p)}"
        for name, p in result.probabilities.items()
        if not names or name in names
    ]
