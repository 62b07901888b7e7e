"""Key figures of packs and shift mean what their names say, in both directions."""

import numpy as np
import pytest
from scene_runs import shift

from thrustwasher.shift import load_scene
from thrustwasher.shift.key_figures.comfort import comfort_figures
from thrustwasher.shift.key_figures.key_figures import carried_torque, shift_heat, slip_end

TIME = np.linspace(0.0, 1.3, 1301)
LOCK, END = 0.6, 0.8


def hole(points, *, lock=LOCK, end=None):
    """Return the torque hole of a shift whose acceleration is known at times: {time: m/s2}."""
    felt = np.interp(TIME, list(points), list(points.values()))
    signals = {
        "transmission.output_acceleration": felt / 0.1,
        "transmission.output_speed": np.full_like(TIME, 100.0),
        "transmission.engine_speed": np.full_like(TIME, 100.0),
    }
    return comfort_figures(load_scene("planetary"), TIME, signals, lock, end)["torque_hole"][0]


@pytest.mark.parametrize(
    ("before", "least", "after", "expected"),
    [
        (1.9, 0.8, 1.2, 0.4),  # up: below the new gear
        (1.2, 0.8, 1.9, 0.4),  # down: below the old one
        (1.2, 1.2, 1.9, 0.0),
        (1.9, 1.5, 1.2, 0.0),
    ],
)
def test_the_torque_hole_is_below_the_smaller_of_before_and_after(before, least, after, expected):
    felt = {0.1: before, 0.4: least, LOCK: least, LOCK + 0.1: after}
    assert hole(felt) == pytest.approx(expected, abs=1e-9)


def test_a_hole_is_settled_after_the_later_packs_slip():
    """0.1 s after lock-up the other pack still slips and acceleration is still low."""
    felt = {0.1: 1.5, 0.4: 0.8, LOCK + 0.1: 0.9, END + 0.1: 1.4}
    assert hole(felt) == pytest.approx(0.1)
    assert hole(felt, end=END) == pytest.approx(0.6)


def packs():
    """A clutch that slips to 0.6 s under load, a brake pressed to 0.8 s that slips from 0.3 s."""
    zero, s = np.zeros_like(TIME), {}
    s["transmission.clutch_load"], s["transmission.clutch_speed"] = zero + 1e3, 300.0 * (TIME < 0.6)
    s["transmission.brake_load"], s["transmission.brake_speed"] = 5e3 * (TIME < 0.8), TIME > 0.3
    s["transmission.clutch_heat"], s["transmission.brake_heat"] = 1e3 * TIME, 500.0 * TIME
    return s


def test_shift_heat_is_that_of_both_packs_to_the_end_of_the_later_slip():
    scene, s = load_scene("planetary"), packs()
    end = slip_end(scene, TIME, s)
    assert TIME[end] == pytest.approx(0.8, abs=2e-3)
    assert shift_heat(scene, TIME, s, end) == pytest.approx(1500.0 * 0.7, rel=3e-3)
    s["transmission.brake_load"] = np.full_like(TIME, 5e3)
    assert slip_end(scene, TIME, s) is None and shift_heat(scene, TIME, s, None) is None


def test_a_locked_pack_carries_its_reaction_and_a_slipping_one_its_friction():
    """Where it slips, the reaction may overshoot for a step; the pack does not."""
    locked = np.array([1.0, 1.0, 0.0, 0.0])
    found = carried_torque(
        "brake",
        {
            "transmission.brake_locked": locked,
            "brake.friction_torque": np.array([0.0, 0, -8, -2]),
            "transmission.brake_reaction": np.array([-122.0, -90.0, -30.0, -2.1]),
        },
    )
    assert found.tolist() == [122.0, 90.0, 8.0, 2.0]


def test_a_brake_that_holds_first_gear_carries_its_share_of_the_engines_torque():
    run = shift("planetary")
    held = np.abs(run.signals["transmission.brake_reaction"][:100]).max()
    assert run.figures["peak_brake_torque"] == pytest.approx(held, rel=1e-3) and held > 120.0
    both = run.figures["slip_energy"] + run.energy["brake"]
    assert run.figures["slip_energy"] < run.figures["shift_heat"] < both
    words = {f.name: f.text for f in run.key_figures}
    assert "the pack that engages" in words["slip_energy"] and "both packs" in words["shift_heat"]


def test_a_downshift_under_power_changes_speeds_first_and_its_clutch_makes_the_heat():
    run = shift("planetary-downshift")
    names = [p.name for p in run.phases]
    assert names == ["second gear", "fill", "inertia phase", "torque phase", "locked"]
    texts = {k.name: k.text for k in run.key_figures}
    assert texts["lock_time"] == "brake locks" and texts["release_time"] == "clutch lets go"
    f = run.figures
    gone = next(e.time for e in run.events if e.kind == "clutch_emptied")
    assert f["torque_phase"] == pytest.approx(gone - f["lock_time"], abs=1e-9)
    assert f["shift_heat"] > 0.9 * (run.energy["clutch"] + run.energy["brake"])
    assert f["shift_heat"] > 8.0 * f["slip_energy"]
    assert f["peak_clutch_torque"] > 84.0 and f["peak_brake_torque"] > 120.0
    assert "full_friction_speed" not in f  # friction rises with speed: nothing is full
