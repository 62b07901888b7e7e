"""The mesh's closed forms against drawn geometry: tips, base circles and summed sliding."""

import math
import re
from dataclasses import dataclass
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
from scipy.optimize import brentq

from thrustwasher import GearMeshParams, ParameterError, solve_gearmesh
from thrustwasher.gearmesh.kernels import tooth_root
from thrustwasher.gearmesh.solve import prepare

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


# Profile shift, distance of the axes, tips: against circles and involutes drawn anew.

FZG = {
    "gear_ratio": 1.5,
    "pinion_teeth": 16,
    "normal_module": 4.5e-3,
    "face_width": 0.014,
    "friction_law": "constant",
    "constant_friction": 0.05,
}
TYPE_C = {
    "profile_shift_pinion": 0.1817,
    "profile_shift_gear": 0.1715,
    "tip_diameter_pinion": 82.46e-3,
    "tip_diameter_gear": 118.36e-3,
    "working_centre_distance": 91.5e-3,
}
TYPE_A = {
    "profile_shift_pinion": 0.8532,
    "profile_shift_gear": -0.5,
    "tip_diameter_pinion": 88.77e-3,
    "tip_diameter_gear": 112.5e-3,
    "working_centre_distance": 91.5e-3,
}


def solved(power: float = 1e4, speed: float = 150.0, **changes):
    return solve_gearmesh(GearMeshParams(**{**FZG, **changes}), power=power, speed=speed)


def involute(angle: float) -> float:
    return math.tan(angle) - angle


@dataclass
class Drawn:
    """A spur pair by its base circles, tips and axes; lengths along the line of contact."""

    base: tuple[float, float]
    tips: tuple[float, float]
    centre: float
    teeth: tuple[int, int]

    def __post_init__(self):
        self.angle = math.acos(sum(self.base) / self.centre)
        self.pitch = 2.0 * math.pi * self.base[0] / self.teeth[0]
        reach = [math.sqrt(t * t - b * b) for t, b in zip(self.tips, self.base, strict=True)]
        self.before = reach[1] - self.base[1] * math.tan(self.angle)
        self.after = reach[0] - self.base[0] * math.tan(self.angle)

    def pairs(self, s: float) -> int:
        """Count the pairs in contact while one of them is ``s`` beyond the pitch point."""
        places = s + self.pitch * np.arange(-5, 6)
        return int(np.sum((places > -self.before) & (places < self.after)))

    def loss_factor(self) -> float:
        """Integrate load share times sliding over the path, friction and power 1."""
        ends = [-self.before, 0.0, self.after]
        ends += [self.after - self.pitch, -self.before + self.pitch]
        ends = sorted(s for s in ends if -self.before <= s <= self.after)
        slides = 1.0 / self.base[0] + 1.0 / self.base[1]  # per length, per speed of the flanks
        total = sum(
            quad(lambda s: abs(s) * slides / self.pairs(s), low, high, epsabs=1e-14)[0]
            for low, high in pairwise(ends)
        )
        return total / self.pitch


def drawn(x1: float, x2: float, tips: tuple[float, float], centre: float) -> Drawn:
    radii = (36e-3, 54e-3)
    base = tuple(r * math.cos(math.radians(20.0)) for r in radii)
    return Drawn(base, (0.5 * tips[0], 0.5 * tips[1]), centre, (16, 24))


@pytest.mark.parametrize(
    ("set_of", "contact", "loss"),
    [(TYPE_C, 0.722590 + 0.714947, 0.194958), ({}, 0.749367 + 0.800951, 0.213614)],
    ids=["type C", "unshifted"],
)
def test_test_gears_have_the_contact_and_loss_of_their_drawing(set_of, contact, loss):
    found = solved(**set_of)
    assert found.contact_ratio == pytest.approx(contact, abs=1e-6)
    assert found.loss_factor == pytest.approx(loss, abs=1e-6)


@pytest.mark.parametrize("set_of", [TYPE_C, TYPE_A], ids=["type C", "type A"])
def test_the_loss_is_load_times_sliding_summed_along_the_path(set_of):
    tips = (set_of["tip_diameter_pinion"], set_of["tip_diameter_gear"])
    pair = drawn(0.0, 0.0, tips, 91.5e-3)
    found = solved(**set_of)
    assert found.contact_ratio == pytest.approx((pair.before + pair.after) / pair.pitch, rel=1e-12)
    assert found.loss_factor == pytest.approx(pair.loss_factor(), rel=1e-9)
    assert found.friction_power == pytest.approx(0.05 * found.loss_factor * 1e4, rel=1e-12)


