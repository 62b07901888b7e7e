"""Calibration: known constants come back, intervals keep their promise, ignorance is named."""

import json

import numpy as np
import pytest
from sampling import sizes
from scipy.stats import binom

from thrustwasher.clutch.calibration.calibration import calibrate
from thrustwasher.clutch.calibration.friction_law import (
    WANG_CONSTANTS,
    friction_over,
    friction_slopes,
    law_values,
    settled_shear,
)
from thrustwasher.clutch.parameters import ClutchParams
from thrustwasher.clutch.solve import solve_clutch
from thrustwasher.errors import ParameterError

TRUTH = {"plough_weight": 0.2, "shear_floor": 0.4, "stick_speed": 1.5, "decay_speed": 2.0}
PACK, TRUE_PACK = ClutchParams(friction_law="wang"), ClutchParams(friction_law="wang", **TRUTH)
RADIUS = PACK.friction_radius
SLIP = np.linspace(1.0, 160.0, 40)  # rad/s: 0.07 .. 12 m/s
LOAD = np.where(np.arange(40) % 2, 1e3, 3e3)
EXACT = friction_over(law_values(TRUE_PACK), SLIP * RADIUS)
SCATTER = 1e-3


def noisy(seed, exact=EXACT):
    return exact + SCATTER * np.random.default_rng(seed).standard_normal(len(exact))


def told(found):
    return {e.name for e in found.estimates if e.identifiable}


def reason(found, name):
    return found[name].reason


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"kink_width": 0.1},
        {"indentation": 0.6, "hardness_ratio": 5.2},
        {"adhesion_factor": 1.5},
    ],
)
def test_the_law_over_arrays_is_that_of_the_kernels(changes):
    pack = ClutchParams(friction_law="wang", **changes)
    speeds = [0.0, 3.0, 15.0, 16.0, 100.0, 5000.0]
    wanted = [solve_clutch(pack, load=1e3, speed=w).friction_coefficient for w in speeds]
    assert friction_over(law_values(pack), np.array(speeds) * RADIUS) == pytest.approx(
        wanted, rel=1e-14
    )


@pytest.mark.parametrize("name", WANG_CONSTANTS)
def test_slopes_are_the_derivatives_of_the_law(name):
    values = law_values(ClutchParams(friction_law="wang", kink_width=0.2, indentation=0.3))
    step = 1e-5 * values[name]
    speed = np.array([0.0, 1.0, 1.3, 4.0, 12.0])
    up = friction_over({**values, name: values[name] + step}, speed)
    down = friction_over({**values, name: values[name] - step}, speed)
    slope = friction_slopes(values, speed, (name,))[:, 0]
    assert slope == pytest.approx((up - down) / (2.0 * step), rel=1e-7, abs=1e-12)


def test_exact_data_give_the_constants_back():
    found = calibrate(PACK, speed=SLIP, load=LOAD, friction=EXACT)
    assert {n: getattr(found.params, n) for n in TRUTH} == pytest.approx(TRUTH, rel=1e-8)
    assert told(found) == set(TRUTH) and found.rms < 1e-12


@pytest.mark.parametrize(
    ("fit", "truth"),
    [
        (("hardness_ratio", "indentation"), {"hardness_ratio": 7.5, "indentation": 0.25}),
        (("hardness_ratio", "shear_floor"), {"hardness_ratio": 4.0, "shear_floor": 0.6}),
        (("indentation", "decay_speed"), {"indentation": 0.8, "decay_speed": 0.5}),
        (("stick_speed",), {"stick_speed": 6.0}),
    ],
)
def test_any_two_of_the_constants_behind_the_two_ends_can_be_fitted(fit, truth):
    exact = friction_over(law_values(ClutchParams(friction_law="wang", **truth)), SLIP * RADIUS)
    found = calibrate(PACK, speed=-SLIP, load=1e3, friction=exact, fit=fit)
    assert {n: getattr(found.params, n) for n in fit} == pytest.approx(truth, rel=1e-8)


