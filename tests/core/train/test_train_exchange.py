"""The gear train in model exchange: the train of co-simulation in sliding; rest, slopes, heat."""

import numpy as np
import pytest
from exchange_runs import Kernels

from thrustwasher.model.registry import find_spec

SPEC = find_spec("train")
POINT = {"torque": 150.0, "speed": 300.0, "oil_temperature": 330.0}
TRAINS = ({}, {"meshes": 1}, {"thermal_mode": "quasi_steady"}, {"meshes": 3})
each_train = pytest.mark.parametrize("changes", TRAINS, ids=str)
POWERS = ("mesh_loss", "bearing_loss", "seal_loss", "churning_loss")


@each_train
@pytest.mark.parametrize("side", [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0)])
def test_at_the_start_it_is_the_train_of_co_simulation(changes, side):
    """Driven from either end, in either sense, far from the speeds near rest."""
    k = Kernels(SPEC, **changes)
    k.start(**POINT | {"torque": side[0] * 150.0, "speed": side[1] * 300.0})
    assert k.rates() == 0
    stepped = k.stepped()
    for name in SPEC.real_outputs:
        assert k.out(name) == pytest.approx(stepped[name], rel=1e-9, abs=1e-12), name
    assert k.iout.tolist() == stepped["iout"]


@pytest.mark.parametrize("changes", [TRAINS[0], pytest.param(TRAINS[3], marks=pytest.mark.slow)])
def test_slopes_are_those_of_the_values(changes):
    k, rng = Kernels(SPEC, **changes), np.random.default_rng(7)
    k.start(**POINT)
    sizes, n = np.array([150.0, 300.0, 300.0, 300.0, 300.0, 300.0, 3.5e-5, 1e3]), k.k.NINP

    def values(at):
        k.inp[:], k.cont[:] = at[:n], at[n:]
        assert k.rates() == 0
        return np.concatenate([k.outputs, k.der])

    for _ in range(3):
        k.put(torque=rng.choice([-1, 1]) * rng.uniform(60.0, 200.0))
        k.put(speed=rng.choice([-1, 1]) * rng.uniform(50.0, 400.0))
        k.cont[:3], k.cont[3] = rng.uniform(331.0, 380.0, 3), rng.normal(0.0, 2e-4)
        point = np.concatenate([k.inp, k.cont])
        for i, size in enumerate(sizes):
            e = np.eye(len(sizes))[i]
            rough, fine = (
                (values(point + h * e) - values(point - h * e)) / (2.0 * h)
                for h in (2e-4 * size, 1e-4 * size)
            )
            expected, here = (4.0 * fine - rough) / 3.0, np.abs(values(point))
            room = here / size + np.abs(expected).max() * 1e-3
            error = np.abs(k.slopes(e) - expected)
            assert np.all(error <= 1e-6 * np.abs(expected) + 1e-8 * room), i


def test_heat_is_the_work_that_is_not_stored_and_never_below_zero():
    """At any bending: what the shafts lose is what the sources give, at most the capacity."""
    k, rng = Kernels(SPEC), np.random.default_rng(8)
    k.start(**POINT)
    for _ in range(100):
        speed = rng.normal() * 10.0 ** rng.uniform(-5, 2)
        k.put(torque=rng.normal() * 10.0 ** rng.uniform(-1, 2.5), speed=speed)
        k.cont[3] = rng.normal() * 10.0 ** rng.uniform(-7, -2.5)
        assert k.rates() == 0
        stiffness, torque = k.discrete[1] / k.own[0], k.out("loss_torque")
        heat = torque * speed - stiffness * k.cont[3] * k.der[3]
        assert k.out("loss") == pytest.approx(max(heat, 0.0), rel=1e-6, abs=1e-9)
        assert sum(k.out(n) for n in POWERS) == pytest.approx(k.out("loss"), rel=1e-9, abs=1e-12)
        given = k.inp[0] * speed - k.out("output_torque") * k.out("output_speed")
        assert given == pytest.approx(torque * speed, rel=1e-6, abs=1e-9)


def test_a_bent_train_holds_either_way_and_gives_the_same_bits_again():
    k = Kernels(SPEC)
    k.start(**POINT | {"speed": 0.0})
    k.cont[3] = 3e-4
    assert k.rates() == 0
    first = k.outputs.tobytes() + k.der.tobytes()
    torque = k.out("loss_torque")
    k.cont[3] = -3e-4
    assert k.rates() == 0
    assert torque > 0.0 > k.out("loss_torque")
    k.cont[3] = 3e-4
    assert k.rates() == 0
    assert k.outputs.tobytes() + k.der.tobytes() == first
