"""A gear mesh says what it doubts: teeth, size, load factor, thick films, speed, limits."""

import re
from dataclasses import replace

import pytest

from thrustwasher import GearMeshParams, solve_gearmesh

POINT = {"power": 7500.0, "speed": 180.0}


PAPER, AT_ONE = GearMeshParams.preset("paper"), {"pinion_teeth": 21, "gear_ratio": 43 / 21}
DOUBTS = [
    ({**AT_ONE, "gear_ratio": 2.03}, {}, "42.63 teeth.*42 teeth.*43 teeth", AT_ONE, {}),
    ({"normal_module": 4e-3, "centre_distance": 0.1}, {}, "0.12 m", {"normal_module": 4e-3}, {}),
    ({}, {"oil_temperature": 253.15}, "film_thickness", {}, {"oil_temperature": 283.15}),
    ({}, {"speed": 1300.0}, "m/s at the pitch line", {}, {"speed": 500.0}),
    ({"mean_roughness": 3e-7}, {}, "3e-07 m against .*2.26e-06 m .surface 'r", {}, {}),
    ({"load_share": 0.5}, {}, "load_share = 0.5 has no effect: read by film_heat = atan", {}, {}),
    (
        {"bulk_conductance": 9.0, "lubrication_factor": 1.2},
        {},
        "lubrication_factor = 1.2 has",
        {},
        {},
    ),
    ({}, {"power": 0.0}, "power = 0 W: hardly any load", {}, {}),
    ({}, {"speed": 0.2, "power": 10.0}, "0.2 rad/s: the flanks roll .* takes 0.1 m/s", {}, {}),
    ({}, {"power": 20.0}, "scuffing_safety counts a rise of 1 K.*read scuffing_margin", {}, {}),
    (
        {"fzg_stage": 1, "structural_factor": 0.1},
        {"oil_temperature": 420.0},
        "scuffing_safety = -.*hotter than what scuffs",
        {},
        {},
    ),
]


@pytest.mark.parametrize(("changes", "point", "words", "sound", "near"), DOUBTS)
def test_what_is_doubtful_is_said_and_what_is_sound_is_not(changes, point, words, sound, near):
    warnings = solve_gearmesh(GearMeshParams(**changes), **(POINT | point)).warnings
    assert any(re.search(words, line) for line in warnings), warnings
    assert all("\n" not in line for line in warnings)
    sound = solve_gearmesh(GearMeshParams(**sound), **(POINT | near)).warnings
    assert [line for line in sound if not line.startswith("load F_bt/b")] == []


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
    a, b = (solve_gearmesh(replace(PAPER, load_factor=x), **POINT) for x in (1.0, 2.0))
    assert "load_factor = 2" in b.warnings[0] and not a.warnings
    assert a.contact_pressure_max == b.contact_pressure_max and a.pitting_stress < b.pitting_stress


def test_safeties_name_the_limits_nobody_gave():
    assert solve_gearmesh(GearMeshParams(), **POINT).limits == (
        "contact limit 1500 MPa (assumed, case-hardened), FZG stage 10 (assumed)"
    )
    given = GearMeshParams(contact_limit=1.3e9, fzg_stage=12)
    assert solve_gearmesh(given, **POINT).limits == "contact limit 1300 MPa, FZG stage 12"
