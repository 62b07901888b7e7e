"""Golden records: what moves is told with name, place and both values; what does not is not."""

import json

import numba
import numpy as np
import pytest

from lab.golden.__main__ import check, main, renew
from lab.golden.cases import RECORDED
from lab.golden.record import FOLDER, bits, numbers, read

TIME = np.linspace(0.0, 1.0, 11)
NEXT = np.nextafter(0.5, 1.0)


def kept(folder, kind, values):
    recorded = {"some": (kind, lambda: values)}
    renew(["some"], "a first record", recorded, folder)
    return lambda now: check(["some"], {"some": (kind, lambda: now)}, folder)


def changed(row, value):
    column = TIME.copy()
    column[row] = value
    return column


@pytest.mark.parametrize(("row", "value"), [(5, NEXT), (10, 1.5), (0, -0.0), (3, np.nan)])
def test_a_bit_of_a_column_that_moves_is_found(row, value, tmp_path, capsys):
    columns = {"time": TIME, "speed": TIME, "words": ["film", "mixed"]}
    again = kept(tmp_path, "bits", bits("washer:", columns))
    assert again(bits("washer:", columns)) == []
    now = bits("washer:", columns | {"speed": changed(row, value)})
    (found,) = again(now)
    assert (found.name, found.place) == ("some", "washer: speed")
    said = capsys.readouterr().out
    assert "some: washer: speed: kept 1.0 at the end of 11 rows" in said
    assert f"now {float(changed(row, value)[-1])!r} at the end of 11 rows" in said


def test_a_column_that_is_constant_is_its_number_and_zero_has_a_sign(tmp_path):
    again = kept(tmp_path, "bits", bits("sump:", {"heat": np.zeros(4)}))
    assert again({"sump: heat": 0.0}) == []
    assert [str(d) for d in again(bits("sump:", {"heat": -np.zeros(4)}))] == [
        "some: sump: heat: kept 0.0, now -0.0"
    ]


@pytest.mark.parametrize(("off", "differ"), [(0.9e-9, 0), (1.1e-9, 1), (-1.1e-9, 1)])
def test_numbers_may_differ_by_a_billionth(off, differ, tmp_path):
    again = kept(tmp_path, "numbers", numbers("fit:", {"best": {"roughness": 4e-7}, "tries": 7}))
    found = again(numbers("fit:", {"best": {"roughness": 4e-7 * (1.0 + off)}, "tries": 7}))
    assert [d.place for d in found] == ["fit: best.roughness"] * differ


def test_values_that_come_or_go_are_differences(tmp_path):
    again = kept(tmp_path, "numbers", {"a": 1.0, "b": 2.0})
    assert [str(d) for d in again({"b": 2.0, "c": 3.0})] == [
        "some: a: kept 1.0, now nothing",
        "some: c: kept nothing, now 3.0",
    ]


def test_times_and_paths_are_left_out_and_long_lists_are_short():
    result = {"wall_time": 3.0, "file": "x", "none": None, "rows": list(range(100)), "few": [1, 2]}
    found = numbers("it:", result)
    assert found == {
        **{f"it: rows[{i}]": x for i, x in enumerate([100.0, 0.0, 99.0, 4950.0])},
        **{"it: few[0]": 1.0, "it: few[1]": 2.0},
    }


def test_a_record_is_renewed_with_its_reason_and_left_alone_if_nothing_moved(tmp_path):
    kept(tmp_path, "numbers", {"a": 1.0})
    assert renew(["some"], "no reason", {"some": ("numbers", lambda: {"a": 1.0})}, tmp_path) == []
    assert read("some", tmp_path).why == "a first record"
    moved = renew(["some"], "another law", {"some": ("numbers", lambda: {"a": 1.1})}, tmp_path)
    assert (moved, read("some", tmp_path).why) == (["some"], "another law")
    assert "numpy" in read("some", tmp_path).made_with


@pytest.mark.parametrize("line", ["", "--check nothing", "--write", "--check --write --why so"])
def test_wrong_arguments_are_refused(line, capsys):
    with pytest.raises(SystemExit) as refused:
        main(line.split())
    assert refused.value.code == 2
    assert "golden: error: " in capsys.readouterr().err


def test_every_record_is_there_and_no_other():
    files = {path.stem: json.loads(path.read_text("utf-8")) for path in FOLDER.glob("*.json")}
    assert {name: table["kind"] for name, table in files.items()} == {
        name: kind for name, (kind, _) in RECORDED.items()
    }
    assert all(table["why"] and len(table["values"]) > 20 for table in files.values())


@pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="mathematics of Python's own library")
def test_a_sweep_is_as_recorded():
    assert check(["sweeps"], RECORDED) == []
