"""A shift as a study runs it: washers apart from the loop, against full runs."""

import pickle
from dataclasses import replace

import numpy as np
import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.fmu.fmu_cache import fmu_paths
from thrustwasher.fmu.stepper import Instance
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.scene.places import scene_scatter
from thrustwasher.shift.scene.variation import varied_scene
from thrustwasher.studio.evaluators import scene as module
from thrustwasher.studio.evaluators import scene_shortcut
from thrustwasher.studio.evaluators.scene import OF_WASHERS, scene_evaluator
from thrustwasher.studio.scatter.target import target_of

LONG = 5e-3  # s, a step that keeps full runs short


@pytest.fixture(scope="module")
def target():
    """Return the default scene with long steps, compared with a few full runs only."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "FULL_RUNS", 2)
        patch.setattr(scene_shortcut, "FULL_RUNS", 2)
        scene = load_scene("planetary").with_options(step=LONG)
        yield target_of(scene_evaluator(scene), scene_scatter(scene))


@pytest.fixture(scope="module")
def rows(target):
    """Return four draws."""
    return target.scatter.values(np.random.default_rng(1).random((4, len(target.scatter.names))))


def column(target, answers, name):
    return answers[:, [f.name for f in target.figures].index(name)]


@pytest.mark.slow
def test_its_figures_are_those_of_full_runs(target, rows):
    """Runs with fresh instances; the band is that of the draws."""
    answers, codes = target.solve(rows, np.ones(4, bool))
    full, paths = (
        [],
        fmu_paths({p.spec.name for p in target.evaluator.scene.parts.values()}, "native"),
    )
    for row in rows:
        scene = varied_scene(target.evaluator.scene, row)
        parts = {
            n: Instance(paths[p.spec.name], parameters=p.parameters())
            for n, p in scene.parts.items()
        }
        full.append(cosimulate(scene, parts).figures)
        for part in parts.values():
            part.close()
    assert not codes.any()
    for name in full[0].keys() & {f.name for f in target.figures}:
        known, found = np.array([f[name] for f in full]), column(target, answers, name)
        assert np.abs(found - known).max() <= 0.05 * np.ptp(known) + 1e-6 * np.abs(known).max(), (
            name
        )


def test_the_error_of_the_shortcut_is_said(target):
    assert 0.0 < max(target.evaluator.shortcut.values()) < module.SHARE
    assert "compared with 2 full runs this errs by at most" in target.notes[0]
    assert target.warnings == ()


def test_what_decides_on_washers_alone_touches_nothing_else(target, rows):
    alone = [n for n in target.scatter.names if not target.evaluator.touches(n)]
    assert alone == ["transmission.thrust_share", "transmission.planet_tilt"] + [
        n for n in target.scatter.names if n.startswith("washer.")
    ]
    assert set(alone[:2]) < set(OF_WASHERS)
    other = [rows[0] | {name: rows[1][name] for name in alone}]
    a, b = (target.solve(some, np.zeros(1, bool))[0] for some in (rows[:1], other))
    assert np.array_equal(a, b, equal_nan=True)


def test_runs_that_are_not_costly_lack_the_washers_figures_alone(target, rows):
    cheap, costly = (target.solve(rows[:1], np.array([own]))[0][0] for own in (False, True))
    names = [f.name for f in target.figures] + list(target.outcomes)
    names += [name for name in target.series for _ in target.time]
    lack = {name for name, x in zip(names, cheap, strict=True) if np.isnan(x)}
    assert lack == {*target.costly, "film_lost", "washer.friction_torque", "washer.film_ratio"}
    assert np.isfinite(costly).all()


@pytest.mark.slow
def test_answers_depend_on_the_batch_alone(target, rows):
    own = np.array([True, False, True, False])
    batch = [rows[0], rows[0] | {"clutch.friction_scale": 0.9}, rows[2], rows[3]]
    first, again = target.solve(batch, own), target.solve(batch, own)
    sent = pickle.loads(pickle.dumps(target)).solve(batch, own)
    for other in (again, sent):
        assert np.array_equal(first[0], other[0], equal_nan=True)
    apart = [target.solve(batch[i : i + 2], own[i : i + 2])[0] for i in (0, 2)]
    assert np.array_equal(first[0], np.concatenate(apart), equal_nan=True)


def test_washers_of_a_costly_run_serve_those_with_the_same_washers(target, rows):
    """The run of the batch's first washers is the nearer to the costly one of the same values."""
    answers, _ = target.solve([rows[0], rows[0]], np.array([True, False]))
    alone, _ = target.solve([rows[0]], np.array([False]))
    lock = [column(target, a, "lock_time") for a in (answers, alone)]
    assert lock[0][0] == lock[0][1] != lock[1][0]


