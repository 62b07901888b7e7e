"""Results that several files look at."""

import pytest
from scene_runs import shift


@pytest.fixture(scope="session")
def default_shift():
    """Return the default scene's result at its default step."""
    return shift("planetary")
