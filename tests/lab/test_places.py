"""Places of parameters and outputs in the kernels: written from the models' lists, not by hand."""

import pytest

from lab.places import lines_of, modules, written


@pytest.mark.parametrize(("path", "spec"), modules(), ids=lambda x: getattr(x, "key", ""))
def test_the_kernels_places_are_those_of_the_parameters_and_outputs(path, spec):
    text = path.read_text("utf-8")
    assert text == written(text, spec), "run python -m lab.places"


def test_the_models_have_such_places():
    """A model that is made of others' parameters, or of rows of its own, may have none."""
    found = [
        path for path, _ in modules() if "# places: P_ of parameters" in path.read_text("utf-8")
    ]
    assert len(found) >= 7


def test_the_number_in_a_line_is_that_of_the_name_and_a_row_has_one_name():
    names = ["P_A", "P_SPEED_1", "P_SPEED_2", "P_B", "N_PARAM"]
    assert list(lines_of(names)) == ["P_A, P_SPEED_1 = range(0, 2)", "P_B, N_PARAM = range(3, 5)"]
