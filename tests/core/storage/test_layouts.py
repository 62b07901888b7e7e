"""Files as loggers lay them out: where the tables stand in them, and what is said of it."""

import numpy as np
import pytest

from tests.needed import package
from thrustwasher.errors import ParameterError
from thrustwasher.storage.tables.column_names import renamed
from thrustwasher.storage.tables.heads import Wanted
from thrustwasher.storage.tables.table import numbers as known_numbers
from thrustwasher.storage.tables.table_file import read_table

TRIBOMETER = """PCX 7 Test File
Lubricant name:\tB
Comments:

Number of steps in profile:\t2
Step 1 started at 03/04/2025 08:00:00
Step type\tTRACTION\tStep description\tup
Zero force (N)\t-0.31\t(measured)
Rolling Speed (mm/s)\tCoeff (-)\tLoad (N)\tCoeff (-)
900\t0.05\t21.0\t0.05
400\t0.06\t21.5\t0.06
Step 2 started at 03/04/2025 08:10:00
Step type\tTRACTION\tStep description\tdown
Zero force (N)\t-0.30\t(measured)
Rolling Speed (mm/s)\tCoeff (-)\tLoad (N)\tCoeff (-)
300\t0.07\t22.0\t0.07
Test ended at 03/04/2025 08:20:00
"""
LABVIEW = """LabVIEW Measurement\t
Separator\tTab
***End_of_Header***\t
\t
Channels\t2\t\t
Samples\t3\t3
Date\t2025/03/04\t2025/03/04
X0\t0.0\t0.0
Delta_X\t0.1\t0.1
***End_of_Header***\t\t
X_Value\tload\ttorque\tComment
0.0\t10\t1.0
0.1\t20\t2.0\tclutch closes
0.2\t30\t3.0
"""
SECTIONS = """[Setup]
Operator;Meier
Oil;80
[Data]
time;load;torque
s;kN;Nm
CH1;CH2;CH3
0,0;1.234,5;7
0,1;1.300,0;8
"""


def table_of(tmp_path, text, name="rig.csv", **wanted):
    (tmp_path / name).write_text(text, encoding="utf-8")
    return read_table(tmp_path / name, Wanted(**wanted))


def numbers(table):
    return {c.name: [float(x) for x in c.cells] for c in table.columns if c.name != "Comment"}


def test_a_head_under_a_block_of_text_is_found_and_what_is_above_is_said(tmp_path):
    table = table_of(tmp_path, LABVIEW, "rig.lvm")
    assert numbers(table) == {"X_Value": [0.0, 0.1, 0.2], "load": [10, 20, 30], "torque": [1, 2, 3]}
    assert table.columns[-1].cells == ["", "clutch closes", ""]
    assert table.lines == [12, 13, 14]
    (said,) = table.remarks
    assert said.startswith("the head of line 11, 9 lines above passed over (LabVIEW Measurement")


def test_tables_of_one_head_are_all_read_and_each_is_one_by_itself(tmp_path):
    table = table_of(tmp_path, TRIBOMETER)
    assert numbers(table)["Rolling Speed"] == [900, 400, 300]
    assert [numbers(t)["Load"] for t in table.each()] == [[21.0, 21.5], [22.0]]
    assert table.each()[1].name == "table 2 (from line 16)"
    assert "2 tables of one head (lines 9, 15)" in table.remarks
    assert any(line.startswith("text from line 17 on passed over") for line in table.remarks)


def test_equal_columns_count_once_and_different_ones_of_a_name_stay(tmp_path):
    assert [c.name for c in table_of(tmp_path, TRIBOMETER).columns].count("Coeff") == 1
    other = table_of(tmp_path, TRIBOMETER.replace("0.07\t22.0\t0.07", "0.07\t22.0\t0.09"))
    assert [c.name for c in other.columns].count("Coeff") == 2


def test_rows_of_units_and_identifiers_may_stand_under_a_head(tmp_path):
    table = table_of(tmp_path, SECTIONS)
    assert [(c.name, c.unit) for c in table.columns] == [
        ("time", "s"),
        ("load", "kN"),
        ("torque", "Nm"),
    ]
    assert numbers(table)["load"] == [1234.5, 1300.0]
    assert "units from line 6" in table.remarks


