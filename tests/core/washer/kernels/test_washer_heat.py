"""Heat balance: exact stack, Bessel annulus at its order, conservation, differences, options."""

import numpy as np
import pytest
from closed_forms.heated_ring import annulus_rise, stack_rise

from thrustwasher.model.part_file import preset_part
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.gap import dry_friction, evaluate_gaps
from thrustwasher.washer.kernels.heat import heat_residual
from thrustwasher.washer.kernels.heat_factor import factor_heat, solve_heat
from thrustwasher.washer.kernels.newton import evaluate
from thrustwasher.washer.parameters import CONDUCTION, SPEC

from washer_setup import (  # isort: skip
    BASE,
    Bench,
    bench,
    bodies,
    full_gear,
    order,
    settle,
    tilted,
)

GRID = (7, 20)  # what is tested holds on any mesh; some of these kernels run as plain Python
CONDUCTIVITY, OIL = 60.5, 0.145
PAPER = preset_part(SPEC, "paper").parameters
DRY = {"oil_cooling": False, "pressure_flow_shear": False}  # the oil carries no heat
LAWS = {
    "default": {},
    "paper": PAPER,
    "carrier turns": {"conduction": "rotating", "heat_split": 0.3},
    "everywhere": {"conduction": "all", "friction_law": "constant"},
    "liquid alone": {"cavity_shear": "liquid", "heat_split": 0.8},
    "no pressure flow": {"pressure_flow_shear": False, "oil_supply_temperature": 330.0},
    "rings without flow": {**DRY, "film_heat_fraction": 0.7, "heat_split": 0.3},
}


def heat_given(b, heat, first=1e-5, second=5e-6):
    """Prescribe gaps and a heat flow [W/m2] (n_r, n_theta) that depends on no temperature."""
    f, m = b.f, b.m
    f.ht[:], f.ht2[:] = first, second
    f.pc[:], f.dmu[:], f.small[L.FRICTION] = 0.0, 0.0, 0.0
    f.mu[:] = (heat * first / (BASE.speed * b.radius) ** 2).T.ravel()
    f.fluidity[:] = 1.0
    f.temp[:] = 0.0
    heat_residual(m, BASE, f.temp, f)
    assert factor_heat(m, BASE, f)
    f.heat[:] *= -1.0
    solve_heat(m, f.heat, f.temp, f)


def touching(b, first=0.3, second=1.2):
    """Return positions where film 1 carries contact within the range of the friction law."""
    q = tilted(b.m, first, gy=0.00166, gx=-1.2e-5, second=second)
    evaluate_gaps(b.m, BASE, q, b.f)
    assert 260.5 < b.f.small[L.CONTACT] < 1725.6
    return q


@pytest.mark.parametrize("oil", [{}, DRY])
@pytest.mark.parametrize("conduction", CONDUCTION)
@pytest.mark.parametrize("split", [0.5, 0.0, 0.3, 1.0])
@pytest.mark.parametrize("grid", [(5, 8), (10, 32)])
def test_an_evenly_heated_stack_is_exact_on_every_grid(grid, split, conduction, oil):
    b = full_gear(grid, heat_split=split, conduction=conduction, **oil)
    heat_given(b, np.full((grid[0], grid[1]), 1e5))
    half = 6.35e-4 / (2.0 * CONDUCTIVITY)
    back = 0.01 / CONDUCTIVITY
    expected = stack_rise(1e5, split, 1e-5 / OIL + half, 5e-6 / OIL + half, back, back)
    for found, rise in zip(bodies(b), expected, strict=True):
        np.testing.assert_allclose(found, rise, rtol=1e-10)
    if split == 0.5:
        tabled = (33.00312669, 33.33478041, 31.52579893)
        assert [24.0 + x[0, 0] for x in bodies(b)] == pytest.approx(tabled, abs=1e-8)


@pytest.mark.parametrize("conduction", CONDUCTION)
def test_with_an_insulated_gear_all_heat_leaves_through_the_carrier(conduction):
    b = full_gear(GRID, heat_split=0.3, conduction=conduction, gear_far_face="insulated", **DRY)
    heat_given(b, np.full(GRID, 1e5))
    first = 1e5 * 0.01 / CONDUCTIVITY
    last = first + 0.7 * 1e5 * (1e-5 / OIL + 6.35e-4 / (2.0 * CONDUCTIVITY))
    for found, rise in zip(bodies(b), (first, last, last), strict=True):
        np.testing.assert_allclose(found, rise, rtol=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("changes", [PAPER, {}])
def test_an_annulus_alone_converges_with_order_two(changes):
    """Oil that conducts from wall to wall no more leaves the carrier on its own: Bessel."""
    errors = []
    for grid in ((16, 48), (31, 96)):
        b = bench(grid, **{**changes, "heat_split": 1.0})
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


def at_random(b, seed=1):
    """Evaluate everything where film 1 touches, at temperatures drawn at random."""
    q = touching(b)
    b.f.temp[:] = np.random.default_rng(seed).uniform(0.0, 80.0, b.f.temp.size)
    return q, evaluate(b.m, BASE, q, b.f, False)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.slow
def test_heat_made_is_heat_out_at_any_temperature(name):
    """What the residual adds up to is heat out less heat made: nothing is lost in between."""
    b = bench(GRID, **LAWS[name])
    m, f = b.m, b.f
    q, made = at_random(b)
    carrier, _, gear = bodies(b)
    out = (np.outer(m.weight1, m.weight_t) * carrier).sum() * CONDUCTIVITY / m.carrier_thickness
    out += (np.outer(m.weight2[m.i_g :], m.weight_t) * gear).sum() * CONDUCTIVITY / m.gear_thickness
    out += m.oil_storage * (f.rim * f.liquid) @ f.edge
    assert f.heat.sum() == pytest.approx(out - made, rel=1e-10)
    settle(m, BASE, q, f)
    assert np.abs(f.heat).sum() < 1e-9 * made


@pytest.mark.parametrize("name", LAWS)
def test_torque_times_speed_is_the_heat_made(name):
    """Pressure flow included: what it makes in all faces is its share of the torque."""
    b = bench(GRID, **LAWS[name])
    m, f = b.m, b.f
    _, made = at_random(b)
    area = np.outer(m.weight1, m.weight_t)
    liquid = b.node("liquid") if m.only_liquid else 1.0
    torque = (area * liquid * BASE.speed * b.radius**2 * b.node("mu") / b.node("ht")).sum()
    p = b.node("p")
    if m.pressure_shear:
        torque += (b.node("wedge") * (np.roll(p, -1, axis=1) - p)).sum() / BASE.speed
    friction = dry_friction(m.par, f.small[L.CONTACT])[0]
    rub = friction * (area * b.radius * b.node("pc")).sum()
    assert made == pytest.approx((m.film_heat_fraction * torque + rub) * BASE.speed, rel=1e-9)
    assert p.max() > 1e5


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
