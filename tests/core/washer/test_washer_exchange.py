"""The washer in model exchange: that of co-simulation in sliding; branches, rest, slopes."""

import numpy as np
import pytest
from exchange_runs import Kernels

from thrustwasher.model.registry import find_spec
from thrustwasher.numerics.status import NOT_IN_MAP, OK, SINGULAR
from thrustwasher.washer.map.look_up import WasherMap

SPEC = find_spec("washer")
FILM, CONTACT = {"load": 300.0, "speed": 545.0}, {"load": 1200.0, "speed": 545.0}
LOST, REGAINED = 958.0, 659.0  # N, at 545 rad/s
each_level = pytest.mark.parametrize("level", ["map", "field"])


def washer(level="field", own=None, **parameters):
    k = Kernels(SPEC, level, own, **parameters)
    if level == "map":
        data = WasherMap(SPEC.params(**parameters)).data
        k.work[k.step.TABLE_AT : k.step.TABLE_AT + len(data)] = data
    return k


def finish(k):
    assert k.k.finish(*k._given(), 0.0) == OK


def loaded(k, *loads):
    """Go through loads in completed steps; return torques and indicators of the branch."""
    found = []
    for load in loads:
        k.put(load=load)
        assert k.rates() == OK
        found.append((k.out("friction_torque"), float(k.sign[0])))
        finish(k)
    return np.array(found).T


@each_level
@pytest.mark.parametrize("point", [FILM, CONTACT, FILM | {"speed": -300.0, "tilt": 0.001}])
def test_at_the_start_it_is_the_washer_of_co_simulation(level, point):
    k = washer(level)
    k.start(**point)
    assert k.rates() == OK
    state, out, iout = np.zeros(k.step.NSTATE), np.zeros(k.k.NOUT), np.zeros(k.k.NIOUT, np.int32)
    assert k.step.step(k.par, k.inp, state, k.work, out, iout, 0.0, 0.0) == OK
    stepped = dict(zip(SPEC.real_outputs, out, strict=True))
    for name in SPEC.real_outputs:
        assert k.out(name) == pytest.approx(stepped[name], rel=2e-5, abs=1e-12), name
    assert k.iout.tolist() == iout.tolist()


@each_level
def test_what_is_tried_leaves_no_trace(level):
    """Same bits after other points, and by another instance that has been elsewhere."""
    k, other = washer(level), washer(level)
    for u in (k, other):
        u.start(**FILM)
        loaded(u, 320.0, 340.0)
    assert k.rates() == OK
    first = k.outputs.tobytes() + k.der.tobytes() + k.sign.tobytes()
    for point in (CONTACT, {"load": 50.0, "speed": -20.0}, {"load": 345.0, "speed": 545.0}):
        other.put(**point)
        assert other.rates() == OK
    other.put(load=340.0, speed=545.0)
    assert other.rates() == OK
    assert other.outputs.tobytes() + other.der.tobytes() + other.sign.tobytes() == first


@each_level
def test_a_film_is_lost_at_an_event_and_regained_at_a_lower_load(level):
    """Beyond the fold the washer stays there, with the indicator below 0, until the event."""
    k = washer(level)
    k.start(**FILM)
    torques, rooms = loaded(k, 800.0, 940.0, 1.01 * LOST, 1100.0)
    assert (rooms[:2] > 0.0).all() and (rooms[2:] < 0.0).all()
    assert torques[3] == pytest.approx(torques[2], rel=1e-6)
    assert k.update(0.0) == OK and k.iout[1] == 1
    torques, rooms = loaded(k, 1100.0, 940.0, 1.02 * REGAINED, 0.96 * REGAINED, 500.0)
    assert (rooms[:3] > 0.0).all() and (rooms[3:] < 0.0).all() and torques[0] > 1.0
    assert torques[4] == pytest.approx(torques[3], rel=1e-4)
    assert k.update(0.0) == OK and k.iout[1] == 0
    assert k.rates() == OK and k.out("friction_torque") < 0.3 and k.sign[0] > 0.0


