"""Driveline losses: the laws in their limits, the books, exact derivatives."""

import math

import numpy as np
import pytest
from slopes import Unit, disagreement

from thrustwasher.errors import ParameterError, Status
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.losses.kernels import step as k
from thrustwasher.losses.kernels.loss_laws import (
    bearing_drag,
    churning_constants,
    churning_drag,
    seal_drag,
    starved,
    thinned,
)
from thrustwasher.losses.kernels.skf_friction import skf_drag
from thrustwasher.losses.kernels.skf_series import TABLE
from thrustwasher.losses.loss_ranges import viscosity_ratio
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
    idle = lambda w: bearing_drag(w, nu, 0.0, d, 2.0, 4e-4, 0.0)[0]  # noqa: E731
    n = 3000.0
    by_hand = 1e-7 * 2.0 * (10.0 * n) ** (2.0 / 3.0) * 60.0**3 * 1e-3  # mm2/s, 1/min, mm -> N m
    heated = 1.0 / (1.0 + 1.84e-9 * (n * 60.0) ** 1.28 * 10.0**0.64)
    assert idle(n * math.pi / 30.0) == pytest.approx(by_hand * heated, rel=1e-13)
    assert idle(1.0) == pytest.approx(160e-10 * 2.0 * 60.0**3, rel=0.01)
    loads = [bearing_drag(300.0, nu, p, d, 2.0, 4e-4, 0.0)[0] for p in (0.0, 1e3, 2e3)]
    assert loads[2] - loads[1] == pytest.approx(loads[1] - loads[0], rel=1e-12)


def test_inlet_shear_heating_of_a_cold_bearing():
    """By SKF's factor, 0.54 at 1170 mm2/s, 3450 rpm and 50 mm."""
    factor, _, _ = thinned(3450.0 * math.pi / 30.0, 1170e-6, 0.05, 0.0)
    assert factor == pytest.approx(0.54, abs=0.005)
    cold, none = (
        bearing_drag(3450.0 * math.pi / 30.0, 1170e-6, 0.0, 0.05, 2.0, 0.0, k)[0]
        for k in (starved(3e-8, 3.1, 0.05, 0.45), 0.0)
    )
    assert 0.01 < cold / none < 0.09


def test_starvation_of_a_cold_bearing():
    """By SKF's exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))), here of a 6008 (40/68 mm)."""
    nu, n, bore, outside = 400.0, 3000.0, 40.0, 68.0
    mean = 0.5e-3 * (bore + outside)
    k = starved(6e-8, 3.1, mean, (outside - bore) / (0.5 * (bore + outside)))
    w = n * math.pi / 30.0
    found = thinned(w, nu * 1e-6, mean, k)[0] / thinned(w, nu * 1e-6, mean, 0.0)[0]
    by_hand = math.exp(
        -6e-8 * nu * n * (bore + outside) * math.sqrt(3.1 / (2.0 * (outside - bore)))
    )
    assert found == pytest.approx(by_hand, rel=1e-12)


def test_a_starvation_constant_of_0_leaves_starvation_out():
    cold = {"oil_temperature": 263.15}
    assert solved({"starvation_constant": 0.0}, **cold).bearing_power > solved(**cold).bearing_power


SIZES = (0.16, 0.03, 0.2, 6e-3, 850.0)  # of the default output gear and its oil
AREA, CUBE = 0.08 * 0.03, (0.03 * 0.08**2) ** (1.0 / 3.0)


def churned(w, nu, sizes=SIZES):
    return churning_drag(w, nu, *churning_constants(*sizes), AREA, CUBE)


# Computed apart, from C_m and the wetted surface by hand, with the width over the diameter; the
# papers' own figures were not at hand.
@pytest.mark.parametrize(
    ("speed", "celsius", "torque"),
    [
        (41.0, 80.0, 0.109),
        (70.0, 80.0, 0.168),
        (100.0, 80.0, 0.223),
        (150.0, -20.0, 0.948),
        (240.0, -20.0, 0.961),
        (30.0, 100.0, 0.085),
    ],
)
def test_churning_of_the_default_output_gear(speed, celsius, torque):
    bare = {"output_bearing_count": 0, "output_seal_diameter": 0.0}
    found = solved(bare, output_speed=speed, oil_temperature=celsius + 273.15).output_torque
    assert found == pytest.approx(torque, abs=6e-4)


