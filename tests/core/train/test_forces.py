"""Tooth forces and the reactions of bearings, against Newton's laws written out here by hand."""

import math

import numpy as np
import pytest
from trains import SPUR, alike, no_losses_of_shafts

from thrustwasher.train.solve import solve_train

T = 100.0


def one_mesh(**changes):
    """100 N m on a pinion of 100 mm, bearings at 0 and 100 mm, gears at 25 mm."""
    places = {f"shaft_{i}_bearing_{k}_position": 0.1 * (k - 1) for i in (1, 2) for k in (1, 2)}
    axial = {"shaft_1_axial": "first", "shaft_2_axial": "first"}
    at = alike(1, **SPUR, pinion_position=0.025, gear_position=0.025)
    return no_losses_of_shafts(**{"meshes": 1, **places, **axial, **at, **changes})


def forces_of(r, shaft):
    names = [f"shaft_{shaft}_bearing_{k}_{f}_force" for k in (1, 2) for f in ("radial", "axial")]
    return [getattr(r, name) for name in names]


def test_a_spur_pair_by_hand():
    """F_t = T/r = 2 kN, F_r = F_t tan 20 deg; three quarters of them on the nearer bearing."""
    r = solve_train(one_mesh(), torque=T, speed=200.0)
    radial = 2000.0 * math.tan(math.radians(20.0))
    assert r.mesh_1_tangential_force == pytest.approx(2000.0, rel=1e-12)
    assert r.mesh_1_radial_force == pytest.approx(radial, rel=1e-12)
    assert r.mesh_1_axial_force == 0.0
    whole = math.hypot(2000.0, radial)
    for shaft in (1, 2):
        near, a, far, b = forces_of(r, shaft)
        assert near == pytest.approx(0.75 * whole, rel=1e-12) and a == b == 0.0
        assert far == pytest.approx(0.25 * whole, rel=1e-12)


@pytest.mark.parametrize(("hand", "sign"), [("right", 1.0), ("left", -1.0)])
def test_a_helical_pair_by_hand(hand, sign):
    """The axial force tilts the shaft: its couple F_a r goes to the bearings with the radial one.

    With the torque about +x and the centre line along y the pinion feels F_t along -z, F_r along
    -y and, with a right hand, F_a along +x, at r in +y from its axis. Moments about the first
    bearing, L = 100 mm, d = 25 mm: L B_y = d F_r + r F_a, L B_z = d F_t. All forces on the gear are
    opposite, they act at 2 r in -y from its axis: L B_y = -d F_r + 2 r F_a.
    """
    helix = math.radians(20.0)
    r = solve_train(one_mesh(mesh_1_helix_angle=helix, mesh_1_hand=hand), torque=T, speed=200.0)
    radius = 0.5 * 25 * 4e-3 / math.cos(helix)
    tangential = T / radius
    separating = tangential * math.tan(math.radians(20.0)) / math.cos(helix)
    axial = sign * tangential * math.tan(helix)
    assert r.mesh_1_tangential_force == pytest.approx(tangential, rel=1e-12)
    assert r.mesh_1_radial_force == pytest.approx(separating, rel=1e-12)
    assert r.mesh_1_axial_force == pytest.approx(axial, rel=1e-12)
    for shaft, arm in ((1, radius), (2, -2.0 * radius)):
        b_y = (0.025 * separating + arm * axial) / 0.1
        b_z = 0.025 * tangential / 0.1
        first = math.hypot(separating - b_y, tangential - b_z)
        found = forces_of(r, shaft)
        wanted = [first, abs(axial), math.hypot(b_y, b_z), 0.0]
        assert found == pytest.approx(wanted, rel=1e-11), shaft


def test_a_reversed_hand_reverses_the_axial_force_alone():
    params = [one_mesh(mesh_1_helix_angle=0.3, mesh_1_hand=h) for h in ("right", "left")]
    one, other = (solve_train(p, torque=T, speed=200.0) for p in params)
    assert one.mesh_1_tangential_force == other.mesh_1_tangential_force
    assert one.mesh_1_radial_force == other.mesh_1_radial_force
    assert one.mesh_1_axial_force == -other.mesh_1_axial_force != 0.0
    assert one.mesh_loss == other.mesh_loss


