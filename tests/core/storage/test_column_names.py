"""Columns by the names that count: renamed, summed, guessed, asked for."""

import numpy as np
import pytest

from tests.needed import package
from thrustwasher.errors import ParameterError
from thrustwasher.storage.tables.column_names import renamed
from thrustwasher.storage.tables.known_columns import known_columns
from thrustwasher.storage.tables.table import numbers
from thrustwasher.storage.tables.table_file import read_table

UNITS = {"speed": "rad/s", "load": "N", "friction_torque": "N.m", "oil_temperature": "K"}
RPM = np.pi / 30.0


def rig(tmp_path, head="n_in [rpm];n_out [rad/s];a-b;T [Nm]", row="300;10;7;5"):
    (tmp_path / "rig.csv").write_text(f"{head}\n{row}\n", encoding="utf-8")
    return read_table(tmp_path / "rig.csv")


def value(table, name, unit):
    (column,) = (c for c in table.columns if c.name == name)
    return numbers(column, table, unit)[0]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("n_in", 300 * RPM),
        ("n_in [rpm]", 300 * RPM),
        ("n_in - n_out", 300 * RPM - 10),
        ("n_in-n_out", 300 * RPM - 10),
        ('"n_in" + "n_out"', 300 * RPM + 10),
        ("n_in - n_out - n_out", 300 * RPM - 20),
    ],
)
def test_a_speed_is_a_column_or_a_sum_of_some(text, expected, tmp_path):
    table = renamed(rig(tmp_path), {"speed": text})
    assert value(table, "speed", "rad/s") == pytest.approx(expected, rel=1e-12)


def test_a_name_with_a_minus_is_read_as_a_name_first(tmp_path):
    assert value(renamed(rig(tmp_path), {"load": "a-b"}), "load", "N") == 7.0


def test_what_was_understood_is_said(tmp_path):
    head = "n_in [rpm];n_out [rpm]"
    table = renamed(rig(tmp_path, head, "300;100"), {"speed": "n_in-n_out"})
    assert table.remarks == ["speed = n_in - n_out [rpm]"]
    assert value(table, "speed", "rad/s") == pytest.approx(200 * RPM)


def test_a_column_of_a_sum_may_have_a_name_of_its_own(tmp_path):
    table = renamed(rig(tmp_path), {"speed": "n_in - n_out", "drum_speed": "n_out"})
    assert value(table, "drum_speed", "rad/s") == 10.0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("n_in - T", "units of all columns that agree are required, found: n_in in rpm, T in Nm"),
        ("n_in - n_ot", "there is no column 'n_ot'; did you mean n_out?"),
        ("n_inn", "there is no column 'n_inn'; did you mean n_in?"),
    ],
)
def test_a_sum_that_is_none_is_refused_by_name(text, words, tmp_path):
    with pytest.raises(ParameterError) as problem:
        renamed(rig(tmp_path), {"speed": text})
    assert words in str(problem.value)


def test_a_sum_of_temperatures_is_refused(tmp_path):
    table = rig(tmp_path, "T1 [degC];T2 [degC]", "80;20")
    with pytest.raises(ParameterError, match="a sum of temperatures is none"):
        renamed(table, {"oil_temperature": "T1 - T2"})


def test_channels_of_two_groups_are_summed_at_the_times_of_the_larger_one(tmp_path):
    mdf = package("asammdf")
    fast, slow = np.linspace(0.0, 1.0, 11), np.linspace(0.0, 1.0, 3)
    with mdf.MDF() as file:
        file.append([mdf.Signal(100.0 + fast, fast, name="n_in", unit="rad/s")], acq_name="a")
        file.append([mdf.Signal(600.0 * slow, slow, name="n_out", unit="rpm")], acq_name="b")
        file.save(tmp_path / "rig.mf4")
    table = renamed(read_table(tmp_path / "rig.mf4"), {"speed": "n_in - b:n_out"})
    table = table.of_columns(("time", "speed"))
    found = next(c for c in table.columns if c.name == "speed")
    expected = 100.0 + fast - 600.0 * RPM * fast
    np.testing.assert_allclose(numbers(found, table, "rad/s"), expected, rtol=1e-12)


