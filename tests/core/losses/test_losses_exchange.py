"""The driveline losses in model exchange: those of co-simulation in sliding, rest, heat."""

import numpy as np
import pytest
from exchange_runs import Kernels

from thrustwasher.model.registry import find_spec

SPEC = find_spec("losses")
SLIDING = {
    "input_speed": 300.0,
    "output_speed": -90.0,
    "drum_speed": 150.0,
    "planet_speed": 400.0,
    "tooth_force": 1500.0,
    "oil_temperature": 340.0,
}


def test_in_sliding_they_are_those_of_co_simulation():
    """Far from the speeds over which co-simulation lets torques pass through zero."""
    k = Kernels(SPEC)
    k.start(**SLIDING)
    assert k.rates() == 0
    stepped = k.stepped()
    for name in SPEC.real_outputs:
        if name != "oil_energy":
            assert k.out(name) == pytest.approx(stepped[name], rel=1e-9, abs=1e-9), name
    assert np.abs(k.der[:4]).max() < 1e-6
    assert k.update(0.0) == 0 and k.iout.tolist() == stepped["iout"]


def test_the_heat_is_the_sum_of_the_powers_and_never_falls():
    k, rng = Kernels(SPEC), np.random.default_rng(3)
    k.start(**SLIDING)
    for _ in range(300):
        k.put(**{n: SLIDING[n] * rng.normal() for n in SLIDING if n != "oil_temperature"})
        k.cont[:4] = rng.normal(0.0, 3e-4, 4)
        assert k.rates() == 0
        powers = [k.out(n) for n in ("bearing_power", "churning_power", "pump_power", "seal_power")]
        assert min(powers) >= 0.0
        assert k.out("oil_heat") == pytest.approx(sum(powers))


def test_a_shaft_is_held_at_rest_below_its_losses():
    """A load of a third of the breakaway torque bends the bristle and moves nothing else."""
    k = Kernels(SPEC)
    k.start(**{n: 0.0 for n in SLIDING if n != "oil_temperature"}, oil_temperature=340.0)
    k.cont[0] = 1.0
    k.rates()
    most = k.out("input_torque")
    k.cont[0] = 0.0

    def rates(_t, y):
        k.put(input_speed=y[0])
        k.cont[0] = y[1]
        assert k.rates() == 0
        return [(most / 3.0 - k.out("input_torque")) / 0.05, k.der[0]]

    run = k.solved(rates, [0.0, 0.0], 0.3)
    assert abs(run.y[0, -1]) < 1e-6
    assert k.out("input_torque") == pytest.approx(most / 3.0, rel=1e-4)


def test_without_bearings_and_seal_a_shaft_turns_freely():
    free = {"drum_bearing_count": 0, "drum_immersion": 0.0, "drum_seal_diameter": 0.0}
    k = Kernels(SPEC, **free)
    k.start(**SLIDING)
    k.cont[2] = 1e-4
    assert k.rates() == 0 and k.out("drum_torque") == 0.0
    assert k.der[2] < 0.0  # the bristle falls back, its energy is heat
    assert k.out("oil_heat") > 0.0
