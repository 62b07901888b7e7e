"""The transmission's derivatives over its inputs: against differences, in every pair of modes."""

import numpy as np
import pytest

from thrustwasher.model.parameters import as_numbers
from thrustwasher.transmission.bearings import BEARINGS, SHAFT
from thrustwasher.transmission.kernels import layout as L
from thrustwasher.transmission.kernels import step as k
from thrustwasher.transmission.parameters import ACTUATION, COUPLING, SPEC, TransmissionParams

from slopes import Unit, disagreement  # isort: skip

NAMES = [s.name for s in SPEC.outputs if s.kind == "real"]


BESIDE = (1e5, 2e5, 0.0, 0.0, 0.05, 3.0, 0.5, -2.0, 0.1)  # pressures, torques; losses


def gearbox(**params):
    par = np.zeros(k.NPAR)
    par[: k.N_PARAM] = [*as_numbers(TransmissionParams(**{"ring_mesh": True} | params)), 1.0]
    assert k.derive(par) == 0
    return Unit(k, par)


def random_bearings(rng):
    found = {}
    for name in BEARINGS:
        one, other = rng.choice(list(SHAFT), 2, replace=False)
        found |= {f"{name}_shaft_1": str(one), f"{name}_shaft_2": str(other)}
        found[f"{name}_coefficient"] = float(rng.choice([0.0, 0.004, 0.05]))
    return found


def random_box(rng):
    return gearbox(
        **random_bearings(rng),
        coupling=str(rng.choice(list(COUPLING))),
        capacity_extrapolation=bool(rng.integers(2)),
        torque_age=int(rng.integers(3)),
        drum_inertia=float(rng.choice([0.0, 0.01, 0.3])),
        initial_engine_speed=float(rng.choice([0.0, 350.0, -100.0])),
        initial_drum_speed=float(rng.choice([0.0, 100.0, -50.0])),
        helix_angle=float(rng.choice([0.0, 0.35])),
        actuation=str(rng.choice(list(ACTUATION))),
        brake_pressure_lag=float(rng.choice([0.0, 0.1])),
        shaft_stiffness=float(rng.choice([0.0, 0.0, 0.0, 1e4])),
    )


def random_point(rng):
    """Return torques weak and strong, none of them 0, and a command."""
    packs = 10.0 ** rng.uniform(0.0, 3.5, 2) * rng.choice([1.0, 1.0, 1.0, -1.0], 2)
    drag = 10.0 ** rng.uniform(-3.0, 0.5, 2) * rng.choice([-1.0, 1.0], 2)
    pressures, outside = rng.uniform(4e4, 1e6, 2), rng.uniform(-200.0, 200.0, 2)
    lost = 10.0 ** rng.uniform(-1.0, 1.0, 4) * rng.choice([-1.0, 1.0], 4)
    command, ring = rng.uniform(0.1, 0.9), 0.3 * drag[1]
    return np.array([*packs, *drag, command, *pressures, *outside, ring, *lost])


def modes(unit):
    return unit.work[L.W_CLUTCH_MODE], unit.work[L.W_BRAKE_MODE]


@pytest.mark.parametrize("seed", range(6))
def test_derivatives_are_those_of_differences_wherever_a_shift_may_be(seed):
    rng = np.random.default_rng(seed)
    for _ in range(20):
        unit = random_box(rng)
        for _ in range(int(rng.integers(0, 4))):
            held = random_point(rng)
            for i in range(int(rng.integers(1, 30))):
                unit.step(held, t=1e-2 * i, dt=1e-2)
        point = random_point(rng)
        assert disagreement(unit, point, 0.1 * np.abs(point)).max() < 1e-6


def stuck_box(clutch, brake):
    """Return a gearbox at rest or turning, and a point where the packs named stick."""
    start = {} if brake else {"initial_drum_speed": 350.0}
    if clutch and brake:
        start["initial_engine_speed"] = 0.0
    unit = gearbox(**start)
    return unit, np.array(
        [900.0 if clutch else 30.0, 900.0 if brake else 30.0, 0.05, -0.2, 0.5, *BESIDE]
    )


@pytest.mark.parametrize(("clutch", "brake"), [(1, 0), (0, 1), (1, 1)])
def test_derivatives_hold_where_packs_stick(clutch, brake):
    unit, point = stuck_box(clutch, brake)
    found = unit.gradient(point)
    assert [m == 0.0 for m in modes(unit)] == [bool(clutch), bool(brake)]
    assert disagreement(unit, point, 0.1 * point).max() < 1e-6
    held = [NAMES.index("clutch_reaction"), NAMES.index("brake_reaction")]
    for pack, sticks in enumerate((clutch, brake)):
        if sticks:  # more capacity changes nothing
            assert (found[held, pack] == 0.0).all()
        else:
            assert abs(found[held[pack], pack]) == 1.0


def helped_box():
    """Return a gearbox and a point where the planets' drag helps the clutch to stick."""
    unit = gearbox(initial_drum_speed=350.0)
    wanted = unit.step([900.0, 30.0, 2.0, 5.0, 0.5, *BESIDE])[NAMES.index("clutch_reaction")]
    return unit, np.array([wanted - 1.0, 30.0, 2.0, 5.0, 0.5, *BESIDE])


def test_drag_that_helps_a_stuck_clutch_leaves_it_its_capacity():
    unit, point = helped_box()
    found = unit.gradient(point)
    assert modes(unit)[0] == 0.0
    assert unit.out[NAMES.index("clutch_reaction")] == point[0]
    assert found[NAMES.index("clutch_reaction")].tolist() == [1.0] + [0.0] * 13
    assert disagreement(unit, point, 0.01 * point).max() < 1e-6


def test_a_corner_counts_as_flat():
    """Without drag or capacity the size of a torque may only grow: no slope is given there."""
    found = gearbox(initial_drum_speed=40.0).gradient([0.0, 0.0, 0.0, 0.0, 0.5, *BESIDE])
    assert (found[:, :4] == 0.0).all() and found[NAMES.index("clutch_load"), 4] == 5898.0


def test_older_torques_look_further_ahead():
    """Extrapolated by their age, changed capacities count 1 + age times."""
    for age in (0, 1, 2):
        unit = gearbox(initial_drum_speed=40.0, torque_age=age)
        unit.step([50.0, 40.0, 0.0, 0.0, 0.5, *BESIDE], dt=1e-3)
        found = unit.gradient([60.0, 45.0, 0.0, 0.0, 0.5, *BESIDE])
        assert abs(found[NAMES.index("clutch_reaction"), 0]) == 1.0 + age


@pytest.mark.parametrize("end_play", [3e-4, 1e-5])
def test_derivatives_of_a_planet_on_needles(end_play):
    """Free to tilt, and with washers that bear; slices that come to bear bend the curve."""
    unit = gearbox(needle_count=18, end_play=end_play, coupling="torque")
    rng = np.random.default_rng(4)
    for _ in range(20):
        point = random_point(rng)
        assert disagreement(unit, point, 0.01 * np.abs(point)).max() < 1e-3
