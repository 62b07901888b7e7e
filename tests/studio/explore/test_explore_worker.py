"""The page's worker in node: the numbers of the Python API, to rounding."""

from dataclasses import fields

import numpy as np
import pytest
from pages import about, answers, node

from thrustwasher import (
    BranchError,
    ClutchParams,
    GearMeshParams,
    LossesParams,
    TrainParams,
    WasherParams,
    engage_clutch,
    load_curve,
    solve_gearmesh,
    solve_losses,
    solve_train,
    solve_washer,
)
from thrustwasher.errors import ParameterError
from thrustwasher.model.parameters import as_numbers
from thrustwasher.model.registry import find_model
from thrustwasher.model.spec import CHURNING_REGIMES

SAME = 1e-10  # the C libraries differ in the last bit
SOLVED = 1e-8  # solutions end at 1e-9 in load; Python begins where a map says, a page from nothing
BESIDE_FOLDS = 1e-8
RESULTS = ["friction_torque", "temperature", "film_thickness", "temperature_max", "film_ratio"]
RESULTS += ["friction_coefficient", "oil_flow", "oil_heat", "contact_load", "fluid_load"]
pytestmark = node


def washer_points(n):
    """Return load, speed, tilt, oil temperature at random."""
    low, high = np.array([20.0, 50.0, 1e-3, 290.0]), np.array([1850.0, 1400.0, 3e-3, 400.0])
    share = np.random.default_rng(17).random((n, 4))
    return [[*point, 0.0] for point in (low * (high / low) ** share).tolist()]


def apart(found, wanted):
    """Return the largest relative difference of the results."""
    pairs = [(found[n], getattr(wanted, n)) for n in RESULTS]
    return max(abs(a - b) / max(abs(b), 1e-6 * wanted.load if b < 1.0 else 1e-12) for a, b in pairs)


@pytest.mark.slow
def test_a_hundred_points_of_the_washer_are_those_of_python():
    points = washer_points(100)
    found, _ = answers("washer", [["solve", p, True, ""] for p in points])
    for point, got in zip(points, found, strict=True):
        wanted = solve_washer(WasherParams(), **dict(zip(NAMES, point, strict=True)))
        assert got["code"] == 0 and got["outputs"]["branch"] == wanted.branch
        beside = got["outputs"]["film_ratio"] < 3.0
        assert apart(got["outputs"], wanted) <= (BESIDE_FOLDS if beside else SOLVED), point


NAMES = ("load", "speed", "tilt", "oil_temperature", "far_face_temperature")


def test_both_folds_are_those_of_load_curve():
    point = [300.0, 545.0, 2e-3, 297.15, 0.0]
    (curve,), _ = answers("washer", [["curve", point, 20.0, 3000.0]])
    wanted = load_curve(WasherParams(), speed=545.0, tilt=2e-3)
    assert [f["kind"] for f in curve["folds"]] == ["film_lost", "film_regained"]
    for got, fold in zip(curve["folds"], wanted.folds, strict=True):
        for name in ("load", "friction_torque", "temperature", "film_ratio"):
            assert got[name] == pytest.approx(getattr(fold, name), rel=BESIDE_FOLDS)
    assert len(curve["points"]) == len(wanted.points)
    for got, p in zip(curve["points"], wanted.points, strict=True):
        assert got["branch"] == p.branch
        assert got["load"] == pytest.approx(p.load, rel=BESIDE_FOLDS)


def test_draws_over_loads_are_solved_on_both_ways_of_the_load():
    loads, rest = [300.0, 700.0, 900.0, 1500.0], [545.0, 2e-3, 297.15, 0.0]
    task = ["draw", as_numbers(WasherParams()), "field", [300.0, *rest], loads]
    (got,), _ = answers("washer", [task])
    for way, branches in {"up": [None] * 4, "down": [None, "contact", "contact", None]}.items():
        for load, one, branch in zip(loads, got[way], branches, strict=True):
            if way == "down" and branch is None:
                assert one is None
                continue
            point = dict(zip(NAMES, [load, *rest], strict=True))
            wanted = solve_washer(WasherParams(), **point, branch=branch)
            assert one["branch"] == wanted.branch
            assert one["friction_torque"] == pytest.approx(wanted.friction_torque, rel=1e-5)


