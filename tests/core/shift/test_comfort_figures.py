"""Jerk, torque hole, flare and phases, read from signals that are known."""

from itertools import pairwise

import numpy as np
import pytest

from thrustwasher.shift import load_scene
from thrustwasher.shift.key_figures.comfort import comfort_figures
from thrustwasher.shift.key_figures.events_and_phases import find_events, find_phases

SCENE = load_scene("planetary")
TIME = np.linspace(0.0, 1.3, 1301)
RATIO = 1.0 + 38.0 / 74.0


def signals(felt, engine=None):
    """Return what the figures read; ``felt``: acceleration of the vehicle [m/s2]."""
    speed = np.full_like(TIME, 200.0)
    return {
        "transmission.output_acceleration": np.asarray(felt) / 0.1,
        "transmission.output_speed": speed,
        "transmission.engine_speed": RATIO * speed if engine is None else engine,
    }


def found(felt, engine=None, lock=0.8):
    figures = comfort_figures(SCENE, TIME, signals(felt, engine), lock)
    return {name: value for name, (value, _) in figures.items()}


def test_a_ramp_of_acceleration_is_its_jerk_and_a_jump_counts_over_10_ms():
    ramp = np.interp(TIME, [0.3, 0.5], [2.0, 1.0])
    assert found(ramp)["peak_jerk"] == pytest.approx(5.0, rel=1e-9)
    jump = np.where(TIME < 0.8, 1.2, 1.0)
    assert found(jump)["peak_jerk"] == pytest.approx(20.0, rel=1e-9)


def test_jerk_before_the_shift_does_not_count():
    assert found(np.where(TIME < 0.05, 3.0, 1.0))["peak_jerk"] == 0.0


def test_flare_is_what_the_engine_runs_above_first_gear():
    engine = 200.0 * RATIO + 12.0 * np.exp(-(((TIME - 0.4) / 0.02) ** 2))
    assert found(np.ones_like(TIME), engine)["flare"] == pytest.approx(12.0, rel=1e-9)
    assert found(np.ones_like(TIME))["flare"] == 0.0


def phases_of(unloaded):
    """Return phases and kinds of events if the brake carries nothing from a time [s] on."""
    locked = (TIME > 0.8).astype(float)
    full = (TIME > 0.1075).astype(float)
    zero = np.zeros_like(TIME)
    s = {
        "transmission.clutch_locked": locked,
        "transmission.lock_time": 0.8 * locked,
        "transmission.brake_locked": (TIME < 0.41).astype(float),
        "transmission.release_time": np.where(TIME < 0.41, -1.0, 0.4095),
        "transmission.clutch_filled": full,
        "transmission.clutch_filled_time": 0.1075 * full,
        "transmission.brake_filled": zero + 1.0,
        "transmission.brake_filled_time": zero,
        "transmission.clutch_kiss_time": 0.1075 * full,
        "transmission.brake_kiss_time": zero,
        "transmission.brake_reaction": -100.0 * (unloaded - TIME),
        "transmission.washer_speed": zero,
    }
    others = {n: p for n, p in SCENE.parts.items() if n != "transmission"}
    rest = {f"{part}.{o.name}": zero for part, p in others.items() for o in p.spec.outputs}
    events = find_events(SCENE, TIME, s | rest)
    return find_phases(SCENE, s, events), [e.kind for e in events]


def test_a_pack_that_lets_go_before_the_kiss_point_leaves_no_torque_phase():
    phases, _ = phases_of(0.15)
    assert [name for name, *_ in phases] == ["first gear", "fill", "inertia phase", "locked"]
    assert all(a[2] == b[1] for a, b in pairwise(phases))


def test_phases_of_profiles_end_at_kiss_point_unloaded_brake_and_lock_up():
    phases, kinds = phases_of(0.3925)
    names = [name for name, *_ in phases]
    assert names == ["first gear", "fill", "torque phase", "inertia phase", "locked"]
    ends = [end for *_, end in phases]
    assert ends == pytest.approx([0.1, 0.2, 0.3925, 0.8, 1.3], abs=1e-9)
    order = [kinds.index(k) for k in ("clutch_filled", "brake_unloaded", "clutch_locked")]
    assert order == sorted(order)
