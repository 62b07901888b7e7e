"""The friction law fitted: its constants come back, and what points leave open is named."""

import json
from dataclasses import replace

import numpy as np
import pytest
from sampling import sizes
from scipy.stats import binom

from thrustwasher import ClutchParams, ParameterError, calibrate, solve_clutch
from thrustwasher.studio.calibration.friction import friction_law
from thrustwasher.studio.calibration.friction.friction_law import (
    WANG_CONSTANTS,
    friction_over,
    law_values,
    settled_shear,
)

TRUTH = {"plough_weight": 0.2, "shear_floor": 0.4, "stick_speed": 1.5, "decay_speed": 2.0}
PACK, TRUE_PACK = ClutchParams(friction_law="wang"), ClutchParams(friction_law="wang", **TRUTH)
RADIUS = PACK.friction_radius
SLIP = np.linspace(1.0, 160.0, 40)  # rad/s: 0.07 .. 12 m/s
LOAD = np.where(np.arange(40) % 2, 1e3, 3e3)
EXACT = friction_over(law_values(TRUE_PACK), SLIP * RADIUS)
SCATTER = 1e-3
HOT = 373.15  # K
BOUNDARY = replace(PACK, friction_data="boundary", friction_temperature_slope=0.0)


def noisy(seed, exact=EXACT):
    return exact + SCATTER * np.random.default_rng(seed).standard_normal(len(exact))


def fitted(friction=EXACT, pack=PACK, speed=SLIP, load=1e3, **more):
    return calibrate(pack, speed=speed, load=load, friction=friction, **more)


def told(found):
    return {e.name for e in found.estimates if e.identifiable}


@pytest.mark.parametrize(
    "changes",
    [{}, {"kink_width": 0.1}, {"indentation": 0.6, "hardness_ratio": 5.2, "adhesion_factor": 1.5}],
)
def test_the_law_over_arrays_is_that_of_the_kernels(changes):
    pack = ClutchParams(friction_law="wang", **changes)
    speeds = [0.0, 3.0, 15.0, 16.0, 100.0, 5000.0]
    pack = replace(pack, friction_temperature_slope=0.0)
    at = {"load": 1e3, "interface_temperature": HOT}
    wanted = [solve_clutch(pack, **at, speed=w).friction_coefficient for w in speeds]
    found = friction_over(law_values(pack), np.array(speeds) * RADIUS)
    assert found == pytest.approx(wanted, rel=1e-14)


@pytest.mark.parametrize(
    "truth",
    [
        TRUTH,
        {"hardness_ratio": 7.5, "indentation": 0.25},
        {"hardness_ratio": 4.0, "shear_floor": 0.6},
        {"indentation": 0.8, "decay_speed": 0.5},
        {"stick_speed": 6.0},
    ],
)
def test_any_two_of_the_constants_behind_the_two_ends_can_be_fitted(truth):
    exact = friction_over(law_values(ClutchParams(friction_law="wang", **truth)), SLIP * RADIUS)
    found = fitted(exact, speed=-SLIP, fit=tuple(truth))
    assert {n: getattr(found.params, n) for n in truth} == pytest.approx(truth, rel=1e-8)
    assert told(found) == set(truth)


@sizes(30, 200)
def test_95_percent_intervals_hold_the_truth_in_95_percent_of_experiments(n):
    """Between the 0.05 % and 99.95 % quantiles of the binomial distribution."""
    held = dict.fromkeys(TRUTH, 0)
    for seed in range(n):
        for e in fitted(noisy(seed), profile=False).estimates:
            held[e.name] += e.interval[0] <= TRUTH[e.name] <= e.interval[1]
    low, high = binom.interval(0.999, n, 0.95)
    assert all(low <= count <= high for count in held.values()), held


def test_profiles_and_slopes_agree_where_points_are_many_and_else_it_is_said():
    found = fitted(noisy(1))
    for e in found.estimates:
        width = e.interval[1] - e.interval[0]
        assert e.profile_interval == pytest.approx(e.interval, abs=0.05 * width)
    assert found.correlation[0, 1] == found.correlation[1, 0] < -0.5  # less ploughing, more floor
    few = SLIP * RADIUS < 2.5
    curved = fitted(noisy(1)[few], speed=SLIP[few])
    assert "the profile interval" in str(curved)
    assert curved["decay_speed"].profile_interval[1] > curved["decay_speed"].interval[1]


