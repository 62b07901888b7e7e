"""Tooth forces and the reactions of bearings, against Newton's laws written out here by hand."""

import math

import numpy as np
import pytest
from scipy.optimize import linprog
from trains import SPUR, alike, no_losses_of_shafts

from thrustwasher.train.kernels import layout as L
from thrustwasher.train.kernels.bearing_life import (
    equivalent_load,
    induced_share,
    rating_life,
    shared_thrust,
)
from thrustwasher.train.parameters import TrainParams
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


def statics(loads, bearings):
    """Radial and axial force of two bearings by statics in space, and by contact normals.

    ``loads``: (place, force, couple) on the shaft; a bearing: (position, pressure centre, axial
    over radial force that it makes). What an outer ring does to its shaft runs through the pressure
    centre, so that its axial part points from the bearing to there. Without preload as little
    axial force is there as balance and the bearings' own forces allow: a linear programme.
    """
    x, across = np.eye(3)[0], np.eye(3)[1:]
    total = sum(force for _, force, _ in loads)
    moment = sum(np.cross(place, force) + couple for place, force, couple in loads)
    # unknown: y and z of both radial forces; two forces and two moments across vanish
    columns = [[*e[1:], *np.cross(centre * x, e)[1:]] for _, centre, _ in bearings for e in across]
    one_y, one_z, two_y, two_z = np.linalg.solve(np.transpose(columns), [*-total[1:], *-moment[1:]])
    radial = [math.hypot(one_y, one_z), math.hypot(two_y, two_z)]
    ways = [np.sign(centre - position) for position, centre, _ in bearings]
    own = [share * size for (*_, share), size in zip(bearings, radial, strict=True)]
    found = linprog(
        [1.0, 1.0],
        A_eq=[ways],
        b_eq=[-total[0]],
        bounds=[(least, None) for least in own],
        options={"primal_feasibility_tolerance": 1e-10},
    )
    return radial, list(found.x)


def along(angle):
    return np.array([0.0, math.cos(angle), math.sin(angle)])


PUSHED = {"position": 0.16, "radial": 900.0, "direction": 2.0, "axial": -700.0}
TILTED = {"position": -0.03, "axial": 300.0, "moment": 60.0, "moment_direction": -1.0}


@pytest.mark.parametrize("torque", [T, -T])
@pytest.mark.parametrize("ends", [(0.0, 0.1), (0.1, 0.0)])
@pytest.mark.parametrize("arrangement", ["O", "X"])
@pytest.mark.parametrize("forces", [[], [PUSHED], [TILTED, PUSHED]])
def test_pairs_in_o_and_x_under_teeth_and_forces_from_outside(arrangement, ends, torque, forces):
    """A helical gear's shaft on taper bearings: both ways of the thrust, both orders of bearings.

    The right-hand pinion is driven along -z t at its radius in +y; the gear feels the opposite.
    """
    own = {f"shaft_2_bearing_{k}_position": place for k, place in enumerate(ends, 1)}
    own |= {"shaft_2_bearing_1_pressure_centre": 0.012, "shaft_2_bearing_2_pressure_centre": 0.017}
    own |= {"shaft_2_bearing_1_y_factor": 1.6, "shaft_2_bearing_2_y_factor": 1.1}
    own |= {f"shaft_2_bearing_{k}_type": "taper" for k in (1, 2)}
    own |= {f"shaft_2_force_{k}_{n}": v for k, f in enumerate(forces, 1) for n, v in f.items()}
    p = one_mesh(mesh_1_helix_angle=0.3, shaft_2_axial=arrangement, **own)
    r = solve_train(p, torque=torque, speed=200.0)
    sign = math.copysign(1.0, torque)
    radius = 25 * 4e-3 / math.cos(0.3)
    teeth = np.array([-r.mesh_1_axial_force, 0.0, 0.0])
    teeth += r.mesh_1_radial_force * along(0.0) + sign * r.mesh_1_tangential_force * along(
        math.pi / 2
    )
    loads = [(np.array([0.025, -radius, 0.0]), teeth, np.zeros(3))]
    for f in forces:
        force = np.array([f["axial"], 0.0, 0.0])
        force += f.get("radial", 0.0) * along(f.get("direction", 0.0))
        couple = f.get("moment", 0.0) * along(f.get("moment_direction", 0.0))
        loads.append((np.array([f["position"], 0.0, 0.0]), force, couple))
    out = 1.0 if arrangement == "O" else -1.0
    bearings = [
        (place, place + out * (1.0 if place == max(ends) else -1.0) * centre, 0.5 / y)
        for place, centre, y in zip(ends, (0.012, 0.017), (1.6, 1.1), strict=True)
    ]
    radial, axial = statics(loads, bearings)
    found = forces_of(r, 2)
    assert found[::2] == pytest.approx(radial, rel=1e-10)
    assert found[1::2] == pytest.approx(axial, rel=1e-9)
    for k, (side, y) in enumerate(((0, 1.6), (1, 1.1)), 1):
        load = max(radial[side], 0.4 * radial[side] + y * axial[side])
        assert getattr(r, f"shaft_2_bearing_{k}_load") == pytest.approx(load, rel=1e-9)