def test_the_constant_law_gives_the_weighted_mean():
    pack = ClutchParams(friction_law="constant")
    error = np.array([1e-3, 2e-3, 1e-3])
    found = calibrate(pack, speed=[1, 2, 3], load=1e3, friction=[0.1, 0.13, 0.12],
                      friction_error=error, fit=("constant_friction",))  # fmt: skip
    assert found.params.constant_friction == pytest.approx((0.1 + 0.13 / 4 + 0.12) / 2.25)
    assert found["constant_friction"].standard_error == pytest.approx(1e-3 / 1.5)
    low, high = found["constant_friction"].profile_interval
    assert high - low == pytest.approx(2 * 1.959964 * 1e-3 / 1.5, rel=1e-2)


@sizes(30, 200)
def test_95_percent_intervals_hold_the_truth_in_95_percent_of_experiments(n):
    """Between the 0.05 % and 99.95 % quantiles of the binomial distribution."""
    held = dict.fromkeys(TRUTH, 0)
    for seed in range(n):
        found = calibrate(PACK, speed=SLIP, load=LOAD, friction=noisy(seed), profile=False)
        for e in found.estimates:
            held[e.name] += e.interval[0] <= TRUTH[e.name] <= e.interval[1]
    low, high = binom.interval(0.999, n, 0.95)
    assert all(low <= count <= high for count in held.values()), held


def test_intervals_from_profiles_and_from_slopes_agree_where_points_are_many():
    found = calibrate(PACK, speed=SLIP, load=LOAD, friction=noisy(1))
    for e in found.estimates:
        width = e.interval[1] - e.interval[0]
        assert e.profile_interval == pytest.approx(e.interval, abs=0.05 * width)


def test_a_curved_problem_is_said_to_be_one():
    few = SLIP * RADIUS < 2.5
    found = calibrate(PACK, speed=SLIP[few], load=1e3, friction=noisy(1)[few])
    assert "the profile interval" in str(found)
    assert found["decay_speed"].profile_interval[1] > found["decay_speed"].interval[1]


def test_only_the_two_ends_of_the_curve_are_told_of_four_constants():
    fit = ("plough_weight", "shear_floor", "hardness_ratio", "stick_speed", "decay_speed")
    found = calibrate(PACK, speed=SLIP, load=LOAD, friction=noisy(2), fit=fit)
    assert told(found) == {"stick_speed", "decay_speed"}
    assert "cannot tell" in reason(found, "hardness_ratio")
    assert len(found.confounded) == 1
    assert all(name in found.confounded[0] for name in fit[:3])
    assert found["friction_at_rest"].identifiable and found["friction_at_speed"].identifiable


def test_a_confounded_change_leaves_the_friction_as_it_was():
    fit = ("plough_weight", "shear_floor", "hardness_ratio")
    found = calibrate(PACK, speed=SLIP, load=1e3, friction=EXACT, fit=fit)
    words = found.confounded[0].split("by ")[1].replace(" and", ",").replace(",", "").split()
    values = law_values(found.params)
    before = friction_over(values, SLIP * RADIUS)
    moved = dict(values)
    for name, change in zip(words[0:6:2], words[1:6:2], strict=True):
        moved[name] += float(change)
    alone = {**values, "plough_weight": moved["plough_weight"]}
    alone_moves = np.abs(friction_over(alone, SLIP * RADIUS) - before).max()
    assert np.abs(friction_over(moved, SLIP * RADIUS) - before).max() < 0.02 * alone_moves


def test_points_on_the_plateau_alone_cannot_part_ploughing_from_the_floor():
    fast = np.linspace(40.0, 60.0, 20) / RADIUS
    mu = friction_over(law_values(TRUE_PACK), fast * RADIUS)
    found = calibrate(
        TRUE_PACK, speed=fast, load=1e3, friction=mu, fit=("plough_weight", "shear_floor")
    )
    assert told(found) == set()
    assert "plough_weight and shear_floor apart" in reason(found, "shear_floor").replace(
        "shear_floor and plough_weight", "plough_weight and shear_floor"
    )
    assert found["friction_at_speed"].identifiable and not found["friction_at_rest"].identifiable


def test_points_that_never_reach_the_plateau_cannot_tell_floor_and_decay():
    slow = np.linspace(0.2, 2.0, 30) / RADIUS
    truth = friction_over(law_values(PACK), slow * RADIUS)
    found = calibrate(PACK, speed=slow, load=1e3, friction=noisy(3, truth))
    assert told(found) == {"plough_weight", "stick_speed"}
    assert "decay_speed" in reason(found, "shear_floor")


