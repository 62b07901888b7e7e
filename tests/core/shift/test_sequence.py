"""Several shifts in one run: each is the shift it would be alone, the oil gets all their heat."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import instances, shift

from tests.needed import package
from thrustwasher.errors import ParameterError
from thrustwasher.gearmesh.parameters import absent_outputs
from thrustwasher.shift import cosimulate, load_scene, run_sequence
from thrustwasher.shift.cosim.loop import Recorder
from thrustwasher.shift.scene.sequence import shift_scene

BODY = """base = "planetary"
stop_time = {stop}
[sequence]
shifts = {shifts}
window = {window}
[sequence.down]
clutch = [[0.0, 7.2e5], [0.1, 7.2e5], [0.14, 1.5e5], [0.4, 1e5], [0.5, 0.0]]
brake = [[0.0, 0.0], [0.3, 0.0], [0.31, 4e4], [0.5, 6e4], [0.7, 7.6e5]]
engine = [[0.0, 32.0], [0.1, 120.0], [1.3, 120.0], [1.5, 25.0]]
{more}"""
TWO = '[[0.0, "up"], [6.0, "down"]]'


def scene(tmp_path, shifts=TWO, stop=9.0, window=1.3, more="[sump]"):
    path = tmp_path / "mine.toml"
    path.write_text(BODY.format(shifts=shifts, stop=stop, window=window, more=more), "utf-8")
    return load_scene(path)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    two = scene(tmp_path_factory.mktemp("two"))
    return run_sequence(two, instances(two))


def test_the_first_shift_is_the_one_it_is_alone(run):
    alone, mine = shift("planetary"), run.shifts[0]
    assert [p.name for p in mine.phases] == [p.name for p in alone.phases]
    for name in ("lock_time", "slip_energy", "filled_time"):
        assert mine.figures[name] == pytest.approx(alone.figures[name], rel=2e-3)
    assert mine.figures["peak_jerk"] == pytest.approx(alone.figures["peak_jerk"], rel=1e-2)


def test_a_sequence_is_short_as_text_and_a_dataset_over_time(run):
    text = repr(run)
    assert text.startswith(f"SequenceResult: {len(run.time)} rows") and len(text) < 1500
    package("xarray")
    found = run.to_xarray()
    assert dict(found.sizes) == {"time": len(run.time)}
    speed = found["transmission.output_speed"]
    assert speed.attrs["units"] == "rad/s"
    assert speed.values.tolist() == run.signals["transmission.output_speed"].tolist()


def test_figures_alone_are_the_same_and_take_the_rows_of_one_window(run, monkeypatch):
    """Before, a run of 500 shifts took 1.1 GB."""
    rows, made = [], Recorder.__init__
    monkeypatch.setattr(
        Recorder, "__init__", lambda own, system, n: rows.append(n) or made(own, system, n)
    )
    bare = run_sequence(run.scene, instances(run.scene), keep="figures")
    whole, kept = run.to_dict(), bare.to_dict()
    assert whole.pop("wall_time") and kept.pop("wall_time")
    assert kept == whole and bare.warnings == run.warnings
    assert max(rows) == 1301 and len(run.time) > 2600
    assert len(bare.time) <= 2 * len(bare.shifts) + 3 and not bare.shifts[0].signals
    assert {run.time.tolist().index(t) for t in bare.time} >= {0, len(run.time) - 1}
    with pytest.raises(ParameterError, match="keep = 'some', allowed: 'all' or 'figures'"):
        run_sequence(run.scene, {}, keep="some")


@pytest.mark.slow
def test_checks_after_a_run_are_the_same_where_figures_alone_are_kept(tmp_path):
    two = scene(tmp_path)
    found = [run_sequence(two, instances(two), guard=True, keep=k) for k in ("all", "figures")]
    assert found[0].step_errors == found[1].step_errors and found[0].warnings == found[1].warnings
    assert found[0].in_time.keys() == found[1].in_time.keys() == {"washer"}


def test_the_second_shift_is_down_and_its_heat_its_own(run):
    s, down = run.signals, run.shifts[1]
    assert [p.name for p in down.phases][-1] == "locked"
    assert 6.3 < down.figures["lock_time"] < 6.8
    total = s["transmission.brake_heat"][-1]
    first = np.interp(6.0, run.time, s["transmission.brake_heat"])
    assert down.figures["slip_energy"] == pytest.approx(total - first, rel=1e-6)
    assert s["transmission.brake_locked"][-1] == 1.0 and s["transmission.clutch_locked"][-1] == 0.0


def test_heat_made_is_heat_stored_and_heat_in_the_oil(run):
    s, h = run.signals, np.diff(run.time)
    for pack in ("clutch", "brake"):
        stored = s[f"{pack}.stored_heat"][-1] - s[f"{pack}.stored_heat"][0]
        oil = np.sum(s[f"{pack}.oil_heat"][1:] * h)
        assert stored + oil == pytest.approx(s[f"{pack}.energy"][-1], rel=1e-12)
    factors = {"clutch": 1, "brake": 1, "washer": 8, "mesh": 4, "ring_mesh": 4}
    sent = sum(f * np.sum(s[f"{p}.oil_heat"][1:] * h) for p, f in factors.items())
    for power in ("bearing_power", "loss_power"):
        sent += np.sum(s[f"transmission.{power}"][1:] * h)
    assert s["sump.received_heat"][-1] == pytest.approx(sent, rel=1e-12)
    left = s["sump.stored_heat"][-1] + s["sump.ambient_heat"][-1]
    assert left == pytest.approx(s["sump.received_heat"][-1], rel=1e-12)
    assert abs(s["transmission.energy_residual"][-1]) < 1e-12 * s["transmission.engine_work"][-1]


def test_the_first_shifts_of_the_duty_cycle_are_comfortable():
    """Later ones have warmer oil, whose packs drag less, under the same profiles."""
    duty = load_scene("duty-cycle")
    three = replace(duty.sequence, shifts=duty.sequence.shifts[:2])
    duty = replace(duty, sequence=three, stop_time=22.0)
    for found in run_sequence(duty, instances(duty)).shifts:
        assert found.figures["peak_jerk"] <= 20.0 and "tie_up_torque" not in found.figures


def test_steps_are_long_between_the_shifts(run):
    h = np.diff(run.time)
    assert h.max() <= 0.5 + 1e-12 and h.min() == pytest.approx(1e-3)
    assert len(h) < 2.0 * 1300 + 40
    assert {1.3, 6.0, 7.3} <= set(run.time.tolist())


@pytest.mark.slow
def test_the_steps_between_hardly_matter_to_the_oil(run, tmp_path):
    fine = scene(tmp_path)
    fine = replace(fine, sequence=replace(fine.sequence, pause_step=0.05))
    again = run_sequence(fine, instances(fine))
    rise, other = (r.oil_temperature[-1] - r.oil_temperature[0] for r in (run, again))
    assert other == pytest.approx(rise, rel=0.01)
    locks = [r.shifts[1].figures["lock_time"] for r in (run, again)]
    assert locks[1] == pytest.approx(locks[0], abs=1e-3)


def test_the_record_and_the_table_hold_both_shifts(run, tmp_path):
    assert run.oil_temperature[-1] != run.oil_temperature[0]
    record = run.as_dict()
    assert [s["direction"] for s in record["shifts"]] == ["up", "down"]
    run.write_csv(tmp_path / "all.csv")
    assert len((tmp_path / "all.csv").read_text("utf-8").splitlines()) == len(run.time) + 1


def test_the_page_holds_all_signals_and_a_row_for_each_shift(run):
    from thrustwasher.studio.report.html import render
    from thrustwasher.studio.report.shift.sequence_report import sequence_page

    page = sequence_page(run)
    data = page.data["runs"][0]
    assert [p.name for p in data["phases"]] == ["1 up", "2 down"]
    assert [text for _, text in data["events"]] == ["1 up locks", "2 down locks"]
    shown = {signal["name"] for signal in (*data["moving"], *data["steady"])}
    assert {name.partition(".")[2] for name in set(run.signals) - shown} == absent_outputs(
        run.scene.parts["mesh"].params
    )
    assert [row[0] for row in page.sections[0].tables[0].rows] == ["1 up", "2 down"]
    assert len(render(page).encode()) < 2_000_000


@pytest.mark.slow
def test_ramps_of_a_command_go_up_and_down(tmp_path):
    path = tmp_path / "ramps.toml"
    path.write_text(
        'base = "msl"\nstop_time = 40.0\n[sequence]\n'
        'shifts = [[0.0, "up"], [20.0, "down"]]\nwindow = 6.0\n'
    )
    whole = load_scene(path)
    up, down = (shift_scene(whole, i) for i in range(2))
    assert (up.command(0.0), up.command(20.0)) == (up.shift_from, up.shift_to) == (0.0, 1.0)
    assert (down.command(20.0), down.command(40.0)) == (1.0, 0.0)
    found = run_sequence(whole, instances(whole)).signals
    assert found["transmission.brake_locked"][-1] == 1.0 and found["transmission.lock_time"][-1] > 0


def test_one_run_does_not_take_the_other_scene(run, tmp_path):
    with pytest.raises(ParameterError, match="run_sequence"):
        cosimulate(run.scene, {})
    with pytest.raises(ParameterError, match="cosimulate"):
        run_sequence(load_scene("planetary"), {})
    with pytest.raises(ParameterError, match="gauss-seidel"):
        run_sequence(run.scene.with_options(master="jacobi"), {})
