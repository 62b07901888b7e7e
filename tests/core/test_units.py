"""Quantities as people write them."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from thrustwasher.errors import ParameterError
from thrustwasher.units import UNITS, format_quantity, parse_quantity


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("24 degC", "K", 297.15),
        ("75.2 degF", "K", 297.15),
        ("3000 rpm", "rad/s", 100.0 * math.pi),
        ("1 MPa", "Pa", 1e6),
        ("0.1 deg", "rad", math.pi / 1800.0),
        ("1.2kN", "N", 1200.0),
        ("-5e2 mm", "m", -0.5),
        ("2 N·m", "N.m", 2.0),
        ("250 N*mm", "N.m", 0.25),
        ("250 Nmm", "N.m", 0.25),
        ("250 mNm", "N.m", 0.25),
        ("250 N mm", "N.m", 0.25),
        ("1.2 kN⋅m", "N.m", 1200.0),
        ("1.2 N-m", "N.m", 1.2),
        ("12 in.lbf", "N.m", 4.4482216152605 * 0.3048),  # 1 lbf on 1 ft
        ("3000 min^-1", "rad/s", 100.0 * math.pi),
        ("0.3 N/mm²", "Pa", 3e5),
        (" 1.5 µm ", "m", 1.5e-6),
        ("0.7 W/(m.K)", "W/(m.K)", 0.7),
        ("300", "N", 300.0),
        (".5", "1", 0.5),
        (7.5, "K", 7.5),
    ],
)
def test_a_written_quantity_becomes_si(text, unit, value):
    assert parse_quantity(text, unit, "x") == pytest.approx(value, rel=1e-15)


def test_a_difference_of_temperatures_has_no_offset():
    assert parse_quantity("10 degC", "K", "rise", difference=True) == 10.0
    assert parse_quantity("18 degF", "K", "rise", difference=True) == pytest.approx(10.0)
    assert format_quantity(10.0, "K", difference=True) == "10 K"


@pytest.mark.parametrize(
    "value", ["24 degC", "", "nan", "1e999", "3,5 N", "300 N extra", True, None]
)
def test_what_is_no_load_is_refused_in_one_line(value):
    with pytest.raises(ParameterError) as caught:
        parse_quantity(value, "N", "load")
    message = str(caught.value)
    assert "load" in message and repr(value) in message and "kN" in message
    assert "\n" not in message


@given(st.floats(-1e9, 1e9), st.sampled_from([(u, w) for u in UNITS for w in UNITS[u]]))
def test_every_unit_is_affine(number, pair):
    unit, written = pair
    factor, offset = UNITS[unit][written]
    value = parse_quantity(f"{number!r} {written}", unit, "x")
    assert value == pytest.approx(factor * number + offset, rel=1e-15, abs=1e-13 * offset)


def test_a_number_with_a_unit_is_rounded_once():
    assert parse_quantity("635 um", "m", "washer_thickness") == 635e-6 != 1e-6 * 635


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (297.15, "K", "24 °C"),
        (1.12e-5, "m", "11.2 µm"),
        (0.0, "m", "0 m"),
        (2e-3, "rad", "2 mrad"),
        (953.0, "rad/s", "953 rad/s"),
        (1.29e9, "Pa", "1.29 GPa"),
        (46012.3, "J", "46.01 kJ"),
        (0.54e6, "J/m2", "0.54 J/mm²"),
        (-0.5, "N.m", "-0.5 N·m"),
        (0.11, "1", "0.11"),
        (6.865114e9, "1/m2", "6.865e+09 1/m²"),
    ],
)
def test_a_number_is_shown_with_a_readable_unit(value, unit, text):
    assert format_quantity(value, unit) == text
