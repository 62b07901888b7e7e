"""The default shift: what pistons, engine and vehicle make of a ring-driven upshift."""

import math
from functools import cache

import numpy as np
import pytest
from closed_forms.lock_up import speed_against_quadratic_load
from scene_runs import (
    NO_DRAG,
    NOMINAL,
    changed,
    default_shift,
    instances,
    real_shift,
    shift,
    slow_without_jit,
)

from thrustwasher.shift import cosimulate, load_scene
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


@pytest.mark.slow
def test_cold_oil_makes_the_pack_drag_and_the_same_pressures_misfit(nominal, tmp_path):
    scene = changed(tmp_path, NOMINAL, "planetary-cold")
    cold = cosimulate(scene, instances(scene))
    warm = nominal.figures
    assert cold.figures["clutch_viscous_share"] > 1.5 * warm["clutch_viscous_share"]
    assert cold.figures["brake_heat_per_area"] > 10.0 * warm["brake_heat_per_area"]
    assert any("The brake is let go at" in line for line in cold.found)
    assert "tie_up_torque" in cold.figures and "tie_up_torque" in shift("planetary-cold").figures


# The default shift: expected magnitudes, the energy balance, and independence of the step.

# Settled film, no drag: ramp -> lock after ramp start [s], at [rad/s]; engine work, load work,
# kinetic and clutch heat [kJ] until lock-up; per face [MJ/m2].
EXPECTED = {
    "0.1 s": (1.465, 98.98, 63.7, 44.1, -22.7, 42.2, 0.54),
    "0.3 s": (1.649, 98.83, 73.5, 50.3, -22.8, 46.0, 0.59),
    "0.5 s": (1.831, 98.67, 83.3, 56.5, -23.0, 49.8, 0.63),
}

SETTLED = {pack: {"fidelity": "stribeck"} for pack in ("clutch", "brake")}


@pytest.mark.parametrize("ramp", list(EXPECTED))
def test_shifts_without_drag_have_the_expected_magnitudes(ramp, tmp_path):
    scene = tmp_path / "ramp.toml"
    scene.write_text(f'base = "planetary-sun"\nshift.duration = "{ramp}"', "utf-8")
    r = shift(scene, parts=SETTLED | NO_DRAG, stop_time=2.4)
    after, speed, engine, load, kinetic, heat, per_area = EXPECTED[ramp]
    assert r.figures["lock_after_ramp_start"] == pytest.approx(after, abs=6e-4)
    assert r.figures["lock_speed"] == pytest.approx(speed, abs=6e-3)
    i = int(np.searchsorted(r.time, r.figures["lock_time"]))
    at_lock = [
        r.signals[f"transmission.{n}"][i] / 1e3
        for n in ("engine_work", "load_work", "kinetic_change", "clutch_heat")
    ]
    # Read at the end of the step of the lock-up: up to 1 ms x 15 kW of engine work later.
    assert at_lock == pytest.approx([engine, load, kinetic, heat], abs=0.07)
    assert r.figures["slip_energy_per_area"] / 1e6 == pytest.approx(per_area, abs=6e-3)
    assert 0.0 < r.energy["brake"] < 1.0
    assert r.figures["friction_lock"] == pytest.approx(0.11, abs=1e-5)
    assert "tie_up_heat" not in r.figures  # without shear they hand over cleanly


@pytest.mark.slow
def test_a_moving_film_shifts_sooner_because_its_oil_resists():
    """Shear of the oil carries a good part of the torque, more so when it is cold."""
    cold, hot = default_shift(), shift("planetary-hot-oil", parts=NO_DRAG)
    settled = shift("planetary-sun", parts=SETTLED | NO_DRAG, stop_time=2.2)
    after = [r.figures["lock_after_ramp_start"] for r in (cold, hot, settled)]
    assert after == sorted(after) and after[0] < 0.5 * after[2]
    open_drag = cold.signals["clutch.viscous_torque"][0]
    assert 2.0 < open_drag < 10.0


@pytest.mark.slow
def test_least_film_ratios_do_not_hang_on_where_samples_lie():
    """Film vanishes with speed: counted above a speed, and read at that speed, it is a figure."""
    coarse, fine = (shift("planetary-sun", step=h) for h in (1e-3, 5e-4))
    value = coarse.figures["minimum_mesh_film_ratio"]
    assert value == pytest.approx(fine.figures["minimum_mesh_film_ratio"], rel=5e-3)
    assert value > 1.2 * np.min(coarse.signals["mesh.film_ratio"])
    texts = {f.name: f.text for f in coarse.key_figures}
    assert "above 10 rad/s" in texts["minimum_mesh_film_ratio"]


