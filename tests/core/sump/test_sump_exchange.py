"""The oil sump in model exchange: the closed form, and what it refuses."""

import numpy as np
import pytest
from built import built_fmu
from fmpy import simulate_fmu

WARM = {"heat_1": 2000.0, "factor_1": 2.0, "cooler_flow": 5e-5}


def run(**more):
    return simulate_fmu(str(built_fmu("sump", local=True)), fmi_type="ModelExchange", **more)


def test_it_warms_as_the_exponential_of_constant_heat():
    """C T' = Q - G (T - Ta) - rho c V (T - Tc), with the defaults of the parameters."""
    capacity, cooler = 850.0 * 2050.0 * 6e-3 + 1.08e4, 850.0 * 2050.0 * 5e-5
    loss = 25.0 + cooler
    end = (4000.0 + 25.0 * 298.15 + cooler * 338.15) / loss
    found = run(start_values=WARM, stop_time=600.0, output_interval=10.0, relative_tolerance=1e-9)
    expected = end + (358.15 - end) * np.exp(-found["time"] * loss / capacity)
    assert np.abs(found["temperature"] - expected).max() < 1e-4
    kept = found["received_heat"] - found["ambient_heat"] - found["cooler_heat"]
    assert np.abs(kept - found["stored_heat"]).max() < 1.0  # of 2.4e6 J
    assert found["received_heat"][-1] == pytest.approx(4000.0 * 600.0, rel=1e-9)


def test_a_host_follows_a_ramp_within_its_steps():
    """Hosts hold inputs over a step of a unit without event indicators: half the heat is lost."""
    ramp = np.array([(0.0, 0.0), (600.0, 2000.0)], dtype=[("time", float), ("heat_1", float)])
    found = run(input=ramp, stop_time=600.0, output_interval=60.0)
    assert found["received_heat"][-1] == pytest.approx(0.5 * 2000.0 * 600.0, rel=0.02)


def test_an_energy_is_refused_for_it_has_no_rate():
    with pytest.raises(Exception, match="fmi2ExitInitializationMode failed"):
        run(start_values={"energy_1": 1e3}, stop_time=1.0)
