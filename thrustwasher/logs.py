"""What is logged, under ``thrustwasher`` and its modules: warnings of results, builds, compiling.

Nothing here sets a level or a handler that writes. Records of worker processes come back with what
these have done.
"""

import logging
from collections.abc import Callable
from functools import wraps
from typing import Any

NAME = __name__.partition(".")[0]
SILENT = logging.CRITICAL + 1


def is_heard(log: logging.Logger, level: int) -> bool:
    """Tell if a record of this level would reach a handler that does something."""
    if not log.isEnabledFor(level):
        return False
    at: logging.Logger | None = log
    while at is not None:
        if not all(isinstance(handler, logging.NullHandler) for handler in at.handlers):
            return True
        at = at.parent if at.propagate else None
    return False


def warn(result: Any, log: logging.Logger, stacklevel: int = 2) -> None:
    """Log the warnings of a result, if it has any and somebody listens."""
    if not is_heard(log, logging.WARNING):
        return  # texts are made when they are read
    texts = getattr(result, "warnings", ())
    if isinstance(texts, tuple):
        for text in texts:
            log.warning("%s", text, stacklevel=stacklevel + 1)


def warning(function: Callable[..., Any], package: str) -> Callable[..., Any]:
    """Return a function of the package, as users call it: what its result warns of is logged.

    The package's own calls take the function itself, or a warning would come twice.
    """
    log = logging.getLogger(function.__module__)

    @wraps(function)
    def call(*args: Any, **given: Any) -> Any:
        result = function(*args, **given)
        warn(result, log, 2)
        return result

    call.__module__ = package  # where it is found, also by pickle
    return call


_kept: list[logging.LogRecord] = []


class _Keeping(logging.Handler):
    """Keeps records, ready to be pickled, until they are taken along."""

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a record as text: what it was made from may not be picklable."""
        record.msg, record.args = record.getMessage(), None
        if record.exc_info:
            record.exc_text = logging.Formatter().formatException(record.exc_info)
            record.exc_info = None
        _kept.append(record)


def wanted_level() -> int:
    """Return the lowest level at which somebody listens, for workers."""
    loggers = [logging.getLogger(NAME)] + [
        log
        for name, log in list(logging.root.manager.loggerDict.items())
        if name.startswith(f"{NAME}.") and isinstance(log, logging.Logger)
    ]
    heard = [log.getEffectiveLevel() for log in loggers if is_heard(log, logging.CRITICAL)]
    return min(heard, default=SILENT)


def keep_from(level: int) -> None:
    """Let a worker process keep its records for its parent instead of writing them."""
    top = logging.getLogger(NAME)
    top.addHandler(_Keeping())
    top.setLevel(level)
    top.propagate = False


class Carrying:
    """A job of a worker process: its answer comes with the records kept so far."""

    def __init__(self, job: Callable[..., Any]) -> None:
        self.job = job

    def __call__(self, *given: Any) -> tuple[Any, list[logging.LogRecord]]:
        """Return the answer and the records."""
        answer = self.job(*given)
        records = _kept.copy()
        _kept.clear()
        return answer, records


def unloaded(carried: tuple[Any, list[logging.LogRecord]]) -> Any:
    """Return a worker's answer, once its records are logged here."""
    answer, records = carried
    for record in records:
        log = logging.getLogger(record.name)
        if log.isEnabledFor(record.levelno):
            log.handle(record)
    return answer
