"""The gear mesh model against closed forms that were derived apart from its kernels."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
import pytest
from closed_forms.flash_temperature import (
    Body,
    atan_flash,
    even_share,
    film_rise,
    pinion_flash,
    sheared_heat,
    surface_rise,
)
from closed_forms.greenwood import real_area_share
from closed_forms.involute_mesh import (
    Flanks,
    Mesh,
    end_of_contact,
    flanks_at,
    least_pinion_teeth,
    line_load,
    loss_factor,
    path_of_contact,
    start_of_contact,
)
from closed_forms.line_contact import (
    compliance,
    dowson_higginson,
    full_width,
    iso_mean,
    li_seireg,
    peak_pressure,
    vogel_viscosity,
)
from closed_forms.thermal_fatigue import (
    Endurance,
    allowable_ratio,
    contact_stress,
    grouped_factor,
    modification_factor,
    thermal_stress,
)

from thrustwasher import GearMeshParams, ParameterError, solve_gearmesh

OIL = 299.85
paper = partial(GearMeshParams.preset, "paper")
SCATTER = {"rough": (2.26e-6, 4.5e-5), "fine": (0.566e-6, 1.5e-5)}
LIMITS = {"aisi1020": Endurance(0.63, 0.77), "aisi4340": Endurance(0.53, 0.40)}
ULTIMATE = {"aisi1020": 434.3e6 / 0.63, "aisi4340": 689.5e6 / 0.53}


def mesh_of(p: GearMeshParams) -> Mesh:
    return Mesh(p.gear_ratio, p.pinion_teeth, p.centre_distance, p.pressure_angle, p.addendum)


def body_of(p: GearMeshParams) -> Body:
    theta = compliance(p.youngs_modulus, p.poisson_ratio)
    return Body(theta, p.conductivity, p.density, p.heat_capacity)


def viscosity(p: GearMeshParams, kelvin: float) -> float:
    return vogel_viscosity(kelvin - 273.15, p.viscosity_scale, p.viscosity_b, p.viscosity_c)


def film(p: GearMeshParams, load: float, flanks: Flanks, mu: float) -> float:
    entrainment = 0.5 * (flanks.speed_pinion + flanks.speed_gear)
    theta = 2.0 * body_of(p).compliance
    return dowson_higginson(load, flanks.radius, theta, mu, entrainment, p.pressure_viscosity)


def contact(p: GearMeshParams, power: float, speed: float) -> tuple[Flanks, float, float]:
    mesh = mesh_of(p)
    flanks = flanks_at(start_of_contact(mesh), mesh, speed)
    load = line_load(p.load_share * power / speed, mesh, p.face_width)
    return flanks, load, full_width(load, flanks.radius, 2.0 * body_of(p).compliance)


def rises(
    p: GearMeshParams, power: float, speed: float, mu: float, h: float
) -> tuple[float, float]:
    """Return the rise of the surface over the bulk and of the film over the surface [K]."""
    flanks, _, width = contact(p, power, speed)
    heat = p.partition_share * sheared_heat(mu, flanks.sliding, width, h)
    solid = p.density * p.heat_capacity
    surface = surface_rise(
        heat, flanks.speed_pinion, width, p.conductivity, p.density, p.heat_capacity
    )
    inside = film_rise(
        heat,
        flanks.speed_pinion,
        width,
        h,
        p.conductivity,
        solid,
        p.oil_conductivity,
        p.oil_density * p.oil_heat_capacity,
    )
    return surface, inside


def cases() -> list[tuple[dict[str, Any], float, float]]:
    """Return random meshes that the model takes, with power and speed."""
    rng, found = np.random.default_rng(5), []
    while len(found) < 60:
        options = {
            "gear_ratio": float(rng.uniform(1.0, 8.0)),
            "pinion_teeth": int(rng.integers(15, 61)),
            "centre_distance": float(rng.uniform(0.05, 0.6)),
            "pressure_angle": math.radians(rng.uniform(17.5, 27.0)),
            "addendum": float(rng.uniform(0.8, 1.15)),
            "face_width": float(rng.uniform(0.01, 0.2)),
            "load_share": float(rng.uniform(0.3, 1.0)),
            "surface": str(rng.choice(["rough", "fine"])),
            "steel": str(rng.choice(["AISI1020", "AISI4340"])),
            "youngs_modulus": float(rng.uniform(1e11, 3e11)),
            "poisson_ratio": float(rng.uniform(0.2, 0.35)),
            "conductivity": float(rng.uniform(20.0, 60.0)),
            "oil_conductivity": float(rng.uniform(0.1, 0.2)),
            "partition_share": float(rng.uniform(0.2, 0.8)),
        }
        try:
            paper(**options)
        except ParameterError:
            continue
        found.append((options, float(rng.uniform(500.0, 5e4)), float(rng.uniform(20.0, 500.0))))
    return found


CASES = cases()
SOME = CASES[::6]


@pytest.mark.parametrize(("options", "power", "speed"), CASES)
def test_geometry_load_and_film_agree(options, power, speed):
    p = paper(**options, viscosity_at="inlet")
    r = solve_gearmesh(p, power=power, speed=speed, oil_temperature=OIL)
    flanks, load, width = contact(p, power, speed)
    theta = 2.0 * body_of(p).compliance
    h = film(p, load, flanks, viscosity(p, OIL))
    expected = {
        "start_of_contact": start_of_contact(mesh_of(p)),
        "contact_ratio": path_of_contact(mesh_of(p)).contact_ratio,
        "sliding_speed": flanks.sliding,
        "slide_roll_ratio": 2.0 * flanks.sliding / (flanks.speed_pinion + flanks.speed_gear),
        "hertz_width": width,
        "hertz_pressure": peak_pressure(load, flanks.radius, theta),
        "contact_stress": contact_stress(load, flanks.radius, p.youngs_modulus),
        "viscosity": viscosity(p, OIL),
        "film_thickness": h,
        "film_ratio": h / SCATTER[p.surface][0],
    }
    assert {n: getattr(r, n) for n in expected} == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("options", "power", "speed"), CASES)
def test_friction_loss_and_temperatures_agree(options, power, speed):
    p = paper(**options, viscosity_at="inlet")
    r = solve_gearmesh(p, power=power, speed=speed, oil_temperature=OIL)
    flanks, load, _ = contact(p, power, speed)
    mu = viscosity(p, OIL)
    h = film(p, load, flanks, mu)
    friction = li_seireg(h / flanks.radius, SCATTER[p.surface][1], p.f0)
    surface, inside = rises(p, power, speed, mu, h)
    torque = p.load_share * power / speed
    flash = pinion_flash(
        mesh_of(p), torque, speed, p.face_width, p.partition_share * friction, body_of(p)
    )
    assert r.friction_coefficient == pytest.approx(friction, rel=1e-12)
    assert r.surface_temperature - OIL == pytest.approx(surface, rel=1e-10)
    assert r.film_temperature - r.surface_temperature == pytest.approx(inside, rel=1e-9)
    assert r.flash_rise == pytest.approx(flash, rel=1e-12)
    if 1.0 <= r.contact_ratio <= 2.0:
        lost = friction * loss_factor(mesh_of(p)) * power
        assert r.friction_power == pytest.approx(lost, rel=1e-12)
    assert r.friction_torque * speed == pytest.approx(r.friction_power, rel=1e-13)


@pytest.mark.parametrize(("options", "power", "speed"), CASES)
def test_the_surface_temperature_solves_its_own_equation(options, power, speed):
    p = paper(**options)
    r = solve_gearmesh(p, power=power, speed=speed, oil_temperature=OIL)
    flanks, load, _ = contact(p, power, speed)
    mu = viscosity(p, r.surface_temperature)
    assert r.film_thickness == pytest.approx(film(p, load, flanks, mu), rel=1e-11)
    surface, inside = rises(p, power, speed, mu, r.film_thickness)
    assert r.surface_temperature - OIL == pytest.approx(surface, rel=1e-9)
    assert r.film_temperature - r.surface_temperature == pytest.approx(inside, rel=1e-9)


@pytest.mark.parametrize(("options", "power", "speed"), CASES)
def test_stresses_of_both_steels_follow_from_the_asperity_temperature(options, power, speed):
    p = paper(**options)
    r = solve_gearmesh(p, power=power, speed=speed, oil_temperature=OIL)
    steel = p.steel.lower()
    stress = thermal_stress(
        r.asperity_temperature - OIL, p.youngs_modulus, p.poisson_ratio, p.thermal_expansion
    )
    factor = modification_factor(stress, r.contact_stress, LIMITS[steel])
    used = math.hypot(r.contact_stress / LIMITS[steel].mechanical, stress / LIMITS[steel].thermal)
    assert r.thermal_stress == pytest.approx(stress, rel=1e-12)
    assert r.modification_factor == pytest.approx(factor, rel=1e-12)
    assert getattr(r, f"modification_factor_{steel}") == r.modification_factor
    assert r.allowable_ratio == pytest.approx(allowable_ratio(factor), rel=1e-12)
    utilization = getattr(r, f"stress_utilization_{steel}")
    assert utilization == pytest.approx(used / ULTIMATE[steel], rel=1e-12)


@pytest.mark.parametrize(("options", "power", "speed"), SOME)
def test_the_literal_reading_is_eq_3_and_eq_12_as_printed(options, power, speed):
    p = GearMeshParams.preset("literal", **{**options, "load_share": 1.0})
    r = solve_gearmesh(p, power=power, speed=speed, oil_temperature=OIL)
    heat = p.partition_share * r.friction_coefficient * 30.0
    rise = atan_flash(mesh_of(p), power, speed, p.face_width, heat, body_of(p))
    assert r.asperity_temperature - OIL == pytest.approx(rise, rel=1e-12)
    for steel, limits in LIMITS.items():
        long = grouped_factor(
            mesh_of(p),
            power,
            speed,
            p.face_width,
            heat,
            limits,
            p.youngs_modulus,
            p.poisson_ratio,
            p.thermal_expansion,
            body_of(p).effusivity,
        )
        rounded = long / (3.0 * math.pi**0.25 * 0.591 / 2.36) ** 2
        assert getattr(r, f"modification_factor_{steel}") == pytest.approx(rounded, rel=1e-11)


@pytest.mark.parametrize(("options", "power", "speed"), SOME)
def test_other_laws_agree_too(options, power, speed):
    p = paper(
        **options,
        friction_law="iso",
        heat_partition="velocity",
        area_law="greenwood-williamson",
        switch="none",
        sigma_rms=3e-6,
    )
    r = solve_gearmesh(p, power=power, speed=speed, oil_temperature=OIL)
    flanks, load, _ = contact(p, power, speed)
    pole = flanks_at(1.0 / (1.0 + p.gear_ratio), mesh_of(p), speed)
    rolling = pole.speed_pinion + pole.speed_gear
    mean = iso_mean(load, rolling, pole.radius, viscosity(p, OIL), 3e-6 / math.sqrt(2.0))
    share = even_share(flanks.speed_pinion, flanks.speed_gear)
    torque = p.load_share * power / speed
    flash = pinion_flash(mesh_of(p), torque, speed, p.face_width, share * mean, body_of(p))
    assert r.friction_coefficient == pytest.approx(mean, rel=1e-12)
    assert r.flash_rise == pytest.approx(flash, rel=1e-12)
    area = 1.0 / real_area_share(r.film_ratio, p.asperity_group)
    if 1.1 < area < 0.9e6:
        assert r.area_ratio == pytest.approx(area, rel=1e-11)


def test_refused_tooth_numbers_are_those_that_interfere():
    for ratio in (1.0, 1.7, 2.0, 5.0, 8.0, 20.0):
        for addendum in (0.8, 1.0, 1.2):
            phi = math.radians(20.0)
            least = math.floor(least_pinion_teeth(ratio, phi, addendum)) + 1
            fits = {"gear_ratio": ratio, "addendum": addendum, "pressure_angle": phi}
            assert paper(**fits, pinion_teeth=least).pinion_teeth == least
            with pytest.raises(
                ParameterError, match=f"pinion_teeth = {least - 1}, allowed: {least}"
            ):
                paper(**fits, pinion_teeth=least - 1)
            mesh = Mesh(ratio, least, 0.254, phi, addendum)
            assert end_of_contact(mesh) < 1.0  # of the two ends the start interferes first
