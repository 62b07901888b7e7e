"""The clutch as a library: results, ranges, messages."""

from dataclasses import fields

import numpy as np
import pytest

from thrustwasher import run_sweep
from thrustwasher.clutch.engagement import engage_clutch
from thrustwasher.clutch.parameters import SPEC, ClutchParams
from thrustwasher.clutch.solve import boundary_friction, solve_clutch
from thrustwasher.errors import ParameterError, SolveError, Status
from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.part_file import find_part

SIZE = {"inner_radius": 0.064, "outer_radius": 0.085, "faces": 8}
PACK = ClutchParams.preset("paper", **SIZE)
BRIEF = {"interface_temperature": 373.15}
UNCOOLED = ClutchParams.preset("paper", heat_transfer=0.0)


def test_paper_like_sample_has_friction_of_the_paper():
    """0.11 at lock-up, falling with speed; 85 x 65 mm faces."""
    sample = ClutchParams.preset("paper")
    at = {
        n: solve_clutch(sample, load=1000.0, speed=n * np.pi / 30, **BRIEF).friction_coefficient
        for n in (0, 600, 1500, 3000)
    }
    assert at[0] == pytest.approx(0.11, abs=1e-5)
    assert [round(at[n], 4) for n in (600, 1500, 3000)] == [0.0848, 0.0498, 0.0374]


def test_closed_level_has_the_constant_coefficient():
    pack = ClutchParams(constant_friction=0.2, friction_temperature_slope=0.0)
    r = solve_clutch(pack, load=10.0, speed=3.0, fidelity="closed")
    assert r.friction_coefficient == 0.2 and r.fidelity == "closed"


def test_arrays_are_taken_and_a_scalar_stays_a_scalar():
    mu = boundary_friction([[0.1], [0.3]], [0.0, 0.5, 1.0], 0.5)
    assert mu.shape == (2, 3) and mu[0, 1] == boundary_friction(0.1, 0.5, 0.5)
    assert isinstance(boundary_friction(0.1, 0.5), float)


@pytest.mark.parametrize("fidelity", ["closed", "stribeck", "field", "fine"])
@pytest.mark.parametrize("law", ["wang", "constant", "table"])
def test_every_law_on_every_level_changes_with_the_temperature_and_stays_below_its_range(
    law, fidelity
):
    pack = ClutchParams(
        friction_law=law, friction_temperature="slope", friction_temperature_slope=-1e-2
    )
    mu = [
        solve_clutch(pack, load=5e3, speed=0.0, oil_temperature=t, fidelity=fidelity)
        for t in (373.15, 253.15, 473.15, 243.15)
    ]
    warm = np.array([r.friction_coefficient for r in mu])
    assert [len(r.warnings) for r in mu] == [0, 0, 0, 1] and "-20 .. 200" in mu[3].warnings[0]
    assert warm / warm[0] == pytest.approx(np.exp([0.0, 1.2, -1.0, 1.2]), rel=1e-12)


TEXTBOOK = {  # 8 faces, 75/150 mm, uniform wear: the force acts at the mean of both radii
    "faces": 8,
    "inner_radius": 0.0375,
    "outer_radius": 0.075,
    "effective_radius": 0.05625,
}
EVEN = {f"table_friction_{n}": 0.1 for n in range(6)}


@pytest.mark.parametrize("fidelity", ["closed", "stribeck", "field", "fine"])
@pytest.mark.parametrize(
    "law", [{"friction_law": "constant", "constant_friction": 0.1}, EVEN], ids=["constant", "table"]
)
def test_a_coefficient_that_was_given_is_that_of_any_temperature(law, fidelity):
    """mu n F (ro + ri)/2 = 0.1 x 8 x 2650.72 N x 56.25 mm; before 107.35 hot, 128.35 cold."""
    pack = ClutchParams(**TEXTBOOK, **law, **({"constant_friction": 0.1} if law is EVEN else {}))
    for oil, slip in ((253.15, 0.0), (297.15, 0.0), (353.15, 3.0), (453.15, 0.0)):
        r = solve_clutch(pack, load=2650.72, speed=slip, oil_temperature=oil, fidelity=fidelity)
        assert r.torque_capacity == pytest.approx(119.28, abs=0.005)


