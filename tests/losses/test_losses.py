"""Driveline losses: the laws in their limits, the books, exact derivatives."""

import math

import numpy as np
import pytest
from slopes import Unit, disagreement

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.losses.kernels import step as k
from thrustwasher.losses.kernels.loss_laws import (
    bearing_drag,
    churning_constants,
    churning_drag,
    seal_drag,
)
from thrustwasher.losses.parameters import SPEC, LossesParams
from thrustwasher.losses.solve import solve_losses
from thrustwasher.model.prepare import filled

POINT = {
    "input_speed": 209.4,
    "output_speed": 70.0,
    "drum_speed": -100.0,
    "planet_speed": 300.0,
    "tooth_force": 2000.0,
    "oil_temperature": 353.15,
}
NAMES = ("input", "output", "drum", "planet")
POWERS = ("bearing_power", "churning_power", "pump_power", "seal_power")
DRY = {"input_immersion": 0.0, "output_immersion": 0.0, "drum_immersion": 0.0}
NO_SEALS = {"input_seal_diameter": 0.0, "output_seal_diameter": 0.0, "drum_seal_diameter": 0.0}
NO_BEARINGS = {"input_bearing_count": 0, "output_bearing_count": 0, "drum_bearing_count": 0}
NO_PUMP = {"pump_displacement": 0.0}


def solved(changes=None, **point):
    return solve_losses(LossesParams(**(changes or {})), **{**POINT, **point})


def exponent(law, a, b):
    """Return the power of its argument with which a law grows from a to b."""
    return math.log(law(b) / law(a)) / math.log(b / a)


@pytest.mark.parametrize("turn", [1.0, -1.0, 1e-4])
def test_torque_times_speed_is_heat(turn):
    point = {**POINT, **{f"{n}_speed": POINT[f"{n}_speed"] * turn for n in NAMES}}
    r = solved({"planets": 3}, **point)
    counts = {"planet": 3}
    work = sum(counts.get(n, 1) * getattr(r, f"{n}_torque") * point[f"{n}_speed"] for n in NAMES)
    assert work == pytest.approx(r.oil_heat, rel=1e-14)
    assert sum(getattr(r, name) for name in POWERS) == pytest.approx(r.oil_heat, rel=1e-14)
    assert min(getattr(r, name) for name in POWERS) >= 0.0


def test_at_rest_there_is_nothing():
    r = solved(**{f"{n}_speed": 0.0 for n in NAMES})
    found = [getattr(r, f"{n}_torque") for n in NAMES] + [getattr(r, n) for n in POWERS]
    assert found == [0.0] * 8


@pytest.mark.parametrize("name", NAMES)
def test_a_torque_turns_with_its_own_speed_alone(name):
    there, back = solved(), solved(**{f"{name}_speed": -POINT[f"{name}_speed"]})
    for n in NAMES:
        sign = -1.0 if n == name else 1.0
        assert getattr(back, f"{n}_torque") == sign * getattr(there, f"{n}_torque")
    assert back.oil_heat == there.oil_heat


def test_a_pump_takes_displacement_times_pressure():
    bare = DRY | NO_SEALS | NO_BEARINGS
    r = solved(bare | {"pump_efficiency": 0.8, "pump_displacement": 2e-5, "line_pressure": 5e5})
    assert r.input_torque == pytest.approx(2e-5 * 5e5 / (2.0 * math.pi * 0.8), rel=1e-13)
    assert (r.output_torque, r.drum_torque) == (0.0, 0.0)


def test_planet_bearings_bear_twice_the_tooth_force():
    loaded, idle = solved(tooth_force=-3000.0), solved(tooth_force=0.0)
    more = loaded.planet_torque - idle.planet_torque
    assert more == pytest.approx(0.001 * 2.0 * 3000.0 * 0.018, rel=1e-12)
    split = solved({"planet_bearing_count": 2}, tooth_force=-3000.0)
    assert split.planet_torque - 2.0 * idle.planet_torque == pytest.approx(more, rel=1e-12)


def test_a_bearing_follows_palmgren():
    nu, d = 10e-6, 0.06
    idle = lambda w: bearing_drag(w, nu, 0.0, d, 2.0, 4e-4)[0]  # noqa: E731
    n = 3000.0
    by_hand = 1e-7 * 2.0 * (10.0 * n) ** (2.0 / 3.0) * 60.0**3 * 1e-3  # mm2/s, 1/min, mm -> N m
    assert idle(n * math.pi / 30.0) == pytest.approx(by_hand, rel=1e-13)
    assert exponent(idle, 50.0, 500.0) == pytest.approx(2.0 / 3.0, rel=1e-13)
    assert idle(1.0) == idle(2.0) == pytest.approx(160e-10 * 2.0 * 60.0**3, rel=0.01)
    loads = [bearing_drag(300.0, nu, p, d, 2.0, 4e-4)[0] for p in (0.0, 1e3, 2e3)]
    assert loads[2] - loads[1] == pytest.approx(loads[1] - loads[0], rel=1e-12)