def test_all_unknown_columns_are_listed_with_guesses_and_a_line_to_copy(tmp_path):
    table = rig(tmp_path, "N_SLIP [1/min];F_AX [kN];M [Nm];Oil [degC];mark", "300;1;5;80;7")
    with pytest.raises(ParameterError) as problem:
        known_columns(table, UNITS, [(name,) for name in UNITS])
    line = (
        '--column "speed=N_SLIP" --column "load=F_AX" --column "friction_torque=M" '
        '--column "oil_temperature=Oil"'
    )
    assert str(problem.value).endswith(line) and "Oil [degC] (is it oil_temperature?), mark" in str(
        problem.value
    )


def test_two_speeds_are_offered_as_their_difference(tmp_path):
    table = rig(tmp_path, "n_in [rpm];n_out [rpm];load;friction_torque", "300;100;1;2")
    with pytest.raises(ParameterError, match='--column "speed=n_in - n_out"'):
        known_columns(table, UNITS, [("speed",)])


def test_one_of_two_speeds_alone_is_asked_about_and_may_be_confirmed(tmp_path):
    table = rig(tmp_path, "n_in [rpm];n_out [rpm];load", "300;100;1")
    with pytest.raises(ParameterError) as problem:
        known_columns(renamed(table, {"speed": "n_in"}), UNITS)
    assert '--column "speed=n_in - n_out"' in str(problem.value)
    assert '--column "_n_out=n_out"' in str(problem.value)
    found = known_columns(renamed(table, {"speed": "n_in", "_n_out": "n_out"}), UNITS)
    assert {*found.found} == {"speed", "load"}


def test_columns_that_no_name_nearly_has_are_passed_over(tmp_path):
    table = rig(tmp_path, "speed [rpm];load;gear;mark", "300;1;2;3")
    assert known_columns(table, UNITS).passed == ["gear", "mark"]
    assert known_columns(table, UNITS, strict=True).passed == ["gear", "mark"]
    with pytest.raises(ParameterError, match="column 'loda' is not known; did you mean load"):
        known_columns(rig(tmp_path, "speed;loda", "1;2"), UNITS)


def test_speeds_that_differ_by_a_number_are_two_also_without_units(tmp_path):
    package("scipy.io").savemat(tmp_path / "rig.mat", {"n1": [3.0, 2.0], "n2": [1.0, 2.0]})
    table = read_table(tmp_path / "rig.mat")
    for given in (table, renamed(table, {"speed": "n1"})):
        with pytest.raises(ParameterError, match='--column "speed=n1 - n2"'):
            known_columns(given, UNITS, [("speed",)])
    assert "speed" in known_columns(renamed(table, {"speed": "n1", "_n2": "n2"}), UNITS).found


def test_channels_of_one_name_are_told_by_their_groups(tmp_path):
    mdf = package("asammdf")
    with mdf.MDF() as file:
        for rows in (11, 3):
            time = np.linspace(0.0, 1.0, rows)
            file.append([mdf.Signal(time + rows, time, name="n", unit="rpm")])
        file.save(tmp_path / "rig.mf4")
    table = read_table(tmp_path / "rig.mf4")
    assert renamed(table, {"speed": "0:n - 1:n"}).remarks == ["speed = 0:n - 1:n"]
    with pytest.raises(ParameterError) as problem:
        known_columns(table, {"time": "s", **UNITS}, [("speed",)], may_lack=True)
    assert '0:n (is it speed?), 1:n (is it speed?); if so: --column "speed=0:n - 1:n"' in str(
        problem.value
    )


def test_units_behind_the_names_of_a_parquet_file_are_read(tmp_path):
    pyarrow = package("pyarrow")
    names = {"n [rpm]": [300.0], "load": [1.0]}
    package("pyarrow.parquet").write_table(pyarrow.table(names), tmp_path / "rig.parquet")
    table = renamed(read_table(tmp_path / "rig.parquet"), {"speed": "n"})
    assert value(table, "speed", "rad/s") == pytest.approx(300.0 * RPM, rel=1e-12)