def test_an_fmu_has_the_coefficient_that_was_given():
    law = {"friction_law": "constant", "constant_friction": 0.1, "starts_pressed": True}
    with DirectInstance(SPEC, parameters={**TEXTBOOK, **law}) as unit:
        for oil in (297.15, 423.15):
            unit.reset()
            unit.initialize(inputs={"load": 2650.72, "oil_temperature": oil})
            unit.step(0.0, 1e-3)
            assert unit.get(["torque_capacity"]) == pytest.approx([119.28], abs=0.005)


@pytest.mark.parametrize(
    ("changes", "fidelity", "law"),
    [
        ({}, "field", "slope"),
        ({}, "closed", ""),
        ({"friction_law": "wang"}, "fine", "slope"),
        ({"friction_law": "wang", "friction_temperature_slope": 0.0}, "field", ""),  # the paper's
        ({"friction_law": "constant"}, "field", ""),
        ({"table_speed_3": 2.1}, "field", ""),
        ({"table_speed_5": 108.0 / 3.6}, "field", "slope"),  # the same in km/h
        ({"table_friction_0": 0.11, "friction_temperature": "slope"}, "field", "slope"),
    ],
)
def test_auto_lets_the_slope_act_on_the_packages_own_numbers_alone(changes, fidelity, law):
    pack = ClutchParams(**changes)
    cold, hot = (
        solve_clutch(pack, load=5e3, speed=0.0, oil_temperature=t, fidelity=fidelity)
        for t in (323.15, 423.15)
    )
    ratio = np.exp(-0.1) if law else 1.0
    assert pack.temperature_law(fidelity) == law
    assert hot.torque_capacity == pytest.approx(ratio * cold.torque_capacity, rel=1e-12)


CONTROLLER = {  # 0.185 at 0 degC, 0.140 at 80 degC: of a transmission's controller
    "friction_temperature": "points",
    "point_temperature_1": 273.15,
    "point_friction_1": 0.185,
    "point_temperature_2": 353.15,
    "point_friction_2": 0.140,
}


@pytest.mark.parametrize("fidelity", ["closed", "field", "fine"])
def test_points_over_temperature_are_the_constant_coefficient(fidelity):
    pack = ClutchParams(friction_law="constant", **CONTROLLER)
    kelvin = np.array([253.15, 273.15, 293.15, 353.15, 423.15])
    found = [
        solve_clutch(pack, load=1e3, speed=0.0, oil_temperature=t, fidelity=fidelity)
        for t in kelvin
    ]
    wanted = np.interp(kelvin, [273.15, 353.15], [0.185, 0.140])
    assert [r.friction_coefficient for r in found] == pytest.approx(wanted, rel=1e-13)
    assert ["known for 0 .. 80 degC" in "".join(r.warnings) for r in found] == [1, 0, 0, 0, 1]


def test_points_change_a_law_over_slip_in_proportion():
    """The law is that of the reference temperature, here 40 degC with 0.1625."""
    plain = ClutchParams(friction_temperature_slope=0.0)
    pack = ClutchParams(**CONTROLLER, reference_temperature=313.15)
    for speed in (0.0, 0.5):
        at = {"load": 1e3, "speed": speed, "oil_temperature": 283.15}
        mu = solve_clutch(pack, **at)
        ratio = np.interp(mu.temperature, [273.15, 353.15], [0.185, 0.140]) / 0.1625
        own = solve_clutch(plain, **at).friction_coefficient
        assert mu.friction_coefficient == pytest.approx(ratio * own, rel=1e-12)


def test_derivatives_over_the_table_keep_the_slope_that_auto_lets_act():
    at = {"load": 9e3, "speed": 0.0, "oil_temperature": 323.15}
    r = solve_clutch(ClutchParams(), **at)
    slope = r.sensitivities(["torque_capacity"], ["table_friction_0"])
    wanted = r.torque_capacity / 0.112
    assert slope["torque_capacity"]["table_friction_0"] == pytest.approx(wanted, rel=1e-8)
    drawn, _ = find_part("clutch").varied({"table_friction_0": 0.1232})
    assert solve_clutch(drawn, **at).torque_capacity == pytest.approx(1.1 * r.torque_capacity)


