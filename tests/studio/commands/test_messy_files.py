"""One measurement as spreadsheets, loggers and programs write it: read, or refused."""

import json
from itertools import pairwise

import numpy as np
import pytest

from tests.needed import package
from thrustwasher.cli import main

SPEEDS = [10, 50, 100, 200, 400, 800, 1200, 1600, 2000, 2500, 3000]  # rpm
FRICTION = [0.1292, 0.1264, 0.1235, 0.1191, 0.1142, 0.1109, 0.1102, 0.11, 0.11, 0.11, 0.11]
ROWS = [[v, 3000, mu] for v, mu in zip(SPEEDS, FRICTION, strict=True)]
HEAD = ["speed [rpm]", "load [N]", "friction"]
NAMES = ["speed", "load", "friction"]
PSI = 6894.757293168361  # Pa


def number(x, comma, group):
    """Return a number as a spreadsheet of a country writes it."""
    whole, _, rest = f"{x:.4f}".rstrip("0").rstrip(".").partition(".")
    if group and len(whole) > 3:
        whole = f"{whole[:-3]}{group}{whole[-3:]}"
    return whole + (("," if comma else ".") + rest if rest else "")


def text(head=HEAD, rows=ROWS, *, sep=";", comma=True, group="", units=None, code="utf-8"):
    """Return a file: cells between ``sep``, decimal commas, groups of thousands, a row of units."""
    lines = [head, *([units] if units else [])]
    lines += [
        [number(x, comma, group) if isinstance(x, int | float) else x for x in r] for r in rows
    ]
    return "\n".join(sep.join(line) for line in lines).encode(code)


def changed(row, column, value):
    rows = [list(r) for r in ROWS]
    rows[row][column] = value
    return rows


BOTH_WAYS = [[v if i % 2 else -v, f, mu if i % 2 else -mu] for i, (v, f, mu) in enumerate(ROWS)]
SAE = [[v, 3000 / 4.4482216152605, mu, 176.0] for v, _, mu in ROWS]
GERMAN = ["Drehzahl", "Anpresskraft", "Reibwert"]
CHANNELS = ("speed [rpm]=Drehzahl", "load [kN]=Anpresskraft", "friction=Reibwert")
# Name -> its bytes, options, what is said (parts of lines).
READ = {
    "plain": (text(sep=",", comma=False), (), ""),
    "DE: semicolons, decimal commas": (text(), (), "decimal commas"),
    "DE: points group thousands": (text(group="."), (), "decimal commas, groups of thousands"),
    "US: commas group thousands": (text(comma=False, group=","), (), "groups of thousands"),
    "FR: narrow spaces group thousands": (
        text(group="\u202f"),
        (),
        "decimal commas, groups of thousands",
    ),
    "IT: tabs": (text(sep="\t"), (), "decimal commas"),
    "ES: UTF-16": (text(sep="\t", code="utf-16"), (), "UTF-16, decimal commas"),
    "CH: apostrophes": (text(comma=False, group="'"), (), "groups of thousands"),
    "Windows' code page": (
        text([*HEAD, "_Prüfer"], [[*r, "Müller"] for r in ROWS], code="cp1252"),
        (),
        "Windows code page 1252, decimal commas",
    ),
    "a row of units": (
        text(NAMES, units=["1/min", "N", "-"]),
        (),
        "units from line 2, decimal commas",
    ),
    "German names and kN": (
        text(GERMAN, [[v, 3, mu] for v, _, mu in ROWS]),
        CHANNELS,
        "decimal commas",
    ),
    "channels of a logger": (
        text(
            ["time", "_note", "N_SLIP", "F_AX", "mue"], [[0.1, "ok", *r] for r in ROWS], comma=False
        ),
        ("speed [rpm]=N_SLIP", "load [N]=F_AX", "friction=mue"),
        "passed over, as no column that counts: time",
    ),
    "SAE: rpm, lbf, degF": (
        text(["speed [rpm]", "load [lbf]", "friction", "oil_temperature [degF]"], SAE, comma=False),
        (),
        "",
    ),
    "sign of a rig that turns both ways": (text(rows=BOTH_WAYS), (), "6 points turn backwards"),
    "commas before a point": (
        text(rows=[[v, "3,000.00", mu] for v, _, mu in ROWS], comma=False),
        (),
        "groups of thousands",
    ),
    "the head again": (
        text(rows=[*ROWS[:5], HEAD, *ROWS[5:]]),
        (),
        "2 tables of one head (lines 1, 7), decimal commas",
    ),
    "text above": (
        b"Rig 3;Mueller\nTested on;01.02.2024\n[Data]\n" + text(),
        (),
        "the head of line 4, 3 lines above passed over (Rig 3;Mueller), decimal commas",
    ),
    "a mark, remarks, empty lines": (
        b"\xef\xbb\xbf# rig 3\n\n" + text(comma=False).replace(b"\n", b"\r\n;;\r\n"),
        (),
        "",
    ),
}
REFUSED = {
    "commas that may be either": (b"speed;load;friction\n1,200;3;1\n", "line 2: speed = '1,200'"),
    "groups by comma and by point": (b"speed;load;friction\n1,200;3.000;1\n", "one decimal sign"),
    "two decimal signs": (text(rows=changed(3, 2, "0.1191")), "one decimal sign is required"),
    "commas between all": (text(sep=","), "separate the cells by semicolons"),
    "a name twice": (text(["speed", "load", "load"]), "has two columns load"),
    "another head": (
        text(rows=[*ROWS[:5], ["speed [rpm]", "load [N]", "torque [Nm]"], *ROWS[5:]]),
        "different heads, name those to read: --table 1 (line 1): speed [rpm], load [N], friction",
    ),
    "a missing value": (text(rows=changed(4, 2, "")), "line 6: friction is missing"),
    "a missing value in words": (text(rows=changed(4, 2, "n/a")), "line 6: friction is missing"),
    "a unit of something else": (text(["speed [rpm]", "load [bar]", "friction"]), "column load"),
    "a sign against the others": (text(rows=changed(7, 2, -0.11)), "point 8 is -0.11"),
    "no such channel": (
        text(GERMAN),
        '--column "speed=Drehzahl" --column "load=Anpresskraft" --column "friction=Reibwert"',
    ),
}


