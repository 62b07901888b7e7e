"""Models are found by key, by name or by the place of their interface; what is none is named."""

import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.gearmesh.parameters import SPEC
from thrustwasher.model.registry import find_spec


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
    ],
)
def test_what_is_no_model_is_refused_with_those_there_are(name, why):
    with pytest.raises(ParameterError, match=rf"model = '{name}'.*{why}.*, allowed: Thrust.*Wet"):
        find_spec(name)
