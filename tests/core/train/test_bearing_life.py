"""Equivalent load and basic rating life: the formula by hand, an example of a catalogue."""

import math

import pytest

from thrustwasher.train.kernels import layout as L
from thrustwasher.train.kernels.bearing_life import equivalent_load, rating_life
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
    assert equivalent_load(10e3, 1e3, 0.56, 1.6) == 10e3
    assert equivalent_load(10e3, 8e3, 0.56, 1.6) == pytest.approx(5.6e3 + 12.8e3)


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
