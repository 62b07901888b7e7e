"""What is known of inputs and parameters only within bounds: tables ``[scatter]`` as distributions.

A line of such a table gives the law of one parameter, input or choice of the model; correlated ones
are joined by a Gaussian copula. Where a law reaches over the allowed range it is truncated there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ..errors import ParameterError, suggestion, within
from ..units import format_quantity, parse_quantity
from .quantity import Quantity

if TYPE_CHECKING:  # part files are read without numpy
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

LAWS = ("normal", "lognormal", "uniform", "either")
CORRELATION = "correlation"
MUCH_CUT = 0.01  # share of the probability outside the allowed range that is worth a warning
LEAST_LEFT = 1e-6  # of the probability, inside the allowed range
LARGEST_WEIGHT = 1e100  # so that their sum is a number
LEAST_U = 2.0**-53  # quantiles at 0 and 1 would be infinite


@dataclass(frozen=True, kw_only=True)
class Law:
    """One distribution; ``low`` and ``high`` [SI] are where it ends, at the latest the range's."""

    kind: str
    """One of ``LAWS``."""
    low: float = -math.inf
    high: float = math.inf
    middle: float = 0.0
    """Mean [SI] of the normal law before it is truncated; of the lognormal law's logarithm."""
    spread: float = 0.0
    """Standard deviation [SI] of the normal law; of the lognormal law's logarithm."""
    is_share: bool = False
    """Its spread grows with the nominal value: a normal law of so many percent, a lognormal one."""
    options: tuple[Any, ...] = ()
    weights: tuple[float, ...] = ()
    """Probabilities of the options."""
    cut: float = 0.0
    """Share of the probability outside the allowed range."""
    text: str

    def value(self, u: Array) -> Array | list[Any]:
        """Return the quantiles, F^-1(u).

        Parameters
        ----------
        u : (n,) array of probabilities; 0 and 1 count as the next number inside

        Returns
        -------
        (n,) array [SI], between ``low`` and ``high``; of a choice the list of its values
        """
        import numpy as np
        from scipy.special import ndtr, ndtri

        u = np.clip(u, LEAST_U, 1.0 - LEAST_U)
        if self.kind == "either":
            places = np.searchsorted(np.cumsum(self.weights)[:-1], u, side="right")
            return [self.options[i] for i in places]
        if self.kind == "uniform":
            return self.low + u * (self.high - self.low)
        start, end = ndtr(self._scores())
        x = self.middle + self.spread * ndtri(start + u * (end - start))
        x = np.exp(x) if self.kind == "lognormal" else x
        found: Array = np.clip(x, self.low, self.high)
        return found

    def _scores(self) -> tuple[float, float]:
        """Return the ends in standard deviations from the middle."""
        ends = self.low, self.high
        if self.kind == "lognormal":
            ends = tuple(math.log(x) if x > 0.0 else -math.inf for x in ends)  # type: ignore[assignment]
        return (ends[0] - self.middle) / self.spread, (ends[1] - self.middle) / self.spread

    def words(self) -> str:
        """Return the law in words, as "normal, standard deviation 10 %"."""
        return self.text


@dataclass(frozen=True, kw_only=True)
class Source:
    """A place that scatters by a law."""

    place: Quantity
    law: Law
    reason: str = ""
    """Where the law comes from: a source, "estimate", or "" if the user gave none."""


