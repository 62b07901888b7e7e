"""Where numbers jump: a scan of one quantity, halved where a number does not shrink with it.

Between two places a continuous number deviates from the mean of its ends less and less as they
come closer; one that jumps deviates by half its jump however close they are. An interval whose
middle deviates is halved, and so on, down to where only a jump is left.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
CLOSE = 1e-7  # of the scan's length, and of the place: down to that both halves are looked at
HALVINGS = 40  # from there on, towards the larger step
HELD = 0.5  # a step that has not shrunk more by then is a jump


@dataclass(frozen=True, slots=True)
class Jump:
    """Between two neighbouring places numbers change by a step."""

    low: float
    high: float
    which: tuple[int, ...]  # the numbers that jump
    size: float  # the largest step over the number's own size


@dataclass(frozen=True, slots=True)
class Scan:
    """A scan of one quantity: its jumps and how often it was requested."""

    jumps: tuple[Jump, ...]
    values: int  # places that have numbers
    refused: int  # places that have none


def find_jumps(
    numbers: Callable[[float], Numbers | None],
    places: Sequence[float],
    least: float,
    floors: Numbers,
) -> Scan:
    """Return where numbers jump along a line.

    Parameters
    ----------
    numbers : what to judge, an array of n numbers at a place; None where there are none
    places : where to begin, rising; a place with numbers of its own alone must be among them
    least : a step below this part of a number's size is none
    floors : (n,) minimum sizes of the numbers, for those near zero
    """
    known: dict[float, Numbers | None] = {}

    def at(x: float) -> Numbers | None:
        if x not in known:
            known[x] = numbers(x)
        return known[x]

    close = CLOSE * (places[-1] - places[0])
    found: list[Jump] = []
    for low, high in pairwise(places):
        found += _between(at, low, high, least, floors, close)
    values = sum(x is not None for x in known.values())
    return Scan(tuple(found), values, len(known) - values)


def _between(
    at: Callable[[float], Numbers | None],
    low: float,
    high: float,
    least: float,
    floors: Numbers,
    close: float,
) -> Iterator[Jump]:
    """Yield the jumps between two places."""
    waiting = [(low, high)]
    while waiting:
        low, high = waiting.pop()
        first, last, half = at(low), at(high), at(0.5 * (low + high))
        if first is None or last is None or half is None:
            continue
        middle = 0.5 * (low + high)
        off = np.abs(half - 0.5 * (first + last)) / _size(first, last, floors)
        if not (off > 0.4 * least).any():
            continue
        if high - low > max(close, CLOSE * abs(middle)):
            waiting += [(middle, high), (low, middle)]
            continue
        jump = _held(at, low, high, least, floors)
        if jump is not None:
            yield jump


def _size(first: Numbers, last: Numbers, floors: Numbers) -> Numbers:
    found: Numbers = np.maximum(np.maximum(np.abs(first), np.abs(last)), floors)
    return found


def _held(
    at: Callable[[float], Numbers | None], low: float, high: float, least: float, floors: Numbers
) -> Jump | None:
    """Return the jump between two close places, or None where the step shrinks with the distance.

    Of the two halves that one is halved on in which the number with the largest step moves more.
    """
    first, last = at(low), at(high)
    if first is None or last is None:
        return None
    size = _size(first, last, floors)
    began = np.abs(last - first) / size
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        half = at(middle)
        if not low < middle < high or half is None:
            break
        before, after = np.abs(half - first) / size, np.abs(last - half) / size
        if before.max() >= after.max():
            high, last = middle, half
        else:
            low, first = middle, half
    step = np.abs(last - first) / size
    which = np.flatnonzero((step > least) & (step > HELD * began))
    if not which.size:
        return None
    return Jump(low, high, tuple(int(i) for i in which), float(step[which].max()))