def test_a_force_from_outside_moves_no_power_but_what_its_bearings_lose():
    own = {"shaft_3_force_1_position": 0.18, "shaft_3_force_1_radial": 8e3}
    plain, loaded = (solve_train(TrainParams(**more), torque=T, speed=400.0) for more in ({}, own))
    assert loaded.mesh_loss == pytest.approx(plain.mesh_loss, rel=1e-12)
    assert loaded.bearing_loss > 1.05 * plain.bearing_loss
    out = loaded.output_torque * loaded.output_speed
    assert T * 400.0 - out == pytest.approx(loaded.loss, rel=1e-11)
    free = no_losses_of_shafts(**own)
    assert solve_train(free, torque=T, speed=400.0).efficiency == pytest.approx(
        solve_train(no_losses_of_shafts(), torque=T, speed=400.0).efficiency, rel=1e-14
    )


# Equivalent load and basic rating life: the formula by hand, an example of a catalogue.


def test_an_example_of_a_catalogue():
    """SKF's catalogue, 6309: C = 55.3 kN, 10 kN, 3000 1/min: 169 million turns, 940 hours."""
    hours = rating_life(55.3e3, 10e3, 3000.0 * math.pi / 30.0, L.BALL) / 3600.0
    assert hours == pytest.approx(940.0, rel=1e-3)
    assert hours * 60.0 * 3000.0 / 1e6 == pytest.approx(169.0, rel=1e-3)


@pytest.mark.parametrize(
    ("kind", "power"),
    [(L.BALL, 3.0), (L.ANGULAR, 3.0), (L.CYLINDRICAL, 10.0 / 3.0), (L.TAPER, 10.0 / 3.0)],
)
def test_life_by_the_formula_of_iso_281(kind, power):
    """L10h = 1e6/(60 n) (C/P)^p."""
    n = 1450.0
    wanted = 1e6 / (60.0 * n) * (80.0 / 12.0) ** power
    assert rating_life(80e3, 12e3, n * math.pi / 30.0, kind) / 3600.0 == pytest.approx(wanted)
    assert rating_life(80e3, 12e3, -n * math.pi / 30.0, kind) / 3600.0 == pytest.approx(wanted)


def test_an_equivalent_load_is_no_less_than_the_radial_one():
    assert equivalent_load(10e3, 1e3, 0.56, 1.6, 0.0) == 10e3
    assert equivalent_load(10e3, 8e3, 0.56, 1.6, 0.0) == pytest.approx(5.6e3 + 12.8e3)


def test_a_catalogues_e_says_from_where_an_axial_force_counts():
    """NUP: e = 0.2, P = 0.92 F_r + 0.6 F_a above it."""
    assert equivalent_load(10e3, 2.0e3, 0.92, 0.6, 0.2) == 10e3
    assert equivalent_load(10e3, 2.1e3, 0.92, 0.6, 0.2) == pytest.approx(9.2e3 + 1.26e3)


