"""Modules have one name; what had another is refused by the one it has."""

import subprocess
import sys

import pytest

import thrustwasher
from thrustwasher import ClutchParams, ParameterError, load_part
from thrustwasher.cli import main
from thrustwasher.fmu.description.interface import interface
from thrustwasher.model.registry import find_spec


def test_importing_the_package_leaves_the_ways_of_import_alone():
    words = (
        "import sys; own = list(sys.meta_path); import thrustwasher; assert sys.meta_path == own"
    )
    subprocess.run([sys.executable, "-c", words], check=True)


@pytest.mark.parametrize("name", ["WasherCourse", "WasherCurse"])
def test_what_is_no_name_is_an_attribute_error(name):
    with pytest.raises(AttributeError, match=name):
        getattr(thrustwasher, name)


def test_a_former_parameter_is_refused_in_a_part_file(tmp_path):
    path = tmp_path / "pack.toml"
    path.write_text('model = "clutch"\nname = "Pack"\n[parameters]\ninput_course = "linear"\n')
    with pytest.raises(ParameterError, match="did you mean 'input_profile'"):
        load_part(path)
    names = [v.name for v in interface(find_spec("clutch")).variables]
    assert "input_profile" in names and not hasattr(ClutchParams(), "input_course")


def test_a_former_command_names_the_one_of_now(capsys):
    assert main(["cards"]) == 2
    assert "thrustwasher fidelity" in capsys.readouterr().err
