"""Draws of a part: each is what a single solve gives, on the branch that the part comes along."""

import pickle
from dataclasses import asdict, replace

import numpy as np
import pytest

from thrustwasher import ParameterError, load_curve, solve_washer
from thrustwasher.model.part_file import find_part, preset_part
from thrustwasher.model.registry import spec_of
from thrustwasher.studio.evaluators.part import LOST, REASONS, part_evaluator
from thrustwasher.studio.scatter import target as asked

WASHER = find_part("washer")
SURFACES = {"roughness": "15 %", "viscosity_scale": "8 %", "tilt": {"lognormal": 1.3}}
WIDE = {**SURFACES, "load": {"uniform": [300.0, 1500.0]}}
BRANCH = {"below": None, "above": "contact"}


def target_of(part, table, reached="below", inputs=None, outputs=None):
    evaluator = part_evaluator(part, inputs or part.starts, reached)
    return asked.target_of(evaluator, part.scattered(table), outputs)


def rows_of(target, n, seed=1):
    return target.scatter.values(
        np.random.default_rng(seed).random((n, len(target.scatter.sources)))
    )


def solved(target, rows):
    """Return columns by name, and the codes."""
    values, codes = target.solve(rows, np.ones(len(rows), bool))
    names = [*(f.name for f in target.figures), *target.outcomes]
    return dict(zip(names, values.T, strict=True)), codes


def single(part, row, reached="below", **more):
    params, inputs = part.varied(row)
    point = {**part.starts, **inputs}
    return solve_washer(params, **point, branch=BRANCH[reached], throw=False, **more)


def test_what_does_not_scatter_is_said():
    target = target_of(WASHER, SURFACES)
    assert target.evaluator.model == "washer" and target.setting["fidelity level"] == "field"
    assert target.setting["speed"] == "545 rad/s" and "tilt" not in target.setting


# Washers, where there are two solutions


@pytest.mark.slow
@pytest.mark.parametrize("reached", BRANCH)
def test_draws_across_both_folds_are_those_of_single_solves(reached):
    target = target_of(WASHER, WIDE, reached)
    rows = rows_of(target, 48)
    columns, codes = solved(target, rows)
    alone = [single(WASHER, row, reached) for row in rows]
    assert not codes.any()
    assert [r.branch == "contact" for r in alone] == columns[LOST].astype(bool).tolist()
    assert 0.2 < columns[LOST].mean() < 0.8
    for name in ("friction_torque", "temperature_max", "film_ratio", "oil_heat"):
        expected = [getattr(r, name) for r in alone]
        assert columns[name] == pytest.approx(expected, rel=1e-6), name


def test_between_its_folds_the_film_is_lost_from_above_and_never_from_below():
    point = {n: WASHER.starts[n] for n in ("speed", "tilt", "oil_temperature")}
    folds = sorted(f.load for f in load_curve(WASHER.params, **point).folds)
    shares = {}
    for reached in BRANCH:
        target = target_of(WASHER, {"load": {"uniform": folds}}, reached)
        shares[reached] = solved(target, rows_of(target, 64))[0][LOST].mean()
    assert shares == {"below": 0.0, "above": 1.0}


def test_a_hair_beside_the_folds_the_branch_is_right():
    point = {n: WASHER.starts[n] for n in ("speed", "tilt", "oil_temperature")}
    low, high = sorted(f.load for f in load_curve(WASHER.params, **point).folds)
    # the first draws tell about the folds of the rest
    rows = [{"load": x} for x in np.linspace(300.0, 1500.0, 12)]
    rows += [{"load": fold * (1.0 + d)} for fold in (low, high) for d in (-1e-4, 1e-4)]
    lost = {
        reached: solved(target_of(WASHER, WIDE, reached), rows)[0][LOST][-4:].tolist()
        for reached in BRANCH
    }
    assert lost == {"below": [0, 0, 0, 1], "above": [0, 1, 1, 1]}


def test_a_batch_does_not_depend_on_what_ran_before():
    target = target_of(WASHER, WIDE)
    one, other = rows_of(target, 20), rows_of(target, 20, seed=2)
    first, _ = target.solve(one, np.ones(20, bool))
    target.solve(other, np.ones(20, bool))
    again, _ = target.solve(one, np.ones(20, bool))
    assert np.array_equal(first, again)


