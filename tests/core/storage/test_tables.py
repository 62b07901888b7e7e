"""Tables as other programs write them: read where they say one thing only, else refused by line."""

import numpy as np
import pytest

from tests.needed import package
from thrustwasher.errors import ParameterError
from thrustwasher.storage.tables.column_names import renamed
from thrustwasher.storage.tables.table import MANY, numbers
from thrustwasher.storage.tables.table_file import read_table

UNITS = {"speed": "rad/s", "load": "N", "friction": "1"}
RPM = np.pi / 30.0
PLAIN = "speed [rpm],load [N],friction\n10,3000,0.1292\n2000,3000,0.11\n"
READ = {
    "points": (PLAIN.encode(), ""),
    "a mark before UTF-8": (PLAIN.encode("utf-8-sig"), ""),
    "carriage returns alone": (PLAIN.replace("\n", "\r").encode(), ""),
    "decimal commas": (
        b"speed [rpm];load [N];friction\n10;3000;0,1292\n2000;3000;0,11\n",
        "decimal commas",
    ),
    "commas and groups": (
        "speed [rpm]\tload [N]\tfriction\n10\t3.000,0\t0,1292\n2\u202f000,0\t3000\t0,11\n".encode(),
        "decimal commas, groups of thousands",
    ),
    "quoted commas": (
        b'speed [rpm],load [N],friction\n10,3000,"0,1292"\n2000,3000,"0,11"\n',
        "decimal commas",
    ),
    "units below": (
        b"speed;load;friction\n1/min;kN;-\n10;3;0.1292\n2000;3;0.11\n",
        "units from line 2",
    ),
    "units in round brackets": (PLAIN.replace("[", "(").replace("]", ")").encode(), ""),
    "UTF-16": (PLAIN.encode("utf-16"), "UTF-16"),
    "Windows text": (
        b"speed [rpm],load [N],friction,_Pr\xfcfer\n10,3000,0.1292,x\n2000,3000,0.11,y\n",
        "Windows code page 1252",
    ),
    "a line for Excel": (
        b"sep=;\nspeed [rpm];load [N];friction\n10;3000;0.1292\n2000;3000;0.11\n",
        "",
    ),
    "remarks and empty lines": (b"# rig 3\n\n" + PLAIN.replace("\n", "\n;;\n#\n").encode(), ""),
}
REFUSED = {
    "thousands or decimals": (b"speed;load\n1,500;3\n", "line 2: speed = '1,500' may have"),
    "two decimal signs": (b"speed;load\n0,5;1.5\n", "line 2 has speed = '0,5' and line 2 load"),
    "shifted": (b"speed,load\n0,5,3\n", "line 2: has 3 cells, the head names 2; if these are"),
    "bytes": (b"PK\x03\x04\0\0", "line 1: is not text"),
    "nothing": (b"# only a remark\n", "is empty"),
    "a head alone": (b"speed,load\nrpm,N\n", "no line of numbers"),
}


def columns(path):
    """Return the columns in SI units."""
    table = read_table(path)
    return {c.name: numbers(c, table, UNITS[c.name]) for c in table.columns if c.name in UNITS}


@pytest.mark.parametrize("kind", READ)
def test_a_table_that_says_one_thing_is_read_and_what_is_unusual_is_said(kind, tmp_path):
    data, remark = READ[kind]
    (tmp_path / "rig.csv").write_bytes(data)
    found = columns(tmp_path / "rig.csv")
    np.testing.assert_allclose(found["speed"], [10.0 * RPM, 2000.0 * RPM], rtol=1e-15)
    assert found["load"] == [3000.0, 3000.0] and found["friction"] == [0.1292, 0.11]
    assert ", ".join(read_table(tmp_path / "rig.csv").remarks) == remark


@pytest.mark.parametrize("kind", REFUSED)
def test_a_table_that_may_say_two_things_is_refused_by_line(kind, tmp_path):
    data, words = REFUSED[kind]
    (tmp_path / "rig.csv").write_bytes(data)
    with pytest.raises(ParameterError) as problem:
        read_table(tmp_path / "rig.csv")
    assert words in str(problem.value) and "rig.csv" in str(problem.value)


def test_long_columns_are_the_same_numbers_as_short_ones(tmp_path):
    given = [f"{x:.3f}" for x in np.random.default_rng(1).uniform(-50.0, 3e3, MANY + 1)]
    for unit, si in (("rpm", "rad/s"), ("degC", "K"), ("degF", "K")):
        (tmp_path / "rig.csv").write_text("\n".join([f"x [{unit}]", *given]))
        table = read_table(tmp_path / "rig.csv")
        whole = numbers(table.columns[0], table, si)
        table.columns[0].cells[MANY:], table.lines[MANY:] = [], []
        np.testing.assert_allclose(whole[:MANY], numbers(table.columns[0], table, si), rtol=3e-16)


