"""Each row is what a single solve gives; the order of rows; points that fail."""

import re
import subprocess
import sys
import tracemalloc
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    ParameterError,
    WasherParams,
    run_sweep,
    solve_clutch,
    solve_gearmesh,
    solve_washer,
)
from thrustwasher.clutch.parameters import SPEC as CLUTCH
from thrustwasher.gearmesh.parameters import SPEC as GEARMESH
from thrustwasher.model.registry import find_model, kernel_of
from thrustwasher.storage import journal
from thrustwasher.studio.evaluators import lines
from thrustwasher.studio.evaluators.lines import output_signals
from thrustwasher.studio.sweep import sweep_table
from thrustwasher.studio.sweep.sweep_plan import make_plan
from thrustwasher.washer.parameters import SPEC

UP = "200:1200:200"
REST = {"model": "gearmesh", "over": {"power": [1e3]}, "at": {"speed": 0.0}}


def test_a_line_is_a_chain_of_warm_washers():
    table = run_sweep("washer", {"load": UP}, at={"speed": 545.0}, workers=1)
    result = None
    for load, torque, status in zip(
        table["load"], table["friction_torque"], table["status"], strict=True
    ):
        result = solve_washer(WasherParams(), load=load, speed=545.0, tilt=2e-3, start=result)
        assert torque == pytest.approx(result.friction_torque, rel=1e-9)
        assert status == ("DISTRESS" if result.distress else "OK")


@pytest.mark.parametrize(
    ("model", "over", "at"),
    [
        ("gearmesh", {"power": [6e3]}, {"speed": 180.0}),
        (
            "losses",
            {"input_speed": [200.0]},
            {"output_speed": 60.0, "drum_speed": 20.0, "planet_speed": 90.0, "tooth_force": 5e2},
        ),
        ("train", {"torque": [60.0]}, {"speed": 300.0}),
    ],
)
def test_every_column_is_that_of_the_single_solve(model, over, at):
    """Whatever outputs a model has that a sweep leaves out."""
    record = find_model(model)
    table = run_sweep(model, over, at=at, workers=1)
    point = {name: values[0] for name, values in over.items()} | at
    alone = record.solve(record.spec.params(), **point)
    nowhere = {
        n for n in record.spec.absent(record.spec.params()) if re.match(r"(mesh|shaft)_\d_", n)
    }
    assert nowhere.isdisjoint(table.columns)  # no column of a mesh that is not there
    for s in (s for s in output_signals(record.spec)[0] if s.name not in nowhere):
        value, wanted = table[s.name][0], getattr(alone, s.name, None)
        if wanted is not None and np.isfinite(value):
            assert value == pytest.approx(wanted, rel=1e-9), s.name


def test_a_line_up_and_down_is_a_hysteresis_loop():
    loads = "400:1100:100,1000:400:-100"
    table = run_sweep("washer", {"load": loads}, at={"speed": 545.0}, workers=1)
    torque, lost = table["friction_torque"], table["distress"]
    at_800 = np.flatnonzero(table["load"] == 800.0)
    assert lost[at_800].tolist() == [False, True]  # film_lost lies at 956 N, film_regained lower
    assert torque[at_800[1]] > 2.0 * torque[at_800[0]]
    assert not lost[-1] and torque[-1] == pytest.approx(torque[0], rel=1e-5)


def test_inputs_run_faster_than_parameters_in_the_order_given():
    table = run_sweep(
        "gearmesh", {"pinion_teeth": [30, 40], "speed": [100.0, 200.0, 300.0], "load": [10.0, 20.0]}
    )
    assert table["speed"].tolist() == [100.0, 200.0, 300.0] * 4
    assert table["load"].tolist() == [10.0, 10.0, 10.0, 20.0, 20.0, 20.0] * 2
    assert table["pinion_teeth"].tolist() == [30] * 6 + [40] * 6


def test_gear_mesh_rows_are_single_solves():
    table = run_sweep("gearmesh", {"power": [5e3, 1e4]}, at={"speed": 180.0, "steel": "AISI1020"})
    one = solve_gearmesh(GearMeshParams(steel="AISI1020"), power=1e4, speed=180.0)
    assert table["load"][1] == pytest.approx(1e4 / 180.0)
    assert table["thermal_stress"][1] == pytest.approx(one.thermal_stress, rel=1e-12)
    assert table["friction_torque"][1] == pytest.approx(one.friction_torque, rel=1e-9)


