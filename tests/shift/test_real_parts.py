"""The default shift with every model of the package in it: washer, mesh and moving films."""

from functools import cache

import numpy as np
import pytest
from scene_runs import slow_without_jit, with_all_parts

from thrustwasher.shift import load_scene, run_shift

pytestmark = slow_without_jit
STOP = 0.75  # s: past lock-up


@cache
def real(step=1e-3):
    """Return the default shift at a step, every part with its own kernels."""
    scene = load_scene("planetary-sun").with_options(step=step, stop_time=STOP)
    return run_shift(*with_all_parts(scene))


def test_all_parts_are_there_and_all_end_well():
    r = real()
    assert list(r.scene.parts) == ["transmission", "clutch", "brake", "washer", "mesh"]
    for name in r.scene.parts:
        assert np.max(r.signals[f"{name}.solver_status"]) == 0.0, name
    assert all(np.isfinite(values).all() for values in r.signals.values())


def test_the_book_closes_and_coupling_is_tight():
    e = real().energy
    assert e["residual_share"] <= 1e-6
    assert e["coupling_difference_share"] <= 1e-3
    assert e["brake_coupling_difference_share"] <= 1e-3
    assert min(e[name] for name in ("clutch", "brake", "washers", "meshes")) > 0.0
    parts = ("kinetic", "load_work", "clutch", "brake", "washers", "meshes")
    assert sum(e[n] for n in parts) + e["residual"] == pytest.approx(e["engine_work"], rel=1e-12)


@pytest.mark.slow
def test_halving_the_step_changes_little():
    coarse, fine = real().figures, real(5e-4).figures
    for name in ("slip_energy", "lock_time", "mesh_loss", "slip_energy_per_area"):
        assert coarse[name] == pytest.approx(fine[name], rel=5e-3), name
    for name in (
        "clutch_temperature",
        "washer_temperature",
        "flash_temperature",
        "mesh_temperature",
    ):
        rise = [f[f"peak_{name}"] - 297.15 for f in (coarse, fine)]
        assert rise[0] == pytest.approx(rise[1], rel=5e-3), name


def test_every_figure_of_washer_mesh_and_packs_is_found():
    r = real()
    found = {f.name: f.value for f in r.key_figures}
    for name in (
        "clutch_viscous_share",
        "peak_clutch_heat_flux",
        "brake_heat_per_area",
        "peak_flash_rise",
        "least_mesh_film_ratio",
        "stress_margin_aisi1020",
        "stress_margin_aisi4340",
        "least_washer_film_ratio",
    ):
        assert found[name] is not None, name
    assert found["stress_margin_aisi1020"] < found["stress_margin_aisi4340"]
    assert found["mesh_loss"] == r.energy["meshes"]
