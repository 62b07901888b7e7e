"""A brake alone on one inertia: the braking case of Wang, Wei & Wu (2012), Tables 1 and 2."""

import math

import numpy as np
import pytest
from scene_runs import changed, shift

from thrustwasher.shift import load_scene

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
