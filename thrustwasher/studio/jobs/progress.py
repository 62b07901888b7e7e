"""What shows the progress of a call: a function of the caller's, or a line on the terminal."""

import sys
from typing import Any

from ...cli.common._progress import time_left
from ...errors import ParameterError
from .runner import Progress


def shown(progress: bool | Progress | None, label: str) -> Progress | None:
    """Return what is called with jobs done and in all; None: nothing is shown.

    True is a bar of tqdm if it is installed, else the line of the commands: on stderr, where that
    is a terminal, or in a notebook.
    """
    if progress is None or progress is False:
        return None
    if progress is not True:
        if not callable(progress):
            raise ParameterError(
                f"progress = {progress!r}, allowed: True, False, or a function of what is done and "
                "of all"
            )
        return progress
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return time_left(f"{label}:") if sys.stderr.isatty() else None
    bars: list[Any] = []

    def show(done: int, total: int) -> None:
        if not bars:  # what was done before does not count for the pace
            bars.append(tqdm(total=total, initial=done, desc=label, disable=None))
        (bar,) = bars
        bar.total = total
        bar.update(done - bar.n)
        if done >= total:
            bar.close()

    return show
