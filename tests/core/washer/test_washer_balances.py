"""What no two outputs of a solve may contradict: heat, torque, flow and materials, anywhere."""

import numpy as np
import pytest
from sampling import sizes

from thrustwasher import WasherParams, solve_washer
from thrustwasher.errors import Status
from thrustwasher.washer.kernels import layout as L
from thrustwasher.washer.kernels.constants import contact_pair
from thrustwasher.washer.solve import constants

LAWS = {
    "default": WasherParams(),
    "paper": WasherParams.preset("paper"),
    "carrier turns": WasherParams(conduction="rotating", heat_split=0.3),
    "everywhere": WasherParams(conduction="all", heat_split=0.8),
    "liquid alone": WasherParams(cavity_shear="liquid", oil_supply_temperature=330.0),
    "heat kept out": WasherParams(oil_cooling=False, film_heat_fraction=0.6),
    "insulated gear": WasherParams(gear_far_face="insulated"),
    "warm gear": WasherParams(gear_far_face="bulk"),
}
BASE = {"load": 300.0, "speed": 545.0, "tilt": 2e-3}


@sizes(25, 250)
@pytest.mark.parametrize("name", LAWS)
def test_friction_power_reaches_the_oil_at_every_point_of_the_box(name, n):
    rng = np.random.default_rng(11)
    worst = 0.0
    for _ in range(n):
        r = solve_washer(
            LAWS[name],
            load=10.0 ** rng.uniform(0.0, 3.7),
            speed=rng.uniform(-2000.0, 2000.0),
            tilt=rng.uniform(0.0, 4e-3),
            oil_temperature=rng.uniform(240.0, 420.0),
            far_face_temperature=345.0 if name == "warm gear" else 0.0,
        )
        assert r.friction_power == pytest.approx(r.friction_torque * r.speed, rel=1e-14)
        worst = max(worst, abs(r.oil_heat / r.friction_power - 1.0))
    assert worst < (1e-7 if name == "warm gear" else 1e-8)  # whose own heat flows next to it


def test_at_rest_nothing_is_made_and_nothing_flows():
    r = solve_washer(WasherParams(), **{**BASE, "speed": 0.0})
    assert (r.friction_power, r.oil_heat, r.oil_flow) == (0.0, 0.0, 0.0)
    assert r.film_temperature == r.oil_outlet_temperature == r.oil_temperature


def test_without_tilt_no_oil_leaves_and_the_gap_is_full():
    r = solve_washer(WasherParams(), **{**BASE, "tilt": 0.0})
    assert r.status is Status.OK and r.fields().liquid_fraction.min() > 1.0 - 1e-12
    assert r.oil_heat == pytest.approx(r.friction_power, rel=1e-8)


def test_a_hotter_supply_warms_the_film_and_not_the_outer_faces():
    cool, hot = (
        solve_washer(WasherParams(oil_supply_temperature=t), **BASE) for t in (297.15, 337.15)
    )
    assert solve_washer(WasherParams(), **BASE).friction_torque == pytest.approx(
        cool.friction_torque, rel=1e-9
    )
    assert cool.film_temperature + 5.0 < hot.film_temperature < cool.film_temperature + 40.0
    assert hot.friction_torque < cool.friction_torque
    assert hot.oil_heat == pytest.approx(hot.friction_power, rel=1e-8)


def test_values_of_each_body_that_are_equal_are_the_common_ones():
    common = WasherParams(youngs_modulus=1.1e11, conductivity=45.0, yield_strength=6e8)
    own = {
        f"{name}_{body}": getattr(common, name)
        for name in ("youngs_modulus", "poisson_ratio", "yield_strength", "conductivity")
        for body in ("carrier", "washer", "gear")
    }
    at = {**BASE, "load": 900.0, "speed": 136.0}
    one, other = solve_washer(common, **at), solve_washer(WasherParams(**own), **at)
    assert one.friction_torque == other.friction_torque
    assert one.temperature == other.temperature


def test_a_bronze_washer_is_softer_in_both_contacts():
    """1/E' = sum of (1 - nu^2)/E; strength, modulus and Poisson's ratio are the softer body's."""
    bronze = {"youngs_modulus_washer": 1.1e11, "poisson_ratio_washer": 0.34}
    p = WasherParams(**bronze, yield_strength_washer=2.5e8, yield_strength_gear=2e8)
    par = constants(p, (10, 32))
    modulus = 1.0 / ((1.0 - 0.296**2) / 201e9 + (1.0 - 0.34**2) / 1.1e11)
    assert contact_pair(par, L.OF_CARRIER) == pytest.approx((modulus, 1.1e11, 0.34, 2.5e8))
    assert contact_pair(par, L.OF_GEAR) == pytest.approx((modulus, 201e9, 0.296, 2e8))
    at = {**BASE, "load": 1361.0, "speed": 136.0}
    steel = solve_washer(WasherParams(), **at)
    assert solve_washer(p, **at).film_ratio < steel.film_ratio