def test_the_stribeck_curve_slows_down_then_speeds_up():
    speeds, rest = [100.0, 545.0], [2e-3, 297.15, 0.0]
    (got,), _ = answers("washer", [["stribeck", [300.0, 545.0, *rest], speeds]])
    rows = [(r["up"], r["speed"]) for r in got["rows"]]
    assert rows == [(False, 545.0), (False, 100.0), (True, 100.0), (True, 545.0)]
    for r in got["rows"][:2]:  # down there is no contact branch to come from
        point = dict(zip(NAMES, [300.0, r["speed"], *rest], strict=True))
        wanted = solve_washer(WasherParams(), **point).friction_coefficient
        assert r["friction_coefficient"] == pytest.approx(wanted, rel=1e-5)


def test_a_branch_that_is_asked_for_is_kept_fresh_and_its_absence_is_told():
    rest = [545.0, 2e-3, 297.15, 0.0]
    point, light = [800.0, *rest], [300.0, *rest]
    (held, lost), _ = answers(
        "washer", [["solve", point, True, "contact"], ["solve", light, True, "contact"]]
    )
    wanted = solve_washer(WasherParams(), **dict(zip(NAMES, point, strict=True)), branch="contact")
    assert held["asked"] and apart(held["outputs"], wanted) <= BESIDE_FOLDS
    with pytest.raises(BranchError):
        solve_washer(WasherParams(), **dict(zip(NAMES, light, strict=True)), branch="contact")
    assert lost["missing"] and lost["outputs"]["branch"] == "film"


@pytest.mark.parametrize("level", ["field", "fine"])
@pytest.mark.parametrize(("conduction", "oil_cooling"), [("carrier", True), ("all", False)])
@pytest.mark.slow
def test_fields_are_those_of_python(level, conduction, oil_cooling):
    params = WasherParams(conduction=conduction, oil_cooling=oil_cooling)
    point = [600.0, 700.0, 2e-3, 320.0, 0.0]
    (got,), _ = answers("washer", [["solve", point, True, ""]], params=params, level=level)
    wanted = solve_washer(params, **dict(zip(NAMES, point, strict=True)), fidelity=level).fields()
    for name in ("radius", "angle"):
        np.testing.assert_allclose(got["fields"][name], getattr(wanted, name), rtol=1e-12)
    for name in ("film_thickness", "pressure", "contact_pressure", "washer_temperature"):
        there = getattr(wanted, name)
        here = np.array(got["fields"][name]).reshape(there.T.shape).T
        np.testing.assert_allclose(here, there, atol=1e-8 * np.abs(there).max(), err_msg=name)


def test_the_gear_mesh_is_that_of_python():
    share = np.random.default_rng(3).random((100, 3))
    low, high = np.array([10.0, 10.0, 250.0]), np.array([3e4, 600.0, 400.0])
    points = (low * (high / low) ** share).tolist()
    limited = GearMeshParams(permissible_film_ratio=0.3)
    found, _ = answers("gearmesh", [["solve", point] for point in points], params=limited)
    for (power, speed, oil), got in zip(points, found, strict=True):
        wanted = solve_gearmesh(limited, power=power, speed=speed, oil_temperature=oil)
        for name, value in got["outputs"].items():
            if value is None:
                assert getattr(wanted, name) is None, name
            elif name != "regime":
                assert value == pytest.approx(getattr(wanted, name), rel=SAME, abs=1e-300), name
        path = got["path"]
        assert max(path["flank"]) == pytest.approx(wanted.surface_temperature, rel=1e-12)
        assert min(path["safety"]) == pytest.approx(wanted.scuffing_safety, rel=1e-9)
        assert min(path["micropitting"]) == pytest.approx(wanted.micropitting_safety, rel=1e-3)


def test_the_losses_are_those_of_python():
    share = np.random.default_rng(5).random((50, 6)) - 0.5
    points = (share * [1e3, 600.0, 900.0, 2e3, 8e3, 120.0] + [0, 0, 0, 0, 0, 330.0]).tolist()
    found, _ = answers("losses", [["solve", point] for point in points])
    names = [s.name for s in find_model("losses").inputs()]
    for point, got in zip(points, found, strict=True):
        wanted = solve_losses(LossesParams(), **dict(zip(names, point, strict=True)))
        for name, value in got["outputs"].items():
            own = getattr(wanted, name)
            if name.endswith("_regime"):
                assert list(CHURNING_REGIMES)[value - 1] == own, name
                continue
            assert value == pytest.approx(own, rel=SAME), name
        assert got["curve"][40]["oil_heat"] == got["outputs"]["oil_heat"]


TRAINS = {
    "two meshes": {},
    "one, no root limit": {"meshes": 1, "mesh_1_root_limit": 0.0},
    "three, the first speeds up": {"meshes": 3, "mesh_1_driver": "gear", "mesh_2_hand": "right"},
}


