"""Grooves: the pads between them, the oil in them, and what is refused."""

import math

import numpy as np
import pytest
from clutch_pack import plain
from clutch_reference import pad_factor

from thrustwasher import ClutchParams, ParameterError, solve_clutch
from thrustwasher.clutch.kernels.constants import groove_factor
from thrustwasher.clutch.solve import prepare


def factor(**changes):
    return groove_factor(prepare(ClutchParams(**changes), "field"))


@pytest.mark.parametrize("count", [1, 3, 21, 22, 60, 200])
@pytest.mark.parametrize("width", [1e-4, 2e-3])
def test_the_short_series_is_the_long_one(count, width):
    p = ClutchParams(groove_count=count, groove_width=width)
    assert factor(groove_count=count, groove_width=width) == pytest.approx(pad_factor(p), rel=1e-9)


def test_a_pad_is_the_solution_of_reynolds_equation_on_a_rectangle():
    """lap p = -12 eta v/h^3, p = 0 around: the force is eta v a^3 l k/h^3; second order."""
    p = ClutchParams()
    a = math.pi * (p.outer_radius + p.inner_radius) / 24 - 2e-3
    wide, forces = p.outer_radius - p.inner_radius, []
    for n in (20, 40, 80):
        x, y = (2.0 - 2.0 * np.cos(np.pi * np.arange(1, n) / n) for _ in range(2))
        lam = x[:, None] / (a / n) ** 2 + y[None, :] / (wide / n) ** 2
        i = np.arange(1, n)
        modes = np.sin(np.pi * np.outer(i, i) / n)
        sums = modes.sum(0)
        weights = np.outer(sums, sums) ** 2 * (2.0 / n) ** 2
        forces.append(12.0 * (weights / lam).sum() * (a / n) * (wide / n))
    force = forces[2] + (forces[2] - forces[1]) / 3.0
    square = p.outer_radius**2 - p.inner_radius**2
    group = p.outer_radius**4 - p.inner_radius**4
    group -= square**2 / math.log(p.outer_radius / p.inner_radius)
    assert factor() == pytest.approx(24 * force / (1.5 * math.pi * group), rel=1e-5)


def test_the_land_carries_the_load():
    """Nominal pressure is on the land alone: the settled film is that of a higher pressure."""
    whole, part = plain(), plain(land_share=0.5)
    thin = solve_clutch(part, load=3000.0, speed=1.0)
    assert thin.film_ratio == pytest.approx(
        solve_clutch(whole, load=6000.0, speed=1.0).film_ratio, rel=1e-12
    )
    assert thin.friction_torque == solve_clutch(whole, load=3000.0, speed=1.0).friction_torque


def test_a_closed_pack_is_cooled_in_its_grooves_and_by_no_more_than_its_oil_takes():
    p = ClutchParams()
    r = solve_clutch(p, load=500.0, speed=2.0, oil_temperature=350.0)
    in_grooves = 4.86 * 0.145 / (2.0 * 4e-4) * 0.2 * p.lining_area
    supply = 850.0 * 2050.0 * p.oil_flow
    cooling = supply * (1.0 - math.exp(-in_grooves / supply))
    assert r.friction_power == pytest.approx(cooling * (r.temperature - 350.0), rel=1e-9)
    scarce = ClutchParams(oil_flow=1e-7)
    r = solve_clutch(scarce, load=100.0, speed=0.1, oil_temperature=350.0)
    least = 850.0 * 2050.0 * 1e-7
    assert r.friction_power == pytest.approx(least * (r.temperature - 350.0), rel=1e-6)


@pytest.mark.parametrize("changes", [{"groove_count": 0}, {"land_share": 1.0}])
def test_without_grooves_a_closed_pack_is_cooled_as_an_open_one(changes):
    p = ClutchParams(oil_flow=0.0, heat_transfer=700.0, **changes)
    r = solve_clutch(p, load=500.0, speed=2.0, oil_temperature=350.0)
    assert r.friction_power == pytest.approx(700.0 * p.lining_area * (r.temperature - 350.0))


def test_grooves_wider_than_the_face_are_refused():
    with pytest.raises(ParameterError, match=r"groove_width = 0.02 m, allowed: below .* 24 groov"):
        ClutchParams(groove_width=0.02)
    assert ClutchParams(groove_width=0.02, groove_count=0).groove_count == 0
