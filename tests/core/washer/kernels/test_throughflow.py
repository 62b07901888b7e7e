"""Oil through film 1: closed forms along a stream, limits of its heat capacity, continuity."""

import numpy as np
import pytest

from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.heat import heat_residual
from thrustwasher.washer.kernels.newton import evaluate
from thrustwasher.washer.kernels.throughflow import _leave
from thrustwasher.washer.parameters import WasherParams
from thrustwasher.washer.solve import constants

from washer_setup import BASE, bench, bench_of, order, settle, tilted  # isort: skip


def stream(n_t, source):
    """Return angles and rises of oil that turns with a stream between walls held at 0.

    ``source`` (n_t,) scales the heat made. Exchange per radian over what flows is about 1.
    """
    b = bench((5, n_t))
    m, f = b.m, b.f
    f.ht[:], f.ht2[:], f.liquid[:], f.fluidity[:] = 1e-5, 1e-5, 1.0, 1.0
    f.mu[:] = (source * 1e-5 / (BASE.speed * b.radius) ** 2).T.ravel()
    per_angle = m.film_exchange * np.asarray(m.weight1) / 1e-5
    b.node("flow_t")[:] = (per_angle / m.oil_storage)[:, None]
    f.flow_r[:] = 0.0
    _leave(m, f)
    at = (m.film_at + np.arange(n_t) * m.film_step)[None, :] + np.arange(m.n_r)[:, None]
    f.temp[:] = 0.0
    heat_residual(m, BASE, f.temp, f)
    made, i = f.heat[at[2]].copy(), 2
    matrix = np.empty((n_t, n_t))
    for j in range(n_t):
        f.temp[:] = 0.0
        f.temp[at[:, j]] = 1.0
        heat_residual(m, BASE, f.temp, f)
        matrix[:, j] = f.heat[at[i]] - made
    angle = np.unwrap(np.arctan2(m.sin, m.cos))
    rise = np.linalg.solve(matrix, -made) * m.film_exchange / 1e-5
    return angle, rise


@pytest.mark.slow
def test_heat_made_in_waves_warms_a_turning_stream_in_waves():
    """dT/da + T = cos a has T = (cos a + sin a)/2; second order in the mesh."""
    errors = []
    for n_t in (32, 64, 128):
        angle = np.unwrap(np.arctan2(bench((5, n_t)).m.sin, bench((5, n_t)).m.cos))
        angle, rise = stream(n_t, np.cos(angle))
        errors.append(np.abs(rise - 0.5 * (np.cos(angle) + np.sin(angle))).max())
    assert order(errors) == pytest.approx([2.0, 2.0], abs=0.3)
    assert errors[-1] < 1e-3


@pytest.mark.parametrize("speed", [545.0, -545.0])
@pytest.mark.parametrize("ratio", [2.0, 12.0])
def test_oil_that_enters_a_node_leaves_it(ratio, speed):
    """Where the film is full all of it; where the gap opens the liquid; full where it closes."""
    b = bench((10, 32))
    m, f = b.m, b.f
    pt, q = BASE._replace(speed=speed), tilted(b.m, ratio, gx=0.0)
    evaluate(m, pt, q, f, False)
    liquid, on, up = b.node("liquid"), b.node("flow_t"), b.node("flow_r")
    down = np.vstack((np.zeros(32), up[:-1]))
    back = np.roll(on, 1, axis=1)
    full = b.node("p") > 0.0
    net = on - back + up - down
    assert np.abs(net[full]).max() < 1e-9 * np.abs(on).max()
    assert liquid.min() > 0.0 and liquid.max() <= 1.0 + 1e-12
    closes = np.sin(np.arctan2(m.sin, m.cos)) * np.sign(speed) < -0.3
    assert np.all(liquid[:, closes] == 1.0) and liquid.min() < 0.9


def cooled(**changes):
    """Return a bench settled at fixed gaps, some oil constants changed beyond their ranges."""
    par = constants(WasherParams(oil_supply_temperature=310.0), (10, 32)).copy()
    for place, value in changes.items():
        par[getattr(L, place)] = value
    b = bench_of(par, (10, 32))
    settle(b.m, BASE, tilted(b.m, 9.0), b.f)
    return b


@pytest.mark.slow
def test_oil_without_heat_capacity_is_warmer_than_the_walls_by_its_heat():
    b = cooled(P_OIL_DENSITY=1e-7)
    film = b.f.temp[: b.m.film_step * 32].reshape(32, -1)
    washer = b.f.temp[b.m.washer_at :][:10]
    walls = 0.5 * (film[:, 10:20] + washer)
    np.testing.assert_allclose((film[:, :10] - walls).ravel(), b.f.made / b.f.exchange, rtol=1e-5)
