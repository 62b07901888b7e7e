"""Dry friction over the mean contact pressure, and its earlier form over the load."""

import math

import pytest

from thrustwasher import ParameterError, WasherParams, load_part, solve_washer
from thrustwasher.model.parameters import as_numbers
from thrustwasher.washer.kernel_arguments import constants
from thrustwasher.washer.kernels.gap import dry_friction

GRID = (10, 32)
HALF = {"inner_radius": 0.00555, "outer_radius": 0.01135, "gear_inner_radius": 0.0078}


def friction(params, load):
    return dry_friction(constants(params, GRID), load)[0]


def test_washers_of_different_size_have_the_same_friction_at_the_same_pressure():
    for load in (100.0, 300.0, 900.0):
        small = friction(WasherParams(**HALF), load / 4.0)
        own = math.pi * (0.01135**2 - 0.00555**2) / (math.pi * (0.0227**2 - 0.0111**2))
        assert own == pytest.approx(0.25, rel=1e-12)
        assert small == pytest.approx(friction(WasherParams(), load), rel=1e-12)


OVER_LOAD = {"friction_constant": 0.4, "friction_load_min": 50.0, "friction_load_max": 900.0}


@pytest.mark.parametrize("size", [{}, HALF])
def test_a_law_over_the_load_holds_for_the_washer_it_is_given_for(size):
    params = WasherParams(**size, **OVER_LOAD, friction_slope=0.04)
    for load in (10.0, 50.0, 300.0, 2000.0):
        expected = 0.4 - 0.04 * math.log(min(max(load, 50.0), 900.0))
        assert friction(params, load) == pytest.approx(expected, rel=1e-13)


def test_a_part_file_of_the_earlier_form_reads_as_before(tmp_path):
    file = tmp_path / "old.toml"
    file.write_text(
        'model = "washer"\nname = "Old"\n[parameters]\ninner_radius = "5.55 mm"\n'
        'outer_radius = "11.35 mm"\ngear_inner_radius = "7.8 mm"\nfriction_constant = 0.48\n'
        'friction_slope = 0.05\nfriction_load_min = "260.5 N"\nfriction_load_max = "1725.6 N"\n'
    )
    part = load_part(file)
    assert "friction_load_min" not in part.parameters
    assert part.params == WasherParams(**HALF, friction_load_min=260.5)
    assert as_numbers(part.model.params()) == as_numbers(part.params)
    assert friction(part.params, 300.0) == pytest.approx(0.48 - 0.05 * math.log(300.0), rel=1e-13)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"friction_load_min": 2000.0}, "friction_load_min = 2000 N, allowed: below"),
        ({"friction_load_min": -1.0}, "friction_load_min"),
        (
            {"friction_load_min": 100.0, "friction_pressure_min": 1e5},
            "together with friction_pressure_min",
        ),
        ({"friction_pressure_min": 2e6}, "friction_pressure_min"),
    ],
)
def test_friction_data_that_contradict_each_other_are_refused(given, said):
    with pytest.raises(ParameterError, match=said):
        WasherParams(**given)


def test_pressures_outside_the_data_are_told():
    inside = solve_washer(WasherParams(), load=1361.0, speed=136.0, tilt=2e-3)
    below = solve_washer(WasherParams(**HALF), load=40.0, speed=5.0, tilt=1e-3)
    full = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=2e-3)
    assert not any("dry friction" in line for line in (*inside.warnings, *full.warnings))
    (line,) = (line for line in below.warnings if "dry friction" in line)
    assert "held" in line