@dataclass(frozen=True, kw_only=True)
class Scatter:
    """All that scatters of a part or scene."""

    sources: tuple[Source, ...] = ()
    pairs: tuple[tuple[int, int, float], ...] = ()
    """Places of two correlated sources, correlation of their normal scores."""
    warnings: tuple[str, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the sources."""
        return tuple(s.place.name for s in self.sources)

    @property
    def correlation(self) -> Array:
        """Correlation of the sources' normal scores, (k, k)."""
        import numpy as np

        found = np.eye(len(self.sources))
        for i, j, value in self.pairs:
            found[i, j] = found[j, i] = value
        return found

    @property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """Places of sources that are correlated, directly or by others, in the order of first."""
        group = list(range(len(self.sources)))
        for i, j, value in self.pairs:
            if value:
                old, new = group[j], group[i]
                group = [new if g == old else g for g in group]
        return tuple(
            tuple(i for i, g in enumerate(group) if g == own) for own in dict.fromkeys(group)
        )

    def values(self, u: Array) -> list[dict[str, Any]]:
        """Return draws: values [SI] by name.

        Gaussian copula: x = F^-1(Phi(z)), z = L Phi^-1(u), L the Cholesky factor of the correlation
        R = L L'. The values of a group of correlated sources depend on its columns alone.

        Parameters
        ----------
        u : (n, k) array of independent probabilities, uniform in (0, 1); a column per source

        Returns
        -------
        n rows
        """
        import numpy as np
        from scipy.special import ndtr, ndtri

        u = np.clip(np.asarray(u, float), LEAST_U, 1.0 - LEAST_U)
        for group in self.groups:
            if len(group) > 1:
                own = np.linalg.cholesky(self.correlation[np.ix_(group, group)])
                u[:, group] = ndtr(np.einsum("nj,ij->ni", ndtri(u[:, group]), own))
        columns = [
            np.asarray(s.law.value(c), object) for s, c in zip(self.sources, u.T, strict=True)
        ]
        names = self.names
        return [{n: c[row] for n, c in zip(names, columns, strict=True)} for row in range(len(u))]


def read_scatter(
    where: str, table: Mapping[str, object], places: Mapping[str, Quantity]
) -> Scatter:
    """Return what a table ``[scatter]`` says.

    Parameters
    ----------
    where : file and table, for messages
    table : as TOML has it: name -> law, next to them ``correlation``. The name of a place with dots
        in it may be written as tables within tables too
    places : what can scatter, by name

    Raises
    ------
    ParameterError : an unknown name, a law that is none or does not fit, correlations that no
        distribution has

    Examples
    --------
    >>> place = Quantity(name="roughness", unit="m", nominal=5e-7, low=1e-7, high=1e-5)
    >>> scatter = read_scatter("[scatter]", {"roughness": "10 %"}, {"roughness": place})
    >>> scatter.sources[0].law.words()
    'normal, standard deviation 10 %'
    """
    sources: dict[str, Source] = {}
    for name, given in _lines(where, table, places):
        place = places[name]
        if place.name in sources:
            raise ParameterError(f"{where}: {place.name} is there twice, allowed: once")
        with within(f"{where}: {name}"):
            sources[place.name] = _source(place, given)
    found = tuple(sources.values())
    pairs = _pairs(f"{where}: {CORRELATION}", table.get(CORRELATION, []), found)
    scatter = Scatter(sources=found, pairs=pairs, warnings=tuple(_warnings(found)))
    _check_definite(f"{where}: {CORRELATION}", scatter)
    return scatter


def _lines(
    where: str, table: Mapping[str, object], places: Mapping[str, Quantity], above: str = ""
) -> Iterator[tuple[str, Any]]:
    for key, given in table.items():
        name = above + key
        if name in places:
            yield name, given
        elif isinstance(given, Mapping) and any(p.startswith(f"{name}.") for p in places):
            yield from _lines(where, given, places, f"{name}.")
        elif name != CORRELATION:
            hint = suggestion(name, places, "; did you mean {!r}?", "")
            raise ParameterError(f"{where}: there is no {name!r} that could scatter{hint}")


def _source(place: Quantity, given: object) -> Source:
    table = given if isinstance(given, Mapping) else {"normal": given}
    kinds = [k for k in table if k in LAWS]
    if len(kinds) != 1 or table.keys() - {*LAWS, "weights", "source"}:
        raise ParameterError(
            f"{dict(table)!r}, allowed: one of {', '.join(LAWS)}, with source (and weights of "
            "either)"
        )
    kind, reason = kinds[0], table.get("source", "")
    if not isinstance(reason, str):
        raise ParameterError(f"source = {reason!r}, allowed: a text")
    if "weights" in table and kind != "either":
        raise ParameterError(f"weights together with {kind}, allowed: with either")
    if bool(place.choices) != (kind == "either"):
        fits = f"{{ either = [..] }} of {place.range_text}"
        fits = fits if place.choices else "normal, lognormal or uniform; it is no choice"
        raise ParameterError(f"{kind} = {table[kind]!r}, allowed: {fits}")
    if kind == "either":
        law = _either(place, table[kind], table.get("weights"))
    else:
        law = {"normal": _normal, "lognormal": _lognormal, "uniform": _uniform}[kind](
            place, table[kind]
        )
    return Source(place=place, law=law, reason=reason)


def _number(value: object, unit: str, name: str, *, difference: bool) -> float:
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ParameterError(f"{name} = {value!r}, a number or a text with its unit is required")
    return parse_quantity(value, unit, name, difference=difference)


def _refuse_share(place: Quantity, words: str) -> None:
    """Refuse a law that is relative to the nominal value where that makes no sense."""
    if place.unit == "K" and not place.relative:
        raise ParameterError(
            f"{words} of an absolute temperature, allowed: a standard deviation in K, "
            'such as "3 K", or uniform'
        )
    if place.nominal == 0.0:
        unit = "" if place.unit == "1" else f" in {place.unit}"
        raise ParameterError(
            f"{words} of a nominal value of 0, allowed: a standard deviation{unit}, or uniform"
        )


def _normal(place: Quantity, given: object) -> Law:
    """Return the normal law about the nominal value: a share of it, or a standard deviation."""
    mean, words = float(place.nominal), f"normal = {given!r}"
    is_share = isinstance(given, str) and given.rstrip().endswith("%")
    if is_share:
        share = _number(given, "1", "normal", difference=True)
        _refuse_share(place, words)
        spread, text = share * abs(mean), f"{format_quantity(100.0 * share, '1')} %"
    else:
        spread = _number(given, place.unit, "normal", difference=True)
        text = format_quantity(spread, place.unit, difference=True)
    if not spread > 0.0:
        raise ParameterError(f"{words}, allowed: a standard deviation above 0")
    text = f"normal, standard deviation {text}"
    return replace(_truncated(place, "normal", mean, spread, text), is_share=is_share)


def _lognormal(place: Quantity, given: object) -> Law:
    """Return the lognormal law whose median is the nominal value."""
    words = f"lognormal = {given!r}"
    factor = _number(given, "1", "lognormal", difference=True)
    _refuse_share(place, words)
    if not factor > 1.0:
        raise ParameterError(
            f"{words}, allowed: the factor of one standard deviation, above 1, such as 1.3"
        )
    if place.nominal < 0.0:  # type: ignore[operator]
        raise ParameterError(
            f"{words} of the nominal value {place.text(place.nominal)}, allowed: above 0"
        )
    middle = math.log(float(place.nominal))
    text = f"lognormal, factor {factor:g}"
    return replace(_truncated(place, "lognormal", middle, math.log(factor), text), is_share=True)


def _truncated(place: Quantity, kind: str, middle: float, spread: float, text: str) -> Law:
    from statistics import NormalDist  # late: for normal laws alone

    law = Law(kind=kind, low=place.low, high=place.high, middle=middle, spread=spread, text=text)
    low, high = law._scores()
    start, end = map(NormalDist().cdf, (low, high))
    wide = end - start < LEAST_LEFT or high - low < 1.0  # in standard deviations
    if wide or middle + spread == middle:
        raise ParameterError(
            f"{text}: {'so wide that it is uniform' if wide else 'nothing'} "
            f"compared with {place.text(place.nominal)} in {place.range_text}, allowed: a standard "
            f"deviation {'no wider than that range' if wide else 'of that size'}, or uniform"
        )
    return replace(law, cut=1.0 - (end - start))


def _uniform(place: Quantity, given: object) -> Law:
    words = f"uniform = {given!r}"
    if not isinstance(given, Sequence) or isinstance(given, str) or len(given) != 2:
        raise ParameterError(f"{words}, allowed: [low, high]")
    low, high = (_number(x, place.unit, "uniform", difference=place.relative) for x in given)
    if not low < high:
        raise ParameterError(f"{words}, allowed: low < high")
    left, right = max(low, place.low), min(high, place.high)
    if not left < right:
        raise ParameterError(f"{words}, allowed: within {place.range_text}")
    text = f"uniform {place.text(low)} .. {place.text(high)}"
    return Law(
        kind="uniform", low=left, high=right, cut=1.0 - (right - left) / (high - low), text=text
    )


def _either(place: Quantity, given: Any, weights: Any) -> Law:
    words = f"either = {given!r}"
    good = isinstance(given, list | tuple) and len(given) > 1
    if not good or any(_choice(place, x) is None for x in given):
        raise ParameterError(f"{words}, allowed: two or more of {place.range_text}")
    if any(x in given[:i] for i, x in enumerate(given)):
        raise ParameterError(f"{words}, allowed: each value once, with weights")
    n = len(given)
    numbers = [1.0] * n if weights is None else weights
    good = isinstance(numbers, list | tuple) and len(numbers) == n
    if not good or not all(_is_weight(w) for w in numbers):
        raise ParameterError(f"weights = {weights!r}, allowed: {n} numbers above 0, one per value")
    shares = tuple(w / math.fsum(numbers) for w in numbers)
    texts = map(place.text, given)
    if weights is None:
        text = f"either {' or '.join(texts)}"
    else:
        parts = (f"{t} ({100.0 * p:.3g} %)" for t, p in zip(texts, shares, strict=True))
        text = f"either {' or '.join(parts)}"
    return Law(kind="either", options=tuple(given), weights=shares, text=text)


def _choice(place: Quantity, value: object) -> Any:
    """Return the allowed value that equals this one and is of its kind; None if there is none."""
    return next((c for c in place.choices if c == value and type(c) is type(value)), None)


def _is_weight(value: Any) -> bool:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    return number and 0.0 < value < LARGEST_WEIGHT


def _pairs(
    where: str, given: object, sources: Sequence[Source]
) -> tuple[tuple[int, int, float], ...]:
    """Return the correlations by the places of their sources."""
    scores = {s.place.name: i for i, s in enumerate(sources) if s.law.kind != "either"}
    choices = {s.place.name for s in sources} - scores.keys()
    if not isinstance(given, list | tuple):
        raise ParameterError(f"{where} = {given!r}, allowed: a list of [name, name, number]")
    found: dict[tuple[int, int], float] = {}
    for line in given:
        if not isinstance(line, list | tuple) or len(line) != 3:
            raise ParameterError(f"{where}: {line!r}, allowed: [name, name, number]")
        *pair, value = line
        for name in pair:
            if not isinstance(name, str):
                raise ParameterError(f"{where}: {line!r}, allowed: [name, name, number]")
            if name in choices:
                raise ParameterError(f"{where}: {name} is a choice, allowed: what has numbers")
            if name not in scores:
                raise ParameterError(
                    f"{where}: {name!r} does not scatter, allowed: {', '.join(scores) or 'none'}"
                )
        i, j = sorted(scores[name] for name in pair)
        number = isinstance(value, int | float) and not isinstance(value, bool)
        if not number or not -1.0 < value < 1.0:
            raise ParameterError(f"{where}: {line!r}, allowed: a number between -1 and 1")
        if i == j or (i, j) in found:
            raise ParameterError(f"{where}: {line!r}, allowed: two names, each pair once")
        found[i, j] = float(value)
    return tuple((i, j, value) for (i, j), value in found.items())


def _check_definite(where: str, scatter: Scatter) -> None:
    """Raise ParameterError unless the correlations are those of some distribution."""
    if len(scatter.pairs) < 2:
        return
    import numpy as np

    try:
        np.linalg.cholesky(scatter.correlation)
    except np.linalg.LinAlgError:
        names = {scatter.names[i]: None for pair in scatter.pairs for i in pair[:2]}
        raise ParameterError(
            f"{where}: not positive definite between {', '.join(names)}: these correlations "
            "contradict each other; make them smaller, or name those that are missing"
        ) from None


def _warnings(sources: Sequence[Source]) -> Iterator[str]:
    for s in sources:
        place, law = s.place, s.law
        if law.cut > MUCH_CUT:
            yield (
                f"scatter of {place.name}: {100.0 * law.cut:.3g} % of the probability is outside "
                f"the allowed {place.range_text} and is cut off"
            )
        inside = law.kind != "uniform" or law.low <= place.nominal <= law.high  # type: ignore[operator]
        if not inside or (law.kind == "either" and place.nominal not in law.options):
            yield (
                f"scatter of {place.name}: {law.words()}, but its nominal value is "
                f"{place.text(place.nominal)}"
            )
