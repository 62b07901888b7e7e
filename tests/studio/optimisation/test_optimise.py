"""Whole searches: known answers, the same ones on any cores and after a stop, named failures."""

import csv
from dataclasses import replace

import numpy as np
import pytest
from bowls import BUDGET, LEAST, Bowl
from stopping import Stop, stopping_after

from thrustwasher import ClutchParams, load_part, optimise
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.model.part_file import find_part
from thrustwasher.studio.optimisation import robust_search
from thrustwasher.studio.optimisation import whole_search as module
from thrustwasher.studio.optimisation.whole_search import JOURNAL

BOX = {"x": "-1:1", "y": "-1:1"}
CLUTCH = {
    "vary": {"land_share": "0.5:0.95", "friction_scale": "0.8:1.2"},
    "at": {"load": 9000.0, "speed": 5.0},
}


@pytest.fixture
def bowl(monkeypatch):
    """Let ``optimise`` search in a bowl."""

    def made(**options):
        monkeypatch.setattr(module, "designs_of", lambda *_: Bowl(**options))
        monkeypatch.setattr(module, "budget_of", lambda *_: BUDGET)

    made()
    return made


@pytest.mark.parametrize("sloped", [True, False])
def test_the_least_of_a_bowl(bowl, sloped):
    bowl(sloped=sloped)
    found = optimise("bowl", vary=BOX, minimise="bowl", workers=1)
    assert tuple(found.best.values.values()) == pytest.approx(LEAST, abs=2e-3)
    assert found.start["bowl"] == pytest.approx(0.36 + 2.0 * 1.69) and not found.binding


def test_a_search_whose_best_design_lives_on_the_steps_error_is_made_again(bowl, tmp_path):
    bowl(step=1.0)
    found = optimise("bowl", vary=BOX, minimise="bowl", out=tmp_path / "o", workers=1)
    assert found.best.values["x"] == pytest.approx(LEAST[0] + 0.5 * 0.0625, abs=2e-3)
    again = "searched again with shorter ones"
    expected = (f"a step of 1 errs: {again}", f"a step of 0.25 errs: {again}")
    assert found.notes == (*expected, "a step of 0.0625 errs")
    assert not list((tmp_path / "o").glob("*.journal"))
    bowl(step=0.0625)
    assert optimise("bowl", vary=BOX, minimise="bowl", workers=1).tries < found.tries / 2


def test_a_step_that_stays_too_long_is_reported(bowl):
    bowl(step=16.0)
    found = optimise("bowl", vary=BOX, minimise="bowl", workers=1)
    assert len(found.notes) == 2 and "1 errs; it may do so in its favour" in found.warnings[-1]


def test_a_search_with_shorter_steps_that_finds_nothing_leaves_what_was_found(bowl, tmp_path):
    """The limit can be met by the step's error alone."""
    bowl(step=0.25)
    given = {"minimise": "sum", "limits": ["bowl<=-0.08"], "workers": 1}
    found = optimise("bowl", vary=BOX, out=tmp_path, **given)
    (warning,) = found.warnings
    assert warning.startswith("a step of 0.25 errs; with steps of 62.5 ms nothing is found: ")
    assert found.best.figures["bowl"] <= -0.08 and (tmp_path / "best.toml").exists()


def test_journals_of_a_search_that_is_given_up_do_not_stop_another(bowl, tmp_path):
    (tmp_path / f"2-{JOURNAL}").write_text("of another search")
    bowl(step=0.25)
    optimise("bowl", vary=BOX, minimise="bowl", out=tmp_path, workers=1)
    assert not list(tmp_path.glob("*.journal"))


def test_limits_and_ends_that_bind_are_named(bowl):
    found = optimise("bowl", vary={"x": "-1:0", "y": "-1:1"}, minimise="bowl", limits=["sum>=0.5"])
    assert found.binding == ("sum >= 0.5", "x <= 0")
    assert found.best.values == pytest.approx({"x": 0.0, "y": 0.5}, abs=1e-3)


