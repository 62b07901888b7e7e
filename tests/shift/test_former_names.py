"""Names of 0.6 that examples and docs told are found for one more minor version, with a warning."""

import importlib

import pytest


@pytest.mark.parametrize(
    "module, name, now",
    [
        ("drivetrain", "load_scene", "shift"),
        ("drivetrain", "run_shift", "shift"),
        ("drivetrain", "Scene", "shift"),
        ("drivetrain", "ShiftResult", "shift"),
        ("fmu.direct", "DirectInstance", "fmu.running.direct_instance"),
    ],
)
def test_a_former_name_is_the_new_one_and_says_so(module, name, now):
    former, present = (importlib.import_module(f"thrustwasher.{m}") for m in (module, now))
    with pytest.warns(DeprecationWarning, match=rf"thrustwasher\.{now}"):
        found = getattr(former, name)
    assert found is getattr(present, name)


def test_a_name_that_never_was_is_none():
    with pytest.raises(AttributeError, match="nothing_like_it"):
        importlib.import_module("thrustwasher.drivetrain").nothing_like_it  # noqa: B018


def test_a_former_submodule_is_no_second_copy():
    with pytest.raises(ModuleNotFoundError):
        importlib.import_module("thrustwasher.drivetrain.scene")
