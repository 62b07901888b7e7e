"""Teeth near rest: heat and slopes are those of the torque that they give; the shaft creeps."""

import numpy as np
import pytest
from kernel_part import Part

from thrustwasher.errors import Status
from thrustwasher.gearmesh.kernels import layout as L
from thrustwasher.tribology.holding import memory as M

H, INERTIA, OUTSIDE = 1e-3, 1e-2, 0.3  # s, kg m2, N m


def at(speed):
    return 100.0, speed, 363.15


def braked(steps):
    """Bring a shaft to rest; return the mesh, (speed, torque, heat, energy) of each step."""
    mesh, speed, rows = Part("gearmesh", "field"), 5.0, []
    mesh.par[[L.P_HOLDING, L.P_COUPLING_INERTIA, L.P_COUPLING_AGE]] = M.GIVEN, INERTIA, 0.0
    for _ in range(steps):
        assert mesh.step(at(speed), H) == Status.OK
        names = ("friction_torque", "oil_heat", "oil_energy")
        rows.append((speed, *(mesh[n] for n in names)))
        speed += H * (OUTSIDE - mesh["friction_torque"]) / INERTIA
    return mesh, np.array(rows).T


def test_energy_is_the_work_of_the_torque_that_acted():
    _, (speed, torque, heat, energy) = braked(160)
    assert torque[-1] == pytest.approx(OUTSIDE, rel=1e-5)
    assert (speed > 0.0).all() and speed[-1] < 2.5 * H * OUTSIDE / INERTIA  # the creep of J/(2 H)
    np.testing.assert_allclose(heat, torque * speed, rtol=1e-9, atol=1e-14)
    np.testing.assert_allclose(energy, np.cumsum(torque * speed * H), rtol=1e-9)


def test_the_slope_of_the_heat_is_that_of_the_output():
    mesh, _ = braked(80)
    near, step, found = 0.02, 1e-5, []
    for v in (near - step, near + step, near):
        mesh.step(at(v))
        found.append(mesh["oil_heat"])
    inp, seed, dout = np.zeros(mesh.k.NINP), np.zeros(mesh.k.NINP), np.zeros(mesh.k.NOUT)
    inp[:3], seed[L.I_SPEED] = at(near), 1.0
    assert mesh.k.sens(mesh.par, inp, mesh.state, mesh.work, seed, dout) == Status.OK
    slope = dout[mesh.reals.index("oil_heat")]
    assert slope == pytest.approx((found[1] - found[0]) / (2.0 * step), rel=1e-4)


def test_what_teeth_make_is_in_their_bodies_and_in_the_oil():
    """At speeds that reverse again and again, some of them next to nothing."""
    rng, mesh, made = np.random.default_rng(3), Part("gearmesh", "field"), 0.0
    for _ in range(300):
        speed, h = (
            float(rng.choice((-80.0, -3.0, -0.2, 0.0, 0.2, 3.0, 80.0))),
            10 ** rng.uniform(-4, 0),
        )
        assert mesh.step(at(speed), h) == Status.OK
        assert mesh["friction_torque"] * speed >= 0.0
        assert mesh["friction_power"] == mesh["friction_torque"] * speed
        made += mesh["friction_power"] * h
    assert mesh["oil_energy"] + mesh.state[L.S_STORED] == pytest.approx(made, rel=1e-9)