@pytest.mark.parametrize("fidelity", ["closed", "stribeck", "field", "fine"])
def test_clutch_rows_are_single_solves_to_the_bit(fidelity):
    """Rows that are too hot and open packs among them; after a failure the search begins anew."""
    over = {"load": [0.0, 3e3, 9e3, 2e5, 1e4], "speed": [-20.0, 0.0, 60.0]}
    table = run_sweep("clutch", over, fidelity=fidelity, workers=1)
    real = [s.name for s in output_signals(CLUTCH)[0]]
    assert set(table["status"]) >= {"OK", "TOO_HOT"}
    for first in range(0, len(table), len(over["load"])):
        result = None
        for i in range(first, first + len(over["load"])):
            point = {name: float(table[name][i]) for name in over}
            result = solve_clutch(
                ClutchParams(), **point, fidelity=fidelity, start=result, throw=False
            )
            assert table["status"][i] == result.status.name
            if result.status.is_failure:
                result = None
                continue
            assert [table[name][i] for name in real] == [getattr(result, n) for n in real]
            assert table["regime"][i] == result.regime


def test_a_point_that_is_not_allowed_or_cannot_be_cooled_fails_its_line():
    points = {"load": [1e3, 2e3, -1.0], "speed": [5.0, 5.0, 5.0]}
    with pytest.raises(ParameterError, match=r"^point 3: load = -1\.0 N, allowed: 0 \.\. 1e\+06 N"):
        run_sweep("clutch", points=points, workers=1)
    uncooled = {"heat_transfer": 0.0, "groove_count": 0}
    table = run_sweep("clutch", {"load": [1e3], "speed": [0.0, 5.0]}, at=uncooled, workers=1)
    assert table["status"].tolist() == ["OK", "BAD_INPUT"]


@pytest.mark.parametrize(("model", "level"), [("gearmesh", "field"), ("washer", "map")])
def test_rows_that_are_stepped_compiled_are_single_steps_to_the_bit(model, level, monkeypatch):
    ends = {
        "gearmesh": {"load": "10:90:n4", "speed": "-90:180:n4"},
        "washer": {"load": "200:1900:n4", "speed": "300:1300:n3"},
    }[model]
    together = run_sweep(model, ends, fidelity=level, workers=1)
    kernel = kernel_of(find_model(model).spec)
    monkeypatch.delattr(kernel, "step_rows")
    alone = run_sweep(model, ends, fidelity=level, workers=1)
    for name, column in alone.columns.items():
        assert column.tolist() == together[name].tolist() or np.array_equal(
            column, together[name], equal_nan=True
        )


def test_a_power_without_speed_is_a_failed_row_not_a_missing_one():
    table = run_sweep("gearmesh", {"speed": [-100.0, 0.0, 100.0]}, at={"power": 1e4})
    assert table["status"].tolist() == ["OK", "BAD_INPUT", "OK"]
    assert np.isnan(table["friction_torque"][1]) and table["regime"][1] == ""
    assert table.failures == {"BAD_INPUT": 1}
    assert table["friction_torque"][0] == -table["friction_torque"][2]


def test_parameters_that_contradict_each_other_are_failed_rows():
    table = run_sweep("washer", {"gear_inner_radius": [0.005, 0.0156]}, workers=1)
    assert table["status"].tolist() == ["BAD_INPUT", "OK"]


def test_points_stand_alone_unless_they_share_a_line():
    speeds, loads = [545.0] * 3, [700.0, 1200.0, 700.0]
    apart = run_sweep("washer", points={"load": loads, "speed": speeds}, workers=1)
    assert apart["distress"].tolist() == [False, True, False]
    assert apart["friction_torque"][0] == apart["friction_torque"][2]
    walked = run_sweep(
        "washer", points={"load": loads, "speed": speeds, "line": [7, 7, 7]}, workers=1
    )
    assert walked["distress"].tolist() == [False, True, True]


def test_rows_through_the_map_are_single_look_ups():
    over = {"load": "100:900:200", "speed": [400.0, 700.0]}
    table = run_sweep("washer", over, fidelity="map", workers=1)
    for i in range(len(table)):
        point = {s.name: table[s.name][i] for s in SPEC.inputs}
        branch = "contact" if table["distress"][i] else "film"
        one = solve_washer(WasherParams(), **point, fidelity="map", branch=branch)
        assert one.fidelity == "map"
        assert table["friction_torque"][i] == pytest.approx(one.friction_torque, rel=1e-9)
        assert table["temperature"][i] == pytest.approx(one.temperature, rel=1e-9)


