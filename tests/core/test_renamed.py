"""Names of earlier versions work for one version, with a warning that names the new one."""

import pickle
import re
from pathlib import Path

import pytest

import thrustwasher
from thrustwasher import ClutchParams, ParameterError, load_part
from thrustwasher.clutch import parameters
from thrustwasher.fmu.description.interface import interface
from thrustwasher.model.registry import find_spec
from thrustwasher.model.toml_tables import spec_beside
from thrustwasher.washer import follow

NOW = "input_course is now input_profile"


@pytest.mark.parametrize(
    ("module", "old", "new"),
    [
        (thrustwasher, "WasherCourse", "WasherHistory"),
        (follow, "WasherCourse", "WasherHistory"),
        (follow, "CourseError", "HistoryError"),
    ],
)
def test_a_class_by_its_former_name_is_the_same(module, old, new):
    with pytest.warns(DeprecationWarning, match=f"{old} is now .*{new}"):
        assert getattr(module, old) is getattr(module, new)
    assert old not in dir(thrustwasher)


def test_what_is_no_name_stays_an_attribute_error():
    for module in (thrustwasher, follow):
        with pytest.raises(AttributeError, match="WasherCurse"):
            module.WasherCurse  # noqa: B018


def test_the_part_before_a_failure_by_its_former_name():
    problem = follow.HistoryError("text", "history")
    with pytest.warns(DeprecationWarning, match=r"HistoryError\.history"):
        assert problem.course == problem.history == "history"


def test_a_parameter_by_its_former_name():
    with pytest.warns(FutureWarning, match=NOW):
        params = ClutchParams(input_course="linear")
    assert params == ClutchParams(input_profile="linear")
    assert params.input_course == "linear" and pickle.loads(pickle.dumps(params)) == params
    with pytest.raises(ParameterError, match="one of the two"):
        ClutchParams(input_course="held", input_profile="linear")


def test_a_part_file_with_a_former_name(tmp_path):
    path = tmp_path / "pack.toml"
    path.write_text('model = "clutch"\nname = "Pack"\n[parameters]\ninput_course = "linear"\n')
    with pytest.warns(FutureWarning, match=rf"pack\.toml.* {NOW}"):
        assert load_part(path).params.input_profile == "linear"


def test_the_interface_of_an_own_model_with_a_former_name(tmp_path):
    own = tmp_path / "interface.toml"
    text = Path(parameters.__file__).with_name(own.name).read_text("utf-8")
    own.write_text(re.sub("(?m)^profile = ", "course = ", text), "utf-8")
    with pytest.warns(FutureWarning, match=r"interface\.toml: course is now profile"):
        spec = spec_beside(str(own.with_name("parameters.py")), ClutchParams)
    assert spec.profile == find_spec("clutch").profile != ()


def test_the_fmu_has_the_new_name_alone():
    names = [v.name for v in interface(find_spec("clutch")).variables]
    assert "input_profile" in names and "input_course" not in names
