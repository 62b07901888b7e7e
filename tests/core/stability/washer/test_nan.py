"""What is no number is refused by name; what was solved before is not harmed.

Hazard: a NaN passes every test written as "stop if larger": the loop ends with status OK, and the
    memory is poisoned for good.
Formula: not (low <= NaN <= high), and NaN != NaN.
Cure: ranges are requested, not exceeded; memory is taken over only after a solution is all
    finite.
"""

import math

import pytest

from thrustwasher import ParameterError, WasherParams

from washer_runs import is_sound, solve  # isort: skip


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("name", ["load", "speed", "tilt", "oil_temperature"])
def test_operating_points_that_are_no_numbers(name, value):
    good = solve()
    with pytest.raises(ParameterError, match=name):
        solve(**{name: value}, start=good)
    again = solve(start=good)
    assert is_sound(again)
    assert again.friction_torque == pytest.approx(good.friction_torque, rel=1e-6)


def test_parameters_that_are_no_numbers():
    with pytest.raises(ParameterError, match="roughness"):
        WasherParams(roughness=math.nan)
