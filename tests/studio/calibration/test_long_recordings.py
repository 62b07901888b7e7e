"""Recordings with many rows, rigs that turn both ways, numbers without their unit."""

import numpy as np
import pytest

from thrustwasher import ClutchParams, ParameterError, calibrate, solve_clutch
from thrustwasher.model.quantity import Quantity
from thrustwasher.studio.calibration.identifiability import information
from thrustwasher.studio.calibration.least_squares import FitProblem, Search
from thrustwasher.studio.calibration.row_groups import GROUPS
from thrustwasher.studio.calibration.signs import folded, too_fast

PACK = ClutchParams()
FORWARD = np.array([10.0, 50.0, 100.0, 200.0, 300.0])


def recording(n, seed=1, **changes):
    """Return columns of a pack's torque at random points, with 1 % of noise."""
    rng = np.random.default_rng(seed)
    pack = ClutchParams(**changes)
    speed, load = rng.uniform(0.1, 6.0, n), rng.uniform(1e3, 8e3, n)
    torque = [
        solve_clutch(pack, load=f, speed=w).friction_torque * (1.0 + 0.01 * e)
        for f, w, e in zip(load, speed, rng.standard_normal(n), strict=True)
    ]
    return {"load": load, "speed": speed, "friction_torque": np.array(torque)}


@pytest.mark.slow
def test_a_long_recording_is_fitted_by_means_of_its_rows_without_a_bias():
    off = []
    for seed in range(4):
        found = calibrate(PACK, recording(4000, seed, friction_scale=0.9), fit=["friction_scale"])
        assert len(found.points.value) == GROUPS
        assert any("4000 rows are fitted as 256 means of 15 to 16" in w for w in found.warnings)
        (scale,) = found.estimates
        off.append((scale.value - 0.9) / scale.standard_error)
        # 1 % of noise on 4000 rows
        assert 0.5 * 0.01 / 4000**0.5 < scale.standard_error / 0.9 < 2.5 * 0.01 / 4000**0.5
    assert max(map(abs, off)) < 3.5 and abs(np.mean(off)) < 1.75


def test_what_points_tell_takes_no_memory_of_rows_squared(monkeypatch):
    n, shapes = 20_000, []
    svd = np.linalg.svd

    def watched(matrix, **options):
        parts = svd(matrix, **options)
        shapes.extend(part.shape for part in parts)
        return parts

    x = np.linspace(0.0, 1.0, n)
    line = FitProblem(
        computed=lambda values: values["a"] + values["b"] * x,
        exact_slopes=lambda values, names: np.column_stack([np.ones(n), x]),
        search=Search(resolution=1e-9),
        base={},
        quantities=(Quantity(name="a"), Quantity(name="b")),
        measured=x,
        weight=np.ones(n),
        low=np.full(2, -9.0),
        high=np.full(2, 9.0),
        scale=np.ones(2),
        logarithmic=np.zeros(2, bool),
        known_errors=True,
    )
    monkeypatch.setattr(np.linalg, "svd", watched)
    told = information(line, np.array([0.0, 1.0]), 0.95)
    assert told.rank == 2 and max(np.prod(shape) for shape in shapes) <= 2 * n


@pytest.mark.parametrize("odd", [False, True])
@pytest.mark.parametrize("signed", [False, True])
def test_both_directions_of_a_rig_count_as_the_model_gives_them(signed, odd):
    speed = np.append(FORWARD, -FORWARD)
    size = np.full(10, 0.12)
    given = size * np.sign(speed) if signed else size
    found, said = folded("friction", given, speed, None, range(10), odd=odd)
    np.testing.assert_array_equal(found, size * np.sign(speed) if odd else size)
    assert ("5 points turn backwards" in said) == (signed != odd)


def test_a_sign_against_the_others_is_refused_by_number_unless_it_is_noise():
    friction, speed = np.append(np.full(5, 0.12), -0.002), np.append(FORWARD, 60.0)
    assert folded("friction", friction, speed, None, range(6), odd=False)[1] == ""
    friction[5] = -0.12
    with pytest.raises(ParameterError, match=r"point 6 is -0\.12 at a speed of 60 rad/s"):
        folded("friction", friction, speed, None, range(6), odd=False)


def test_within_three_deviations_a_sign_is_noise():
    friction, speed = np.append(np.full(5, 0.12), -0.02), np.append(FORWARD, 60.0)
    folded("friction", friction, speed, np.full(6, 0.01), range(6), odd=False)
    with pytest.raises(ParameterError, match="point 6"):
        folded("friction", friction, speed, np.full(6, 0.006), range(6), odd=False)


def test_speeds_that_no_part_slides_at_are_doubted_with_the_unit_they_would_fit():
    assert too_fast(np.array([300.0]), 0.075) == ""
    text = too_fast(np.array([10.0, -3000.0]), 0.075)
    assert "3000 rad/s, 225 m/s" in text and "speed [rpm]" in text
    assert "rpm" not in too_fast(np.array([1e6]), 0.075)
    data = {"speed": FORWARD * 10.0, "load": 3e3, "friction": [0.13, 0.125, 0.12, 0.115, 0.11]}
    assert any("225 m/s" in text for text in calibrate(PACK, data).warnings)
