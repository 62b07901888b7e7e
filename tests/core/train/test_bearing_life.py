"""Equivalent load and basic rating life: the formula by hand, an example of a catalogue."""

import math

import pytest
from trains import no_losses_of_shafts

from thrustwasher.train.kernels import layout as L
from thrustwasher.train.kernels.bearing_life import (
    equivalent_load,
    induced_share,
    rating_life,
    shared_thrust,
)
from thrustwasher.train.parameters import TrainParams
from thrustwasher.train.solve import solve_train


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
    said = [text for text in r.warnings if "required_life = 1e+04 h" in text]
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
