"""The mesh of the default scene is that of its teeth: sun and planet in the transverse section."""

import math

import pytest

from thrustwasher.shift import load_scene
from thrustwasher.shift.steady_points import efficiency_map

HELIX = math.radians(20.0)
TRANSVERSE = 1.5e-3 / math.cos(HELIX)  # module


def test_the_mesh_is_the_transverse_section_of_the_teeth():
    """20 degrees and one normal module, both in the normal section of the tooth."""
    scene = load_scene("planetary-sun")
    gearbox, mesh = scene.parts["transmission"].params, scene.parts["mesh"].params
    assert (gearbox.normal_module, gearbox.helix_angle) == (1.5e-3, pytest.approx(HELIX))
    distance = 0.5 * TRANSVERSE * (gearbox.sun_teeth + gearbox.planet_teeth)
    assert mesh.centre_distance == pytest.approx(distance, abs=0.5e-6)
    angle = math.atan(math.tan(math.radians(20.0)) / math.cos(HELIX))
    assert mesh.pressure_angle == pytest.approx(angle, abs=math.radians(5e-4))
    assert mesh.addendum == pytest.approx(1.5e-3 / TRANSVERSE, abs=5e-5)


def test_a_set_whose_planets_are_larger_than_the_sun_runs(tmp_path):
    """24/30/84 teeth, first gear with the ring driven; the planet's teeth bend both ways."""
    path = tmp_path / "large.toml"
    path.write_text(
        'base = "planetary"\n[transmission]\nsun_teeth = 24\nplanet_teeth = 30\n'
        "ring_teeth = 84\nplanets = 3\n[mesh]\ngear_ratio = 0.8\npinion_teeth = 30\n"
        "[ring_mesh]\ngear_ratio = 2.8\npinion_teeth = 30\n"
    )
    scene = load_scene(path)
    mesh = scene.parts["mesh"].params
    assert (mesh.reversed_bending, mesh.mates_pinion, mesh.mates_gear) == (0.7, 2, 3)
    assert not any("teeth" in line for line in scene.warnings)
    found = efficiency_map(scene, [247.0], [209.44], gear="first").columns
    assert 0.96 < found["efficiency"][0] < 0.99 and 50.0 < found["mesh_loss"][0] < 200.0
