"""The default shift with every model of the package in it: washer, mesh and moving films."""

from functools import cache

import numpy as np
import pytest
from scene_runs import changed, instances, slow_without_jit, with_all_parts

from thrustwasher.shift import cosimulate, load_scene

pytestmark = slow_without_jit
STOP = 0.75  # s: past lock-up


@cache
def real():
    """Return the default shift, every part with its own kernels."""
    scene = load_scene("planetary-sun").with_options(stop_time=STOP)
    return cosimulate(*with_all_parts(scene))


@pytest.mark.slow
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


def test_every_figure_of_washer_mesh_and_packs_is_found():
    found = {f.name for f in real().key_figures if f.value is not None}
    assert found >= {"clutch_viscous_share", "peak_clutch_heat_flux", "brake_heat_per_area"}
    assert found >= {"peak_flash_rise", "minimum_mesh_film_ratio", "minimum_washer_film_ratio"}
    assert found >= {"stress_margin_aisi1020", "stress_margin_aisi4340"}


def test_four_planets_have_their_meshes_with_sun_and_ring():
    """The ring's share is (1/18 - 1/66)/(1/18 + 1/30) of the sun's."""
    r = real()
    power = 4 * (1 + (1 / 18 - 1 / 66) / (1 / 18 + 1 / 30)) * r.signals["mesh.friction_power"]
    assert r.energy["meshes"] == pytest.approx(np.trapezoid(power, r.time), rel=5e-3)
    assert r.figures["mesh_loss"] == r.energy["meshes"]


def test_the_lining_of_a_shift_is_looked_at(tmp_path):
    scene = changed(tmp_path, "[pressure.clutch]\npiston_area = 0.06\n")
    found = cosimulate(scene, instances(scene)).found
    assert any("clutch: load = " in text and "an organic lining" in text for text in found)
