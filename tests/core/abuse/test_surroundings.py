"""Streams that are full or closed, a folder that has gone, pipes: one line and the right status."""

import os
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path

import pytest
from children import ROOT

from thrustwasher.cli import main
from thrustwasher.native.ownership import doubt_of

FULL = Path("/dev/full")
needs_full = pytest.mark.skipif(not FULL.exists(), reason="needs /dev/full")
needs_pipes = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")


def test_closed_standard_output_is_said(monkeypatch, capsys):
    monkeypatch.setattr(sys, "stdout", None)
    assert main(["clutch", "--json"]) == 2
    assert sys.stdout is None
    assert capsys.readouterr().err == "thrustwasher clutch: standard output: is closed\n"


@pytest.mark.parametrize(("words", "status"), [("--nonsense", 2), ("--json", 0)])
@pytest.mark.parametrize("stream", [None, pytest.param(FULL, marks=needs_full)])
def test_what_nobody_can_read_changes_no_status(words, status, stream, monkeypatch):
    lost = stream and stream.open("w", buffering=1)
    monkeypatch.setattr(sys, "stderr", lost)
    assert main(["clutch", words]) == status
    monkeypatch.undo()
    with suppress(OSError):
        lost and lost.close()


@needs_full
def test_a_program_whose_output_does_not_fit_ends_with_its_line_alone(tmp_path):
    """Before, the interpreter ended it with 120 and 'Exception ignored'; a closed output too."""
    for end in ("> /dev/full", ">&-"):
        done = subprocess.run(
            f"{sys.executable} -m thrustwasher --version {end}",
            shell=True,
            stderr=subprocess.PIPE,
            text=True,
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
        )
        assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
        assert done.stderr.startswith("thrustwasher: standard output: ")


def test_a_working_directory_that_has_gone_is_named(tmp_path, monkeypatch, capsys):
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    try:
        (tmp_path / "here").rmdir()
    except OSError:  # Windows
        pytest.skip("a folder in use stays")
    assert doubt_of(tmp_path) == ""  # what has a whole path is there
    assert main(["shift", "--scene", "msl", "--out", "r"]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "the working directory is gone" in said


def test_a_circle_of_bases_is_found_whatever_way_it_goes(tmp_path, capsys):
    (tmp_path / "sub").mkdir()
    (tmp_path / "a.toml").write_text('base = "sub/../a.toml"')
    assert main(["shift", "--scene", str(tmp_path / "a.toml")]) == 2
    said = capsys.readouterr().err
    assert said.endswith(f"scene '{tmp_path}/sub/../a.toml': its bases go round in a circle\n")


@needs_pipes
@pytest.mark.parametrize(
    "words", ["shift --scene x.toml", "clutch --part x.toml", "calibrate x.csv"]
)
def test_a_pipe_nobody_writes_to_is_refused(words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    name = words.split()[-1]
    os.mkfifo(name)
    writer = threading.Timer(20.0, lambda: Path(name).open("w").close())  # it would wait for ever
    writer.start()
    assert main(words.split()) == 2
    is_refused = writer.is_alive()
    writer.cancel()
    said = capsys.readouterr().err
    assert is_refused and said.count("\n") == 1 and "is a pipe, a file is required" in said
