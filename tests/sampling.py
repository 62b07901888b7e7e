"""How much is tried: a few by default, the many by mark."""

import pytest


def sizes(few, many, mark=pytest.mark.slow):
    """Return a test's argument ``n``: ``few`` in the default run, ``many`` under the mark."""
    return pytest.mark.parametrize("n", [few, pytest.param(many, marks=mark)])
