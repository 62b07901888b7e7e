"""Ctrl-C and SIGTERM: a command stops where it is, tidies up and says so in one line.

Only the first signal counts while things are tidied up; one that comes a second later stops
whatever still runs. A stop that arrives as another failure, because some library in between takes
every exception for its own, is still a stop.
"""

from __future__ import annotations

import signal
import threading
import time
from types import FrameType

GRACE = 1.0  # s


class Stopped(KeyboardInterrupt):
    """The user or the system wants the command to end."""


class Watch:
    """Which signal wanted this process to end, if any."""

    def __init__(self) -> None:
        self.number = 0
        self._last = float("-inf")

    def begin(self) -> None:
        """Take the signals over; what a parent has switched off stays off."""
        if threading.current_thread() is not threading.main_thread():
            return
        for number in (signal.SIGINT, signal.SIGTERM):
            if signal.getsignal(number) in (signal.default_int_handler, signal.SIG_DFL):
                signal.signal(number, self._stop)

    def _stop(self, number: int, _frame: FrameType | None) -> None:
        now = time.monotonic()
        if now - self._last < GRACE:
            return
        self.number, self._last = number, now
        raise Stopped

    def close(self) -> None:
        """Let nothing disturb the last line and the interpreter's end."""
        for number in (signal.SIGINT, signal.SIGTERM):
            if signal.getsignal(number) == self._stop:
                signal.signal(number, signal.SIG_IGN)

    @property
    def status(self) -> int:
        """The exit status that shells know."""
        return 128 + (self.number or signal.SIGINT)

    @property
    def word(self) -> str:
        """What is said."""
        return "terminated" if self.number == signal.SIGTERM else "stopped"
