"""A warning fails a test if this package or a test causes it, and not if another package does."""

import warnings

import pytest

OURS = ["thrustwasher", "thrustwasher.washer.solve", "test_warnings", "built", "ex01_washer"]


def warn_from(module, category):
    names = {"__name__": module, "warn": warnings.warn, "category": category}
    exec("warn('said', category)", names)


@pytest.mark.parametrize("module", OURS)
def test_our_own_warnings_are_errors(module):
    for category in (UserWarning, DeprecationWarning, RuntimeWarning):
        with pytest.raises(category, match="said"):
            warn_from(module, category)


@pytest.mark.parametrize("module", ["matplotlib.pyplot", "pytest", "thrustwashers", "importlib"])
def test_what_others_warn_of_among_themselves_is_not(module):
    warn_from(module, DeprecationWarning)