def test_points_above_stick_speed_do_not_tell_it():
    fast = SLIP * RADIUS > 2.0
    found = calibrate(PACK, speed=SLIP[fast], load=1e3, friction=noisy(1)[fast])
    assert told(found) == {"decay_speed"}
    assert "all points lie above it (slowest slip" in reason(found, "stick_speed")
    assert found["stick_speed"].interval == (0.0, 50.0)
    assert np.isinf(found["stick_speed"].standard_error)


def test_points_below_stick_speed_tell_friction_at_rest_alone():
    slow = np.linspace(0.1, 1.1, 20) / RADIUS
    found = calibrate(PACK, speed=slow, load=1e3, friction=np.full(20, 0.115))
    assert "plough_weight" in told(found) and "decay_speed" not in told(found)
    assert found["friction_at_rest"].value == pytest.approx(0.115, abs=1e-9)
    assert found.params.decay_speed == pytest.approx(PACK.decay_speed, rel=1e-3)


def test_one_speed_tells_no_constant_and_says_so():
    found = calibrate(PACK, speed=np.full(10, 50.0), load=1e3, friction=noisy(4, np.full(10, 0.1)))
    assert told(found) == set()
    assert all("one slip speed (3.75 m/s)" in e.reason for e in found.estimates)


def test_fewer_points_than_constants_are_named():
    found = calibrate(PACK, speed=SLIP[::15], load=1e3, friction=EXACT[::15])
    assert told(found) == set()
    assert all("3 points for 4 constants" in e.reason for e in found.estimates)


def test_as_many_points_as_constants_need_given_errors():
    without = calibrate(PACK, speed=SLIP[::10], load=1e3, friction=EXACT[::10])
    assert "friction_error" in reason(without, "decay_speed") and told(without) == set()
    given = calibrate(PACK, speed=SLIP[::10], load=1e3, friction=EXACT[::10], friction_error=1e-6)
    assert "plough_weight" in told(given)


def test_a_bound_is_named_with_what_would_free_it():
    found = calibrate(PACK, speed=SLIP, load=1e3, friction=0.7 * noisy(1))
    assert found.params.plough_weight == 0.0
    assert found["plough_weight"].at_bound == "lower"
    assert "a larger hardness_ratio" in reason(found, "plough_weight")
    freed = calibrate(
        ClutchParams(friction_law="wang", plough_weight=0.1), speed=SLIP, load=1e3,
        friction=0.7 * noisy(1),
        fit=("hardness_ratio", "shear_floor", "stick_speed", "decay_speed"),
    )  # fmt: skip
    assert freed.rms < 0.5 * found.rms and freed["hardness_ratio"].at_bound == ""


def test_constants_not_told_stay_near_those_given():
    fit = ("plough_weight", "hardness_ratio")
    slow = np.linspace(0.1, 1.1, 20) / RADIUS
    exact = solve_clutch(PACK, load=1e3, speed=5.0).friction_coefficient
    found = calibrate(PACK, speed=slow, load=1e3, friction=np.full(20, exact), fit=fit)
    assert found.params.hardness_ratio == pytest.approx(PACK.hardness_ratio, abs=1e-6)
    assert found.params.plough_weight == pytest.approx(PACK.plough_weight, abs=1e-6)


def test_scatter_alone_does_not_move_a_constant_that_is_not_told():
    slow = SLIP * RADIUS < 1.4
    found = calibrate(PACK, speed=SLIP[slow], load=1e3, friction=noisy(1)[slow])
    assert not found["decay_speed"].identifiable
    assert found.params.decay_speed == pytest.approx(PACK.decay_speed, rel=0.02)


def test_a_load_in_the_data_is_found_and_one_that_is_not_there_is_not():
    clean = calibrate(PACK, speed=SLIP, load=LOAD, friction=noisy(5))
    assert clean.load_test.p_value > 0.05 and not clean.load_test.is_significant
    leaning = noisy(5) * np.where(LOAD > 2e3, 1.05, 1.0)
    found = calibrate(PACK, speed=SLIP, load=LOAD, friction=leaning).load_test
    assert found.is_significant and found.change == pytest.approx(0.05, abs=0.01)
    assert "+4" in found.text or "+5" in found.text


