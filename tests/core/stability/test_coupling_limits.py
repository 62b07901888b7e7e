"""Steps at which a co-simulated loop stops being stable, bisected, against the formulas.

Hazard: each part is stable and right on its own; a signal held between them, or a step old, makes
    the loop swing, grow, or settle nowhere.
Formula: kappa = H c/J for a step H, J the inertia that the clutch's slip sees, c =
    d(torque)/d(slip): stable below 2 with fresh torques, below 1 with torques a step old.
Cure: capacities instead of torques, or torques with their slopes; else steps below the limit.
    All parts are FMUs stepped through FMPy: a transmission with its clutch, or a body with a linear
    law.
"""

from pathlib import Path

import numpy as np
import pytest
from built import built_fmu
from loops.running import (
    body_and_law,
    dies_out,
    gearbox_and_clutch,
    keeps_its_side,
    last_step,
    march,
)
from loops.specs import BODY, LAW

SOURCES = Path(__file__).parent / "loops" / "texts"  # there are none
WITHIN = 0.02

# The set of the default scene, without load: what acts is engine and clutch.
SUN, CARRIER, RING, RATIO = 0.25, 8.0, 0.01, 66 / 30
ENGINE, SLIP, FORCE, RADIUS = 150.0, 50.0, 1000.0, 0.1


@pytest.fixture(scope="module")
def fmus():
    made = [built_fmu(s.key, target="python", sources=SOURCES, local=True) for s in (BODY, LAW)]
    made += [built_fmu(n, local=True) for n in ("WetClutch", "ShiftTransmission")]
    return {path.stem: path for path in made}


def seen_by_the_slip():
    """Return J with the brake open, and the engine's torque as far as the slip feels it."""
    ring = np.array([-1.0 / RATIO, (1.0 + RATIO) / RATIO])  # its speed from those of sun, carrier
    slip = np.array([1.0, 0.0]) - ring
    mass = np.diag([SUN, CARRIER]) + RING * np.outer(ring, ring)
    mobility = np.linalg.inv(mass)
    inertia = 1.0 / (slip @ mobility @ slip)
    return inertia, inertia * (slip @ mobility @ [ENGINE, 0.0])


OPEN, DRIVE = seen_by_the_slip()
HELD = SUN + CARRIER / (1.0 + RATIO) ** 2  # brake closed: the ring rests


def at_work(fmus, slope, deviation=10.0, rest=DRIVE, brake=0.0, ring=None, **gearbox):
    """Return a system near a steady slip: friction there carries ``rest``, with ``slope`` [N.m.s].

    The clutch's coefficient is a straight line over slip, without heat and with a settled film.
    """
    per_torque = 1.0 / (FORCE * RADIUS * 10.0)
    low, high = 0.0, 2.0 * SLIP
    start, end = (per_torque * (rest + slope * (w - SLIP)) for w in (low, high))
    speeds = {f"table_speed_{k}": high * RADIUS + k - 1.0 for k in range(1, 6)}
    values = {f"table_friction_{k}": end for k in range(1, 6)}
    clutch = {
        "fidelity": "stribeck",
        "friction_law": "table",
        "friction_temperature_slope": 0.0,
        "faces": 10,
        "effective_radius": RADIUS,
        "table_friction_0": start,
        **speeds,
        **values,
        "speed_smoothing": 1e-3,
    }
    return gearbox_and_clutch(fmus, _gearbox(SLIP + deviation, ring, gearbox), clutch, brake)


def with_coulomb(fmus, torque, slip, smoothing, **gearbox):
    """Return a system with a constant coefficient, smoothed over ``smoothing`` [rad/s]."""
    friction = torque / (FORCE * RADIUS * 10.0)
    clutch = {
        "fidelity": "closed",
        "constant_friction": friction,
        "faces": 10,
        "effective_radius": RADIUS,
        "speed_smoothing": smoothing,
        "friction_law": "constant",
        "friction_temperature_slope": 0.0,
    }
    return gearbox_and_clutch(fmus, _gearbox(slip, None, gearbox), clutch)


def _gearbox(slip, ring, more):
    """Return parameters with the given slip at the start; the carrier turns at 100 rad/s or so."""
    ring = 100.0 if ring is None else ring
    return {
        "load_torque": 0.0,
        "washers": 0,
        "clutch_force": FORCE,
        "drum_inertia": RING,
        "engine_torque": ENGINE,
        "initial_drum_speed": ring,
        "initial_engine_speed": ring + slip,
        **more,
    }


