"""``progress`` of fits: runs done, without a total that nobody knows."""

import io
import sys

import numpy as np
import pytest
from rigs import PACK, history, recorded

from thrustwasher import ParameterError, SolveError, calibrate, calibrate_traces
from thrustwasher.cli import main
from thrustwasher.studio.jobs.progress import counted_runs

SLIP = np.geomspace(0.3, 20.0, 8)
LAW = {"speed": SLIP, "load": 6e3, "friction": 0.1 + 0.02 * np.exp(-SLIP)}
EVERY = "thrustwasher.cli.common._progress.EVERY"


class Terminal(io.StringIO):
    """A terminal that keeps what is written to it."""

    def isatty(self):
        """Tell that it is one."""
        return True


def fit_law(progress):
    return calibrate(PACK, LAW, progress=progress)


def fit_traces(progress):
    data = [recorded(seed=seed, way=history(61)) for seed in (1, 2)]
    return calibrate_traces(PACK, data, fit=["friction_scale"], progress=progress)


@pytest.mark.parametrize("fit", [fit_law, fit_traces])
def test_a_function_gets_growing_numbers_and_their_last_one_as_the_total(fit):
    seen = []
    fit(lambda *now: seen.append(now))
    last = len(seen) - 1
    assert seen == [*((k, None) for k in range(1, last + 1)), (last, last)] and last > 2


def test_recordings_count_once_for_each_iteration_of_the_fit():
    seen = []
    found = fit_traces(lambda *now: seen.append(now))
    done = seen[-1][0]
    assert len(found.points.runs) == 2 and done % 2 == 0
    found.histories()  # which steps along them again
    assert seen[-1][0] == done


@pytest.mark.parametrize("has_tqdm", [True, False])
@pytest.mark.parametrize("fit", [fit_law, fit_traces])
def test_nothing_is_written_where_there_is_no_terminal(fit, has_tqdm, capsys, monkeypatch):
    if not has_tqdm:
        monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    fit(True)
    assert capsys.readouterr() == ("", "")


def test_on_a_terminal_the_command_shows_evaluations_and_takes_the_line_away(monkeypatch, tmp_path):
    file = tmp_path / "law.csv"
    rows = [f"{w},6e3,{f}" for w, f in zip(SLIP, LAW["friction"], strict=True)]
    file.write_text("\n".join(["speed,load,friction", *rows]))
    monkeypatch.setattr(EVERY, -1.0)
    monkeypatch.setattr(sys, "stderr", Terminal())
    main(["calibrate", str(file)])
    shown = sys.stderr.getvalue().split("\r\033[K")
    assert shown[1:4] == ["fit, evaluations: 1", "fit, evaluations: 2", "fit, evaluations: 3"]
    assert not any(text.startswith("fit,") for text in shown[-1:])


@pytest.mark.parametrize("has_tqdm", [True, False])
def test_a_fit_that_fails_leaves_no_open_line(has_tqdm, monkeypatch):
    if not has_tqdm:
        monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    else:
        pytest.importorskip("tqdm")
    monkeypatch.setattr(EVERY, -1.0)
    monkeypatch.setattr(sys, "stderr", Terminal())
    with pytest.raises(SolveError), counted_runs(True, "fit") as ran:
        ran()
        raise SolveError("no start converged")
    assert sys.stderr.getvalue().endswith(("\r\033[K", "\n"))


def test_a_function_may_stop_the_fit():
    def stop(done, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fit_law(stop)


@pytest.mark.parametrize("fit", [fit_law, fit_traces])
def test_what_is_no_progress_is_named(fit):
    with pytest.raises(ParameterError, match="progress = 3, allowed: True, False, or a function"):
        fit(3)
