"""The default shift: expected magnitudes, the energy balance, and independence of the step."""

import numpy as np
import pytest
from scene_runs import NO_DRAG, default_shift, shift, slow_without_jit

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