@pytest.mark.parametrize("units", ["s,Volt,Volt", "s,V,V", "s,V,mV", "(s),(V),(V)", "s,kg,kg"])
def test_units_under_a_head_may_be_equal_and_need_not_be_known(tmp_path, units):
    table = table_of(tmp_path, f"DSO-X 3024\nTime,CH1,CH2\n{units}\n0,1,2\n1e-3,3,4\n")
    assert [c.name for c in table.columns] == ["Time", "CH1", "CH2"]
    assert [c.unit for c in table.columns] == [unit.strip("()") for unit in units.split(",")]
    assert numbers(table) == {"Time": [0.0, 1e-3], "CH1": [1, 3], "CH2": [2, 4]}
    found = known_numbers(renamed(table, {"friction_torque [N.m]": "CH2"}).columns[2], table, "N.m")
    assert found == [2.0, 4.0]


def test_channels_that_are_numbers_are_told_apart_by_these(tmp_path):
    table = table_of(tmp_path, "x-axis,1,2\nsecond,Volt,Volt\n0,1,2\n1e-3,3,4\n")
    assert [c.name for c in table.columns] == ["x-axis", "1", "2"]
    assert known_numbers(table.columns[0], table, "s") == [0.0, 1e-3]


def test_a_head_with_two_equal_names_is_one_below_a_line_of_text(tmp_path):
    table = table_of(
        tmp_path, "Step,up,fast,dry\nSpeed (mm/s),Coeff (-),Load (N),Coeff (-)\n1,2,3,4\n"
    )
    assert [c.name for c in table.columns] == ["Speed", "Coeff", "Load", "Coeff"]


def test_tables_of_different_heads_are_named_and_one_is_chosen(tmp_path):
    text = "a;b\n1;2\n3;4\n\nc;d\n5;6\n7;8\n\na;b\n9;9\n8;8\n"
    with pytest.raises(ParameterError) as problem:
        table_of(tmp_path, text)
    assert "--table 1,3 (line 1, 9): a, b, 4 rows" in str(problem.value)
    assert "--table 2 (line 5): c, d, 2 rows" in str(problem.value)
    assert numbers(table_of(tmp_path, text, table=(2,))) == {"c": [5, 7], "d": [6, 8]}
    assert numbers(table_of(tmp_path, text, table=(1, 3)))["a"] == [1, 3, 9, 8]
    with pytest.raises(ParameterError, match=r"--table 4: allowed: 1 \.\. 3"):
        table_of(tmp_path, text, table=(4,))


def test_skip_overrules_what_is_found(tmp_path):
    text = "speed;load\n10;20\n30;40\nn;F\n1;2\n3;4\n"
    assert numbers(table_of(tmp_path, text, skip=3)) == {"n": [1, 3], "F": [2, 4]}


def test_a_quoted_head_may_have_line_ends(tmp_path):
    text = '"Speed\n[rpm]","Load\n(N)"\n10,"1,500.5"\n20,3\n'
    table = table_of(tmp_path, text)
    assert [(c.name, c.unit) for c in table.columns] == [("Speed", "rpm"), ("Load", "N")]
    assert numbers(table)["Load"] == [1500.5, 3.0] and table.lines == [4, 5]


def test_a_footer_is_passed_over_and_a_gap_in_the_middle_is_not(tmp_path):
    text = "speed,load\n1,2\n3,4\nMean,3\nsigned by Meier\n"
    table = table_of(tmp_path, text)
    assert numbers(table) == {"speed": [1, 3], "load": [2, 4]}
    assert table.remarks == ["text from line 4 on passed over (Mean,3)"]
    table = table_of(tmp_path, "speed,load\n1,2\nn/a,n/a\n3,4\n")
    assert table.columns[0].cells == ["1", "n/a", "3"]


def book(path, sheets):
    workbook = package("openpyxl").Workbook()
    workbook.remove(workbook.active)
    for name, rows in sheets.items():
        sheet = workbook.create_sheet(name)
        for row in rows:
            sheet.append(row)
    workbook.save(path)
    return path


DATA = [["Test 5"], ["speed [rpm]", "load"], [10, 2.5], [20, 3.5]]


