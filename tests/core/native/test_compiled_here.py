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
washer = WasherParams()
for load, speed, level in ((300, 953, "field"), (1100, 545, "field"),
                           (300, 545, "map"), (300, 953, "fine")):
    r = solve_washer(washer, load=load, speed=speed, tilt=0.002, fidelity=level)
    print(r.friction_torque.hex(), r.temperature.hex(), r.film_ratio.hex())
for fold in load_curve(washer, speed=545.0, tilt=0.002, grid=(9, 20)).folds:
    print(fold.load.hex(), fold.friction_torque.hex())
for level in ("closed", "stribeck", "field", "fine"):
    c = solve_clutch(ClutchParams(), load=9000.0, speed=5.0, fidelity=level)
    g = solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0)
    print(c.friction_torque.hex(), c.temperature.hex(), g.flash_rise.hex())
"""


try:
    SAME_TOOLS = shipped.index().get("toolchain") == ship.toolchain()
except metadata.PackageNotFoundError:  # nothing that links for all platforms
    SAME_TOOLS = False


@pytest.mark.slow
@pytest.mark.skipif(not SAME_TOOLS, reason="other versions make other bytes")
def test_made_again_everything_shipped_has_the_same_bytes():
    shipped = [name for name in libraries() if name.startswith("thrustwasher.")]
    assert ship.check(shipped) == []


@pytest.mark.slow
@pytest.mark.skipif(SAME_TOOLS, reason="the same bytes give the same numbers")
def test_compiled_here_the_kernels_give_the_shipped_numbers(tmp_path):
    shown = []
    for where in ("shipped", "here"):
        done = child(SOLVES, where, limit=1200, XDG_CACHE_HOME=str(tmp_path / where))
        assert done.returncode == 0, done.stderr
        assert ("compiled washer in" in done.stderr) == (where == "here")
        shown.append([float.fromhex(word) for word in done.stdout.split()])
    assert len(shown[0]) == 4 * 3 + 2 * 2 + 4 * 3  # washer, folds, clutch and mesh
    assert shown[1] == pytest.approx(shown[0], rel=1e-11)
