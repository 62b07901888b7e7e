"""Packs that do not hold as a shift takes for granted: lock-up is the last one, and it is said."""

import numpy as np
import pytest
from scene_runs import changed, instances, slow_without_jit

from thrustwasher.errors import SolveError
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.checks.holding import _in_turn, _of_washers
from thrustwasher.shift.key_figures.events_and_phases import Event, lock_up

BARE = "losses = false\n[transmission]\nwashers = 0\n"


def run(tmp_path, text):
    own = changed(tmp_path, BARE + text)
    return cosimulate(own, instances(own))


def events(*pairs):
    return [Event(t, f"clutch_{kind}", kind) for t, kind in pairs]


@pytest.mark.parametrize(
    ("times", "lock"),
    [
        ((0.8,), 0.8),
        ((0.7, 0.71, 0.75), 0.75),
        ((0.7, 0.71), None),
        ((0.7, 0.8, 0.9, 1.1, 1.2), None),
        ((0.05, 0.06, 0.8), 0.8),
    ],
)
def test_lock_up_is_the_last_lock_after_which_the_pack_holds(times, lock):
    """It locks and lets go in turn at these times."""
    found = events(*((t, ("locked", "released")[i % 2]) for i, t in enumerate(times)))
    assert lock_up(load_scene("planetary"), found) == lock


@slow_without_jit
def test_figures_and_phases_follow_the_lock_up_that_holds(tmp_path):
    result = run(tmp_path, '[engine]\nspeed = "-1000 rpm"\n')
    locks = [e.time for e in result.events if e.kind == "clutch_locked"]
    f = result.figures
    assert len(locks) > 1 and f["lock_time"] == locks[-1]
    assert not any(e.kind == "clutch_released" and e.time > locks[-1] for e in result.events)
    inertia = next(p for p in result.phases if p.name == "inertia phase")
    assert inertia.end == locks[-1] and f["inertia_phase"] == inertia.end - inertia.start
    assert [p.name for p in result.phases][-1] == "locked"
    assert f["flare"] == 0.0  # an engine that turns backwards and only slows down


@pytest.mark.parametrize(("every", "words"), [(0.002, "numerical"), (0.02, "asks for more")])
def test_sticking_and_slipping_in_turn_is_told_with_its_times(every, words):
    time = np.linspace(0.0, 1.3, 1301)
    turns = [(0.7 + i * every, "locked") for i in range(10)]
    turns += [(t + 0.5 * every, "released") for t, _ in turns[:-1]]
    [line] = _in_turn(load_scene("planetary"), time, events(*sorted(turns)))
    assert f"from 0.7 to {0.7 + 9 * every:.4g} s (10 lock-ups)" in line and words in line
    assert not list(_in_turn(load_scene("planetary"), time, events(turns[0])))


@slow_without_jit
def test_a_pack_let_go_at_the_end_held_until_then(tmp_path):
    points = '[[0.1, 0.0], [0.2, "720 kPa"], [1.1, "720 kPa"], [1.2, 0.0]]'
    result = run(tmp_path, f"[pressure.clutch]\npoints = {points}\n")
    [line] = [w for w in result.warnings if w.startswith("At the end no pack holds")]
    assert f"{result.figures['lock_time']:.4g} s" in line
    assert result.phases[-1].name == "open"


@slow_without_jit
def test_a_late_clutch_leaves_the_engine_free_and_says_so(tmp_path):
    text = '[pressure.clutch]\nfill_volume = 1e-4\nfill_flow = "10 l/min"\n'
    result = run(tmp_path, text)
    [line] = [w for w in result.warnings if "neither pack is pressed" in w]
    assert "flares by 287.9" in line


@slow_without_jit
def test_a_run_that_fails_while_nothing_holds_says_so(tmp_path):
    points = '[[2.0, 0.0], [2.1, "720 kPa"]]'
    own = changed(tmp_path, f"{BARE}[pressure.clutch]\npoints = {points}\n")
    alive = instances(own)
    alive["mesh"] = FailsLate(alive["mesh"])
    with pytest.raises(SolveError, match=r"since 0\.\d+ s no pack held .*the run ends at 1.3 s"):
        cosimulate(own, alive)


class FailsLate:
    """Stands for a part whose input leaves its range at 0.6 s."""

    def __init__(self, part):
        self._part = part

    def __getattr__(self, name):
        return getattr(self._part, name)

    def step(self, t, h):
        if t > 0.6:
            raise SolveError(f"mesh at t = {t:.4g} s: speed is outside")
        self._part.step(t, h)


@slow_without_jit
def test_a_pressed_pack_that_slips_before_the_shift_is_told(tmp_path):
    late = run(tmp_path, "[brake]\nstarts_pressed = false\n")
    [line] = [w for w in late.warnings if w.startswith("Before the shift begins")]
    assert "brake" in line
    assert late.figures["torque_phase"] is not None  # the same shift has the same phases


def test_washers_without_a_tilting_couple_are_told():
    one = np.ones(3)
    signals = {
        "transmission.washer_load": one,
        "washer.friction_torque": one,
        "transmission.washer_heat": 6.3 * one,
    }
    [line] = _of_washers(signals)
    assert "1 N" in line and "6.3 J" in line
    assert not list(_of_washers(signals | {"transmission.washer_load": 2.0 * one}))


def test_no_washers_means_no_washer_part(tmp_path):
    own = changed(tmp_path, BARE)
    assert "washer" not in own.parts and any("washers = 0" in note for note in own.notes)