def test_churning_follows_four_sets():
    """Of Changenet, Leprince, Ville & Velex 2011: by Re, and by omega^2 (b R^2)^(1/3)."""
    slow, fast = (lambda w, nu=nu: churned(w, nu)[0] for nu in (1e-3, 1e-6))
    assert exponent(slow, 10.0, 110.0) == pytest.approx(0.59, rel=1e-12)
    assert exponent(slow, 150.0, 600.0) == pytest.approx(0.03, rel=1e-11)
    assert exponent(fast, 10.0, 110.0) == pytest.approx(0.8, rel=1e-12)
    assert exponent(fast, 150.0, 600.0) == pytest.approx(0.24, rel=1e-12)
    for w in (50.0, 300.0):
        by_nu = exponent(lambda nu, w=w: churned(w, nu)[0], 1e-3, 1e-2)
        assert by_nu == pytest.approx(0.21, rel=1e-12)
        assert churned(w, 1e-6)[0] == churned(w, 2e-6)[0]  # nothing of the oil's thickness
    # by hand, the set for large Re and centrifugal acceleration
    w, half = 200.0, math.acos(0.6)
    wetted = 0.08**2 * (2.0 * half - math.sin(2.0 * half))
    wetted += 0.16 * 0.03 * half * (1.0 + 4.5 / (math.pi * math.cos(math.pi / 9.0)))
    c_m = 3.644 * 0.2**0.1 * (6e-3 / 0.16**3) ** -0.35 * (0.03 / 0.16) ** 0.85
    c_m *= (w * w * 0.08 / 9.80665) ** -0.88
    assert churned(w, 1e-6)[0] == pytest.approx(425.0 * w * w * 0.08**3 * wetted * c_m, rel=1e-13)


@pytest.mark.parametrize("speed", [50.0, 300.0])
def test_both_switches_of_reynolds_are_continuous(speed):
    """Each set's two lines meet near Re = 4000; rounded there, by 0.6 % at most."""
    for re in (2000.0, 3900.0, 4000.0, 4100.0, 8000.0):
        slow = speed * AREA / re
        sharp = max(churned(speed, 1e-3)[0] * (slow / 1e-3) ** 0.21, churned(speed, 1e-6)[0])
        assert sharp * (1.0 - 1e-12) <= churned(speed, slow)[0] <= sharp * 1.006


def test_churning_has_no_kink_over_speed_and_temperature():
    """Slopes are continuous: halving a step halves what they change by, everywhere."""
    found = []
    for n in (400, 800):
        by_speed = np.array([churned(w, 2e-5)[1] for w in np.linspace(20.0, 400.0, n)])
        by_nu = np.array([churned(w, 2e-5)[2] for w in np.linspace(20.0, 400.0, n)])
        oil = np.array([churned(70.0, x)[2] for x in np.geomspace(3e-6, 1e-3, n)])
        found.append([np.abs(np.diff(x)).max() for x in (by_speed, by_nu, oil)])
    coarse, fine = np.array(found)
    assert (fine < 0.7 * coarse).all(), (coarse, fine)


def test_thinner_oil_never_churns_more():
    """The torque of 0.18.0 grew 3.8 times as its oil warmed from 40 to 100 degC."""
    for w in (30.0, 41.0, 70.0, 100.0, 114.0, 130.0, 200.0):
        torques = [
            solved(
                {"output_bearing_count": 0, "output_seal_diameter": 0.0},
                output_speed=w,
                oil_temperature=273.15 + t,
            ).output_torque
            for t in range(-20, 151, 2)
        ]
        assert (np.diff(torques) <= 1e-12).all()


@pytest.mark.parametrize(
    ("speed", "celsius", "regime"),
    [
        (0.0, 80.0, "none"),
        (50.0, 0.0, "viscous"),
        (50.0, 80.0, "inertial"),
        (130.0, 80.0, "between"),
        (150.0, -20.0, "centrifugal_viscous"),
        (240.0, 80.0, "centrifugal_inertial"),
    ],
)
def test_the_regime_of_churning_is_told(speed, celsius, regime):
    r = solved(output_speed=speed, oil_temperature=celsius + 273.15)
    assert r.output_churning_regime == regime
    assert (r.input_churning_regime, r.drum_churning_regime) == ("none", "none")


