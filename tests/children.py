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


STOPPING = """
import os, pkgutil, sys, threading, time
from thrustwasher.cli import main
of, when, numbers, *sys.argv[1:] = sys.argv[1:]
where, name = of.rsplit(".", 1)
owner, calls, left = pkgutil.resolve_name(where), [], [int(n) for n in numbers.split(",")]
plain = getattr(owner, name)
def stopping(*given):
    calls.append(given)
    if left and eval(when, {"calls": calls, "given": given}):
        first, *others = left
        left.clear()
        for number in others:  # while things are tidied up
            threading.Timer(0.02, os.killpg, [0, number]).start()
        os.killpg(0, first)
        time.sleep(0.1)  # the signal is heard here
    return plain(*given)
setattr(owner, name, stopping)
sys.exit(main())
"""


def started(words, folder, stop=None):
    """Start a command as a program of its own, which hears Ctrl-C whatever runs the tests.

    ``stop``: a function by its dotted name, a condition on its ``calls`` and what is ``given``, and
    signals: all its processes get them there, on a machine of any speed. Its lines are not
    measured: coverage holds a lock that an exception out of a signal never frees.
    """
    unmeasured = {k: v for k, v in os.environ.items() if not k.startswith("COVERAGE_PROCESS")}
    program = ["-m", "thrustwasher"]
    if stop:
        of, when, *numbers = stop
        program = ["-c", STOPPING, of, when, ",".join(str(int(n)) for n in numbers)]
    return subprocess.Popen(
        [sys.executable, *program, *map(str, words)],
        cwd=folder,
        text=True,
        env=unmeasured,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )


def stopped(words, folder, *stop):
    """Run a command that is stopped there, as ``started`` says; return its status and lines."""
    running = started(words, folder, stop)
    try:
        said = running.communicate(timeout=120)[1]
    finally:
        running.kill()
    return running.returncode, said.splitlines()
