"""Heat balance: exact stack, Bessel annulus at its order, conservation, differences, options."""

import numpy as np
import pytest

from thrustwasher.washer.closed_forms.heated_ring import annulus_rise, stack_rise
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.gap import dry_friction, evaluate_gaps, evaluate_viscosity
from thrustwasher.washer.kernels.heat import factor_heat, heat_residual, heat_slopes, solve_heat
from thrustwasher.washer.kernels.newton import evaluate
from thrustwasher.washer.kernels.workspace import Point

from washer_setup import BASE, Bench, bench, full_gear, order, settle, tilted  # isort: skip

CONDUCTIVITY, OIL = 60.5, 0.145


def heat_given(b, heat, first=1e-5, second=5e-6):
    """Prescribe gaps and a heat flow [W/m2] (n_r, n_theta) that depends on no temperature."""
    f, m = b.f, b.m
    f.ht[:], f.ht2[:] = first, second
    f.pc[:], f.dmu[:], f.small[L.FRICTION] = 0.0, 0.0, 0.0
    f.mu[:] = (heat * first / (BASE.speed * b.radius) ** 2).T.ravel()
    f.temp[:] = 0.0
    heat_residual(m, BASE, f.temp, f)
    assert factor_heat(m, BASE, f)
    f.heat[:] *= -1.0
    solve_heat(m, f.heat, f.temp, f)


def bodies(b):
    """Return the rises of carrier, washer and gear, each (n, n_theta)."""
    n_r, i_g = b.m.n_r, b.m.i_g
    column = b.f.temp.reshape(b.m.n_t, 3 * n_r - i_g).T
    return column[:n_r], column[n_r : 2 * n_r], column[2 * n_r :]


def touching(b, first=0.3, second=1.2):
    """Return positions where film 1 carries contact within the range of the friction law."""
    q = tilted(b.m, first, gy=0.00166, gx=-1.2e-5, second=second)
    evaluate_gaps(b.m, BASE, q, b.f)
    assert 260.5 < b.f.small[L.CONTACT] < 1725.6
    return q


@pytest.mark.parametrize("split", [0.5, 0.0, 0.3, 1.0])
@pytest.mark.parametrize("grid", [(5, 8), (10, 32)])
def test_an_evenly_heated_stack_is_exact_on_every_grid(grid, split):
    b = full_gear(grid, heat_split=split)
    heat_given(b, np.full((grid[0], grid[1]), 1e5))
    half = 6.35e-4 / (2.0 * CONDUCTIVITY)
    back = 0.01 / CONDUCTIVITY
    expected = stack_rise(1e5, split, 1e-5 / OIL + half, 5e-6 / OIL + half, back, back)
    for found, rise in zip(bodies(b), expected, strict=True):
        np.testing.assert_allclose(found, rise, rtol=1e-10)
    if split == 0.5:
        tabled = (33.00312669, 33.33478041, 31.52579893)
        assert [24.0 + x[0, 0] for x in bodies(b)] == pytest.approx(tabled, abs=1e-8)


def test_an_annulus_alone_converges_with_order_two():
    """Oil that does not conduct leaves the carrier on its own: Bessel functions."""
    errors = []
    for grid in ((16, 48), (31, 96)):
        b = bench(grid, heat_split=1.0)
        b = Bench(b.m._replace(oil_conductivity=1e-14), b.f)
        angle = np.arctan2(b.m.sin, b.m.cos)
        heat_given(b, 1e5 * (b.radius / b.m.outer_radius) ** 2 * np.cos(2.0 * angle))
        amplitude = annulus_rise(
            np.asarray(b.m.r), 1e5, 2, CONDUCTIVITY, 0.01, b.m.inner_radius, b.m.outer_radius
        )
        exact = np.outer(amplitude, np.cos(2.0 * angle))
        errors.append(np.abs(bodies(b)[0] - exact).max() / np.abs(exact).max())
    assert order(errors) == pytest.approx([2.0], abs=0.15)
    assert errors[-1] < 1.5e-3


@pytest.mark.parametrize("split", [0.5, 0.3])
def test_heat_made_is_heat_out_at_any_temperature(split):
    """What the residual adds up to is far-face heat less heat made: nothing is lost in between."""
    b = bench((10, 32), heat_split=split)
    m, f = b.m, b.f
    q = touching(b)
    f.temp[:] = np.random.default_rng(1).uniform(0.0, 80.0, f.temp.size)
    evaluate_viscosity(m, BASE, f)
    made = heat_residual(m, BASE, f.temp, f)
    carrier, _, gear = bodies(b)
    out = (np.outer(m.weight1, m.weight_t) * carrier).sum() * CONDUCTIVITY / m.carrier_thickness
    out += (np.outer(m.weight2[m.i_g :], m.weight_t) * gear).sum() * CONDUCTIVITY / m.gear_thickness
    assert f.heat.sum() == pytest.approx(out - made, rel=1e-10)
    shear = np.outer(m.weight1, m.weight_t) * (BASE.speed * b.radius) ** 2 * b.node("mu")
    rub = np.outer(m.weight1, m.weight_t) * BASE.speed * b.radius * b.node("pc")
    friction = dry_friction(m.par, f.small[L.CONTACT])[0]
    assert made == pytest.approx((shear / b.node("ht")).sum() + friction * rub.sum(), rel=1e-12)
    settle(m, BASE, q, f)
    assert np.abs(f.heat).sum() < 1e-9 * made


