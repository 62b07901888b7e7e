"""Rungs asked for by tolerance: words, trial runs, choices, and the run they lead to."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scene_runs import PetroffWasher

from thrustwasher.clutch import parameters
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.gearmesh import parameters as gearmesh_params
from thrustwasher.ladder.choose import Choice
from thrustwasher.shift import load_scene, run_auto, with_fidelities
from thrustwasher.shift.tolerance import run_to_tolerance, selection, trial_run
from thrustwasher.shift.tolerance.selection import above
from thrustwasher.shift.tolerance.trial_run import MARGIN, Pool, farthest, step_share, trial_runs
from thrustwasher.washer import parameters as washer_params

STOP = 0.2


class Biased(PetroffWasher):
    """A rung whose torque is a tenth too high."""

    def outputs(self):
        torque, *rest = super().outputs()
        return [1.1 * torque, *rest]


def made(log):
    """Return a maker of instances that writes down what it made; the washer is a stand-in."""

    def make(name, part):
        log.append((name, part.fidelity))
        if name == "washer":
            return Biased(part.spec) if part.fidelity == "coarse" else PetroffWasher(part.spec)
        return DirectInstance(part.spec, parameters=part.parameters())

    return make


def auto(*wishes, stop=STOP):
    return with_fidelities(load_scene("planetary-sun").with_options(stop_time=stop), wishes)


def test_a_scene_file_asks_for_all_parts_and_for_one(tmp_path):
    file = tmp_path / "s.toml"
    file.write_text('base = "planetary-sun"\nfidelity = "auto:0.02"\n[mesh]\nfidelity = "fine"\n')
    found = {n: (p.fidelity, p.tolerance) for n, p in load_scene(file).parts.items()}
    assert found == {
        "transmission": ("rigid", None), "clutch": ("field", 0.02), "brake": ("field", 0.02),
        "washer": ("field", 0.02), "mesh": ("fine", None),
    }  # fmt: skip


def test_auto_alone_is_one_percent():
    assert auto("auto").parts["washer"].tolerance == 0.01


def test_later_wishes_overrule_earlier_ones():
    parts = auto("auto:0.02", "mesh=fine", "clutch=auto:0.1").parts
    assert parts["mesh"].fidelity == "fine" and parts["mesh"].tolerance is None
    assert (parts["brake"].tolerance, parts["clutch"].tolerance) == (0.02, 0.1)
    assert auto("auto", "field").parts == load_scene("planetary-sun").with_options(
        stop_time=STOP
    ).parts  # fmt: skip


@pytest.mark.parametrize(
    ("wish", "text"),
    [
        ("auto:2", "auto:TOLERANCE with 1e-06 .. 0.5"),
        ("auto:", "auto:TOLERANCE"),
        ("auto:one", "for example auto:0.01"),
        ("washer=best", "part 'washer': fidelity = 'best', allowed: .*'field'.* or 'auto:TOL"),
        ("disc=field", "there is no part 'disc' here, allowed: transmission, clutch"),
    ],
)
def test_a_wish_that_cannot_be_is_named(wish, text):
    with pytest.raises(ParameterError, match=text):
        auto(wish)


def test_the_rung_to_compare_with_is_never_below_the_default():
    assert above(gearmesh_params.SPEC, "field") == "fine"
    assert above(parameters.SPEC, "closed") == "field"
    assert above(washer_params.SPEC, list(washer_params.SPEC.fidelities)[-1]) is None


def trials(wish="auto:0.01"):
    log = []
    scene = auto(wish)
    return trial_runs(scene, Pool(made(log))), log


@pytest.mark.parametrize(("cards", "rung"), [(("card",), "map"), ((), "field")])
def test_trial_runs_take_a_cheap_rung_for_the_washer_and_leave_the_others_theirs(
    monkeypatch, cards, rung
):
    monkeypatch.setattr(trial_run, "fresh_cards", lambda *_: cards)
    _, log = trials()
    assert log[:5] == [("transmission", "rigid"), ("clutch", "field"), ("brake", "field"),
                       ("washer", rung), ("mesh", "field")]  # fmt: skip


def test_one_trial_run_tries_the_finest_rungs_of_all_but_the_washer(monkeypatch):
    monkeypatch.setattr(trial_run, "fresh_cards", lambda *_: ())
    found, _ = trials()
    rungs = {n: p.fidelity for n, p in found.finest.scene.parts.items()}
    assert rungs == {"transmission": "rigid", "clutch": "fine", "brake": "fine",
                     "washer": "field", "mesh": "fine"}  # fmt: skip
    assert found.finest.step == found.coarse.step


def test_trial_runs_make_long_steps_and_use_instances_again():
    found, log = trials()
    assert (found.coarse.step, found.fine.step) == (pytest.approx(4e-3), pytest.approx(2e-3))
    assert log.count(("clutch", "field")) == 1


def test_the_box_is_what_was_seen_and_a_fifth_on_each_side_where_legal():
    found, _ = trials()
    box = found.box("washer", washer_params.SPEC)
    seen = np.concatenate([r.signals["washer.speed"] for r in (found.coarse, found.fine)])
    more = MARGIN * np.ptp(seen)
    assert box["speed"] == pytest.approx((seen.min() - more, seen.max() + more))
    assert box["tilt"] == (1.6e-3, 1.6e-3) and box["oil_temperature"] == (297.15, 297.15)
    assert found.box("clutch", parameters.SPEC)["load"][0] == 0.0, "a load is not negative"


def test_the_steps_error_is_estimated_at_first_order_from_the_worst_figure():
    found, _ = trials()
    apart, figure = farthest(found.coarse, found.fine)
    share = step_share(found, 1e-3, 0.01)
    assert (share.error, share.figure) == (pytest.approx(0.5 * apart), figure)
    assert share.suffices == (share.error <= 0.003)
    assert step_share(found, 0.5e-3, 0.01).error == pytest.approx(0.25 * apart)


def test_runs_are_apart_by_their_worst_figure():
    found, _ = trials()
    run = found.fine
    assert farthest(run, run)[0] == 0.0
    warmer = replace(run, energy={**run.energy, "meshes": 1.02 * run.energy["meshes"]})
    assert farthest(warmer, run) == (pytest.approx(0.02), "heat of the meshes")
    locked = [f._replace(value=0.15) if f.name == "lock_time" else f for f in run.key_figures]
    assert farthest(replace(run, key_figures=locked), run) == (math.inf, "lock_time")


def test_a_step_too_long_for_the_tolerance_is_said_with_one_that_would_do():
    found, _ = trials()
    words = step_share(found, 1e-3, 1e-6).words()
    assert "more than its share of 3e-05 %" in words and "would do" in words


def run(monkeypatch, fidelity="coarse", steady=True, **options):
    """Run with a choice for the washer that is made up; ``steady``: it counts as that."""
    asked = []
    if steady:
        monkeypatch.setattr(run_to_tolerance, "guarded", lambda result, *_: result)

    def choose(model, box, **given):
        asked.append((model, box, given))
        return Choice(fidelity, 1e-3, 1e-6, (f"{model}: {fidelity}, made up", "why not"))

    monkeypatch.setattr(selection, "fresh_cards", lambda *_: ("card",))
    monkeypatch.setattr(selection, "choose", choose)
    return run_auto(auto("auto:0.01"), made([]), **options), asked


def test_the_chooser_is_asked_once_for_the_box_of_the_trial_runs(monkeypatch):
    r, asked = run(monkeypatch)
    ((model, box, given),) = asked
    assert model == "washer" and list(box) == [s.name for s in washer_params.SPEC.inputs]
    assert (given["tol"], given["n_calls"]) == (0.01, 200)
    assert given["params"] == r.scene.parts["washer"].params
    assert r.selection.parts[-2].rung == "coarse"


def test_a_washer_that_is_not_steady_in_the_run_is_run_again_in_time(monkeypatch):
    r, _ = run(monkeypatch, steady=False)
    assert r.scene.parts["washer"].params.thermal_mode == "transient"
    assert r.scene.parts["washer"].fidelity == "field" and r.in_time == {}
    assert any("repeated with thermal_mode transient" in m for m in r.messages)
    assert r.step_error is not None and "thermal_mode" not in " ".join(r.warnings)
    r, _ = run(monkeypatch, steady=False, guard=False)
    assert r.scene.parts["washer"].params.thermal_mode == "quasi_steady" and r.step_error is None


def test_a_guard_stands_in_for_the_factor_of_safety(monkeypatch):
    assert run(monkeypatch)[1][0][2]["safety"] == 1.0
    assert run(monkeypatch, guard=False)[1][0][2]["safety"] == 1.5


def test_every_part_says_why(monkeypatch):
    words = run(monkeypatch)[0].selection.words()
    assert "washer: coarse, made up" in words and "  why not" in words
    for part in ("clutch", "brake", "mesh"):
        assert any(w.startswith(f"{part}: field, its default: the finest") for w in words), part
    assert "communication step 1 ms" in words[-1]


def test_a_part_asks_the_cards_if_its_finest_rung_moves_the_figures(monkeypatch):
    monkeypatch.setattr(selection, "farthest", lambda *_: (0.0061, "slip_energy"))
    _, asked = run(monkeypatch, fidelity="field", guard=False)
    assert [model for model, *_ in asked] == ["clutch"] * 4 + ["washer", "gearmesh"]
    assert {given["safety"] for model, _, given in asked if model == "clutch"} == {1.5}
    assert asked[0][2]["tol"] == pytest.approx(0.006)
    kelvin = [given["tol"] for model, _, given in asked if given["quantity"] == "temperature"]
    assert len(set(kelvin)) == 1, "the same for both packs: by the hotter one's range"


def test_a_run_repeats_to_the_bit(monkeypatch):
    a, b = (run(monkeypatch)[0] for _ in range(2))
    assert [c.worst for c in a.guard.checks] == [c.worst for c in b.guard.checks]
    assert all(np.array_equal(a.signals[n], b.signals[n]) for n in a.signals)


def test_without_a_card_the_default_serves_unchecked(monkeypatch):
    monkeypatch.setattr(selection, "fresh_cards", lambda *_: ())
    r = run_auto(auto("washer=auto:0.01"), made([]))
    assert r.scene.parts["washer"].fidelity == "field" and r.guard is None
    assert "washer: field, its default: no card" in r.selection.words()[0]


def test_what_no_rung_holds_is_an_error_that_names_the_part(monkeypatch):
    def refuse(*_, **__):
        raise SolveError("washer: no rung reaches 0.01")

    monkeypatch.setattr(selection, "fresh_cards", lambda *_: ("card",))
    monkeypatch.setattr(selection, "choose", refuse)
    with pytest.raises(SolveError, match="part 'washer', friction_torque: washer: no rung"):
        run_auto(auto("auto:0.01"), made([]))


def test_a_scene_without_wishes_runs_as_it_stands():
    r = run_auto(auto("field"), made([]))
    assert r.selection is None and r.guard is None


def test_a_tolerance_asked_for_leaves_nothing_open_in_the_result(monkeypatch):
    r, _ = run(monkeypatch)
    assert all(p.tolerance is None for p in r.scene.parts.values())
    told = r.as_dict()
    assert told["selection"]["parts"][0]["part"] == "clutch"
    assert replace(r, selection=None).as_dict()["selection"] is None


def test_trial_runs_keep_within_the_steps_a_scene_may_have():
    scene = auto("auto:0.01").with_options(step=0.01)
    found = trial_runs(scene, Pool(made([])))
    assert scene.longest_step == pytest.approx(0.015)
    assert (found.coarse.step, found.fine.step) == pytest.approx((0.1 / 7, 0.0075), rel=0.03)
