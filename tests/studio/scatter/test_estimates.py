"""Quantiles, probabilities and indices of functions for which they are known."""

import math

import numpy as np
import pytest
from scipy.stats import norm
from stand_ins import ANGLES, NORMAL, ishigami, linear

from lab.benchmarks import scatter as benchmark
from thrustwasher import propagate
from thrustwasher.studio.scatter.estimates import (
    order_statistics,
    probability_bounds,
    quantile_bounds,
    quantiles,
    sobol_indices,
)


@pytest.fixture(scope="module")
def of_ishigami():
    return propagate(ishigami, scatter=ANGLES, runs=4096, workers=1)


@pytest.mark.parametrize(
    ("source", "first", "total"),
    [("x1", 0.3139, 0.5576), ("x2", 0.4424, 0.4424), ("x3", 0.0, 0.2437)],
)
def test_indices_of_ishigamis_function_are_found_within_their_confidence(
    of_ishigami, source, first, total
):
    index = of_ishigami.figures["value"].indices[source]
    assert index.first == pytest.approx(first, abs=min(0.02, index.first_confidence))
    assert index.total == pytest.approx(total, abs=min(0.02, index.total_confidence))
    assert index.confidence == max(index.first_confidence, index.total_confidence)


@pytest.mark.parametrize("correlation", [0.0, 0.8])
def test_a_sum_of_normal_inputs_has_the_mean_and_variance_of_theory(correlation):
    table = {**NORMAL, "correlation": [["a", "b", correlation]]} if correlation else NORMAL
    band = propagate(linear, scatter=table, runs=4096, indices=False, workers=1).figures["sum"]
    s = math.sqrt(9.0 + 4.0 + 1.0 + 2.0 * correlation * 3.0 * 2.0)
    assert band.mean == pytest.approx(60.0, abs=1e-3 * s)
    assert band.standard_deviation**2 == pytest.approx(s**2, rel=0.01)
    for level, value in band.quantiles.items():
        assert value == pytest.approx(60.0 + s * norm.ppf(level), abs=0.02 * s)


def test_indices_of_a_sum_are_shares_of_variance():
    band = propagate(linear, scatter=NORMAL, runs=4096, workers=1).figures["sum"]
    for name, share in {"a": 9.0, "b": 4.0, "c": 1.0}.items():
        assert band.indices[name].first == pytest.approx(share / 14.0, abs=0.01)
        assert band.indices[name].total == pytest.approx(share / 14.0, abs=0.01)


def test_correlated_inputs_have_one_index_under_their_joined_names():
    table = {**NORMAL, "correlation": [["a", "c", 0.8]]}
    result = propagate(linear, scatter=table, runs=1024, workers=1)
    indices = result.figures["sum"].indices
    v = 14.0 + 2.0 * 0.8 * 3.0
    assert list(indices) == ["a + c", "b"] and result.solves == 1024 * 4
    assert indices["b"].total == pytest.approx(4.0 / v, abs=0.02)
    assert indices["a + c"].total == pytest.approx(1.0 - 4.0 / v, abs=0.03)


def test_what_does_not_vary_has_no_index_and_what_does_not_matter_has_zero():
    result = propagate(linear, scatter=NORMAL, runs=64, workers=1)
    same, alone = (result.figures[n].indices for n in ("same", "a alone"))
    assert {i.total for i in same.values()} == {i.first for i in same.values()} == {None}
    assert alone["b"].total == alone["b"].first == 0.0


def test_base_points_with_a_failed_run_count_for_nothing_in_an_index():
    """As if they had never been drawn."""
    rng = np.random.default_rng(1)
    a, b, ab = rng.normal(size=(64, 2)), rng.normal(size=(64, 2)), rng.normal(size=(3, 64, 2))
    few = sobol_indices(a[::2], b[::2], ab[:, ::2])
    ab[1, 1:32:2, 0] = a[33::2, 0] = np.nan
    found = sobol_indices(a, b, ab)
    assert found.left_out.tolist() == [32, 0] and few.left_out.tolist() == [0, 0]
    assert found.first[:, 0] == pytest.approx(few.first[:, 0])
    assert found.total[:, 0] == pytest.approx(few.total[:, 0])


def test_one_figure_of_one_source_has_an_index():
    a, b = np.arange(8.0)[:, None], np.arange(8.0)[::-1, None].copy()
    first, total, _ = sobol_indices(a, b, b[None])
    assert first.shape == total.shape == (1, 1) and total[0, 0] > 0.5


def test_the_median_of_a_value_that_fails_now_and_then_may_be_at_either_end():
    values = np.arange(1000.0)
    low, high = quantile_bounds(values, 0.5)
    values[::50] = np.nan  # 20 of 1000
    wide = quantile_bounds(values, 0.5)
    assert wide.low < low - 5.0 and wide.high > high + 5.0
    assert quantiles(values[:, None])[1, 0] == pytest.approx(500.0)


def test_a_quantile_that_may_lie_among_failed_runs_has_no_bound_there():
    values = np.arange(1000.0)
    values[100:200] = np.nan
    assert quantile_bounds(values, 0.05).low == -np.inf
    assert quantile_bounds(values, 0.95).high == np.inf
    assert np.isfinite(quantile_bounds(values, 0.5)).all()


def test_what_never_happened_is_not_impossible():
    low, high = probability_bounds(np.zeros(64))
    assert low == 0.0 and 0.03 < high < 0.1
    low, high = probability_bounds(np.ones(1024))
    assert 0.99 < low < 1.0 and high == 1.0


def test_a_run_that_fails_may_have_been_either():
    values = np.zeros(512)
    values[:64:2] = np.nan
    low, high = probability_bounds(values)
    assert low == 0.0 and high > 32 / 512


@pytest.mark.parametrize("n", [59, 64, 128, 255])
def test_order_statistics_hold_a_quantile_as_often_as_they_say(n):
    """David & Nagaraja 2003: by the binomial law of how many values are below it."""
    from scipy.stats import binom

    for level in (0.05, 0.95):
        first, last = order_statistics(n, level)
        held = binom.cdf(last - 1, n, level) - binom.cdf(first - 1, n, level)
        assert 0.95 <= held < 0.99


@pytest.mark.slow
@pytest.mark.parametrize("name", benchmark.FUNCTIONS)
def test_intervals_of_small_studies_hold_the_truth(name):
    known = benchmark.FUNCTIONS[name]()
    found = benchmark.coverage(known, 256, 60, benchmark.truth(known, 2**16))
    assert {what: share for what, share in found.items() if share < 0.85} == {}
