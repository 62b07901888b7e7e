"""Rungs asked for by tolerance: words, scout runs, choices, and the run they lead to."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import PetroffWasher

from thrustwasher.drivetrain import load_scene, run_auto, selection, with_fidelities
from thrustwasher.drivetrain.budget import LOOK, SHARE, first_look, strides
from thrustwasher.drivetrain.scout import MARGIN, Pool, scout
from thrustwasher.drivetrain.selection import above
from thrustwasher.drivetrain.step_share import step_share
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fidelity.choose import Choice
from thrustwasher.fmu.direct import DirectInstance
from thrustwasher.models import clutch_params, gearmesh_params, washer_params

STOP = 0.2


def made(log):
    """Return a maker of instances that writes down what it made; the washer is a stand-in."""

    def make(name, part):
        log.append((name, part.fidelity))
        if name == "washer":
            return PetroffWasher(part.spec)
        return DirectInstance(part.spec, parameters=part.parameters())

    return make


def auto(*wishes, stop=STOP):
    return with_fidelities(load_scene("planetary").with_options(stop_time=stop), wishes)


def test_a_scene_file_asks_for_all_parts_and_for_one(tmp_path):
    file = tmp_path / "s.toml"
    file.write_text('base = "planetary"\nfidelity = "auto:0.02"\n[mesh]\nfidelity = "closed"\n')
    found = {n: (p.fidelity, p.tolerance) for n, p in load_scene(file).parts.items()}
    assert found == {
        "transmission": ("rigid", None), "clutch": ("field", 0.02), "brake": ("field", 0.02),
        "washer": ("field", 0.02), "mesh": ("closed", None),
    }  # fmt: skip


def test_auto_alone_is_one_percent():
    assert auto("auto").parts["washer"].tolerance == 0.01


def test_later_wishes_overrule_earlier_ones():
    parts = auto("auto:0.02", "mesh=closed", "clutch=auto:0.1").parts
    assert parts["mesh"].fidelity == "closed" and parts["mesh"].tolerance is None
    assert (parts["brake"].tolerance, parts["clutch"].tolerance) == (0.02, 0.1)
    assert auto("auto", "field").parts == load_scene("planetary").with_options(
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
    assert above(gearmesh_params.SPEC, "closed") == "field"
    assert above(clutch_params.SPEC, "boundary") == "field"
    assert above(washer_params.SPEC, list(washer_params.SPEC.fidelities)[-1]) is None


def scouted(wish="auto:0.01"):
    log = []
    scene = auto(wish)
    return scout(scene, Pool(made(log))), log


def test_scouts_take_cheap_rungs_for_what_drags_and_leave_the_packs_theirs():
    _, log = scouted()
    rungs = dict(log)
    assert rungs["clutch"] == rungs["brake"] == "field"
    assert rungs["mesh"] in ("stribeck", "closed")


def test_scouts_make_long_steps_and_use_instances_again():
    found, log = scouted()
    assert (found.coarse.step, found.fine.step) == (pytest.approx(4e-3), pytest.approx(2e-3))
    assert [n for n, _ in log].count("clutch") == 1


def test_the_box_is_what_was_seen_and_a_fifth_on_each_side_where_legal():
    found, _ = scouted()
    box = found.box("washer", washer_params.SPEC)
    seen = np.concatenate([r.signals["washer.speed"] for r in (found.coarse, found.fine)])
    more = MARGIN * np.ptp(seen)
    assert box["speed"] == pytest.approx((seen.min() - more, seen.max() + more))
    assert box["tilt"] == (1.6e-3, 1.6e-3) and box["oil_temperature"] == (297.15, 297.15)
    assert found.box("clutch", clutch_params.SPEC)["load"][0] == 0.0, "a load is not negative"


def test_the_steps_error_is_estimated_from_above():
    """At first order the truth lies as far from the fine scout as that from the coarse one."""
    found, _ = scouted()
    share = step_share(found, 1e-3, 0.01)
    change = [
        abs(a / b - 1.0)
        for name in ("washers", "meshes")
        for a, b in [(found.coarse.energy[name], found.fine.energy[name])]
    ]
    assert share.error >= 0.5 * max(change) * (1.0 - 1e-9)
    assert share.suffices == (share.error <= 0.003)
    assert step_share(found, 0.5e-3, 0.01).error == pytest.approx(0.5 * share.error)


def test_a_step_too_long_for_the_tolerance_is_said_with_one_that_would_do():
    found, _ = scouted()
    words = step_share(found, 1e-3, 1e-6).words()
    assert "more than its share of 3e-05 %" in words and "would do" in words


def test_looks_stay_within_their_share_of_the_run():
    few, many = strides(10e-6, 2e-6, 300e-6)
    assert (300e-6 + LOOK) / few <= SHARE * 10e-6
    assert (2e-6 + LOOK) / many <= SHARE * 308e-6
    assert strides(10e-6, 2e-6, 300e-6, guards=2)[0] in (2 * few, 2 * few - 1)
    assert strides(10e-6, 2e-6, 300e-6, far=8.0)[0] > 7 * few


def test_a_run_too_quick_for_its_share_is_looked_at_once_all_the_same():
    assert first_look(1500, 15_000) == 300
    assert first_look(1500, 40) == 40
    assert first_look(2, 15_000) == 1


def run(monkeypatch, fidelity="closed", outside=None, **options):
    """Run with a choice for the mesh that is made up, and no cards for the rest."""
    asked = []

    def fresh(model, rung, params):
        return ("card",) if model == "gearmesh" else ()

    def choose(model, box, **given):
        asked.append((model, box, given))
        return Choice(fidelity, 1e-3, 1e-6, (f"{model}: {fidelity}, made up", "why not"), outside)

    monkeypatch.setattr(selection, "fresh_cards", fresh)
    monkeypatch.setattr(selection, "choose", choose)
    return run_auto(auto("auto:0.01", "washer=field"), made([]), **options), asked


def test_the_chooser_is_asked_once_for_the_scouted_box_and_the_rungs_share(monkeypatch):
    r, asked = run(monkeypatch)
    ((model, box, given),) = asked
    assert model == "gearmesh" and set(box) == {"load", "speed", "oil_temperature"}
    assert given["tol"] == pytest.approx(0.006) and given["n_calls"] == 200
    assert given["params"] == r.scene.parts["mesh"].params
    assert r.scene.parts["mesh"].fidelity == "closed"


def test_every_part_says_why(monkeypatch):
    words = run(monkeypatch)[0].selection.words()
    assert "mesh: closed, made up" in words and "  why not" in words
    assert any(w.startswith("clutch: field, its default: no card") for w in words)
    assert "communication step 1 ms" in words[-1]


def test_a_choice_that_does_not_hold_is_replaced_by_the_guard(monkeypatch):
    r, _ = run(monkeypatch)
    assert [p.part for p in r.guard.posts] == ["mesh"]
    assert [s.after for s in r.guard.switches] == ["field"]
    assert r.guard.posts[0].worst > 0.006


def test_without_guard_the_choice_stands(monkeypatch):
    r, _ = run(monkeypatch, guard=False)
    assert r.guard is None and r.selection is not None
    assert [c.fidelity for c in r.cost if c.part == "mesh"] == ["closed"]


def test_a_run_repeats_to_the_bit(monkeypatch):
    a, b = (run(monkeypatch)[0] for _ in range(2))
    assert a.guard.switches == b.guard.switches
    assert all(np.array_equal(a.signals[n], b.signals[n]) for n in a.signals)


def test_what_no_rung_holds_is_an_error_that_names_the_part(monkeypatch):
    def refuse(*_, **__):
        raise SolveError("gearmesh: no rung reaches 0.006")

    monkeypatch.setattr(selection, "fresh_cards", lambda *_: ("card",))
    monkeypatch.setattr(selection, "choose", refuse)
    with pytest.raises(SolveError, match="part 'mesh', friction_torque: gearmesh: no rung"):
        run_auto(auto("mesh=auto:0.01"), made([]))


def test_a_scene_without_wishes_runs_as_it_stands():
    r = run_auto(auto("field"), made([]))
    assert r.selection is None and r.guard is None


def test_a_tolerance_asked_for_leaves_nothing_open_in_the_result(monkeypatch):
    r, _ = run(monkeypatch)
    assert all(p.tolerance is None for p in r.scene.parts.values())
    told = r.as_dict()
    assert told["selection"]["parts"][0]["part"] == "clutch"
    assert replace(r, selection=None).as_dict()["selection"] is None
