"""What a run leaves behind, and what happens when it cannot run."""

import csv
import os
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scene_runs import changed, default_shift, instances, shift, slow_without_jit, with_all_parts

from thrustwasher.clutch.parameters import ClutchParams
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.key_figures.events_and_phases import find_events


def test_every_signal_of_every_part_is_kept():
    r = default_shift()
    assert len(r.time) == 1501 and r.time[-1] == 1.5
    for name, part in r.scene.parts.items():
        for signal in (*part.spec.inputs, *part.spec.outputs):
            assert r.signals[f"{name}.{signal.name}"].shape == r.time.shape
    assert all(np.isfinite(values).all() for values in r.signals.values())
    assert r.units()["transmission.clutch_speed"] == "rad/s"


def test_cost_adds_up():
    r = default_shift()
    assert [c.steps for c in r.cost] == [1500] * 5
    assert sum(c.wall_time for c in r.cost) + r.overhead == pytest.approx(r.wall_time)
    assert r.real_time_factor == pytest.approx(1.5 / r.wall_time)


def test_csv_holds_every_number_with_its_unit(tmp_path):
    default_shift().write_csv(tmp_path / "shift.csv")
    with open(tmp_path / "shift.csv", newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    assert head[0] == "time [s]" and "clutch.torque_capacity [N.m]" in head
    column = head.index("transmission.engine_speed [rad/s]")
    values = np.array([float(row[column]) for row in rows])
    assert (values == default_shift().signals["transmission.engine_speed"]).all()
    assert os.listdir(tmp_path) == ["shift.csv"]


def test_a_path_that_cannot_be_written_is_named_and_nothing_is_left(tmp_path):
    (tmp_path / "shift.csv").mkdir()
    with pytest.raises(ParameterError, match=r"path = .*shift.csv.*cannot be written"):
        default_shift().write_csv(tmp_path / "shift.csv")
    assert os.listdir(tmp_path) == ["shift.csv"]
    with pytest.raises(ParameterError, match="cannot be written"):
        default_shift().write_csv(tmp_path / "none" / "shift.csv")


def test_a_run_with_instances_for_another_master_says_so():
    scene = load_scene("msl").with_options(stop_time=0.02)
    r = cosimulate(scene, instances(scene), master="jacobi")
    assert any("made for master 'gauss-seidel'" in m for m in r.found)


def test_a_part_that_fails_is_named_with_the_time():
    scene = load_scene("planetary-sun").with_options(stop_time=0.05)
    parts = instances(scene)

    def fail(t, h):
        if t > 0.03:
            raise SolveError("not converged")

    parts["washer"].step = fail
    with pytest.raises(SolveError, match=r"washer at t = 0.031 s: not converged"):
        cosimulate(scene, parts)


def test_a_step_that_does_not_divide_the_time_is_adapted_and_said():
    r = shift("msl", stop_time=0.1, step=3e-3)
    assert len(r.time) == 35 and r.time[-1] == pytest.approx(0.1, rel=1e-15)
    assert any("34 steps" in m for m in r.messages)


def test_a_stall_is_said():
    """A command that stays at one half: both packs hold, and everything stops."""
    scene = load_scene("planetary-sun")
    scene = replace(scene, shift_start=-50.0, shift_duration=100.0)
    packs = {n: replace(scene.parts[n], params=ClutchParams(faces=40)) for n in ("clutch", "brake")}
    scene = replace(scene, parts=scene.parts | packs)
    r = cosimulate(scene, instances(scene))
    assert r.signals["transmission.engine_speed"][-1] == 0.0
    assert any("STALLED" in m for m in r.warnings)


def test_jacobi_hands_over_old_values_and_gauss_seidel_fresh_ones():
    masters = ("gauss-seidel", "jacobi")
    fresh, old = (shift("planetary-sun", stop_time=0.3, master=m) for m in masters)
    for r, lag in ((fresh, 0), (old, 1)):
        used = r.signals["transmission.clutch_torque"][2:]
        sent = r.signals["clutch.torque_capacity"][2 - lag : len(r.time) - lag]
        assert (used == sent).all()


def test_a_part_above_the_limit_of_its_temperature_is_an_event():
    scene, time = load_scene("planetary-sun"), np.array([0.0, 0.5, 1.0])
    signals = {f"{pack}.temperature": np.full(3, 300.0) for pack in ("clutch", "brake")}
    signals["clutch.temperature"] = np.array([300.0, 523.5, 530.0])
    parts = {n: scene.parts[n] for n in ("transmission", "clutch", "brake")}
    scene = replace(scene, parts=parts)
    hot = [e for e in find_events(scene, time, signals) if e.kind.endswith("hot")]
    assert hot == [(0.5, "clutch_hot", "clutch is hotter than 523 K")]


def test_progress_is_called_to_the_end():
    scene = load_scene("msl").with_options(stop_time=0.05)
    calls = []
    cosimulate(scene, instances(scene), progress=lambda done, total: calls.append((done, total)))
    assert calls[-1] == (50, 50) and len(calls) <= 101


# The default shift with every model of the package in it: washer, mesh and moving films.

STOP = 0.75  # s: past lock-up


@cache
def real():
    """Return the default shift, every part with its own kernels."""
    scene = load_scene("planetary-sun").with_options(stop_time=STOP)
    return cosimulate(*with_all_parts(scene))


@pytest.mark.slow
@slow_without_jit
def test_all_parts_are_there_and_all_end_well():
    r = real()
    assert list(r.scene.parts) == ["transmission", "clutch", "brake", "washer", "mesh"]
    for name in r.scene.parts:
        assert np.max(r.signals[f"{name}.solver_status"]) == 0.0, name
    assert all(np.isfinite(values).all() for values in r.signals.values())


@slow_without_jit
def test_the_book_closes_and_coupling_is_tight():
    e = real().energy
    assert e["residual_share"] <= 1e-6
    assert e["coupling_difference_share"] <= 1e-3
    assert e["brake_coupling_difference_share"] <= 1e-3
    assert min(e[name] for name in ("clutch", "brake", "washers", "meshes")) > 0.0
    parts = ("kinetic", "load_work", "clutch", "brake", "washers", "meshes")
    assert sum(e[n] for n in parts) + e["residual"] == pytest.approx(e["engine_work"], rel=1e-12)


@slow_without_jit
def test_every_figure_of_washer_mesh_and_packs_is_found():
    found = {f.name for f in real().key_figures if f.value is not None}
    assert found >= {"clutch_viscous_share", "peak_clutch_heat_flux", "brake_heat_per_area"}
    assert found >= {"peak_flash_rise", "minimum_mesh_film_ratio", "minimum_washer_film_ratio"}
    assert found >= {"stress_margin_aisi1020", "stress_margin_aisi4340"}


@slow_without_jit
def test_four_planets_have_their_meshes_with_sun_and_ring():
    """The ring's share is (1/18 - 1/66)/(1/18 + 1/30) of the sun's."""
    r = real()
    power = 4 * (1 + (1 / 18 - 1 / 66) / (1 / 18 + 1 / 30)) * r.signals["mesh.friction_power"]
    assert r.energy["meshes"] == pytest.approx(np.trapezoid(power, r.time), rel=5e-3)
    assert r.figures["mesh_loss"] == r.energy["meshes"]


@slow_without_jit
def test_the_lining_of_a_shift_is_looked_at(tmp_path):
    scene = changed(tmp_path, "[pressure.clutch]\npiston_area = 0.06\n")
    found = cosimulate(scene, instances(scene)).found
    assert any("clutch: load = " in text and "an organic lining" in text for text in found)
