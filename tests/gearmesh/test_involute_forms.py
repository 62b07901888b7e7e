"""The mesh's closed forms against drawn geometry: tips, base circles and summed sliding."""

import math
from itertools import pairwise, product

import numpy as np
import pytest
from closed_forms.involute_mesh import (
    Mesh,
    end_of_contact,
    flanks_at,
    least_pinion_teeth,
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
    tips = [r + tooth_module(mesh) for r in
            (mesh.ratio * pinion_radius(mesh), pinion_radius(mesh))]  # fmt: skip
    gap = np.linalg.norm(on_line(mesh, start_of_contact(mesh)) - centre)
    assert gap == pytest.approx(tips[0], rel=1e-13)
    assert np.linalg.norm(on_line(mesh, end_of_contact(mesh))) == pytest.approx(tips[1], rel=1e-13)


def test_the_pitch_point_lies_on_the_line_of_centres():
    for mesh in MESHES:
        pole = on_line(mesh, 1.0 / (1.0 + mesh.ratio))
        assert pole == pytest.approx([pinion_radius(mesh), 0.0], abs=1e-15)
        assert flanks_at(1.0 / (1.0 + mesh.ratio), mesh, 180.0).sliding == pytest.approx(
            0, abs=1e-13
        )


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


@pytest.mark.parametrize("mesh", MESHES)
def test_start_of_contact_agrees_with_its_form_in_numbers_of_teeth(mesh):
    m = mesh.ratio
    root = math.sqrt((m + 2.0 / mesh.pinion_teeth) ** 2 - (m * math.cos(PHI)) ** 2)
    expected = 1.0 - root / ((1.0 + m) * math.sin(PHI))
    assert start_of_contact(mesh) == pytest.approx(expected, abs=2e-15)


def test_base_cases_have_their_tabled_numbers():
    found = [
        (start_of_contact(mesh), flanks_at(start_of_contact(mesh), mesh, 180.0).sliding)
        for mesh in (Mesh(m, n, 0.254, PHI) for m, n in product((2.0, 5.0), (20, 30)))
    ]
    assert np.allclose(
        found, [(0.08683, 5.782), (0.16217, 4.015), (0.03342, 2.500), (0.07598, 1.702)],
        rtol=0.0, atol=(6e-6, 6e-4),
    )  # fmt: skip


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0, 8.0])
@pytest.mark.parametrize("addendum", [0.8, 1.0, 1.25])
@pytest.mark.parametrize("degrees", [14.5, 20.0, 25.0])
def test_at_the_least_number_of_teeth_contact_starts_on_the_base_circle(ratio, addendum, degrees):
    phi = math.radians(degrees)
    n = least_pinion_teeth(ratio, phi, addendum)
    assert start_of_contact(Mesh(ratio, n, 0.3, phi, addendum)) == pytest.approx(0.0, abs=1e-14)
    assert start_of_contact(Mesh(ratio, 1.01 * n, 0.3, phi, addendum)) > 0.0
    assert start_of_contact(Mesh(ratio, 0.99 * n, 0.3, phi, addendum)) < 0.0


def test_least_numbers_of_teeth_at_20_degrees():
    found = [least_pinion_teeth(m, PHI) for m in (1.0, 2.0, 5.0, 1e6)]
    assert found == pytest.approx([12.32, 14.16, 15.74, 17.10], abs=5e-3)


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
        pairs = [s for s in (phase - 2.0, phase - 1.0, phase, phase + 1.0)
                 if -approach <= s <= recess]  # fmt: skip
        return sum(abs(s) for s in pairs) / len(pairs)

    cuts = sorted({0.0, 1.0, *(c % 1.0 for c in (approach, recess, -approach, 0.0))})
    total = sum(quad(slid, a, b, epsabs=1e-14)[0] for a, b in pairwise(cuts))
    # torque/base radius x (1 + 1/M) speed x s base pitches, over torque x speed
    return total * (1.0 + 1.0 / mesh.ratio) * 2.0 * math.pi / mesh.pinion_teeth


@pytest.mark.parametrize("mesh", [*MESHES, Mesh(3.0, 40, 0.2, math.radians(18.0), 0.9),
                                  Mesh(2.0, 60, 0.2, PHI, 0.65)])  # fmt: skip
def test_loss_factor_is_the_sliding_summed_along_the_line_of_action(mesh):
    assert 1.0 < path_of_contact(mesh).contact_ratio < 2.0
    assert loss_factor(mesh) == pytest.approx(summed_loss(mesh), rel=1e-9)


def ohlendorf_factor(mesh):
    """Return the loss factor in the usual form."""
    approach, recess = path_of_contact(mesh)
    shape = 1.0 - approach - recess + approach**2 + recess**2
    return math.pi * (1.0 + 1.0 / mesh.ratio) / mesh.pinion_teeth * shape


@pytest.mark.parametrize("mesh", MESHES)
def test_with_the_pitch_point_on_one_pair_alone_it_is_ohlendorfs(mesh):
    assert max(path_of_contact(mesh)) < 1.0
    assert loss_factor(mesh) == pytest.approx(ohlendorf_factor(mesh), rel=1e-13)


def test_with_the_pitch_point_on_two_pairs_ohlendorfs_form_is_wrong():
    mesh = Mesh(4.0, 30, 0.2, math.radians(14.5), 0.9)
    assert max(path_of_contact(mesh)) > 1.0
    assert loss_factor(mesh) == pytest.approx(summed_loss(mesh), rel=1e-9)
    assert abs(ohlendorf_factor(mesh) / loss_factor(mesh) - 1.0) > 1e-3


def test_loss_factors_of_the_base_cases():
    found = [(path_of_contact(mesh).contact_ratio, loss_factor(mesh))
             for mesh in (Mesh(2.0, 20, 0.254, PHI), Mesh(5.0, 30, 0.254, PHI))]  # fmt: skip
    assert np.allclose(found, [(1.63519, 0.166065), (1.77232, 0.101196)], rtol=0.0, atol=6e-6)
