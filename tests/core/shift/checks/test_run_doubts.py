"""Packs that do not hold as a shift takes for granted: lock-up is the last one, and it is said."""

import re
from dataclasses import replace

import numpy as np
import pytest
from scene_runs import NOMINAL, changed, instances, shift, slow_without_jit

from thrustwasher.errors import SolveError
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.checks.capacity import holding
from thrustwasher.shift.checks.rule_data import NUMBERS
from thrustwasher.shift.key_figures.events_and_phases import Event, lock_up
from thrustwasher.shift.warning_texts import scope_of, warnings_of

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
    result = run(tmp_path, NOMINAL.replace("[engine]", '[engine]\nspeed = "-1000 rpm"'))
    locks = [e.time for e in result.events if e.kind == "clutch_locked"]
    f = result.figures
    assert len(locks) > 1 and f["lock_time"] == locks[-1]
    assert not any(e.kind == "clutch_released" and e.time > locks[-1] for e in result.events)
    inertia = next(p for p in result.phases if p.name == "inertia phase")
    assert inertia.end == locks[-1] and f["inertia_phase"] == inertia.end - inertia.start
    assert [p.name for p in result.phases][-1] == "locked"
    assert f["flare"] == 0.0  # an engine that turns backwards and only slows down


def by_rules(signals=None, **values):
    """Return the warnings of runs that all other rules have nothing to say of."""
    rows = ("packs", "statuses", "laws", "boxes", "linings", "warm", "maps", "dry", "washers")
    nothing = {name: [] for name in rows}
    times = {"start_time": 0.0, "stop_time": 1.3, "shift_start": 0.1, "shift_end": 0.9}
    steps = {"step": 1e-3, "scene_step": 1e-3, "until": 1.3, "time": np.linspace(0.0, 1.3, 1301)}
    run = {"alone": True, "engaging": "clutch", "releasing": "brake", "lock_time": None}
    own = {**NUMBERS, **nothing, **times, **steps, **run, "flare": None, "locks": []}
    return [*warnings_of("run", scope_of(own | values, signals))]


@pytest.mark.parametrize(("every", "words"), [(0.002, "numerical"), (0.02, "asks for more")])
def test_sticking_and_slipping_in_turn_is_told_with_its_times(every, words):
    locks = [0.7 + i * every for i in range(10)]
    [line] = by_rules(locks=locks, lock_time=locks[-1])
    assert f"from 0.7 to {0.7 + 9 * every:.4g} s (10 lock-ups)" in line and words in line
    assert not by_rules(locks=locks[:1], lock_time=locks[0])


@slow_without_jit
def test_a_pack_let_go_at_the_end_held_until_then(tmp_path):
    points = '[[0.1, 0.0], [0.2, "720 kPa"], [1.1, "720 kPa"], [1.2, 0.0]]'
    result = run(tmp_path, f"[pressure.clutch]\npoints = {points}\n")
    [line] = [w for w in result.warnings if w.startswith("At the end no pack holds")]
    assert f"{result.figures['lock_time']:.4g} s" in line
    assert result.phases[-1].name == "open"


@slow_without_jit
def test_a_late_clutch_leaves_the_engine_free_and_says_so(tmp_path):
    result = run(tmp_path, NOMINAL + 'fill_volume = 1e-4\nfill_flow = "10 l/min"\n')
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


@pytest.mark.parametrize("pack", ["clutch", "brake"])
@pytest.mark.parametrize("name", ["planetary", "planetary-sun"])
def test_the_torque_that_holds_a_gear_is_that_of_the_free_members(name, pack):
    """Each member by itself: teeth drive the drum's gear by r tau, the carrier by (1 + r) tau."""
    p = load_scene(name).parts["transmission"].params
    engine, output, r = 250.0, 60.0, p.ratio
    driven, drum, carrier = (getattr(p, f"{n}_inertia") for n in ("input", "drum", "carrier"))
    x = np.array(
        [1.0, -1.0, 0.0] if pack == "clutch" else [0.0, 1.0, 0.0]
    )  # it turns what it holds
    # unknown: rates of driven gear, drum, carrier; tooth torque; the pack's torque
    rows = np.zeros((5, 5))
    rows[:3, :3] = np.diag([driven, drum, carrier])
    rows[:3, 3], rows[:3, 4] = [1.0, r, -(1.0 + r)], x
    rows[3, :3] = [1.0, r, -(1.0 + r)]  # speeds of the set
    rows[4, :3] = x  # the slip stays
    torque = np.linalg.solve(rows, [engine, 0.0, -output, 0.0, 0.0])[4]
    law = holding(p, pack)
    assert law.engine * engine + law.output * output == pytest.approx(torque, rel=1e-10)
    rows[4], more = [0.0, 0.0, 0.0, 0.0, 1.0], torque + 1.0  # the pack carries 1 N m more
    slip = x @ np.linalg.solve(rows, [engine, 0.0, -output, 0.0, more])[:3]
    assert slip == pytest.approx(-law.mobility, rel=1e-9)


