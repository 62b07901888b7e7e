"""Standard output and error of a command: what fails there says so, or says nothing."""

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

from ..errors import naming

OUTPUT = "standard output"


class Stream:
    """A stream whose errors have its name; ``silent``: one that loses what it cannot write.

    ``stream`` is None if who started the program has closed it.
    """

    def __init__(self, stream: Any, *, silent: bool = False) -> None:
        self._stream, self._silent = stream, silent

    def __getattr__(self, name: str) -> Any:
        if self._stream is None:
            raise AttributeError(name)
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Write a text; OSError with the stream's name where it fails."""
        return self._do("write", text) or len(text)

    def flush(self) -> None:
        """Write what waits."""
        if self._stream is not None:
            self._do("flush")

    def isatty(self) -> bool:
        """Tell if a person looks at it."""
        return self._stream is not None and bool(self._stream.isatty())

    def _do(self, name: str, *given: str) -> Any:
        try:
            with naming(OUTPUT):
                if self._stream is None:
                    raise OSError(errno.EBADF, "is closed")
                return getattr(self._stream, name)(*given)
        except OSError:
            self._forget()
            if not self._silent:
                raise

    def _forget(self) -> None:
        """Let the interpreter's last flush be quiet; a test's stream may have no file number."""
        with suppress(OSError, ValueError, AttributeError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), self._stream.fileno())


@contextmanager
def named_streams(*, is_program: bool) -> Iterator[None]:
    """Let failures of standard output have its name, and those of standard error no effect.

    ``is_program``: numbers of closed streams are taken, so that no file gets one of them and what
    a library prints.
    """
    for number in range(3) if is_program else ():
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # it gets the lowest number that is free
    before = sys.stdout, sys.stderr
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(errors="replace")  # a terminal that knows no µ still gets numbers
    sys.stdout, sys.stderr = Stream(sys.stdout), Stream(sys.stderr, silent=True)
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before
