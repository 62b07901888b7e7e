"""Root stress: against the fillet that a rack really cuts, and a beam bent by hand."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from thrustwasher import GearMeshParams, ParameterError, solve_gearmesh
from thrustwasher.gearmesh.kernels import tooth_root
from thrustwasher.gearmesh.solve import prepare

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
