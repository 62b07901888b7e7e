"""The oil sump: exact for any step, every joule accounted for."""

import math

import pytest

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
