"""A small map: quick to build, and with folds in it."""

import pytest

from thrustwasher.washer.map.look_up import WasherMap
from thrustwasher.washer.map.map_build import make_map
from thrustwasher.washer.map.map_file import VARIABLE
from thrustwasher.washer.parameters import WasherParams

BOX = {
    "load": (100.0, 1100.0),
    "speed": (400.0, 700.0),
    "tilt": (0.0018, 0.0022),
    "oil_temperature": (297.15, 297.15),
}


@pytest.fixture(scope="session")
def map_path(tmp_path_factory):
    path = tmp_path_factory.mktemp("maps") / "small.twm"
    make_map(WasherParams(), path, box=BOX, fidelity="field", workers=1, points=8)
    return path


@pytest.fixture(scope="session")
def small(map_path):
    return WasherMap(WasherParams(), map_path)


@pytest.fixture
def found_first(map_path, monkeypatch):
    """Let the small map be the one that is found for the default washer."""
    monkeypatch.setenv(VARIABLE, str(map_path.parent))
    return map_path
