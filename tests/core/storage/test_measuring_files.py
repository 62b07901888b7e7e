"""Measuring files: what is not measured at an instant is left out there, and counted."""

import numpy as np
import pytest

from tests.needed import package
from thrustwasher.errors import ParameterError
from thrustwasher.storage.tables.table_file import read_table

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
        table.renamed({"speed": "speed"})
    for group, value in (("fast", 150.0), ("slow", 75.0)):
        found, _ = cells(table.renamed({"speed": f"{group}:speed"}))
        assert set(found["speed"]) == {value}
    assert len(table.of_columns(("time", "load", "note"))) == 101


def test_groups_without_names_are_named_by_their_numbers(tmp_path):
    groups = ("", FAST, {"load": FAST, "speed": FAST}), ("", SLOW, {"speed": SLOW + 1.0})
    table = written(tmp_path / "rig.mf4", *groups)
    with pytest.raises(ParameterError, match="groups '0', '1'"):
        cells(table)
    assert cells(table.renamed({"speed": "1:speed"}))[0]["speed"][0] == 1.0


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
        read_table(tmp_path / "rig.csv").renamed({"speed": "N"})
