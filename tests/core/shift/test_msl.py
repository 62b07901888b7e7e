"""The Modelica Standard Library's gear shift: known events, order of convergence, drum inertia.

Event-driven reference at tolerance 1e-11: lock at 2.1107904 s, 5.0425032 rad/s.
"""

import math

import numpy as np
import pytest
from closed_forms.lock_up import speed_against_quadratic_load
from scene_runs import shift, slow_without_jit

LOCK_TIME, LOCK_SPEED = 2.1107904, 5.0425032
MASTERS = ["gauss-seidel", "jacobi"]


def test_engine_speed_in_first_gear_is_the_closed_form():
    r = shift("msl", stop_time=2.0)
    exact = speed_against_quadratic_load(1.5, 20.0, 20.0, 10.471975512, 1.0, 10.0, 2.5)
    assert exact == pytest.approx(11.2486219248636, abs=1e-11)
    assert r.signals["transmission.engine_speed"][-1] == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("master", MASTERS)
def test_four_digits_at_1_ms(master):
    f = shift("msl", stop_time=2.3, master=master).figures
    assert f["lock_time"] == pytest.approx(LOCK_TIME, rel=1e-4)
    assert f["lock_speed"] == pytest.approx(LOCK_SPEED, rel=1e-4)


@pytest.mark.slow
@slow_without_jit
@pytest.mark.parametrize("master", MASTERS)
def test_five_digits_at_0_1_ms(master):
    f = shift("msl", stop_time=2.2, master=master, step=1e-4).figures
    assert f["lock_time"] == pytest.approx(LOCK_TIME, rel=1e-6)
    assert f["lock_speed"] == pytest.approx(LOCK_SPEED, rel=1e-5)


@pytest.mark.parametrize("master", MASTERS)
@pytest.mark.parametrize(("extrapolated", "order"), [(True, 2.0), (False, 1.0)])
@pytest.mark.slow
def test_lock_time_converges_with_the_order_of_the_capacities(master, extrapolated, order):
    """Held capacities are late by part of a step; extrapolated ones leave a second-order error."""
    gearbox = {"capacity_extrapolation": extrapolated, "torque_age": int(master == "jacobi")}
    options = {"stop_time": 2.2, "master": master, "parts": {"transmission": gearbox}}
    runs = [shift("msl", step=h, **options) for h in (4e-3, 2e-3, 1e-3)]
    errors = np.abs([r.figures["lock_time"] - 2.11079036 for r in runs])
    found = np.log2(errors[:-1] / errors[1:])
    assert found == pytest.approx([order, order], abs=0.1)


@slow_without_jit
def test_drum_inertia_delays_the_lock_up_in_proportion():
    """First order in J_r: + 0.0257 s and - 0.419 rad/s per kg m2."""
    base = shift("msl", stop_time=2.2).figures
    for inertia in (0.005, 0.02):
        drum = {"transmission": {"drum_inertia": inertia}}
        f = shift("msl", stop_time=2.2, parts=drum).figures
        assert (f["lock_time"] - base["lock_time"]) / inertia == pytest.approx(0.0257, rel=0.03)
        assert (f["lock_speed"] - base["lock_speed"]) / inertia == pytest.approx(-0.419, rel=0.03)


def test_events_come_in_order_and_the_book_closes():
    r = shift("msl")
    kinds = [e.kind for e in r.events]
    assert kinds == ["ramp_start", "brake_released", "ramp_end", "clutch_locked"]
    assert [p.name for p in r.phases] == ["first gear", "torque phase", "inertia phase", "locked"]
    assert r.energy["residual_share"] < 1e-12
    assert r.energy["coupling_difference_share"] < 1e-3
    assert r.signals["transmission.clutch_speed"][-1] == 0.0
    assert r.signals["transmission.output_speed"][-1] < math.sqrt(20.0 / 20.0) * 10.471975512
