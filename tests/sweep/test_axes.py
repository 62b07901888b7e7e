"""What can be written behind --over, and what is refused in which words."""

import math
from itertools import pairwise

import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.sweep.axes import parse_values, places, read_axis
from thrustwasher.washer.parameters import SPEC

KNOWN = places(SPEC)


def values(name, text):
    return list(read_axis(name, text, KNOWN, SPEC).values)


def test_a_range_ends_on_its_stop_exactly():
    assert values("load", "50:1850:50")[-1] == 1850.0
    assert values("load", "1:2:0.1")[-1] == 2.0
    assert len(values("load", "1:2:0.1")) == 11


def test_a_range_stops_before_it_passes_the_stop():
    assert values("load", "50:190:50") == [50.0, 100.0, 150.0]


def test_a_range_may_go_down():
    assert values("load", "300:100:-100") == [300.0, 200.0, 100.0]


def test_ranges_and_values_join_into_one_line():
    assert values("load", "100:300:100,200:100:-100") == [100.0, 200.0, 300.0, 200.0, 100.0]


def test_equal_ratios_and_equal_differences_keep_both_ends():
    even, log = values("load", "20:1850:n4"), values("load", "20:1850:x4")
    assert even == pytest.approx([20.0, 630.0, 1240.0, 1850.0])
    assert (even[0], even[-1], log[0], log[-1]) == (20.0, 1850.0, 20.0, 1850.0)
    assert [b / a for a, b in pairwise(log)] == pytest.approx([92.5 ** (1 / 3)] * 3)


def test_numbers_take_units_and_a_step_of_temperature_is_a_difference():
    warmer = values("oil_temperature", "24 degC:44 degC:10 degC")
    assert warmer == pytest.approx([297.15, 307.15, 317.15])
    assert values("speed", "3000 rpm") == pytest.approx([100.0 * math.pi])


def test_a_unit_behind_the_name_holds_for_bare_numbers():
    assert values("oil_temperature [degC]", "24:44:20") == pytest.approx([297.15, 317.15])
    assert values("load [kN]", "1, 200 N") == [1000.0, 200.0]


def test_parameters_are_varied_by_their_kind():
    assert values("friction_law", "load,constant") == ["load", "constant"]
    assert values("roughness", "3e-7,0.4 um") == pytest.approx([3e-7, 4e-7])


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("laod", "1:2:1", "did you mean load?"),
        ("load", "1:2", "start:stop:step"),
        ("load", "1:2:-1", "a step that leads from start to stop"),
        ("load", "1:2:0", "a step that leads from start to stop"),
        ("load", "1:2:n1", "2 .. "),
        ("speed", "-10:10:x5", "one sign"),
        ("load", "1:99999:1", "allowed: 0 .. 10000 N"),
        ("load", "1:9999:1e-9", "more than"),
        ("load", "heavy", "load = 'heavy'"),
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


def test_no_value_is_refused():
    with pytest.raises(ParameterError, match="no value"):
        read_axis("load", [], KNOWN, SPEC)


def test_a_bare_number_is_si():
    assert parse_values("0.002", KNOWN["tilt"]) == [0.002]
