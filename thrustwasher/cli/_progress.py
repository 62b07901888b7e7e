"""A progress bar for a person at a terminal; nothing in a pipe."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

WIDTH = 32


def progress_bar(label: str) -> Callable[[float], None]:
    """Return ``show(fraction)``, which redraws at most ten times a second; 1 clears the line."""
    stream = sys.stderr
    if not stream.isatty():
        return lambda fraction: None
    last = 0.0

    def show(fraction: float) -> None:
        nonlocal last
        now = time.monotonic()
        if fraction < 1.0 and now - last < 0.1:
            return
        last = now
        done = round(WIDTH * min(max(fraction, 0.0), 1.0))
        bar = "█" * done + "·" * (WIDTH - done)
        text = "\r\033[K" if fraction >= 1.0 else f"\r{label} {bar} {fraction:4.0%}"
        stream.write(text)
        stream.flush()

    return show
