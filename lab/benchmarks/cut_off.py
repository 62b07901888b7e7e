"""A plugin of pytest: each file of tests has so much processor time, what is left is skipped."""

import signal
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest

_used: defaultdict[Path, float] = defaultdict(float)
_cut: set[str] = set()  # tests that were stopped


def _stop(*_: object) -> None:
    pytest.skip("cut off")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Take the limit."""
    parser.addoption("--cut-off", type=float, default=40.0, help="processor time of a file [s]")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    """Run a test until the time of its file is up."""
    left, began = item.config.getoption("--cut-off") - _used[item.path], time.process_time()
    if left <= 0.0:
        _stop()

    def cut(*_: object) -> None:
        _cut.add(item.nodeid)
        _stop()

    signal.signal(signal.SIGPROF, cut)
    signal.setitimer(signal.ITIMER_PROF, left)
    try:
        return (yield)
    except Exception:  # hypothesis takes the skip for a strategy that is not the same twice
        if item.nodeid in _cut:
            _stop()
        raise
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        _used[item.path] += time.process_time() - began