@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_only_the_wanted_share_of_film_heat_enters(share):
    b = bench((10, 32), film_heat_fraction=share)
    q = tilted(b.m, 20.0)  # no contact at all
    evaluate(b.m, BASE, q, b.f)
    made = heat_residual(b.m, BASE, b.f.temp, b.f)
    whole = (
        np.outer(b.m.weight1, b.m.weight_t) * (BASE.speed * b.radius) ** 2 * b.node("mu")
        / b.node("ht")
    ).sum()  # fmt: skip
    assert made == pytest.approx(share * whole, rel=1e-12)


@pytest.mark.parametrize("split", [0.5, 0.3, 0.0])
def test_matrix_is_the_difference_of_the_residual(split):
    """solve(rhs) = x means: the residual changes by rhs along x, viscosity following."""
    b = bench((10, 32), heat_split=split, film_heat_fraction=0.7)
    m, f = b.m, b.f
    touching(b)
    rng = np.random.default_rng(2)
    start = rng.uniform(0.0, 60.0, f.temp.size)
    f.temp[:] = start
    evaluate_viscosity(m, BASE, f)
    assert factor_heat(m, BASE, f)
    rhs, x = rng.normal(size=f.temp.size), np.empty(f.temp.size)
    solve_heat(m, rhs, x, f)
    found = []
    for e in (1e-3, -1e-3):
        f.temp[:] = start + e * x
        evaluate_viscosity(m, BASE, f)
        heat_residual(m, BASE, f.temp, f)
        found.append(f.heat.copy())
    np.testing.assert_allclose((found[0] - found[1]) / 2e-3, rhs, rtol=0, atol=1e-6)


@pytest.mark.parametrize("law", ["load", "constant"])
@pytest.mark.parametrize("split", [0.5, 0.3])
def test_slopes_over_the_positions_are_the_differences(split, law):
    """Also through the friction coefficient, which knows the total contact force."""
    b = bench((10, 32), heat_split=split, film_heat_fraction=0.7, friction_law=law)
    m, f = b.m, b.f
    q = touching(b)
    f.temp[:] = np.random.default_rng(4).uniform(0.0, 60.0, f.temp.size)
    evaluate_viscosity(m, BASE, f)
    heat_slopes(m, BASE, f.temp, f)
    told = -f.following.copy()
    for c in range(4):
        unit = m.sigma1 * (1.0 if c < 2 else 1.0 / m.outer_radius) * 1e-5
        found = []
        for sign in (1.0, -1.0):
            moved = q.copy()
            moved[c] += sign * unit
            evaluate_gaps(m, BASE, moved, f)
            heat_residual(m, BASE, f.temp, f)
            found.append(f.heat.copy())
        differences = (found[0] - found[1]) / (2.0 * unit)
        scale = np.abs(told[c]).max()
        np.testing.assert_allclose(told[c], differences, rtol=0, atol=1e-6 * scale)


def test_dry_friction_has_its_published_ends_and_its_slope():
    m = bench((5, 8)).m
    assert dry_friction(m.par, 260.5)[0] == pytest.approx(0.201870, abs=5e-7)
    assert dry_friction(m.par, 1725.6)[0] == pytest.approx(0.107333, abs=5e-7)
    assert dry_friction(m.par, 0.0) == (dry_friction(m.par, 260.5)[0], 0.0)
    assert dry_friction(m.par, 1e5) == (dry_friction(m.par, 1725.6)[0], 0.0)
    value, slope = dry_friction(m.par, 900.0)
    assert value == pytest.approx(0.48 - 0.05 * np.log(900.0), rel=1e-14)
    differences = (dry_friction(m.par, 900.01)[0] - dry_friction(m.par, 899.99)[0]) / 0.02
    assert slope == pytest.approx(differences, rel=1e-7)
    assert dry_friction(bench((5, 8), friction_law="constant").m.par, 900.0) == (0.15, 0.0)


@pytest.mark.parametrize("option", ["carrier", "rotating"])
def test_axisymmetric_bodies_have_even_rings(option):
    """Only the named bodies vary around the circumference; the others to 0.1 %."""
    b = bench((10, 32), conduction=option)
    settle(b.m, BASE, tilted(b.m, 3.0), b.f)
    spread = [np.ptp(body, axis=1).max() / body.mean() for body in bodies(b)]
    even = (1, 2) if option == "carrier" else (0,)
    assert all((spread[k] < 1e-3) == (k in even) for k in range(3)), spread


def test_a_washer_at_rest_stays_at_oil_temperature():
    b = bench((10, 32))
    pt = Point(300.0, 0.0, 0.002, 297.15)
    settle(b.m, pt, touching(b), b.f)
    assert np.all(b.f.temp == 0.0)
