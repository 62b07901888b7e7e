"""How far a long command is, how long it still takes, and how it goes on when it was stopped."""

import argparse
import math
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

EVERY, IN_PIPE = 0.1, 60.0  # s between two lines: on a terminal, elsewhere
FIRST = 3.0  # s before the time left is named
SETTLES = 10.0  # s in which the time left follows a change of pace
KEPT = 512  # moments by which the pace is found


class TimeLeft:
    """Time left, from the pace of the last half of the time so far; it changes smoothly.

    What was done before the first moment does not count for the pace.
    """

    def __init__(self) -> None:
        self._moments: deque[tuple[float, int]] = deque(maxlen=KEPT)
        self._began = math.inf
        self._left = math.nan
        self._at = 0.0

    def after(self, now: float, done: int, total: int) -> float:
        """Return the seconds left, NaN while they are not known."""
        if not self._moments:
            self._began = now
        if not self._moments or done > self._moments[-1][1]:
            self._moments.append((now, done))
        half = self._began + 0.5 * (now - self._began)
        while len(self._moments) > 2 and self._moments[1][0] <= half:
            self._moments.popleft()
        then, before = self._moments[0]
        if now - self._began < FIRST or done <= before:
            return math.nan
        fresh = (now - then) * (total - done) / (done - before)
        if math.isnan(self._left):
            self._left = fresh
        else:
            passed = now - self._at
            expected = max(self._left - passed, 0.0)
            self._left = expected + (1.0 - math.exp(-passed / SETTLES)) * (fresh - expected)
        self._at = now
        return self._left


def time_left(label: str) -> Callable[[int, int | None], None]:
    """Return ``show(done, total)`` that also says how long it takes; in a pipe a line a minute.

    With a total of None, as of a search, it says what is done.
    """
    stream, on_terminal = sys.stderr, sys.stderr.isatty()
    every = EVERY if on_terminal else IN_PIPE
    last = time.monotonic()
    left = TimeLeft()

    def show(done: int, total: int | None) -> None:
        nonlocal last
        now = time.monotonic()
        seconds = math.nan if total is None else left.after(now, done, total)
        if total is not None and done >= total:
            stream.write("\r\033[K" if on_terminal else "")
        elif now - last >= every:
            last = now
            known = "" if math.isnan(seconds) else f", {duration(seconds)} left"
            of_all = "" if total is None else f" of {total} ({done / total:.0%})"
            text = f"{label} {done}{of_all}{known}"
            stream.write(f"\r\033[K{text}" if on_terminal else text + "\n")
        stream.flush()

    return show


def duration(seconds: float) -> str:
    """Return a duration for a glance: 0.4 s, 40 s, 3 min, 2 h 10 min."""
    if seconds < 90.0:
        return f"{seconds:.1g} s" if seconds < 1.0 else f"{seconds:.0f} s"
    minutes = round(seconds / 60.0)
    return f"{minutes} min" if minutes < 90 else f"{minutes // 60} h {minutes % 60} min"


@contextmanager
def going_on(
    arguments: argparse.Namespace,
    journal: Path | None,
    show: Callable[[int, int], None],
    kept: str = "{done} of {total} points",
) -> Iterator[Callable[[int, int], None]]:
    """Give ``show``; if what runs stops, say what its journal keeps and which command goes on."""
    done = total = 0

    def progress(*now: int) -> None:
        nonlocal done, total
        done, total = now
        show(done, total)

    try:
        yield progress
    except BaseException:
        if journal and done and journal.exists():
            command = getattr(arguments, "command_line", "the same command")
            words = kept.format(done=done, total=total)
            print(f"{journal} keeps {words}; to go on: {command}", file=sys.stderr)
        raise