@pytest.mark.slow
def test_without_folds_the_film_is_lost_below_a_film_ratio_of_3():
    thin = replace(WASHER, parameters={"viscosity_scale": 6e-6})
    table = {"roughness": "15 %", "load": {"uniform": [5.0, 300.0]}}
    assert not load_curve(thin.params, speed=545.0, tilt=0.002).folds
    for reached in BRANCH:
        target = target_of(thin, table, reached)
        rows = rows_of(target, 16)
        columns, codes = solved(target, rows)
        assert not codes.any() and 0.0 < columns[LOST].mean() < 1.0
        assert np.array_equal(columns[LOST], columns["film_ratio"] < 3.0)
        alone = [single(thin, row, reached).friction_torque for row in rows]
        assert columns["friction_torque"] == pytest.approx(alone, rel=1e-6)


def test_choices_and_layouts_may_change_from_draw_to_draw():
    table = {
        "conduction": {"either": ["carrier", "rotating", "all"]},
        "cavity_shear": {"either": ["full", "liquid"]},
        "outer_radius": "3 %",
        "load": {"uniform": [300.0, 1200.0]},
    }
    target = target_of(WASHER, table)
    rows = rows_of(target, 24)
    alone = [single(WASHER, row).friction_torque for row in rows]
    assert solved(target, rows)[0]["friction_torque"] == pytest.approx(alone, rel=1e-6)


def test_a_washer_without_tilt_or_speed_is_solved_too():
    target = target_of(WASHER, {"load": "20 %"}, inputs={"tilt": 0.0, "speed": 0.0})
    columns, codes = solved(target, rows_of(target, 4))
    assert not codes.any() and (columns["friction_torque"] == 0.0).all()


# Levels


def test_the_level_is_the_parts():
    fine = replace(WASHER, fidelity="fine")
    target = target_of(fine, {"roughness": "5 %"})
    rows = rows_of(target, 3)
    alone = [single(fine, row, fidelity="fine").friction_torque for row in rows]
    assert solved(target, rows)[0]["friction_torque"] == pytest.approx(alone, rel=1e-6)


def test_a_map_answers_where_inputs_scatter_and_leaves_parameters_to_the_field():
    mapped = replace(WASHER, fidelity="map")
    inputs = target_of(mapped, {"load": {"uniform": [400.0, 1200.0]}}, "above")
    rows = rows_of(inputs, 6)
    alone = []
    for row in rows:
        found = single(WASHER, row, "above", fidelity="map")
        if found.status.name == "NO_BRANCH":
            found = single(WASHER, row, fidelity="map")
        alone.append(found.friction_torque)
    assert solved(inputs, rows)[0]["friction_torque"].tolist() == alone
    assert (inputs.evaluator.fidelity, inputs.warnings) == ("map", ())
    both = target_of(mapped, {"roughness": "5 %"})
    assert both.evaluator.fidelity == "field" and "own parameters alone" in both.warnings[0]


# Any model


@pytest.mark.parametrize("model", ["clutch", "gearmesh"])
def test_draws_of_other_models_are_those_of_single_solves(model):
    part = find_part(model)
    target = target_of(part, None)
    rows = rows_of(target, 5)
    columns, codes = solved(target, rows)
    assert not codes.any() and LOST not in target.outcomes
    for i, row in enumerate(rows):
        params, inputs = part.varied(row)
        found = replace(part, parameters=asdict(params)).solve(**{**part.starts, **inputs})
        for name in ("friction_torque", "film_ratio"):
            assert columns[name][i] == pytest.approx(getattr(found, name), rel=1e-12)


def test_safeties_of_a_gear_mesh_below_1_are_outcomes():
    part = preset_part(spec_of("gearmesh"), "planet")
    target = target_of(part, {"load": {"uniform": [1.0, 400.0]}}, inputs={"speed": 200.0})
    columns, _ = solved(target, rows_of(target, 40))
    assert "pitting_safety_below_1" in target.outcomes
    for name in target.outcomes:
        safety = columns[name.removesuffix("_below_1")]
        assert np.array_equal(columns[name], safety < 1.0)
    assert 0.0 < columns["pitting_safety_below_1"].mean() < 1.0


