"""Helical teeth whose transverse contact ratio is below 1: their lines of contact never end."""

import math
from dataclasses import replace

import numpy as np
import pytest
from reference_pairs import H951, of_viscosity

from thrustwasher import GearMeshParams, ParameterError, Status, solve_gearmesh
from thrustwasher.gearmesh.kernels import layout as L
from thrustwasher.gearmesh.solve import prepare

LOW = GearMeshParams(**H951, **of_viscosity(46.23e-3, 75.0), permissible_film_ratio=0.1)
POINT = {"power": 31415.9, "speed": 157.08, "oil_temperature": 348.15}
PRINTED = [
    ("contact_ratio", 0.93, 0.005),
    ("overlap_ratio", 1.00, 0.005),
    ("loss_factor", 0.0688, 0.01),  # summed over the lines there
    ("mean_friction", 0.0415, 0.015),
    ("friction_power", 89.68, 0.01),
    ("contact_pressure_max", 1048.6e6, 0.002),
]


@pytest.mark.parametrize(("output", "printed", "within"), PRINTED)
def test_low_loss_gears_beside_an_open_program(output, printed, within):
    assert getattr(solve_gearmesh(LOW, **POINT), output) == pytest.approx(printed, rel=within)


def test_they_lose_less_than_ohlendorf_says():
    approach, recess = path(LOW)
    ohlendorf = (
        math.pi * (1.0 / 38 + 1.0 / 57) * (1.0 - approach - recess + approach**2 + recess**2)
    )
    par = prepare(LOW, "field")
    assert ohlendorf / par[L.D_COS_BASE] == pytest.approx(0.0739, rel=2e-3)  # printed too
    assert par[L.D_LOSS] < 0.95 * ohlendorf / par[L.D_COS_BASE]


def path(params):
    par = prepare(params, "field")
    return par[L.D_APPROACH], par[L.D_RECESS]


def summed(params, phases=800, width=800):
    """Return loss factor and largest share of the load: all lines on a grid, phase by phase."""
    approach, recess = path(params)
    contact, overlap = approach + recess, solve_gearmesh(params, **POINT).overlap_ratio
    along = (np.arange(width) + 0.5) / width * overlap
    moment, most = 0.0, 0.0
    for phase in (np.arange(phases) + 0.5) / phases:
        length, arm = 0.0, 0.0
        for k in range(math.ceil(contact + overlap)):
            at = phase + k - along  # of the line k, from the start of contact
            inside = at[(at > 0.0) & (at < contact)]
            length += len(inside) / width
            arm += np.abs(inside - approach).sum() / width
        moment += arm / length / phases
        most = max(most, 1.0 / length)
    teeth = params.pinion_teeth, params.pinion_teeth * params.gear_ratio
    cos_base = prepare(params, "field")[L.D_COS_BASE]
    around = 2.0 * math.pi * (1.0 / teeth[0] + 1.0 / teeth[1]) / cos_base
    return around * moment, most


@pytest.mark.parametrize("width", [5e-3, 10e-3, 15e-3, 21.24e-3, 33e-3])
def test_loss_and_load_are_those_of_all_lines_on_a_grid(width):
    params = replace(LOW, face_width=width)
    par = prepare(params, "field")
    factor, most = summed(params)
    assert par[L.D_LOSS] == pytest.approx(factor, rel=2e-3)
    n = int(par[L.D_PLACES])
    shares = par[L.D_PATH_SHARE : L.D_PATH_SHARE + n]
    assert max(shares) == pytest.approx(most, rel=0.02)
    assert sum(par[L.D_PATH_LOSS : L.D_PATH_LOSS + n]) == pytest.approx(1.0, rel=1e-12)
    assert solve_gearmesh(params, **POINT).loss_factor == par[L.D_LOSS]


@pytest.mark.parametrize("width", [12e-3, 21.24e-3, 30e-3])
def test_nothing_jumps_at_a_contact_ratio_of_1(width):
    """By the tip of the gear, with overlaps below and above 1."""
    base = replace(LOW, face_width=width)

    def excess(tip):
        return sum(path(replace(base, tip_diameter_gear=tip))) - 1.0

    low, high = H951["tip_diameter_gear"], H951["tip_diameter_gear"] + 0.6e-3
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) < 0.0 else (low, middle)
    step = 1e-9
    below, above = (
        solve_gearmesh(replace(base, tip_diameter_gear=low + d), **POINT) for d in (-step, step)
    )
    assert below.contact_ratio < 1.0 < above.contact_ratio
    for name in (
        "loss_factor",
        "contact_pressure_max",
        "flash_max",
        "pitting_stress",
        "film_thickness",
        "film_ratio_gf",
    ):
        assert getattr(below, name) == pytest.approx(getattr(above, name), rel=1e-5), name


def test_safeties_come_with_one_warning_and_are_never_ok():
    r = solve_gearmesh(LOW, **POINT)
    assert r.status == Status.OUTSIDE_VERIFIED
    (line,) = [w for w in r.warnings if "outside" in w]
    assert "outside ISO 6336" in line and "all safeties" in line
    assert r.pitting_safety > 1.0 and r.micropitting_safety > 0.0
    wide = solve_gearmesh(replace(LOW, tip_diameter_gear=112.4e-3), **POINT)
    assert wide.contact_ratio > 1.0 and wide.status == Status.OK


def test_lines_that_end_are_refused_with_what_cures_it():
    for width in (1.2e-3, 1.5e-3):
        with pytest.raises(ParameterError, match="more face_width"):
            replace(LOW, face_width=width)
    assert replace(LOW, face_width=2e-3).face_width == 2e-3
    with pytest.raises(ParameterError, match="contact ratios from 1 on"):
        replace(LOW, load_sharing="elastic")
    with pytest.raises(ParameterError, match=r"contact ratio is 0\.8256, allowed: 1 and more$"):
        replace(LOW, helix_angle=0.0, tip_diameter_pinion=73.6e-3, tip_diameter_gear=107.6e-3)
