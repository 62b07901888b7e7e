"""A calibration says so, first of all, where its law cannot follow the points."""

import re

import numpy as np
import pytest

from thrustwasher import calibrate
from thrustwasher.clutch.parameters import ClutchParams
from thrustwasher.studio.calibration.estimates import spanned
from thrustwasher.studio.calibration.friction.friction_law import friction_over, law_values

PACK = ClutchParams(friction_law="wang")
SLIP = np.linspace(1.0, 250.0, 60)
FALL = 0.05 * np.exp(-SLIP / 50.0)
TRUE = ClutchParams(
    friction_law="wang", plough_weight=0.2, shear_floor=0.4, stick_speed=1.5, decay_speed=2.0
)
EXACT = friction_over(law_values(TRUE), SLIP * TRUE.friction_radius)


def fitted(friction, pack=PACK, **more):
    return calibrate(pack, speed=SLIP, load=5e3, friction=friction, profile=False, **more)


def scattered(friction, seed, size=1e-3):
    return friction + size * np.random.default_rng(seed).standard_normal(len(SLIP))


@pytest.mark.parametrize("level", [0.3, 1.5])
def test_points_above_all_that_the_law_can_give_are_said_first(level):
    found = fitted(level + FALL)
    first = found.warnings[0]
    assert str(found).startswith(f"WARNING. {first}")
    assert f"gives at most 0.1489, measured are up to {max(level + FALL):.4g}" in first
    assert "plough_weight is stopped by its upper bound 1" in first
    assert found["plough_weight"].at_bound == "upper" and found.params.plough_weight == 1.0
    for word in ("smaller hardness_ratio", "larger indentation", "larger adhesion_factor", "table"):
        assert word in first


@pytest.mark.parametrize("name", ["hardness_ratio", "indentation", "adhesion_factor"])
def test_the_value_that_is_said_to_help_does_and_a_tenth_less_far_does_not(name):
    words = fitted(0.3 + FALL).warnings[0]
    value = float(re.search(rf"{name} \(([0-9.]+) or", words)[1])
    start = getattr(PACK, name)
    assert fitted(0.3 + FALL, ClutchParams(friction_law="wang", **{name: value})).warnings == ()
    less = fitted(
        0.3 + FALL, ClutchParams(friction_law="wang", **{name: start + 0.9 * (value - start)})
    )
    assert less.warnings


def test_points_below_all_that_the_law_can_give_are_named():
    found = fitted(np.full(60, 0.05), fit=("plough_weight",))
    assert "of 60 points (it gives at least 0.0" in found.warnings[0]
    assert "plough_weight is stopped by its lower bound 0" in found.warnings[0]
    assert "larger hardness_ratio" in found.warnings[0]


def test_a_fall_hidden_below_the_slowest_point_is_named():
    found = fitted(np.full(60, 0.02))
    assert found.rms < 1e-9  # at the points nothing is wrong
    assert "below the slowest point, 0.07499 m/s" in found.warnings[0]
    value = float(re.search(r"adhesion_factor \(([0-9.]+) or less", found.warnings[0])[1])
    assert (
        fitted(np.full(60, 0.02), ClutchParams(friction_law="wang", adhesion_factor=value)).warnings
        == ()
    )


def test_points_that_no_curve_meets_all_at_once_name_the_bound():
    found = fitted(0.7 * scattered(EXACT, 1))
    assert "misses the points by more than they scatter" in found.warnings[0]
    assert "plough_weight is at its lower bound 0: the points pull beyond it" in found.warnings[0]


@pytest.mark.parametrize(
    ("friction", "start"),
    [(0.1 + 2e-4 * SLIP, "0.07499"), (EXACT + 0.04 * (SLIP / 250.0) ** 2, "")],
)
def test_friction_that_rises_asks_for_the_table(friction, start):
    first = fitted(scattered(friction, 1)).warnings[0]
    assert first.startswith("Friction rises with speed") and f"from {start}" in first
    assert 'friction_law = "table"' in first


def test_the_constant_law_is_told_of_friction_over_speed():
    constant = ClutchParams(friction_law="constant")
    fit = ("constant_friction",)
    assert 'friction_law = "wang"' in fitted(EXACT, constant, fit=fit).warnings[0]
    assert (
        "the constant law cannot change" in fitted(0.1 + 1e-4 * SLIP, constant, fit=fit).warnings[0]
    )
    assert fitted(scattered(np.full(60, 0.1), 1), constant, fit=fit).warnings == ()


def test_residuals_above_a_fifth_of_the_friction_are_named_even_if_only_scatter():
    found = fitted(np.abs(scattered(EXACT, 3, 0.03)))
    assert "% of the mean friction" in found.warnings[-1]
    assert "they suppose a law that can follow the points" in str(found)


@pytest.mark.parametrize("size", [0.0, 1e-4, 1e-3, 1e-2])
def test_points_of_the_law_itself_give_no_warning_whatever_their_scatter(size):
    for seed in range(8):
        assert fitted(scattered(EXACT, seed, size)).warnings == ()


@pytest.mark.parametrize(
    ("low", "high", "text"),
    [
        (0.1, 0.2, "0.1 .. 0.2"),
        (2.8701, 2.8704, "2.8701 .. 2.8704"),
        (0.0, 1.0, "0 .. 1"),
        (5.0, 5.0 + 1e-12, "5 +- 5e-13"),
        (3.0, 3.0, "3 +- 0"),
    ],
)
def test_an_interval_shows_its_width(low, high, text):
    assert spanned(low, high) == text


def test_one_constant_and_one_degree_are_not_plural():
    found = calibrate(
        PACK, speed=[1.0, 50.0], load=1e3, friction=[0.11, 0.08], fit=("decay_speed",)
    )
    assert "1 constant fitted to 2 points" in str(found) and "1 degree of freedom." in str(found)
    alone = calibrate(PACK, speed=[50.0], load=1e3, friction=[0.08], fit=("decay_speed",))
    assert "1 point for 1 constant: no scatter" in alone["decay_speed"].reason