def deviation(system, master, h, n=120):
    return march(system, master, h, n)["transmission.clutch_speed"] - SLIP


def limit(system, master, expected, judge, n=120):
    """Bisect the step between a half and twice what is expected; return the share of it found."""
    found = last_step(
        lambda h: judge(deviation(system, master, h, n)), 0.5 * expected, 2.0 * expected
    )
    return found / expected


SLOPE = 2.0  # N.m.s/rad
TORQUE = {"coupling": "torque"}


@pytest.mark.parametrize(
    "master, judge, kappa",
    [
        ("gauss-seidel", dies_out, 2.0),
        ("gauss-seidel", keeps_its_side, 1.0),
        ("jacobi", dies_out, 1.0),
        ("jacobi", keeps_its_side, 0.25),
    ],
)
def test_a_held_friction_torque_limits_the_step(master, judge, kappa, fmus):
    system = at_work(fmus, SLOPE, **TORQUE)
    found = limit(system, master, kappa * OPEN / SLOPE, judge)
    assert found == pytest.approx(1.0, abs=WITHIN)


@pytest.mark.parametrize("extrapolated, kappa", [(False, 2.0), (True, 1.0)])
def test_a_torque_extrapolated_linearly_allows_half_the_step_of_a_held_one(
    extrapolated, kappa, fmus
):
    system = at_work(fmus, SLOPE, capacity_extrapolation=extrapolated)
    found = limit(system, "gauss-seidel", kappa * OPEN / SLOPE, dies_out)
    assert found == pytest.approx(1.0, abs=WITHIN)


def test_a_closed_brake_gives_the_slip_another_inertia(fmus):
    """The ring rests: sun and carrier turn together, the slip is the sun's speed."""
    system = at_work(fmus, SLOPE, rest=ENGINE, brake=1e5, ring=0.0, capacity_extrapolation=False)
    found = limit(system, "gauss-seidel", 2.0 * HELD / SLOPE, dies_out)
    assert found == pytest.approx(1.0, abs=WITHIN)
    assert HELD / OPEN > 5.0


@pytest.mark.parametrize("kappa", [0.1, 1.0, 2.0, 30.0, 1e3])
def test_linearly_implicit_steps_of_any_length_are_stable(kappa, fmus):
    """The factor per step is 1/(1 + kappa)."""
    drive = SLOPE * SLIP
    system = at_work(fmus, SLOPE, rest=drive, engine_torque=ENGINE * drive / DRIVE, **TORQUE)
    found = deviation(system, "linearly-implicit", kappa * OPEN / SLOPE, 3)
    assert found[1:3] / found[:2] == pytest.approx(1.0 / (1.0 + kappa), rel=WITHIN)


GROWTH = {  # per step, of a deviation where friction falls; x = H |c|/J
    "gauss-seidel": lambda x: 1.0 + x,
    "jacobi": lambda x: 0.5 + np.sqrt(0.25 + x),
    "linearly-implicit": lambda x: 1.0 + x + x * x,
}


