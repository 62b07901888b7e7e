"""A progress bar for a person at a terminal; nothing in a pipe."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

WIDTH = 32


def progress_bar(label: str) -> Callable[[int, int], None] | None:
    """Return ``show(done, total)``, which clears the line at the end; None in a pipe."""
    stream = sys.stderr
    if not stream.isatty():
        return None
    last = 0.0

    def show(done: int, total: int) -> None:
        nonlocal last
        now = time.monotonic()
        if done < total and now - last < 0.1:
            return
        last = now
        filled = WIDTH * done // total
        bar = "█" * filled + "·" * (WIDTH - filled)
        stream.write("\r\033[K" if done >= total else f"\r{label} {bar} {done / total:4.0%}")
        stream.flush()

    return show
