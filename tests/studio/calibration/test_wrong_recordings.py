"""Recordings that cannot be used: each is refused by name."""

import numpy as np
import pytest
from rigs import PACK, advances_by, history, recorded

from thrustwasher import ParameterError, SolveError, Status, calibrate, calibrate_traces
from thrustwasher.cli import main


def wrong(**changes):
    """Return a recording with columns changed, or left out where None."""
    data = {**recorded(), **changes}
    return {name: x for name, x in data.items() if x is not None}


def holed(name):
    column = np.array(recorded()[name])
    column[7] = np.nan
    return {name: column}


def out_of_order():
    time = history()["time"].copy()
    time[[40, 41]] = time[[41, 40]]
    return time


@pytest.mark.parametrize(
    ("data", "more", "words"),
    [
        (wrong(time=None), {}, "no column time"),
        (wrong(time=np.zeros(301)), {}, "time does not rise"),
        (wrong(time=out_of_order()), {}, "at row 42"),
        (wrong(load=None), {}, "load [N] or pressure [Pa]"),
        (wrong(pressure=1e5), {}, "load [N] or pressure [Pa]"),
        (wrong(load=None, pressure=1e5), {}, "needs piston_area"),
        (wrong(load=-recorded()["load"]), {}, "never above 0 N"),
        (wrong(load=recorded()["load"] - 600.0), {}, "load of row 1 is"),
        (wrong(speed=None), {}, "no column speed"),
        (wrong(speed=1e9), {}, "speed of row 1"),
        (wrong(friction_torque=None), {}, "nothing is measured"),
        (wrong(torque=3.0), {}, "column torque is not known"),
        (wrong(oil_temperature=80.0), {}, "oil_temperature of row 1 is 80 K"),
        (wrong(**holed("load")), {}, "load of row 8 is missing"),
        (wrong(**holed("speed")), {}, "speed of row 8 is missing"),
        (wrong(speed=[1.0, 2.0]), {}, "shape"),
        (wrong(speed="fast"), {}, "no number"),
        (recorded(), {"fit": ["piston_area"]}, "friction_scale in its place"),
        (recorded(), {"fit": ["kiss_pressure"]}, "allowed: with piston_area"),
        (recorded(), {"fit": ["drag_torque"]}, "allowed: with inertia"),
        (recorded(), {"fit": ["inertia"]}, "inertia"),
        (recorded(), {"fit": ["faces"]}, "real parameters"),
        (recorded(), {"fit": ["friktion_scale"]}, "did you mean friction_scale"),
        (recorded(), {"torque_at": "hub"}, "inertia_between = 0"),
        (recorded(), {"torque_at": "wheel"}, "pack or hub"),
        (recorded(), {"inertia_between": 0.1}, "inertia_between = 0.1"),
        (recorded(), {"inertia": -1.0}, "inertia = -1"),
        (recorded(), {"inertia": "1 kg"}, "inertia"),
        (recorded(), {"errors": {"temperature": 1.0}}, "allowed: of friction_torque"),
        (recorded(), {"errors": {"friction_torque": 0.0}}, "above 0"),
        (recorded(), {"errors": {"friction_torque": "2 K"}}, "error of friction_torque"),
        (recorded(), {"bounds": {"roughness": (1e-6, 1e-5)}}, "bounds of roughness"),
        (recorded(), {"at": {"load": 3.0}}, "as a column"),
        (recorded(), {"at": {"speed": 3.0}}, "allowed: one of both"),
        (recorded(), {"confidence": 1.0}, "confidence"),
        ([], {}, "recordings: none"),
        (3.0, {}, "recordings: float"),
        ([3.0], {}, "columns by their names"),
        ({n: x[:3] for n, x in history().items()}, {}, "3 rows"),
        (recorded(), {"part": "washer"}, "part: washer, allowed: a part or parameters of clutch"),
        (
            wrong(speed=None),
            {"fit": ["drag_torque"], "inertia": 0.25, "at": {"speed": 300.0}},
            "with a column speed",
        ),
    ],
)
def test_a_recording_that_cannot_be_used_is_refused_by_name(data, more, words):
    with pytest.raises(ParameterError) as problem:
        calibrate_traces(**{"part": PACK, "recordings": data, "fit": ["friction_scale"], **more})
    assert words in str(problem.value)


def test_settled_points_are_not_taken_for_a_recording():
    with pytest.raises(ParameterError, match="calibrate_traces"):
        calibrate(PACK, recorded(), fit=["friction_scale"])


def test_a_recording_that_a_pack_cannot_be_stepped_along_is_named(monkeypatch):
    data = {"rig 3.csv": recorded()}
    advances_by(monkeypatch, lambda _: lambda *_: int(Status.NOT_FINITE))
    with pytest.raises(SolveError, match=r"rig 3\.csv: the part cannot be stepped along it"):
        calibrate_traces(PACK, data, fit=["friction_scale"])


@pytest.mark.parametrize("head", ["Zeit abs. [s];p [bar];n1 [rpm];M [Nm]", "X_Value;load;speed;M"])
@pytest.mark.parametrize("rig", [(), ("--piston-area", "60 cm2")])
def test_time_by_another_name_is_asked_for_with_all_other_columns(head, rig, tmp_path, capsys):
    rows = "".join(f"{t};1;9;5\n" for t in (0, 1, 2, 3, 4, 5))
    (tmp_path / "rig.csv").write_text(f"{head}\n{rows}", "utf-8")
    assert main(["calibrate", "clutch", str(tmp_path / "rig.csv"), *rig]) == 2
    said, time = capsys.readouterr().err, head.split(";")[0].removesuffix(" [s]")
    assert f'--column "time={time}"' in said and '"friction_torque=M"' in said
    assert f'if it is none: --column "_{time}={time}"' in said


def test_channels_of_an_oscilloscope_are_asked_for_by_name(tmp_path, capsys):
    rows = "".join(f"{t},1,2\n" for t in range(6))
    (tmp_path / "scope.csv").write_text(f"Time,CH1,CH2\ns,Volt,Volt\n{rows}", "utf-8")
    assert main(["calibrate", "clutch", str(tmp_path / "scope.csv")]) == 2
    said = capsys.readouterr().err
    assert "column load or pressure is missing; found, but not known: CH1, CH2; say what" in said
    assert '--column "load [N]=CH1"' in said
