"""Compiled code is kept where only its user can write, and is checked before it is loaded."""

import errno
import os
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from thrustwasher.native import files
from thrustwasher.native.ownership import doubt_of
from thrustwasher.numerics import jit

posix = pytest.mark.skipif(sys.platform == "win32", reason="modes of folders are POSIX")


@pytest.fixture
def fresh(monkeypatch, tmp_path):
    """A cache of its own, nothing remembered."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(files, "_said", [])
    return tmp_path / "cache" / "thrustwasher" / "native"


@posix
def test_the_folder_is_made_for_the_user_alone(fresh):
    assert files.code_folder() == fresh
    assert fresh.stat().st_mode & 0o777 == 0o700


@posix
def test_a_folder_others_can_enter_is_closed_first(fresh):
    fresh.mkdir(parents=True)
    fresh.chmod(0o755)
    assert files.code_folder() == fresh and files.not_private(fresh) == ""


@posix
def test_a_folder_of_somebody_else_is_not_used_and_it_is_said(fresh, monkeypatch, capsys):
    fresh.mkdir(parents=True, mode=0o700)
    monkeypatch.setattr(files.os, "getuid", lambda: 54321)
    folder = files.code_folder()
    assert folder != fresh and folder.is_dir()
    said = capsys.readouterr().err
    assert "belongs to another user" in said and str(folder.parent) in said
    assert said.count("\n") == 1


def test_where_nothing_can_be_written_a_temporary_folder_serves(fresh, capsys):
    fresh.parent.parent.mkdir()
    fresh.parent.write_text("a file where the folder should be")
    assert files.not_private(files.code_folder()) == ""
    files.code_folder("built")
    said = capsys.readouterr().err
    assert "cannot be written" in said and said.count("\n") == 1


@pytest.mark.parametrize("spoil", ["flip", "cut", "no sum"])
def test_a_file_that_is_not_as_it_was_written_is_not_there(tmp_path, spoil):
    path = tmp_path / "code.o"
    files.keep(path, b"machine code")
    assert files.kept(path) == b"machine code"
    if spoil == "flip":
        path.write_bytes(b"machine c0de")
    elif spoil == "cut":
        path.write_bytes(b"machine")
    else:
        path.with_name("code.o.sha256").unlink()
    assert files.kept(path) is None


def test_a_failed_write_leaves_no_part_behind(tmp_path, monkeypatch):
    full = OSError(errno.ENOSPC, "full")
    monkeypatch.setattr(files.os, "replace", lambda *_: (_ for _ in ()).throw(full))
    with pytest.raises(OSError, match="full"):
        files.write(tmp_path / "a", b"x")
    assert list(tmp_path.iterdir()) == []


def test_two_holders_of_a_lock_take_turns(tmp_path):
    order, waited = [], threading.Event()

    def second():
        with files.locked(tmp_path / "lock", waited.set):
            order.append("second")

    with files.locked(tmp_path / "lock", lambda: order.append("waiting")):
        thread = threading.Thread(target=second)
        thread.start()
        assert waited.wait(30)
        order.append("first")
    thread.join(30)
    assert order == ["first", "second"]


def test_a_lock_ends_with_its_process(tmp_path):
    code = (
        "import time; from pathlib import Path; from thrustwasher.native import files\n"
        f"held = files.locked(Path({str(tmp_path / 'lock')!r}), print)\n"
        "held.__enter__()\nprint('held', flush=True)\ntime.sleep(600)"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[3])},
    )
    assert process.stdout.readline() == "held\n"
    waited = []

    def end():
        waited.append(True)
        process.kill()

    with files.locked(tmp_path / "lock", end):
        assert waited == [True]
    process.communicate(timeout=30)


@posix
def test_a_folder_others_could_write_to_and_a_link_are_not_used(fresh, tmp_path, capsys):
    fresh.mkdir(parents=True)
    fresh.chmod(0o777)
    assert files.code_folder() != fresh
    assert "could be written by others" in capsys.readouterr().err
    (tmp_path / "link").symlink_to(tmp_path)
    assert files.not_private(tmp_path / "link").endswith("is no folder")


@pytest.fixture
def owned_by(monkeypatch):
    """Let a folder belong to another user, as far as this process can see."""
    whose, lstat = {}, Path.lstat

    def about(path):
        found = list(lstat(path))
        found[stat.ST_UID] = whose.get(path, found[stat.ST_UID])
        return os.stat_result(found)

    monkeypatch.setattr(Path, "lstat", about)
    return whose


@posix
def test_a_folder_above_that_belongs_to_somebody_else_is_not_trusted(fresh, owned_by, capsys):
    """Who owns it can put a folder of his own in the place of the user's, while a program runs."""
    assert files.code_folder() == fresh
    owned_by[fresh.parent] = 54321
    folder = files.code_folder()
    assert folder != fresh and files.not_private(folder) == ""
    said = capsys.readouterr().err
    assert f"{fresh.parent} belongs to another user" in said and said.count("\n") == 1
    files.keep(fresh / "a.o", b"code")
    assert files.kept(fresh / "a.o") is None, "it is looked at anew before each load"


@posix
@pytest.mark.parametrize(("mode", "is_trusted"), [(0o755, True), (0o777, False), (0o1777, True)])
def test_a_folder_above_that_others_can_write_has_to_be_sticky(fresh, mode, is_trusted, capsys):
    above = fresh.parent.parent
    above.mkdir()
    above.chmod(mode)
    assert (files.code_folder() == fresh) == is_trusted
    assert (f"{above} could be written by others" in capsys.readouterr().err) != is_trusted
    assert is_trusted or not files.user_cache().is_relative_to(above), "nor are maps from there"


@posix
def test_both_ends_of_a_link_are_looked_at(tmp_path):
    (tmp_path / "open").mkdir()
    (tmp_path / "open").chmod(0o777)
    (tmp_path / "open" / "mine").mkdir()
    (tmp_path / "here").symlink_to("open/../open/mine")
    assert doubt_of(tmp_path / "here") == f"{tmp_path / 'open'} could be written by others"
    (tmp_path / "round").symlink_to("round")
    with pytest.raises(OSError, match="symbolic links"):
        doubt_of(tmp_path / "round")


@posix
@pytest.mark.parametrize("what", ["", "kernels-0"])
def test_compiled_code_of_numba_is_not_taken_where_others_write(tmp_path, what, fresh, monkeypatch):
    monkeypatch.setattr(jit, "kernel_digest", lambda: "0")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "numba"))
    assert jit.cache_folder() == str(tmp_path / "numba" / "kernels-0")
    (tmp_path / "numba" / what).chmod(0o777)
    assert not jit.cache_folder().startswith(str(tmp_path / "numba"))


@posix
def test_a_file_others_could_write_is_not_there(tmp_path):
    files.keep(tmp_path / "a.o", b"code")
    (tmp_path / "a.o").chmod(0o666)
    assert files.kept(tmp_path / "a.o") is None


def test_without_a_home_code_lies_in_no_folder_of_that_name(monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", "somewhere/relative")
    assert files.user_cache().is_absolute()
