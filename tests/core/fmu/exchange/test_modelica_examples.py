"""Examples of the Modelica Standard Library 4.0.0: its reference results, by packs as friction.

Numbers: github.com/modelica/MAP-LIB_ReferenceResults (Dymola, Dassl, 1e-6).
"""

from functools import cache

import numpy as np
import pytest
from modelica_examples import coupled_clutches
from modelica_examples import lossy_gear as solved

pytestmark = pytest.mark.slow
lossy_gear = cache(solved)


def test_coupled_clutches_stick_and_turn_as_in_modelica_to_four_digits():
    """Until the first sticks; then friction at rest, 10 % higher there, matters."""
    run = coupled_clutches(1e-7)
    times, speeds = run["time"], run["speeds"]
    assert np.interp(0.4, times, speeds[:, 0]) == pytest.approx(6.16630, rel=1e-4)
    for k, stuck in ((1, 0.709621), (0, 0.791658)):
        slip = np.abs(speeds[:, k] - speeds[:, k + 1])
        before, after = times < stuck - 2e-3, times > stuck + 2e-3
        near = before & (times > stuck - 0.02)
        line = np.polyfit(times[near], slip[near], 2)
        ends = np.roots(line)
        assert np.min(np.abs(ends - stuck)) < 1e-4
        assert slip[after & (times < stuck + 0.02)].max() < 5e-3


@pytest.mark.parametrize(
    ("number", "at", "speed"), [(1, 0.05, -0.0195042), (1, 0.3, 0.0131812), (2, 0.04, -0.0122578)]
)
def test_a_lossy_gear_moves_and_sticks_as_in_modelica(number, at, speed):
    """Extrapolated to a bristle without bending: the difference falls with its angle's root."""
    rough, fine = (lossy_gear(number, 1e-6, angle) for angle in (4e-6, 1e-6))
    found = [float(np.interp(at, r["time"], r["Inertia2.w"])) for r in (rough, fine)]
    assert found[1] == pytest.approx(speed, rel=1e-2)
    assert 2.0 * found[1] - found[0] == pytest.approx(speed, rel=5e-3)
    stuck = (fine["time"] > 0.1) & (fine["time"] < 0.19)
    assert np.ptp(fine["Inertia2.phi"][stuck]) < 1e-6
