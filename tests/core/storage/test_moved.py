"""Modules that had another name: what was pickled then is still read."""

import pickle
import re
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

from thrustwasher import calibrate
from thrustwasher.moved import MOVED, new_name

SLIP = np.array([0.01, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0])


def as_before(result):
    """Return a result pickled with the names that modules had; protocol 0 has them as text."""
    text = pickle.dumps(result, protocol=0).decode("latin-1")
    for old, new in sorted(MOVED.items(), key=lambda pair: -len(pair[1])):
        text = re.sub(rf"thrustwasher\.{re.escape(new)}\b", f"thrustwasher.{old}", text)
    return text.encode("latin-1")


@pytest.mark.parametrize("old", MOVED)
def test_an_old_name_is_the_same_module(old):
    here = import_module(f"thrustwasher.{MOVED[old]}")
    assert import_module(f"thrustwasher.{old}") is here
    assert here.__name__ == here.__spec__.name == f"thrustwasher.{MOVED[old]}"


def test_what_lies_in_a_folder_went_with_it():
    name = "thrustwasher.clutch.calibration.friction_law"
    assert import_module(name) is import_module(new_name(name))
    assert new_name("thrustwasher.clutch.kernels") == new_name("elsewhere.clutch.calibration") == ""
    with pytest.raises(ModuleNotFoundError, match="nothing"):
        import_module("thrustwasher.clutch.calibration.nothing")


def test_a_pickled_fit_of_an_older_version_is_read():
    data = {"speed": SLIP / 0.05, "load": 1000.0, "friction": 0.12 + 0.03 * np.exp(-SLIP / 0.3)}
    found = calibrate("clutch", data)
    old = as_before(found)
    assert b"thrustwasher.clutch.calibration.friction_fit" in old
    assert pickle.loads(old).to_dict() == found.to_dict()


def test_no_page_but_the_one_on_names_has_an_old_name():
    root = Path(__file__).parents[3]
    for page in (root / "README.md", *(root / "docs").rglob("*.md")):
        named = re.findall(r"\bthrustwasher(?:\.\w+)+", page.read_text("utf-8"))
        assert page.name == "migration.md" or [n for n in named if new_name(n)] == [], page