@pytest.mark.parametrize(("load", "words"), [(1e3, "one load"), (np.exp(-SLIP * 0), "one load")])
def test_one_load_is_no_test_of_load(load, words):
    found = calibrate(PACK, speed=SLIP, load=load, friction=EXACT).load_test
    assert found.p_value is None and words in found.text


def test_a_load_that_follows_speed_is_not_tested():
    rows = friction_over(law_values(TRUE_PACK), SLIP * RADIUS)
    found = calibrate(TRUE_PACK, speed=SLIP, load=1e4 * rows, friction=noisy(6)).load_test
    assert found.p_value is None and "only together with speed" in found.text


def test_a_law_with_temperature_says_where_its_points_stand():
    warm = ClutchParams(
        friction_law="wang", shear_temperature_slope=1e-3, reference_temperature=350.0
    )
    found = calibrate(warm, speed=SLIP, load=LOAD, friction=noisy(8))
    assert "measured at reference_temperature (350 K)" in str(found)
    assert "Temperature" not in str(calibrate(PACK, speed=SLIP, load=LOAD, friction=noisy(8)))


def test_chi_square_judges_the_given_errors():
    good = calibrate(PACK, speed=SLIP, load=LOAD, friction=noisy(7), friction_error=SCATTER)
    assert good.reduced_chi_square == pytest.approx(1.0, abs=0.5)
    bad = calibrate(PACK, speed=SLIP, load=LOAD, friction=noisy(7), friction_error=SCATTER / 3)
    assert bad.reduced_chi_square == pytest.approx(9 * good.reduced_chi_square, rel=1e-6)
    assert "larger than friction_error allows" in str(bad)
    assert calibrate(PACK, speed=SLIP, load=LOAD, friction=noisy(7)).reduced_chi_square is None


def test_a_smaller_error_gives_its_points_more_weight():
    lifted = EXACT + np.where(SLIP > 80.0, 0.01, 0.0)
    error = np.where(SLIP > 80.0, 1.0, 1e-4)
    found = calibrate(PACK, speed=SLIP, load=1e3, friction=lifted, friction_error=error)
    assert found.params.decay_speed == pytest.approx(2.0, rel=1e-3)


def test_the_band_is_narrow_at_the_points_and_endless_where_none_are():
    fast = SLIP * RADIUS > 2.0
    found = calibrate(PACK, speed=SLIP[fast], load=1e3, friction=noisy(1)[fast])
    curve, half = found.band([5.0, 0.5, 2.0])
    assert curve[0] == pytest.approx(friction_over(law_values(TRUE_PACK), np.array([5.0]))[0],
                                     abs=3 * half[0])  # fmt: skip
    assert half[0] < SCATTER and np.isinf(half[1:]).all()


def test_correlation_is_that_of_the_told_constants():
    found = calibrate(PACK, speed=SLIP, load=LOAD, friction=noisy(1))
    assert np.diag(found.correlation) == pytest.approx(np.ones(4))
    assert found.correlation == pytest.approx(found.correlation.T)
    assert found.correlation[0, 1] < -0.5  # less ploughing, higher floor


def test_the_fitted_pack_can_be_solved_and_the_result_is_json():
    found = calibrate(PACK, speed=SLIP, load=LOAD, friction=noisy(1))
    mu = solve_clutch(found.params, load=1e3, speed=SLIP[9]).friction_coefficient
    assert noisy(1)[9] - mu == pytest.approx(found.residuals[9], abs=1e-12)
    few = calibrate(PACK, speed=SLIP[::15], load=1e3, friction=EXACT[::15])
    plain = json.loads(json.dumps(few.as_dict(), allow_nan=False))
    assert plain["estimates"][0]["standard_error"] is None


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
    found = calibrate(pack, speed=slip, load=1e3, friction=mu, fit=fit)
    for e in found.estimates:
        assert e.interval[0] <= e.value <= e.interval[1]
        assert e.identifiable or e.reason
    assert str(found)


