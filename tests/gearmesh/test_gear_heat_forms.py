"""The gear mesh's temperatures and stresses derived again: heat flow, moving bands, groups."""

import math
from itertools import product

import mpmath as mp
import numpy as np
import pytest
from closed_forms.flash_temperature import (
    ELLIPTIC,
    EVEN,
    Body,
    atan_flash,
    blok_flash,
    deep_body_rise,
    even_share,
    film_rise,
    iso_flash,
    pinion_flash,
    sheared_heat,
    surface_rise,
)
from closed_forms.involute_mesh import (
    Mesh,
    flanks_at,
    least_pinion_teeth,
    line_load,
    start_of_contact,
)
from closed_forms.line_contact import (
    LARGEST_ROUGHNESS,
    LEAST_ROUGHNESS,
    compliance,
    full_width,
    iso_mean,
    li_seireg,
    peak_pressure,
)
from closed_forms.thermal_fatigue import (
    CONTACT,
    Endurance,
    allowable_ratio,
    contact_stress,
    grouped_factor,
    modification_factor,
    thermal_stress,
)
from scipy.integrate import quad, solve_ivp

PHI, E, NU, SPEED, POWER, FACE = math.radians(20.0), 205e9, 0.3, 180.0, 7500.0, 0.05
STEEL = Body(compliance(E, NU), 50.2, 7850.0, 475.0)
THETA = 2.0 * STEEL.compliance
SWEEP = [Mesh(m, n, 0.254, PHI) for m, n in product((1.0, 2.0, 4.0, 8.0), (18, 25, 40, 60))]
LOW_CARBON, HIGH_CARBON = Endurance(0.63, 0.77), Endurance(0.53, 0.40)


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

    run = solve_ivp(warming, (0.0, time), np.zeros(240), method="LSODA", lband=1, uband=1,
                    rtol=1e-8, atol=1e-16)  # fmt: skip
    surface = run.y[0, -1] + 1.0 * middle[0] / k
    assert surface == pytest.approx(deep_body_rise(1.0, time, math.sqrt(k * c)), rel=1e-4)


@pytest.mark.parametrize("mesh", SWEEP)
def test_the_four_groups_of_eq_3_are_band_flux_and_time(mesh):
    grouped = atan_flash(mesh, POWER, SPEED, FACE, 0.04, STEEL)
    stepped = pinion_flash(mesh, POWER / SPEED, SPEED, FACE, 0.04, STEEL)
    assert grouped == pytest.approx(stepped, rel=1e-13)


def test_the_flash_rises_with_the_powers_of_torque_speed_size_and_face():
    mesh = SWEEP[5]
    usual = pinion_flash(mesh, 40.0, SPEED, FACE, 0.04, STEEL)
    assert pinion_flash(mesh, 80.0, SPEED, FACE, 0.04, STEEL) / usual == pytest.approx(2**0.75)
    assert pinion_flash(mesh, 40.0, 2 * SPEED, FACE, 0.04, STEEL) / usual == pytest.approx(2**0.5)
    assert pinion_flash(mesh, 40.0, SPEED, 2 * FACE, 0.04, STEEL) / usual == pytest.approx(2**-0.75)
    larger = mesh._replace(centre_distance=0.508)
    assert pinion_flash(larger, 40.0, SPEED, FACE, 0.04, STEEL) / usual == pytest.approx(2**-0.5)


def test_the_flash_is_unbounded_where_contact_starts_on_the_base_circle():
    """x_s^(-3/4): the slow flank stays under the heat ever longer."""
    limit = least_pinion_teeth(2.0, PHI)
    near = [Mesh(2.0, limit * (1.0 + d), 0.254, PHI) for d in (1e-4, 1e-5)]
    rises = [pinion_flash(mesh, 40.0, SPEED, FACE, 0.04, STEEL) for mesh in near]
    places = [start_of_contact(mesh) for mesh in near]
    slope = math.log(rises[1] / rises[0]) / math.log(places[1] / places[0])
    assert slope == pytest.approx(-0.75, abs=0.01)


def band_peak(shape):
    """Return the hottest place of a fast band of heat with the given shape over -1 .. 1."""

    def rise(s):
        return quad(lambda v: 2.0 * shape(s - v * v), 0.0, math.sqrt(s + 1.0), epsabs=1e-11)[0]

    return max(rise(s) for s in np.linspace(0.0, 1.0, 401)) / math.sqrt(math.pi)


def test_bloks_constants_are_the_peaks_of_a_fast_band_of_heat():
    """Flux w/(2a) x shape of mean 1, passed in a/V: the constant is the peak over 2."""
    even = band_peak(lambda u: 1.0)
    elliptic = band_peak(lambda u: 4.0 / math.pi * math.sqrt(max(1.0 - u * u, 0.0)))
    assert even / 2.0 == pytest.approx(EVEN, rel=1e-9)
    assert elliptic / 2.0 == pytest.approx(ELLIPTIC, rel=1e-5)


