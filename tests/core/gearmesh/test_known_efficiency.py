"""A mesh whose efficiency is known: other tools' definitions, both ways of power, rest, limits."""

from dataclasses import replace

import numpy as np
import pytest
from kernel_part import Part

from thrustwasher import GearMeshParams, ParameterError, solve_gearmesh
from thrustwasher.gearmesh.parameters import SPEC
from thrustwasher.model.prepare import filled
from thrustwasher.model.registry import kernel_of

from slopes import Unit, disagreement  # isort: skip

DRIVES, BACK = 0.97, 0.95
KNOWN = GearMeshParams(friction_law="efficiency", efficiency=DRIVES, efficiency_back=BACK)
ELASTIC = replace(KNOWN, load_sharing="elastic")
BOTH = pytest.mark.parametrize("params", [KNOWN, ELASTIC], ids=["rigid", "elastic"])
QUADRANTS = pytest.mark.parametrize("speed", [180.0, -180.0])
TORQUE = 40.0
NAMES = [s.name for s in SPEC.outputs if s.kind == "real"]
OF_THE_LOSS = ("friction_torque", "friction_power", "mean_friction", "oil_heat")


def lossy_gear(torque, speed, ratio):
    """Modelica's LossyGear without bearing friction, eta_mf1 and eta_mf2: the torque at flange b.

    Quadrants of torque and speed at flange a; 0 = tau_b + i (tau_a - loss).
    """
    loss = (1.0 - DRIVES) * torque if torque * speed > 0.0 else (1.0 - 1.0 / BACK) * torque
    return -ratio * (torque - loss)


@BOTH
@QUADRANTS
@pytest.mark.parametrize("torque", [TORQUE, -TORQUE])
def test_torques_are_those_of_lossy_gear_in_all_quadrants(params, torque, speed):
    r = solve_gearmesh(params, power=torque * speed, speed=speed)
    wanted = lossy_gear(torque, speed, params.gear_ratio)
    assert -params.gear_ratio * (torque - r.friction_torque) == pytest.approx(wanted, rel=1e-13)
    step = Part("gearmesh", "field", params)
    assert step.step((torque, speed, 299.85)) == 0
    assert step["friction_torque"] == pytest.approx(r.friction_torque, rel=1e-13)


def test_one_efficiency_is_that_of_gearpy_and_simscape_both_ways():
    """The driven gear gets efficiency x ratio x torque of its master, whichever gear that is."""
    params = replace(KNOWN, efficiency_back=0.0)
    drive = solve_gearmesh(params, power=TORQUE * 180.0, speed=180.0)
    left = params.gear_ratio * (TORQUE - drive.friction_torque)
    assert left == pytest.approx(DRIVES * params.gear_ratio * TORQUE, rel=1e-13)
    back = solve_gearmesh(params, power=-TORQUE * 180.0, speed=180.0)
    gear = params.gear_ratio * (TORQUE + back.friction_torque)  # that drives: TORQUE comes out
    assert pytest.approx(DRIVES / params.gear_ratio * gear, rel=1e-13) == TORQUE


def test_the_friction_that_it_means_stands_beside_the_result():
    r = solve_gearmesh(KNOWN, power=7500.0, speed=180.0)
    assert r.mean_friction * r.loss_factor == pytest.approx(1.0 - DRIVES, rel=1e-13)
    same = replace(KNOWN, friction_law="constant", constant_friction=r.mean_friction)
    constant = solve_gearmesh(same, power=7500.0, speed=180.0)
    assert r.friction_power == pytest.approx(constant.friction_power, rel=1e-13)
    assert r.bulk_temperature == pytest.approx(constant.bulk_temperature, rel=1e-13)
    assert any("mean_friction" in line and "f0" in line for line in r.warnings)


def test_at_rest_it_makes_no_torque_and_passes_through_with_one_slope():
    step, found = Part("gearmesh", "field", KNOWN), []
    for speed in (-1e-5, 0.0, 1e-5):
        assert step.step((TORQUE, speed, 299.85)) == 0
        found.append(step["friction_torque"])
    assert found[1] == 0.0 and found[0] == pytest.approx(-found[2], rel=1e-3)


@BOTH
@pytest.mark.parametrize("point", [(40.0, 0.05), (-40.0, 0.05), (40.0, -0.12), (0.03, 0.3)])
def test_derivatives_are_exact_where_the_ways_of_power_blend(params, point):
    kernel = kernel_of(SPEC)
    par = filled(SPEC, params, "field", kernel.NPAR, kernel.derive)
    unit = Unit(kernel, par.copy())
    at = np.array([*point, 320.0])
    worst = disagreement(unit, at, [abs(point[0]), 0.1 * abs(point[1]), 100.0])
    assert worst[[NAMES.index(name) for name in OF_THE_LOSS]].max() < 1e-6


def test_limits_are_said():
    with pytest.raises(ParameterError, match=r"efficiency = 1.02, allowed: 0.01 .. 1"):
        replace(KNOWN, efficiency=1.02)
    with pytest.raises(ParameterError, match=r"efficiency_back = 0.001, allowed: 0 .* locks"):
        replace(KNOWN, efficiency_back=0.001)
    with pytest.raises(ParameterError, match="'mixed' or 'efficiency'"):
        replace(KNOWN, film_heat="atan")
    worm = replace(KNOWN, efficiency=0.4, efficiency_back=0.2)
    assert any(
        "self-locking" in line for line in solve_gearmesh(worm, power=1e3, speed=9.0).warnings
    )
    lossless = replace(KNOWN, efficiency=1.0, efficiency_back=0.0)
    assert solve_gearmesh(lossless, power=7500.0, speed=180.0).friction_power == 0.0
