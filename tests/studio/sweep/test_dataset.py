"""A sweep as a dataset of xarray, and as a short text."""

import numpy as np

from tests.needed import package
from thrustwasher import run_sweep

SPEEDS, LOADS = [5.0, 10.0, 20.0], [3e3, 1e3]


def grid():
    return run_sweep("clutch", {"load": LOADS, "speed": SPEEDS}, workers=1)


def test_a_grid_has_the_axes_as_dimensions_and_a_value_where_it_belongs():
    package("xarray")
    table = grid()
    found = table.to_xarray()
    assert found["friction_torque"].dims == ("load", "speed")
    for i in range(len(table)):
        at = found.sel(load=table["load"][i], speed=table["speed"][i])
        assert float(at["friction_torque"]) == table["friction_torque"][i]
    assert found["load"].attrs["units"] == "N" and found["load"].values.tolist() == LOADS
    assert found["friction_torque"].attrs["units"] == "N.m"
    assert "torque" in found["friction_torque"].attrs["long_name"]


def test_the_axes_stand_in_the_order_in_which_they_were_asked_for():
    package("xarray")
    asked = {"friction_scale": (1.0, 1.5), "speed": SPEEDS, "load": LOADS}
    assert list(run_sweep("clutch", asked, workers=1).to_xarray().sizes) == list(asked)


def test_the_status_is_a_number_with_its_meaning_and_points_alone_are_rows():
    package("xarray")
    points = {"load": [1e3, 2e3, 3e3], "speed": [5.0, 6.0, 7.0]}
    found = run_sweep("clutch", points=points, workers=1).to_xarray()
    assert found["friction_torque"].dims == ("row",) and found.sizes["row"] == 3
    assert found["status"].attrs["flag_meanings"] == "OK"
    assert (found["status"] == found["status"].attrs["flag_values"][0]).all()


def test_a_dataset_comes_back_from_a_file_as_it_was(tmp_path):
    xarray = package("xarray")
    found = grid().to_xarray()
    found.to_netcdf(tmp_path / "table.nc", engine="scipy")
    with xarray.open_dataset(tmp_path / "table.nc", engine="scipy") as again:
        xarray.testing.assert_equal(again.load(), found)
        np.testing.assert_array_equal(
            again["status"].attrs["flag_values"], found["status"].attrs["flag_values"]
        )


def test_the_text_of_a_table_is_short_and_says_what_there_is():
    text = repr(grid())
    assert text.startswith("SweepTable: 6 rows") and "speed  5 rad/s .. 20 rad/s" in text
    assert len(text) < 1500


def test_a_table_whose_rows_are_in_a_file_alone_says_so(tmp_path):
    table = run_sweep(
        "clutch", {"load": LOADS}, at={"speed": 5.0}, workers=1, out=tmp_path / "t.csv", keep=False
    )
    assert repr(table).startswith("SweepTable: 0 rows, 0 columns")
