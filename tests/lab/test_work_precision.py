"""Work-precision: first calls apart, failures kept, worst and rms as defined."""

import json
import math

import pytest

from lab.charts.chart_series import Configuration, Quantity, cases_of, digest
from lab.charts.methods import ChartCase, MethodAnswer
from lab.charts.work_precision import CHARTS, measure
from thrustwasher.errors import ParameterError, Status
from thrustwasher.model.registry import spec_of
from thrustwasher.studio.verification.costs import Timing, time_call
from thrustwasher.studio.verification.reference_values import ReferenceValues

CASES = (ChartCase("one", (1.0,)), ChartCase("two", (2.0,)), ChartCase("three", (4.0,)))
KNOWN = [ReferenceValues({"y": c.point[0] ** 2}, {"y": 1e-6}) for c in CASES]
RELATIVE = Quantity("y", True, 1e-3)


class Method:
    """Answers x^2 (1 + error(x)); what it does in a case can be changed."""

    def __init__(self, error=lambda x: 0.0, odd=None):
        self.error, self.odd = error, odd or {}
        self.calls = 0

    def solve(self, case):
        x = case.point[0]
        if case.name in self.odd:
            return self.odd[case.name]()
        return MethodAnswer({"y": x * x * (1.0 + self.error(x))}, Status.OK, 7.0)

    def warm(self, case):
        def call():
            self.calls += 1

        return call

    def idle(self, case):
        return None


def sampled(way, quantities=(RELATIVE,)):
    found = Configuration("family", "label", "knob", "1", lambda: way, "turns")
    return measure(found, CASES, KNOWN, quantities, repeats=3)


def test_worst_and_rms_are_over_all_cases_and_the_worst_is_named():
    s = sampled(Method(lambda x: 0.01 * x))
    assert s.errors["y"]["worst"] == pytest.approx(0.04)
    assert s.errors["y"]["rms"] == pytest.approx(math.sqrt((1e-4 + 4e-4 + 16e-4) / 3.0))
    assert (s.errors["y"]["case"], s.count, s.n_failed) == ("three", 7.0, 0)


def test_absolute_errors_keep_their_unit():
    s = sampled(Method(lambda x: 0.5 / (x * x)), (Quantity("y", False, unit="K"),))
    assert s.errors["y"]["worst"] == pytest.approx(0.5)


def failing():
    raise ZeroDivisionError("no")


def test_every_kind_of_failure_is_counted_and_none_ends_the_run():
    odd = {
        "one": failing,
        "two": lambda: MethodAnswer({"y": 1.0}, Status.MAX_ITERATIONS, 0.0),
        "three": lambda: MethodAnswer({"y": math.nan}, Status.OK, 0.0),
    }
    s = sampled(Method(odd=odd))
    assert s.n_failed == 3 and s.errors["y"]["worst"] is None
    assert s.failures["one"] == "ZeroDivisionError: no"
    assert s.failures["two"] == "MAX_ITERATIONS"
    assert s.failures["three"] == "not finite, silently"
    text = json.dumps(s.as_dict(), allow_nan=False)  # NaN of a cost that is not known: null
    assert json.loads(text)["call_median"] is None


def test_a_way_that_cannot_be_set_up_fails_in_every_case():
    def make():
        raise ParameterError("there is no map")

    s = measure(Configuration("f", "l", "k", "1", make), CASES, KNOWN, (RELATIVE,), repeats=3)
    assert s.n_failed == 3 and s.failures["one"] == "ParameterError: there is no map"


def test_an_answer_outside_the_verified_range_is_no_answer():
    odd = {"two": lambda: MethodAnswer({"y": 4.0}, Status.OUTSIDE_VERIFIED, 0.0)}
    assert sampled(Method(odd=odd)).failures == {"two": "OUTSIDE_VERIFIED"}


class Clock:
    """A clock that only calls move on."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now

    def takes(self, seconds):
        def call():
            self.now += seconds

        return call


@pytest.fixture
def clock(monkeypatch):
    found = Clock()
    monkeypatch.setattr("thrustwasher.studio.verification.costs.CLOCK", found)
    return found


def test_the_first_call_is_apart_and_batches_are_long_enough(clock):
    costs = iter([0.5, *[1e-4] * 10_000])

    def call():
        clock.now += next(costs)

    t = time_call(call, repeats=5, batch=1e-2)
    assert (t.first, t.repeats) == (0.5, 5)
    assert t.median == pytest.approx(1e-4) and t.least == pytest.approx(1e-4)
    assert 5 * 1e-2 <= clock.now - 0.5001 < 6 * 1e-2


def test_what_the_call_itself_costs_is_taken_off(clock):
    way = Method()
    way.warm = lambda case: clock.takes(3e-3)
    way.idle = lambda case: clock.takes(1e-3)
    s = sampled(way)
    assert s.call_median == pytest.approx(2e-3) and s.call_min == pytest.approx(2e-3)


def test_the_cost_is_that_of_the_median_case_and_the_slowest_is_named(clock):
    way = Method()
    way.warm = lambda case: clock.takes({"one": 1e-3, "two": 9e-3, "three": 2e-3}[case.name])
    s = sampled(way)
    assert s.call_median == pytest.approx(2e-3)
    assert (s.slowest_case, s.slowest_call_s) == ("two", pytest.approx(9e-3))


def test_something_is_left_of_every_call():
    assert 0.0 < Timing(1e-6, 0.0, 1e-6, 9, 0.0).less(1.0).median < 1e-6


def test_case_lists_hold_what_their_model_takes():
    for model in ("washer", "gearmesh"):
        spec = spec_of(model)
        for case in cases_of(model):
            for point in (*case.before, case.point):
                assert len(point) == len(spec.inputs)
                for value, signal in zip(point, spec.inputs, strict=True):
                    assert signal.low <= value <= signal.high


def test_a_changed_list_has_another_digest():
    assert digest(CASES) != digest(CASES[:2]) and len(digest(CASES)) == 16
    assert digest(cases_of("washer")) != digest(cases_of("washer", quick=True))


@pytest.mark.parametrize("model", ["washer", "clutch", "gearmesh"])
def test_every_configuration_has_a_label_of_its_own(model):
    found = [series.label for series in CHARTS[model].series(spec_of(model))]
    assert len(set(found)) == len(found)
    assert {r.label for r in CHARTS[model].series(spec_of(model), quick=True)} <= set(found)
    assert set(spec_of(model).levels) <= set(found)
