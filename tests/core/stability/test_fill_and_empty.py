"""A pack filled and emptied within one communication step, or between two of them.

Hazard: the film's rate is hundreds per second where it settles and 1e10 where it is squeezed; an
    explicit step overshoots through zero thickness, and one step of a second skips the filling.
Formula: dh/dt = -(p - p_c(h)) A (phi h^3 + 12 Phi d) 2/(3 pi eta G); rates -330 1/s to -1e10 1/s.
Cure: the film is integrated inside the step, implicitly and error controlled: what a step of a
    second gives is what a hundred steps of 10 ms give.
"""

import pytest

from thrustwasher.clutch.parameters import SPEC
from thrustwasher.errors import Status
from thrustwasher.fmu.running.direct_instance import DirectInstance

PRESSED, SLIP, OIL = 5898.0, 200.0, 297.15
SHOWN = ("torque_capacity", "film_ratio", "temperature", "energy")


def run(step, parts, loads=(PRESSED, 0.0, PRESSED, 0.0), **params):
    """Return what is shown after each load, held for ``step`` in so many parts."""
    # a pack that asks lowers its torque in some steps, be they long or short
    pack = DirectInstance(SPEC, parameters={"initial_film": 2.5e-4, "holding": "off", **params})
    pack.initialize(0.0, {"load": 0.0, "speed": SLIP, "oil_temperature": OIL})
    shown, t = [], 0.0
    for load in loads:
        pack.set_inputs([load, SLIP, OIL])
        for _ in range(parts):
            pack.step(t, step / parts)
            t += step / parts
        shown.append(dict(zip(SHOWN, pack.get(SHOWN), strict=True)))
    return shown


@pytest.mark.parametrize("fidelity", ["field", "fine"])
@pytest.mark.parametrize("step", [1e-3, 0.1, 1.0])
def test_one_step_fills_as_a_hundred_do(step, fidelity):
    for one, many in zip(
        run(step, 1, fidelity=fidelity), run(step, 100, fidelity=fidelity), strict=True
    ):
        for name in SHOWN:
            assert one[name] == pytest.approx(many[name], rel=1e-4), name


def test_in_a_second_it_fills_and_empties_for_good():
    full, empty, again, gone = run(1.0, 1)
    assert full["film_ratio"] < 0.6 < 25.0 < empty["film_ratio"]
    assert empty["torque_capacity"] < 0.02 * full["torque_capacity"]  # the oil's drag is left
    assert again["film_ratio"] == pytest.approx(full["film_ratio"], rel=1e-3)
    assert gone["film_ratio"] == pytest.approx(empty["film_ratio"], rel=1e-3)


def test_a_pulse_that_begins_and_ends_with_the_steps_is_squeezed_by_as_much_as_it_lasts():
    """In a millisecond from full clearance the film goes down, and stays down until it refills."""
    before, after = run(1e-3, 1, loads=(PRESSED, 0.0))
    assert before["film_ratio"] < 29.0 and after["film_ratio"] > before["film_ratio"]
    assert after["energy"] > before["energy"] > 0.0


def test_heat_never_comes_back_and_nothing_is_below_the_oil():
    for step in (1e-3, 0.1, 1.0):
        for profile in ("held", "linear"):
            shown = run(step, 1, input_profile=profile)
            heats = [s["energy"] for s in shown]
            assert heats == sorted(heats)
            assert all(s["temperature"] >= OIL for s in shown)


def test_looking_ahead_over_ten_seconds_it_says_that_it_is_too_hot():
    """With inputs that run straight the heat of a step is booked in advance, at its first power."""
    first = run(10.0, 1, loads=(PRESSED,), input_profile="linear")[0]
    pack = DirectInstance(
        SPEC, parameters={"initial_film": 2.5e-4, "input_profile": "linear", "starts_pressed": True}
    )
    pack.initialize(0.0, {"load": PRESSED, "speed": SLIP, "oil_temperature": OIL})
    pack.set_inputs([PRESSED, SLIP, OIL])
    pack.step(0.0, 10.0)
    temperature, status = pack.get(["temperature", "solver_status"])
    assert temperature > 1000.0 and status == Status.EXTRAPOLATED
    assert first["temperature"] < temperature