def test_the_front_of_two_bowls_is_the_line_between_them(bowl):
    found = optimise("bowl", vary=BOX, minimise=["bowl", "other"], points=9, workers=1)
    assert len(found.front) == 9
    x = [d.values["x"] for d in found.front]
    assert x == sorted(x, reverse=True) and min(x) < -0.65 and max(x) > 0.28
    assert all(abs(d.values["y"] - LEAST[1]) < 0.03 for d in found.front)
    assert found.best in found.front


@pytest.mark.parametrize("sloped", [True, False])
def test_a_limit_that_cannot_be_met_is_named_with_the_nearest(bowl, sloped):
    bowl(sloped=sloped)
    words = r"sum >= 3 cannot be met: 2 is the nearest found with bowl <= 9, at x = 1, y = 1"
    with pytest.raises(SolveError, match=words):
        optimise("bowl", vary=BOX, minimise="bowl", limits=["sum>=3", "bowl<=9"], workers=1)


def test_the_start_is_the_target_as_it_is_also_outside_the_ranges(bowl):
    found = optimise("bowl", vary={"x": "-1:0", "y": "-1:0"}, minimise="bowl", workers=1)
    assert found.start["bowl"] == pytest.approx(0.36 + 2.0 * 1.69)


def test_a_best_design_that_is_none_when_solved_again_is_named(bowl, monkeypatch):
    evaluate = Bowl.evaluate

    def gone(self, rows, figures, effort="search"):
        found = evaluate(self, rows, figures)
        return found._replace(values=np.nan * found.values) if effort == "shown" else found

    monkeypatch.setattr(Bowl, "evaluate", gone)
    with pytest.raises(SolveError, match="the best design has no bowl when it is solved again, at"):
        optimise("bowl", vary=BOX, minimise="bowl", workers=1)


def test_what_is_off_when_solved_again_is_made_up_for(bowl, monkeypatch):
    evaluate = Bowl.evaluate
    shift = [[0.0, 0.1]]  # bowl, sum

    def off(self, rows, figures, effort="search"):
        found = evaluate(self, rows, figures)
        if effort != "shown" or "sum" not in figures:
            return found
        return found._replace(values=found.values - np.array(shift)[:, : len(figures)])

    monkeypatch.setattr(Bowl, "figures", {n: f for n, f in Bowl.figures.items() if n != "other"})
    monkeypatch.setattr(Bowl, "evaluate", off)
    found = optimise("bowl", vary=BOX, minimise="bowl", limits=["sum>=0.5"], workers=1)
    assert 0.5 <= found.best.figures["sum"] < 0.51


def test_tightened_limits_that_cannot_be_met_leave_the_design_that_was_found(bowl, monkeypatch):
    def far(problem, uniforms, draws, share):
        return {(1e-9,)} if len(draws) == 512 else {(0.5,)}

    monkeypatch.setattr(robust_search, "critical", far)
    limits = ["sum>=1.5"]
    found = optimise("bowl", vary=BOX, minimise="bowl", limits=limits, robust=0.95, workers=1)
    assert found.share.value < 0.95 and found.best.figures["sum"] >= 1.5
    assert any("cannot be tightened (sum >= 1.5 cannot be met" in w for w in found.warnings)


def test_figures_that_no_design_has_are_named(bowl):
    bowl(gone=-2.0)
    with pytest.raises(SolveError, match="none of 9 designs has bowl"):
        optimise("bowl", vary=BOX, minimise="bowl")


@pytest.mark.parametrize("sloped", [True, False])
def test_a_robust_design_keeps_its_distance_from_a_limit(bowl, sloped):
    """x scatters by 0.1 about its value: at 95 % the sum has to keep 0.164 from its limit."""
    bowl(sloped=sloped)
    found = optimise("bowl", vary=BOX, minimise="bowl", limits=["sum>=0.5"], robust=0.95, workers=1)
    assert found.best.figures["sum"] == pytest.approx(0.5 + 1.645 * 0.1, abs=0.03)
    assert found.share.low <= 0.95 <= found.share.high or found.share.value >= 0.95
    assert found.share.draws == 512


def test_a_share_that_is_not_reached_is_said(bowl, monkeypatch):
    monkeypatch.setattr(robust_search, "critical", lambda *_: {(0.5,)})  # draws that decide nothing
    found = optimise("bowl", vary=BOX, minimise="bowl", limits=["sum>=0.5"], robust=0.95, workers=1)
    assert found.share.value < 0.95
    assert any("fresh draws meet the limits, which were tightened" in w for w in found.warnings)


