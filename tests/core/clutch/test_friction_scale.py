"""The factor on a pack's law of friction: torque, heat and derivatives follow; tables do not."""

from dataclasses import replace

import numpy as np
import pytest

from thrustwasher import ClutchParams, calibrate, solve_clutch
from thrustwasher.clutch.parameters import FRICTION_LAWS, SPEC
from thrustwasher.ladder.error_table import load_tables

POINT = {"load": 3000.0, "speed": 5.0, "oil_temperature": 350.0}
HELD = {"interface_temperature": 350.0}


@pytest.mark.parametrize("level", SPEC.levels)
@pytest.mark.parametrize("law", FRICTION_LAWS)
def test_the_torque_of_a_settled_pack_is_as_the_scale(level, law):
    plain, half = (
        solve_clutch(
            ClutchParams(friction_law=law, friction_scale=k), **POINT, **HELD, fidelity=level
        )
        for k in (1.0, 0.5)
    )
    assert half.friction_torque == pytest.approx(0.5 * plain.friction_torque, rel=1e-12)
    assert half.friction_coefficient == pytest.approx(0.5 * plain.friction_coefficient, rel=1e-12)
    assert half.friction_power == pytest.approx(5.0 * half.friction_torque, rel=1e-14)


def test_shear_of_the_oil_is_not_scaled():
    opened = [
        solve_clutch(ClutchParams(friction_scale=k), load=0.0, speed=50.0) for k in (0.5, 2.0)
    ]
    assert opened[0].friction_torque == opened[1].friction_torque > 0.0


def test_no_table_speaks_for_another_scale():
    assert load_tables("clutch", ClutchParams())
    assert load_tables("clutch", ClutchParams(friction_scale=0.9)) == []


def test_a_fitted_law_is_that_of_the_points_and_has_the_scale_one():
    speed = np.linspace(1.0, 60.0, 8)
    start = ClutchParams.preset("paper", friction_law="constant", friction_scale=0.5)
    found = calibrate(
        start, fit=["constant_friction"], speed=speed, load=1e3, friction=np.full(8, 0.07)
    )
    written = replace(start, friction_temperature="slope")  # with the paper's 0
    assert found.params == replace(written, constant_friction=0.07, friction_scale=1.0)
    torque = solve_clutch(ClutchParams(friction_scale=0.8), **POINT).friction_torque
    data = {**{k: [v] for k, v in POINT.items()}, "friction_torque": [torque]}
    scale = calibrate(ClutchParams(), data, fit=["friction_scale"], errors={"friction_torque": 1.0})
    assert scale.params.friction_scale == pytest.approx(0.8, rel=1e-8)
