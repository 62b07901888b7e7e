"""What the gear's far face borders on: the oil, nothing, or the bulk of the gear."""

from dataclasses import replace

import numpy as np
import pytest

from thrustwasher import ParameterError, WasherParams, solve_washer

BASE = {"load": 300.0, "speed": 545.0, "tilt": 2e-3}
OIL = 297.15
INSULATED = WasherParams(gear_far_face="insulated")
BULK = WasherParams(gear_far_face="bulk")


def test_a_far_face_as_warm_as_the_oil_is_that_of_the_oil():
    oil, bulk, told = (
        solve_washer(params, **BASE, **more)
        for params, more in (
            (WasherParams(), {}),
            (BULK, {}),
            (BULK, {"far_face_temperature": OIL}),
        )
    )
    assert bulk.friction_torque == oil.friction_torque == told.friction_torque
    assert bulk.temperature == oil.temperature == told.temperature
    said = "without a far_face_temperature: the oil's is taken"
    assert said in bulk.warnings[0] and not oil.warnings and not told.warnings


def test_an_insulated_gear_is_between_none_and_one_as_warm_as_it_would_become():
    """With the far face as warm as the insulated gear no heat passes it: the same washer."""
    params = replace(INSULATED, conductivity_gear=400.0)  # its radial differences are small
    free = solve_washer(params, **BASE)
    gear = free.fields().gear_temperature
    told = float(np.nanmean(gear))
    bulk = solve_washer(replace(params, gear_far_face="bulk"), **BASE, far_face_temperature=told)
    assert np.nanmax(gear) - np.nanmin(gear) < 0.5
    assert bulk.friction_torque == pytest.approx(free.friction_torque, rel=2e-3)
    assert free.temperature > solve_washer(WasherParams(), **BASE).temperature


@pytest.mark.parametrize(
    ("params", "more", "said"),
    [
        (WasherParams(), {"far_face_temperature": 330.0}, "with gear_far_face = 'bulk'"),
        (BULK, {"far_face_temperature": 80.0}, "0 \\(the oil's\\) or 233.15"),
        (BULK, {"fidelity": "map"}, "a map has no far_face_temperature"),
    ],
)
def test_a_far_face_in_vain_is_refused(params, more, said):
    with pytest.raises(ParameterError, match=said):
        solve_washer(params, **BASE, **more)