@pytest.mark.parametrize(
    ("options", "words"),
    [({"points": 2}, "points = 2, allowed"), ({"seed": -1}, "seed = -1"), ({"workers": 0}, "work")],
)
def test_wrong_options_are_named(options, words):
    with pytest.raises(ParameterError, match=words):
        optimise("clutch", vary={"land_share": "0.5:0.9"}, minimise="temperature", **options)


def test_a_sequence_of_shifts_is_refused():
    with pytest.raises(ParameterError, match=r"it has a \[sequence\], allowed: one shift"):
        optimise("duty-cycle", vary={"clutch.land_share": "0.5:0.9"}, minimise="slip_energy")


def test_inputs_beside_a_scene_are_refused():
    with pytest.raises(ParameterError, match="at: is of a part's inputs"):
        optimise("planetary", vary={}, minimise="slip_energy", at={"load": 1.0})


def test_the_file_of_the_best_design_gives_its_figures(tmp_path):
    found = optimise("clutch", maximise="friction_torque", out=tmp_path, workers=1, **CLUTCH)
    part = load_part(tmp_path / "best.toml")
    again = part.solve(load=9000.0, speed=5.0)
    assert again.friction_torque == found.best.figures["friction_torque"]
    assert found.best.values["friction_scale"] == 1.2
    assert not (tmp_path / JOURNAL).exists()


def test_inputs_that_are_varied_are_the_box_of_the_file(tmp_path):
    vary = {"load": "1 kN:9 kN"}
    found = optimise(
        "clutch", vary=vary, minimise="temperature", at={"speed": 5.0}, out=tmp_path, workers=1
    )
    part = load_part(tmp_path / "best.toml")
    assert part.box["load"] == (found.best.values["load"],) * 2
    assert found.best.values["load"] == pytest.approx(1000.0, rel=1e-3)