@pytest.mark.parametrize("mesh", SWEEP)
def test_bloks_temperature_is_eq_3_with_the_heat_divided_evenly(mesh):
    flanks, load, width = contact(mesh)
    share = even_share(flanks.speed_pinion, flanks.speed_gear)
    blok = blok_flash(load, 0.08, flanks.speed_pinion, flanks.speed_gear, width, STEEL.effusivity)
    ours = pinion_flash(mesh, POWER / SPEED, SPEED, FACE, share * 0.08, STEEL)
    assert ours == pytest.approx(blok, rel=1e-13)


def test_evenly_divided_heat_leaves_both_flanks_equally_hot():
    flanks, load, width = contact(SWEEP[6])
    share = even_share(flanks.speed_pinion, flanks.speed_gear)
    flux = 0.08 * load / width * flanks.sliding
    first = deep_body_rise(share * flux, width / flanks.speed_pinion, STEEL.effusivity)
    second = deep_body_rise((1.0 - share) * flux, width / flanks.speed_gear, STEEL.effusivity)
    assert first == pytest.approx(second, rel=1e-13)


@pytest.mark.parametrize("mesh", SWEEP)
def test_the_standards_form_is_bloks_with_elliptic_heat(mesh):
    """0.51 x 1.22 stands for ELLIPTIC (pi/8)^(1/4) = 0.62220."""
    flanks, load, width = contact(mesh)
    blok = blok_flash(load, 0.08, flanks.speed_pinion, flanks.speed_gear, width,
                      STEEL.effusivity, ELLIPTIC)  # fmt: skip
    iso = iso_flash(mesh, POWER / SPEED, SPEED, FACE, 0.08, STEEL)
    rounding = 0.51 * 1.22 / (ELLIPTIC * (math.pi / 8.0) ** 0.25)
    assert rounding == pytest.approx(1.0, abs=2e-5)
    assert iso == pytest.approx(rounding * blok, rel=1e-12)


@pytest.mark.parametrize(("m", "n", "ratio"), [(2.0, 20, 1.67), (2.0, 30, 1.32), (5.0, 20, 1.73)])
def test_half_the_heat_overheats_the_slow_flank(m, n, ratio):
    mesh = Mesh(m, n, 0.254, PHI)
    flanks, load, width = contact(mesh)
    half = pinion_flash(mesh, POWER / SPEED, SPEED, FACE, 0.5 * 0.08, STEEL)
    blok = blok_flash(load, 0.08, flanks.speed_pinion, flanks.speed_gear, width,
                      STEEL.effusivity, ELLIPTIC)  # fmt: skip
    assert half / blok == pytest.approx(ratio, abs=6e-3)


def test_friction_falls_with_the_film_from_dry_to_its_floor():
    assert li_seireg(1e-4, 3e-5, 0.12) == pytest.approx(0.08441831, abs=5e-9)
    assert li_seireg(0.0, 3e-5, 0.12) == 0.12
    floors = [li_seireg(1.0, s, 0.12) for s in (4.5e-5, 1.5e-5)]
    assert floors == pytest.approx([0.0953, 0.0542], abs=6e-5)


def test_the_friction_law_ends_where_its_fall_or_its_decay_changes_sign():
    assert (LEAST_ROUGHNESS, LARGEST_ROUGHNESS) == pytest.approx((7.459e-6, 6.297e-5), rel=1e-4)
    assert li_seireg(1e-4, 1.001 * LARGEST_ROUGHNESS, 0.12) > 0.12
    assert li_seireg(1e-7, 0.999 * LEAST_ROUGHNESS, 0.12) > 0.12


@pytest.mark.parametrize(
    ("m", "roughness", "expected"),
    [(2.0, 0.4e-6, 0.020), (2.0, 1.6e-6, 0.028), (5.0, 0.4e-6, 0.029), (5.0, 1.6e-6, 0.041)],
)
def test_the_standards_mean_friction_is_about_half_to_a_third(m, roughness, expected):
    """Oil at the inlet temperature, Ra 0.4 and 1.6 um."""
    mesh = Mesh(m, 20, 0.254, PHI)
    pole = flanks_at(1.0 / (1.0 + m), mesh, SPEED)
    rolling = pole.speed_pinion + pole.speed_gear
    found = iso_mean(line_load(POWER / SPEED, mesh, FACE), rolling, pole.radius, 0.2386, roughness)
    assert found == pytest.approx(expected, abs=5e-4)
    floor = li_seireg(1.0, 4.5e-5 if roughness > 1e-6 else 1.5e-5, 0.12)
    assert 1.8 < floor / found < 3.5


def test_shear_heat_crosses_into_the_flank_as_an_elliptic_band():
    """Eq 7 beside a fast band of even heat: sqrt(4/pi) = 1.128; of elliptic heat 1.111."""
    heat, speed, width = 500.0, 1.4, 2e-4
    even = deep_body_rise(heat / width, width / speed, STEEL.effusivity)
    found = surface_rise(heat, speed, width, 50.2, 7850.0, 475.0)
    assert found / even == pytest.approx(1.03 / math.sqrt(4.0 / math.pi), rel=1e-12)