@pytest.mark.parametrize(
    ("changes", "at", "words"),
    [
        ({"friction_law": "constant", "friction_temperature_slope": -2e-3}, {}, "is not used"),
        ({"friction_law": "constant", **CONTROLLER, "constant_friction": 0.1}, {}, "is not used"),
        ({"friction_law": "wang"}, {}, "0.11 at reference_temperature = 100 °C"),
        ({"heat_transfer": 3e3}, {"speed": 0.1}, "3000 W/(m²·K), 156.7 W/(m²·K) here"),
        ({"heat_transfer": 3e3, "groove_count": 0}, {"speed": 0.1}, "oil_flow"),
        ({"heat_transfer": 3e3, "groove_count": 0, "oil_flow": 0.0}, {"speed": 0.1}, ""),
        ({}, {"speed": 0.1}, ""),
    ],
)
def test_a_number_given_that_another_one_changes_is_named_with_what_counts(changes, at, words):
    """h = 4.86 k (1 - a_l)/(2 d_g) = 176.2, m = rho c Q/(n A) = 738: m (1 - exp(-h/m)) = 156.7."""
    point = {"load": 1e3, "speed": 0.0, "oil_temperature": 323.15, **at}
    told = solve_clutch(ClutchParams(**changes), **point).warnings
    assert len(told) == bool(words) and words in "".join(told)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: boundary_friction(0.0, 0.5), "x = 0.0, allowed"),
        (lambda: boundary_friction(0.1, 1.5), "shear_ratio = 1.5, allowed: 0 .. 1"),
        (lambda: boundary_friction(np.nan, 0.5), "x = nan"),
        (lambda: boundary_friction([0.1, 0.2], [0.1, 0.2, 0.3]), r"shapes \(2,\), \(3,\)"),
        (lambda: boundary_friction("a", 1), "x = 'a', numbers are required"),
        (lambda: boundary_friction(0.1, [[1.0], [0.5, 0.2]]), "shear_ratio = .*numbers are"),
        (lambda: boundary_friction(0.1, 0.5, {}), "plough_weight = {}, numbers are required"),
        (lambda: solve_clutch(UNCOOLED, load=1e3, speed=1.0), "heat_transfer"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(ParameterError, match=message):
        call()


def test_no_load_is_an_open_pack_that_drags_by_its_oil_alone():
    r = solve_clutch(PACK, load=0.0, speed=100.0)
    assert (r.regime, r.film_thickness) == ("film", 8.8e-5) and 0.0 <= r.contact_torque < 1e-20
    assert (
        r.friction_torque == pytest.approx(r.viscous_torque, rel=1e-15) and r.viscous_torque > 0.0
    )
    dry = solve_clutch(PACK, load=0.0, speed=100.0, fidelity="stribeck")
    assert dry.friction_torque == 0.0


@pytest.mark.parametrize("load", [0.0, 500.0, 5898.0])
@pytest.mark.parametrize("speed", [3.0, -40.0, 90.0])
@pytest.mark.parametrize("oil", [250.0, 297.15, 400.0])
def test_the_steady_temperature_balances_cooling_and_friction(load, speed, oil):
    r = solve_clutch(PACK, load=load, speed=speed, oil_temperature=oil)
    area = np.pi * (PACK.outer_radius**2 - PACK.inner_radius**2)
    cooling = PACK.faces * PACK.heat_transfer * area * (r.temperature - oil)
    assert cooling == pytest.approx(r.friction_power, rel=1e-9)
    assert r.friction_torque == pytest.approx(r.contact_torque + r.viscous_torque, rel=1e-15)


def test_the_levels_differ_by_what_they_leave_out():
    at = {"load": 5898.0, "speed": 50.0}
    stribeck, field = (solve_clutch(PACK, **at, fidelity=f) for f in ("stribeck", "field"))
    assert 297.15 < stribeck.temperature == field.temperature
    assert stribeck.friction_torque == field.friction_torque
    sheared = solve_clutch(ClutchParams.preset("paper", friction_data="boundary", **SIZE), **at)
    assert sheared.viscous_torque > 0.0 == field.viscous_torque == stribeck.viscous_torque


def test_slip_that_would_burn_the_pack_has_no_answer_and_a_moment_of_it_has():
    """It was 138 000 degC with film and torque as if nothing were, status OK."""
    at = {"load": 2e5, "speed": 3.0}
    with pytest.raises(SolveError, match=r"load = 200000 N, .* above 600 degC") as caught:
        solve_clutch(ClutchParams(), **at)
    assert "\n" not in str(caught.value)
    burnt = solve_clutch(ClutchParams(), **at, throw=False)
    assert burnt.status is Status.TOO_HOT and burnt.status.is_failure and len(burnt.warnings) == 1
    numbers = [getattr(burnt, f.name) for f in fields(burnt)]
    assert np.isnan([x for x in numbers if isinstance(x, float)]).all()
    table = run_sweep("clutch", {"load": [1e3, 2e5]}, at={"speed": 3.0})
    assert table["status"].tolist() == ["OK", "TOO_HOT"]
    assert np.isnan(table["friction_torque"]).tolist() == [False, True]
    brief = solve_clutch(ClutchParams(), load=9e3, speed=300.0, **BRIEF)
    resting = solve_clutch(ClutchParams(), load=9e3, speed=0.0, oil_temperature=373.15)
    mu = 0.129 + (0.126 - 0.129) * (300.0 * ClutchParams().friction_radius - 8.0) / 22.0
    assert brief.torque_capacity == pytest.approx(resting.torque_capacity * mu / 0.112, rel=1e-12)
    assert brief.temperature == 373.15 and brief.status is Status.OK


def test_an_engagement_goes_on_above_600_degc_and_says_what_its_numbers_are():
    long = {"time": [0.0, 60.0], "load": 9e3, "speed": 100.0}
    found = engage_clutch(ClutchParams(), **long)
    assert found.status is Status.EXTRAPOLATED and np.isfinite(found.friction_torque).all()
    assert sum("no more than an extrapolation" in text for text in found.warnings) == 1


def test_a_run_says_hot_once_and_extrapolated_once_in_warming_up_and_cooling_down():
    told = []
    with DirectInstance(SPEC, parameters={"fidelity": "stribeck", "holding": "off"}) as unit:
        unit.initialize(inputs={"load": 9e3, "speed": 300.0})
        for n in range(400):
            if n == 200:
                unit.set_inputs([1e3, 0.0])
            unit.step(0.05 * n, 0.05)
            told += unit.core.advice()
    assert [text.split(": ")[1] for text in told] == ["HOT", "EXTRAPOLATED"]


def test_an_open_pack_has_no_asperity_torque_and_a_crushed_one_says_so():
    light = solve_clutch(PACK, load=5.0, speed=0.5, oil_temperature=300.0)
    assert light.contact_torque < 1e-12 < light.viscous_torque
    crushed = solve_clutch(ClutchParams(roughness=1e-7, land_share=1.0), load=6000.0, speed=0.01)
    assert crushed.status.name == "OUTSIDE_VERIFIED" and crushed.film_ratio < -3.0


def test_a_measured_curve_is_followed_and_held_beyond_its_end():
    points = {"speed": [0.0, 1.0, 5.0], "friction": [0.10, 0.11, 0.13]}
    rising = ClutchParams.with_table(**points, effective_radius=0.1, friction_temperature_slope=0.0)
    for slip, mu in ((0.0, 0.10), (5.0, 0.105), (-10.0, 0.11), (30.0, 0.12), (4000.0, 0.13)):
        r = solve_clutch(rising, load=1000.0, speed=slip, **BRIEF, fidelity="stribeck")
        assert r.friction_coefficient == pytest.approx(mu, rel=1e-14)


@pytest.mark.parametrize(
    ("speed", "friction", "message"),
    [
        ([0.1, 1.0], [0.1, 0.1], "the first at 0 m/s"),
        ([0.0], [0.1], r"2 \.\. 6 pairs"),
        ([], [], "speed: no values"),
        ([0.0, 1.0], [0.1], "2 and 1 values"),
        ([0.0, 2.0, 1.0], [0.1, 0.1, 0.1], r"table_speed_2 = 1.0 m/s, allowed: above 2.0 m/s"),
        ([0.0, 1.0], [0.1, float("nan")], "table_friction_1 = nan"),
    ],
)
def test_a_curve_that_cannot_be_used_is_refused_by_name(speed, friction, message):
    with pytest.raises(ParameterError, match=message):
        ClutchParams.with_table(speed, friction)


@pytest.mark.parametrize(
    ("changes", "load", "words"),
    [
        ({}, 5500.0, ""),
        ({}, 1e5, "with 12.7 MPa; above 3 MPa an organic lining"),  # 0.18.0 said nothing
        ({"friction_law": "wang"}, 3e4, ""),
        ({"friction_law": "wang"}, 1e5, "above 6 MPa a lining of sintered bronze"),
    ],
)
def test_a_lining_bears_so_much(changes, load, words):
    params = ClutchParams(**changes)
    solved = solve_clutch(params, load=load, speed=0.0, oil_temperature=350.0).warnings
    told = " ".join(solved)
    assert ("does not last" in told) == bool(words) and words in told
