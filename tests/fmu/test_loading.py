"""FMUs are unpacked once per content into a cache that is kept small."""

import os
import shutil
import time

import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.fmu.running.loading import IN_USE, KEPT, prune
from thrustwasher.fmu.stepper import unpack


def test_an_fmu_is_unpacked_once_per_content(python_toy, tmp_path):
    copy = tmp_path / "ToyClutch.fmu"
    copy.write_bytes(python_toy.read_bytes())
    assert unpack(copy) == unpack(python_toy)
    with pytest.raises(ParameterError, match="build it first"):
        unpack(tmp_path / "none.fmu")


def test_the_cache_keeps_what_is_new_or_among_the_last_used(tmp_path):
    for i in range(KEPT + 5):
        folder = tmp_path / f"old-{i:02}"
        folder.mkdir()
        (folder / "modelDescription.xml").write_text("")
        age = (i + 1) * IN_USE if i else 0.0
        os.utime(folder, (time.time() - age - 60.0,) * 2)
    for i in range(5):
        (tmp_path / f"new-{i}").mkdir()
    prune(tmp_path)
    left = {p.name for p in tmp_path.iterdir()}
    assert left == {f"old-{i:02}" for i in range(KEPT - 5)} | {f"new-{i}" for i in range(5)}
    for folder in tmp_path.iterdir():  # used today: however many, none goes
        os.utime(folder)
    for i in range(KEPT):
        (tmp_path / f"more-{i}").mkdir()
    prune(tmp_path)
    assert len(list(tmp_path.iterdir())) == 2 * KEPT


def test_an_emptied_cache_is_filled_again(python_toy, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    copy = tmp_path / "ToyClutch.fmu"
    copy.write_bytes(python_toy.read_bytes())
    folder = unpack(copy)
    assert folder.is_relative_to(tmp_path)
    shutil.rmtree(folder)
    assert unpack(copy) == folder and (folder / "modelDescription.xml").is_file()
    assert [p.name for p in folder.parent.iterdir()] == [folder.name]  # nothing half unpacked