def test_a_confounded_change_leaves_the_friction_as_it_was():
    """Of four constants behind the two ends of the curve the ends alone are told."""
    fit = ("plough_weight", "shear_floor", "hardness_ratio")
    found = fitted(noisy(2), fit=(*fit, "stick_speed", "decay_speed"))
    assert told(found) == {"stick_speed", "decay_speed"} and len(found.confounded) == 1
    assert "cannot tell" in found["hardness_ratio"].reason
    assert all(e.identifiable for e in found.end_frictions)
    words = fitted(fit=fit).confounded[0].split("by ")[1].replace(" and", "").replace(",", "")
    changes = dict(zip(words.split()[0:6:2], map(float, words.split()[1:6:2]), strict=True))
    values = law_values(fitted(fit=fit).params)

    def moved(names):
        new = values | {name: values[name] + changes[name] for name in names}
        return np.abs(friction_over(new, SLIP * RADIUS) - friction_over(values, SLIP * RADIUS))

    assert set(changes) == set(fit)
    assert moved(fit).max() < 0.02 * moved(["plough_weight"]).max()


@pytest.mark.parametrize(
    ("speed", "known", "lost", "words"),
    [
        (np.linspace(0.2, 2.0, 30), {"plough_weight", "stick_speed"}, "shear_floor", "decay_speed"),
        (np.linspace(2.0, 12.0, 33), {"decay_speed"}, "stick_speed", "all points lie above it"),
        (np.linspace(0.1, 1.1, 20), {"plough_weight"}, "decay_speed", "lie below stick_speed"),
        (np.full(10, 3.75), set(), "decay_speed", "one slip speed (3.75 m/s)"),
        (np.linspace(0.1, 12.0, 3), set(), "decay_speed", "3 points for 4 constants"),
    ],
)
def test_what_the_points_speeds_do_not_tell_is_named(speed, known, lost, words):
    exact = friction_over(law_values(TRUE_PACK), speed)
    found = fitted(noisy(3, exact), speed=speed / RADIUS)
    assert told(found) == known and not found[lost].identifiable
    assert words in found[lost].reason
    limits = ClutchParams.__dataclass_fields__[lost].metadata
    assert found[lost].interval == (limits["min"], limits["max"])


def test_as_many_points_as_constants_are_enough_with_their_errors():
    without = fitted(EXACT[::10], speed=SLIP[::10])
    assert "friction_error" in without["decay_speed"].reason and told(without) == set()
    assert "plough_weight" in told(fitted(EXACT[::10], speed=SLIP[::10], friction_error=1e-6))


def test_a_bound_is_named_with_what_would_free_it():
    found = fitted(0.7 * noisy(1))
    assert found.params.plough_weight == 0.0
    assert found["plough_weight"].at_bound == "lower"
    assert "a larger hardness_ratio" in found["plough_weight"].reason
    fit = ("hardness_ratio", "shear_floor", "stick_speed", "decay_speed")
    freed = fitted(0.7 * noisy(1), ClutchParams(friction_law="wang", plough_weight=0.1), fit=fit)
    assert freed.rms < 0.5 * found.rms and freed["hardness_ratio"].at_bound == ""


def test_constants_not_told_stay_near_those_given():
    slow = np.linspace(0.1, 1.1, 20) / RADIUS
    exact = friction_over(law_values(PACK), np.array([5.0 * RADIUS]))[0]
    found = fitted(np.full(20, exact), speed=slow, fit=("plough_weight", "hardness_ratio"))
    assert found.params.hardness_ratio == pytest.approx(PACK.hardness_ratio, abs=1e-6)
    assert found.params.plough_weight == pytest.approx(PACK.plough_weight, abs=1e-6)
    found = fitted(noisy(1)[SLIP * RADIUS < 1.4], speed=SLIP[SLIP * RADIUS < 1.4])
    assert not found["decay_speed"].identifiable  # nor does scatter move it
    assert found.params.decay_speed == pytest.approx(PACK.decay_speed, rel=0.02)


def test_a_load_in_the_data_is_found_and_one_that_is_not_there_is_not():
    clean = fitted(noisy(5), load=LOAD).load_test
    assert clean.p_value > 0.05 and not clean.is_significant
    found = fitted(noisy(5) * np.where(LOAD > 2e3, 1.05, 1.0), load=LOAD).load_test
    assert found.is_significant and found.change == pytest.approx(0.05, abs=0.01)
    assert "+4" in found.text or "+5" in found.text
    for load, words in ((1e3, "one load"), (1e4 * EXACT, "only together with speed")):
        test = fitted(noisy(6), TRUE_PACK, load=load).load_test
        assert test.p_value is None and words in test.text


