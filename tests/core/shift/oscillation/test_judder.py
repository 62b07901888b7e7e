"""Judder: growth and limit of the torsional mode, against eigenvalues, whatever step and master."""

from dataclasses import replace

import numpy as np
import pytest
from closed_forms.torsional_stability import damping_limit
from scene_runs import shift, slow_without_jit

from thrustwasher.clutch.solve import solve_clutch
from thrustwasher.shift import load_scene
from thrustwasher.shift.account.shift_record import record_of
from thrustwasher.shift.account.swing_texts import chatter_texts
from thrustwasher.shift.masters.master import MASTERS
from thrustwasher.shift.oscillation.torsion import (
    capacity_slopes,
    damping_limit_of,
    handed_over,
    matrix,
    torsional_mode,
)
from thrustwasher.transmission.mobility import planetary

SHORT = {"stop_time": 0.65}  # the swing is still small


def swing(damping=None, **options):
    parts = {} if damping is None else {"transmission": {"shaft_damping": damping}}
    return shift("judder", parts=parts, **{**SHORT, **options}).judder


def law_slope():
    """Return the slope [N m s/rad] of the clutch's law at the scene's slip of 26 rad/s."""
    params = load_scene("judder").parts["clutch"].params
    values = [
        solve_clutch(params, load=1500.0, speed=26.0 + d, fidelity="stribeck").torque_capacity
        for d in (-0.01, 0.01)
    ]
    return (values[1] - values[0]) / 0.02


def closed_limit():
    p = load_scene("judder").parts["transmission"].params
    m = planetary(2.2, p.input_inertia, p.drum_inertia, p.carrier_inertia, p.vehicle_inertia)
    return damping_limit(m, law_slope(), p.shaft_stiffness)


@pytest.mark.parametrize("master", MASTERS)
@pytest.mark.parametrize("step", [1e-3, pytest.param(1e-4, marks=pytest.mark.slow)])
def test_the_swing_grows_as_the_eigenvalue_says_whatever_step_and_master(master, step):
    j = swing(master=master, step=step)
    p = load_scene("judder").parts["transmission"].params
    mode = torsional_mode(matrix(p, {"clutch": law_slope()}, vehicle=65.9))
    assert j.growth == pytest.approx(mode.real, rel=0.02) and mode.real > 3.0
    assert 2.0 * np.pi * j.frequency == pytest.approx(mode.imag, rel=2e-3)
    assert j.kind == "physical"


@slow_without_jit
@pytest.mark.slow
def test_smaller_steps_do_not_shrink_the_growth():
    coarse, fine = swing(step=1e-3), swing(step=1e-4)
    assert coarse.growth == pytest.approx(fine.growth, rel=5e-3)
    assert fine.growth == pytest.approx(fine.mode_growth, rel=2e-3)


@pytest.mark.parametrize("master", ["gauss-seidel", "jacobi"])
@pytest.mark.slow
def test_without_growth_the_damping_is_the_closed_limit(master):
    """Bisect the shaft's damping until the swing neither grows nor decays."""
    low, high = 1.0, 5.0
    for _ in range(8):
        middle = 0.5 * (low + high)
        if swing(middle, master=master).growth > 0.0:
            low = middle
        else:
            high = middle
    assert 0.5 * (low + high) == pytest.approx(closed_limit().damping, rel=0.02)


def test_the_limit_by_bisection_is_the_closed_form_without_load():
    p = replace(load_scene("judder").parts["transmission"].params, load_torque=0.0)
    found = damping_limit_of(p, {"clutch": law_slope()})
    assert found == pytest.approx(closed_limit().damping, rel=1e-9)
    assert damping_limit_of(p, {"clutch": 0.5}) == 0.0


@pytest.mark.slow
def test_the_scene_judders_and_its_damped_twin_does_not():
    wild, tame = shift("judder"), shift("judder-damped")
    assert wild.judder.damping < 0.5 * wild.judder.limit_damping
    assert wild.judder.stick_slip and wild.phases[-1].name == "stick-slip"
    assert wild.judder.amplitude > 2.0 * wild.signals["transmission.resistance_torque"].max()
    assert tame.judder.kind == "decaying" and tame.judder.locks == 0
    assert tame.judder.growth == pytest.approx(tame.judder.mode_growth, rel=0.02)
    torque = tame.signals["transmission.shaft_torque"]
    assert np.ptp(torque[tame.time > 2.3]) < 0.05 * np.ptp(torque[tame.time < 0.5])
    for r in (wild, tame):
        assert r.energy["residual_share"] < 1e-9
        assert r.energy["shaft"] > 0.0
    assert r.figures["judder_limit_damping"] == tame.judder.limit_damping


def test_a_large_swing_grows_by_the_slope_it_meets():
    """Up to half of its maximum swing; parts of it lie where friction falls less."""
    whole = shift("judder", stop_time=1.7).judder
    small = swing()
    assert small.mode_growth > whole.mode_growth > 0.95 * small.mode_growth
    assert whole.growth == pytest.approx(whole.mode_growth, rel=0.02)