def test_a_run_without_lock_up_has_no_time_of_it(target):
    row = {"pressure.clutch.scale": 0.3}
    (answer,), (code,) = target.solve([row], np.array([False]))
    assert code == 0 and np.isnan(column(target, answer[None], "lock_time"))
    assert answer[len(target.figures) + target.outcomes.index("no_lock_up")] == 1.0


def test_values_that_do_not_go_together_are_a_named_failure(target):
    answers, codes = target.solve(
        [{"transmission.planet_tilt": 0.02}, {"oil_temperature": 350.0}], np.zeros(2, bool)
    )
    assert target.reasons[codes[0] - 1] == "the values do not go together" and codes[1] == 0
    assert np.isnan(answers[0]).all() and np.isfinite(answers[1, 0])


def test_a_run_without_end_is_a_named_failure_and_leaves_no_trace(target, rows):
    wild = {"engine.torque_scale": 90.0, "pressure.clutch.scale": 0.02}
    alone, _ = target.solve(rows[:1], np.array([False]))
    answers, codes = target.solve([wild, rows[0]], np.zeros(2, bool))
    assert target.reasons[codes[0] - 1] == "the shift could not be run" and codes[1] == 0
    assert np.array_equal(answers[1], alone[0], equal_nan=True)


@pytest.mark.slow
def test_some_outputs_can_be_asked_for(target):
    some = target_of(target.evaluator, replace(target.scatter, sources=()), ["lock_time"])
    assert [f.name for f in some.figures] == ["lock_time"] and some.series == ()
    assert some.nominal()[0] == column(target, target.nominal()[None], "lock_time")
    with pytest.raises(ParameterError, match=r"lock_tim.*did you mean 'lock_time'"):
        target_of(target.evaluator, target.scatter, ["lock_tim"])


@pytest.mark.slow
def test_where_the_shortcut_errs_too_much_all_runs_are_full(target, rows, monkeypatch):
    full = pickle.loads(pickle.dumps(target))
    monkeypatch.setattr(module, "SHARE", 0.0)
    names = [f.name for f in full.figures]
    full.evaluator._learn(np.ones(len(names)), np.ones(len(names)), names)
    assert full.costly == () and full.evaluator.touches("washer.roughness")
    assert full.warnings[0].endswith("so that all runs are full ones") and full.notes == ()
    answers, codes = full.solve(rows[:1], np.array([False]))
    assert codes[0] == 0 and np.isfinite(answers).all()


def test_numerical_errors_of_the_step_and_of_the_washers_mesh_are_known(target):
    found = target.evaluator.error()
    of_the_shift = {"lock_time", "lock_after_ramp_start", "slip_energy", "slip_energy_per_area"}
    assert set(found) == of_the_shift | {"peak_jerk", "washer_torque"}
    assert all(0.0 < x < 0.5 for x in found.values())


def test_several_shifts_are_refused():
    with pytest.raises(ParameterError, match=r"it has a \[sequence\]"):
        scene_evaluator(load_scene("duty-cycle"))


def test_usual_ranges_and_units_are_those_of_the_report(target):
    known = {f.name: f for f in target.figures}
    assert (known["flare"].unit, known["flare"].high) == ("rad/s", pytest.approx(5.236, rel=1e-3))
    assert known["minimum_pitting_safety"].low == 1.0 and known["peak_flash_rise"].relative
