"""What is called chatter: reversals of a slip that the torque goes along with, not what is healthy.

Engine and vehicle of two inertias; the pack sees the slip as it is, through a filter, or held.
"""

import numpy as np
import pytest

from thrustwasher.errors import Status
from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.registry import find_spec

H, J1, J2, OIL = 1e-3, 0.15, 1.0, 363.15  # s, kg m2, K
GIVEN = {"holding": "given", "coupling_inertia": J1 * J2 / (J1 + J2)}


def engaged(*, lag=0.0, every=1, ripple=0.0, frequency=25.0, delay=0, steps=900, **parameters):
    """Return slip, torque and status after each step; ``lag`` of the slip that is seen [s]."""
    element = {"friction_law": "constant", "fidelity": "stribeck"}
    pack = DirectInstance(find_spec("clutch"), parameters={**element, **parameters})
    pack.initialize(0.0, {"load": 200.0, "speed": 60.0, "oil_temperature": OIL})
    w1, w2, seen, waiting, rows = 60.0, 0.0, 60.0, [0.0] * delay, []
    for n in range(steps):
        if lag > 0.0:
            seen += (w1 - w2 - seen) * H / lag
        elif n % every == 0:
            seen = w1 - w2
        given = {"load": min(200.0 + 2e4 * n * H, 6000.0), "speed": seen, "oil_temperature": OIL}
        pack.set_inputs([given.get(name, 0.0) for name in pack.input_names])
        pack.step(n * H, H)
        torque, status = pack.get(["friction_torque", "solver_status"])
        waiting.append(torque)
        acting = waiting.pop(0)
        w1 += H * (100.0 + ripple * np.sin(2.0 * np.pi * frequency * n * H) - acting) / J1
        w2 += H * (acting - 20.0) / J2
        rows.append((w1 - w2, torque, status))
    return np.array(rows).T


@pytest.mark.parametrize("parameters", [{}, GIVEN], ids=["identified", "given"])
@pytest.mark.parametrize("delay", [0, 1])
@pytest.mark.parametrize("frequency", [10.0, 25.0])
def test_firing_torque_through_zero_in_a_locked_pack_is_healthy(frequency, delay, parameters):
    more = {"coupling_age": delay} if parameters else {}
    slip, torque, status = engaged(
        ripple=110.0, frequency=frequency, delay=delay, **parameters, **more
    )
    assert (status == Status.OK).all()
    late = slice(-400, None)
    assert torque[late].min() < 0.0 < torque[late].max()
    assert np.abs(slip[late]).max() < 0.5


@pytest.mark.parametrize(
    "parameters", [{}, GIVEN, {"holding": "off"}], ids=["asks", "given", "off"]
)
@pytest.mark.parametrize("lag", [0.01, 0.02])
def test_a_filtered_slip_that_swings_is_said_within_ten_reversals(lag, parameters):
    slip, _, status = engaged(lag=lag, **parameters)
    reversals = np.cumsum(np.append(0, slip[1:] * slip[:-1] < 0.0))
    assert (status != Status.OK).any()
    assert reversals[np.argmax(status != Status.OK)] < 10


@pytest.mark.parametrize("parameters", [{}, GIVEN], ids=["identified", "given"])
@pytest.mark.parametrize("every", [10, 20])
def test_a_slip_that_comes_every_few_steps_is_said_before_it_reverses(every, parameters):
    slip, _, status = engaged(every=every, **parameters)
    told = int(np.argmax(status == Status.CHATTER))
    assert 0 < told <= 7 * every and slip[told] > 0.0