def test_columns_are_renamed_by_the_channel_that_holds_them(tmp_path):
    (tmp_path / "rig.csv").write_text("N_SLIP,F_AX [kN],mue\n3000,3,0.11\n")
    table = read_table(tmp_path / "rig.csv")
    named = renamed(table, {"speed [rpm]": "N_SLIP", "load": "F_AX", "friction": "mue"})
    assert [(c.name, c.unit) for c in named.columns] == [
        ("speed", "rpm"),
        ("load", "kN"),
        ("friction", ""),
    ]
    with pytest.raises(ParameterError, match="did you mean N_SLIP"):
        renamed(table, {"speed": "N_SLP"})


def test_spreadsheets_are_read(tmp_path):
    book = package("openpyxl").Workbook()
    for row in (
        ["speed", "load", "friction"],
        ["rpm", "N", None],
        [10, 3000, 0.1292],
        [2e3, 3e3, 0.11],
    ):
        book.active.append(row)
    book.save(tmp_path / "rig.xlsx")
    found = columns(tmp_path / "rig.xlsx")
    assert found["friction"] == [0.1292, 0.11] and found["speed"][0] == pytest.approx(10.0 * RPM)


def test_matlab_files_are_read(tmp_path):
    io = package("scipy.io")
    vectors = {"speed": np.array([1.0, 200.0]), "friction": [0.1292, 0.11], "load": [3e3, 3e3]}
    io.savemat(tmp_path / "rig.mat", {**vectors, "title": "rig 3", "gain": 2.0})
    assert columns(tmp_path / "rig.mat") == {
        "speed": [1.0, 200.0],
        "load": [3e3, 3e3],
        "friction": [0.1292, 0.11],
    }


@pytest.mark.parametrize("name", ["rig.xlsx", "rig.mat"])
def test_a_damaged_file_is_one_line(name, tmp_path):
    package("openpyxl")
    (tmp_path / name).write_bytes(b"no such thing")
    with pytest.raises(ParameterError, match="cannot be read as a"):
        read_table(tmp_path / name)


# Measuring files: what is not measured at an instant is left out there, and counted.

COUNT = ("time", "load", "speed", "friction_torque")
FAST = np.linspace(0.0, 1.0, 101)
SLOW = np.linspace(0.0, 1.0, 11)


def written(path, *groups):
    """Write groups of (name, times, channels by name), with marks or another master."""
    mdf = package("asammdf")
    with mdf.MDF() as file:
        for group, times, channels, *more in groups:
            about = more[0] if more else {}
            signals = [
                mdf.Signal(
                    np.asarray(x),
                    times,
                    name=name,
                    unit="",
                    invalidation_bits=about.get(name),
                    master_metadata=about.get("master"),
                    encoding="utf-8" if np.asarray(x).dtype.kind == "S" else None,
                )
                for name, x in channels.items()
            ]
            file.append(signals, acq_name=group)
        file.save(path)
    return read_table(path)


def cells(table, may_lack=("friction_torque",)):
    """Return the numbers of the columns that count, and the remarks."""
    found = table.of_columns(COUNT, may_lack)
    columns = {c.name: [float(x or "nan") for x in c.cells] for c in found.columns if c.cells}
    return {name: np.array(x) for name, x in columns.items()}, found.remarks


def test_samples_marked_invalid_or_no_number_are_left_out_and_counted(tmp_path):
    marked, torque = np.arange(101) % 5 == 0, 10.0 * FAST
    torque[7] = np.nan
    channels = {"load": 1e3 + FAST, "friction_torque": np.where(marked, 1e9, torque)}
    load_marks = np.arange(101) >= 98
    marks = {"friction_torque": marked, "load": load_marks}
    found, said = cells(written(tmp_path / "rig.mf4", ("fast", FAST, channels, marks)))
    np.testing.assert_array_equal(found["time"], FAST[:98])
    is_known = np.isfinite(found["friction_torque"])
    assert not is_known[marked[:98]].any() and is_known.sum() == 98 - 20 - 1
    assert np.nanmax(found["friction_torque"]) < 10.0
    assert "22 of 101 samples of friction_torque left out: invalid" in said
    assert "3 of 101 samples of load left out: invalid" in said


