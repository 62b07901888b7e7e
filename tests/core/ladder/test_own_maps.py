"""A part's map is built once, whoever else builds it; only one within its tolerance serves."""

from types import SimpleNamespace

import pytest

from thrustwasher.ladder.own_tables import ensure, serves
from thrustwasher.native.files import user_cache
from thrustwasher.storage import journal
from thrustwasher.storage.digests import params_digest
from thrustwasher.storage.journal import Journal
from thrustwasher.washer.parameters import WasherParams

PARAMS, BOX = WasherParams(), {"load": (20.0, 100.0)}


class Tables:
    """A map that is built by a call; ``metadata`` is what it says of itself."""

    def __init__(self, **metadata):
        self.metadata, self.built = metadata, 0

    def box(self, params):
        from thrustwasher.errors import ParameterError

        if not self.metadata:
            raise ParameterError("there is no map")
        return BOX

    def find(self, params):
        return SimpleNamespace(metadata=self.metadata)

    def least(self, name, ends):
        return ends[0]

    def build(self, params, box, tol, workers, progress):
        self.built += 1
        self.metadata = {"tolerance": tol}


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(journal, "LOOK", 0.01)


def lock():
    return Journal(user_cache() / "maps" / f"{params_digest(PARAMS)[:16]}.lock", {}, "map")


def test_a_map_that_serves_is_not_built_again():
    tables, said = Tables(), []
    for _ in range(2):
        ensure(tables, PARAMS, BOX, 0.01, None, begin=lambda: said.append("begins"))
    assert tables.built == 1 and said == ["begins"]


def test_one_that_another_run_built_meanwhile_is_taken():
    tables, said, held = Tables(), [], lock()

    def other_ends(text):
        said.append(text)
        tables.metadata = {"tolerance": 0.01}
        held.close()

    ensure(tables, PARAMS, BOX, 0.01, None, begin=lambda: said.append("begins"), say=other_ends)
    assert tables.built == 0 and len(said) == 1 and said[0].startswith("waits for another run: ")


def test_a_run_whose_forerunner_failed_builds():
    tables, said, held = Tables(), [], lock()
    ensure(
        tables, PARAMS, BOX, 0.01, None,
        begin=lambda: said.append("begins"), say=lambda _: held.close(),
    )  # fmt: skip
    assert tables.built == 1 and said == ["begins"]


@pytest.mark.parametrize(("held_out", "does"), [(0.009, True), (0.011, False)])
def test_a_map_that_misses_its_tolerance_does_not_serve(held_out, does):
    tables = Tables(tolerance=0.01, held_out={"torque": held_out})
    assert serves(tables, PARAMS, BOX, 0.01) == does
