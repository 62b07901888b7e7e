"""The default shift at one percent against the default levels everywhere; counts, no seconds."""

from functools import cache

import numpy as np
import pytest
from scene_runs import slow_without_jit

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.ladder.error_table import fresh_levels
from thrustwasher.shift import load_scene, run_auto, with_fidelities

pytestmark = slow_without_jit
STOP = 0.9  # s: past lock-up
TOLERANCE = 0.01


@cache
def run(*wishes):
    """Return the default shift with every part's own kernels."""
    scene = load_scene("planetary").with_options(stop_time=STOP)

    def make(name, part):
        return DirectInstance(part.spec, parameters=part.parameters())

    return run_auto(with_fidelities(scene, ["field", *wishes]), make)


def at_tolerance():
    if "map" not in fresh_levels("washer", load_scene("planetary").parts["washer"].params):
        pytest.skip("the table of the washer's map is older than its kernels")
    return run(f"washer=auto:{TOLERANCE}")


def judged(r):
    """Return what a shift is evaluated by; temperatures as rises above the oil."""
    oil = r.scene.oil_temperature
    torque = np.abs(r.signals["washer.friction_torque"])
    return {
        "slip energy": r.figures["slip_energy"],
        "lock-up": r.figures["lock_time"],
        "clutch's peak": r.figures["peak_clutch_temperature"] - oil,
        "washer's peak": r.figures["peak_washer_temperature"] - oil,
        "washer's maximum torque": torque.max(),
        "washers' heat": r.energy["washers"],
    }


@pytest.mark.slow
def test_a_shift_with_the_washers_map_is_the_shift_with_its_field():
    slow, quick = judged(run()), judged(run("washer=map"))
    for name, value in slow.items():
        assert quick[name] == pytest.approx(value, rel=0.3 * TOLERANCE), name
    torques = [r.signals["washer.friction_torque"] for r in (run(), run("washer=map"))]
    assert np.abs(torques[1] - torques[0]).max() <= 0.3 * TOLERANCE * np.abs(torques[0]).max()
    assert max(run("washer=map").signals["washer.solver_status"]) == 0.0


@pytest.mark.slow
def test_what_a_shift_is_judged_by_stays_within_the_tolerance():
    slow, quick = judged(run()), judged(at_tolerance())
    for name, value in slow.items():
        assert quick[name] == pytest.approx(value, rel=TOLERANCE), name


@pytest.mark.slow
def test_the_washer_leaves_the_field_to_a_check_of_some_thirty_points():
    """What took 85 % of the time is asked at less than a twentieth of the points."""
    r = at_tolerance()
    assert [(c.part, c.fidelity) for c in r.cost if c.part == "washer"] == [("washer", "map")]
    (check,) = r.guard.checks
    assert (check.part, check.fidelity, check.above) == ("washer", "map", "field")
    assert 25 <= check.points <= 0.05 * (len(r.time) - 1)
    assert 0.0 < check.worst.share <= check.tolerance and check.failed == () and check.holds
