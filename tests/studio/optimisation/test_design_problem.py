"""What is varied, wanted and limited is read with units; what is wrong is named."""

import numpy as np
import pytest
from bowls import FIGURES, PLACES

from thrustwasher.errors import ParameterError
from thrustwasher.model.quantity import Figure, Quantity
from thrustwasher.studio.optimisation.design_problem import read_problem

SOUND = {"vary": {"x": "-1:1"}, "minimise": ["bowl"]}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"vary": {}}, "vary: nothing is varied"),
        ({"vary": {"z": "0:1"}}, "vary z: there is no such parameter"),
        ({"vary": {"x": "0"}}, "vary x=0: allowed: low:high"),
        ({"vary": {"x": "0:2"}}, r"vary x: 2, allowed: -1 .. 1"),
        ({"vary": {"x": "1:0"}}, "allowed: low below high"),
        ({"vary": {"x": "a:b"}}, "x = 'a', allowed"),
        ({"vary": {"x": (0.0, float("nan"))}}, "x = nan"),
        ({"minimise": []}, "minimise, maximise: 0 figures, allowed: one, or two"),
        ({"minimise": ["bowl", "sum", "other"]}, "3 figures"),
        ({"minimise": ["bowl"], "maximise": ["bowl"]}, "bowl is given twice"),
        ({"minimise": ["bow"]}, "minimise bow: .* did you mean bowl"),
        ({"limits": ["bowl<3"]}, "limit 'bowl<3': allowed: FIGURE<=VALUE"),
        ({"limits": ["bowl<=much"]}, "bowl = 'much'"),
        ({"limits": ["bow<=1"]}, "limit bow: .* did you mean bowl"),
        ({"robust": 1.0}, "robust = 1.0, allowed: 0.5 .. 0.999"),
    ],
)
def test_what_is_wrong_is_named(changes, words):
    with pytest.raises(ParameterError, match=words):
        read_problem(PLACES, FIGURES, **{**SOUND, **changes})


def test_a_choice_is_no_variable():
    places = {"law": Quantity(name="law", unit="1", nominal="a", choices=("a", "b"))}
    with pytest.raises(ParameterError, match="vary law: is a choice or a count"):
        read_problem(places, FIGURES, vary={"law": "1:2"}, minimise=["bowl"])


def test_units_count_in_ranges_and_limits():
    places = {"p": Quantity(name="p", unit="Pa", nominal=1e5, low=0.0, high=1e7)}
    figures = {"t": Figure("t", "K", "")}
    found = read_problem(
        places, figures, vary={"p": "1 bar:0.5 MPa"}, minimise=["t"], limits=["t <= 80 degC"]
    )
    (variable,), (limit,) = found.variables, found.limits
    assert (variable.low, variable.high) == (1e5, 5e5)
    assert limit.upper and limit.bound == pytest.approx(353.15)


def test_costs_and_excess_have_the_sign_of_what_is_wanted():
    problem = read_problem(
        PLACES, FIGURES, vary={"x": "-1:1"}, maximise=["sum"], limits=["bowl<=2", "other>=3"]
    )
    values = np.array([[7.0, 5.0, 1.0]])  # sum, bowl, other
    assert problem.costs(values).tolist() == [[-7.0]]
    assert problem.excess(values).tolist() == [[3.0, 2.0]]


def test_a_design_has_one_place_in_the_cube():
    problem = read_problem(PLACES, FIGURES, vary={"x": "-1:1", "y": "0:0.5"}, minimise=["bowl"])
    row = problem.row(np.array([0.25, 1.0]))
    assert row == {"x": -0.5, "y": 0.5}
    assert problem.point(row).tolist() == [0.25, 1.0]