def test_cold_oil_makes_both_packs_work_against_each_other():
    r = default_shift()
    f, s, t = r.figures, r.signals, r.time
    begin = {k.name: k.time for k in r.key_figures}["tie_up_duration"]
    end = begin + f["tie_up_duration"]
    assert 0.1 < begin < f["release_time"] < end == pytest.approx(0.4, abs=1.1e-3)
    during, torque = (t > begin) & (t < end), s["transmission.brake_reaction"]
    assert torque[0] < -250.0 and (torque[during] > 0.0).all() and f["tie_up_torque"] > 250.0
    power = (torque * s["transmission.brake_speed"])[during]
    assert f["tie_up_heat"] == pytest.approx(np.sum(power) * 1e-3, rel=5e-3)
    i = np.searchsorted(t, begin)
    assert s["clutch.viscous_torque"][i] > 0.9 * s["clutch.friction_torque"][i]


def test_coupling_difference_shrinks_with_the_square_of_the_step():
    coarse, fine = (
        shift("planetary-sun", step=h).energy["coupling_difference_share"] for h in (4e-3, 5e-4)
    )
    assert np.log(coarse / fine) / np.log(8.0) == pytest.approx(2.0, abs=0.15)


def test_the_washer_gets_what_the_planets_give():
    s = default_shift().signals
    for name in ("load", "speed", "tilt"):
        sent, used = s[f"transmission.washer_{name}"], s[f"washer.{name}"]
        assert (used[1:] == sent[:-1]).all()
    assert (s["washer.oil_temperature"] == 297.15).all()
    assert (s["transmission.washer_torque"][1:] == s["washer.friction_torque"][1:]).all()


@pytest.mark.slow
@slow_without_jit
def test_plain_torque_loop_finds_the_same_shift_at_small_steps():
    """Coupling torque needs steps below 2 w0 J/T; it creeps instead of sticking."""
    smoothing = 1.0
    limit = 2.0 * smoothing * 0.1157 / 389.0
    packs = {pack: {**given, "speed_smoothing": smoothing} for pack, given in SETTLED.items()}
    held = {**packs, **NO_DRAG, "transmission": {"washers": 0, "coupling": "torque"}}
    r = shift("planetary-sun", parts=held, step=0.5 * limit, stop_time=1.9)
    reference = shift("planetary-sun", parts=SETTLED | NO_DRAG, stop_time=1.9)
    assert r.figures["slip_energy"] == pytest.approx(reference.figures["slip_energy"], rel=2e-3)
    assert 0.0 < abs(r.signals["transmission.clutch_speed"][-1]) < smoothing
    assert r.energy["residual_share"] < 1e-9


# The Modelica Standard Library's gear shift: known events, order of convergence, drum inertia.
#
# Event-driven reference at tolerance 1e-11: lock at 2.1107904 s, 5.0425032 rad/s.

LOCK_TIME, LOCK_SPEED = 2.1107904, 5.0425032
MASTERS = ["gauss-seidel", "jacobi"]


def test_engine_speed_in_first_gear_is_the_closed_form():
    r = shift("msl", stop_time=2.0)
    exact = speed_against_quadratic_load(1.5, 20.0, 20.0, 10.471975512, 1.0, 10.0, 2.5)
    assert exact == pytest.approx(11.2486219248636, abs=1e-11)
    assert r.signals["transmission.engine_speed"][-1] == pytest.approx(exact, rel=1e-9)


@pytest.mark.parametrize("master", MASTERS)
def test_four_digits_at_1_ms(master):
    f = shift("msl", stop_time=2.3, master=master).figures
    assert f["lock_time"] == pytest.approx(LOCK_TIME, rel=1e-4)
    assert f["lock_speed"] == pytest.approx(LOCK_SPEED, rel=1e-4)


@pytest.mark.slow
@slow_without_jit
@pytest.mark.parametrize("master", MASTERS)
def test_five_digits_at_0_1_ms(master):
    f = shift("msl", stop_time=2.2, master=master, step=1e-4).figures
    assert f["lock_time"] == pytest.approx(LOCK_TIME, rel=1e-6)
    assert f["lock_speed"] == pytest.approx(LOCK_SPEED, rel=1e-5)


