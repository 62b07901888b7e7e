"""The oil sump: exact for any step, every joule accounted for."""

import math

import pytest

from thrustwasher.clutch.parameters import SPEC as PACK
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.sump.parameters import SPEC, SumpParams

CAPACITY = 850.0 * 2050.0 * 6e-3 + 1.08e4  # J/K


def sump(**params):
    return DirectInstance(SPEC, parameters=params)


def run(steps, heat, flow=0.0, **params):
    """Return the outputs after steps [s] with a heat [W] held."""
    with sump(**params) as one:
        one.initialize(0.0, {"heat_1": heat, "cooler_flow": flow})
        t = 0.0
        for h in steps:
            one.step(t, h)
            t += h
        return dict(zip(one.output_names, one.outputs(), strict=True))


def test_the_sump_holds_21_kj_per_kelvin():
    assert pytest.approx(21255.0) == CAPACITY
    warm = run([10.0], 2e3, conductance=0.0)
    assert warm["temperature"] - 358.15 == pytest.approx(2e4 / CAPACITY, rel=1e-11)


@pytest.mark.parametrize("steps", [[900.0], [300.0] * 3, [0.5] * 1800])
def test_any_step_gives_the_exponential(steps):
    flow = 1e-4
    leak = 25.0 + 850.0 * 2050.0 * flow
    end = (3e3 + 25.0 * 298.15 + (leak - 25.0) * 338.15) / leak
    exact = end + (358.15 - end) * math.exp(-leak * 900.0 / CAPACITY)
    assert run(steps, 3e3, flow)["temperature"] == pytest.approx(exact, rel=1e-13)


def test_every_joule_is_somewhere():
    found = run([7.0] * 100, 4e3, 5e-5)
    where = found["stored_heat"] + found["ambient_heat"] + found["cooler_heat"]
    assert found["received_heat"] == pytest.approx(4e3 * 700.0, rel=1e-13)
    assert where == pytest.approx(found["received_heat"], rel=1e-12)


def test_equal_parts_count_by_their_number():
    assert run([60.0], 500.0, factor_1=4.0) == run([60.0], 2e3)


def taken_in(steps, sends):
    """Return the outputs after steps [s]; ``sends`` gives the inputs of the step to a time [s]."""
    with sump(factor_1=2.0) as one:
        one.initialize(0.0, {})
        t = 0.0
        for h in steps:
            given = {s.name: s.start for s in SPEC.inputs} | sends(t + h)
            one.set_inputs([given[name] for name in one.input_names])
            one.step(t, h)
            t += h
        return dict(zip(one.output_names, one.outputs(), strict=True))


def test_energy_in_even_steps_is_power():
    by_energy = taken_in([0.5] * 40, lambda t: {"energy_1": 1500.0 * t})
    by_power = taken_in([0.5] * 40, lambda _: {"heat_1": 1500.0})
    assert by_energy["received_heat"] == pytest.approx(2.0 * 1500.0 * 20.0, rel=1e-13)
    for name, value in by_power.items():
        assert by_energy[name] == pytest.approx(value, rel=1e-12), name


@pytest.mark.parametrize("steps", [[3.0], [0.1, 2.0, 0.9], [1e-6, 2.999999]])
def test_all_energy_arrives_whatever_the_steps(steps):
    found = taken_in(steps, lambda t: {"energy_1": 200.0 * t * t, "heat_2": 10.0})
    assert found["received_heat"] == pytest.approx(2.0 * 200.0 * 9.0 + 30.0, rel=1e-12)


def coupled(steps):
    """Return temperature, heat received, heat the pack had sent a step before, step by step.

    Pack and sump run side by side, each with what the other had at the step's start.
    """
    small = {"volume": 1e-4, "housing_capacity": 0.0, "conductance": 0.0}
    held = {"load": 5e3, "speed": 20.0}
    prescribed = {"holding": "off"}
    with DirectInstance(PACK, parameters=prescribed) as pack, sump(**small) as oil:
        pack.initialize(0.0, held | {"oil_temperature": 358.15})
        oil.initialize(0.0, {})
        t, rows = 0.0, []
        for h in steps:
            sent = dict(zip(pack.output_names, pack.outputs(), strict=True))["oil_energy"]
            found = dict(zip(oil.output_names, oil.outputs(), strict=True))
            given = held | {"oil_temperature": found["temperature"], "drum_speed": 0.0}
            pack.set_inputs([given[name] for name in pack.input_names])
            given = {s.name: s.start for s in SPEC.inputs} | {"energy_1": sent}
            oil.set_inputs([given[name] for name in oil.input_names])
            pack.step(t, h)
            oil.step(t, h)
            t += h
            found = dict(zip(oil.output_names, oil.outputs(), strict=True))
            rows.append((found["temperature"], found["received_heat"], sent))
    return rows


def test_a_sump_coupled_by_energy_has_what_its_pack_had_sent_a_step_before_and_converges():
    for _, received, sent in coupled([0.1, 0.01, 0.03] * 14):
        assert received == pytest.approx(sent, rel=1e-12, abs=1e-12)
    *_, (exact, *_) = coupled([0.002] * 1000)
    errors = [exact - coupled([h] * round(2.0 / h))[-1][0] for h in (0.1, 0.05)]
    assert 0.1 < errors[0] < 0.2  # K, of 1.6 K
    assert 1.8 < errors[0] / errors[1] < 2.2


def test_heat_that_comes_as_power_and_as_energy_is_refused():
    twice = {"heat_1": 1e3, "energy_1": 1e3}
    with pytest.raises(SolveError, match=r"heat_1 = 1000 W.*energy_1 = 1000 J.*excluded by"):
        taken_in([1.0], lambda _: twice)
    assert taken_in([1.0], lambda _: {"heat_1": 1e3, "energy_2": 1e3})["received_heat"] == 3e3


def test_steps_without_time_change_nothing_and_bad_inputs_are_named():
    with sump() as one:
        one.initialize(0.0, {"heat_1": 1e3})
        assert one.outputs()[0] == 358.15
        one.step(0.0, 5.0)
        before = one.core.state.tobytes()
        one.set_inputs([1e5, *one.core.inp.tolist()[1:]])
        assert one.outputs()[0] != 358.15 and one.core.state.tobytes() == before
        with pytest.raises((ParameterError, SolveError), match="heat_1"):
            one.set_inputs([math.nan, *one.core.inp.tolist()[1:]])


def test_a_sump_without_volume_is_refused():
    with pytest.raises(ParameterError, match=r"volume = 0\.0 m3"):
        SumpParams(volume=0.0)