def test_a_pitch_point_in_double_contact_is_beyond_the_usual_formula():
    pair = drawn(0.0, 0.0, (88.77e-3, 112.5e-3), 91.5e-3)
    e1, e2 = pair.after / pair.pitch, pair.before / pair.pitch
    assert pair.pairs(0.0) == 2
    usual = math.pi * 2.5 / 24.0 * (1.0 - e1 - e2 + e1 * e1 + e2 * e2)
    assert usual / solved(**TYPE_A).loss_factor - 1.0 == pytest.approx(0.0134, abs=1e-4)


@pytest.mark.parametrize("helix", [0.0, 0.4])
@pytest.mark.parametrize(("first", "second"), [(0.3, 0.5), (0.5, -0.2), (-0.1, 0.2), (0.4, -0.4)])
def test_the_axes_stand_where_the_teeth_have_no_backlash(helix, first, second):
    found = solved(helix_angle=helix, profile_shift_pinion=first, profile_shift_gear=second)
    slope, angle = (
        math.tan(math.radians(20.0)),
        math.atan(math.tan(math.radians(20.0)) / math.cos(helix)),
    )
    aim = involute(angle) + 2.0 * (first + second) / 40.0 * slope
    working = brentq(lambda a: involute(a) - aim, 0.01, 1.2, xtol=1e-15)
    reference = 0.5 * 4.5e-3 * 40.0 / math.cos(helix)
    assert found.working_pressure_angle == pytest.approx(working, rel=1e-12)
    distance = reference * math.cos(angle) / math.cos(working)
    assert found.centre_distance == pytest.approx(distance, rel=1e-12)
    # thicknesses on the pitch circles add up to their pitch
    radius, thick = distance / 2.5, 0.0
    for teeth, shift, r in ((16, first, radius), (24, second, 1.5 * radius)):
        half = (0.5 * math.pi + 2.0 * shift * slope) / teeth + involute(angle) - involute(working)
        thick += 2.0 * r * half
    assert thick == pytest.approx(2.0 * math.pi * radius / 16.0, rel=1e-12)


def test_a_ring_with_the_shift_of_its_pinion_keeps_the_axes():
    ring = {"internal": True, "gear_ratio": 3.0, "pinion_teeth": 24}
    plain = solved(**ring)
    shifted = solved(**ring, profile_shift_pinion=0.4, profile_shift_gear=0.4)
    assert shifted.centre_distance == plain.centre_distance
    assert shifted.working_pressure_angle == plain.working_pressure_angle
    wider = 0.8 * 4.5e-3
    assert shifted.pinion_tip_diameter - plain.pinion_tip_diameter == pytest.approx(wider)
    assert shifted.gear_tip_diameter - plain.gear_tip_diameter == pytest.approx(wider)


@pytest.mark.parametrize("internal", [False, True])
def test_the_distance_of_the_axes_decides_the_shift_of_the_gear(internal):
    pair = {"internal": internal, "gear_ratio": 3.0, "pinion_teeth": 24}
    given = solved(**pair, profile_shift_pinion=0.2, profile_shift_gear=0.5)
    found = solved(
        **pair,
        profile_shift_pinion=0.2,
        working_centre_distance=given.centre_distance,
        profile_shift_gear_from_distance=True,
    )
    assert found.profile_shift_gear == pytest.approx(0.5, abs=1e-11)
    assert found.loss_factor == pytest.approx(given.loss_factor, rel=1e-10)


def test_the_zone_factor_of_a_shifted_pair_is_the_standards():
    plain, shifted = solved(), solved(profile_shift_pinion=0.3, profile_shift_gear=0.5)
    angle, zone = math.radians(20.0), []
    for r in (plain, shifted):
        a = r.working_pressure_angle
        zone.append(2.0 * math.cos(a) / (math.cos(angle) ** 2 * math.sin(a)))
    shares = [(4.0 - r.contact_ratio) / 3.0 for r in (plain, shifted)]
    # Both are judged where one pair alone is most curved: B or D.
    curved = []
    for r in (plain, shifted):
        tips = (r.pinion_tip_diameter, r.gear_tip_diameter)
        pair = drawn(0.0, 0.0, tips, r.centre_distance)
        one, two = (base * math.tan(pair.angle) for base in pair.base)
        alone = (pair.after - pair.pitch, pair.pitch - pair.before)
        curved.append(min(1.0, *((one + s) * (two - s) / (one * two) for s in alone)))
    stress = math.sqrt(zone[1] * shares[1] / (zone[0] * shares[0]) * curved[0] / curved[1])
    assert shifted.pitting_stress / plain.pitting_stress == pytest.approx(stress, rel=1e-12)


