"""Columns as Python's users have them: a path, a DataFrame, an MDF in place of a dict."""

import numpy as np
import pytest

from tests.needed import package
from thrustwasher import ClutchParams, calibrate, calibrate_traces, engage_clutch, run_sweep
from thrustwasher.storage.tables.given import columns_given

RPM = np.pi / 30.0
PACK = ClutchParams(friction_law="constant", constant_friction=0.1)
POINTS = {"load": [1.0, 2.0, 3.0], "speed": [100.0, 200.0, 300.0]}  # kN, rpm
UNITS = {"load": "kN", "speed": "rpm", "friction_torque": "N.m"}
SI = {"load": [1e3, 2e3, 3e3], "speed": [100 * RPM, 200 * RPM, 300 * RPM]}


def frame(columns, units=UNITS, index=None):
    found = package("pandas").DataFrame(columns, index=index)
    found.attrs["units"] = {name: unit for name, unit in units.items() if name in columns}
    return found


def test_a_sweep_takes_points_of_a_frame_in_its_units():
    table = run_sweep("clutch", points=frame({**POINTS, "note": ["a", "b", "c"]}), workers=1)
    plain = run_sweep("clutch", points=SI, workers=1)
    np.testing.assert_allclose(table["friction_torque"], plain["friction_torque"], rtol=1e-12)


def test_a_fit_takes_a_frame_and_a_path(tmp_path):
    torque = run_sweep("clutch", points=SI, workers=1)["friction_torque"].tolist()
    plain = calibrate("clutch", {**SI, "friction_torque": torque}, fit=["friction_scale"])
    data = frame({**POINTS, "friction_torque": torque})
    data.rename(columns=lambda n: f"{n} [{UNITS[n]}]").to_csv(tmp_path / "rig.csv", index=False)
    for given in (data, tmp_path / "rig.csv", str(tmp_path / "rig.csv")):
        found = calibrate("clutch", given, fit=["friction_scale"])
        assert found.params.friction_scale == pytest.approx(plain.params.friction_scale, rel=1e-9)
    with pytest.raises(ValueError, match="data: float, allowed: columns by name, a path"):
        calibrate("clutch", 3.0, fit=["friction_scale"])


def recorded():
    time = np.linspace(0.0, 0.4, 81)
    way = {"load": 5e3 * np.minimum(time / 0.1, 1.0), "speed": 100.0 * (1.0 - time / 0.4)}
    torque = engage_clutch(ClutchParams(friction_scale=0.9), time=time, **way).friction_torque
    return time, {**way, "friction_torque": torque}


@pytest.mark.parametrize("kind", ["column", "seconds", "timedelta", "timestamp"])
def test_a_recording_is_a_frame_with_time_as_a_column_or_the_index(kind):
    pandas = package("pandas")
    time, columns = recorded()
    units = {"load": "N", "speed": "rad/s"}
    index = {
        "column": None,
        "seconds": pandas.Index(time, name="time"),
        "timedelta": pandas.to_timedelta(time, unit="s"),
        "timestamp": pandas.Timestamp("2025-03-04") + pandas.to_timedelta(time, unit="s"),
    }[kind]
    data = frame({**columns, **({"time": time} if kind == "column" else {})}, units, index)
    found = calibrate_traces("clutch", data, fit=["friction_scale"])
    assert found.params.friction_scale == pytest.approx(0.9, rel=1e-4)


def test_a_recording_is_an_mdf_in_memory():
    mdf = package("asammdf")
    time, columns = recorded()
    file = mdf.MDF(version="4.10")
    units = {"load": "N", "speed": "rad/s", "friction_torque": "Nm"}
    file.append([mdf.Signal(x, time, units[name], name) for name, x in columns.items()])
    found = calibrate_traces("clutch", {"Monday": file}, fit=["friction_scale"])
    assert found.params.friction_scale == pytest.approx(0.9, rel=1e-4)


