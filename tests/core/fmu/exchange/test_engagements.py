"""Packs that lock in model exchange: as in co-simulation, by any tolerance, without chatter."""

import numpy as np
import pytest
from closed_forms.lock_up import engagement
from engagements import TWELVE, Plant, exchanged, lock_up, stepped
from exchanged import unit

from thrustwasher import ClutchParams, solve_clutch
from thrustwasher.clutch.parameters import FRICTION_LAWS
from thrustwasher.model.registry import find_spec

each = pytest.mark.parametrize(
    "place", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in range(1, len(TWELVE)))]
)
END = 1.0


@each
def test_an_engagement_is_that_of_co_simulation(place):
    """At 0.1 ms: when the slip is used up, the heat, and the torque that holds, within 0.2 %."""
    plant = TWELVE[place]
    with unit("clutch") as u, unit("clutch", kind="CoSimulation") as c:
        one, two = exchanged(u, plant, END), stepped(c, plant, END)
    assert abs(one["slip"][-1]) < 1e-3
    assert lock_up(one) == pytest.approx(lock_up(two), rel=2e-3)
    assert one["heat"] == pytest.approx(two["heat"], rel=2e-3)
    assert one["torque"] == pytest.approx(plant.held, rel=2e-3, abs=0.05)
    assert two["torque"] == pytest.approx(plant.held, rel=2e-2, abs=0.5)


@each
def test_it_locks_once_and_stays_so(place):
    with unit("clutch") as u:
        run = exchanged(u, TWELVE[place], END)
    assert [locked for _, locked in run["locks"]] == [True]
    assert run["events"] < 20 and run["steps"] < 3000
    late = run["time"] > run["locks"][0][0] + 0.05
    assert np.ptp(run["slip"][late]) < 1e-2


@pytest.mark.parametrize(
    ("tolerance", "part"), [(1e-3, 5e-2), (1e-4, 2e-3), (1e-5, 2e-3), (1e-7, 2e-3)]
)
@pytest.mark.slow
def test_every_tolerance_ends_at_the_same_lock(tolerance, part):
    plant = TWELVE[0]
    with unit("clutch") as u:
        fine = exchanged(u, plant, END, 1e-8)
    with unit("clutch") as u:
        run = exchanged(u, plant, END, tolerance)
    assert lock_up(run) == pytest.approx(lock_up(fine), rel=part)
    assert run["torque"] == pytest.approx(plant.held, abs=0.5)


@pytest.mark.parametrize("place", [0, 5, 8])
def test_a_constant_friction_is_modelicas_clutch_to_four_digits(place):
    """Modelica.Mechanics.Rotational.Components.Clutch, mu constant, has a closed form."""
    given, rigid = TWELVE[place], find_spec("clutch")
    (first, second), (drive, brake) = given.inertias, given.torques
    plant = Plant(given.inertias, given.torques, given.load, 1e-9, given.speeds)
    level = list(rigid.fidelities).index("closed") + 1
    law = list(FRICTION_LAWS).index("constant") + 1
    capacity = solve_clutch(
        ClutchParams(friction_law="constant"), load=plant.load, speed=0.0, fidelity="closed"
    ).torque_capacity
    sign = np.sign(plant.speeds[0] - plant.speeds[1])
    form = engagement(capacity, sign * drive, -sign * brake, first, second, *(
        sign * s for s in plant.speeds
    ))  # fmt: skip
    with unit("clutch") as u:
        run = exchanged(u, plant, 2.0 * form.lock_time, 1e-8, fidelity=level, friction_law=law)
    assert lock_up(run) == pytest.approx(0.98 * form.lock_time, rel=1e-4)
    assert run["heat"] == pytest.approx(form.heat, rel=2e-4)  # the bristle holds a part
    assert run["torque"] == pytest.approx(plant.held, rel=1e-4, abs=1e-4)


def test_a_contact_rise_is_for_co_simulation_alone():
    with unit("clutch") as u, pytest.raises(Exception, match="failed"):
        u.start(contact_rise=True)
