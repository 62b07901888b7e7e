"""Compile for the report while the FMUs are compiled and run: both take long on a new machine."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ._output import note

SOLVE_ONCE = """
from thrustwasher import WasherParams, solve_washer
solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002)
"""


@contextmanager
def compiled_for_report(scene: Any, target: str) -> Iterator[None]:
    """Let the washer's solver be compiled meanwhile: the report solves it again for its maps.

    Python FMUs compile it for themselves.
    """
    helper = None
    if target == "native" and "washer" in scene.parts:
        from ..fmu.registry import is_compiled

        if not is_compiled(scene.parts["washer"].spec):
            surroundings = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
            helper = subprocess.Popen(
                [sys.executable, "-c", SOLVE_ONCE], env=surroundings,
                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            )  # fmt: skip
    try:
        yield
    except BaseException:
        if helper:
            helper.terminate()
        raise
    finally:
        if helper:
            if helper.poll() is None:
                note("the washer is still being compiled for the report's maps")
            helper.wait()
