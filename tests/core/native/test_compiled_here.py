"""Compiled here, by whatever numba is installed, the kernels are the shipped ones."""

from importlib import metadata

import pytest
from children import child

from lab import ship
from thrustwasher.native import shipped
from thrustwasher.native.entries import libraries

SOLVES = """
import sys
from thrustwasher.native import shipped
if "here" in sys.argv:
    shipped.index = lambda: {"kernels": {}}
from thrustwasher import *
for power, speed in ((7500.0, 180.0), (2000.0, 60.0)):
    for level in ("field", "fine"):
        g = solve_gearmesh(GearMeshParams(), power=power, speed=speed, fidelity=level)
        print(g.friction_torque.hex(), g.film_ratio.hex(), g.flash_rise.hex())
"""
LOCAL = ("linux64", "wasm32")  # where all kernels are made again, those of one model for all
SMALL = "thrustwasher.sump.kernels.step"


try:
    SAME_TOOLS = shipped.index().get("toolchain") == ship.toolchain()
except metadata.PackageNotFoundError:  # nothing that links for all platforms
    SAME_TOOLS = False


@pytest.mark.slow
@pytest.mark.skipif(not SAME_TOOLS, reason="other versions make other bytes")
def test_made_again_everything_shipped_has_the_same_bytes():
    """Of the larger models for two platforms: `python -m lab.ship --check` makes all of all.

    The rest of the way is one for all models: the same module is lowered for each platform.
    """
    shipped = [name for name in libraries() if name.startswith("thrustwasher.")]
    assert ship.check([SMALL]) == []
    assert ship.check([name for name in shipped if name != SMALL], LOCAL) == []


@pytest.mark.slow
@pytest.mark.skipif(SAME_TOOLS, reason="the same bytes give the same numbers")
def test_compiled_here_the_kernels_give_the_shipped_numbers(tmp_path):
    shown = []
    for where in ("shipped", "here"):
        done = child(SOLVES, where, limit=1200, XDG_CACHE_HOME=str(tmp_path / where))
        assert done.returncode == 0, done.stderr
        assert ("compiled gearmesh in" in done.stderr) == (where == "here")
        shown.append([float.fromhex(word) for word in done.stdout.split()])
    assert len(shown[0]) == 2 * 2 * 3
    assert shown[1] == pytest.approx(shown[0], rel=1e-11)