@pytest.mark.parametrize("changed", TRAINS.values(), ids=TRAINS)
@pytest.mark.slow
def test_the_gear_train_is_that_of_python(changed):
    params = TrainParams(**changed)
    share = np.random.default_rng(8).random((30, 3)) - 0.5
    points = [*(share * [500.0, 800.0, 120.0] + [0.0, 0.0, 340.0]).tolist()]
    points += [[0.0, 300.0, 330.0], [100.0, 0.0, 330.0], [0.0, 0.0, 330.0], [0.4, 400.0, 260.0]]
    found, _ = answers("train", [["solve", point] for point in points], params=params)
    names = [s.name for s in find_model("train").inputs()]
    for point, got in zip(points, found, strict=True):
        wanted = solve_train(params, **dict(zip(names, point, strict=True)), throw=False)
        assert got["code"] == wanted.status
        for name, value in got["outputs"].items():
            own = getattr(wanted, name)
            if name == "flow" or own is None:
                assert value == own, name
            elif name == "efficiency" and value is None:  # NaN, of which JSON makes null
                assert np.isnan(own)
            else:
                assert value == pytest.approx(own, rel=SAME, abs=SAME), (name, point)
        assert got["speeds"][16]["loss"] == got["outputs"]["loss"]


def test_losses_by_source_over_torque_sum_to_the_loss():
    (got,), _ = answers("train", [["solve", [150.0, 500.0, 353.15]]])
    middle = got["torques"][24]
    assert (middle["torque"], middle["efficiency"]) == (0.0, None)  # idle: nothing comes out
    for p in got["torques"]:
        parts = [p[name] for name in ("mesh", "bearing", "seal", "churning")]
        assert p["loss"] == pytest.approx(sum(parts), rel=SAME)
        wanted = solve_train(TrainParams(), torque=p["torque"], speed=500.0)
        assert p["loss"] == pytest.approx(wanted.loss, rel=SAME)


def test_bearings_of_a_shaft_at_one_place_are_refused_as_in_python():
    names = [f.name for f in fields(TrainParams)]
    numbers = as_numbers(TrainParams())
    numbers[names.index("shaft_2_bearing_1_position")] = 0.13  # where its second one is
    (number,), _ = answers("train", [["set", numbers, "handbook"]])
    with pytest.raises(ParameterError, match="shaft_2_bearing_2_position"):
        TrainParams(shaft_2_bearing_1_position=0.13)
    assert about("train")["rules"][number - 1].startswith("shaft_2_bearing_2_position")


@pytest.mark.parametrize("preset", [None, "paper"])
def test_the_page_has_no_figure_where_python_has_none(preset):
    params = GearMeshParams.preset(preset) if preset else GearMeshParams()
    point = [7500.0, 180.0, 300.0]
    (got,), _ = answers("gearmesh", [["solve", point]], params=params)
    wanted = solve_gearmesh(params, power=7500.0, speed=180.0, oil_temperature=300.0)
    none = {name for name, value in got["outputs"].items() if value is None}
    assert none == {name for name in got["outputs"] if getattr(wanted, name, 0) is None}
    assert "micropitting_safety" in none and (preset or got["path"]["micropitting"] is None)


@pytest.mark.parametrize("level", ["field", "fine", "closed"])
def test_an_engagement_under_a_drawn_ramp_is_that_of_python(level):
    ramp = [0.0, 1000.0, 4000.0, 3000.0, 5000.0, 5000.0, 5500.0, 5000.0, 5000.0]
    task = ["solve", [120.0, 340.0, 0.0, 0.6], True, "", {"ramp": ramp}]
    (got,), _ = answers("clutch", [task], level=level)
    time = np.linspace(0.0, 0.6, about("clutch")["points"] + 1)
    wanted = engage_clutch(
        ClutchParams(),
        time=time,
        load=np.interp(time, np.linspace(0.0, 0.6, 9), ramp),
        speed=120.0 * (1.0 - time / 0.6),
        oil_temperature=340.0,
        fidelity=level,
    )
    for name in ("friction_torque", "temperature", "film_ratio", "energy", "oil_heat"):
        there = getattr(wanted, name)
        np.testing.assert_allclose(
            got["series"][name], there, atol=1e-9 * np.abs(there).max(), err_msg=name
        )
    assert got["outputs"]["temperature_max"] == pytest.approx(wanted.temperature.max(), rel=1e-9)
