"""A running FMU: numbers of the kernels, dependencies, lazy outputs, instances side by side."""

import os
import random
import shutil
import time

import pytest
from toy.places import TOY_START
from toy.spec import SPEC as TOY

from thrustwasher.errors import ParameterError
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.running.core import Core, Mode
from thrustwasher.fmu.running.loading import IN_USE, KEPT, prune
from thrustwasher.fmu.stepper import DirectInstance, Instance, unpack

H = 1e-3


def points(n, seed=1):
    rng = random.Random(seed)
    return [[rng.uniform(0, 8000), rng.uniform(-900, 900), rng.uniform(240, 470)] for _ in range(n)]


def test_outputs_are_valid_after_the_initialization(toy, direct_toy):
    assert toy.outputs() == direct_toy.outputs()
    assert toy.get(["temperature", "time"]) == [310.0, 0.0]


def test_the_fmu_and_the_kernels_agree_to_the_bit(toy, direct_toy):
    for i, point in enumerate(points(200)):
        for instance in (toy, direct_toy):
            instance.set_inputs(point)
            instance.step(i * H, H)
        assert toy.outputs() == direct_toy.outputs()


def test_readings_never_change_what_follows(toy_fmu):
    results = []
    for readings in (0, 3):
        with Instance(toy_fmu) as fmu:
            fmu.initialize(inputs=TOY_START)
            for i, point in enumerate(points(50)):
                fmu.set_inputs(point)
                for _ in range(readings):
                    fmu.outputs()
                fmu.step(i * H, H)
            results.append(fmu.outputs())
    assert results[0] == results[1]


@pytest.mark.parametrize("name", [s.name for s in TOY.inputs])
def test_an_input_moves_exactly_the_outputs_that_list_it(name, toy):
    before = toy.outputs()
    values = {**TOY_START, "speed": 40.0, "load": 600.0}
    toy.set_inputs(list(values.values()))
    before = toy.outputs()
    values[name] = {"load": 9600.0, "speed": 60.0, "oil_temperature": 320.0}[name]
    toy.set_inputs(list(values.values()))
    try:
        after = toy.outputs()
    except Exception:  # the load is beyond the toy's range: its status is what moves
        after = [*before[:-1], toy.get(["solver_status"])[0]]
        values["load"] = 8000.0
        toy.set_inputs(list(values.values()))
        after = [*toy.outputs()[:-1], after[-1]]
    moved = {n for n, a, b in zip(toy.output_names, before, after, strict=True) if a != b}
    assert moved == {v.name for v in interface(TOY).variables if name in v.depends}


def test_an_output_is_solved_at_most_once_per_change(direct_toy, monkeypatch):
    core, solved = direct_toy.core, []
    solve = core._solve
    monkeypatch.setattr(core, "_solve", lambda h: (solved.append(h), solve(h))[1])
    for _ in range(3):
        direct_toy.outputs()
    direct_toy.set_inputs([1.0, 2.0, 300.0])
    direct_toy.set_inputs([3.0, 2.0, 300.0])
    for _ in range(3):
        direct_toy.outputs()
    direct_toy.set_inputs([3.0, 2.0, 300.0])  # nothing changes
    direct_toy.outputs()
    direct_toy.step(0.0, H)
    direct_toy.outputs()
    assert solved == [0.0, H]


def test_parameters_by_name_and_by_item(toy_fmu):
    given = {"discs": 4, "law": "dry", "fidelity": "fine", "dry": True, "inner_radius": 0.04}
    with Instance(toy_fmu, parameters=given) as fmu:
        fmu.initialize(inputs=TOY_START)
        assert fmu.get(list(given)) == [4.0, 2.0, 2.0, 1.0, 0.04]
        direct = DirectInstance(TOY, parameters=given)
        direct.initialize(inputs=TOY_START)
        assert fmu.outputs() == direct.outputs()
        assert direct.get(list(given)) == [4.0, 2.0, 2.0, 1.0, 0.04]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"disc": 2}, "did you mean discs"),
        ({"law": "wet"}, "allowed: viscous, dry"),
        ({"discs": 2.5}, "whole number"),
        ({"discs": 50}, "discs = 50 is outside 1 .. 20"),
        ({"inner_radius": 2.0}, r"inner_radius = 2 m is outside 0.001 .. 1 m"),
    ],
)
def test_wrong_parameters_are_refused_by_name(given, message, toy_fmu):
    with pytest.raises(ParameterError, match=message):
        Instance(toy_fmu, parameters=given)


