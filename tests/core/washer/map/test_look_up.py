"""The map against the mesh it was built on: values, branches, folds, symmetry, derivatives."""

import math

import numpy as np
import pytest

from thrustwasher.errors import BranchError, ParameterError, SolveError, Status
from thrustwasher.fmu.build import build
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.washer.kernels.map import alone
from thrustwasher.washer.kernels.map import map_layout as L
from thrustwasher.washer.load_curve import load_curve
from thrustwasher.washer.map.map_alone import map_alone
from thrustwasher.washer.map.map_file import VARIABLE, pack, read_map
from thrustwasher.washer.parameters import SPEC, WasherParams
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


# Outside the map's box: solved, held at the nearest edge or refused, and said each time.

OUTSIDE_PLACE = {"load": 300.0, "speed": 545.0, "tilt": 0.002, "oil_temperature": 297.15}
ALONE = map_alone(SPEC)


def solved(way, **change):
    return solve_washer(WasherParams(outside_map=way), **OUTSIDE_PLACE | change, fidelity="map")


def stepped(**parameters):
    """Return the washer that only looks up, initialized in the box."""
    model = DirectInstance(ALONE, parameters=parameters)
    model.initialize(0.0, OUTSIDE_PLACE)
    return model


@pytest.mark.parametrize(
    ("change", "edge"),
    [
        ({"load": 5000.0}, {"load": 1850.0}),
        ({"speed": -1900.0}, {"speed": -1400.0}),
        ({"tilt": 0.0}, {"tilt": 0.001}),
        ({"oil_temperature": 260.0}, {"oil_temperature": 290.0}),
        ({"load": 5.0, "tilt": 0.008}, {"load": 20.0, "tilt": 0.003}),
    ],
)
def test_held_the_answer_is_that_of_the_nearest_point_of_the_box(change, edge):
    held, there = solved("hold", **change), solved("hold", **edge)
    assert held.friction_torque == there.friction_torque
    assert held.friction_power == held.friction_torque * held.speed
    assert held.status in (Status.OUTSIDE_MAP, there.status)
    (name, value), *_ = change.items()
    assert f"{name} = {value:g} " in held.warnings[0] and "hold" in held.warnings[0]


def test_solved_by_the_field_it_is_said_in_status_and_warnings():
    found, field = (
        solved("solve", tilt=0.0035),
        solve_washer(WasherParams(), **OUTSIDE_PLACE | {"tilt": 0.0035}),
    )
    assert field.status == Status.OK
    assert found.friction_torque == field.friction_torque
    assert (found.status, found.fidelity) == (Status.OUTSIDE_MAP, "field")
    assert "solved with 'field'" in found.warnings[0]


def test_refused_the_message_names_input_box_and_cure():
    with pytest.raises(ParameterError, match=r"tilt = 0.006 rad .* 0.001 .. 0.003 rad.*'hold'"):
        solved("refuse", tilt=0.006)
    inside = solved("refuse")
    assert inside.status == Status.OK and not inside.warnings


def test_the_map_alone_gives_the_numbers_of_the_washer():
    model = stepped(holding="off")
    for load in (40.0, 300.0, 900.0):
        model.set_inputs([load, *list(OUTSIDE_PLACE.values())[1:]])
        model.step(model.core.time, 1e-3)
        found = dict(zip(model.output_names, model.outputs(), strict=True))
        wanted = solve_washer(WasherParams(), **OUTSIDE_PLACE | {"load": load}, fidelity="map")
        for name in ("friction_torque", "temperature", "film_ratio", "oil_flow", "oil_heat"):
            assert found[name] == getattr(wanted, name), name


def test_a_step_that_leaves_the_box_says_so_once_and_stays_bounded():
    log, model = [], stepped(holding="off")
    edge = solved("hold", tilt=0.003).friction_torque
    for k in range(5):
        model.set_inputs([300.0, 545.0, 0.008, 297.15])
        model.step(k * 1e-3, 1e-3)
        found = dict(zip(model.output_names, model.outputs(), strict=True))
        assert found["solver_status"] == Status.OUTSIDE_MAP
        assert found["friction_torque"] == edge
        log += [text for _, text in model.core.messages()]
    assert found["energy"] == pytest.approx(5e-3 * edge * 545.0, rel=1e-12)
    assert sum("OUTSIDE_MAP" in text for text in log) == 1
    model.set_inputs(list(OUTSIDE_PLACE.values()))
    model.step(5e-3, 1e-3)
    assert model.outputs()[model.output_names.index("solver_status")] == Status.OK