@pytest.mark.parametrize("master", MASTERS)
@pytest.mark.parametrize(("extrapolated", "order"), [(True, 2.0), (False, 1.0)])
@pytest.mark.slow
def test_lock_time_converges_with_the_order_of_the_capacities(master, extrapolated, order):
    """Held capacities are late by part of a step; extrapolated ones leave a second-order error."""
    gearbox = {"capacity_extrapolation": extrapolated, "torque_age": int(master == "jacobi")}
    options = {"stop_time": 2.2, "master": master, "parts": {"transmission": gearbox}}
    runs = [shift("msl", step=h, **options) for h in (4e-3, 2e-3, 1e-3)]
    errors = np.abs([r.figures["lock_time"] - 2.11079036 for r in runs])
    found = np.log2(errors[:-1] / errors[1:])
    assert found == pytest.approx([order, order], abs=0.1)


@pytest.mark.slow
@slow_without_jit
def test_drum_inertia_delays_the_lock_up_in_proportion():
    """First order in J_r: + 0.0257 s and - 0.419 rad/s per kg m2."""
    base = shift("msl", stop_time=2.2).figures
    for inertia in (0.005, 0.02):
        drum = {"transmission": {"drum_inertia": inertia}}
        f = shift("msl", stop_time=2.2, parts=drum).figures
        assert (f["lock_time"] - base["lock_time"]) / inertia == pytest.approx(0.0257, rel=0.03)
        assert (f["lock_speed"] - base["lock_speed"]) / inertia == pytest.approx(-0.419, rel=0.03)


def test_events_come_in_order_and_the_book_closes():
    r = shift("msl")
    kinds = [e.kind for e in r.events]
    assert kinds == ["ramp_start", "brake_released", "ramp_end", "clutch_locked"]
    assert [p.name for p in r.phases] == ["first gear", "torque phase", "inertia phase", "locked"]
    assert r.energy["residual_share"] < 1e-12
    assert r.energy["coupling_difference_share"] < 1e-3
    assert r.signals["transmission.clutch_speed"][-1] == 0.0
    assert r.signals["transmission.output_speed"][-1] < math.sqrt(20.0 / 20.0) * 10.471975512


# A brake alone on one inertia: the braking case of Wang, Wei & Wu (2012), Tables 1 and 2.

SCENES = {"brake-test": 30.0, "brake-test-sample": 0.036}
START = 3000.0 * math.pi / 30.0


def effective_inertia(params):
    """Return what the ring drags along: sun and carrier turn freely and share one reaction.

    With tau in the sun's teeth: J_s w_s' = -tau, J_c w_c' = (1 + r) tau, and w_s' + r w_r' =
    (1 + r) w_c' give tau = r w_r'/(1/J_s + (1 + r)^2/J_c); the ring then feels r tau.
    """
    r = params.ratio
    both = 1.0 / (1.0 / params.input_inertia + (1.0 + r) ** 2 / params.carrier_inertia)
    return params.drum_inertia + r * r * both


@pytest.mark.parametrize(("name", "inertia"), SCENES.items())
def test_the_ring_has_the_inertia_that_is_stated(name, inertia):
    params = load_scene(name).parts["transmission"].params
    assert effective_inertia(params) == pytest.approx(inertia, rel=1e-12)


@pytest.mark.parametrize(("name", "inertia"), SCENES.items())
def test_brake_heat_is_the_kinetic_energy_of_the_ring(name, inertia):
    r = shift(name)
    assert r.energy["brake"] == pytest.approx(0.5 * inertia * START**2, rel=1e-11)
    assert r.figures["stopped_inertia"] == pytest.approx(inertia, rel=1e-11)
    assert r.energy["residual_share"] <= 1e-12
    assert r.energy["brake_coupling_difference_share"] <= 1e-3
    assert r.energy["clutch"] == 0.0 and r.energy["engine_work"] == 0.0


@pytest.mark.parametrize("name", SCENES)
def test_the_momentum_of_sun_and_carrier_is_kept(name):
    """(1 + r) J_s w_s + J_c w_c sees no torque of the ring; it stays as it was at the start."""
    r = shift(name)
    p, s = r.scene.parts["transmission"].params, r.signals
    ratio = p.ratio
    kept = (1.0 + ratio) * p.input_inertia * s["transmission.engine_speed"]
    kept = kept + p.carrier_inertia * s["transmission.output_speed"]
    assert kept == pytest.approx(kept[0], rel=1e-11)


