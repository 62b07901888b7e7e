"""Outside the map's box: solved, held at the nearest edge or refused, and said each time."""

import numpy as np
import pytest

from thrustwasher.errors import ParameterError, SolveError, Status
from thrustwasher.fmu.build import build
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.washer.kernels.map import alone
from thrustwasher.washer.map.map_alone import map_alone
from thrustwasher.washer.parameters import SPEC, WasherParams
from thrustwasher.washer.solve import solve_washer

PLACE = {"load": 300.0, "speed": 545.0, "tilt": 0.002, "oil_temperature": 297.15}
ALONE = map_alone(SPEC)


def solved(way, **change):
    return solve_washer(WasherParams(outside_map=way), **PLACE | change, fidelity="map")


def stepped(**parameters):
    """Return the washer that only looks up, initialized in the box."""
    model = DirectInstance(ALONE, parameters=parameters)
    model.initialize(0.0, PLACE)
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
        solve_washer(WasherParams(), **PLACE | {"tilt": 0.0035}),
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
        model.set_inputs([load, *list(PLACE.values())[1:]])
        model.step(model.core.time, 1e-3)
        found = dict(zip(model.output_names, model.outputs(), strict=True))
        wanted = solve_washer(WasherParams(), **PLACE | {"load": load}, fidelity="map")
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
    model.set_inputs(list(PLACE.values()))
    model.step(5e-3, 1e-3)
    assert model.outputs()[model.output_names.index("solver_status")] == Status.OK


@pytest.mark.parametrize(("way", "level"), [("solve", "field"), ("hold", "map")])
def test_the_washer_with_its_solver_says_once_that_it_left_the_box(way, level):
    """Then it is back in the box; the next time is counted for the end of the run."""
    given = {"fidelity": "map", "outside_map": way, "holding": "off"}
    model, log = DirectInstance(SPEC, parameters=given), []
    model.initialize(0.0, PLACE)
    for k, tilt in enumerate([0.0035, 0.0036, 0.0035, 0.002, 0.0035]):
        model.set_inputs([300.0, 545.0, tilt, 297.15])
        model.step(k * 1e-3, 1e-3)
        found = dict(zip(model.output_names, model.outputs(), strict=True))
        assert found["solver_status"] == (Status.OUTSIDE_MAP if tilt > 0.003 else Status.OK)
        log += [text for _, text in model.core.messages() if "OUTSIDE_MAP" in text]
    place = PLACE | {"tilt": 0.0035 if way == "solve" else 0.003}
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
    model.set_inputs(list(PLACE.values()))
    model.step(0.0, 1e-3)
    assert model.outputs()[model.output_names.index("solver_status")] == Status.OK


def test_at_the_edge_what_is_held_has_no_slope_and_the_rest_has():
    model = stepped(holding="off")
    model.set_inputs([300.0, 545.0, 0.008, 297.15])
    model.step(0.0, 1e-3)
    slopes = [model.directional_derivative(["friction_torque"], [name], [1.0])[0] for name in PLACE]
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
