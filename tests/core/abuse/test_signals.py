"""Ctrl-C and SIGTERM in the middle: one line, the status shells know, nothing lost or half."""

import re
import signal
import sys
import time

import pytest
from children import started, stopped

from thrustwasher.cli import SIGNALS, Stopped, Watch, main

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs signals of POSIX")
SWEEP = ["sweep", "gearmesh", "--over", "load=10:1000:x300", "--over", "speed=50:500:x150"]
MAP = "map build --load 20:1800 --speed 50:1400 --tilt 0.001:0.003 --workers 2".split()
MAP += ["--oil-temperature", "290:400"]
KEPT = "thrustwasher.storage.journal.Journal.put"  # some rows are done


@pytest.mark.parametrize(
    ("number", "status", "word"),
    [
        (signal.SIGINT, 130, "stopped"),
        pytest.param(signal.SIGTERM, 143, "terminated", marks=pytest.mark.abuse),
    ],
)
@pytest.mark.slow
def test_a_sweep_that_is_stopped_says_how_to_go_on_and_does(tmp_path, number, status, word):
    words = [*SWEEP, "--workers", "2", "--out", "t.csv"]
    code, lines = stopped(words, tmp_path, KEPT, "len(calls) == 3", number)
    kept, ended = lines
    assert (code, ended) == (status, f"thrustwasher sweep: {word}")
    assert re.fullmatch(r"t\.csv\.journal keeps \d+ of \d+ points; to go on: (.*)", kept)
    assert [p.name for p in tmp_path.iterdir()] == ["t.csv.journal"]
    again = started(words, tmp_path)
    again.communicate(timeout=60)
    assert again.returncode == 0
    assert [p.name for p in tmp_path.iterdir()] == ["t.csv"]


@pytest.mark.abuse
def test_a_map_build_that_is_stopped_twice_says_so_and_keeps_its_lines(tmp_path):
    words, twice = [*MAP, "--out", "m.twm"], [signal.SIGINT, signal.SIGINT]
    code, lines = stopped(words, tmp_path, KEPT, "len(calls) == 3", *twice)
    assert code == 130 and lines[-1] == "thrustwasher map: stopped"
    assert [line.startswith("m.twm.journal keeps ") for line in lines[:-1]] == [True]
    assert [p.name for p in tmp_path.iterdir()] == ["m.twm.journal"]


@pytest.mark.parametrize(
    ("number", "status"),
    [pytest.param(signal.SIGINT, 130, marks=pytest.mark.abuse), (signal.SIGTERM, 143)],
)
@pytest.mark.slow
def test_a_shift_that_is_stopped_leaves_the_folder_as_it_was(tmp_path, number, status, fmu_of):
    for model in ("clutch", "transmission"):
        fmu_of(model, "native-fmi2")
    (tmp_path / "r").mkdir()
    (tmp_path / "r" / "shift.csv").write_text("of an earlier run")
    words = ["shift", "--scene", "msl", "--step", "5 ms", "--out", "r"]
    written = "str(given[1]).startswith('r/')"  # the first file takes its place
    code, lines = stopped(words, tmp_path, "os.replace", written, number)
    assert code == status and len(lines) == 1
    assert [p.name for p in (tmp_path / "r").iterdir()] == ["shift.csv"]
    assert (tmp_path / "r" / "shift.csv").read_text() == "of an earlier run"


@pytest.fixture
def watch():
    before = {n: signal.getsignal(n) for n in SIGNALS}
    for number in before:
        signal.signal(number, signal.SIG_DFL)
    made = Watch()
    made.begin()
    yield made
    for number, handler in before.items():
        signal.signal(number, handler)


def test_only_the_first_signal_disturbs_what_is_tidied_up(watch):
    with pytest.raises(Stopped):
        signal.raise_signal(signal.SIGTERM)
    signal.raise_signal(signal.SIGINT)
    assert (watch.status, watch.word) == (143, "terminated")


def test_a_terminal_that_closes_stops_a_command_as_ctrl_c_does(watch):
    with pytest.raises(Stopped):
        signal.raise_signal(signal.SIGHUP)
    assert (watch.status, watch.word) == (129, "the terminal has closed")


def test_a_signal_a_second_later_stops_what_hangs(watch, monkeypatch):
    with pytest.raises(Stopped):
        signal.raise_signal(signal.SIGINT)
    now = time.monotonic()
    monkeypatch.setattr(time, "monotonic", lambda: now + 2.0)
    with pytest.raises(Stopped):
        signal.raise_signal(signal.SIGINT)


def test_the_last_line_is_said_in_peace(watch):
    watch.close()
    signal.raise_signal(signal.SIGINT)
    signal.raise_signal(signal.SIGTERM)
    assert watch.number == 0


def test_what_a_parent_has_switched_off_stays_off():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        watch = Watch()
        watch.begin()
        signal.raise_signal(signal.SIGINT)
        assert watch.number == 0
    finally:
        watch.close()
        for number in SIGNALS:
            signal.signal(number, signal.SIG_DFL)
        signal.signal(signal.SIGINT, before)


def test_a_stop_that_a_library_takes_for_a_failure_is_a_stop(monkeypatch, capsys):
    """As where Ctrl-C meets a Python FMU, which answers every exception with an error."""
    from thrustwasher import cli

    def fail(words):
        try:
            signal.raise_signal(signal.SIGTERM)
        except Stopped:
            raise RuntimeError("step failed") from None

    monkeypatch.setattr(cli, "_dispatch", fail)
    monkeypatch.setattr(sys, "argv", ["thrustwasher", "shift"])
    before = {n: signal.getsignal(n) for n in SIGNALS}
    try:
        assert main() == 143
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    assert capsys.readouterr().err == "thrustwasher shift: terminated\n"