def test_a_tolerance_is_handed_to_the_choice_with_the_box_of_all_points(monkeypatch):
    from thrustwasher.ladder import choose

    asked = {}

    def choose_fine(model, box, **options):
        asked.update(options, model=model, box=box)
        return choose.Choice("fine", 0.01, 1e-6, ("gear mesh: fine", "because"))

    monkeypatch.setattr(choose, "choose", choose_fine)
    over = {"load": [10.0, 40.0], "speed": [50.0, 150.0]}
    table = run_sweep("gearmesh", over, fidelity="auto:0.05")
    assert (asked["model"], asked["tol"], asked["n_calls"]) == ("gearmesh", 0.05, 4)
    assert asked["box"]["load"] == (10.0, 40.0) and asked["box"]["speed"] == (50.0, 150.0)
    assert len({(p["load"], p["speed"]) for p in asked["points"]}) == 4
    assert (table.fidelity, "because" in table.choice) == ("fine", True)
    with pytest.raises(ParameterError, match="without varied parameters"):
        run_sweep("gearmesh", {**over, "pinion_teeth": [30, 40]}, fidelity="auto:0.05")


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"model": "gearbox", "over": {"load": [1.0]}}, "'washer' or 'clutch' or 'gearmesh'"),
        ({}, "nothing is varied"),
        ({"over": {"load": [1.0]}, "fidelity": "best"}, "'field'"),
        ({"over": {"load": [1.0]}, "fidelity": "auto:-1"}, "auto:TOLERANCE"),
        ({"over": {"load": [1.0]}, "at": {"load": 2.0}}, "twice"),
        ({"over": {"load": [1.0]}, "points": {"load": [1.0]}}, "without axes"),
        ({"points": {"load": [1.0, 2.0], "speed": [1.0]}}, "one length"),
        ({"points": {"load": []}}, "one length"),
        ({"over": {"load": [1.0]}, "at": {"tilt": "1e-3,2e-3"}}, "one value"),
        ({"over": {"load": [1.0]}, "params": ClutchParams()}, "WasherParams"),
        ({"over": {"load": [1.0]}, "workers": 0}, "workers = 0"),
        ({"over": {"load": [1.0]}, "workers": 2, "cluster": "x"}, "one of them"),
        ({"over": {"load": "0:1e4:n2001", "speed": "0:2000:n2000"}}, "up to"),
        ({"model": "gearmesh", "over": {"power": [1.0]}, "at": {"load": 1.0}}, "instead of load"),
        ({"over": {"power": [1.0]}}, "'power'"),
        ({"over": {"load": [1.0]}, "out": "x.txt"}, ".csv or .parquet"),
        ({"over": {"load": [1.0]}, "at": {"gear_inner_radius": 0.005}}, "gear_inner_radius"),
        (
            {"over": {"load": [1.0]}, "at": {"roughness": 4e-7}, "fidelity": "map"},
            "no map was made",
        ),
        ({"over": {"load": []}}, "load: no value is given"),
        ({**REST, "fidelity": "auto:0.05"}, "no point has allowed inputs"),
    ],
)
def test_wrong_arguments_are_named(arguments, says):
    with pytest.raises(ParameterError, match=re.escape(says)):
        run_sweep(**{"model": "washer", **arguments})


def test_columns_that_are_not_kept_are_in_the_file_alone(tmp_path):
    over = {"power": "1 kW:40 kW:1 kW", "speed": [0.0, 100.0, 200.0]}
    kept = run_sweep("gearmesh", over, out=tmp_path / "kept.csv", workers=1)
    table = run_sweep("gearmesh", over, out=tmp_path / "not.csv", workers=1, keep=False)
    assert (tmp_path / "not.csv").read_bytes() == (tmp_path / "kept.csv").read_bytes()
    assert (len(table), table.columns, table.failures) == (120, {}, {"BAD_INPUT": 40})
    assert (len(kept), kept.failures) == (120, table.failures)
    assert "status" in run_sweep("gearmesh", over, workers=1, keep=False).columns  # no file


@pytest.mark.parametrize("suffix", ["csv", pytest.param("parquet", marks=pytest.mark.slow)])
@pytest.mark.slow
def test_memory_does_not_grow_with_the_outputs_of_a_sweep_to_a_file(tmp_path, monkeypatch, suffix):
    """30 outputs are 240 bytes a point; inputs and what is done stay, on lines of 100 points."""
    monkeypatch.setattr(sweep_table, "CHUNK", 1000)
    monkeypatch.setattr(journal, "INTERVAL", 0.0)  # [s] nothing waits for the disk, by any pace
    peaks = []
    for n in (20, 20, 200):  # the first one loads what is needed
        over = {"power": "1 kW:30 kW:n100", "speed": f"100:300:n{n}"}
        out = tmp_path / f"{len(peaks)}.{suffix}"
        tracemalloc.start()
        run_sweep("gearmesh", over, out=out, workers=1, keep=False)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[2] - peaks[1] < 100 * (20_000 - 2_000)


