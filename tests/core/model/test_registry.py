"""Models are found by key, name or the place of their interface; lists and limits fit them."""

import pytest

from lab.charts.work_precision import CHARTS
from thrustwasher.clutch.kernels import layout as clutch
from thrustwasher.errors import ParameterError
from thrustwasher.gearmesh.kernels.mesh_point import HOT_FILM
from thrustwasher.gearmesh.parameters import SPEC
from thrustwasher.model.registry import find_spec, models_with_error_tables, models_with_points
from thrustwasher.studio.report.model_plots import FIGURES
from thrustwasher.studio.verification.reference_cache import SOURCES
from thrustwasher.washer.kernels import layout as washer


@pytest.mark.parametrize("name", ["gearmesh", "GearMesh", "thrustwasher.gearmesh.parameters:SPEC"])
def test_a_model_is_found_by_any_of_its_names(name):
    assert find_spec(name) is SPEC


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("wheel", ""),
        ("a:b", "No module named 'a'"),
        ("json:SPEC", "no attribute 'SPEC'"),
        (":SPEC", "Empty module name"),
        (".json:SPEC", "package"),
        ("json:loads", "no ModelSpec"),
        ("/", r"\(a folder\)"),
    ],
)
def test_what_is_no_model_is_refused_with_those_there_are(name, why):
    with pytest.raises(ParameterError, match=rf"model = '{name}'.*{why}.*, allowed: Thrust.*Wet"):
        find_spec(name)


def test_what_lies_above_the_models_has_all_that_offer_it():
    plotted = {key for key, model in models_with_points().items() if model.command.plot}
    assert FIGURES.keys() == plotted
    assert SOURCES.keys() == CHARTS.keys() == models_with_error_tables().keys()


@pytest.mark.parametrize(
    ("model", "name", "limit"),
    [
        ("washer", "temperature_max", washer.HOT_LIMIT),
        ("clutch", "temperature", clutch.HOT_LIMIT),
        ("gearmesh", "film_temperature", HOT_FILM),
    ],
)
def test_outputs_have_the_limits_of_the_kernels(model, name, limit):
    assert {s.name: s.limit for s in find_spec(model).outputs if s.limit} == {name: limit}