@pytest.mark.parametrize("x", [0.05, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("master", GROWTH)
def test_no_master_damps_what_falling_friction_makes_grow(master, x, fmus):
    """The driveline grows by exp(x) per step; an implicit torque, 1/(1 - x), had a pole at 1."""
    system = at_work(fmus, -SLOPE, deviation=1e-4, **TORQUE)
    n = 5 if x > 0.5 and master != "jacobi" else 11
    found = deviation(system, master, x * OPEN / SLOPE, n)
    rate = found[n] / found[n - 1]
    assert rate == pytest.approx(GROWTH[master](x), rel=WITHIN)
    assert rate > 1.0
    if x == 0.05:
        assert rate - 1.0 == pytest.approx(np.expm1(x), rel=1.5 * x)


CAPACITY = 100.0


def chatter(system, master, h, n=40):
    """Return the slips of a loop with Coulomb friction, from the first change of sign on."""
    slip = march(system, master, h, n)["transmission.clutch_speed"]
    return slip[int(np.argmax(slip < 0.0)) - 1 :]


def test_held_coulomb_friction_chatters_in_a_band(fmus):
    """The slip never leaves -(T_k - T_x) H/J .. (T_k + T_x) H/J and fills it; T_x drives it on."""
    drive, h = 0.3 * CAPACITY, 1e-3
    engine = ENGINE * drive / DRIVE
    low, high = -(CAPACITY - drive) * h / OPEN, (CAPACITY + drive) * h / OPEN
    seen = []
    for start in np.linspace(0.01, 0.99, 12):
        slip = -low * start * 1.001
        system = with_coulomb(fmus, CAPACITY, slip, 1e-6, engine_torque=engine, **TORQUE)
        seen.append(chatter(system, "gauss-seidel", h))
    slips = np.concatenate(seen)
    assert 1.001 * low < slips.min() < (1.0 - WITHIN) * low
    assert (1.0 - WITHIN) * high < slips.max() < 1.001 * high
    false_heat = 0.5 * OPEN * slips.max() ** 2
    assert false_heat == pytest.approx((CAPACITY + drive) ** 2 * h**2 / (2.0 * OPEN), rel=0.04)


@pytest.mark.parametrize("judge, kappa", [(dies_out, 2.0), (keeps_its_side, 1.0)])
def test_smoothed_coulomb_friction_sets_the_step_by_its_width(judge, kappa, fmus):
    """T_k tanh(w/w_0) has the slope T_k/w_0 at rest."""
    width, expected = 0.5, kappa * OPEN * 0.5 / CAPACITY
    system = with_coulomb(fmus, CAPACITY, 1e-3 * width, width, engine_torque=0.0, **TORQUE)
    found = last_step(
        lambda h: judge(march(system, "gauss-seidel", h, 120)["transmission.clutch_speed"]),
        0.5 * expected,
        2.0 * expected,
    )
    assert found / expected == pytest.approx(1.0, abs=WITHIN)


def test_linearly_implicit_stops_a_fast_slip_on_a_steep_flank_without_chatter(fmus):
    """A step forty times the limit: the tangent out on the saturated branch knows no flank."""
    width, drive = 0.01, 0.3 * CAPACITY
    h = 40.0 * 2.0 * OPEN * width / CAPACITY
    engine = ENGINE * drive / DRIVE
    system = with_coulomb(fmus, CAPACITY, 10.0, width, engine_torque=engine, **TORQUE)
    slip = march(system, "linearly-implicit", h, 60)["transmission.clutch_speed"]
    assert keeps_its_side(slip)
    assert slip[-1] == pytest.approx(width * np.arctanh(drive / CAPACITY), rel=1e-3)
    explicit = march(system, "gauss-seidel", h, 60)["transmission.clutch_speed"]
    assert np.count_nonzero(np.diff(np.sign(explicit))) > 20


@pytest.mark.parametrize("share", [0.05, 0.3, 0.6, 0.95])
def test_a_lock_up_seen_at_points_only_is_late_by_up_to_a_step(share, fmus):
    """Time within H, speed within (T_k + T_x) H/J; in capacity coupling it is located."""
    drive, h, steps = 0.3 * CAPACITY, 1e-3, 10
    engine = ENGINE * drive / DRIVE
    rate = (CAPACITY - drive) / OPEN
    slip = rate * h * (steps - share)
    exact = slip / rate
    late = with_coulomb(fmus, CAPACITY, slip, 1e-6, engine_torque=engine, **TORQUE)
    slips = march(late, "gauss-seidel", h, 20)["transmission.clutch_speed"]
    first = int(np.argmax(slips < 0.0))
    assert first * h - exact == pytest.approx(share * h, rel=1e-2)
    assert np.abs(slips[first:]).max() <= 1.001 * (CAPACITY + drive) * h / OPEN
    located = with_coulomb(fmus, CAPACITY, slip, 1e-6, engine_torque=engine)
    found = march(located, "gauss-seidel", h, 20)
    assert found["transmission.lock_time"][-1] == pytest.approx(exact, rel=1e-9)
    assert (found["transmission.clutch_speed"][first:] == 0.0).all()


# A body with a spring and a damper.

MASS, SPRING = 2.0, 800.0


def vibrates(fmus, damper, master, h, n=200):
    body = {"inertia": MASS, "start_speed": 0.0, "start_position": 1.0}
    system = body_and_law(fmus, body, {"stiffness": SPRING, "slope": damper})
    found = march(system, master, h, n)
    # as an energy, so that windows of an oscillation can be compared
    return np.hypot(found["body.position"], found["body.speed"] * np.sqrt(MASS / SPRING))


def least_damper(fmus, master, h, low, high):
    return last_step(lambda c: not dies_out(vibrates(fmus, c, master, h)), low, high)


def largest_damper(fmus, master, h, low, high):
    return last_step(lambda c: dies_out(vibrates(fmus, c, master, h)), low, high)


def test_a_held_spring_needs_a_damper_within_a_window(fmus):
    """k H/2 < c < 2 m/H."""
    h = 0.5 * np.sqrt(MASS / SPRING)
    low, high = 0.5 * SPRING * h, 2.0 * MASS / h
    assert least_damper(fmus, "gauss-seidel", h, 0.5 * low, 2.0 * low) / low == pytest.approx(
        1.0, abs=WITHIN
    )
    assert largest_damper(fmus, "gauss-seidel", h, 0.5 * high, 2.0 * high) / high == pytest.approx(
        1.0, abs=WITHIN
    )


def late_window(h):
    """Return the minimum and the maximum damper of a force one step late.

    z^3 - 2 z^2 + (1 + a + b/2) z - (a - b/2) = 0 with a = c H/m, b = k H^2/m has its roots inside
    the unit circle for a - (a - b/2)^2 > 3 b/2.
    """
    b = SPRING * h * h / MASS
    half = np.sqrt((1.0 + b) ** 2 - b * b - 6.0 * b)
    return [0.5 * (1.0 + b + side * half) * MASS / h for side in (-1.0, 1.0)]


def test_a_late_spring_needs_three_times_the_damper(fmus):
    """c > 1.5 k H and c < m/H where H is small compared with the period."""
    h = 0.1 * np.sqrt(MASS / SPRING)
    low, high = late_window(h)
    assert low == pytest.approx(1.5 * SPRING * h, rel=0.03)
    assert high == pytest.approx(MASS / h, rel=0.03)
    assert least_damper(fmus, "jacobi", h, 0.5 * low, 2.0 * low) / low == pytest.approx(
        1.0, abs=WITHIN
    )
    assert largest_damper(fmus, "jacobi", h, 0.5 * high, 2.0 * high) / high == pytest.approx(
        1.0, abs=WITHIN
    )


@pytest.mark.parametrize("share", [0.01, 0.1, 0.5])
def test_an_undamped_held_spring_gains_energy_at_every_step(share, fmus):
    """Per step the amplitude grows by sqrt(1 + k H^2/(2 m))."""
    h = share * np.sqrt(MASS / SPRING)
    n = round(8.0 * np.pi / share)
    found = vibrates(fmus, 0.0, "gauss-seidel", h, n)
    growth = np.polyfit(np.arange(n + 1), np.log(found), 1)[0]
    assert growth == pytest.approx(0.5 * np.log1p(0.5 * share**2), rel=WITHIN)


def test_linearly_implicit_damps_a_stiff_damper_but_no_spring_of_its_own(fmus):
    """Above 2 m/H the held damper is unstable."""
    h = 0.2 * np.sqrt(MASS / SPRING)
    damper = 20.0 * MASS / h
    assert dies_out(vibrates(fmus, damper, "linearly-implicit", h))
    assert not dies_out(vibrates(fmus, damper, "gauss-seidel", h, 40))


# A body that heats up: speed is its temperature.

CONDUCTANCE, CAPACITANCE = 5.0, 100.0


def warms(fmus, rise, h, n=80):
    body = {"inertia": CAPACITANCE, "leak": CONDUCTANCE, "start_speed": 1.0}
    system = body_and_law(fmus, body, {"slope": -rise})
    return march(system, "gauss-seidel", h, n)["body.speed"]


@pytest.mark.parametrize("share", [0.2, 1.0, 4.0])
def test_a_held_heat_flow_may_rise_by_the_conductance_and_fall_by_more(share, fmus):
    """-G coth(G H/(2 C)) < dq/dT < G, whatever the step of an exactly integrated body."""
    h = share * CAPACITANCE / CONDUCTANCE
    most = CONDUCTANCE
    least = CONDUCTANCE / np.tanh(0.5 * share)
    rise = last_step(lambda q: dies_out(warms(fmus, q, h)), 0.5 * most, 2.0 * most)
    fall = last_step(lambda q: dies_out(warms(fmus, -q, h)), 0.5 * least, 2.0 * least)
    assert rise / most == pytest.approx(1.0, abs=WITHIN)
    assert fall / least == pytest.approx(1.0, abs=WITHIN)