def test_what_was_left_out_of_an_mdf_in_memory_is_said():
    mdf = package("asammdf")
    time, columns = recorded()
    file, late = mdf.MDF(version="4.10"), time[4:]
    for name, unit in {"load": "N", "speed": "rad/s", "friction_torque": "Nm"}.items():
        own, x = (late, columns[name][4:]) if name == "load" else (time, columns[name])
        file.append([mdf.Signal(x, own, unit, name)])
    found = calibrate_traces("clutch", {"Monday": file}, fit=["friction_scale"])
    (said,) = (note for note in found.notes if "Monday" in note)
    assert said == "Monday: read with 4 rows left out: load is recorded from 0.02 to 0.4 s."


def test_points_are_an_mdf_in_memory_too():
    mdf = package("asammdf")
    torque = run_sweep("clutch", points=SI, workers=1)["friction_torque"]
    file = mdf.MDF(version="4.10")
    columns = {**POINTS, "friction_torque": torque}
    file.append([mdf.Signal(np.array(x), np.arange(3.0), UNITS[n], n) for n, x in columns.items()])
    np.testing.assert_allclose(
        run_sweep("clutch", points=file, workers=1)["friction_torque"], torque, rtol=1e-12
    )
    found = calibrate("clutch", file, fit=["friction_scale"])
    assert found.params.friction_scale == pytest.approx(1.0, rel=1e-9)


def test_an_engagement_as_a_frame_is_a_recording(tmp_path):
    """Its time is the index; it has speed and the sliding speed that is the same."""
    pandas = package("pandas")
    package("pyarrow")
    time, columns = recorded()
    way = {name: columns[name] for name in ("load", "speed")}
    data = engage_clutch(ClutchParams(friction_scale=0.9), time=time, **way).to_pandas()
    assert data.index.name == "time" and data.attrs["units"]["time"] == "s"
    data.to_parquet(tmp_path / "rig.parquet")
    assert pandas.read_parquet(tmp_path / "rig.parquet").attrs == data.attrs
    for given in (data, tmp_path / "rig.parquet"):
        found = calibrate_traces("clutch", given, fit=["friction_scale"])
        assert found.params.friction_scale == pytest.approx(0.9, rel=1e-4)


def test_remarks_on_a_file_of_points_are_notes(tmp_path):
    file = tmp_path / "rig.csv"
    rows = "\n".join(f"{v};{0.12 - 0.0002 * v:.4f};3000,5" for v in range(5, 60, 4)).replace(
        ".", ","
    )
    file.write_text(f"speed;friction;load\n{rows}\n")
    found = calibrate(PACK, file, fit=["constant_friction"])
    assert f"{file}: read with decimal commas." in [r.text for r in found.remarks]


def test_pandas_finds_the_units_in_a_parquet_file_and_it_is_read_again(tmp_path):
    pandas = package("pandas")
    package("pyarrow")
    path = tmp_path / "table.parquet"
    table = run_sweep("clutch", points=SI, workers=1, out=path)
    read = pandas.read_parquet(path)
    assert read.attrs["units"]["friction_torque"] == "N.m" and read.attrs["units"]["load"] == "N"
    again = run_sweep("clutch", points=path, workers=1)
    np.testing.assert_array_equal(again["friction_torque"], table["friction_torque"])


def test_two_speeds_in_place_of_slip_are_refused_and_other_columns_are_told():
    two = {"n_in": [100.0, 200.0], "n_out": [0.0, 50.0], "load": [1.0, 2.0]}
    units = {"n_in": "rpm", "n_out": "rpm", "load": "kN"}
    with pytest.raises(ValueError, match=r"not known: n_in \(is it speed\?\); give columns"):
        run_sweep("clutch", points=frame(two, units), workers=1)
    own = {"load": [1.0, 2.0], "_n_in": [1.0, 2.0], "gear": [3.0, 4.0], "temperature": [9.0, 9.0]}
    given = frame(own, {"load": "kN", "temperature": "K"})
    assert len(run_sweep("clutch", points=given, workers=1)) == 2
    said = columns_given(given, {"load": "N", "oil_temperature": "K"}).remarks
    assert said == ["passed over, as no column that counts: gear, temperature"]
