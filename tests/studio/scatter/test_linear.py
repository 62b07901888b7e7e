"""The standard deviation by gradient: exact where a figure is linear, a warning where it is not."""

import math
from dataclasses import replace

import numpy as np
import pytest

from thrustwasher import GearMeshParams, propagate
from thrustwasher.model.part_file import find_part
from thrustwasher.studio.evaluators.part import part_evaluator
from thrustwasher.studio.scatter.linear import linear_deviations
from thrustwasher.studio.scatter.target import target_of


def deviations(name, table, **parameters):
    part = find_part(name)
    part = replace(part, parameters={**part.parameters, **parameters})
    target = target_of(part_evaluator(part, part.starts), part.scattered(table))
    return linear_deviations(target), dict(
        zip((f.name for f in target.figures), target.nominal(), strict=False)
    )


def test_a_figure_in_proportion_to_a_source_has_its_relative_deviation():
    found, nominal = deviations("clutch", {"friction_scale": "5 %"}, friction_temperature_slope=0.0)
    share = found["friction_coefficient"] / nominal["friction_coefficient"]
    assert share == pytest.approx(0.05, rel=2e-3)


def test_independent_sources_add_as_squares_and_correlated_ones_do_not():
    one, nominal = deviations("clutch", {"friction_scale": "3 %"})
    other, _ = deviations("clutch", {"load": "4 %"})
    both = {"friction_scale": "3 %", "load": "4 %"}
    apart, _ = deviations("clutch", both)
    name = "friction_torque"
    assert apart[name] == pytest.approx(math.hypot(one[name], other[name]), rel=1e-6)
    joined, _ = deviations("clutch", {**both, "correlation": [["friction_scale", "load", 0.99]]})
    assert apart[name] < 1.2 * apart[name] < joined[name] < one[name] + other[name]
    assert nominal[name] > 0.0


def test_choices_have_no_gradient():
    assert deviations("gearmesh", {"load_sharing": {"either": ["rigid", "elastic"]}})[0] == {}
    assert GearMeshParams().load_sharing == "rigid"


def test_a_film_that_some_runs_lose_is_a_warning():
    found = propagate(
        "washer",
        scatter={"load": {"uniform": [300.0, 1500.0]}},
        at={"speed": 545.0, "tilt": 0.002},
        runs=64,
        indices=False,
        outputs=["friction_torque"],
        workers=1,
    )
    assert 0.01 < found.probabilities["film_lost"].value < 0.99
    assert any("a gradient knows one of both branches" in text for text in found.warnings)
    band = found.figures["friction_torque"]
    assert band.linear_deviation < 0.8 * band.standard_deviation
    assert any("by gradient is more than 20 % off" in text for text in found.warnings)
    assert np.isfinite(found.as_dict()["figures"]["friction_torque"]["linear_deviation"])
