"""A run waits for another one that has its journal, and takes what that one leaves."""

import pytest

from thrustwasher.storage import journal
from thrustwasher.storage.journal import InUseError, Journal, when_free


@pytest.fixture(autouse=True)
def impatient(monkeypatch):
    monkeypatch.setattr(journal, "LOOK", 0.01)
    monkeypatch.setattr(journal, "PATIENCE", 1.0)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "lines"


def begin(path):
    return Journal(path, {"source": "one"}, "map")


@pytest.mark.parametrize(("finished", "left"), [(False, [(3, b"done")]), (True, [])])
def test_a_second_run_waits_and_has_what_the_first_one_left(path, finished, left):
    first, said = begin(path), []
    first.put(3, b"done")

    def end(text):
        said.append(text)
        first.close(finished=finished)

    second = when_free(lambda: begin(path), end)
    assert list(second.entries()) == left and path.exists()
    assert said == [f"waits for another run: {path}"]
    second.close()


@pytest.mark.slow
def test_the_wait_has_an_end(path):
    first, said = begin(path), []
    with pytest.raises(InUseError, match="another run is writing this map"):
        when_free(lambda: begin(path), said.append)
    assert len(said) == 1
    first.close()


def test_much_is_written_before_the_second_is_over(path, monkeypatch):
    monkeypatch.setattr(journal, "MUCH", 10)
    monkeypatch.setattr(journal, "INTERVAL", 1e9)
    one = begin(path)
    one.put(1, b"first")
    one.put(2, b"few")
    assert len(one._waiting) == 1
    one.put(3, b"many of them")
    assert not one._waiting and [entry for entry, _ in one.entries()] == [1, 2, 3]
    one.close()
