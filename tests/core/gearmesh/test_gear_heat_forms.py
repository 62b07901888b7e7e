"""The gear mesh's temperatures and stresses derived again from heat flow and contact."""

import math

import numpy as np
import pytest
from closed_forms.flash_temperature import (
    ELLIPTIC,
    Body,
    atan_flash,
    blok_flash,
    deep_body_rise,
    pinion_flash,
)
from closed_forms.involute_mesh import Mesh, flanks_at, line_load, start_of_contact
from closed_forms.line_contact import compliance, full_width, peak_pressure
from closed_forms.thermal_fatigue import (
    Endurance,
    contact_stress,
    grouped_factor,
    modification_factor,
    thermal_stress,
)
from scipy.integrate import quad, solve_ivp

PHI, E, NU, SPEED, POWER, FACE = math.radians(20.0), 205e9, 0.3, 180.0, 7500.0, 0.05
STEEL = Body(compliance(E, NU), 50.2, 7850.0, 475.0)
THETA = 2.0 * STEEL.compliance
HIGH_CARBON = Endurance(0.53, 0.40)


def contact(mesh, speed=SPEED, power=POWER):
    flanks = flanks_at(start_of_contact(mesh), mesh, speed)
    load = line_load(power / speed, mesh, FACE)
    return flanks, load, full_width(load, flanks.radius, THETA)


def test_a_deep_body_warms_as_heat_conduction_says():
    """Finite volumes over a depth that the heat does not reach in the time."""
    k, c, time = 50.2, 7850.0 * 475.0, 1e-4
    depth = 12.0 * math.sqrt(k / c * time)
    edges = depth * np.linspace(0.0, 1.0, 241) ** 2
    size, middle = np.diff(edges), 0.5 * (edges[1:] + edges[:-1])
    between = k / np.diff(middle)

    def warming(_, t):
        flow = np.concatenate(([1.0], -between * np.diff(t), [0.0]))
        return -np.diff(flow) / (c * size)

    run = solve_ivp(
        warming, (0.0, time), np.zeros(240), method="LSODA", lband=1, uband=1, rtol=1e-8, atol=1e-16
    )
    surface = run.y[0, -1] + 1.0 * middle[0] / k
    assert surface == pytest.approx(deep_body_rise(1.0, time, math.sqrt(k * c)), rel=1e-4)


@pytest.mark.parametrize(("m", "n", "ratio"), [(2.0, 20, 1.67), (2.0, 30, 1.32), (5.0, 20, 1.73)])
def test_half_the_heat_overheats_the_slow_flank(m, n, ratio):
    mesh = Mesh(m, n, 0.254, PHI)
    flanks, load, width = contact(mesh)
    half = pinion_flash(mesh, POWER / SPEED, SPEED, FACE, 0.5 * 0.08, STEEL)
    blok = blok_flash(
        load, 0.08, flanks.speed_pinion, flanks.speed_gear, width, STEEL.effusivity, ELLIPTIC
    )
    assert half / blok == pytest.approx(ratio, abs=6e-3)


def test_without_the_cosine_in_eq_9_eq_12_would_not_follow():
    """The load is the torque over the *base* radius; over the pitch radius K is 6.4 % larger."""
    mesh = Mesh(2.0, 25, 0.254, PHI)
    flanks, load, _ = contact(mesh)
    rise = atan_flash(mesh, POWER, SPEED, FACE, 0.4, STEEL)
    printed = contact_stress(load * math.cos(PHI), flanks.radius, E)
    short = modification_factor(thermal_stress(rise, E, NU, 12e-6), printed, HIGH_CARBON)
    long = grouped_factor(
        mesh, POWER, SPEED, FACE, 0.4, HIGH_CARBON, E, NU, 12e-6, STEEL.effusivity
    )
    assert max(short / long, long / short) == pytest.approx(1.064, abs=1e-3)


@pytest.mark.parametrize("place", [-0.7, 0.2, 0.9])
def test_the_pressure_flattens_the_gap(place):
    """Slope of two half spaces: -(2 theta/pi) times the principal value of p(s)/(x - s)."""
    load, radius = 2.5e4, 0.008
    half, top = 0.5 * full_width(load, radius, THETA), peak_pressure(load, radius, THETA)
    value = quad(lambda u: -math.sqrt(1.0 - u * u), -1.0, 1.0, weight="cauchy", wvar=place)[0]
    assert -2.0 * THETA / math.pi * top * value == pytest.approx(-place * half / radius, rel=1e-6)
