"""Profile shift, distance of the axes, tips: against circles and involutes drawn anew."""

import math
import re
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from thrustwasher import GearMeshParams, ParameterError, solve_gearmesh

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
