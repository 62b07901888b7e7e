"""The whole curve: its branches, its folds, and what solving at one load says about the same."""

import itertools

import numpy as np
import pytest
from curves import traced

from thrustwasher import (
    ParameterError,
    Status,
    WasherParams,
    follow_washer,
    load_curve,
    solve_washer,
)
from thrustwasher.washer import follow
from thrustwasher.washer.follow import HistoryError


@pytest.fixture(scope="module")
def curve():
    return traced()


def test_points_go_from_thick_to_thin_over_the_whole_range(curve):
    ratios = [p.film_ratio for p in curve.points]
    assert all(b < a for a, b in itertools.pairwise(ratios))
    assert curve.points[0].load <= 20.0 * 1.001 and curve.points[-1].load >= 3000.0


def test_branches_follow_each_other_and_meet_at_the_folds(curve):
    names = [p.branch for p in curve.points]
    order = [n for i, n in enumerate(names) if i == 0 or n != names[i - 1]]
    assert order == ["film", "unstable", "contact"]
    lost, regained = curve.folds
    assert (lost.kind, regained.kind) == ("film_lost", "film_regained")
    assert all(p.film_ratio >= lost.film_ratio for p in curve.points if p.branch == "film")
    assert all(p.film_ratio <= regained.film_ratio for p in curve.points if p.branch == "contact")
    assert max(p.load for p in curve.points if p.branch == "film") <= lost.load * (1 + 1e-9)
    assert min(p.load for p in curve.points if p.branch == "contact") >= regained.load * (1 - 1e-9)


def test_every_point_is_a_solution(curve):
    for p in curve.points:
        good = Status.HOT if p.temperature_max > 523.0 else Status.OK
        assert p.status is (Status.DISTRESS if p.distress else good)
        assert p.fluid_load + p.contact_load == pytest.approx(p.load, rel=1e-6)
        assert p.temperature_max >= p.temperature >= p.oil_temperature
        assert p.distress == (p.branch == "contact" or p.temperature - 297.15 > 200.0)


def test_solving_at_a_points_load_gives_the_point(curve):
    for branch in ("film", "contact"):
        points = [p for p in curve.points if p.branch == branch][1:-1:4]
        assert len(points) >= 3
        for p in points:
            r = solve_washer(WasherParams(), load=p.load, speed=545.0, tilt=0.002, branch=branch)
            assert r.friction_torque == pytest.approx(p.friction_torque, rel=1e-5)
            assert r.film_ratio == pytest.approx(p.film_ratio, abs=1e-3)


def test_a_point_serves_as_start(curve):
    p = next(p for p in curve.points if p.branch == "contact" and p.load > 500.0)
    r = solve_washer(WasherParams(), load=p.load, speed=545.0, tilt=0.002, start=p)
    assert r.branch == "contact" and r.film_ratio == pytest.approx(p.film_ratio, abs=1e-4)


@pytest.mark.parametrize("kind", ["film_lost", "film_regained"])
@pytest.mark.slow
def test_bisection_in_load_finds_the_fold_of_the_continuation(curve, kind):
    """Within 0.01 N on the same grid."""
    fold = next(f for f in curve.folds if f.kind == kind)
    there, gone = (-1.0, 1.0) if kind == "film_lost" else (1.0, -1.0)
    branch = "film" if kind == "film_lost" else "contact"
    at = {"speed": 545.0, "tilt": 0.002, "branch": branch, "throw": False}
    for _ in range(12):
        middle = 0.5 * (there + gone)
        r = solve_washer(WasherParams(), load=fold.load + middle, **at)
        assert r.status is Status.NO_BRANCH or not r.status.is_failure
        if not r.status.is_failure:
            there = middle
        else:
            gone = middle
    assert abs(there) < 0.01 and abs(gone) < 0.01


def test_less_film_heat_moves_the_fold_to_higher_loads(curve):
    loads = [
        load_curve(WasherParams(film_heat_fraction=x, oil_cooling=False), speed=545.0, tilt=0.002)
        .folds[0]
        .load
        for x in (0.3, 0.6, 1.0)
    ]
    assert loads[0] > loads[1] > loads[2] < curve.folds[0].load


def values(text):
    return {name: float(x) for name, x in (word.split("=") for word in text.split())}


FAR = {  # parameters, place, minimum and maximum load [N]
    "soft bodies, whose film grows with the load in the end": (
        """youngs_modulus=1.05e10 youngs_modulus_gear=7.5e10 yield_strength=1.16e9
        roughness_washer=2.8e-7 roughness_carrier=1.8e-7 asperity_radius=3.7e-5
        inner_radius=5.57e-3 gear_inner_radius=7.47e-3 outer_radius=11.43e-3""",
        "speed=14.75 tilt=0.00146 oil_temperature=300.1",
        (14.0, 2100.0),
    ),
    "flat folds": (
        """inner_radius=0.0106 outer_radius=0.0235 gear_inner_radius=0.0123
        washer_thickness=0.00256 carrier_thickness=0.0182 gear_thickness=0.00365
        oil_density=902 heat_split=0.7 roughness_washer=1.73e-6 roughness_carrier=3.17e-7
        youngs_modulus=3.83e10 youngs_modulus_gear=1.05e11 yield_strength=4.91e8
        asperity_radius=1.92e-4 oil_conductivity=0.126 conductivity=10.6""",
        "speed=707 tilt=1.87e-4 oil_temperature=359",
        (59.0, 8827.0),
    ),
    "much oil on a large disc": (
        """inner_radius=0.0222 outer_radius=0.0502 gear_inner_radius=0.0294
        washer_thickness=0.00163 carrier_thickness=0.0117 gear_thickness=0.00741
        oil_density=919 oil_heat_capacity=2240 heat_split=0.673 roughness_washer=2.48e-7
        roughness_carrier=6.1e-7 youngs_modulus=2.68e10 youngs_modulus_gear=1.17e11
        yield_strength=7.6e8 asperity_radius=1.15e-4 oil_conductivity=0.177 conductivity=11.1""",
        "speed=212 tilt=1.28e-4 oil_temperature=342",
        (269.0, 9000.0),
    ),
}
*SHORT, LONG = FAR


@pytest.mark.parametrize("name", [*SHORT, pytest.param(LONG, marks=pytest.mark.slow)])
@pytest.mark.slow
def test_curves_of_washers_far_from_the_default_reach_their_ends(name):
    changes, place, (low, high) = FAR[name]
    params = WasherParams(**values(changes))
    curve = load_curve(params, **values(place), load_min=low, load_max=high)
    assert curve.points[0].load < low and curve.points[-1].load >= high
    kinds = [fold.kind for fold in curve.folds]
    assert kinds == ["film_lost", "film_regained"][: len(kinds)] and len(kinds) in (0, 2)
    for p in curve.points[:: len(curve.points) // 5]:
        assert p.fluid_load + p.contact_load == pytest.approx(p.load, rel=1e-5)


# A washer followed over time: through the fold, back again, and what is refused.

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