def test_chi_square_judges_the_given_errors():
    good, bad = (fitted(noisy(7), friction_error=SCATTER / k) for k in (1, 3))
    assert good.reduced_chi_square == pytest.approx(1.0, abs=0.5)
    assert bad.reduced_chi_square == pytest.approx(9 * good.reduced_chi_square, rel=1e-6)
    assert "larger than friction_error allows" in str(bad)
    assert fitted(noisy(7)).reduced_chi_square is None


def test_the_band_is_narrow_at_the_points_and_endless_where_none_are():
    fast = SLIP * RADIUS > 2.0
    curve, half = fitted(noisy(1)[fast], speed=SLIP[fast]).band([5.0, 0.5, 2.0])
    exact = friction_over(law_values(TRUE_PACK), np.array([5.0]))[0]
    assert curve[0] == pytest.approx(exact, abs=3 * half[0])
    assert half[0] < SCATTER and np.isinf(half[1:]).all()


def test_the_fitted_pack_can_be_solved_and_the_result_is_json():
    found = fitted(noisy(1), load=LOAD)
    mu = friction_over(law_values(found.params), SLIP[9:10] * RADIUS)[0]
    assert noisy(1)[9] - mu == pytest.approx(found.residuals[9], abs=1e-12)
    few = fitted(EXACT[::15], speed=SLIP[::15])
    plain = json.loads(json.dumps(few.as_dict(), allow_nan=False))
    assert plain["estimates"][0]["standard_error"] is None
    warm = ClutchParams(
        friction_law="wang", shear_temperature_slope=1e-3, reference_temperature=350.0
    )
    assert "measured at reference_temperature (350 K)" in str(fitted(noisy(8), warm))
    assert "Temperature" not in str(fitted(pack=replace(PACK, friction_temperature_slope=0.0)))


def test_the_change_of_friction_with_temperature_is_fitted_to_points_at_several():
    oil = np.linspace(243.15, 403.15, 40)
    pack = replace(TRUE_PACK, friction_temperature_slope=-2e-3)
    friction = [
        solve_clutch(pack, load=1e3, speed=0.0, oil_temperature=t).friction_coefficient for t in oil
    ]
    fit = ("friction_temperature_slope", "shear_floor", "stick_speed", "decay_speed")
    exact = np.array(friction) * EXACT / EXACT[0]  # the slowest point is below stick_speed
    found = fitted(exact, TRUE_PACK, oil_temperature=oil, fit=fit)
    wanted = {n: getattr(pack, n) for n in fit}
    assert {n: getattr(found.params, n) for n in fit} == pytest.approx(wanted, rel=1e-6)
    assert "-0.2 % per kelvin" in str(found)
    one = fitted(EXACT, TRUE_PACK, oil_temperature=373.15, fit=fit[:2])
    assert "one temperature" in one["friction_temperature_slope"].reason


def choice(found):
    p = found.params
    return p.friction_temperature, p.friction_temperature_slope


def test_a_fit_writes_out_how_friction_changes_with_temperature():
    own = ClutchParams.with_table([0.0, 5.0], [0.12, 0.13])
    assert choice(fitted(pack=ClutchParams())) == ("slope", -1e-3)  # the table's of the start
    assert choice(fitted(pack=own)) == ("slope", 0.0)  # one's own table has none
    oil = np.linspace(293.15, 393.15, 5)
    constant = ClutchParams(friction_law="constant")
    mu = 0.11 * np.exp(-4e-3 * (oil - HOT))
    fit = ("constant_friction", "friction_temperature_slope")
    found = fitted(mu, constant, speed=np.full(5, 50.0), oil_temperature=oil, fit=fit)
    assert choice(found) == ("slope", pytest.approx(-4e-3, rel=1e-6))
    points = {"point_temperature_1": 293.15, "point_temperature_2": 393.15}
    points |= {"point_friction_1": 0.15, "point_friction_2": 0.10, "reference_temperature": 343.15}
    pack = replace(PACK, friction_temperature="points", **points)
    warm = np.linspace(293.15, 393.15, 40)
    exact = EXACT * np.interp(warm, [293.15, 393.15], [0.15, 0.10]) / 0.125
    found = fitted(exact, pack, oil_temperature=warm)
    assert {n: getattr(found.params, n) for n in TRUTH} == pytest.approx(TRUTH, rel=1e-8)
    assert choice(found)[0] == "points" and "by its points" in str(found)
    with pytest.raises(ParameterError, match="stands in place of"):
        fitted(exact, pack, oil_temperature=warm, fit=("friction_temperature_slope",))


