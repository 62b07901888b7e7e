"""What shows the progress of a call: a function of the caller's, or a line on the terminal."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from ...cli.common._progress import time_left
from ...errors import ParameterError

Show = Callable[[int, int | None], None]
Count = Callable[[], None]


def shown(progress: bool | Callable[..., None] | None, label: str) -> Show | None:
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

    def show(done: int, total: int | None) -> None:
        if not bars:  # what was done before does not count for the pace
            bars.append(tqdm(total=total, initial=done, desc=label, disable=None))
        (bar,) = bars
        bar.total = total
        bar.update(done - bar.n)
        if total is not None and done >= total:
            bar.close()

    return show


@contextmanager
def counted_runs(progress: bool | Callable[..., None] | None, label: str) -> Iterator[Count]:
    """Give what is called after each run of a search, whose number nobody knows before.

    ``progress`` gets runs done and None, at the end their number as that of all. Later runs, of
    what comes out, do not count.
    """
    show, done, is_open = shown(progress, label), 0, True

    def count() -> None:
        nonlocal done
        if show and is_open:
            done += 1
            show(done, None)

    try:
        yield count
    finally:
        is_open = False
        if show and done:
            show(done, done)
