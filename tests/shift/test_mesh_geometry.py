"""The mesh of the default scene is that of its teeth: sun and planet in the transverse section."""

import math

import pytest

from thrustwasher.shift import load_scene

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