@pytest.mark.parametrize("name", SCENES)
def test_force_is_1_mpa_and_the_speed_law_keeps_friction_over_rpm(name):
    scene = load_scene(name)
    brake, default = scene.parts["brake"].params, load_scene("planetary-sun").parts["brake"].params
    force = 1e6 * brake.lining_area / brake.faces
    assert scene.parts["transmission"].params.brake_force == pytest.approx(force, rel=1e-6)
    sample = load_scene("brake-test-sample").parts["brake"].params
    scale = brake.friction_radius / sample.friction_radius
    assert brake.stick_speed == pytest.approx(default.stick_speed * scale, rel=1e-4)
    assert brake.decay_speed == pytest.approx(default.decay_speed * scale, rel=1e-4)


def test_faces_are_the_nearest_whole_number():
    brake = load_scene("brake-test").parts["brake"].params
    torque = 30.0 * START / 1.2
    per_face = 0.053 * 1e6 * brake.lining_area / brake.faces * brake.friction_radius
    assert torque / per_face == pytest.approx(15.3, abs=0.01)
    assert brake.faces == round(torque / per_face)


def test_the_sample_brakes_as_published():
    figures = shift("brake-test-sample").figures
    for said in shift("brake-test-sample").comparison():
        if said["name"] != "stopped_inertia":
            assert said["run"] == pytest.approx(said["published"], rel=5e-3), said["name"]
    assert figures["lock_after_half_ramp"] == pytest.approx(1.2, abs=1e-3)


def test_the_full_size_pack_brakes_as_long_as_its_faces_say():
    figures = shift("brake-test").figures
    assert figures["lock_after_half_ramp"] == pytest.approx(1.2 * 15.3 / 15, rel=2e-3)
    assert figures["friction_mean"] == pytest.approx(0.053, abs=1e-4)


def test_shear_of_cold_oil_shortens_braking_where_the_film_moves():
    """Read as friction of the asperities, the published law leaves room for shear on top."""
    settled = shift("brake-test-sample")
    sheared = {"fidelity": "field", "friction_data": "boundary"}
    moving = shift("brake-test-sample", parts={"brake": sheared})
    after = [r.figures["lock_after_ramp_start"] for r in (moving, settled)]
    assert 0.7 < after[0] / after[1] < 0.95
    assert settled.figures["brake_viscous_share"] == 0.0
    assert 0.1 < moving.figures["brake_viscous_share"] < 0.4
    assert moving.energy["brake"] == pytest.approx(settled.energy["brake"], rel=0.01)
    total = shift("brake-test-sample", parts={"brake": {"fidelity": "field"}})
    lock = total.figures["lock_after_ramp_start"]
    assert lock == pytest.approx(after[1], rel=0.03)  # the shear is in the law already


def test_the_profile_is_free_braking_locked():
    r = shift("brake-test")
    assert [p.name for p in r.phases] == ["free", "braking", "locked"]
    assert [e.kind for e in r.events] == ["ramp_start", "ramp_end", "brake_locked"]
    assert r.signals["transmission.drum_speed"][-1] == 0.0
    assert "release_time" in r.figures and r.figures["release_time"] is None


def test_standstill_is_located_inside_the_step():
    """With constant friction the slip falls evenly: the last point tells when it is zero."""
    r = shift("brake-test-sample", parts={"brake": {"friction_law": "constant"}})
    speed = r.signals["transmission.drum_speed"]
    torque = r.signals["transmission.brake_reaction"]
    last = int(np.flatnonzero(speed > 0.0)[-1])
    exact = r.time[last] + 0.036 * speed[last] / torque[last]
    assert r.figures["lock_time"] == pytest.approx(exact, abs=1e-9)
    assert r.time[last] < exact < r.time[last + 1]


def test_what_is_not_stopped_has_no_inertia():
    figures = shift("brake-test-sample", stop_time=0.5).figures
    assert figures["lock_time"] is None and "stopped_inertia" not in figures


def test_figures_of_two_sources_are_not_mixed(tmp_path):
    table = '[published]\nsource = "my rig"\nlock_after_ramp_start = "1.05 s"\n'
    published = changed(tmp_path, table, "brake-test-sample").published
    assert published.source == "my rig"
    assert published.figures == {"lock_after_ramp_start": 1.05}