@pytest.mark.parametrize(
    ("point", "changes", "words"),
    [
        ({"output_speed": 20.0}, {}, "output gear: Froude number 3.26 is below 10"),
        ({"output_speed": 900.0}, {}, "output gear: Froude number 6.61e+03 is above 5000"),
        (
            {"output_speed": 100.0, "oil_temperature": 253.15},
            {},
            "Reynolds number 205 is below 300",
        ),
        (
            {"output_speed": 240.0, "oil_temperature": 253.15},
            {},
            "output bearings: heated and starved, 5.3 % of their viscous torque is left",
        ),
        ({"oil_temperature": 405.0}, {}, "seals: at 131.9 °C their formula falls below 20"),
        ({}, {"output_immersion": 0.05}, "output gear: depth over diameter 0.05 is below 0.1"),
    ],
)
def test_a_law_outside_its_range_is_said(point, changes, words):
    assert any(words in text for text in solved(changes, **point).warnings)
    assert not solved(oil_temperature=313.15).warnings


def test_mixed_friction_is_said_where_palmgrens_law_leaves_it_out():
    """ISO 281: nu_1 = 45000 n^-0.83 d_m^-0.5 below 1000 1/min: 20.5 mm2/s at 668 1/min, 65 mm."""
    said = solved().warnings
    assert len(said) == 1 and said[0].startswith("output bearings: viscosity ratio kappa = 0.43")
    assert 1e6 * viscosity_ratio(1.0, 1.0, 0.065) == pytest.approx(
        1e12 * math.sqrt(65.0) / 45000.0 * (30.0 / math.pi) ** 0.83, rel=1e-12
    )
    by_skf = solved(SKF).warnings  # of the planets' needle bearings
    assert len(by_skf) == 1 and by_skf[0].startswith("planet bearings: viscosity ratio")


SKF = {"bearing_law": "skf", "bearing_series": "62"}
N, NU = 1500.0, 14.0  # 1/min, mm2/s


def skf(series, forces, size=(0.0, 23.2e3), n=N, nu=NU, krs=3e-8, kz=3.1):
    """N mm of a bearing 50/90 mm."""
    starving = starved(krs, kz, 0.07, 40.0 / 70.0)
    row = np.array(TABLE[series][1])
    speed = n * math.pi / 30.0
    return 1e3 * skf_drag(speed, nu * 1e-6, forces, 0.07, starving, row, size, 0.05)[0]


def contacts(g_rr, g_sl, smooth, kz, n=N, nu=NU):
    """M_rr + M_sl [N mm] of SKF's catalogue, of a bearing 50/90 mm in an oil jet."""
    heat = 1.0 / (1.0 + 1.84e-9 * (n * 70.0) ** 1.28 * nu**0.64)
    track = math.exp(-3e-8 * nu * n * (50.0 + 90.0) * math.sqrt(kz / (2.0 * (90.0 - 50.0))))
    weight = math.exp(-2.6e-8 * (n * nu) ** 1.4 * 70.0)
    return heat * track * g_rr * (nu * n) ** 0.6 + g_sl * (weight * 0.12 + (1 - weight) * smooth)


def test_skfs_model_by_hand():
    """A 6210, NU 210 and 30210 under 4 kN and 1.5 kN, by the formulas and constants printed."""
    r, a = 4000.0, 1500.0
    sine = math.sin(math.radians(24.6 * (a / 23.2e3) ** 0.24))
    ball = (
        3.9e-7 * 70.0**1.96 * (r + 1.7 / sine * a) ** 0.54,
        3.23e-3 * 70.0**-0.145 * (r**5 + 36.5 * 70.0**1.5 / sine * a**4) ** (1 / 3),
    )
    assert skf("62", (r, a)) == pytest.approx(contacts(*ball, 0.05, 3.1), rel=1e-12)
    plain = 3.9e-7 * 70.0**1.96 * r**0.54, 3.23e-3 * 70.0**-0.26 * r ** (5 / 3)
    assert skf("62", (r, 0.0)) == pytest.approx(contacts(*plain, 0.05, 3.1), rel=1e-12)
    roller = 1.09e-6 * 70.0**2.41 * r**0.31, 0.16 * 70.0**0.9 * a + 0.0015 * 70.0 * r
    assert skf("NU2", (r, a), kz=5.1) == pytest.approx(contacts(*roller, 0.02, 5.1), rel=1e-12)
    taper = (
        1.76e-6 * 70.0**2.38 * (r + 10.9 * 1.4 * a) ** 0.31,
        0.017 * 70.0**0.82 * (r + 2.0 * 1.4 * a),
    )
    found = skf("302", (r, a), (1.4, 0.0), kz=6.0)
    assert found == pytest.approx(contacts(*taper, 0.002, 6.0), rel=1e-12)
    thrown = 70.0**4 * N * N
    angular = (
        5.03e-7 * 70.0**1.97 * (r + 1.9e-12 * thrown + 1.97 * a) ** 0.54,
        1.3e-2 * 70.0**0.26 * ((r + 1.91e-12 * thrown) ** (4 / 3) + 0.68 * a ** (4 / 3)),
    )
    assert skf("7", (r, a), kz=4.4) == pytest.approx(contacts(*angular, 0.05, 4.4), rel=1e-12)


