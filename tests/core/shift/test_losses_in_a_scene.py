"""Oil pump, churning, bearings and seals in a scene: wired, in the balance, or left out."""

import numpy as np
import pytest
from scene_runs import changed, instances, real_shift, slow_without_jit

from thrustwasher.errors import ParameterError
from thrustwasher.shift import cosimulate, load_scene

BARE = "stop_time = 0.9\n"
NO_WASHERS = "[transmission]\nwashers = 0\n"
NOTHING = """[losses]
pump_displacement = 0.0
input_bearing_count = 0
output_bearing_count = 0
drum_bearing_count = 0
planet_viscous_factor = 0.0
planet_load_factor = 0.0
output_immersion = 0.0
input_seal_diameter = 0.0
output_seal_diameter = 0.0
"""


def run(tmp_path, text, base="planetary"):
    scene = changed(tmp_path, text, base)
    return cosimulate(scene, instances(scene))


@slow_without_jit
def test_without_losses_all_is_as_with_none_to_lose(tmp_path):
    out = run(tmp_path, f"losses = false\n{BARE}{NO_WASHERS}")
    none = run(tmp_path, f"{BARE}{NO_WASHERS}{NOTHING}")
    assert "losses" not in out.scene.parts and "losses" in none.scene.parts
    for name, series in out.signals.items():
        assert np.array_equal(series, none.signals[name], equal_nan=True), name
    assert out.energy == none.energy and "pump_loss" not in out.figures


def test_the_heat_of_the_book_is_divided_by_source():
    r = real_shift("planetary")
    parts = [r.figures[f"{n}_loss"] for n in ("pump", "churning", "rolling", "seal")]
    assert sum(parts) == pytest.approx(r.figures["loss_heat"], rel=1e-12)
    assert min(parts) > 50.0 and parts[0] == max(parts)
    sent = np.sum(r.signals["losses.oil_heat"][1:] * np.diff(r.time))
    assert r.figures["loss_heat"] == pytest.approx(sent, rel=5e-3)
    assert r.energy["residual_share"] < 1e-12


@slow_without_jit
def test_any_scene_can_have_losses_and_its_planets_count(tmp_path):
    r = run(tmp_path, "stop_time = 0.05\n[losses]\n", "planetary-sun")
    losses = r.scene.parts["losses"].params
    assert losses.planets == r.scene.parts["transmission"].params.planets
    s = r.signals
    assert (s["losses.planet_speed"][1:] == s["transmission.mesh_speed"][:-1]).all()
    assert r.figures["loss_heat"] > 10.0


def test_losses_are_a_table_or_false(tmp_path):
    with pytest.raises(
        ParameterError, match=r"losses = True, allowed: a table \[losses\] or false"
    ):
        changed(tmp_path, "losses = true\n")
    assert "losses" not in load_scene("planetary-sun").parts