def test_axial_forces_that_radial_ones_induce():
    """0.5 F_r/Y of taper bearings: 312.5 and 625 N; e F_r of angular ones, 1.14 at 40 degrees."""
    taper = induced_share(L.TAPER, 0.4, 1.6, 0.37, -1.0)
    assert (1000.0 * taper, 2000.0 * taper) == (312.5, 625.0)
    assert induced_share(L.ANGULAR, 0.35, 0.57, 1.14, -1.0) == 1.14
    assert induced_share(L.ANGULAR, 0.35, 0.57, 0.0, -1.0) == pytest.approx(1.14, abs=5e-3)
    assert induced_share(L.ANGULAR, 0.41, 0.87, 0.0, -1.0) == pytest.approx(0.68, abs=5e-3)
    assert induced_share(L.TAPER, 0.4, 1.6, 0.37, 0.0) == 0.0  # given
    assert induced_share(L.BALL, 0.56, 1.6, 0.0, -1.0) == 0.0


@pytest.mark.parametrize(("arrangement", "way"), [(L.FACE_TO_FACE, 1.0), (L.BACK_TO_BACK, -1.0)])
def test_thrust_of_a_pair_as_catalogues_list_it(arrangement, way):
    """Induced 312.5 N (A, first) and 625 N (B), K_a towards that which it loads.

    Towards A: F_aA = F_aB + K_a. Towards B: F_aB = F_aA + K_a if K_a is 312.5 N or more, less
    leaves B at its own 625 N and A at F_aB - K_a. In X a push towards a bearing loads it, in O the
    other one.
    """
    own = (312.5, 625.0)
    assert shared_thrust(arrangement, own, 0.0) == (625.0, 625.0)
    assert shared_thrust(arrangement, own, -way * 400.0) == (1025.0, 625.0)
    assert shared_thrust(arrangement, own, way * 100.0) == (525.0, 625.0)
    assert shared_thrust(arrangement, own, way * 400.0) == (312.5, 712.5)


def test_a_maker_s_example_of_a_pair_back_to_back():
    """NSK's catalogue, HR30305DJ (I) and HR30206J (II), 600 1/min, pressure centres 83.8 mm apart.

    5500 N at 59.9 mm from I, 2000 N on it: F_r 1569 and 3931 N; 0.6 F_r/Y is induced; F_aI = 2000 +
    0.6/1.6 3931 = 3474 N; P = 3164 and 3931 N; lives 109 750 and 80 400 h with its rounded factors.
    """
    pair = {"axial": "O", "force_1_position": 0.0399, "force_1_radial": 5500.0}
    one = {"position": 0.0, "pressure_centre": 0.02, "y_factor": 0.73, "e_factor": 0.83}
    two = {"position": 0.05, "pressure_centre": 0.0138, "y_factor": 1.6, "e_factor": 0.38}
    for bearing, own, c in (("1", one, 38e3), ("2", two, 43e3)):
        own |= {"type": "taper", "capacity": c, "x_factor": 0.4}
        own["induced_factor"] = 0.6 / own["y_factor"]
        pair |= {f"bearing_{bearing}_{name}": value for name, value in own.items()}
    pair["force_1_axial"] = 2000.0  # in O towards +x: away from the second, on to the first
    p = no_losses_of_shafts(**{f"shaft_1_{name}": value for name, value in pair.items()})
    r = solve_train(p, torque=0.0, speed=600.0 * math.pi / 30.0)
    found = {
        "radial_force": (1569.0, 3931.0),
        "axial_force": (3474.0, 1474.0),
        "load": (3164.0, 3931.0),
    }
    for name, values in found.items():
        told = [getattr(r, f"shaft_1_bearing_{k}_{name}") for k in (1, 2)]
        assert told == pytest.approx(values, rel=5e-4), name
    lives = [getattr(r, f"shaft_1_bearing_{k}_life") / 3600.0 for k in (1, 2)]
    assert lives == pytest.approx([109750.0, 80400.0], rel=5e-3)