GOOD = {"speed": SLIP, "load": LOAD, "friction": EXACT}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"speed": SLIP[1:]}, r"speed: shape \(39,\), allowed: one number per point \(40\)"),
        ({"speed": 5.0}, r"speed: shape \(1,\)"),
        ({"speed": np.where(SLIP < 2, np.nan, SLIP)}, r"speed\[0\] = nan rad/s"),
        ({"speed": SLIP * 1e4}, r"speed\[0\] = 10000.0 rad/s, allowed: -5000 .. 5000 rad/s"),
        ({"load": -LOAD}, r"load\[0\] = -3000.0 N"),
        ({"load": 0.0}, r"load\[0\] = 0 N, allowed: above 0"),
        ({"load": ["a"] * 40}, "load: numbers in N are wanted"),
        ({"friction": []}, r"friction: shape \(0,\)"),
        ({"friction": np.ones((2, 2))}, r"friction: shape \(2, 2\)"),
        ({"friction": EXACT * 100}, r"friction\[0\] = "),
        ({"friction": -EXACT}, "allowed: above 0"),
        ({"friction_error": 0.0}, r"friction_error\[0\] = 0, allowed: above 0"),
        ({"fit": ()}, "fit names nothing"),
        ({"fit": ("load",)}, "does not depend on load"),
        ({"fit": ("plough_wight",)}, "did you mean plough_weight"),
        ({"fit": ("faces",)}, "fit = 'faces'"),
        ({"fit": ("constant_friction",)}, "friction_law 'wang'"),
        ({"fit": ("shear_floor", "shear_floor")}, "shear_floor twice"),
        ({"confidence": 1.0}, "confidence = 1.0, allowed: above 0 and below 1"),
        ({"confidence": np.nan}, "confidence = nan"),
    ],
)
def test_wrong_input_is_named(changes, message):
    with pytest.raises(ParameterError, match=message):
        calibrate(PACK, **{**GOOD, **changes})


def test_a_table_gives_way_to_the_law():
    table = ClutchParams.with_table([0.0, 5.0], [0.12, 0.13])
    found = calibrate(table, speed=SLIP, load=LOAD, friction=EXACT)
    assert found.params.friction_law == "wang"
    assert found.params.plough_weight == pytest.approx(0.2, rel=1e-6)


# What the points were measured on.

HOT = 373.15  # K


def measured(**changes):
    """Return the total friction of a settled pack whose asperities follow the true constants."""
    rig = ClutchParams(friction_law="wang", friction_data="boundary", **TRUTH, **changes)
    shear = settled_shear(rig, SLIP, LOAD, np.full(40, HOT))
    found = [
        solve_clutch(rig, load=f, speed=w, oil_temperature=HOT)
        for f, w in zip(LOAD, SLIP, strict=True)
    ]
    mu = [r.friction_coefficient for r in found]
    assert mu == pytest.approx(EXACT, rel=1e-12)
    return EXACT + shear, shear


def test_shear_of_the_settled_film_is_taken_off_for_a_law_of_the_asperities():
    friction, shear = measured(permeability=1e-13)
    assert shear.max() > 0.02 and (shear < 0.5 * friction).all()
    points = {"speed": SLIP, "load": LOAD, "friction": friction}
    law = ClutchParams(friction_law="wang", friction_data="boundary")
    found = calibrate(law, **points, oil_temperature=HOT)
    assert found.params.plough_weight == pytest.approx(0.2, rel=1e-6)
    assert found.params.friction_data == found.as_dict()["friction_data"] == "boundary"
    assert "asperities alone" in str(found)
    as_they_are = calibrate(ClutchParams(), **points)
    assert "total friction" in str(as_they_are) and as_they_are.rms > 1e3 * found.rms


def test_points_that_are_shear_for_the_most_are_refused():
    law = ClutchParams(friction_law="wang", friction_data="boundary")
    cold = {"speed": SLIP, "load": LOAD, "friction": EXACT, "oil_temperature": 260.0}
    with pytest.raises(ParameterError, match=r"friction\[\d+\] = .*: shear of the settled film"):
        calibrate(law, **cold)
    assert calibrate(ClutchParams(), **cold).params.friction_data == "total"


def test_the_oil_s_temperature_is_asked_for():
    law = ClutchParams(friction_law="wang", friction_data="boundary")
    with pytest.raises(ParameterError, match="oil_temperature is missing, wanted with"):
        calibrate(law, speed=SLIP, load=LOAD, friction=EXACT)
