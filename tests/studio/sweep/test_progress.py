"""``progress`` of sweeps, studies and searches: True, or a function."""

import io
import sys

import pytest

from thrustwasher import (
    ParameterError,
    WasherParams,
    follow_washer,
    load_scene,
    run_sweep,
)
from thrustwasher.shift.steady_points import efficiency_map
from thrustwasher.studio.jobs.progress import shown

OVER = {"load": (1e3, 2e3, 3e3)}


class Terminal(io.StringIO):
    """A terminal that keeps what is written to it."""

    def isatty(self):
        """Tell that it is one."""
        return True


def sweep(progress):
    return run_sweep("clutch", OVER, at={"speed": 2.0}, workers=1, progress=progress)


def test_a_function_is_called_with_points_done_and_all():
    seen = []
    sweep(lambda done, total: seen.append((done, total)))
    assert seen[-1] == (3, 3)


@pytest.mark.parametrize("has_tqdm", [True, False])
def test_nothing_is_written_where_there_is_no_terminal(has_tqdm, capsys, monkeypatch):
    if not has_tqdm:
        monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    sweep(True)
    assert capsys.readouterr() == ("", "")


def test_without_tqdm_it_is_the_line_of_the_commands(monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    monkeypatch.setattr(sys, "stderr", Terminal())
    monkeypatch.setattr("thrustwasher.cli.common._progress.EVERY", -1.0)
    shown(True, "sweep")(2, 4)
    assert "sweep: 2 of 4 (50%)" in sys.stderr.getvalue()


def test_with_tqdm_it_is_its_bar(monkeypatch):
    pytest.importorskip("tqdm")
    monkeypatch.setattr(sys, "stderr", Terminal())
    show = shown(True, "sweep")
    show(1, 4)
    show(4, 4)
    assert "4/4" in sys.stderr.getvalue()
    assert sys.stderr.getvalue().endswith("\n")


@pytest.mark.parametrize("off", [None, False])
def test_nothing_is_shown_unless_asked(off):
    assert shown(off, "sweep") is None


def test_what_is_no_progress_is_named():
    with pytest.raises(ParameterError, match="progress = 3, allowed: True, False, or a function"):
        sweep(3)


def test_a_map_of_efficiency_shows_its_points():
    seen = []
    for progress in (True, lambda *now: seen.append(now)):
        efficiency_map(load_scene("msl"), [50.0, 100.0], [100.0], progress=progress)
    assert seen == [(1, 2), (2, 2)]


def test_a_washer_over_time_shows_its_points():
    seen = []
    way = {"time": [0.0, 0.1, 0.2], "load": 200.0, "speed": 100.0}
    for progress in (True, lambda *now: seen.append(now)):
        follow_washer(WasherParams(), **way, progress=progress)
    assert seen == [(1, 3), (2, 3), (3, 3)]
