"""FMUs are unpacked once per content into a cache that is kept small."""

import os
import shutil
import sys
import tempfile
import time
import zipfile
from pathlib import Path

import pytest

from thrustwasher.errors import EnvironmentProblem, ParameterError
from thrustwasher.fmu import diagnosis
from thrustwasher.fmu.running import loading
from thrustwasher.fmu.running.loading import IN_USE, KEPT, prune
from thrustwasher.fmu.stepper import unpack
from thrustwasher.native import files
from thrustwasher.storage.whole_files import whole_file, whole_folder


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


@pytest.fixture
def copy(python_toy, tmp_path, monkeypatch):
    """An FMU, and an empty cache for what is unpacked."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(files, "_said", [])
    path = tmp_path / "ToyClutch.fmu"
    path.write_bytes(python_toy.read_bytes())
    return path


def test_an_emptied_cache_is_filled_again(copy, tmp_path):
    folder = unpack(copy)
    assert folder.is_relative_to(tmp_path)
    shutil.rmtree(folder)
    assert unpack(copy) == folder and (folder / "modelDescription.xml").is_file()
    assert [p.name for p in folder.parent.iterdir()] == [folder.name]  # nothing half unpacked


def as_unpacked(folder, fmu):
    with zipfile.ZipFile(fmu) as archive:
        return all((folder / n).read_bytes() == archive.read(n) for n in archive.namelist())


@pytest.mark.parametrize("is_new", [False, True], ids=["same process", "new process"])
@pytest.mark.parametrize("harm", ["empty", "cut", "flipped", "all files gone", "one file gone"])
def test_what_was_unpacked_and_is_not_as_it_was_is_unpacked_again(copy, harm, is_new, capsys):
    """Before, a cut library ended the program silently, an empty description as a defect."""
    folder = unpack(copy)
    (library,) = folder.glob("binaries/linux64/*")
    data = bytearray(library.read_bytes())
    about = library.stat()
    if harm == "empty":
        (folder / "modelDescription.xml").write_bytes(b"")
    elif harm == "cut":
        library.write_bytes(data[:5000])
    elif harm == "flipped":  # nothing else shows it
        data[len(data) // 2] ^= 4
        library.write_bytes(data)
        os.utime(library, ns=(about.st_atime_ns, about.st_mtime_ns))
    else:  # as a cleaner does that takes old files and no folders
        for file in folder.rglob("*") if harm == "all files gone" else [library]:
            file.is_file() and file.unlink()
    if is_new:
        loading._unpacked.clear()
    assert unpack(copy) == folder and as_unpacked(folder, copy)
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "is unpacked again" in said
    assert unpack(copy) == folder and capsys.readouterr().err == ""


def test_what_an_fmu_wrote_beside_its_files_is_its_own(copy, capsys):
    folder = unpack(copy)
    (folder / "resources" / "__pycache__").mkdir(exist_ok=True)
    loading._unpacked.clear()
    assert unpack(copy) == folder and capsys.readouterr().err == ""


SHM = Path("/dev/shm")
NOEXEC = getattr(os, "ST_NOEXEC", 0)


@pytest.fixture
def noexec(tmp_path, monkeypatch):
    """A cache on a file system that runs no code: a real one, or as the system would answer."""
    is_real = SHM.is_dir() and os.access(SHM, os.W_OK) and os.statvfs(SHM).f_flag & NOEXEC
    home = Path(tempfile.mkdtemp(dir=SHM if is_real else tmp_path))
    if not is_real:
        runs = files.lets_run
        monkeypatch.setattr(files, "lets_run", lambda f: not f.is_relative_to(home) and runs(f))
    yield home
    shutil.rmtree(home)


@pytest.mark.skipif(sys.platform != "linux", reason="noexec is of Linux")
def test_where_no_code_may_run_fmus_are_unpacked_elsewhere(copy, noexec, monkeypatch, capsys):
    monkeypatch.setenv("XDG_CACHE_HOME", str(noexec))
    folder = unpack(copy)
    assert not folder.is_relative_to(noexec) and as_unpacked(folder, copy)
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "noexec" in said and "let XDG_CACHE_HOME name" in said
    found = diagnosis._look("x", diagnosis._running)
    assert not found.ok and str(noexec) in found.text and "XDG_CACHE_HOME" in found.text
    monkeypatch.setattr(files, "lets_run", lambda folder: False)  # nor in the temporary folder
    files._fit.clear()
    with pytest.raises(EnvironmentProblem, match="let XDG_CACHE_HOME name a folder that does"):
        unpack(copy)


def test_bytes_are_on_the_disk_before_their_name_is(copy, tmp_path, monkeypatch):
    """A power failure after the rename would leave a name with nothing behind it."""
    on_disk, fsync, rename, replace = set(), os.fsync, Path.rename, os.replace

    def sync(handle):
        on_disk.add(os.fstat(handle).st_ino)
        fsync(handle)

    def moved(do, source, target):
        found = [source, *Path(source).rglob("*")]
        names = [p for p in found if Path(p).is_file()]
        assert names and all(Path(p).stat().st_ino in on_disk for p in names), source
        do(source, target)

    monkeypatch.setattr(os, "fsync", sync)
    monkeypatch.setattr(Path, "rename", lambda s, t: moved(rename, s, t))
    monkeypatch.setattr(os, "replace", lambda s, t: moved(replace, s, t))
    unpack(copy)
    files.write(tmp_path / "a", b"x")
    with whole_file(tmp_path / "b") as draft:
        draft.write_text("x")
    with whole_folder(tmp_path / "c") as draft:
        (draft / "d").write_text("x")
