"""What a page reads of a study: its figures, what decides them, probabilities, bands over time.

``studio.scatter.result`` makes it; pages lie below that and import none of it.
"""

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class SourceLine(Protocol):
    """Something that scatters."""

    @property
    def name(self) -> str:
        """Its name."""

    @property
    def words(self) -> str:
        """Its distribution."""

    @property
    def reason(self) -> str:
        """Where that comes from."""

    @property
    def nominal(self) -> float | str | bool:
        """Its nominal value."""


class Index(Protocol):
    """How much of a figure's variance a source decides; None where it does not vary."""

    @property
    def first(self) -> float | None:
        """By itself."""

    @property
    def total(self) -> float | None:
        """With all its interactions."""

    @property
    def confidence(self) -> float | None:
        """Half the 95 % confidence interval, the larger one of both."""

    @property
    def first_confidence(self) -> float | None:
        """Of the first one."""

    @property
    def total_confidence(self) -> float | None:
        """Of the total one."""


class Probability(Protocol):
    """A probability with its 95 % confidence interval."""

    @property
    def value(self) -> float:
        """Share of the runs."""

    @property
    def low(self) -> float:
        """Lower bound."""

    @property
    def high(self) -> float:
        """Upper bound."""


class Band(Protocol):
    """A figure and what the scatter makes of it [SI]."""

    @property
    def nominal(self) -> float:
        """Its nominal value."""

    @property
    def quantiles(self) -> Mapping[float, float]:
        """At 0.05, 0.5, 0.95."""

    @property
    def confidence(self) -> Mapping[float, tuple[float, float]]:
        """Their 95 % confidence intervals."""

    @property
    def mean(self) -> float:
        """Of the runs that have it."""

    @property
    def standard_deviation(self) -> float:
        """Of these."""

    @property
    def indices(self) -> Mapping[str, Index]:
        """By source or joined names of correlated ones."""

    @property
    def left_out(self) -> int:
        """Base points that the indices leave out."""

    @property
    def absent(self) -> int:
        """Base runs that did not fail and yet lack it."""

    @property
    def unit(self) -> str:
        """Its unit."""

    @property
    def relative(self) -> bool:
        """Whether it is a difference of temperatures."""

    @property
    def help(self) -> str:
        """Its meaning."""

    @property
    def usual(self) -> tuple[float, float]:
        """Its usual range."""

    @property
    def outside(self) -> Probability | None:
        """Of a value outside the usual range."""

    @property
    def error(self) -> float | None:
        """Numerical error, relative; None: not known."""

    @property
    def linear_deviation(self) -> float | None:
        """Standard deviation by the gradient; None: not requested."""


class Series(Protocol):
    """A signal over time, all (n_t,)."""

    @property
    def time(self) -> Array:
        """[s]."""

    @property
    def nominal(self) -> Array:
        """The nominal run."""

    @property
    def quantiles(self) -> Mapping[float, Array]:
        """At 0.05, 0.5, 0.95."""

    @property
    def indices(self) -> Mapping[str, Array]:
        """Total indices by source."""

    @property
    def unit(self) -> str:
        """Its unit."""


class Study(Protocol):
    """What a study found."""

    @property
    def target(self) -> str:
        """Name of what was studied."""

    @property
    def kind(self) -> str:
        """Part, scene or function."""

    @property
    def runs(self) -> int:
        """Base points."""

    @property
    def solves(self) -> int:
        """Runs in all."""

    @property
    def failed(self) -> Mapping[str, int]:
        """Failed runs by their reason."""

    @property
    def reached(self) -> str:
        """How a washer's branch is reached."""

    @property
    def seed(self) -> int:
        """Of the sample."""

    @property
    def sources(self) -> tuple[SourceLine, ...]:
        """What scatters."""

    @property
    def figures(self) -> Mapping[str, Band]:
        """By name."""

    @property
    def probabilities(self) -> Mapping[str, Probability]:
        """By name."""

    @property
    def series(self) -> Mapping[str, Series]:
        """By name."""

    @property
    def nearest(self) -> Mapping[str, Mapping[float, Mapping[str, Any]]]:
        """Sources' values of the base run nearest to each quantile of a figure."""

    @property
    def sample(self) -> Mapping[str, Any]:
        """Base runs by columns."""

    @property
    def units(self) -> Mapping[str, str]:
        """Of the sample's columns."""

    @property
    def groups(self) -> tuple[str, ...]:
        """Sources as indices have them."""

    @property
    def correlations(self) -> tuple[tuple[str, str, float], ...]:
        """Pairs of correlated sources with their correlation."""

    @property
    def model(self) -> str:
        """Command that solves a part."""

    @property
    def setting(self) -> Mapping[str, str]:
        """Of a part what does not scatter, in words."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What must not be missed."""

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be known of errors."""

    @property
    def wall_time(self) -> float:
        """[s]."""
