"""A shift from its scene alone: FMUs are built and freed, a study comes with it if requested."""

from contextlib import nullcontext

import pytest
from scene_runs import instances

import thrustwasher
from thrustwasher import (
    ParameterError,
    SequenceResult,
    ShiftResult,
    SolveError,
    load_scene,
    run_shift,
)
from thrustwasher.fmu.stepper import Instance
from thrustwasher.shift import cosimulate


def test_it_is_the_shift_that_instances_of_ones_own_give():
    scene = load_scene("msl")
    own = cosimulate(scene, instances(scene))
    told = []
    result = run_shift("msl", progress=lambda *now: told.append(now))
    assert told == sorted(told) and told[-1][0] == told[-1][1] > 1000
    assert isinstance(result, ShiftResult) and result.scatter is None
    assert result.figures == own.figures
    assert result.step_error is not None  # it was checked, as the command checks it


def test_a_scene_is_a_name_a_path_or_what_was_loaded(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text('base = "msl"\nstep = "2 ms"\n')
    found = [run_shift(scene).figures["lock_time"] for scene in (file, str(file))]
    found.append(run_shift("msl", step=2e-3).figures["lock_time"])
    found.append(run_shift(load_scene("msl").with_options(step=2e-3)).figures["lock_time"])
    assert len(set(found)) == 1


def test_levels_are_named_for_all_parts_or_by_part():
    coarse = run_shift("msl", fidelity="stribeck").scene.parts
    assert coarse["clutch"].fidelity == "stribeck"
    assert (
        run_shift("msl", fidelity={"clutch": "closed"}).scene.parts["clutch"].fidelity == "closed"
    )
    assert run_shift("msl", fidelity={}).scene.parts == load_scene("msl").parts


@pytest.mark.parametrize("fails", [False, True])
def test_every_fmu_is_freed(fails, monkeypatch):
    alive, real = set(), (Instance.__enter__, Instance.__exit__)

    def enter(self):
        alive.add(self)
        return real[0](self)

    def leave(self, *problem):
        alive.remove(self)
        return real[1](self, *problem)

    def stopped(scene, make, **_):
        for name, part in scene.parts.items():
            make(name, part)
        assert len(alive) == len(scene.parts)
        raise SolveError("stopped")

    monkeypatch.setattr(Instance, "__enter__", enter)
    monkeypatch.setattr(Instance, "__exit__", leave)
    if fails:
        monkeypatch.setattr("thrustwasher.shift.whole_shift.run_scene", stopped)
    with pytest.raises(SolveError, match="stopped") if fails else nullcontext():
        run_shift("msl", step=2e-3)
    assert alive == set()


@pytest.mark.slow
def test_a_scene_with_a_sequence_gives_its_result(tmp_path):
    file = tmp_path / "one.toml"
    table = 'shifts = [[0.0, "up"]]\nwindow = 1.3\n'
    file.write_text(f'base = "planetary"\nstop_time = 1.4\n[sequence]\n{table}')
    result = run_shift(file, fidelity={"washer": "map"})
    assert isinstance(result, SequenceResult) and len(result.shifts) == 1


@pytest.mark.slow
def test_a_study_is_attached():
    result = run_shift("planetary", scatter=8)
    assert result.scatter.runs == 8
    assert result.scatter.figures["lock_time"].nominal == pytest.approx(
        result.figures["lock_time"], rel=1e-6
    )
    assert result.to_dict()["scatter"]["runs"] == 8


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"scene": "planetry"}, "scene = 'planetry', allowed: .*did you mean 'planetary'"),
        ({"scene": 3}, "scene = 3, allowed: a name, the path of a file or a Scene"),
        ({"scene": "none.toml"}, "scene = 'none.toml': cannot be read"),
        ({"step": "1 ms"}, "step = '1 ms', allowed: a number of seconds"),
        ({"step": -1.0}, "step = -1.0 s, allowed: 1e-06 .. 1 s"),
        ({"fidelity": "coarse"}, "fidelity = 'coarse', allowed: 'closed'"),
        ({"fidelity": 3}, "fidelity = 3, allowed: a fidelity level"),
        ({"fidelity": {"washr": "map"}}, "no part 'washr' here, allowed: transmission"),
        ({"scatter": 3}, r"scatter = 3: allowed: a whole number 8 \.\. 131072"),
        ({"scatter": True}, "scatter = True: allowed: a whole number"),
        ({"scene": "msl", "scatter": 64}, "scatter = 64: nothing scatters in msl"),
        ({"scene": "duty-cycle", "scatter": 64}, "allowed: a scene without .sequence."),
        (
            {"scene": "duty-cycle", "fidelity": "auto"},
            "allowed with .sequence.: a fidelity level by name",
        ),
    ],
)
def test_what_is_not_allowed_is_named_before_anything_is_built(given, said, monkeypatch):
    monkeypatch.setattr("thrustwasher.shift.whole_shift.fmu_instances", lambda *_: 1 / 0)
    with pytest.raises(ParameterError, match=said):
        thrustwasher.run_shift(**given)
