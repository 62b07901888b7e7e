"""The map against the mesh it was built on: values, branches, folds, symmetry, derivatives."""

import math

import numpy as np
import pytest

from thrustwasher.errors import BranchError, ParameterError, Status
from thrustwasher.washer.kernels.map import map_layout as L
from thrustwasher.washer.load_curve import load_curve
from thrustwasher.washer.map.map_file import VARIABLE, pack, read_map
from thrustwasher.washer.parameters import WasherParams
from thrustwasher.washer.solve import solve_washer

PARAMS = WasherParams()
TORQUE = 1.7e-3  # a third of the tolerance that the map is built to
PLACE = {"speed": 545.0, "tilt": 0.002, "oil_temperature": 297.15}
OFF_NODES = [
    (150.0, 431.0, 0.00183, "film"), (420.0, 655.0, 0.00217, "film"),
    (700.0, 512.0, 0.00194, "film"), (800.0, 587.0, 0.00209, "contact"),
    (880.0, 418.0, 0.00201, "contact"),
]  # fmt: skip


@pytest.mark.parametrize(("load", "speed", "tilt", "branch"), OFF_NODES)
def test_between_its_nodes_the_map_agrees_with_the_mesh(found_first, load, speed, tilt, branch):
    point = {"load": load, "speed": speed, "tilt": tilt, "branch": branch}
    here = solve_washer(PARAMS, **point, fidelity="map")
    there = solve_washer(PARAMS, **point)
    assert (here.fidelity, here.branch, here.distress) == ("map", there.branch, there.distress)
    assert here.friction_torque == pytest.approx(there.friction_torque, rel=TORQUE)
    assert here.film_ratio == pytest.approx(there.film_ratio, abs=1e-2)
    assert here.temperature == pytest.approx(there.temperature, abs=0.02)
    assert here.fluid_load + here.contact_load == pytest.approx(load, rel=1e-9)
    assert here.contact_load == pytest.approx(there.contact_load, rel=5e-3, abs=0.1)
    assert here.washer_tilt_y == pytest.approx(there.washer_tilt_y, rel=1e-3)
    assert here.washer_tilt_x == pytest.approx(there.washer_tilt_x, abs=1e-3 * tilt)
    assert here.friction_coefficient == pytest.approx(there.friction_coefficient, rel=TORQUE)
    for name in ("oil_flow", "throughflow_heat", "oil_heat", "stick_margin"):
        assert getattr(here, name) == pytest.approx(getattr(there, name), rel=2e-3), name
    for name in ("oil_outlet_temperature", "film_temperature"):
        rise = getattr(there, name) - 297.15
        assert getattr(here, name) - 297.15 == pytest.approx(rise, rel=3e-3), name


def test_the_folds_are_those_of_the_load_curve(small):
    for speed in (460.0, 545.0, 690.0):
        place = {**PLACE, "speed": speed}
        mine, theirs = small.folds(**place), load_curve(PARAMS, **place).folds
        assert [f.kind for f in mine] == [f.kind for f in theirs] == ["film_lost", "film_regained"]
        for a, b in zip(mine, theirs, strict=True):
            assert a.load == pytest.approx(b.load, rel=TORQUE)
            assert a.film_ratio == pytest.approx(b.film_ratio, abs=0.02)


def test_a_branch_is_kept_up_to_its_fold_and_no_further(found_first, small):
    lost, regained = (f.load for f in small.folds(**PLACE))
    last = solve_washer(PARAMS, load=lost - 0.5, **PLACE, fidelity="map")
    assert (last.branch, last.distress) == ("film", False)
    fallen = solve_washer(PARAMS, load=lost + 0.5, **PLACE, fidelity="map", start=last)
    assert (fallen.branch, fallen.distress) == ("contact", True)
    held = solve_washer(PARAMS, load=regained + 0.5, **PLACE, fidelity="map", start=fallen)
    assert held.branch == "contact"
    back = solve_washer(PARAMS, load=regained - 0.5, **PLACE, fidelity="map", start=held)
    assert back.branch == "film"


def test_a_branch_that_is_not_there_is_refused(found_first, small):
    lost, regained = (f.load for f in small.folds(**PLACE))
    with pytest.raises(BranchError, match="film"):
        solve_washer(PARAMS, load=1.02 * lost, **PLACE, fidelity="map", branch="film")
    with pytest.raises(BranchError, match="contact"):
        solve_washer(PARAMS, load=0.98 * regained, **PLACE, fidelity="map", branch="contact")


def test_rows_and_single_look_ups_are_the_same(small):
    loads = np.linspace(110.0, 890.0, 9)
    rows = small.look_up(load=loads, **PLACE)["friction_torque"]
    assert [small.torque(load, 545.0, 0.002, 297.15) for load in loads] == rows.tolist()


def test_outside_its_box_a_map_says_nothing_and_the_field_answers(found_first, small):
    for change in (
        {"load": 99.0},
        {"load": 1101.0},
        {"speed": 399.0},
        {"tilt": 0.0023},
        {"tilt": 0.0},
        {"oil_temperature": 298.0},
    ):
        point = {"load": 300.0, **PLACE, **change}
        assert not small.covers(**point)
        assert math.isnan(small.torque(*point.values()))
        assert small.look_up(**point)["branch"] == -1.0
        result = solve_washer(PARAMS, **point, fidelity="map")
        assert result.fidelity == "field"
        assert result.status is (Status.DISTRESS if result.distress else Status.OUTSIDE_MAP)
        assert result.friction_torque == solve_washer(PARAMS, **point).friction_torque


def test_without_a_map_for_the_parameters_the_message_says_how_to_make_one(found_first):
    with pytest.raises(ParameterError, match="thrustwasher map build"):
        solve_washer(WasherParams(roughness=4.1e-7), load=300.0, **PLACE, fidelity="map")


def test_a_map_that_comes_goes_or_is_written_anew_is_seen_at_once(map_path, tmp_path, monkeypatch):
    """The washer and its parameters stay the same; the answer is the map's that is there now."""

    def answered():
        result = solve_washer(PARAMS, load=300.0, **PLACE, fidelity="map")
        return result.fidelity, result.friction_torque

    def write(data):
        draft = tmp_path / "draft"
        draft.write_bytes(pack(data, small.metadata))
        draft.replace(tmp_path / "mine.twm")

    shipped, small = answered(), read_map(map_path)
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    assert answered() == shipped  # no map there yet
    write(small.data)
    first = answered()
    assert first[0] == "map" and first != shipped
    narrow = small.data.copy()
    narrow[L.BOX + 1] = 250.0  # N, the highest load
    write(narrow)
    assert answered()[0] == "field"
    (tmp_path / "mine.twm").write_bytes(pack(small.data, small.metadata))  # in its place
    assert answered() == first
    (tmp_path / "mine.twm").unlink()
    assert answered() == shipped
