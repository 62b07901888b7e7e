"""What can be written behind --over, and what is refused in which words."""

import math
from itertools import pairwise

import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.settings import places
from thrustwasher.studio.sweep.axes import read_axis
from thrustwasher.washer.parameters import SPEC

KNOWN = places(SPEC)


def values(name, text):
    return list(read_axis(name, text, KNOWN, SPEC).values)


@pytest.mark.parametrize(
    ("name", "text", "wanted"),
    [
        ("load", "50:190:50", [50.0, 100.0, 150.0]),
        ("load", "300:100:-100", [300.0, 200.0, 100.0]),
        ("load", "100:300:100,200:100:-100", [100.0, 200.0, 300.0, 200.0, 100.0]),
        ("oil_temperature", "24 degC:44 degC:10 degC", [297.15, 307.15, 317.15]),
        ("speed", "3000 rpm", [100.0 * math.pi]),
        ("oil_temperature [degC]", "24:44:20", [297.15, 317.15]),
        ("load [kN]", "1, 200 N", [1000.0, 200.0]),
        ("roughness", "3e-7,0.4 um", [3e-7, 4e-7]),
        ("tilt", "0.002", [0.002]),
    ],
)
def test_ranges_values_and_units_are_read(name, text, wanted):
    """A step of temperature is a difference; a unit behind the name holds for bare numbers."""
    assert values(name, text) == pytest.approx(wanted)


def test_a_range_ends_on_its_stop_exactly():
    assert values("load", "50:1850:50")[-1] == 1850.0
    assert values("load", "1:2:0.1")[-1] == 2.0
    assert len(values("load", "1:2:0.1")) == 11


def test_equal_ratios_and_equal_differences_keep_both_ends():
    even, log = values("load", "20:1850:n4"), values("load", "20:1850:x4")
    assert even == pytest.approx([20.0, 630.0, 1240.0, 1850.0])
    assert (even[0], even[-1], log[0], log[-1]) == (20.0, 1850.0, 20.0, 1850.0)
    assert [b / a for a, b in pairwise(log)] == pytest.approx([92.5 ** (1 / 3)] * 3)


def test_choices_are_varied_by_their_names():
    assert values("friction_law", "load,constant") == ["load", "constant"]


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("load", "1:2", "start:stop:step"),
        ("load", "1:2:-1", "a step from start towards stop"),
        ("load", "1:2:n1", "2 .. "),
        ("speed", "-10:10:x5", "one sign"),
        ("load", "1:999999:1", "allowed: 0 .. 200000 N"),
        ("load", "1:9999:1e-9", "more than"),
        ("load", "1 m", "in kN"),
        ("load", "1,,2", "load = ''"),
        ("load [m]", "1", "in kN"),
        ("friction_law", "sticky", "'load' or 'constant'"),
        ("roughness", "1", "allowed: 1.5e-07 .. 1e-05 m"),
    ],
)
def test_what_is_wrong_is_named(name, text, says):
    with pytest.raises(ParameterError) as caught:
        values(name, text)
    assert says in str(caught.value)
