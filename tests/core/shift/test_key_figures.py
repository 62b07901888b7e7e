"""Jerk, torque hole, flare and phases, read from signals that are known."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scene_runs import changed, real_shift, shift, slow_without_jit

from thrustwasher.shift import load_scene
from thrustwasher.shift.account.shift_record import record_of
from thrustwasher.shift.account.what_happened import headline, known_texts
from thrustwasher.shift.key_figures.comfort import comfort_figures
from thrustwasher.shift.key_figures.events_and_phases import find_events, find_phases
from thrustwasher.shift.key_figures.key_figures import carried_torque, shift_heat, slip_end
from thrustwasher.shift.scene.scene_file import known_bands
from thrustwasher.studio.report.shift.shift_report import _cards
from thrustwasher.studio.report.shift.usual import usual_table
from thrustwasher.studio.scatter.propagate import propagate
from thrustwasher.units import format_quantity

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


# Key figures of packs and shift mean what their names say, in both directions.

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


# Bands of a built-in scene, known without a study: shown while nothing of it was changed.


@pytest.fixture(scope="module")
def bands_found():
    return real_shift("planetary")


@slow_without_jit
def test_the_first_screen_shows_the_median_and_the_nominal_jerk_beside(bands_found):
    """What real units do is the headline: the nominal run alone may lie outside of the band."""
    record = record_of(bands_found)
    low, middle, high = known_bands(bands_found.scene)["peak_jerk"].quantiles.values()
    nominal = bands_found.figures["peak_jerk"]
    low_, middle_, high_, own = (
        format_quantity(x, "m/s3", digits=3) for x in (low, middle, high, nominal)
    )
    words = f"is {middle_} (median; {low_} to {high_} from 5 to 95 %), {own} with nominal values"
    assert words in headline(record) and words in known_texts(record)[0]
    (card,) = [c for c in _cards(record) if "change of acceleration" in c.name]
    value, note = (str(x).replace("\N{NO-BREAK SPACE}", " ") for x in (card.value, card.note))
    assert value == middle_ and not card.figure  # no script writes the nominal value over it
    assert f"5 .. 95 %: {low_} .. {high_}<br>nominal values: {own}" in note
    (row,) = [row for row in usual_table(record).rows if row[0].startswith("jerk of the vehicle")]
    assert row[4] == ("▲\N{NO-BREAK SPACE}above" if middle > 15.0 else "")
    assert bands_found.to_dict()["known_bands"]["peak_jerk"]["quantiles"]["0.5"] == middle


@slow_without_jit
def test_what_is_known_is_of_this_version(bands_found):
    """Else: python -m lab.benchmarks.scatter_scene bands FILE, which is known_bands.toml."""
    for name, band in known_bands(bands_found.scene).items():
        now = bands_found.figures.get(name)
        assert now is None or now == pytest.approx(band.nominal, rel=0.02), name


def test_nothing_is_known_of_a_changed_scene(tmp_path):
    scene = load_scene("planetary")
    assert known_bands(scene)
    assert known_bands(scene.with_options(step=5e-4, master="jacobi"))
    other = changed(tmp_path, "[clutch]\nfriction_scale = 0.98\n")
    assert known_bands(replace(other, name="planetary")) == {}
    assert known_bands(load_scene("planetary-cold")) == {}


def test_profiles_are_tuned_for_the_scatter():
    """The profiles that suit nominal values: 12 m/s3 with them, 112 in the worst twentieth."""
    jerk = known_bands(load_scene("planetary"))["peak_jerk"]
    low, middle, high = jerk.quantiles.values()
    assert low < jerk.nominal < middle * 1.1 and high < 0.5 * 112.0


@pytest.mark.slow
def test_a_study_finds_the_known_bands_and_the_nominal_run_in_their_middle():
    """Not so what washers take and how hot they get: share and oil lie low in their ranges."""
    scene = load_scene("planetary")
    study = propagate(scene, runs=64, workers=1, indices=False)
    figures = study.figures
    for name in known_bands(scene).keys() - {"washer_torque", "peak_washer_temperature_max"}:
        low, high = np.nanquantile(study.sample[name], [0.25, 0.75])
        assert low <= figures[name].nominal <= high, name
    for name, known in known_bands(scene).items():
        for level, value in known.quantiles.items():
            low, high = figures[name].confidence[level]
            room = 0.1 * abs(known.quantiles[0.95] - known.quantiles[0.05])
            assert low - room <= value <= high + room or not np.isfinite([low, high]).all(), name
