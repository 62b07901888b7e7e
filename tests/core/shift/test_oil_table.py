"""One oil for all parts of a scene: its viscosity at two or three temperatures, and the rest."""

import math

import pytest
from scene_runs import changed

from thrustwasher.model.oil_laws import roelands, vogel
from thrustwasher.shift.run import remarks
from thrustwasher.tribology.viscosity import viscosity

FLUID = ((297.15, 60.8e-3), (313.15, 31.4e-3), (373.15, 5.99e-3))


def test_both_laws_go_through_three_points():
    scale, constant, exponent = roelands(FLUID)
    factor, b, c = vogel(FLUID)
    for t, thick in FLUID:
        assert viscosity(t, scale, constant, exponent)[0] == pytest.approx(thick, rel=1e-12)
        assert factor * math.exp(b / (t - 273.15 + c)) == pytest.approx(thick, rel=1e-12)
    # The fluid of Jackson & Green has 9.37 mPa s at 80 degC.
    assert viscosity(353.15, scale, constant, exponent)[0] == pytest.approx(9.37e-3, rel=2e-3)


def test_every_part_has_the_scenes_oil(tmp_path):
    scene = changed(tmp_path, "[sump]\n")
    washer, mesh = scene.parts["washer"].params, scene.parts["ring_mesh"].params
    for part in ("clutch", "brake"):
        assert scene.parts[part].params.viscosity_scale == washer.viscosity_scale
    for name in ("clutch", "brake", "washer", "mesh", "ring_mesh", "sump"):
        assert scene.parts[name].params.oil_heat_capacity == 2050.0
    assert scene.parts["transmission"].params.oil_density == 850.0
    assert mesh.pressure_viscosity == 1.7e-8
    for t in (313.15, 358.15):
        thick = mesh.viscosity_scale * math.exp(mesh.viscosity_b / (t - 273.15 + mesh.viscosity_c))
        law = (washer.viscosity_scale, washer.viscosity_constant, washer.viscosity_exponent)
        assert thick == pytest.approx(viscosity(t, *law)[0], rel=2e-3)
    assert scene.notes == ()


def test_a_parts_own_oil_overrides_and_is_said(tmp_path):
    scene = changed(tmp_path, "[mesh]\noil_density = 900.0")
    assert scene.parts["mesh"].params.oil_density == 900.0
    assert scene.parts["ring_mesh"].params.oil_density == 850.0
    assert remarks(scene) == ["mesh: oil_density of its own, not of the scene's oil"]


@pytest.mark.parametrize("base", ["planetary-sun", "planetary"])  # without and with an oil
def test_an_oil_is_known_by_its_kinematic_viscosity_too(tmp_path, base):
    found = []
    for key, unit, factor in (("viscosity", "mPa.s", 0.8), ("kinematic_viscosity", "cSt", 1.0)):
        points = f"[[313.15, '{40 * factor} {unit}'], [373.15, '{7 * factor} {unit}']]"
        scene = changed(tmp_path, f"[oil]\ndensity = 800.0\n{key} = {points}", base)
        found.append(scene.parts["clutch"].params.viscosity_scale)
    assert found[0] == pytest.approx(found[1], rel=1e-9)