def test_tips_cut_back_shorten_the_path():
    whole, cut = solved(**TYPE_C), solved(**{**TYPE_C, "tip_diameter_pinion": 81e-3})
    assert cut.contact_ratio < whole.contact_ratio
    by_shortening = solved(tip_shortening=0.1)
    assert by_shortening.pinion_tip_diameter == pytest.approx(72e-3 + 1.8 * 4.5e-3)
    assert by_shortening.gear_tip_diameter == pytest.approx(108e-3 + 1.8 * 4.5e-3)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            {"profile_shift_pinion": 0.2, "working_centre_distance": 0.091},
            r"working_centre_distance = 0.091 m, allowed: 0.0908693262 m, that of",
        ),
        ({"profile_shift_gear_from_distance": True}, "allowed: with working_centre_distance"),
        (
            {"profile_shift_gear_from_distance": True, "working_centre_distance": 0.08},
            "allowed: above 0.0845723",
        ),
        ({"profile_shift_pinion": 1.6, "profile_shift_gear": 0.0}, "teeth are -.* thick"),
        ({"tip_diameter_pinion": 0.076, "tip_diameter_gear": 0.110}, "contact ratio is"),
        (
            {"pinion_teeth": 10, "gear_ratio": 4.0, "profile_shift_pinion": -0.2},
            "cut below the pinion's involute",
        ),
        ({"profile_shift_pinion": -2.0, "profile_shift_gear": -2.0}, "mesh without backlash"),
        ({"tip_diameter_gear": 1e-4}, "tip_diameter_gear = 0.0001 m"),
        ({"profile_shift_pinion": 0.1, "film_heat": "atan"}, "film_heat = 'atan'"),
    ],
)
def test_teeth_that_cannot_be_are_refused(changes, said):
    with pytest.raises(ParameterError, match=said):
        GearMeshParams(**{**FZG, **changes})


def test_thin_tips_and_undercut_are_said():
    said = " ".join(solved(**TYPE_A).warnings)
    assert "pinion's teeth are 0.131 modules thick" in said
    assert "profile_shift_gear = -0.5, below -0.404" in said
    assert not any("modules" in line for line in solved(**TYPE_C).warnings)


@pytest.mark.parametrize(
    "changes",
    [
        {"pinion_teeth": 10},
        {"pinion_teeth": 12, "helix_angle": 0.3, "gear_ratio": 4.0},
        {"pinion_teeth": 30, "gear_ratio": 0.34},
    ],
)
def test_the_shift_that_a_refusal_names_is_taken_and_leaves_no_undercut(changes):
    with pytest.raises(ParameterError) as refused:
        GearMeshParams(**changes)
    name, value = re.findall(r"or (profile_shift_\w+) = ([\d.]+)", str(refused.value))[0]
    cured = GearMeshParams(**changes, **{name: float(value)})
    said = solve_gearmesh(cured, power=5e3, speed=100.0).warnings
    assert not any("undercuts" in line and name in line for line in said)


# Root stress: against the fillet that a rack really cuts, and a beam bent by hand.

ANGLE = math.radians(20.0)
PAIR = {"normal_module": 4e-3, "root_limit": 430e6, "pinion_teeth": 24}


def params(**changes) -> GearMeshParams:
    return GearMeshParams(**{**PAIR, **changes})


def fillet(turn: float, teeth: int, shift: float, addendum: float, radius: float):
    """Return point and inward normal of the fillet, its rack rolled by ``turn`` [rad]; modules.

    The middle of the tooth is the axis of y, the gear's centre the origin.
    """
    space = math.pi / 4.0 - addendum * math.tan(ANGLE)
    aside = math.pi / 2.0 - (space - (1.0 - math.sin(ANGLE)) * radius / math.cos(ANGLE))
    corner = np.array([aside - 0.5 * teeth * turn, radius - addendum + shift])
    normal = corner / np.linalg.norm(corner)  # through the pitch point
    point = corner + radius * normal + np.array([0.0, 0.5 * teeth])
    c, s = math.cos(turn), math.sin(turn)
    turned = np.array([[c, s], [-s, c]])
    return turned @ point, turned @ normal


