"""A washer near rest: heat, margin and slopes are those of the torque that it gives.

It holds nothing, for beside a pack that holds the same shaft it would chatter: it creeps.
"""

import numpy as np
import pytest
from kernel_part import Part

from thrustwasher.errors import Status
from thrustwasher.tribology.holding import memory as M
from thrustwasher.washer.kernels import layout as L

H, INERTIA, OUTSIDE = 1e-3, 1e-3, 0.05  # s, kg m2, N m


def told():
    """Return a washer that knows its shaft; a part by itself passes through zero as it does."""
    washer = Part("washer", "map")
    washer.par[L.P_HOLDING : L.P_COUPLING_AGE + 1] = M.GIVEN, INERTIA, 0.0
    return washer


def at(speed):
    return 300.0, speed, 2e-3, 363.15


@pytest.fixture(scope="module")
def braked():
    """A shaft from 5 rad/s to rest: (speed, torque, energy, oil energy, margin) of each step."""
    washer, speed, rows = told(), 5.0, []
    for _ in range(160):
        assert washer.step(at(speed), H) == Status.OK
        names = ("friction_torque", "energy", "oil_energy", "stick_margin", "oil_heat")
        rows.append((speed, *(washer[n] for n in names)))
        speed += H * (OUTSIDE - washer["friction_torque"]) / INERTIA
    return np.array(rows).T


def test_energy_is_the_work_of_the_torque_that_acted(braked):
    speed, torque, energy, oil_energy, _, oil_heat = braked
    assert torque[-1] == pytest.approx(OUTSIDE, rel=1e-6)
    assert (speed > 0.0).all() and speed[-1] < 2.5 * H * OUTSIDE / INERTIA  # the creep of J/(2 H)
    work = np.cumsum(torque * speed * H)
    np.testing.assert_allclose(energy, work, rtol=1e-12)
    np.testing.assert_allclose(oil_energy, work, rtol=1e-12)
    np.testing.assert_allclose(oil_heat, torque * speed, rtol=1e-12, atol=1e-15)


def test_gap_2_holds_what_it_holds_however_small_the_torque():
    """The margin is that of the torque which is given: the same hold over a smaller torque."""
    held = told()
    speed = 5.0
    for _ in range(60):
        assert held.step(at(speed), H) == Status.OK
        last, speed = speed, speed + H * (OUTSIDE - held["friction_torque"]) / INERTIA
    sliding = Part("washer", "map")
    assert sliding.step(at(last), H) == Status.OK
    small, large = abs(held["friction_torque"]), abs(sliding["friction_torque"])
    assert small < 0.9 * large
    assert held["stick_margin"] * small == pytest.approx(sliding["stick_margin"] * large, rel=1e-12)


@pytest.mark.parametrize("name", ["friction_torque", "stick_margin", "friction_coefficient"])
def test_slopes_of_a_washer_near_rest_are_those_of_its_outputs(name):
    washer, speed = told(), 5.0
    for _ in range(60):
        washer.step(at(speed), H)
        speed += H * (OUTSIDE - washer["friction_torque"]) / INERTIA
    near, step, found = 0.1, 1e-4, []
    for v in (near - step, near + step, near):
        washer.step(at(v))
        found.append(washer[name])
    dout, seed = np.zeros(washer.k.NOUT), np.zeros(washer.k.NSEED)
    seed[L.I_SPEED] = 1.0
    inp = np.zeros(washer.k.NINP)
    inp[:4] = at(near)
    assert washer.k.sens(washer.par, inp, washer.state, washer.work, seed, dout) == Status.OK
    slope = dout[washer.reals.index(name)]
    assert slope == pytest.approx((found[1] - found[0]) / (2.0 * step), rel=1e-4)


@pytest.mark.parametrize("changes", [{}, {"thermal_mode": "transient"}])
def test_slopes_near_rest_are_those_of_one_torque_in_the_film_too(changes):
    """Friction, heat and temperatures over speed and oil, at a part of the torque."""
    washer = Part("washer", "field", **changes)
    washer.par[L.P_HOLDING : L.P_COUPLING_AGE + 1] = M.GIVEN, 1e-5, 0.0
    for _ in range(3):
        assert washer.step(at(40.0), H) == Status.OK
    sliding, size = Part("washer", "field", **changes), {L.I_SPEED: 0.4, L.I_OIL: 0.2}
    assert sliding.step(at(40.0), H) == Status.OK
    assert 0.01 < washer["friction_torque"] / sliding["friction_torque"] < 0.5
    for place, step in size.items():
        found = []
        for shift in (-step, step, 0.0):
            inputs = list(at(40.0))
            inputs[place] += shift
            assert washer.step(inputs) == Status.OK
            found.append(washer.out.copy())
        dout, seed, inp = np.zeros(washer.k.NOUT), np.zeros(washer.k.NSEED), np.zeros(washer.k.NINP)
        inp[:4], seed[place] = at(40.0), 1.0
        assert washer.k.sens(washer.par, inp, washer.state, washer.work, seed, dout) == Status.OK
        for name in ("friction_torque", "friction_power", "oil_heat", "friction_coefficient"):
            i = washer.reals.index(name)
            assert dout[i] == pytest.approx((found[1][i] - found[0][i]) / (2.0 * step), rel=3e-2), (
                name
            )