@pytest.mark.parametrize(("way", "level"), [("solve", "field"), ("hold", "map")])
def test_the_washer_with_its_solver_says_once_that_it_left_the_box(way, level):
    """Then it is back in the box; the next time is counted for the end of the run."""
    given = {"fidelity": "map", "outside_map": way, "holding": "off"}
    model, log = DirectInstance(SPEC, parameters=given), []
    model.initialize(0.0, OUTSIDE_PLACE)
    for k, tilt in enumerate([0.0035, 0.0036, 0.0035, 0.002, 0.0035]):
        model.set_inputs([300.0, 545.0, tilt, 297.15])
        model.step(k * 1e-3, 1e-3)
        found = dict(zip(model.output_names, model.outputs(), strict=True))
        assert found["solver_status"] == (Status.OUTSIDE_MAP if tilt > 0.003 else Status.OK)
        log += [text for _, text in model.core.messages() if "OUTSIDE_MAP" in text]
    place = OUTSIDE_PLACE | {"tilt": 0.0035 if way == "solve" else 0.003}
    wanted = solve_washer(WasherParams(), **place, fidelity=level).friction_torque
    assert found["friction_torque"] == pytest.approx(wanted, rel=1e-5)
    assert len(log) == 1
    (count,) = model.core.counts()
    assert count.startswith("ThrustWasher: OUTSIDE_MAP 2 times in this run")


def test_a_refused_step_fails_and_the_next_one_in_the_box_goes_on():
    model = stepped(outside_map="refuse")
    model.set_inputs([300.0, 545.0, 0.008, 297.15])
    with pytest.raises(SolveError, match="outside the map's box"):
        model.step(0.0, 1e-3)
    model.set_inputs(list(OUTSIDE_PLACE.values()))
    model.step(0.0, 1e-3)
    assert model.outputs()[model.output_names.index("solver_status")] == Status.OK


def test_at_the_edge_what_is_held_has_no_slope_and_the_rest_has():
    model = stepped(holding="off")
    model.set_inputs([300.0, 545.0, 0.008, 297.15])
    model.step(0.0, 1e-3)
    slopes = [
        model.directional_derivative(["friction_torque"], [name], [1.0])[0]
        for name in OUTSIDE_PLACE
    ]
    near = [solved("hold", tilt=0.008, load=300.0 + x).friction_torque for x in (0.5, -0.5)]
    assert slopes[2] == 0.0
    assert slopes[0] == pytest.approx(near[0] - near[1], rel=1e-4)


def test_the_map_alone_shows_no_parameter_of_the_solver_and_its_box():
    names = [f for f in ALONE.params.__dataclass_fields__]
    assert names == ["holding", "coupling_inertia", "coupling_age", "outside_map"]
    assert list(ALONE.fidelities) == ["map"] and len(ALONE.inputs) == alone.NINP
    options = ALONE.params.__dataclass_fields__["outside_map"].metadata["options"]
    assert list(options) == ["hold", "refuse"]
    assert 8 * alone.NWORK < 3e6 and np.isfinite(alone.NSTATE)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"models": ["WetClutch"], "fidelity": "map"}, "WetClutch, allowed: none"),
        ({"models": ["washer"], "fidelity": "field"}, "allowed: 'map'"),
        ({"models": ["washer"], "fidelity": "map", "maps": False}, "--no-maps"),
        ({"models": ["washer"], "fidelity": "map", "target": "python"}, "--target native"),
    ],
)
def test_an_fmu_of_one_level_that_there_is_not_is_refused(options, words, tmp_path):
    with pytest.raises(ParameterError, match=words):
        build(out=tmp_path, **options)