@each_level
@pytest.mark.parametrize("load", [1000.0, 1300.0, 1800.0])
def test_a_load_far_beyond_the_fold_is_answered_by_the_fold(level, load):
    """From a thick film, as a solver's trial step may ask it."""
    k = washer(level)
    k.start(**FILM)
    loaded(k, 0.999 * LOST, 1.001 * LOST)
    k.put(load=1.001 * LOST)
    k.rates()
    at_fold = k.out("friction_torque")
    far = washer(level)
    far.start(**FILM)
    far.put(load=load)
    assert far.rates() == OK and far.sign[0] < 0.0
    assert far.out("friction_torque") == pytest.approx(at_fold, rel=1e-4)
    along = np.eye(far.k.NINP + far.k.NCONT)[0]
    found = np.zeros(far.k.NOUT + far.k.NCONT)
    assert far.k.slopes(*far._given(), along, found) == SINGULAR


@each_level
@pytest.mark.parametrize("point", [FILM, CONTACT, {"load": 200.0, "speed": 2.0}])
def test_slopes_are_those_of_the_values(level, point):
    k = washer(level)
    k.start(**point)
    k.cont[0] = 5e-5
    finish(k)
    sizes, n = np.array([300.0, 500.0, 2e-3, 300.0, 1.0, 3.5e-5, 1e2]), k.k.NINP
    if level == "field":
        sizes[:4] = point["load"], point["speed"], 2e-3, 300.0
    at, unit = np.concatenate([k.inp, k.cont]), np.eye(n + k.k.NCONT)

    def values(point):
        k.inp[:], k.cont[:] = point[:n], point[n:]
        assert k.rates() == OK
        return np.concatenate([k.outputs, k.der])

    here = np.abs(values(at))
    for i in (0, 1, 2, 3, 5, 6):
        e, h = unit[i], 1e-4 * sizes[i]
        rough, fine = ((values(at + x * e) - values(at - x * e)) / (2.0 * x) for x in (2.0 * h, h))
        expected = (4.0 * fine - rough) / 3.0
        values(at)
        found = k.slopes(e)
        room = here / sizes[i] + np.abs(expected).max() * 1e-3
        assert np.all(np.abs(found - expected) <= 3e-6 * np.abs(expected) + 1e-7 * room), i


def test_it_is_passive_and_never_above_its_capacity():
    """At any bending, load and speed."""
    k, rng = washer("map"), np.random.default_rng(8)
    k.start(**FILM)
    for _ in range(400):
        speed = rng.normal() * 10.0 ** rng.uniform(-6, 2.5)
        k.put(load=abs(rng.normal()) * 10.0 ** rng.uniform(-3, 3), speed=speed)
        k.cont[0] = rng.normal() * 10.0 ** rng.uniform(-8, -3)
        assert k.rates() == OK
        sliding = abs(float(k.work[k.k.L.AT_OUTPUTS + k.k.L.O_TORQUE]))
        assert k.out("friction_power") >= 0.0
        assert abs(k.out("friction_torque")) <= sliding * (1.0 + 1e-12)
        assert k.out("throughflow_heat") <= k.out("oil_heat") * (1.0 + 1e-9)


def test_friction_goes_on_through_rest():
    """The capacity is the same on both sides of rest, and changes evenly."""
    k = washer()
    k.start(load=300.0, speed=1.0)
    capacities = []
    for speed in (0.1, 1e-3, 0.0, -1e-3, -0.1):
        k.put(speed=speed)
        assert k.rates() == OK
        capacities.append(abs(float(k.work[k.k.L.AT_OUTPUTS + k.k.L.O_TORQUE])))
        finish(k)
    assert capacities[:2] == pytest.approx(capacities[:2:-1], rel=1e-7)
    assert np.ptp(capacities[1:4]) < 1e-4 * capacities[2]


def test_outside_of_a_map_it_says_so():
    k = washer("map", outside_map="refuse")
    k.start(**FILM)
    k.put(load=1e5)
    assert k.rates() == NOT_IN_MAP