def test_rows_are_those_that_all_inputs_cover_and_outputs_are_empty_beyond_their_times(tmp_path):
    late, early = SLOW >= 0.2, FAST <= 0.9
    table = written(
        tmp_path / "rig.mf4",
        ("fast", FAST, {"load": 1e3 * FAST}),
        ("slow", SLOW[late], {"speed": SLOW[late] ** 2}),
        ("torque", FAST[early], {"friction_torque": FAST[early]}),
    )
    found, said = cells(table)
    np.testing.assert_array_equal(found["time"], FAST[20:])
    np.testing.assert_allclose(found["speed"], np.interp(FAST[20:], SLOW, SLOW**2), rtol=1e-12)
    assert np.isfinite(found["friction_torque"]).sum() == 71  # 0.2 .. 0.9 s
    assert said == ["20 rows left out: speed is recorded from 0.2 to 1 s"]


def test_integer_channels_lie_on_the_same_straight_lines_as_floats(tmp_path):
    counts = np.array([0, 7, 3, 3, 250, 9, 0, 1, 2, 3, 4])
    found = {}
    for kind in ("u1", "i8", "f8"):
        groups = ("fast", FAST, {"load": FAST}), ("slow", SLOW, {"speed": counts.astype(kind)})
        found[kind] = cells(written(tmp_path / f"{kind}.mf4", *groups))[0]["speed"]
    np.testing.assert_allclose(found["f8"], np.interp(FAST, SLOW, counts), rtol=1e-12)
    np.testing.assert_array_equal(found["u1"], found["f8"])
    np.testing.assert_array_equal(found["i8"], found["f8"])


def test_an_instant_next_to_an_invalid_sample_of_another_group_is_not_known(tmp_path):
    groups = (
        ("fast", FAST, {"load": FAST, "speed": FAST}),
        ("slow", SLOW, {"friction_torque": SLOW}, {"friction_torque": SLOW == SLOW[5]}),
    )
    found, _ = cells(written(tmp_path / "rig.mf4", *groups))
    lost = np.isnan(found["friction_torque"])
    np.testing.assert_array_equal(lost, (FAST > SLOW[4]) & (FAST < SLOW[6]))


@pytest.mark.parametrize(("kind", "number"), [("angle", 2), ("distance", 3), ("index", 4)])
def test_a_group_that_is_over_no_time_is_refused_by_its_kind(kind, number, tmp_path):
    table = written(
        tmp_path / "rig.mf4",
        ("fast", FAST, {"load": FAST, "speed": FAST}),
        ("shaft", FAST, {"friction_torque": FAST}, {"master": (kind, number)}),
    )
    with pytest.raises(ParameterError, match=f"friction_torque of the group 'shaft' .*over {kind}"):
        cells(table)
    assert len(table.of_columns(("time", "load"))) == 101


def test_a_name_in_two_groups_is_refused_by_the_groups_or_chosen_by_one(tmp_path):
    table = written(
        tmp_path / "rig.mf4",
        ("fast", FAST, {"load": FAST, "speed": np.full(101, 150.0)}),
        ("slow", SLOW, {"speed": np.full(11, 75.0)}),
        ("other", SLOW, {"note": SLOW}),
    )
    with pytest.raises(ParameterError, match="speed is in the groups 'fast', 'slow'; name one"):
        cells(table)
    with pytest.raises(ParameterError, match="speed is in the groups 'fast', 'slow'"):
        renamed(table, {"speed": "speed"})
    for group, value in (("fast", 150.0), ("slow", 75.0)):
        found, _ = cells(renamed(table, {"speed": f"{group}:speed"}))
        assert set(found["speed"]) == {value}
    assert len(table.of_columns(("time", "load", "note"))) == 101


def test_groups_without_names_are_named_by_their_numbers(tmp_path):
    groups = ("", FAST, {"load": FAST, "speed": FAST}), ("", SLOW, {"speed": SLOW + 1.0})
    table = written(tmp_path / "rig.mf4", *groups)
    with pytest.raises(ParameterError, match="groups '0', '1'"):
        cells(table)
    assert cells(renamed(table, {"speed": "1:speed"}))[0]["speed"][0] == 1.0


def test_channels_without_a_common_time_or_a_number_are_refused_by_name(tmp_path):
    table = written(
        tmp_path / "a.mf4", ("", FAST, {"load": FAST}), ("", SLOW + 2.0, {"speed": SLOW})
    )
    with pytest.raises(ParameterError, match=r"load 0 \.\. 1 s, speed 2 \.\. 3 s"):
        cells(table)
    words = {"load": FAST, "speed": np.full(101, b"fast")}
    with pytest.raises(ParameterError, match="speed of the group '0' holds no numbers"):
        cells(written(tmp_path / "b.mf4", ("", FAST, words)))


def test_equal_names_in_a_text_file_are_refused_where_one_is_named(tmp_path):
    (tmp_path / "rig.csv").write_text("N,N,load\n1,2,3\n")
    with pytest.raises(ParameterError, match="has two columns n"):
        renamed(read_table(tmp_path / "rig.csv"), {"speed": "N"})