def test_a_long_step_makes_a_swing_that_is_no_judder_and_a_good_one_does_not():
    """Damping above the limit: the mode decays, yet torques two long steps old make it grow."""
    wrong = swing(2.7, master="jacobi", step=1e-2, stop_time=2.0)
    assert wrong.growth > 0.0 > wrong.mode_growth and wrong.kind == "numerical"
    assert wrong.growth == pytest.approx(wrong.mode_growth + wrong.step_growth, rel=0.15)
    right = swing(2.7, master="jacobi", step=wrong.good_step, stop_time=1.0)
    assert right.kind == "decaying"


def test_a_rigid_shaft_has_nothing_to_swing():
    stiff = {"shaft_stiffness": 0.0, "shaft_damping": 0.0, "initial_twist": 0.0}
    r = shift("judder", parts={"transmission": stiff}, stop_time=0.3)
    assert r.judder is None and r.as_dict()["judder"] is None
    assert not [name for name in r.figures if name.startswith("judder")]


def test_shear_of_cold_oil_keeps_the_clutch_from_judder():
    """With the film's shear next to a law of the asperities the torque rises with slip again."""
    field = {"clutch": {"fidelity": "field", "starts_pressed": True, "friction_data": "boundary"}}
    j = shift("judder", parts=field, **SHORT).judder
    assert j.slope > 0.0 and j.limit_damping == 0.0 and j.kind == "decaying"
    assert j.growth == pytest.approx(j.mode_growth, rel=0.02)


@pytest.mark.parametrize("level", ["stribeck", "field"])
def test_slopes_at_recorded_points_are_those_of_differences(level):
    params = load_scene("judder").parts["clutch"].params
    near = [solve_clutch(params, load=1500.0, speed=s, fidelity=level) for s in (25.9, 26.0, 26.1)]
    signals = {
        f"clutch.{name}": np.array([getattr(r, name) for r in near])
        for name in ("temperature", "film_ratio", "torque_capacity", "viscous_torque")
    } | {"clutch.speed": np.array([25.9, 26.0, 26.1])}
    found = capacity_slopes(params, level, "clutch", signals, np.array([1]))
    contact = [r.torque_capacity - r.viscous_torque for r in near]
    viscous = near[1].viscous_torque / 26.0  # Couette flow: in proportion to slip
    assert found[0] == pytest.approx((contact[2] - contact[0]) / 0.2 + viscous, rel=1e-4)


@pytest.mark.parametrize("age", [0, 1])
@pytest.mark.parametrize("extrapolated", [False, True])
def test_what_is_handed_over_is_the_swing_that_a_receiver_sees(age, extrapolated):
    """Against the projection of the received signal, made point by point."""
    angle, n, m = 0.3, 400, 200
    points = np.exp(1j * angle * np.arange(-3, n))
    x = (np.arange(m) + 0.5) / m
    seen = 0.0
    for k in range(3, n):
        now, before = points[k - age], points[k - age - 1]
        received = now + (age + x) * (now - before) * extrapolated
        seen += np.mean(received * np.exp(-1j * angle * (k - 3 + x)))
    assert handed_over(angle, age, extrapolated) == pytest.approx(seen / (n - 3), abs=1e-5)
    assert handed_over(1e-9, age, extrapolated) == pytest.approx(1.0, abs=1e-8)
    small = [handed_over(a, age, extrapolated) for a in (0.999e-3, 1.001e-3)]
    assert small[0] == pytest.approx(small[1], abs=1e-5)


# Chatter: found where a step is too long for a torque loop, and the step named ends it.

BARE = {"washer": None, "mesh": None}


def bare(stop_time=0.9, coupling="torque", **options):
    parts = BARE | {"transmission": {"washers": 0, "coupling": coupling}}
    return shift("planetary-sun", parts=parts, stop_time=stop_time, **options)


@pytest.mark.parametrize(("master", "limit"), [("gauss-seidel", 2.0), ("jacobi", 1.0)])
def test_a_torque_loop_over_its_limit_chatters_and_says_why(master, limit):
    r = bare(master=master)
    found = {c.pack: c for c in r.chatter}["clutch"]
    assert found.limit == limit < found.kappa and found.turns > 40
    assert found.inertia == pytest.approx(0.1157, abs=1e-4)
    assert r.as_dict()["chatter"][0]["kappa"] > 1.0
    text = " ".join(chatter_texts(record_of(r)))
    for words in ("Numerical", "kappa", f"below {limit:g}", 'coupling = "capacity"', master):
        assert words in text


@slow_without_jit
@pytest.mark.parametrize("master", ["gauss-seidel", pytest.param("jacobi", marks=pytest.mark.slow)])
def test_the_step_that_is_named_ends_the_chatter(master):
    """With ten times the smoothing, so that the step is not tiny."""
    smooth = {"speed_smoothing": 1.0}
    parts = BARE | {"transmission": {"washers": 0, "coupling": "torque"}}
    parts |= {"clutch": smooth, "brake": smooth}
    wrong = shift("planetary-sun", parts=parts, stop_time=1.0, master=master, step=2e-3)
    clutch = {c.pack: c for c in wrong.chatter}["clutch"]
    right = shift("planetary-sun", parts=parts, stop_time=0.8, master=master, step=clutch.good_step)
    assert right.chatter == []


def test_nothing_chatters_where_packs_stick_or_torques_are_corrected():
    assert bare(coupling="capacity").chatter == []
    assert bare(master="linearly-implicit").chatter == []
