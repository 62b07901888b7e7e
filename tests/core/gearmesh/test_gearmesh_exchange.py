"""The gear mesh in model exchange: the mesh of co-simulation in sliding; bodies, rest, slopes."""

import numpy as np
import pytest
from exchange_runs import Kernels

from thrustwasher.model.registry import find_spec

SPEC = find_spec("gearmesh")
POINT = {"load": 60.0, "speed": 150.0, "oil_temperature": 330.0}
PAIRS = (
    {},
    {"film_heat": "atan"},
    {"thermal_mode": "quasi_steady"},
    {"friction_law": "mixed"},
    {"load_sharing": "elastic"},
)
each_pair = pytest.mark.parametrize("changes", PAIRS, ids=lambda c: str(*c.values()) or "default")


@each_pair
@pytest.mark.parametrize("speed", [150.0, -40.0])
def test_at_the_start_it_is_the_mesh_of_co_simulation(changes, speed):
    """Far from the speeds over which co-simulation lets the torque pass through zero."""
    k = Kernels(SPEC, **changes)
    k.start(**POINT | {"speed": speed})
    assert k.rates() == 0
    stepped = k.stepped()
    for name in SPEC.real_outputs:
        assert k.out(name) == pytest.approx(stepped[name], rel=1e-9, abs=1e-12), name
    assert k.iout.tolist() == stepped["iout"]


@each_pair
def test_heat_goes_into_bodies_and_oil(changes):
    k = Kernels(SPEC, **changes)
    k.start(**POINT)
    k.cont[0] += 10.0
    k.rates()
    h, power, oil = 1e-5, k.out("friction_power"), k.out("oil_heat")
    before = k.out("stored_heat"), k.out("oil_energy")
    k.cont += h * k.der
    k.rates()
    stored, given = k.out("stored_heat") - before[0], k.out("oil_energy") - before[1]
    assert given / h == pytest.approx(oil, rel=1e-4)
    assert (stored + given) / h == pytest.approx(power, rel=1e-4, abs=1e-4)


@each_pair
def test_slopes_are_those_of_the_values(changes):
    k, rng = Kernels(SPEC, **changes), np.random.default_rng(7)
    k.start(**POINT)
    sizes, n = np.array([40.0, 180.0, 300.0, 300.0, 3.5e-5, 1e3]), k.k.NINP

    def values(at):
        k.inp[:], k.cont[:] = at[:n], at[n:]
        assert k.rates() == 0
        return np.concatenate([k.outputs, k.der])

    for _ in range(4):
        k.put(load=rng.uniform(20.0, 90.0), speed=rng.choice([-1, 1]) * rng.uniform(20.0, 200.0))
        k.cont[0], k.cont[1] = rng.uniform(331.0, 380.0), rng.normal(0.0, 2e-5)
        point = np.concatenate([k.inp, k.cont])
        for i, size in enumerate(sizes):
            e = np.eye(len(sizes))[i]
            rough, fine = (
                (values(point + h * e) - values(point - h * e)) / (2.0 * h)
                for h in (2e-4 * size, 1e-4 * size)
            )
            expected, here = (4.0 * fine - rough) / 3.0, np.abs(values(point))
            found = k.slopes(e)
            room = here / size + np.abs(expected).max() * 1e-3
            assert np.all(np.abs(found - expected) <= 1e-6 * np.abs(expected) + 1e-8 * room), i


def test_it_is_passive_and_never_above_its_capacity():
    """At any bending and load: heat is not negative, and the torque at most that of sliding."""
    k, rng = Kernels(SPEC), np.random.default_rng(8)
    k.start(**POINT)
    for _ in range(400):
        speed = rng.normal() * 10.0 ** rng.uniform(-6, 2)
        k.put(load=abs(rng.normal()) * 10.0 ** rng.uniform(-3, 4), speed=speed)
        k.cont[1] = rng.normal() * 10.0 ** rng.uniform(-8, -3)
        assert k.rates() == 0
        most = abs(k.work[0])  # of sliding
        assert k.out("friction_power") >= 0.0
        assert abs(k.out("friction_torque")) <= most * (1.0 + 1e-12)


def test_without_load_nothing_is_held():
    k = Kernels(SPEC)
    k.start(load=0.0, speed=1.0, oil_temperature=330.0)
    k.cont[1] = 1e-5
    assert k.rates() == 0
    assert k.out("friction_torque") == 0.0 and k.der[1] < 0.0


def test_a_bristle_that_is_given_its_capacity_bends_by_its_angle():
    own = {"largest_capacity": 2.0, "rest_angle": 1e-3}
    k = Kernels(SPEC, own=own)
    k.start(**POINT)
    k.cont[1] = 1e-4
    k.rates()
    k.slopes([0.0, 0.0, 0.0, 0.0, 1.0, 0.0])
    assert k.discrete[1] == 2.0
    found = Kernels(SPEC)
    found.start(**POINT)
    assert 0.0 < found.discrete[1] < 100.0
