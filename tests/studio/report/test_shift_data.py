"""What the scripts of a page are given: every signal, packed without loss."""

import base64
import zlib
from dataclasses import replace

import numpy as np
import pytest
import shift_stand_in
from test_usual import full

from thrustwasher.model.registry import find_spec
from thrustwasher.shift.scene.connections import PARTS
from thrustwasher.studio.report.shift import shift_data
from thrustwasher.studio.report.shift.shift_data import pack, panels, run_data


def unpacked(run):
    """Return the rows of a run: time, then the signals that move."""
    planes = np.frombuffer(zlib.decompress(base64.b64decode(run["packed"])), dtype=np.uint8)
    bits = planes.reshape(-1, 4, run["points"]).transpose(0, 2, 1).copy().view("<i4")[..., 0]
    for _ in range(2):
        bits = np.cumsum(bits, axis=1, dtype=np.int32)
    return bits.view("<f4")


def row(run, name):
    place = next(signal["row"] for signal in run["moving"] if signal["name"] == name)
    return unpacked(run)[place]


def test_packed_signals_come_back_to_the_bit():
    rng = np.random.default_rng(1)
    rows = np.array([np.linspace(0.0, 9.0, 400), rng.normal(size=400), np.full(400, np.nan)], "<f4")
    rows[1, 7] = np.inf
    back = unpacked({"packed": pack(rows), "points": 400})
    assert back.tobytes() == rows.tobytes()


def test_every_signal_of_a_run_is_in_its_page_once():
    record = shift_stand_in.record(mesh=True)
    run = run_data(record, {})
    names = [s["name"] for s in (*run["moving"], *run["steady"])]
    assert sorted(names) == sorted(record.signals)
    speed = record.signals["transmission.engine_speed"].astype(np.float32)
    assert np.array_equal(row(run, "transmission.engine_speed"), speed)


def test_words_and_units_are_those_of_the_models():
    run = run_data(shift_stand_in.record(), {})
    shown = {s["name"]: s for s in (*run["moving"], *run["steady"])}
    hot = shown["clutch.temperature"]
    told = next(s for s in find_spec("clutch").outputs if s.name == "temperature")
    assert hot["help"] == f"clutch: {told.help}" and (hot["unit"], hot["zero"]) == ("°C", 273.15)
    assert hot["limit"] > 400.0 and "limit" not in shown["washer.temperature"]
    assert shown["transmission.engine_work"]["unit"] == "kJ"
    assert shown["transmission.engine_work"]["scale"] == 1e3


def test_every_signal_that_a_panel_or_a_flow_names_is_one_of_a_model():
    known = {f"{p}.{s.name}" for p, spec in PARTS.items() for s in (*spec.inputs, *spec.outputs)}
    known |= set(shift_data.OF_THE_VEHICLE)
    named = [name for panel in panels()["panel"] for name in panel["signals"]]
    named += [flow[k] for flow in panels()["flow"] for k in ("signal", "kept") if k in flow]
    assert [name for name in named if name not in known] == []


def test_a_long_run_is_thinned_but_not_beside_events():
    record = shift_stand_in.record()
    room = len(run_data(record, {})["packed"]) // 6
    thin = run_data(record, {}, room=room)
    assert len(thin["packed"]) <= room and thin["recorded"] == 2501
    time = row(thin, "transmission.engine_work").shape[0]
    assert time == thin["points"] < 2501 / 3
    times = unpacked(thin)[0]
    assert times[-1] == np.float32(2.5)
    for event in record.events:
        assert np.sum(np.abs(times - event.time) <= 1.01e-3) >= 3


def test_a_thinned_run_has_the_extremes_of_every_signal_in_each_phase():
    record, rng = shift_stand_in.record(), np.random.default_rng(3)
    noise = {name: rng.normal(size=2501) * (1.0 + record.time) for name in ("clutch.load", "x.y")}
    noise["x.y"][:1000] = np.nan
    record = replace(record, signals=record.signals | noise)
    thin = run_data(record, {}, room=len(run_data(record, {})["packed"]) // 4)
    times = unpacked(thin)[0]
    assert len(times) == thin["points"] < 1000
    for name, values in record.signals.items():
        if name not in [signal["name"] for signal in thin["moving"]]:
            continue
        for _, start, end in record.phases:
            within = values[(record.time >= start) & (record.time <= end)]
            kept = row(thin, name)[(times >= np.float32(start)) & (times <= np.float32(end))]
            if np.all(np.isfinite(within)):
                assert kept.min() == pytest.approx(within.min(), rel=2e-5)
                assert kept.max() == pytest.approx(within.max(), rel=2e-5)


def test_signals_that_parts_hand_on_are_packed_once():
    run = run_data(shift_stand_in.record(), {})
    rows = {signal["name"]: signal["row"] for signal in run["moving"]}
    assert rows["clutch.speed"] == rows["transmission.clutch_speed"]
    assert len(unpacked(run)) == 1 + len(set(rows.values())) < 1 + len(rows)


def test_jerk_is_the_change_over_ten_milliseconds():
    jerk = row(run_data(full(), {}), "vehicle.jerk")
    assert np.min(jerk) == pytest.approx(-0.1 / 0.01, rel=1e-6) and jerk[-1] == 0.0
    names = [s["name"] for s in run_data(shift_stand_in.record(), {})["moving"]]
    assert not [name for name in names if name.startswith("vehicle")]


def test_friction_with_the_oil_is_torque_over_load_where_that_is_large():
    record = shift_stand_in.record()
    load = np.where(record.time < 0.2, 10.0, 4000.0)
    pack = find_spec("clutch").params()
    torque = 0.2 * load * pack.friction_radius * pack.faces
    given = {"load": load, "friction_torque": -torque, "viscous_torque": torque}
    signals = record.signals | {f"clutch.{name}": values for name, values in given.items()}
    run = run_data(replace(record, signals=signals), {})
    shown = row(run, "clutch.friction_with_oil")
    assert np.all(np.isnan(shown[record.time < 0.2]))
    assert shown[record.time >= 0.2] == pytest.approx(0.2)
