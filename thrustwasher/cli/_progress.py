"""How far it is and how long it will take, for a person at a terminal."""

import sys
import time
from collections.abc import Callable


def time_left(label: str) -> Callable[[int, int], None]:
    """Return ``show(done, total)`` that also says how long it will take; in a pipe a line a minute.

    What was done before the first call does not count for the pace.
    """
    stream, on_terminal = sys.stderr, sys.stderr.isatty()
    every = 0.1 if on_terminal else 60.0
    began = last = time.monotonic()
    before = -1

    def show(done: int, total: int) -> None:
        nonlocal last, before
        before = done if before < 0 else before
        now = time.monotonic()
        if done >= total:
            stream.write("\r\033[K" if on_terminal else "")
        elif now - last >= every and done > before:
            last = now
            left = (now - began) * (total - done) / (done - before)
            text = f"{label} {done} of {total} ({done / total:.0%}), {_duration(left)} left"
            stream.write(f"\r\033[K{text}" if on_terminal else text + "\n")
        stream.flush()

    return show


def _duration(seconds: float) -> str:
    """Return a duration for a glance: 40 s, 3 min, 2 h 10 min."""
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60.0)
    return f"{minutes} min" if minutes < 90 else f"{minutes // 60} h {minutes % 60} min"