def test_an_output_shaft_with_a_chain():
    """A sprocket of 100 mm beyond the bearings of the last shaft pulls with T/r, across.

    Spur pair, 100 N m and ratio 2, gear of 200 mm at 25 mm, bearings at 0 and 100 mm, sprocket at
    130 mm; by hand: of the pull 1.3 times on the second bearing, -0.3 on the first.
    """
    places = {f"shaft_2_bearing_{k}_position": 0.1 * (k - 1) for k in (1, 2)}
    gear = {"mesh_1_pinion_teeth": 25, "mesh_1_normal_module": 4e-3, "mesh_1_gear_ratio": 2.0}
    gear |= {"mesh_1_helix_angle": 0.0, "mesh_1_gear_position": 0.025}
    gear |= {"mesh_1_friction_law": "constant", "mesh_1_constant_friction": 0.0}
    pull = 200.0 / 0.05
    chain = {"position": 0.13, "radial": pull, "direction": -math.pi / 2.0}
    chain = {f"shaft_2_force_1_{name}": value for name, value in chain.items()}
    p = no_losses_of_shafts(meshes=1, **places, **gear, **chain)
    r = solve_train(p, torque=100.0, speed=200.0)
    assert r.output_torque == -200.0
    y, z = 2000.0 * math.tan(math.radians(20.0)), 2000.0  # on the gear
    near = math.hypot(0.75 * y, 0.75 * z + 0.3 * pull)
    far = math.hypot(0.25 * y, 0.25 * z - 1.3 * pull)
    assert r.shaft_2_bearing_1_radial_force == pytest.approx(near, rel=1e-12)
    assert r.shaft_2_bearing_2_radial_force == pytest.approx(far, rel=1e-12)
    life = 1e6 * 2.0 * math.pi / 100.0 * (p.shaft_2_bearing_2_capacity / far) ** 3
    assert r.shaft_2_bearing_2_life == pytest.approx(life, rel=1e-11)


def test_bearings_without_load_or_speed_live_the_longest_time_there_is():
    assert rating_life(80e3, 0.0, 100.0, L.BALL) == rating_life(80e3, 12e3, 0.0, L.BALL) == 1e12


def test_lives_of_a_train_follow_from_its_forces():
    p = TrainParams(required_life=3.6e7)
    r = solve_train(p, torque=150.0, speed=500.0)
    lives = []
    for i, w in ((1, 500.0), (2, 500.0 / 3.0), (3, abs(r.output_speed))):
        for k in (1, 2):
            name = f"shaft_{i}_bearing_{k}"
            x, y, c = (getattr(p, f"{name}_{n}") for n in ("x_factor", "y_factor", "capacity"))
            radial, axial = getattr(r, f"{name}_radial_force"), getattr(r, f"{name}_axial_force")
            load = max(radial, x * radial + y * axial)
            power = 3.0 if getattr(p, f"{name}_type") == "ball" else 10.0 / 3.0
            lives.append(2e6 * math.pi / w * (c / load) ** power)
            assert getattr(r, f"{name}_life") == pytest.approx(lives[-1], rel=1e-12)
    assert r.bearing_life == pytest.approx(min(lives), rel=1e-12)
    said = [text for text in r.warnings if "required_life = 10000 h" in text]
    assert said and said[0].startswith("shaft 1, bearing 1: life = 862.8 h, below")


def test_loads_beyond_the_range_of_the_rating_are_said():
    r = solve_train(TrainParams(shaft_1_bearing_1_capacity=9e3), torque=150.0, speed=500.0)
    assert any("shaft 1, bearing 1: P = 5.704 kN is above C/2" in text for text in r.warnings)


def test_an_axial_force_that_a_bearing_does_not_count_is_said():
    """A roller bearing (Y = 0) that takes the axial force of a helical pair; of a ball no word."""
    point = {"torque": 150.0, "speed": 500.0}
    ball = solve_train(TrainParams(), **point).warnings
    roller = solve_train(TrainParams(shaft_1_bearing_1_y_factor=0.0), **point).warnings
    said = [text for text in roller if text not in ball]
    assert len(said) == 1 and said[0].startswith("shaft 1, bearing 1: takes an axial force of 2.24")