def calibrated(path, capsys, *options):
    """Return fitted constants, and what was said."""
    words = ["calibrate", str(path), "--json"]
    for channel in options:
        words += ["--column", channel]
    assert main(words) == 0
    out, err = capsys.readouterr()
    return json.loads(out)["fitted"], err


@pytest.fixture(scope="module")
def fitted(tmp_path_factory):
    """Constants of the plain file."""
    from thrustwasher import calibrate

    rpm = np.pi / 30.0
    columns = {n: [r[i] for r in ROWS] for i, n in enumerate(NAMES)}
    columns["speed"] = [v * rpm for v in SPEEDS]
    return {e.name: e.value for e in calibrate("clutch", columns).estimates}


@pytest.mark.parametrize("kind", READ)
def test_a_file_that_says_one_thing_gives_the_same_constants(kind, tmp_path, capsys, fitted):
    data, options, said = READ[kind]
    (tmp_path / "rig.csv").write_bytes(data)
    found, err = calibrated(tmp_path / "rig.csv", capsys, *options)
    assert found["decay_speed"] == pytest.approx(fitted["decay_speed"], rel=1e-4)
    assert said in err and bool(said) == bool(err)


@pytest.mark.parametrize("kind", REFUSED)
def test_a_file_that_may_say_two_things_is_refused_in_one_line(kind, tmp_path, capsys):
    data, words = REFUSED[kind]
    (tmp_path / "rig.csv").write_bytes(data)
    assert main(["calibrate", str(tmp_path / "rig.csv")]) == 2
    out, err = capsys.readouterr()
    *remarks, last = err.splitlines()
    assert words in last and out == "" and all("read with" in line for line in remarks)


def test_files_of_programs_are_read_as_well(tmp_path, capsys, fitted):
    book = package("openpyxl").Workbook()
    for row in (NAMES, ["rpm", "N", "-"], *ROWS):
        book.active.append(row)
    book.save(tmp_path / "rig.xlsx")
    vectors = {n: np.array([float(r[i]) for r in ROWS]) for i, n in enumerate(NAMES)}
    package("scipy.io").savemat(tmp_path / "rig.mat", {**vectors, "rig": "3"})
    for name, options, said in (
        ("rig.xlsx", (), "sheet 'Sheet', units from line 2"),
        ("rig.mat", ("speed [rpm]=speed",), ""),
    ):
        found, err = calibrated(tmp_path / name, capsys, *options)
        assert found["decay_speed"] == pytest.approx(fitted["decay_speed"], rel=1e-4)
        assert said in err


