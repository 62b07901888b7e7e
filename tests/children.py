"""Python in a process of its own, with this checkout first in its path."""

import os
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def child(code, *words, check=False, path=(), limit=500, **environment):
    """Run code in a fresh process; return what it printed and how it ended."""
    before = os.environ.get("PYTHONPATH", "")
    folders = os.pathsep.join([*map(str, path), str(ROOT), *([before] if before else [])])
    done = subprocess.run(
        [sys.executable, "-c", code, *map(str, words)],
        env={**os.environ, "PYTHONPATH": folders, **environment},
        capture_output=True,
        text=True,
        timeout=limit,
    )
    assert not check or done.returncode == 0, done.stderr
    return done


def started(words, folder):
    """Start a command as a program of its own, which hears Ctrl-C whatever runs the tests.

    Its lines are not measured: coverage holds a lock that an exception out of a signal never frees.
    """
    unmeasured = {k: v for k, v in os.environ.items() if not k.startswith("COVERAGE_PROCESS")}
    return subprocess.Popen(
        [sys.executable, "-m", "thrustwasher", *map(str, words)],
        cwd=folder,
        text=True,
        env=unmeasured,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
