"""Python in a process of its own, with this checkout first in its path."""

import os
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
