"""Tables as other programs write them: read where they say one thing only, else refused by line."""

import numpy as np
import pytest

from tests.needed import package
from thrustwasher.errors import ParameterError
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
    named = table.renamed({"speed [rpm]": "N_SLIP", "load": "F_AX", "friction": "mue"})
    assert [(c.name, c.unit) for c in named.columns] == [
        ("speed", "rpm"),
        ("load", "kN"),
        ("friction", ""),
    ]
    with pytest.raises(ParameterError, match="did you mean N_SLIP"):
        table.renamed({"speed": "N_SLP"})


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
