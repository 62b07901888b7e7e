"""The flank that its own oil heats: substitution swings between two temperatures for ever.

Hazard: hotter oil is thinner and heats less. Substituted, the temperature jumps over the root to
    a colder oil, which heats more, and back: a two-cycle, found with status OK by any loop that
    counts its turns and not its changes.
Formula: T = T_B + dT_0 (mu(T)/mu(T_B))^n has one root in [T_B, T_B + dT_0]; its slope is -n 755
    (T - T_B)/(T + 70)^2, T in degC, and substitution needs more than -1. At 40 degC and 100 K:
    roots 66.442854 degC (n = 1, slope -1.072) and 91.748712 degC (n = 0.3).
Cure: Newton's method inside the bracket that always holds the root.
"""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lab.benchmarks.failures import heat_loop as h
from thrustwasher import GearMeshParams, solve_gearmesh
from thrustwasher.errors import Status
from thrustwasher.gearmesh.kernels.flank_temperature import heated_flank

FROZEN, THINNING = h.Loop(40.0, 100.0, 1.0), h.Loop(40.0, 100.0, 0.3)


def ours(loop):
    t, _, _, status, _ = heated_flank(
        loop.bulk + 273.15, loop.rise, 1.0, 1e300, loop.power, h.B, h.C
    )
    return t - 273.15, status


def test_the_roots_are_known():
    for loop, root in ((FROZEN, 66.442854), (THINNING, 91.748712)):
        assert ours(loop) == (pytest.approx(root, abs=5e-7), Status.OK)
        assert loop.root() == pytest.approx(root, abs=5e-7)
    assert FROZEN.slope(66.442854) == pytest.approx(-1.072, abs=5e-4)


def test_substitution_swings_and_a_count_of_turns_does_not_see_it():
    (even, status, _), (odd, _, _) = (h.substitute_often(FROZEN, n) for n in (400, 401))
    assert status is Status.OK and abs(even - odd) > 20.0
    assert abs(even - 66.442854) > 10.0 and abs(odd - 66.442854) > 10.0
    assert h.substitute(FROZEN)[1] is Status.MAX_ITERATIONS
    assert h.substitute(THINNING)[1] is Status.OK


@given(st.floats(-39.0, 200.0), st.floats(0.0, 1e5), st.floats(0.0, 1.5))
def test_the_bracketed_root_is_found_everywhere(bulk, rise, power):
    loop = h.Loop(bulk, rise, power)
    t, status = ours(loop)
    assert status == Status.OK
    assert t == pytest.approx(loop.root(), abs=1e-8 * (1.0 + rise))


@pytest.mark.parametrize("power", [10.0, 1e3, 7500.0, 5e4])
@pytest.mark.parametrize("celsius", [-39.0, 26.7, 120.0])
@pytest.mark.parametrize("level", ["field", "fine"])
def test_the_mesh_is_solved_from_cold_oil_to_hot_and_from_little_heat_to_much(
    level, celsius, power
):
    r = solve_gearmesh(
        GearMeshParams(), power=power, speed=300.0, fidelity=level, oil_temperature=celsius + 273.15
    )
    assert not r.status.is_failure
    assert math.isfinite(r.film_temperature) and r.friction_torque > 0.0
    assert r.film_temperature >= r.surface_temperature >= celsius + 273.15 - 1e-9