def test_no_two_threads_write_to_one_work_array():
    spec, params = GEARMESH, GEARMESH.params()
    here = lines._steps(spec, "field", params).work
    assert here is lines._steps(spec, "field", params).work
    with ThreadPoolExecutor(1) as pool:
        there = pool.submit(lines._steps, spec, "field", params).result().work
    assert not np.shares_memory(here, there)


@pytest.mark.parametrize(
    ("model", "level", "over"),
    [
        ("clutch", "field", {"load": (500.0, 2e3), "speed": (1.0, 20.0)}),
        ("gearmesh", "field", {"power": (1e3, 9e3), "speed": (50.0, 500.0)}),
        ("washer", "map", {"load": (100.0, 900.0), "speed": (300.0, 1300.0)}),
    ],
)
def test_random_points_are_each_solved_from_nothing_and_their_part_is_made_once_a_task(
    model, level, over, monkeypatch
):
    draw = np.random.default_rng(3)
    points = {name: draw.uniform(*ends, 640) for name, ends in over.items()}
    made = []
    monkeypatch.setattr(lines, "_steps", lambda *a, f=lines._steps: made.append(a) or f(*a))
    table = run_sweep(model, points=points, fidelity=level, workers=1)
    assert len(made) <= 64  # once a task
    for i in range(0, 640, 80):
        alone = {name: column[i : i + 1] for name, column in points.items()}
        own = run_sweep(model, points=alone, fidelity=level, workers=1)
        assert own["friction_torque"][0] == table["friction_torque"][i]


def test_a_column_with_a_number_out_of_range_names_its_point():
    with pytest.raises(ParameterError, match=r"point 2: speed = 9000.0 rad/s, allowed: "):
        run_sweep("clutch", points={"load": [1e3, 1e3], "speed": np.array([5.0, 9e3])})


def test_what_is_held_takes_no_memory_and_can_be_written_in_the_table():
    plan = make_plan("clutch", {"load": "1 kN:3 kN:n500"}, {"speed": 10.0}, None, None, None)
    held = [name for name, column in plan.columns.items() if column.strides == (0,)]
    assert {"speed", "oil_temperature"} <= {*held} and "load" not in held
    for keep in (slice(0, 10), slice(None)):
        columns = plan.columns_at(keep)
        columns["speed"][:] = 1.0
        assert (plan.columns["speed"] == 10.0).all()


@pytest.mark.slow
def test_parquet_is_written_without_modules_that_take_memory(tmp_path):
    pytest.importorskip("pyarrow")
    code = (
        "import os, sys; from thrustwasher import run_sweep; run_sweep('clutch', "
        "{'load': '1 kN:3 kN:n100'}, at={'speed': 10.0}, fidelity='closed', out='x.parquet', "
        "workers=1, keep=False); print({'pandas', 'pyarrow.compute'} & {*sys.modules}, "
        "[x for x in os.environ if 'ARROW' in x], sys.modules['pyarrow'].default_memory_pool()"
        ".backend_name)"
    )
    words = [sys.executable, "-c", code]
    told = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert told.split() == ["set()", "[]", "system"]


def test_of_points_that_share_a_part_each_fails_for_itself():
    points = {"load": [1e3] * 4, "speed": [0.0, 5.0, 0.0, 5.0]}
    uncooled = {"heat_transfer": 0.0, "groove_count": 0}
    table = run_sweep("clutch", points=points, at=uncooled, workers=1)
    assert table["status"].tolist() == ["OK", "BAD_INPUT", "OK", "BAD_INPUT"]


@pytest.mark.parametrize(
    "column",
    [
        np.float32([300.0, 233.15, 320.0]),  # 233.14999 K
        np.ma.masked_array([300.0, 310.0, 320.0], [False, True, False]),
        np.array([[300.0], [310.0], [320.0]]),
    ],
    ids=["below the range once it is a double", "masked", "two axes"],
)
def test_a_column_of_points_is_checked_as_numbers_are(column):
    points = {"load": [1e3] * 3, "speed": [-0.0, 5.0, 5.0], "oil_temperature": column}
    with pytest.raises(ParameterError, match="oil_temperature"):
        run_sweep("clutch", points=points, workers=1)
    at = {"load": [1e3], "speed": np.array([-0.0])}
    assert str(run_sweep("clutch", points=at, workers=1)["speed"][0]) == "0.0"