WEAK = {
    "brake": '[[0.0, "{} kPa"], [0.16, "{} kPa"], [0.36, "80 kPa"], [0.38, 0.0]]',
    "clutch": '[[0.1, 0.0], [0.11, "40 kPa"], [0.2, "40 kPa"], [0.4, "{} kPa"], [1.0, "{} kPa"]]',
}


@slow_without_jit
@pytest.mark.parametrize(
    ("pack", "kpa", "gear"),
    [("brake", 200, "first"), pytest.param("clutch", 230, "second", marks=pytest.mark.slow)],
)
def test_a_pack_too_weak_for_its_gear_is_told_first_and_the_advice_cures_it(
    tmp_path, pack, kpa, gear
):
    def pressed(pressure):
        points = WEAK[pack].format(pressure, pressure)
        return run(tmp_path, f"[pressure.{pack}]\npoints = {points}\n")

    result = pressed(kpa)
    line = result.warnings[0]
    assert line.startswith(f"The {pack} is too weak for {gear} gear: under ")
    told = "\n".join(result.warnings)
    assert "initial speeds" not in told and "let it go later" not in told
    assert "HOT" in told  # of a part, behind the cause
    capacity, need = (
        float(re.search(rf"{word} ([\d.]+) N·m", line)[1]) for word in ("holds", "gear takes")
    )
    r = 38.0 / 74.0
    held = {"brake": r, "clutch": r / (1.0 + r)}[pack] * 253.0  # without acceleration
    assert need == pytest.approx(held, rel=0.04)
    mean = (85e-3**3 - 64e-3**3) / (85e-3**2 - 64e-3**2) / 1.5
    assert capacity == pytest.approx(4 * 0.112 * mean * 8e-3 * (kpa - 30.0) * 1e3, rel=0.04)
    times = float(re.search(r"([\d.]+) times", line)[1])
    cured = pressed(30.0 + times * (kpa - 30.0))  # behind the spring of 30 kPa
    assert not any("too weak" in w for w in cured.warnings)
    assert cured.figures["lock_time"] is not None


def test_washers_without_a_tilting_couple_are_told():
    one = np.ones(3)
    signals = {"transmission.washer_load": one, "transmission.washer_heat": 6.3 * one}
    [line] = by_rules(signals, washers=[{}])
    assert "1 N" in line and "6.3 J" in line
    assert not by_rules(signals | {"transmission.washer_load": 2.0 * one}, washers=[{}])


def test_no_washers_means_no_washer_part(tmp_path):
    own = changed(tmp_path, BARE)
    assert "washer" not in own.parts and any("washers = 0" in note for note in own.notes)


# What a scene and its signals show to be doubtful is a warning, without a further run.


def said(name="msl", **changes):
    scene = replace(load_scene(name), **changes).checked()
    return " ".join(cosimulate(scene, instances(scene)).warnings)


def test_a_shift_that_the_run_does_not_hold_is_told():
    assert "after the run ends at 0.05 s: nothing shifts" in said(stop_time=0.05)
    assert "before the pressures of the shift have settled at 2.1 s" in said(stop_time=2.05)
    assert "before the run does at 2.05 s" in said(start_time=2.05, stop_time=2.2)


def test_a_step_adapted_by_more_than_a_percent_is_told():
    assert "The step is 3.333 ms, not 4.9 ms" in said(stop_time=0.01, step=4.9e-3)
    assert "The step is" not in said(stop_time=0.1, step=0.1 / 33 * 1.001)


def test_inputs_that_leave_the_box_of_a_part_file_are_told():
    scene = load_scene("msl").with_options(stop_time=0.05)
    narrow = replace(scene.parts["brake"], labels={"box": {"load": (0.0, 10.0)}})
    words = said(stop_time=0.05, parts={**scene.parts, "brake": narrow})
    assert "brake: load of 100 N .. 100 N in this run leaves the 0 N .. 10 N" in words
    wide = replace(narrow, labels={"box": {"load": (0.0, 100.0)}})
    assert "[box]" not in said(stop_time=0.05, parts={**scene.parts, "brake": wide})


def test_a_shift_that_does_not_happen_comes_before_what_its_scene_has_no_use_for():
    scene = replace(load_scene("msl").with_options(stop_time=0.05), warnings=("look here",))
    first, *others = cosimulate(scene, instances(scene)).warnings
    assert "nothing shifts" in first and "look here" in others
    assert shift("msl", stop_time=0.05).as_dict()["warnings"][0] != "look here"


@pytest.mark.slow
def test_a_guarded_run_needs_instances_that_can_be_reset():
    scene = load_scene("msl").with_options(stop_time=0.05)
    found = cosimulate(scene, instances(scene), guard=True)
    assert found.step_error is not None and found.step_error.suffices


def test_contacts_outside_the_data_of_their_dry_friction_are_told():
    words = said("planetary-distressed", stop_time=0.02)
    assert "points, first at 0 s: dry friction was measured for mean contact pressures" in words
    assert "dry friction was" not in said("planetary", stop_time=0.02)
