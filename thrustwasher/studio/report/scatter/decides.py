"""What decides a figure: total Sobol' indices, else a regression of the sample's ranks.

Source of the latter: Iman & Conover 1979 (standardised rank regression coefficients).
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .study_data import Index, Study
from .words import LOST, LOST_TEXTS, joined, percent, probability, title_of, varies

Array = NDArray[np.float64]
LEAST = 0.02  # an index or the square of a coefficient below this decides nothing
PER_SOURCE = 2  # runs that a regression takes at least
MOST_TIED = 3  # inputs that are named as not told apart
INDEX, RANK = "total index", "rank regression coefficient"


class Share(NamedTuple):
    """How much of a figure a source decides, by one measure."""

    source: str
    value: float
    """A total index, or a rank regression coefficient, with a sign where it is of one number."""
    half: float
    """Half its 95 % confidence interval."""
    by: str

    @property
    def weight(self) -> float:
        """Its share of the variance, of the ranks' variance for a coefficient."""
        return self.value if self.by == INDEX else self.value**2

    @property
    def is_sure(self) -> bool:
        """Whether it decides something, and its confidence interval excludes zero."""
        return self.weight >= LEAST and self.half < abs(self.value)


def shares(result: Study, name: str) -> list[Share]:
    """Return what every source decides of a figure, the largest first.

    By total indices where the study has them, else by the regression of its ranks on the ranks of
    all sources; [] where the figure does not scatter or the runs are too few.
    """
    band = result.figures[name]
    found = [
        Share(source, index.total, _half(index), INDEX)
        for source, index in band.indices.items()
        if index is not None and index.total is not None and math.isfinite(index.total)
    ]
    if not band.indices and varies(band):
        found = _coefficients(result, name)
    return sorted(found, key=lambda share: -share.weight)


def _half(index: Index) -> float:
    """Return half the confidence interval of a total index."""
    half = index.confidence if index.total_confidence is None else index.total_confidence
    return float(half) if half is not None and math.isfinite(half) else math.inf


def column(sample: Mapping[str, object], name: str) -> Array | None:
    """Return a figure's column of the sample, None if there is none."""
    values = sample.get(f"{name} (result)", sample.get(name))
    return None if values is None else np.asarray(values, dtype=float)


def _coefficients(result: Study, name: str) -> list[Share]:
    """Return the standardised coefficients of a figure's ranks on the ranks of all sources.

    A choice takes part by an indicator of each word. A choice, and correlated sources together,
    have the standard deviation that they make, which has no sign; zero is excluded by an F-test.
    """
    from scipy.stats import f, t

    values = column(result.sample, name)
    there = np.isfinite(values) if values is not None else np.zeros(0, bool)
    n = int(there.sum())
    if values is None or n <= PER_SOURCE * len(result.sources) or not np.ptp(values[there]):
        return []
    names = list(result.groups) or [s.name for s in result.sources]
    blocks = [[c for one in g.split(" + ") for c in _columns(result, one, there)] for g in names]
    x = np.column_stack([np.ones(n), *(c for block in blocks for c in block)])
    y = _standard(_ranks(values[there]))
    free = n - x.shape[1]
    if free < 1:
        return []
    inverse = np.linalg.pinv(x.T @ x, hermitian=True)
    slopes = inverse @ (x.T @ y)
    covariance = inverse * float(((y - x @ slopes) ** 2).sum()) / free
    found, end, wide = [], 1, float(t.ppf(0.975, free))
    for group, block in zip(names, blocks, strict=True):
        own, end = slice(end, end + len(block)), end + len(block)
        slope, error = slopes[own], covariance[own, own]
        if len(block) == 1 and not _is_choice(result, group):
            found.append(Share(group, float(slope[0]), wide * math.sqrt(error[0, 0]), RANK))
        elif block:
            spread = np.atleast_2d(np.cov(x[:, own], rowvar=False, bias=True))
            size = math.sqrt(max(float(slope @ spread @ slope), 0.0))
            along = spread @ slope / size if size else 0.0 * slope
            half = wide * math.sqrt(max(float(along @ error @ along), 0.0))
            ratio = float(slope @ np.linalg.pinv(error, hermitian=True) @ slope) / len(block)
            is_other = f.sf(ratio, len(block), free) < 0.05
            found.append(Share(group, size, half if is_other else max(half, size), RANK))
    return found


def _is_choice(result: Study, name: str) -> bool:
    return any(s.name == name and isinstance(s.nominal, str | bool) for s in result.sources)


def _columns(result: Study, name: str, there: NDArray[np.bool_]) -> list[Array]:
    """Return a source as a regression takes it: its ranks, or an indicator of each word but one."""
    drawn = np.asarray(result.sample[name])[there]
    if not _is_choice(result, name):
        return [_standard(_ranks(drawn))] if np.ptp(drawn) else []
    return [_standard((drawn == word) * 1.0) for word in list(dict.fromkeys(drawn.tolist()))[1:]]


