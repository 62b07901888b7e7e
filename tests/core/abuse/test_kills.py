"""Killed at any instant (kill -9): nothing half written, and the next run takes the rest away."""

import os
import random
import signal
import sys
import time

import pytest
from children import ROOT, child, started
from disk import full_disk

from thrustwasher.storage.whole_files import whole_file, whole_folder

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs signals of POSIX")
DIE_WRITING = """
import os, signal, sys
from pathlib import Path
from thrustwasher.storage import whole_files
with getattr(whole_files, sys.argv[1])(Path(sys.argv[2])) as draft:
    (draft / "a" if draft.is_dir() else draft).write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
"""
POINTS = "speed,load,friction\n" + "".join(f"{v},1000,{0.1 + 1e-4 * v}\n" for v in range(2, 32))
COMMANDS = {
    "calibrate": ("calibrate clutch rig.csv --out mine.toml", {"rig.csv": POINTS}),
    "efficiency": (
        "efficiency mine.toml --over torque=50:150:50 --over speed=1000rpm:2000rpm:n2 "
        "--out map.csv --plot map.png",
        {"mine.toml": 'base = "planetary"\n[transmission]\nwashers = 0\n'},
    ),
    "compare": (f"compare {ROOT / 'examples/measured/gearpie-c14'} --draws 2 --out there", {}),
}


def names(folder):
    return sorted(p.relative_to(folder).as_posix() for p in folder.rglob("*"))


def contents(folder):
    return {p.name: p.read_bytes() for p in folder.rglob("*") if p.is_file()}


@pytest.mark.parametrize(
    ("way", "name", "left"), [("whole_file", "map.twm", ["map.twm"]), ("whole_folder", ".", ["b"])]
)
def test_a_dead_draft_goes_when_the_next_one_is_made_and_a_living_one_stays(
    tmp_path, way, name, left
):
    write = {"whole_file": whole_file, "whole_folder": whole_folder}[way]
    for _ in range(2):
        assert child(DIE_WRITING, way, tmp_path / name).returncode == -signal.SIGKILL
    dead = names(tmp_path)
    assert dead and all(n.startswith(".draft-") for n in dead)
    with write(tmp_path / name) as draft:
        first = {n.split("/")[0] for n in names(tmp_path)}
        assert first == {draft.name}
        with write(tmp_path / name) as other:  # of another run at the same time
            assert draft.exists() and draft != other
        (draft / "b" if draft.is_dir() else draft).write_text("whole")
    assert names(tmp_path) == left


def test_a_draft_that_does_not_fit_on_the_disk_is_removed(tmp_path):
    with full_disk(10), pytest.raises(OSError, match="too large"), whole_file(tmp_path / "a"):
        (next(tmp_path.glob(".draft-*"))).write_bytes(b"x" * 100)
    assert names(tmp_path) == []


def prepared(folder, files):
    folder.mkdir()
    for name, text in files.items():
        (folder / name).write_text(text, "utf-8")
    return names(folder)


@pytest.mark.abuse
@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_that_is_killed_at_random_instants_ends_as_if_it_never_was(tmp_path, command):
    words, files = COMMANDS[command]
    rng = random.Random(command)
    prepared(tmp_path / "whole", files)
    began = time.monotonic()
    whole = started(words.split(), tmp_path / "whole")
    said = whole.communicate(timeout=300)
    assert whole.returncode == 0, said
    lasts = time.monotonic() - began
    prepared(tmp_path / "x", files)
    for _ in range(12):
        running = started(words.split(), tmp_path / "x")
        time.sleep(rng.uniform(0.0, 1.1) * lasts)
        os.killpg(running.pid, signal.SIGKILL)
        running.communicate(timeout=60)
        seen = {n for n in names(tmp_path / "x") if not n.startswith((".draft-", "there/.draft-"))}
        assert seen <= {*names(tmp_path / "whole")}
        for name in seen:
            made, file = tmp_path / "x" / name, tmp_path / "whole" / name
            assert made.is_dir() or made.read_bytes() == file.read_bytes(), f"{name} is half"
    again = started(words.split(), tmp_path / "x")
    again.communicate(timeout=300)
    assert names(tmp_path / "x") == names(tmp_path / "whole")
    assert contents(tmp_path / "x") == contents(tmp_path / "whole")