def test_reset_gives_a_fresh_run_with_the_same_parameters(toy_fmu):
    results = []
    with Instance(toy_fmu, parameters={"discs": 5}) as fmu:
        for _ in range(3):
            fmu.initialize(inputs=TOY_START)
            for i, point in enumerate(points(10)):
                fmu.set_inputs(point)
                fmu.step(i * H, H)
            results.append(fmu.outputs())
            fmu.reset()
    assert results[0] == results[1] == results[2]


def test_instances_do_not_touch_each_other(toy_fmu):
    with Instance(toy_fmu) as one, Instance(toy_fmu, parameters={"discs": 9}) as two:
        one.initialize(inputs=TOY_START)
        two.initialize(inputs=TOY_START)
        before = two.outputs()
        one.set_inputs([9.0, 9.0, 300.0])
        one.step(0.0, H)
        assert two.outputs() == before
        one.close()
        assert two.outputs() == before


def test_the_start_time_is_kept_and_steps_may_vary(toy_fmu):
    with Instance(toy_fmu) as fmu:
        fmu.initialize(5.0, TOY_START)
        fmu.step(5.0, 1e-3)
        fmu.step(5.001, 4e-3)
        assert fmu.get(["time"]) == [5.005]
        assert fmu.warnings == []
        fmu.step(7.0, 1e-3)
        assert "the host's time counts" in fmu.warnings[0]


def test_calls_and_times_are_counted(toy):
    for i in range(3):
        toy.step(i * H, H)
    assert toy.calls == 3
    assert min(toy.wall_time, toy.instantiate_time, toy.initialize_time) > 0.0


def test_an_fmu_is_unpacked_once_per_content(toy_fmu, tmp_path):
    copy = tmp_path / "ToyClutch.fmu"
    copy.write_bytes(toy_fmu.read_bytes())
    assert unpack(copy) == unpack(toy_fmu)
    with pytest.raises(ParameterError, match="build it first"):
        unpack(tmp_path / "none.fmu")


def test_the_cache_keeps_what_is_new_or_among_the_last_used(tmp_path):
    for i in range(KEPT + 5):
        folder = tmp_path / f"old-{i:02}"
        folder.mkdir()
        (folder / "modelDescription.xml").write_text("")
        age = (i + 1) * IN_USE if i else 0.0
        os.utime(folder, (time.time() - age - 60.0,) * 2)
    for i in range(5):
        (tmp_path / f"new-{i}").mkdir()
    prune(tmp_path)
    left = {p.name for p in tmp_path.iterdir()}
    assert left == {f"old-{i:02}" for i in range(KEPT - 5)} | {f"new-{i}" for i in range(5)}
    for folder in tmp_path.iterdir():  # used today: however many, none goes
        os.utime(folder)
    for i in range(KEPT):
        (tmp_path / f"more-{i}").mkdir()
    prune(tmp_path)
    assert len(list(tmp_path.iterdir())) == 2 * KEPT


def test_an_emptied_cache_is_filled_again(toy_fmu, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    copy = tmp_path / "ToyClutch.fmu"
    copy.write_bytes(toy_fmu.read_bytes())
    folder = unpack(copy)
    assert folder.is_relative_to(tmp_path)
    shutil.rmtree(folder)
    assert unpack(copy) == folder and (folder / "modelDescription.xml").is_file()
    assert [p.name for p in folder.parent.iterdir()] == [folder.name]  # nothing half unpacked


def test_the_core_solves_what_the_kernel_solves():
    from toy import kernel

    core = Core(interface(TOY))
    core.mode = Mode.STEPPING
    core.set([1, 2, 3], [500.0, 20.0, 310.0], "Real")
    core.advance(0.0, H)
    par, out, iout = core.par.copy(), core.out * 0.0, core.iout * 0
    assert kernel.derive(par) == 0
    state, work = core.state * 0.0, core.work * 0.0
    assert kernel.step(par, core.inp, state, work, out, iout, 0.0, H) == 0
    assert out.tolist() == core.out.tolist() and state.tolist() == core.state.tolist()