def test_a_front_is_written_with_its_table(tmp_path):
    asked = {"minimise": "temperature", "maximise": "friction_torque", "points": 4, **CLUTCH}
    found = optimise("clutch", out=tmp_path, workers=1, **asked)
    with (tmp_path / "front.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == len(found.front) > 1
    for row, design in zip(rows, found.front, strict=True):
        assert float(row["temperature [K]"]) == design.figures["temperature"]
        assert load_part(tmp_path / row["design"]).params == ClutchParams(**design.values)


@pytest.mark.slow
def test_a_map_is_for_one_part_so_that_designs_are_solved(tmp_path):
    part = replace(find_part("washer"), fidelity="map")
    at = {"load": 300.0, "speed": 953.0, "tilt": 0.002}
    vary = {"roughness": "0.4 um:0.6 um"}
    found = optimise(part, vary=vary, minimise="friction_torque", at=at, out=tmp_path, workers=1)
    assert found.best.values["roughness"] == pytest.approx(6e-7)
    assert any("solved with 'field', as parameters are varied" in w for w in found.warnings)
    assert load_part(tmp_path / "best.toml").fidelity == "field"


@pytest.mark.slow
def test_two_processes_find_the_design_of_one():
    asked = {"minimise": "temperature", "limits": ["friction_torque>=20"], **CLUTCH}
    found = [optimise("clutch", workers=n, **asked) for n in (1, 2)]
    assert replace(found[0], wall_time=0.0).to_dict() == replace(found[1], wall_time=0.0).to_dict()


def test_a_search_that_was_stopped_goes_on_with_what_it_has_tried(bowl, tmp_path, monkeypatch):
    asked = {"vary": BOX, "minimise": "bowl", "workers": 1}
    whole = optimise("bowl", **asked)

    with pytest.raises(Stop):
        optimise("bowl", out=tmp_path, progress=stopping_after(31), **asked)
    assert (tmp_path / JOURNAL).exists()
    tried, solve = [], Bowl.gradient
    monkeypatch.setattr(Bowl, "gradient", lambda *a: (tried.append(1), solve(*a))[1])
    again = optimise("bowl", out=tmp_path, **asked)
    assert again.best.values == whole.best.values and again.tries == whole.tries
    assert len(tried) < whole.tries - 9 and not (tmp_path / JOURNAL).exists()


def test_a_stop_in_the_search_with_shorter_steps_loses_none_of_both(bowl, tmp_path, monkeypatch):
    bowl(step=0.25)
    asked = {"vary": BOX, "minimise": "bowl", "workers": 1}
    whole, searches = optimise("bowl", **asked), []

    def stop(done, _total):
        searches.extend([1] * (done == 0))
        if len(searches) == 2 and done > 30:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        optimise("bowl", out=tmp_path, progress=stop, **asked)
    assert len(list(tmp_path.glob("*.journal"))) == 2
    tried, solve = [], Bowl.gradient
    monkeypatch.setattr(Bowl, "gradient", lambda *a: (tried.append(1), solve(*a))[1])
    again = optimise("bowl", out=tmp_path, **asked)
    assert again.best.values == whole.best.values and again.tries == whole.tries
    assert len(tried) < whole.tries / 2 and not list(tmp_path.glob("*.journal"))


def test_another_search_does_not_go_on_with_it(bowl, tmp_path):
    def stop(done, _total):
        if done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        optimise("bowl", vary=BOX, minimise="bowl", out=tmp_path, progress=stop, workers=1)
    with pytest.raises(ParameterError, match="begun by another search"):
        optimise("bowl", vary=BOX, minimise="other", out=tmp_path, workers=1)


@pytest.mark.slow
def test_slopes_of_a_washer_are_those_of_its_figures():
    designs = module.designs_of("washer", {"load": 300.0, "speed": 545.0, "tilt": 0.002}, "below")
    row, names = {"roughness": 5e-7, "inner_radius": 0.0111}, ("roughness", "inner_radius")
    figures = ("friction_torque", "film_lost_load")
    values, slopes = designs.gradient(row, figures, names)
    assert values == pytest.approx(designs.evaluate([row], figures).values[0], rel=1e-5)
    for i, name in enumerate(names):
        step = 1e-3 * row[name]
        ends = [{**row, name: row[name] + side * step} for side in (1.0, -1.0)]
        found = designs.evaluate(ends, figures).values
        difference = (found[0] - found[1]) / (2.0 * step)
        assert slopes[:, i] == pytest.approx(difference, rel=0.02)
    assert designs.gradient({**row, "load": 200.0}, figures, (*names, "load")) is None


@pytest.mark.slow
def test_the_load_at_which_a_washer_loses_its_film_is_raised_to_the_ends(tmp_path):
    vary = {"roughness": "0.4 um:0.6 um", "inner_radius": "10 mm:12 mm"}
    found = optimise(
        "washer",
        vary=vary,
        maximise="film_lost_load",
        at={"speed": 545.0, "tilt": 0.002},
        workers=1,
    )
    assert found.best.values == pytest.approx({"roughness": 4e-7, "inner_radius": 0.01})
    assert found.best.figures["film_lost_load"] > 1.1 * found.start["film_lost_load"]
    assert found.tries < 25  # load curves: slopes lead there
    assert found.best.figures["temperature"] > 297.15


@pytest.mark.slow
def test_a_washer_at_a_point_is_as_good_as_a_fine_grid_says():
    vary = {"roughness": "0.3 um:1 um", "washer_thickness": "0.5 mm:2 mm"}
    at = {"load": 300.0, "speed": 953.0, "tilt": 0.002}
    found = optimise(
        "washer", vary=vary, minimise="friction_torque", limits=["film_ratio>=18"], at=at, workers=1
    )
    designs = module.designs_of("washer", at, "below")
    rows = [
        {"roughness": r, "washer_thickness": t}
        for r in np.linspace(3e-7, 1e-6, 15)
        for t in np.linspace(5e-4, 2e-3, 7)
    ]
    torque, film = designs.evaluate(rows, ("friction_torque", "film_ratio")).values.T
    assert found.best.figures["film_ratio"] >= 18.0
    assert found.best.figures["friction_torque"] <= torque[film >= 18.0].min() * (1.0 + 1e-5)
