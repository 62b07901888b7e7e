"""A mesh under torque and speed of either sign: the other flanks bear, the loss stays a loss."""

import math

import numpy as np
import pytest
from built import built_fmu
from kernel_part import Part

from thrustwasher import GearMeshParams, solve_gearmesh
from thrustwasher.fmu.stepper import Instance
from thrustwasher.gearmesh.kernels import layout as L
from thrustwasher.gearmesh.kernels.mesh_point import LEAST_LINE_LOAD
from thrustwasher.gearmesh.parameters import SPEC

PAIRS = {
    "default": GearMeshParams(),
    "helical": GearMeshParams.preset("planet"),
    "shifted": GearMeshParams(profile_shift_pinion=0.3, profile_shift_gear=-0.1),
    "elastic": GearMeshParams(
        load_sharing="elastic", tip_relief_pinion=10e-6, tip_relief_length_pinion=2e-3
    ),
    "paper": GearMeshParams.preset("paper"),
}
QUADRANTS = [(a, b) for a in (1.0, -1.0) for b in (1.0, -1.0)]


def mesh_of(name):
    return Part("gearmesh", "field", PAIRS[name])


def at(mesh, load, speed):
    """Return the real outputs of the step that FMUs make, at a point."""
    mesh.state[:] = 0.0
    assert mesh.step([load, speed, 353.15]) == 0
    return {name: mesh[name] for name in mesh.reals}


@pytest.mark.parametrize("pair", PAIRS)
def test_all_four_quadrants_lose_the_same(pair):
    """Neither flank nor driver is in the laws: the profile is that of both flanks."""
    mesh = mesh_of(pair)
    one = at(mesh, 40.0, 180.0)
    for load, speed in QUADRANTS:
        found = at(mesh, 40.0 * load, 180.0 * speed)
        for name, value in one.items():
            sign = speed if name == "friction_torque" else 1.0
            assert found[name] == sign * value, name
        given, left = 40.0 * load * 180.0 * speed, 40.0 * load - found["friction_torque"]
        assert given - left * 180.0 * speed == pytest.approx(found["friction_power"], rel=1e-9)
        assert found["friction_power"] > 0.0


@pytest.mark.parametrize("pair", PAIRS)
def test_the_loss_passes_through_no_torque_smoothly(pair):
    """Continuous with its slope, and exact outside the stated width of 2 N/m of line load."""
    mesh = mesh_of(pair)
    width = 2.0 * LEAST_LINE_LOAD / mesh.par[L.D_LINE]
    torques = np.linspace(-2.0 * width, 2.0 * width, 401)
    loss = np.array([at(mesh, t, 180.0)["friction_torque"] for t in torques])
    slopes = np.diff(loss) / np.diff(torques)
    assert loss[200] == 0.0 and (loss >= 0.0).all() and loss == pytest.approx(loss[::-1])
    assert abs(slopes).max() < 0.2
    assert abs(np.diff(slopes)).max() < 0.05 * abs(slopes).max()
    if PAIRS[pair].load_sharing == "rigid":
        found = at(mesh, width, 180.0)
        sharp = found["mean_friction"] * mesh.par[L.D_LOSS] * width
        assert found["friction_torque"] == pytest.approx(sharp, rel=1e-12)


def test_the_sign_of_the_power_given_does_not_matter():
    """The power of a mesh seen from Python: recuperation has the other sign."""
    drive, coast = (solve_gearmesh(GearMeshParams(), power=p, speed=180.0) for p in (7e3, -7e3))
    assert drive.friction_power == coast.friction_power > 0.0
    back = solve_gearmesh(GearMeshParams(), power=7e3, speed=-180.0)
    assert back.friction_torque == -drive.friction_torque and math.isfinite(back.film_thickness)


def test_the_fmu_passes_from_drive_to_coasting_without_a_jump():
    """1 N m to -1 N m in steps of 0.01 N m: the loss changes by less than 4e-5 N m in each."""
    with Instance(built_fmu("gearmesh", local=True)) as mesh:
        names = [s.name for s in SPEC.outputs]
        place, losses = names.index("friction_torque"), []
        mesh.initialize(0.0, {"load": 1.0, "speed": 180.0, "oil_temperature": 353.15})
        for i, torque in enumerate(np.linspace(1.0, -1.0, 201).tolist()):
            mesh.set_inputs([torque, 180.0, 353.15])
            mesh.step(1e-3 * i, 1e-3)
            losses.append(mesh.outputs()[place])
    assert min(losses) == pytest.approx(0.0, abs=1e-15) and losses[0] > 1e-3
    assert abs(np.diff(losses)).max() < 4e-5
    assert losses == pytest.approx(losses[::-1], rel=1e-3, abs=1e-12)
