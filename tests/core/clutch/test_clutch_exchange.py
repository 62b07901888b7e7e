"""The wet clutch in model exchange: torque, heat, film of co-simulation; rest, lock, slopes."""

import numpy as np
import pytest
from exchange_runs import Kernels

from thrustwasher.model.registry import find_spec

SPEC = find_spec("clutch")
POINT = {"load": 4000.0, "speed": 80.0, "oil_temperature": 330.0, "drum_speed": 100.0}
LEVELS = ("closed", "stribeck", "field", "fine")
SAME = (
    "torque_capacity friction_coefficient film_ratio viscosity viscous_torque contact_share".split()
)


@pytest.mark.parametrize("level", LEVELS)
def test_at_the_start_it_is_the_pack_of_co_simulation(level):
    k = Kernels(SPEC, level, starts_pressed=True)
    k.start(**POINT)
    assert k.rates() == 0
    stepped = k.stepped()
    for name in (*SAME, "friction_torque", "friction_power", "temperature"):
        assert k.out(name) == pytest.approx(stepped[name], rel=1e-9, abs=1e-12), name
    assert k.iout[0] == stepped["iout"][0]


@pytest.mark.parametrize("level", LEVELS)
def test_heat_goes_into_steel_and_oil(level):
    k = Kernels(SPEC, level, starts_pressed=True)
    k.start(**POINT)
    k.cont[3:] += np.array([20.0, 30.0, 40.0, 50.0])
    assert k.rates() == 0
    steel = k.der[3:] @ np.array([1.0, 1.0, 1.0, 1.0] if level == "fine" else [1.0, 0, 0, 0])
    stored = k.out("stored_heat")
    assert steel != 0.0 and stored > 0.0
    h = 1e-6
    k.cont += h * k.der
    oil, power, before = k.out("oil_heat"), k.out("friction_power"), k.out("oil_energy")
    k.rates()
    assert (k.out("stored_heat") - stored) / h == pytest.approx(power - oil, rel=1e-4)
    assert (k.out("oil_energy") - before) / h == pytest.approx(oil, rel=1e-3, abs=1.0)


@pytest.mark.parametrize("level", LEVELS)
def test_slopes_are_those_of_the_values(level):
    k, rng = Kernels(SPEC, level, starts_pressed=True), np.random.default_rng(5)
    k.start(**POINT)
    n = k.k.NINP
    for _ in range(6):
        k.put(**{name: x * rng.uniform(0.7, 1.2) for name, x in POINT.items()})
        k.put(oil_temperature=rng.uniform(300.0, 360.0))
        k.cont[0] = rng.uniform(0.5, 2.5)
        k.cont[1] = rng.normal(0.0, 3e-4)
        k.cont[3:] = rng.uniform(310.0, 400.0, 4)
        point = np.concatenate([k.inp, k.cont])
        sizes = np.array([4e3, 80.0, 300.0, 100.0, 1.0, 3e-5, 1e3, 300.0, 300.0, 300.0, 300.0])

        def values(at):
            k.inp[:], k.cont[:] = at[:n], at[n:]
            assert k.rates() == 0
            return np.concatenate([k.outputs, k.der])

        for place, size in enumerate(sizes):
            one = np.eye(len(point))[place]
            rough, fine = (
                (values(point + h * one) - values(point - h * one)) / (2.0 * h)
                for h in (2e-4 * size, 1e-4 * size)
            )
            expected = (4.0 * fine - rough) / 3.0
            k.inp[:], k.cont[:] = point[:n], point[n:]
            found = k.slopes(one)
            scale = np.abs(values(point)) / size
            assert np.all(np.abs(found - expected) <= 1e-5 * np.abs(expected) + 1e-7 * scale), place


def engaged(level, **own):
    """Two inertias and a pack, pressed within 0.1 s: Radau over the model's own rates."""
    k = Kernels(SPEC, level, starts_pressed=True, own=own)
    first, second, drive = 0.15, 1.0, 60.0
    k.start(load=100.0, speed=100.0, oil_temperature=330.0)

    def rates(t, y):
        k.put(load=min(100.0 + 5e4 * t, 5e3), speed=y[0] - y[1])
        k.cont[:] = y[2:]
        assert k.rates() == 0
        torque = k.out("friction_torque")
        return [(drive - torque) / first, torque / second, *k.der]

    run = k.solved(rates, [100.0, 0.0, *k.cont], 1.0, method="LSODA", rtol=1e-7, atol=1e-9)
    return k, run


@pytest.mark.parametrize("level", ["stribeck", "field"])
def test_a_pack_locks_holds_and_its_heat_is_the_energy_lost(level):
    k, run = engaged(level)
    slip = run.y[0] - run.y[1]
    assert abs(slip[-1]) < 1e-3
    held = 60.0 / 0.15 / (1 / 0.15 + 1.0)
    assert k.out("friction_torque") == pytest.approx(held, rel=1e-3)
    kinetic = 0.5 * (0.15 * (run.y[0] ** 2 - 1e4) + 1.0 * run.y[1] ** 2)
    work = np.sum(60.0 * 0.5 * (run.y[0][1:] + run.y[0][:-1]) * np.diff(run.t))
    assert run.y[4, -1] == pytest.approx(work - kinetic[-1], rel=2e-3)
    k.update(1.0)
    assert k.iout[2] == 0  # held, but for how long?
    assert k.discrete[0] == pytest.approx(1.005)
    k.update(k.discrete[0])
    assert k.iout[2] == 1


def test_it_lets_go_where_the_capacity_is_gone():
    k, _ = engaged("stribeck")
    k.update(1.0), k.update(1.005)
    k.put(load=0.0)
    k.rates()
    assert k.sign[0] < 0.0
    k.update(1.2)
    assert k.iout[2] == 0 and k.outputs[0] == pytest.approx(0.0, abs=1e-9)
