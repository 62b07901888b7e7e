"""The default shift: what pistons, engine and vehicle make of a ring-driven upshift."""

from functools import cache

import numpy as np
import pytest
from scene_runs import NOMINAL, changed, instances, real_shift, shift

from thrustwasher.shift import cosimulate
from thrustwasher.shift.account.shift_record import record_of
from thrustwasher.shift.account.summary import warnings

LONG = [pytest.param(n, marks=pytest.mark.slow) for n in ("planetary-cold", "planetary-downshift")]
SHIFTS = ("planetary", "planetary-transient", "msl", *LONG)


@cache
def half():
    return shift("planetary", step=5e-4)


@pytest.fixture(scope="module")
def run():
    return shift("planetary")


@pytest.fixture(scope="module")
def nominal(tmp_path_factory):
    """Return the shift with profiles that suit its nominal values only."""
    scene = changed(tmp_path_factory.mktemp("nominal"), NOMINAL)
    return cosimulate(scene, instances(scene))


@pytest.mark.parametrize(
    ("which", "torque_phase", "inertia_phase"), [("nominal", 0.182, 0.446), ("run", 0.169, 0.431)]
)
def test_the_phases_are_those_of_the_profiles(which, torque_phase, inertia_phase, request):
    run = request.getfixturevalue(which)
    names = [p.name for p in run.phases]
    assert names == ["first gear", "fill", "torque phase", "inertia phase", "locked"]
    figures = run.figures
    assert figures["filled_time"] == pytest.approx(0.1075, abs=1e-9)
    assert run.phases[1].end == 0.2
    assert figures["torque_phase"] == pytest.approx(torque_phase, abs=0.0057)
    assert figures["inertia_phase"] == pytest.approx(inertia_phase, rel=0.03)


def test_nominal_profiles_make_a_shift_that_an_engineer_would_call_good(nominal):
    assert nominal.figures["torque_hole"] <= 0.1 and nominal.figures["peak_jerk"] <= 20.0


@pytest.mark.parametrize("which", ["nominal", "run"])
def test_a_shift_has_no_tie_up_no_flare_and_sound_teeth(which, request):
    figures = request.getfixturevalue(which).figures
    assert "tie_up_torque" not in figures and figures["flare"] < 0.1
    assert figures["minimum_pitting_safety"] > 1.0 and figures["minimum_scuffing_safety"] > 1.0


def test_heat_and_temperature_of_the_clutch(nominal):
    """As a trial with code of its own gave them: 11.7 kJ, 0.30 J/mm2, 0.83 W/mm2, 79 K, 9.6 %.

    The trial had no thrust bearings, which brake too.
    """
    figures = nominal.figures
    assert figures["slip_energy"] == pytest.approx(11.7e3, rel=0.04)
    assert figures["clutch_heat_per_area"] == pytest.approx(0.30e6, rel=0.04)
    assert figures["peak_clutch_heat_flux"] == pytest.approx(0.856e6, rel=0.03)
    assert figures["peak_clutch_temperature"] - 358.15 == pytest.approx(79.0, rel=0.04)
    assert figures["clutch_viscous_share"] == pytest.approx(0.096, rel=0.04)


def test_first_gear_is_1_514_and_the_book_closes(run):
    s = run.signals
    before = run.time <= 0.3
    ratio = s["transmission.engine_speed"][before] / s["transmission.output_speed"][before]
    assert ratio == pytest.approx(112.0 / 74.0, rel=1e-12)
    assert run.energy["residual_share"] < 1e-12


@pytest.mark.parametrize("name", ["lock_time", "slip_energy", "peak_clutch_temperature"])
def test_half_the_step_moves_lock_up_heat_and_temperature_by_a_thousandth_at_most(run, name):
    assert half().figures[name] == pytest.approx(run.figures[name], rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("name", SHIFTS)
def test_heat_made_is_heat_stored_and_heat_in_the_oil(name):
    r = real_shift(name)
    s, h = r.signals, np.diff(r.time)
    assert r.energy["residual_share"] < 1e-12 and r.figures["lock_time"] is not None
    for part in r.scene.parts.keys() - {"transmission", "losses"}:
        oil, made = (np.sum(s[f"{part}.{n}"][1:] * h) for n in ("oil_heat", "friction_power"))
        if f"{part}.energy" in s:
            made, held = s[f"{part}.energy"][-1], made
            assert held == pytest.approx(made, rel=2e-3)
        assert oil + s[f"{part}.stored_heat"][-1] == pytest.approx(made, rel=1e-9, abs=0.0), part
        if part in ("clutch", "brake"):
            assert r.figures[f"{part}_oil_heat"] == pytest.approx(oil, rel=1e-12)


def test_a_brake_that_holds_makes_no_heat():
    """It starts settled; what it makes later is the drag of the open pack."""
    s, opens = (r := real_shift("planetary")).signals, r.figures["release_time"]
    assert s["brake.energy"][r.time < opens].max() == 0.0
    assert s["brake.film_ratio"][100] == pytest.approx(s["brake.film_ratio"][0], rel=1e-12)


def test_nothing_is_wrong_with_the_default_shift():
    assert warnings(record_of(real_shift("planetary"))) == []


def test_the_ring_mesh_carries_the_suns_load_and_loses_less(run):
    s = run.signals
    for name in ("load", "speed"):
        assert (s[f"ring_mesh.{name}"] == s[f"mesh.{name}"]).all()
    assert 0.1 * s["mesh.friction_power"][50] < s["ring_mesh.friction_power"][50]
    assert s["ring_mesh.friction_power"][50] < 0.8 * s["mesh.friction_power"][50]
    power = 4.0 * sum(np.abs(s[f"transmission.{n}_torque"]) for n in ("mesh", "ring_mesh"))
    lost = np.trapezoid(power * np.abs(s["transmission.mesh_speed"]), run.time)
    assert run.energy["meshes"] == pytest.approx(lost, rel=2e-3)


@pytest.mark.parametrize("step", [1e-3, 2e-3])
def test_the_downshift_is_comfortable(step):
    figures = shift("planetary-downshift", step=step).figures
    assert figures["peak_jerk"] <= 20.0 and figures["flare"] < 5.0
    assert "tie_up_torque" not in figures


def test_half_shafts_swing_at_the_frequency_of_two_inertias():
    r = shift("planetary-shuffle")
    gearbox = r.scene.parts["transmission"].params
    front = gearbox.input_inertia + gearbox.drum_inertia + gearbox.carrier_inertia
    pulse = np.sqrt(gearbox.shaft_stiffness * (1.0 / front + 1.0 / gearbox.vehicle_inertia))
    after = r.time > 1.0
    felt = r.signals["transmission.output_acceleration"][after]
    tops = np.flatnonzero((felt[1:-1] > felt[:-2]) & (felt[1:-1] >= felt[2:]))
    period = np.diff(r.time[after][tops])
    assert np.median(period) == pytest.approx(2.0 * np.pi / pulse, rel=0.03)


def test_cold_oil_makes_the_pack_drag_and_the_same_pressures_misfit(nominal, tmp_path):
    scene = changed(tmp_path, NOMINAL, "planetary-cold")
    cold = cosimulate(scene, instances(scene))
    warm = nominal.figures
    assert cold.figures["clutch_viscous_share"] > 1.5 * warm["clutch_viscous_share"]
    assert cold.figures["brake_heat_per_area"] > 10.0 * warm["brake_heat_per_area"]
    assert any("The brake is let go at" in line for line in cold.found)
    assert "tie_up_torque" in cold.figures and "tie_up_torque" in shift("planetary-cold").figures
