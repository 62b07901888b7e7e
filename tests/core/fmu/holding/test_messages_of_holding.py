"""What a pack says when it cannot hold: the numbers behind it, once in an engagement."""

import re

import numpy as np
import pytest
from built import built_fmu

from thrustwasher.fmu.stepper import Instance

H, INERTIA = 1e-3, 0.13  # s, kg m2 that the slip sees
TOLD = {"holding": "given", "coupling_inertia": INERTIA}


ELEMENT = {"fidelity": "stribeck"}


def warned(slip_of, parameters=(), steps=400, load=6000.0, **built):
    """Return what a pack says of the slips [rad/s] that ``slip_of`` makes of step and torque."""
    with Instance(
        built_fmu("clutch", local=True, **built), parameters={**ELEMENT, **dict(parameters)}
    ) as unit:
        unit.initialize(0.0, {"load": 0.0, "speed": 20.0, "oil_temperature": 363.15})
        torque = 0.0
        for n in range(steps):
            pressed = load(n) if callable(load) else load
            given = {"load": pressed, "speed": slip_of(n, torque), "oil_temperature": 363.15}
            unit.set_inputs([given.get(name, 0.0) for name in unit.input_names])
            unit.step(n * H, H)
            (torque,) = unit.get(["friction_torque"])
        return list(unit.warnings)


def swinging(n, _):
    return 10.0 * np.cos(2.0 * np.pi * n / 40.0 + 0.3)


def held(every, inertia=INERTIA, first=20.0):
    """Return a plant whose speed a host hands over anew every so many steps."""
    slip = [first, first]

    def slip_of(n, torque):
        slip[0] += H * (10.0 - torque) / inertia if n else 0.0
        if n % every == 0:
            slip[1] = slip[0]
        return slip[1]

    return slip_of


@pytest.mark.parametrize("built", [{}, {"target": "python"}, {"fmi": 3}], ids=["native", "py", "3"])
def test_a_slip_that_does_not_answer_is_said_with_tests_noise_and_what_the_capacity_moves(built):
    (told,) = warned(swinging, **built)
    assert "UNANSWERED: " in told and "right for a prescribed slip" in told
    found = re.search(
        r"tested (\d+) times, none answered; the noise of the speed is (\S+) rad/s, the capacity "
        r"moves the slip by at most (\S+) rad/s in a step; load = ",
        told,
    )
    tests, noise, move = map(float, found.groups())
    assert tests >= 12 and 0.0 < noise < 0.1 and 0.0 < move < 10.0


def test_it_is_said_once_in_an_engagement():
    """Two engagements with an open pack between them."""

    def load(n):
        return 0.0 if 300 <= n < 320 else 6000.0

    told = [text for text in warned(swinging, steps=700, load=load) if "UNANSWERED" in text]
    assert len(told) == 2


@pytest.mark.parametrize("every", [10, 20])
def test_a_speed_that_comes_every_few_steps_is_said_with_its_rate(every):
    told = [text for text in warned(held(every), steps=600) if "CHATTER" in text]
    assert f"the speed comes every {every} steps: step the unit at that rate" in told[0]
    assert "advised_step" in told[0]


@pytest.mark.parametrize(("inertia", "least", "most"), [(0.06, 0.055, 0.065), (0.3, 0.28, 0.32)])
def test_an_inertia_that_does_not_explain_the_slip_is_refuted_with_the_one_that_does(
    inertia, least, most
):
    told = [text for text in warned(held(1, inertia, 100.0), TOLD) if "REFUTED" in text]
    found = re.search(r"the slip answers as one of (\S+) kg m2 does; load = ", told[0])
    assert least < float(found.group(1)) < most


def test_a_slip_that_is_held_too_long_for_what_was_given_is_said_with_what_was_expected():
    """The host takes over: the pack holds, then the slip runs away from it."""
    plant = held(1)

    def slip_of(n, torque):
        return plant(n, torque) if n < 250 else 2.0 * np.sin(0.2 * (n - 250))

    told = [text for text in warned(slip_of, TOLD) if "REFUTED" in text]
    found = re.search(r"the slip is (\S+) rad/s where at most (\S+) rad/s were expected", told[0])
    slip, most = map(float, found.groups())
    assert slip > most > 0.0


@pytest.mark.parametrize("slip_of", [lambda: swinging, lambda: held(10)], ids=["swing", "held"])
def test_both_targets_and_both_versions_say_the_same(slip_of):
    builds = ({}, {"target": "python"}, {"fmi": 3})
    native, python, third = (warned(slip_of(), steps=600, **built) for built in builds)
    assert native and native == python == third
