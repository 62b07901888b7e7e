"""The time left changes smoothly; a command that was stopped says how it goes on."""

import math
from types import SimpleNamespace

import pytest

from thrustwasher.cli.common._output import duration, going_on
from thrustwasher.cli.common._progress import TimeLeft


def test_the_time_left_forgets_a_slow_start_and_does_not_jump():
    left, shown = TimeLeft(), []
    done, now = 0.0, 0.0
    while done < 1000.0:  # 20 s for the first five, then two each second
        shown.append((now, left.after(now, int(done), 1000)))
        now += 0.5
        done += 0.125 if done < 5.0 else 1.0
    end = now
    known = [(t, x) for t, x in shown if math.isfinite(x)]
    for (t, x), (then, y) in zip(known[1:], known, strict=False):
        assert abs(x - (y - (t - then))) <= 0.06 * max(x, y)  # 6 % in half a second
    for t, x in known:
        if t > 120.0:
            assert x == pytest.approx(end - t, rel=0.15, abs=2.0)


def test_nothing_is_named_before_it_is_known():
    left = TimeLeft()
    assert [math.isnan(left.after(t, n, 100)) for t, n in [(0, 40), (1, 50), (4, 60)]] == [
        True,
        True,
        False,
    ]


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.31, "0.3 s"), (40.0, "40 s"), (310.0, "5 min"), (7800.0, "2 h 10 min")],
)
def test_durations_are_read_at_a_glance(seconds, words):
    assert duration(seconds) == words


@pytest.mark.parametrize(("done", "there"), [(3, True), (0, True), (3, False)])
def test_a_stopped_command_names_its_journal_and_the_command_that_goes_on(
    done, there, tmp_path, capsys
):
    journal = tmp_path / "a.csv.journal"
    if there:
        journal.write_text("")
    given = SimpleNamespace(command_line="thrustwasher sweep clutch --out a.csv")
    with (
        pytest.raises(KeyboardInterrupt),
        going_on(given, journal, lambda *_: None) as progress,
    ):
        progress(done, 10)
        raise KeyboardInterrupt
    told = capsys.readouterr().err
    if done and there:
        line = f"{journal} keeps 3 of 10 points; to go on: {given.command_line}\n"
        assert told == line
    else:
        assert told == ""