def test_churning_follows_changenet_and_velex():
    sizes = (0.16, 0.03, 0.1, 6e-3, 850.0)
    slow, fast = churning_constants(*sizes)
    torque = lambda w, nu: churning_drag(w, nu, slow, fast, 0.08 * 0.03)[0]  # noqa: E731
    assert exponent(lambda w: torque(w, 1e-4), 10.0, 200.0) == pytest.approx(0.59, rel=1e-12)
    assert exponent(lambda nu: torque(50.0, nu), 1e-4, 1e-3) == pytest.approx(0.21, rel=1e-12)
    assert exponent(lambda w: torque(w, 1e-6), 10.0, 200.0) == pytest.approx(0.24, rel=1e-12)
    assert torque(100.0, 1e-6) == torque(100.0, 2e-6)  # nothing of the oil's thickness
    # by hand, from C_m at Re above 9000
    w, half = 200.0, math.acos(0.8)
    wetted = 0.08**2 * (2.0 * half - math.sin(2.0 * half))
    wetted += 0.16 * 0.03 * half * (1.0 + 4.5 / (math.pi * math.cos(math.pi / 9.0)))
    c_m = 3.644 * 0.1**0.1 * (6e-3 / 0.16**3) ** -0.35 * (0.03 / 0.16) ** 0.85
    c_m *= (w * w * 0.08 / 9.80665) ** -0.88
    assert torque(w, 1e-6) == pytest.approx(425.0 * w * w * 0.08**3 * wetted * c_m, rel=1e-13)


def test_churning_goes_smoothly_from_one_regime_to_the_other():
    slow, fast = churning_constants(0.16, 0.03, 0.1, 6e-3, 850.0)
    area, nu = 0.08 * 0.03, 1e-5
    for reynolds in (6000.0, 9000.0):
        w = reynolds * nu / area
        below, above = (churning_drag(w * x, nu, slow, fast, area) for x in (1 - 1e-9, 1 + 1e-9))
        slopes = (below[0], below[0] / w, below[0] / nu)  # sizes of value and slopes
        assert np.abs(np.subtract(below, above) / slopes).max() < 1e-6


def test_a_gear_above_the_oil_churns_none():
    assert churning_constants(0.16, 0.03, 0.0, 6e-3, 850.0) == (0.0, 0.0)
    assert solved(DRY).churning_power == 0.0


def test_a_seal_follows_its_formula_to_a_least_value():
    power = (145.0 - 1.6 * 80.0 + 350.0 * math.log10(math.log10(32.8))) * 1e-7 * 50.0**2 * 2000.0
    torque, slope = seal_drag(353.15, 32e-6, 0.05)
    assert torque * 2000.0 * math.pi / 30.0 == pytest.approx(power, rel=1e-13)
    assert slope < 0.0
    assert seal_drag(470.0, 2e-6, 0.05) == (pytest.approx(30.0 / math.pi * 0.1 * 0.05**2 * 20.0), 0)


def test_cold_oil_costs_more():
    cold, warm = (solved(oil_temperature=t) for t in (273.15, 373.15))
    assert cold.bearing_power > 2.0 * warm.bearing_power
    assert cold.seal_power > warm.seal_power
    assert cold.pump_power == warm.pump_power


@pytest.mark.parametrize(
    "inputs",
    [
        [209.4, 70.0, -100.0, 300.0, 2000.0, 353.15],
        [0.0, 0.01, -0.05, 0.0, 0.3, 300.0],
        [90.0, -400.0, 30.0, 5.0, -700.0, 405.0],
        [700.0, 250.0, 180.0, 1.0, 0.0, 262.0],
    ],
)
def test_derivatives_are_exact(inputs):
    unit = Unit(k, filled(SPEC, LossesParams(input_immersion=0.2), "handbook", k.NPAR, k.derive))
    scale = [max(abs(x), 0.1) * 0.1 for x in inputs]
    assert disagreement(unit, inputs, scale).max() < 1e-7


def test_oil_energy_is_all_heat_whatever_the_steps():
    found = []
    for steps in ([1.0], [0.5, 0.25, 0.25], [1e-6, 0.999999]):
        with DirectInstance(SPEC) as one:
            one.initialize(0.0, POINT)
            t = 0.0
            for h in steps:
                one.step(t, h)
                t += h
            found.append(dict(zip(one.output_names, one.outputs(), strict=True)))
    assert [f["oil_energy"] for f in found] == pytest.approx([solved().oil_heat] * 3, rel=1e-13)


def test_one_golden_point():
    r = solved()
    found = [r.bearing_power, r.churning_power, r.pump_power, r.seal_power]
    assert np.round(found, 3).tolist() == [114.396, 32.252, 588.124, 46.608]
