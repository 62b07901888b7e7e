"""A washer followed over time: through the fold, back again, and what is refused."""

import numpy as np
import pytest
from curves import traced

from thrustwasher import ParameterError, WasherParams, follow_washer, solve_washer
from thrustwasher.washer import follow
from thrustwasher.washer.follow import HistoryError

GRID = (5, 12)
STEADY, IN_TIME = WasherParams(), WasherParams(thermal_mode="transient")
AT = {"speed": 545.0, "tilt": 2e-3, "grid": GRID}


def lost_load(rate, params=IN_TIME):
    """Return the load at which a load that rises by ``rate`` [N/s] loses the film."""
    fold = traced(**AT).folds[0].load
    load = np.arange(0.97 * fold, 1.5 * fold, 0.002 * fold)
    c = follow_washer(params, time=(load - load[0]) / rate, load=load, **AT)
    return c.load[np.argmax(c.distress)] / fold - 1.0


@pytest.mark.slow
def test_slow_loads_lose_the_film_at_the_fold_and_quick_ones_later():
    """Passing a fold takes longer the quicker: the excess grows as the rate to the power 2/3."""
    slow, quick = lost_load(0.5), lost_load(4.0)
    assert 0.0 < slow < quick
    assert 2.5 < quick / slow < 6.0  # 8^(2/3) = 4
    assert lost_load(0.01) < 0.02
    assert lost_load(4.0, STEADY) <= 0.004  # steady states lose it there at any rate


@pytest.mark.slow
def test_a_slow_loop_of_load_has_the_hysteresis_of_steady_states():
    low, high = (f.load for f in reversed(traced(**AT).folds))
    there = np.linspace(0.9 * low, 1.1 * high, 60)
    load = np.concatenate((there, there[::-1]))
    time = np.arange(len(load)) * 200.0
    steady, slow = (follow_washer(p, time=time, load=load, **AT) for p in (STEADY, IN_TIME))
    assert steady.distress.any() and not steady.distress[-1]
    assert np.count_nonzero(steady.distress != slow.distress) <= 4  # a point late at each fold
    same = steady.distress == slow.distress
    same &= np.roll(same, 1) & np.roll(same, -1)
    error = np.abs(slow.temperature - steady.temperature)[same]
    assert np.median(error) < 0.02 + 2e-3 * np.median(slow.temperature_max - 297.15)


def test_a_short_overload_is_survived_and_a_long_one_is_not():
    fold = traced(**AT).folds[0].load
    for duration, lost in ((0.05, False), (60.0, True)):
        time = np.array([0.0, 1e-3, 1e-3 + duration, 2e-3 + duration, 60.0 + duration])
        load = fold * np.array([0.8, 1.3, 1.3, 0.8, 0.8])
        c = follow_washer(IN_TIME, time=time, load=load, **AT)
        assert bool(c.distress[2]) == lost == bool(c.distress[-1])
        assert solve_washer(STEADY, load=1.3 * fold, **AT).distress


def test_a_time_history_can_be_written_as_json():
    c = follow_washer(IN_TIME, time=[0.0, 0.1], load=300.0, **AT)
    written = c.as_dict()
    assert written["status"] == ["OK", "OK"] and written["thermal_mode"] == "transient"
    assert written["distress"] == [False, False] and len(written["temperature"]) == 2


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"time": [0.0, 0.0]}, "rising points"),
        ({"load": [300.0]}, r"load: shape \(1,\)"),
        ({"load": [300.0, 0.0]}, r"load\[1\] = 0.0 N"),
        ({"tilt": float("nan")}, r"tilt\[0\] = nan rad"),
        ({"fidelity": "map"}, "allowed: 'field' or 'fine'"),
    ],
)
def test_what_cannot_be_followed_is_named(change, words):
    given = {"time": [0.0, 1.0], "load": 300.0, "speed": 545.0, "tilt": 2e-3} | change
    with pytest.raises(ParameterError, match=words):
        follow_washer(IN_TIME, **given)


def test_what_was_computed_before_a_failure_is_kept(monkeypatch):
    step = follow.kernel.step

    def fails(par, inp, *rest):
        return 10 if inp[0] == 500.0 else step(par, inp, *rest)

    monkeypatch.setattr(follow.kernel, "step", fails)
    with pytest.raises(HistoryError, match="load = 500 N") as problem:
        follow_washer(STEADY, time=[0.0, 1.0, 2.0], load=[300.0, 400.0, 500.0], **AT)
    assert problem.value.history.load.tolist() == [300.0, 400.0]
    assert (problem.value.history.temperature > 297.15).all()