def test_the_sheet_with_a_table_is_read_under_its_title(tmp_path):
    path = book(tmp_path / "rig.xlsx", {"About": [["Rig 3"], ["Operator", "Meier"]], "Runs": DATA})
    table = read_table(path)
    assert numbers(table) == {"speed": [10, 20], "load": [2.5, 3.5]}
    assert table.remarks == [
        "sheet 'Runs'",
        "the head of line 2, 1 line above passed over (Test 5)",
    ]


def test_several_sheets_with_tables_are_named_and_one_is_chosen(tmp_path):
    path = book(tmp_path / "rig.xlsx", {"A": DATA, "B": [["x", "y"], [1, 2], [3, 4]]})
    with pytest.raises(ParameterError, match=r"name one by --sheet: 'A' \(speed .*'B' \(x, y\)"):
        read_table(path)
    assert numbers(read_table(path, Wanted(sheet="B"))) == {"x": [1, 3], "y": [2, 4]}
    with pytest.raises(ParameterError, match="no such sheet; found: A, B"):
        read_table(path, Wanted(sheet="C"))


def test_a_struct_of_a_matlab_file_is_read_or_chosen(tmp_path):
    save = package("scipy.io").savemat
    run = {"time": np.arange(4.0), "load": np.ones(4), "note": "x"}
    save(tmp_path / "one.mat", {"data": run, "version": 3.0})
    table = read_table(tmp_path / "one.mat")
    assert numbers(table)["time"] == [0, 1, 2, 3] and table.remarks == ["struct data"]
    assert {c.group for c in table.columns} == {"data"}
    save(tmp_path / "two.mat", {"runs": {"a": run, "b": run}})
    with pytest.raises(ParameterError, match=r"by --sheet: runs\.a \(time, load\), runs\.b"):
        read_table(tmp_path / "two.mat")
    assert len(read_table(tmp_path / "two.mat", Wanted(sheet="runs.b"))) == 4


@pytest.mark.parametrize("where", ["field", "attrs"])
def test_parquet_is_read_with_its_units(where, tmp_path):
    pyarrow, parquet = package("pyarrow"), package("pyarrow.parquet")
    unit = {"unit": "rpm"} if where == "field" else None
    schema = pyarrow.schema(
        [pyarrow.field("speed", pyarrow.float64(), metadata=unit), ("name", pyarrow.string())]
    )
    if where == "attrs":
        schema = schema.with_metadata({"PANDAS_ATTRS": '{"units": {"speed": "rpm"}}'})
    columns = {"speed": [10.0, None], "name": ["a", "b"]}
    parquet.write_table(pyarrow.table(columns, schema), tmp_path / "rig.parquet")
    table = read_table(tmp_path / "rig.parquet")
    assert table.columns[0].unit == "rpm" and table.columns[0].cells == ["10.0", ""]


@pytest.mark.parametrize(
    ("name", "data", "what"),
    [
        ("a.ods", b"PK\3\4", "an OpenDocument spreadsheet"),
        ("a.tdms", b"TDSm\0\0", "a TDMS file"),
        ("a.blf", b"LOGG\0", "a log of bus messages"),
        ("a.uff", b"    -1\n   151\n", "a Universal File"),
        ("a.asc", b"date Mon Mar 3 10:00:00 2025\nbase hex\n", "a log of bus messages"),
        ("without", b"TDSm\0\0", "a TDMS file"),
    ],
)
def test_a_kind_that_is_not_read_is_refused_with_those_that_are(name, data, what, tmp_path):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(ParameterError) as problem:
        read_table(tmp_path / name)
    assert what in str(problem.value) and ".xlsx" in str(problem.value)


def test_a_table_in_text_is_read_by_the_name_of_a_log(tmp_path):
    assert numbers(table_of(tmp_path, "a;b\n1;2\n", "rig.asc")) == {"a": [1.0], "b": [2.0]}


def test_times_of_day_are_seconds_and_nan_is_not_measured(tmp_path):
    text = "Time,load,speed [rpm]\n10:00:01.250,1,NaN\n10:00:01.500,2,30\n"
    table = table_of(tmp_path, text)
    assert known_numbers(table.columns[0], table, "s") == [36001.25, 36001.5]
    assert known_numbers(table.columns[2], table, "rad/s") == [None, pytest.approx(np.pi)]
