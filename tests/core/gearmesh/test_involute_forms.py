"""The mesh's closed forms against drawn geometry: tips, base circles and summed sliding."""

import math
from itertools import pairwise, product

import numpy as np
import pytest
from closed_forms.involute_mesh import (
    Mesh,
    end_of_contact,
    flanks_at,
    line_load,
    loss_factor,
    path_of_contact,
    pinion_radius,
    start_of_contact,
    tooth_module,
)
from scipy.integrate import quad

PHI = math.radians(20.0)
MESHES = [Mesh(m, n, 0.254, PHI) for m, n in product((1.0, 2.0, 5.0, 8.0), (18, 20, 30, 60))]


def on_line(mesh, x):
    """Return the point at position x of the line of action; pinion at 0, gear at (C, 0)."""
    foot = pinion_radius(mesh) * math.cos(mesh.pressure_angle)
    start = foot * np.array([math.cos(mesh.pressure_angle), math.sin(mesh.pressure_angle)])
    along = np.array([math.sin(mesh.pressure_angle), -math.cos(mesh.pressure_angle)])
    return start + x * mesh.centre_distance * math.sin(mesh.pressure_angle) * along


@pytest.mark.parametrize("mesh", MESHES)
def test_contact_starts_on_the_gears_tip_circle_and_ends_on_the_pinions(mesh):
    centre = np.array([mesh.centre_distance, 0.0])
    tips = [r + tooth_module(mesh) for r in (mesh.ratio * pinion_radius(mesh), pinion_radius(mesh))]
    gap = np.linalg.norm(on_line(mesh, start_of_contact(mesh)) - centre)
    assert gap == pytest.approx(tips[0], rel=1e-13)
    assert np.linalg.norm(on_line(mesh, end_of_contact(mesh))) == pytest.approx(tips[1], rel=1e-13)


@pytest.mark.parametrize("mesh", MESHES)
def test_sliding_is_the_difference_of_two_rotations(mesh):
    x = start_of_contact(mesh)
    place = on_line(mesh, x)
    along = np.array([math.cos(PHI), math.sin(PHI)])  # the common tangent of the flanks

    def speed(spin, centre):
        arm = place - centre
        return spin * float(np.dot([-arm[1], arm[0]], along))

    flanks = flanks_at(x, mesh, 180.0)
    first = speed(180.0, np.zeros(2))
    second = speed(-180.0 / mesh.ratio, np.array([mesh.centre_distance, 0.0]))
    assert abs(second - first) == pytest.approx(abs(flanks.sliding), rel=1e-12)
    assert sorted((abs(first), abs(second))) == pytest.approx(
        sorted((flanks.speed_pinion, flanks.speed_gear)), rel=1e-12
    )


def test_a_gear_smaller_than_its_pinion_interferes_at_the_end_first():
    mesh = Mesh(0.5, 24, 0.254, PHI)
    assert start_of_contact(mesh) > 0.0 and end_of_contact(mesh) > 1.0
    mirrored = Mesh(2.0, 12, 0.254, PHI)
    assert start_of_contact(mesh) == pytest.approx(1.0 - end_of_contact(mirrored), abs=1e-14)


def test_the_line_load_turns_the_pinion():
    mesh = MESHES[5]
    w = line_load(41.0, mesh, 0.05)
    lever = np.linalg.norm(on_line(mesh, 0.0))  # the line of action touches the base circle
    assert w * 0.05 * lever == pytest.approx(41.0, rel=1e-13)


def summed_loss(mesh):
    """Integrate load x friction x sliding over one base pitch, pair by pair."""
    approach, recess = path_of_contact(mesh)

    def slid(phase):
        pairs = [
            s for s in (phase - 2.0, phase - 1.0, phase, phase + 1.0) if -approach <= s <= recess
        ]
        return sum(abs(s) for s in pairs) / len(pairs)

    cuts = sorted({0.0, 1.0, *(c % 1.0 for c in (approach, recess, -approach, 0.0))})
    total = sum(quad(slid, a, b, epsabs=1e-14)[0] for a, b in pairwise(cuts))
    # torque/base radius x (1 + 1/M) speed x s base pitches, over torque x speed
    return total * (1.0 + 1.0 / mesh.ratio) * 2.0 * math.pi / mesh.pinion_teeth


@pytest.mark.parametrize(
    "mesh", [*MESHES, Mesh(3.0, 40, 0.2, math.radians(18.0), 0.9), Mesh(2.0, 60, 0.2, PHI, 0.65)]
)
def test_loss_factor_is_the_sliding_summed_along_the_line_of_action(mesh):
    assert 1.0 < path_of_contact(mesh).contact_ratio < 2.0
    assert loss_factor(mesh) == pytest.approx(summed_loss(mesh), rel=1e-9)


def ohlendorf_factor(mesh):
    """Return the loss factor in the usual form."""
    approach, recess = path_of_contact(mesh)
    shape = 1.0 - approach - recess + approach**2 + recess**2
    return math.pi * (1.0 + 1.0 / mesh.ratio) / mesh.pinion_teeth * shape


def test_with_the_pitch_point_on_two_pairs_ohlendorfs_form_is_wrong():
    mesh = Mesh(4.0, 30, 0.2, math.radians(14.5), 0.9)
    assert max(path_of_contact(mesh)) > 1.0
    assert loss_factor(mesh) == pytest.approx(summed_loss(mesh), rel=1e-9)
    assert abs(ohlendorf_factor(mesh) / loss_factor(mesh) - 1.0) > 1e-3