def test_coasting_reverses_tangential_and_axial_force():
    """The separating force goes on separating: the other flank bears."""
    p = one_mesh(mesh_1_helix_angle=0.3)
    one, other = (solve_train(p, torque=t, speed=200.0) for t in (T, -T))
    assert one.mesh_1_axial_force == -other.mesh_1_axial_force
    assert one.mesh_1_radial_force == other.mesh_1_radial_force
    y, z = one.mesh_1_radial_force, one.mesh_1_tangential_force
    arm = 0.05 / math.cos(0.3)
    back = (0.025 * y - arm * one.mesh_1_axial_force) / 0.1
    assert forces_of(other, 1)[2] == pytest.approx(math.hypot(back, 0.025 * z / 0.1), rel=1e-11)


def test_the_middle_shaft_bears_the_vector_sum():
    """Forces of both meshes in space, by cross products: sums of forces and moments vanish."""
    helix, angle = math.radians(18.0), math.radians(50.0)
    p = no_losses_of_shafts(
        mesh_1_helix_angle=helix,
        mesh_1_hand="right",
        mesh_2_hand="left",
        mesh_2_helix_angle=helix,
        mesh_2_angle=angle,
        shaft_2_axial="second",
    )
    r = solve_train(p, torque=T, speed=400.0)
    r1 = 0.5 * p.mesh_1_pinion_teeth * p.mesh_1_normal_module / math.cos(helix)
    r2 = 0.5 * p.mesh_2_pinion_teeth * p.mesh_2_normal_module / math.cos(helix)
    slope = math.tan(math.radians(20.0)) / math.cos(helix)
    x, e1 = np.eye(3)[0], np.eye(3)[1]
    e2 = np.array([0.0, math.cos(angle), math.sin(angle)])

    def on_driver(torque, radius, e, right):
        size = torque / radius
        screw = math.tan(helix) if right else -math.tan(helix)
        return -size * np.cross(x, e) - abs(size) * slope * e + size * screw * x

    friction = r.mesh_1_loss / 400.0
    middle = -3.0 * (T - friction)
    gear, pinion = -on_driver(T, r1, e1, True), on_driver(middle, r2, e2, False)
    at_gear = np.array([p.mesh_1_gear_position, 0, 0]) - 3.0 * r1 * e1
    at_pinion = np.array([p.mesh_2_pinion_position, 0, 0]) + r2 * e2
    moment = np.cross(at_gear, gear) + np.cross(at_pinion, pinion)
    far = p.shaft_2_bearing_2_position
    # far x cross B = -moment, in y and z; then the forces
    b = np.array([0.0, -moment[2] / far, moment[1] / far])
    assert (np.cross(far * x, b) + moment)[1:] == pytest.approx([0.0, 0.0], abs=1e-9)
    a = -(gear + pinion + b)
    found = forces_of(r, 2)
    assert found[0] == pytest.approx(math.hypot(a[1], a[2]), rel=1e-10)
    assert found[2] == pytest.approx(math.hypot(b[1], b[2]), rel=1e-10)
    assert found[1] == 0.0 and found[3] == pytest.approx(abs((gear + pinion)[0]), rel=1e-10)


def test_profile_shift_keeps_the_base_circles_forces():
    """The normal force on the base circle is T/r_b whatever the distance of the axes is."""
    p = one_mesh(mesh_1_helix_angle=0.3, mesh_1_profile_shift_pinion=0.4)
    r = solve_train(p, torque=T, speed=200.0)
    angle = math.atan(math.tan(math.radians(20.0)) / math.cos(0.3))
    base = 0.5 * 25 * 4e-3 / math.cos(0.3) * math.cos(angle)
    normal = math.hypot(r.mesh_1_tangential_force, r.mesh_1_radial_force)
    assert normal == pytest.approx(T / base, rel=1e-11)
    lead = math.tan(0.3) * math.cos(angle)  # of the base helix
    assert r.mesh_1_axial_force == pytest.approx(T / base * lead, rel=1e-11)


@pytest.mark.parametrize("torque", [T, -T])
def test_the_bearing_that_the_shaft_is_pushed_to_takes_the_axial_force(torque):
    p = one_mesh(mesh_1_helix_angle=0.3, shaft_1_axial="pushed")
    r = solve_train(p, torque=torque, speed=200.0)
    towards = 2 if r.mesh_1_axial_force > 0.0 else 1
    assert getattr(r, f"shaft_1_bearing_{towards}_axial_force") == abs(r.mesh_1_axial_force)
    assert getattr(r, f"shaft_1_bearing_{3 - towards}_axial_force") == 0.0