def test_a_trace_in_psi_and_ms_of_a_german_spreadsheet_is_read(tmp_path, capsys):
    """The same engagement in SI and as a logger wrote it."""
    from thrustwasher import ClutchParams, calibrate_traces, engage_clutch

    time = np.linspace(0.0, 0.5, 101)
    pressure, speed = 8e5 * np.clip(time / 0.1, 0.0, 1.0), 300.0 * (1.0 - time / 0.5)
    force = {"load": 6e-3 * pressure, "speed": speed}
    torque = engage_clutch(ClutchParams(friction_scale=0.9), time=time, **force).friction_torque
    head = ["Zeit", "P_K1", "N_SLIP", "M_K1"]
    columns = zip(1e3 * time, pressure / PSI, speed * 30.0 / np.pi, torque, strict=True)
    data = text(head, [list(map(float, row)) for row in columns], group=".")
    (tmp_path / "rig.csv").write_bytes(data)
    words = ["calibrate", "clutch", str(tmp_path / "rig.csv"), "--piston-area", "60 cm2", "--json"]
    for channel in ("time [ms]=Zeit", "pressure [psi]=P_K1", "speed [rpm]=N_SLIP",
                    "friction_torque [N.m]=M_K1"):  # fmt: skip
        words += ["--column", channel]
    assert main([*words, "--fit", "friction_scale"]) == 0
    found = json.loads(capsys.readouterr().out)["fitted"]["friction_scale"]
    exact = {"time": time, "pressure": pressure, "speed": speed, "friction_torque": torque}
    same = calibrate_traces("clutch", exact, fit=["friction_scale"], piston_area=6e-3)
    assert found == pytest.approx(0.9, rel=1e-4) == same.params.friction_scale
    assert all(a < b for a, b in pairwise(time))


def test_friction_over_sliding_speed_in_metres_per_second_gives_the_same_constants(
    tmp_path, capsys, fitted
):
    from thrustwasher import ClutchParams

    radius = ClutchParams().friction_radius
    rows = [[v * np.pi / 30.0 * radius * 1e3, f, mu] for v, f, mu in ROWS]
    lines = [",".join(map(repr, row)) for row in rows]
    (tmp_path / "rig.csv").write_text("\n".join(["sliding_speed [mm/s],load,friction", *lines]))
    found, _ = calibrated(tmp_path / "rig.csv", capsys)
    assert found["decay_speed"] == pytest.approx(fitted["decay_speed"], rel=1e-4)
    (tmp_path / "two.csv").write_text("sliding_speed,speed,load,friction\n1,2,3,0.1\n2,4,3,0.1\n")
    assert main(["calibrate", str(tmp_path / "two.csv")]) == 2
    assert "has speed and sliding_speed, allowed: one of both" in capsys.readouterr().err


def test_steps_of_a_rig_in_one_file_are_recordings_each(tmp_path, capsys):
    """Time goes on from step to step: by time alone they would be one recording."""
    from thrustwasher import ClutchParams, engage_clutch

    time = np.linspace(0.0, 0.5, 51)
    way = {"load": 5e3 * np.clip(time / 0.1, 0.0, 1.0), "speed": 150.0 * (1.0 - time / 0.5)}
    torque = engage_clutch(ClutchParams(friction_scale=0.9), time=time, **way).friction_torque
    lines = ["Rig 3;steps"]
    for step in range(2):
        lines += [f"Step {step + 1};started", "time [s];load [N];v [m/s];n_slip [rad/s];M [Nm]"]
        for t, *rest in zip(time + 0.51 * step, *way.values(), torque, strict=True):
            lines.append(";".join(map(repr, map(float, [t, rest[0], 1.0, *rest[1:]]))))
    (tmp_path / "rig.txt").write_text("\n".join(lines))
    words = ["calibrate", "clutch", str(tmp_path / "rig.txt"), "--fit", "friction_scale", "--json"]
    assert main(words) == 2
    copied = '--column "speed=n_slip" --column "friction_torque=M"'
    assert copied in capsys.readouterr().err
    named = [*words, "--column", "speed=n_slip", "--column", "friction_torque=M"]
    assert main(named) == 0
    out, err = capsys.readouterr()
    found = json.loads(out)
    assert found["recordings"] == 2 and "2 tables of one head (lines 3, 56)" in err
    assert found["fitted"]["friction_scale"] == pytest.approx(0.9, rel=1e-3)
    assert main([*named, "--table", "2"]) == 0
    assert json.loads(capsys.readouterr().out)["recordings"] == 1