def _standard(x: Array) -> Array:
    """Return values less their mean, over their standard deviation."""
    found: Array = (x - x.mean()) / x.std()
    return found


def _ranks(values: Array) -> Array:
    """Return the ranks of values, equal ones share theirs."""
    from scipy.stats import rankdata

    found: Array = rankdata(np.asarray(values, dtype=float))
    return found


def leading(of: Sequence[Share]) -> list[Share]:
    """Return the sure source that decides most, and those that are not told apart from it.

    The first stands alone if its value less its confidence exceeds the next one's.
    """
    sure = [share for share in of if share.is_sure]
    least = abs(sure[0].value) - sure[0].half if sure else 0.0
    return [share for share in sure if abs(share.value) >= least]


def most_words(of: Sequence[Share], words: Callable[[str], str] = joined) -> str:
    """Return what decides most in words, as the end of a sentence."""
    first = leading(of)
    if not first:
        return "these runs are too few to say what decides it"
    tied = ", not distinguished by so few runs" if len(first) > 1 else ""
    shown = " and ".join(share_words(s, words) for s in first[:MOST_TIED])
    return f"decided most by {shown}{tied}"


def flagged(result: Study, words: Callable[[str], str] = joined) -> Callable[[str], str]:
    """Return words of a source that say if it rests on an estimate."""
    estimates = {s.name for s in result.sources if s.reason.lower().startswith("estimate")}

    def found(name: str) -> str:
        is_one = not estimates.isdisjoint(name.split(" + "))
        return words(name) + (", an estimate" if is_one else "")

    return found


def share_words(share: Share, words: Callable[[str], str] = joined) -> str:
    """Return what a source decides in words."""
    half = f" ± {share.half:.2f}" if math.isfinite(share.half) else ""
    return f"{words(share.source)} ({share.by} {signed(share.value)}{half})"


def signed(value: float) -> str:
    """Return two decimals with a sign that is one."""
    return f"{value:.2f}".replace("-", "\N{MINUS SIGN}")


def verdict(
    result: Study, of: str, names: Sequence[str], words: Callable[[str], str] = joined
) -> list[str]:
    """Return what the verdict on something rests on; [] where none of its figures scatters.

    Parameters
    ----------
    of : what is judged, as "the washers"
    names : its figures; the one that a single source decides most speaks for all
    words : what a source is, by its name
    """
    names = [name for name in names if name in result.figures and varies(result.figures[name])]
    found = {name: own for name in names if (own := shares(result, name))}
    sure = [name for name, own in found.items() if leading(own)]
    if names and not sure:
        if found and not any(s.weight >= LEAST for own in found.values() for s in own):
            return [f"No single input decides the figures of {of}."]
        return [f"These runs are too few to say which input decides the figures of {of}."]
    if not names:
        return []
    words = flagged(result, words)
    name = max(sure, key=lambda name: leading(found[name])[0].weight)
    title, first = title_of(name, result.figures[name]), leading(found[name])
    others = [s for s in found[name] if s.is_sure and s.weight >= 0.1 and s not in first][:2]
    then = f"; then {' and '.join(share_words(s, words) for s in others)}" if others else ""
    if len(first) > 1:
        shown = " and ".join(share_words(s, words) for s in first[:MOST_TIED])
        return [
            f"The verdict on {of} rests most on {shown}, by “{title}”, not distinguished by so few "
            f"runs{then}."
        ]
    top = first[0]
    if top.by == INDEX:
        share = percent(min(top.value, 1.0))
        what = f"alone or with others it makes {share} of the variance of “{title}”"
        what += f" (± {100.0 * top.half:.0f} %)"
    else:
        what = f"its {RANK} for “{title}” is {signed(top.value)} ± {top.half:.2f}"
    return [f"The verdict on {of} rests most on {words(top.source)}: {what}{then}."]


def chances(result: Study, names: Sequence[str] = ()) -> list[str]:
    """Return the probabilities of yes and no in words, of these names or all."""
    return [
        f"{name.replace('_', ' ')}: probability {probability(p, result.runs)}"
        for name, p in result.probabilities.items()
        if not names or name in names
    ]


def lost_texts(result: Study) -> list[str]:
    """Return what a lost film is, and how many runs form a group of their own by it."""
    if LOST not in result.probabilities or result.kind not in LOST_TEXTS:
        return []
    texts = [f"“Film lost” means: {LOST_TEXTS[result.kind]}."]
    lost, p = column(result.sample, LOST), result.probabilities[LOST]
    if lost is not None and 0.0 < p.value < 0.5:
        count = int(np.nansum(lost))
        texts.append(
            f"In {count} of {result.runs} base runs the film is lost; they form a second "
            "group: a 5 or 95 % quantile near that share may fall into either group."
        )
    return texts