@pytest.mark.parametrize(
    ("series", "capacity", "mu", "least", "most"),
    [("62", 37.1e3, 0.0015, 0.7, 1.1), ("NU2", 73.5e3, 0.0011, 0.9, 1.5)],
)
@pytest.mark.parametrize(("n", "nu"), [(1500.0, 14.0), (1500.0, 28.0), (3000.0, 10.0)])
def test_skfs_model_beside_its_constant_coefficient(series, capacity, mu, least, most, n, nu):
    """The catalogue's M = mu P d/2, which it gives for P = 0.1 C and good lubrication."""
    constant = 0.5 * mu * 0.1 * capacity * 50.0
    assert least < skf(series, (0.1 * capacity, 0.0), n=n, nu=nu) / constant < most


@pytest.mark.parametrize("series", ["62", "7", "NU2", "302"])
def test_slopes_of_skfs_model(series):
    row, size = np.array(TABLE[series][1]), (1.4, 23.2e3)
    law = lambda w, nu: skf_drag(w, nu, (4e3, 1e3), 0.07, 1e-6, row, size, 0.05)  # noqa: E731
    _, by_speed, by_nu = law(700.0, 14e-6)
    h = 1e-5
    change = law(700.0 * (1 + h), 14e-6)[0] - law(700.0 * (1 - h), 14e-6)[0]
    assert by_speed == pytest.approx(change / (1400.0 * h), rel=1e-7)
    change = law(700.0, 14e-6 * (1 + h))[0] - law(700.0, 14e-6 * (1 - h))[0]
    assert by_nu == pytest.approx(change / (28e-6 * h), rel=1e-7)


def test_bearings_without_constants_are_refused():
    with pytest.raises(ParameterError, match="bearing_series = 'none': SKF's model has no"):
        LossesParams(bearing_law="skf")
    r, plain = solved(SKF), solved()
    assert r.planet_torque == plain.planet_torque and r.bearing_power != plain.bearing_power


def test_thick_oil_at_speed_is_outside_the_verified_range():
    thick = {"oil_temperature": 255.15}
    assert solved(output_speed=100.0, **thick).status == Status.OUTSIDE_VERIFIED
    assert solved(output_speed=5.0, **thick).status == Status.OK  # hardly turns: no matter
    assert solved(DRY, output_speed=100.0, **thick).status == Status.OK


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
    assert cold.bearing_power > 1.5 * warm.bearing_power
    assert cold.seal_power > warm.seal_power
    assert cold.pump_power == warm.pump_power


@pytest.mark.parametrize(
    "inputs",
    [
        [209.4, 70.0, -100.0, 300.0, 2000.0, 353.15],
        [0.0, 0.01, -0.05, 0.0, 0.3, 300.0],
        [90.0, -400.0, 30.0, 5.0, -700.0, 405.0],
        [700.0, 250.0, 180.0, 1.0, 0.0, 262.0],
        [125.0, 160.0, -60.0, 900.0, 400.0, 275.0],
        [60.0, 120.0, 0.0, -300.0, 50.0, 331.0],
    ],
)
@pytest.mark.parametrize("law", [{}, {"bearing_law": "skf", "bearing_series": "NU10"}])
def test_derivatives_are_exact(inputs, law):
    params = LossesParams(input_immersion=0.2, **law)
    unit = Unit(k, filled(SPEC, params, "handbook", k.NPAR, k.derive))
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
    assert np.round(found, 3).tolist() == [113.793, 11.725, 588.124, 46.608]
