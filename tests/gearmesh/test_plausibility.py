"""A gear mesh says what it doubts: teeth, size, load factor, thick films, speed, limits."""

import pytest

from thrustwasher import GearMeshParams, solve_gearmesh

POINT = {"power": 7500.0, "speed": 180.0}


def said(params, **point):
    return solve_gearmesh(params, **(POINT | point)).warnings


def test_half_a_tooth_names_the_ratios_of_whole_ones():
    (line,) = said(GearMeshParams(pinion_teeth=21, gear_ratio=2.03))
    assert "42.63 teeth" in line and "42 teeth" in line and "43 teeth" in line
    assert not said(GearMeshParams(pinion_teeth=21, gear_ratio=43 / 21))


def test_a_centre_distance_that_is_not_that_of_the_teeth_is_named():
    (line,) = said(GearMeshParams(normal_module=4e-3, centre_distance=0.1))
    assert "0.12 m" in line
    assert not said(GearMeshParams(normal_module=4e-3, centre_distance=0.12))
    assert not said(GearMeshParams(centre_distance=0.1))


@pytest.mark.parametrize("internal", [False, True])
def test_a_result_shows_the_size_of_the_pair(internal):
    helix = 0.3 if internal else 0.0
    params = GearMeshParams(
        internal=internal, pinion_teeth=20, gear_ratio=3.0, normal_module=2e-3, helix_angle=helix
    )
    r = solve_gearmesh(params, **POINT)
    apart = r.gear_diameter - r.pinion_diameter if internal else r.gear_diameter + r.pinion_diameter
    assert r.normal_module == pytest.approx(2e-3, rel=1e-14)
    assert 0.5 * apart == pytest.approx(r.centre_distance, rel=1e-14)


def test_the_papers_heat_has_no_load_factor_but_of_the_pitting_stress():
    plain, loaded = (GearMeshParams.preset("paper", load_factor=x) for x in (1.0, 2.0))
    (line,) = said(loaded)
    assert "load_factor = 2" in line and not said(plain)
    a, b = (solve_gearmesh(p, **POINT) for p in (plain, loaded))
    assert a.contact_pressure_max == b.contact_pressure_max and a.pitting_stress < b.pitting_stress


def test_a_film_thicker_than_its_contact_is_no_forecast():
    assert any("film_thickness" in s for s in said(GearMeshParams(), oil_temperature=253.15))
    assert not said(GearMeshParams(), oil_temperature=283.15)


def test_gears_beyond_a_hundred_metres_a_second_are_named():
    assert any("pitch line" in s for s in said(GearMeshParams(), speed=1300.0))
    assert not said(GearMeshParams(), speed=1000.0)


def test_safeties_name_the_limits_nobody_gave():
    assert solve_gearmesh(GearMeshParams(), **POINT).limits == (
        "contact limit 1500 MPa (assumed, case-hardened), FZG stage 10 (assumed)"
    )
    given = GearMeshParams(contact_limit=1.3e9, fzg_stage=12)
    assert solve_gearmesh(given, **POINT).limits == "contact limit 1300 MPa, FZG stage 12"