@pytest.mark.parametrize("shift", [-0.2, 0.0, 0.3, 0.6])
@pytest.mark.parametrize("teeth", [17, 24, 40, 101])
def test_the_critical_section_is_where_the_cut_fillet_stands_at_30_degrees(teeth, shift):
    rack = (1.25, 0.38)

    def off(turn):
        _, inwards = fillet(turn, teeth, shift, *rack)
        return math.atan2(-inwards[1], -inwards[0]) - math.pi / 6.0

    turn = brentq(off, 2.0 / teeth, 10.0 / teeth, xtol=1e-14)
    point, _ = fillet(turn, teeth, shift, *rack)
    near = [fillet(turn + d, teeth, shift, *rack) for d in (-1e-5, 1e-5)]
    angle = math.acos(min(1.0, abs(float(near[0][1] @ near[1][1]))))
    curved = float(np.linalg.norm(near[1][0] - near[0][0])) / angle
    par = prepare(params(), "field")
    chord, radius, below = tooth_root.root_section(float(teeth), shift, par)
    assert chord == pytest.approx(2.0 * abs(point[0]), rel=1e-9)
    assert 0.5 * below == pytest.approx(point[1], rel=1e-9)
    assert radius == pytest.approx(curved, rel=1e-4)


def test_stress_is_that_of_a_beam_bent_at_the_outer_end_of_single_contact():
    found = solve_gearmesh(params(), power=2e4, speed=100.0)
    teeth, tip, base = 24, 13.0, 12.0 * math.cos(ANGLE)
    par = prepare(params(), "field")
    chord, radius, below = tooth_root.root_section(24.0, 0.0, par)
    reach = math.sqrt(tip**2 - base**2) - math.pi * math.cos(ANGLE) * (found.contact_ratio - 1.0)
    at = math.hypot(reach, base)
    half = math.pi / 2.0 / teeth + math.tan(ANGLE) - ANGLE
    half -= reach / base - math.acos(base / at)
    acts = math.acos(base / at) - half  # of the force against the middle's normal
    arm = base / math.cos(acts) - 0.5 * below
    force = 200.0 / (base * 4e-3)  # N, along the line of contact
    bent = 6.0 * force * math.cos(acts) * arm / (0.05 * chord**2 * 4e-3)
    slender, notch = chord / arm, chord / (2.0 * radius)
    raised = (1.2 + 0.13 * slender) * notch ** (1.0 / (1.21 + 2.3 / slender))
    forms = tooth_root.root_factors(par, 24.0, 0.0, 13.0 * 4e-3, found.contact_ratio)
    assert forms == pytest.approx((bent * 0.05 * 4e-3 / (200.0 / 48e-3), raised), rel=1e-9)
    gear = tooth_root.root_factors(par, 48.0, 0.0, 25.0 * 4e-3, found.contact_ratio)
    worst = max(math.prod(forms), math.prod(gear))
    assert found.root_stress == pytest.approx(worst * 200.0 / 48e-3 / (0.05 * 4e-3), rel=1e-9)
    assert found.root_safety == pytest.approx(2.0 * 430e6 / found.root_stress, rel=1e-9)


def test_planets_and_uneven_load_take_their_share():
    plain = solve_gearmesh(params(), power=2e4, speed=100.0)
    planet = solve_gearmesh(params(reversed_bending=0.7), power=2e4, speed=100.0)
    assert planet.root_safety < plain.root_safety
    assert planet.root_stress == plain.root_stress
    loaded = params(face_load_factor=1.2, mesh_load_factor=1.1, load_factor=1.25)
    uneven = solve_gearmesh(loaded, power=2e4, speed=100.0)
    assert uneven.root_stress == pytest.approx(1.2 * 1.1 * 1.25 * plain.root_stress, rel=1e-12)


def test_a_helical_tooth_bears_more_than_a_spur_one_of_its_module():
    spur = solve_gearmesh(params(), power=2e4, speed=100.0)
    helical = solve_gearmesh(params(helix_angle=0.3), power=2e4, speed=100.0)
    assert helical.root_stress < spur.root_stress


def test_no_limit_gives_no_safety_and_no_rack_no_root():
    without = solve_gearmesh(params(root_limit=0.0), power=2e4, speed=100.0)
    assert without.root_safety is None and without.root_stress > 0.0
    flat = params(root_limit=0.0, pressure_angle=0.6, addendum=0.8, pinion_teeth=40)
    assert solve_gearmesh(flat, power=2e4, speed=100.0).root_stress == -1.0
    with pytest.raises(ParameterError, match=r"tool_tip_radius = 0.6, allowed: less"):
        params(tool_tip_radius=0.6)
    with pytest.raises(ParameterError, match=r"root_limit = 1000000.0 Pa, allowed"):
        params(root_limit=1e6)
