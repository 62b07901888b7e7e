"""Oil at the ends of its viscosity law, and beyond.

Hazard: both laws have a pole below which they are nonsense: an iterate that gets there gives an
    infinite viscosity, or one of the wrong sign, and a NaN a line later.
Formula: Roelands: mu = scale 10^(G (1 + T/135)^-S), pole at -135 degC. Vogel: mu = scale exp(b/(T
    + c)), pole at -70 degC.
Cure: the argument of each law stops before its pole; the range that is let in ends long before.
"""

import math

import numpy as np
import pytest

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    ParameterError,
    WasherParams,
    solve_clutch,
    solve_gearmesh,
)
from thrustwasher.gearmesh.kernels.flank_temperature import LOWEST_OIL, oil_viscosity
from thrustwasher.tribology.viscosity import viscosity

from washer_runs import is_sound, solve  # isort: skip

P = WasherParams()
LAW = (P.viscosity_scale, P.viscosity_constant, P.viscosity_exponent)
ENDS = (233.15, 473.15)


def test_roelands_law_is_finite_and_falls_from_any_temperature_on():
    kelvin = np.concatenate((-np.geomspace(1e300, 1e-3, 50), np.geomspace(1e-3, 1e300, 200)))
    found = np.array([viscosity(float(t), *LAW) for t in kelvin])
    assert np.isfinite(found).all()
    assert (np.diff(found[:, 0]) <= 0.0).all() and (found[:, 1] <= 0.0).all()


def test_vogels_law_stops_before_its_pole():
    for kelvin in (-1e9, 0.0, 203.15, 203.15 + 1e-9, LOWEST_OIL):
        assert oil_viscosity(kelvin, 9.7e-5, 755.0, 70.0) == pytest.approx(
            9.7e-5 * math.exp(755.0 / 30.0)
        )


@pytest.mark.parametrize("kelvin", ENDS)
@pytest.mark.parametrize("load", [1.0, 300.0, 3000.0])
def test_the_washer_is_solved_at_both_ends(load, kelvin):
    for speed in (1.0, 545.0):
        assert is_sound(solve(load=load, speed=speed, oil_temperature=kelvin))


@pytest.mark.parametrize("kelvin", ENDS)
def test_mesh_and_pack_are_solved_at_both_ends(kelvin):
    mesh = solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0, oil_temperature=kelvin)
    pack = solve_clutch(ClutchParams(), load=3000.0, speed=20.0, oil_temperature=kelvin)
    assert not mesh.status.is_failure and not pack.status.is_failure
    assert mesh.film_temperature >= kelvin and pack.temperature >= kelvin


def at(kelvin):
    """Return calls that solve washer, pack and mesh in oil of a temperature."""
    return (
        lambda: solve(oil_temperature=kelvin),
        lambda: solve_clutch(ClutchParams(), load=3000.0, speed=20.0, oil_temperature=kelvin),
        lambda: solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0, oil_temperature=kelvin),
    )


@pytest.mark.parametrize(("end", "out"), zip(ENDS, (0.0, 1e9), strict=True))
def test_one_unit_in_the_last_place_outside_is_taken_as_the_end(end, out):
    """Converting units costs that much."""
    for beyond, there in zip(at(math.nextafter(end, out)), at(end), strict=True):
        assert beyond().to_dict() == there().to_dict()


@pytest.mark.parametrize("kelvin", [ENDS[0] * (1.0 - 1e-9), ENDS[1] * (1.0 + 1e-9)])
def test_a_billionth_outside_is_refused_by_name(kelvin):
    for call in at(kelvin):
        with pytest.raises(ParameterError, match="oil_temperature"):
            call()