@pytest.mark.parametrize(
    ("slip", "mu", "fit"),
    [
        (np.zeros(8), 0.1 + 1e-3 * np.arange(8), ("decay_speed", "shear_floor")),
        (np.array([30.0, 90.0]), np.array([1e-12, 1e-12]), WANG_CONSTANTS),
        (1e-4 * np.arange(1, 9), np.full(8, 0.1), ("decay_speed", "plough_weight", "indentation")),
        (np.array([5000.0]), np.array([0.05]), ("decay_speed",)),
        (np.array([0.0, 0.0, 9.0]), np.array([0.0, 0.0, 0.3]), ("stick_speed", "shear_floor")),
    ],
)
@pytest.mark.parametrize("width", [0.0, 1.0])
def test_hopeless_questions_get_an_honest_answer(slip, mu, fit, width):
    pack = ClutchParams(friction_law="wang", kink_width=width)
    found = fitted(mu, pack, speed=slip, fit=fit)
    for e in found.estimates:
        assert e.interval[0] <= e.value <= e.interval[1]
        assert e.identifiable or e.reason
    assert str(found)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"load": 0.0}, "load: point 1 is 0, allowed: above 0 N"),
        ({"friction": EXACT * 100}, "friction: point 1 is 11.*, allowed: -2 .. 2"),
        ({"friction": -EXACT}, "friction is -.* on average, allowed: above 0"),
        (
            {"friction_torque": 1.0, "errors": {"friction": 1, "friction_torque": 1}},
            "other outputs",
        ),
        ({"faces": np.arange(40) % 2 * 2 + 4}, "all points of one pack"),
        ({"fit": ("load",)}, "does not depend on load"),
        ({"fit": ("plough_wight",)}, "did you mean plough_weight"),
        ({"fit": ("constant_friction",)}, "friction_law 'wang'"),
        ({"pack": BOUNDARY}, "oil_temperature is missing, required with"),
        ({"fit": ("friction_temperature_slope",)}, "oil_temperature is missing, required with"),
        ({"pack": BOUNDARY, "oil_temperature": 260.0}, "twice the shear of the settled film"),
    ],
)
def test_what_the_law_cannot_use_is_named(changes, message):
    with pytest.raises(ParameterError, match=message):
        fitted(**changes)


def test_a_table_gives_way_to_the_law():
    found = fitted(pack=ClutchParams.with_table([0.0, 5.0], [0.12, 0.13]))
    assert found.params.friction_law == "wang"
    assert found.params.plough_weight == pytest.approx(0.2, rel=1e-6)


def test_shear_of_the_settled_film_is_taken_off_for_a_law_of_the_asperities():
    rig = ClutchParams(friction_law="wang", friction_data="boundary", permeability=1e-13, **TRUTH)
    shear = settled_shear(rig, SLIP, LOAD, np.full(40, HOT))
    points = {"friction": EXACT + shear, "load": LOAD}
    assert shear.max() > 0.02 and (shear < 0.5 * points["friction"]).all()
    found = fitted(**points, pack=BOUNDARY, oil_temperature=HOT)
    assert found.params.plough_weight == pytest.approx(0.2, rel=1e-6)
    assert found.params.friction_data == found.as_dict()["friction_data"] == "boundary"
    assert "asperities alone" in str(found)
    as_they_are = fitted(**points)
    assert "total friction" in str(as_they_are) and as_they_are.rms > 1e3 * found.rms


def test_of_many_points_the_search_takes_some_and_the_fit_all(monkeypatch):
    monkeypatch.setattr(friction_law, "N_SEARCHED", 20)
    measured = noisy(5)
    some = fitted(measured)
    monkeypatch.setattr(friction_law, "N_SEARCHED", 40)
    every = fitted(measured)
    for one, other in zip(some.estimates, every.estimates, strict=True):
        assert one.value == pytest.approx(other.value, rel=1e-6)
        assert one.interval == pytest.approx(other.interval, rel=1e-3)