def test_a_safety_without_its_limit_is_no_figure():
    target = target_of(find_part("gearmesh"), None)
    assert "micropitting_safety" not in [f.name for f in target.figures]
    assert "micropitting_safety_below_1" not in target.outcomes


# Failures, names


def test_parameters_that_do_not_go_together_fail_alone():
    table = {"gear_inner_radius": {"uniform": [0.02, 0.06]}}
    target = target_of(WASHER, table)
    rows = [{"gear_inner_radius": x} for x in (WASHER.params.gear_inner_radius, 0.06)]
    columns, codes = solved(target, rows)
    assert codes.tolist() == [0, 1] and target.reasons == REASONS
    assert np.isfinite(columns["friction_torque"][0]) and np.isnan(columns[LOST][1])


def test_figures_have_units_and_usual_ranges_and_can_be_chosen():
    target = target_of(WASHER, {"load": "5 %"}, outputs=["temperature_max", "stick_margin"])
    hottest, margin = target.figures
    assert (hottest.unit, hottest.high, margin.low) == ("K", 523.0, 1.0)
    assert len(target.nominal()) == 3
    with pytest.raises(ParameterError, match="did you mean 'film_ratio'"):
        target_of(WASHER, {"load": "5 %"}, outputs=["film_ration"])


@pytest.mark.parametrize(
    ("more", "words"),
    [({"reached": "up"}, "'below' or 'above'"), ({"inputs": {"lod": 1.0}}, "allowed: load")],
)
def test_a_wrong_argument_is_named(more, words):
    with pytest.raises(ParameterError, match=words):
        target_of(WASHER, {"load": "5 %"}, **more)


def test_the_nominal_run_is_the_part_itself_and_its_error_its_own():
    target = target_of(WASHER, {"roughness": "5 %"})
    own = WASHER.solve()
    assert target.nominal()[0] == pytest.approx(own.friction_torque, rel=1e-6)
    assert target.evaluator.error().get("friction_torque") == own.error_estimate


def test_a_target_goes_to_workers_and_knows_what_makes_it_another():
    target = target_of(WASHER, {"roughness": "5 %"})
    sent = pickle.loads(pickle.dumps(target))
    assert sent.identity == target.identity and np.array_equal(sent.nominal(), target.nominal())
    others = [
        target_of(WASHER, {"roughness": "5 %"}, "above"),
        target_of(WASHER, {"roughness": "5 %"}, inputs={"load": 400.0}),
        target_of(replace(WASHER, parameters={"roughness": 6e-7}), {"roughness": "5 %"}),
        target_of(WASHER, {"roughness": "5 %"}, outputs=["film_ratio"]),
    ]
    assert all(other.identity != target.identity for other in others)


# What is said of a study


def test_what_a_single_solve_warns_of_is_said_of_the_nominal_and_the_base_runs():
    clutch = find_part("clutch")
    inputs = {**clutch.starts, "load": 2000.0, "speed": 30.0}
    target = target_of(clutch, {"friction_scale": "6 %"}, inputs=inputs)
    base, _ = target.solve(rows_of(target, 8), np.ones(8, bool))
    names = [f.name for f in target.figures]
    nominal, runs = target.evaluator.doubts(names, base[:, : len(names)])
    assert nominal.startswith("nominal run: at worst temperature = ") and "250 degC" in nominal
    assert runs.startswith("8 of 8 base runs, at worst temperature = ")
    assert "load = 2 kN" in target.notes[0] and repr(target.evaluator.fidelity) in target.notes[0]


def test_a_refused_draw_says_which_value_does_not_go_together():
    mesh = find_part("gearmesh")
    target = target_of(mesh, {"addendum": {"uniform": [0.5, 1.0]}})
    row = {"addendum": 0.4}
    assert target.solve([row], np.ones(1, bool))[1].tolist() == [1]
    assert "addendum" in target.evaluator.why(row) and "allowed" in target.evaluator.why(row)
    assert target.evaluator.why({"addendum": 1.0}) == ""