@pytest.mark.parametrize("load_factor", [0.5, 2.0])
def test_the_films_own_rise_hardly_depends_on_the_load(load_factor):
    """Leading order 1.14 psi mu V_s^2/(2 k_0): width and film drop out but for powers of 0.003."""
    mu, slide, speed, film, width = 0.2386, 5.78, 1.36, 3e-6, 2e-4

    def rise(b):
        heat = 0.5 * sheared_heat(mu, slide, b, film)
        return film_rise(heat, speed, b, film, 50.2, 7850.0 * 475.0, 0.13, 880.0 * 2010.0)

    assert rise(load_factor * width) == pytest.approx(rise(width), rel=3e-3)
    leading = 1.14 * 0.5 * mu * slide**2 / (2.0 * 0.13)
    assert rise(width) == pytest.approx(leading, rel=0.2)
    surface = [surface_rise(0.5 * sheared_heat(mu, slide, b, film), speed, b, 50.2, 7850.0, 475.0)
               for b in (width, load_factor * width)]  # fmt: skip
    assert surface[1] / surface[0] == pytest.approx(math.sqrt(load_factor), rel=1e-12)


def test_the_printed_contact_constant_is_hertz_for_a_poisson_ratio_of_0_3():
    load, radius = 2.5e4, 0.008
    assert math.sqrt(1.0 / (math.pi * (1.0 - NU**2))) == pytest.approx(0.5914, abs=5e-5)
    exact = peak_pressure(load, radius, THETA)
    assert contact_stress(load, radius, E) / exact == pytest.approx(CONTACT / 0.59143, rel=1e-4)


@pytest.mark.parametrize("mesh", SWEEP)
def test_the_grouped_factor_is_the_square_of_the_stresses(mesh):
    flanks, load, _ = contact(mesh)
    rise = atan_flash(mesh, POWER, SPEED, FACE, 0.4, STEEL)
    stresses = thermal_stress(rise, E, NU, 12e-6), contact_stress(load, flanks.radius, E)
    long = grouped_factor(mesh, POWER, SPEED, FACE, 0.4, HIGH_CARBON, E, NU, 12e-6,
                          STEEL.effusivity)  # fmt: skip
    rounding = (3.0 * math.pi**0.25 * 0.591 / 2.36) ** 2
    assert rounding == pytest.approx(1.000388, abs=1e-6)
    assert long == pytest.approx(rounding * modification_factor(*stresses, HIGH_CARBON), rel=1e-12)


def test_without_the_cosine_in_eq_9_eq_12_would_not_follow():
    """The load is the torque over the *base* radius; over the pitch radius K is 6.4 % larger."""
    mesh = SWEEP[5]
    flanks, load, _ = contact(mesh)
    rise = atan_flash(mesh, POWER, SPEED, FACE, 0.4, STEEL)
    printed = contact_stress(load * math.cos(PHI), flanks.radius, E)
    short = modification_factor(thermal_stress(rise, E, NU, 12e-6), printed, HIGH_CARBON)
    long = grouped_factor(mesh, POWER, SPEED, FACE, 0.4, HIGH_CARBON, E, NU, 12e-6,
                          STEEL.effusivity)  # fmt: skip
    assert max(short / long, long / short) == pytest.approx(1.064, abs=1e-3)


def test_chain_of_stresses_at_numbers_worked_out_apart():
    mesh = Mesh(2.0, 30, 0.254, PHI)
    flanks, load, _ = contact(mesh)
    rise = atan_flash(mesh, POWER, SPEED, FACE, 0.5 * 0.08 * 10.0, STEEL)
    assert rise == pytest.approx(100.7493, abs=1e-4)
    thermal, mechanical = thermal_stress(rise, E, NU, 12e-6), contact_stress(load, flanks.radius, E)
    assert 1e-6 * thermal == pytest.approx(118.0206, abs=1e-4)
    assert 1e-6 * mechanical == pytest.approx(178.2393, abs=1e-4)
    factors = [modification_factor(thermal, mechanical, s) for s in (LOW_CARBON, HIGH_CARBON)]
    assert factors == pytest.approx([0.2934999, 0.7697331], abs=1e-7)
    assert factors[1] / factors[0] == pytest.approx(2.62, abs=5e-3)


def test_the_allowable_ratio_solves_the_criterion():
    """1 = (s_m/(K_m s_u))^2 + (s_t/(K_t s_u))^2 with both stresses grown in proportion."""
    thermal, mechanical, ultimate = 2e8, 3e8, 1.3e9
    ratio = allowable_ratio(modification_factor(thermal, mechanical, HIGH_CARBON))
    grown = ratio * 0.53 * ultimate / mechanical
    total = (grown * mechanical / (0.53 * ultimate)) ** 2 + (
        grown * thermal / (0.4 * ultimate)
    ) ** 2
    assert total == pytest.approx(1.0, rel=1e-13)
    assert mp.almosteq(ratio, 1 / mp.sqrt(1 + (mp.mpf(0.53) * 2 / (mp.mpf(0.4) * 3)) ** 2), 1e-14)
