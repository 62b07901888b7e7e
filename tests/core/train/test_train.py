"""A gear train at a point: books that close, limits, chains of stages, coasting, self-locking."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from built import built_fmu
from kernel_part import Part
from trains import SPUR, alike, no_losses_of_shafts

from thrustwasher import ParameterError, SolveError, solve_gearmesh
from thrustwasher.errors import Status
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.losses.kernels.loss_laws import bearing_drag, seal_drag, starved
from thrustwasher.losses.kernels.skf_friction import skf_drag
from thrustwasher.losses.kernels.skf_series import TABLE
from thrustwasher.model.part_file import load_part
from thrustwasher.train.parameters import SPEC, TrainParams, pair_of
from thrustwasher.train.solve import solve_train

SOURCES = ("mesh_loss", "bearing_loss", "seal_loss", "churning_loss")
QUADRANTS = [(a * 120.0, b * 400.0) for a in (1, -1) for b in (1, -1)]


@pytest.mark.parametrize("meshes", [1, 2, 3])
@pytest.mark.parametrize(("torque", "speed"), [*QUADRANTS, (0.0, 300.0), (0.4, 300.0), (90.0, 0.0)])
def test_power_in_is_power_out_and_losses(meshes, torque, speed):
    r = solve_train(TrainParams(meshes=meshes), torque=torque, speed=speed)
    power, out = torque * speed, r.output_torque * r.output_speed
    most = max(abs(power), r.loss, 1e-9)
    assert abs(power - out - sum(getattr(r, n) for n in SOURCES)) < 1e-14 * most
    assert r.loss == pytest.approx(r.loss_torque * speed, rel=1e-11, abs=1e-12)
    parts = sum(getattr(r, f"mesh_{i}_loss") for i in range(1, meshes + 1))
    bearings = [f"shaft_{i}_bearing_{k}_loss" for i in range(1, meshes + 2) for k in (1, 2)]
    assert parts == pytest.approx(r.mesh_loss, rel=1e-14)
    assert sum(getattr(r, n) for n in bearings) == pytest.approx(r.bearing_loss, rel=1e-14)
    assert min(getattr(r, n) for n in SOURCES) >= 0.0


def test_coasting_loses_as_much_as_driving_at_the_same_load():
    """Efficiency is what comes out over what goes in, whichever shaft drives."""
    drive, coast = (solve_train(TrainParams(), torque=t, speed=400.0) for t in (120.0, -120.0))
    assert drive.flow == "input to output" and coast.flow == "output to input"
    assert drive.efficiency == drive.output_torque * drive.output_speed / (120.0 * 400.0)
    assert coast.efficiency == 120.0 * 400.0 / -(coast.output_torque * coast.output_speed)
    assert coast.loss == pytest.approx(drive.loss, rel=0.05)
    both = solve_train(TrainParams(), torque=0.2, speed=400.0)
    assert math.isnan(both.efficiency) and both.flow == "both shafts feed in"
    rest = solve_train(TrainParams(), torque=50.0, speed=0.0)
    assert math.isnan(rest.efficiency) and rest.flow == "at rest"


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_known_efficiencies_of_the_meshes_multiply_whichever_gear_drives(way):
    """The pinion of the first mesh and the gear of the second are nearer to the input."""
    known = {"friction_law": "efficiency", "efficiency": 0.98, "efficiency_back": 0.96}
    params = no_losses_of_shafts(
        meshes=2, mesh_2_driver="gear", **alike(1, **known), **alike(2, **known)
    )
    r = solve_train(params, torque=way * 120.0, speed=400.0)
    assert r.efficiency == pytest.approx(0.98 * 0.96, rel=1e-12)


def test_turned_both_ways_round_the_teeth_lose_the_same():
    one, other = (solve_train(TrainParams(), torque=t, speed=4 * t) for t in (100.0, -100.0))
    assert one.efficiency == pytest.approx(other.efficiency, abs=1e-3)  # by other bearing loads
    assert one.mesh_loss == pytest.approx(other.mesh_loss, rel=1e-3)


@pytest.mark.slow
def test_the_loss_passes_through_no_torque_smoothly():
    """Bounded slope: what teeth and bearings rub per torque; no jump at the change of flank."""
    torques = np.linspace(-1.0, 1.0, 401)
    loss = np.array([solve_train(TrainParams(), torque=t, speed=400.0).loss for t in torques])
    slopes = np.diff(loss) / np.diff(torques)
    assert abs(slopes).max() < 0.05 * 400.0
    small = np.linspace(-1e-6, 1e-6, 3)
    tiny = [solve_train(TrainParams(), torque=t, speed=400.0).loss for t in small]
    assert tiny[0] == pytest.approx(tiny[2], rel=1e-6)


def test_a_ratio_of_one_turns_torque_round():
    pair = {**SPUR, "gear_ratio": 1.0, "pinion_teeth": 30}
    frictionless = alike(1, **pair, friction_law="constant", constant_friction=0.0)
    r = solve_train(no_losses_of_shafts(meshes=1, **frictionless), torque=80.0, speed=150.0)
    assert (r.output_torque, r.output_speed) == (-80.0, -150.0)
    assert r.efficiency == 1.0 and r.loss == 0.0


def test_two_equal_stages_are_one_run_twice():
    twice = no_losses_of_shafts(meshes=2, **alike(1, **SPUR), **alike(2, **SPUR))
    once = no_losses_of_shafts(meshes=1, **alike(1, **SPUR))
    both = solve_train(twice, torque=100.0, speed=300.0)
    first = solve_train(once, torque=100.0, speed=300.0)
    second = solve_train(once, torque=first.output_torque, speed=first.output_speed)
    assert both.mesh_1_loss == first.loss
    assert both.mesh_2_loss == pytest.approx(second.loss, rel=1e-13)
    assert both.output_torque == pytest.approx(second.output_torque, rel=1e-13)
    assert both.efficiency == pytest.approx(first.efficiency * second.efficiency, rel=1e-13)


@pytest.mark.parametrize("mesh", [0, 1])
def test_a_mesh_loses_what_its_own_model_says(mesh):
    p = TrainParams()
    r = solve_train(p, torque=120.0, speed=400.0)
    pair, speed = pair_of(p, mesh), 400.0 / (1.0, 3.0)[mesh]
    radius = 0.5 * pair.pinion_teeth * pair.normal_module / math.cos(pair.helix_angle)
    torque = getattr(r, f"mesh_{mesh + 1}_tangential_force") * radius
    own = solve_gearmesh(
        replace(pair, thermal_mode="quasi_steady"),
        power=torque * speed,
        speed=speed,
        oil_temperature=353.15,
    )
    assert getattr(r, f"mesh_{mesh + 1}_loss") == pytest.approx(own.friction_power, rel=1e-9)
    for name in ("pitting", "root", "scuffing"):
        found = getattr(r, f"mesh_{mesh + 1}_{name}_safety")
        assert found == pytest.approx(getattr(own, f"{name}_safety"), rel=1e-9)
    assert r.pitting_safety == min(r.mesh_1_pitting_safety, r.mesh_2_pitting_safety)


def test_a_gear_that_drives_is_a_pinion_driven_backwards():
    """The same pair seen from its other shaft: same losses, torques and speeds change places."""
    same = {f"shaft_{i}_bearing_{k}_position": 0.1 * (k - 1) for i in (1, 2) for k in (1, 2)}
    pair = {**alike(1, **SPUR), "meshes": 1, **same}
    there = solve_train(no_losses_of_shafts(**pair), torque=100.0, speed=300.0)
    back = solve_train(
        no_losses_of_shafts(**pair, mesh_1_driver="gear"),
        torque=-there.output_torque,
        speed=there.output_speed,
    )
    assert back.output_speed == pytest.approx(300.0, rel=1e-14)
    assert back.mesh_loss == pytest.approx(there.mesh_loss, rel=2e-2)  # friction of the other side
    assert back.output_torque == pytest.approx(-100.0, rel=1e-3)
    assert back.flow == "output to input"


def test_bearings_and_seals_lose_what_the_laws_of_losses_say():
    p = TrainParams()
    r = solve_train(p, torque=120.0, speed=400.0, oil_temperature=333.15)
    mu = p.viscosity_scale * math.exp(p.viscosity_b / (60.0 + p.viscosity_c))
    nu = mu / p.oil_density
    w = math.hypot(400.0, p.speed_smoothing)
    starving = starved(p.starvation_constant, 3.1, 0.06, p.shaft_1_bearing_1_section)
    drag, _, _ = bearing_drag(w, nu, r.shaft_1_bearing_1_load, 0.06, 2.0, 4e-4, starving)
    assert r.shaft_1_bearing_1_loss == pytest.approx(drag * 400.0, rel=1e-9)
    nu_40 = p.viscosity_scale * math.exp(p.viscosity_b / (40.0 + p.viscosity_c)) / p.oil_density
    one, _ = seal_drag(333.15, nu_40, 0.035)
    two, _ = seal_drag(333.15, nu_40, 0.045)
    slow = 400.0 / (p.mesh_1_gear_ratio * p.mesh_2_gear_ratio)
    assert r.seal_loss == pytest.approx(one * 400.0 + 2.0 * two * slow, rel=1e-9)


SKF = {"bearing_law": "skf"}
for i, series in ((1, "62"), (2, "302"), (3, "320")):
    for k in (1, 2):
        SKF |= {f"shaft_{i}_bearing_{k}_series": series}
        SKF |= {f"shaft_{i}_bearing_{k}_static_capacity": 23e3 if i == 1 else 0.0}


def test_bearings_lose_what_skfs_model_says():
    """Of a deep groove ball and a taper roller bearing, under their radial and axial forces."""
    p = TrainParams(**SKF)
    r = solve_train(p, torque=120.0, speed=400.0, oil_temperature=333.15)
    mu = p.viscosity_scale * math.exp(p.viscosity_b / (60.0 + p.viscosity_c))
    of = (("shaft_1_bearing_1", 400.0, 3.1), ("shaft_2_bearing_2", 400.0 / 3.0, 6.0))
    for name, speed, kind in of:
        d, section = (getattr(p, f"{name}_{n}") for n in ("diameter", "section"))
        forces = tuple(getattr(r, f"{name}_{n}_force") for n in ("radial", "axial"))
        row = np.array(TABLE[getattr(p, f"{name}_series")][1])
        k_rs = starved(p.starvation_constant, kind, d, section)
        drag, _, _ = skf_drag(speed, mu / p.oil_density, forces, d, k_rs, row, (1.6, 23e3), 0.05)
        assert getattr(r, f"{name}_loss") == pytest.approx(drag * speed, rel=1e-6)
    assert not [text for text in r.warnings if "Palmgren" in text]
    power = 120.0 * 400.0 - r.output_torque * r.output_speed
    assert power == pytest.approx(r.loss, rel=1e-12)


def test_light_load_and_mixed_friction_are_said_of_palmgrens_law():
    said = solve_train(TrainParams(), torque=5.0, speed=500.0).warnings
    found = [text.partition(",")[0] for text in said if "Palmgren" in text]
    assert found == ["shaft 1", "shaft 3"]
    warm = solve_train(TrainParams(), torque=150.0, speed=500.0, oil_temperature=313.15).warnings
    assert not [text for text in warm if "load over C" in text]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"shaft_2_bearing_1_series": "none"}, "shaft_2_bearing_1_series = 'none'.*no constants"),
        ({"shaft_2_bearing_2_series": "62"}, "shaft_2_bearing_2_series = '62'.*no constants"),
        ({"shaft_1_bearing_2_static_capacity": 0.0}, "static_capacity = 0.0, allowed: C0 above 0"),
    ],
)
def test_bearings_without_constants_of_skf_are_refused(changes, words):
    with pytest.raises(ParameterError, match=words):
        TrainParams(**{**SKF, **changes})


RUBBING = {
    f"shaft_1_bearing_{k}_{name}": value
    for k in (1, 2)
    for name, value in {"diameter": 1.5, "load_factor": 0.02, "viscous_factor": 0.0}.items()
}


def test_a_train_that_locks_itself_says_so():
    """Bearings of 1.5 m rub with 1.2 times what turns the pinion: the output cannot drive."""
    forth = solve_train(TrainParams(**RUBBING), torque=100.0, speed=50.0)
    assert forth.flow == "input to output" and 0.3 < forth.efficiency < 0.6
    with pytest.raises(SolveError, match="self-locking"):
        solve_train(TrainParams(**RUBBING), torque=-100.0, speed=50.0)
    back = solve_train(TrainParams(**RUBBING), torque=-100.0, speed=50.0, throw=False)
    assert back.flow == "self-locking" and math.isnan(back.efficiency)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"shaft_2_bearing_2_position": 0.0}, "shaft_2_bearing_2_position = 0.0, allowed: apart"),
        ({"meshes": 4}, "meshes = 4, allowed: 1 .. 3"),
        ({"mesh_2_pinion_teeth": 5}, "mesh 2: pinion_teeth = 5, allowed: "),
        ({"shaft_1_bearing_1_type": "plain"}, "allowed: 'ball'"),
    ],
)
def test_what_is_wrong_is_named(changes, words):
    with pytest.raises(ParameterError, match=words):
        TrainParams(**changes)


def test_what_is_not_there_has_no_value():
    r = solve_train(TrainParams(meshes=1, mesh_1_root_limit=0.0), torque=50.0, speed=100.0)
    assert r.mesh_2_loss is r.shaft_3_bearing_1_life is r.root_safety is None
    assert r.mesh_1_loss > 0.0 and r.shaft_2_bearing_2_life > 0.0


# Lives of three reducers, derived apart from this code by an engineer's own statics.
#
# The numbers are those of rigid shafts, ideal teeth and ISO 281 with the axial loads of pairs in O
# and X that catalogues of taper and angular contact bearings print; so friction is taken out here.
# Loads and lives were balanced about an arbitrary point there, and the pair's logic compared with
# SKF's load cases. L10h in hours, bearing by bearing from the input on; drive, then coast.

RPM = 0.10471975511965977
REDUCERS = [
    ("one-stage", 180.0, 2900.0, (13370.19, 149646.41, 154381.98, 2597455.67)),
    ("one-stage", -180.0, 2900.0, (44215.86, 12448.24, 618772.09, 152242.46)),
    ("two-stages", 95.0, 2930.0, (5533.72, 14255.36, 125345.41, 99668.83, 147751.17, 170837.26)),
    ("two-stages", -95.0, 2930.0, (11887.50, 5312.85, 155726.52, 295681.39, 217780.20, 83417.26)),
    ("chain-and-propeller", 120.0, 2200.0, (26321.95, 14594.20, 41808.44, 180696.86)),
    ("chain-and-propeller", -120.0, 2200.0, (37117.55, 12620.29, 180000.91, 822492.44)),
]


@pytest.mark.parametrize(("name", "torque", "speed", "hours"), REDUCERS)
def test_lives_are_those_that_were_derived_apart(name, torque, speed, hours):
    part = load_part(Path(__file__).parent / "reducers" / f"{name}.toml")
    r = solve_train(part.params, torque=torque, speed=speed * RPM)
    shafts = range(1, len(hours) // 2 + 1)
    lives = [getattr(r, f"shaft_{i}_bearing_{k}_life") / 3600.0 for i in shafts for k in (1, 2)]
    assert lives == pytest.approx(hours, rel=2e-8, abs=0.006)


# The train in time: the FMU does what Python does, passes through no torque, books its heat.

H = 1e-3
NAMES = [s.name for s in SPEC.outputs]


def test_the_fmu_passes_from_drive_to_coasting_without_a_jump():
    """150 N m to -150 N m in 600 steps: the loss moves by no more than its slope allows."""
    with Instance(built_fmu("train", local=True)) as fmu, DirectInstance(SPEC) as direct:
        start = {"torque": 150.0, "speed": 500.0, "oil_temperature": 353.15}
        fmu.initialize(0.0, start)
        direct.initialize(0.0, start)
        losses = []
        for i, torque in enumerate(np.linspace(150.0, -150.0, 601).tolist()):
            for part in (fmu, direct):
                part.set_inputs([torque, 500.0, 353.15])
                part.step(H * i, H)
            found = fmu.outputs()
            assert found == direct.outputs()
            losses.append(found[NAMES.index("loss")])
    assert losses[0] == pytest.approx(1205.0, rel=0.01)
    steps = abs(np.diff(losses))
    assert steps.max() < 1.5 * steps[0] and min(losses) == pytest.approx(losses[300], rel=0.01)


def test_it_begins_as_python_solves_it():
    point = {"torque": 120.0, "speed": 400.0, "oil_temperature": 333.15}
    with Instance(built_fmu("train", local=True)) as fmu:
        fmu.initialize(0.0, point)
        shown = dict(zip(NAMES, fmu.outputs(), strict=True))
    r = solve_train(TrainParams(), **point)
    for name in SPEC.real_outputs:
        if name != "oil_energy" and getattr(r, name) is not None:
            assert shown[name] == pytest.approx(getattr(r, name), rel=1e-9), name
    assert shown["mesh_3_loss"] == shown["shaft_4_bearing_1_life"] == -1.0


def test_heat_of_a_run_is_what_was_lost_less_what_the_bodies_keep():
    """Started as warm as the oil: bodies take up heat, the oil gets the rest."""
    part = Part("train", "handbook", TrainParams(thermal_start="oil"))
    part = _transient(part)
    lost = 0.0
    for _ in range(50):
        assert part.step([150.0, 500.0, 353.15], 0.1) == 0
        lost += 0.1 * part["loss"]
    assert part["oil_energy"] < lost
    before = part["oil_energy"]
    for _ in range(200):
        assert part.step([150.0, 500.0, 353.15], 10.0) == 0
    assert part.step([150.0, 500.0, 353.15], 1.0) == 0
    assert part["oil_heat"] == pytest.approx(part["loss"], rel=1e-6)
    assert part["oil_energy"] > before and part["mesh_1_bulk_temperature"] > 358.0


def _transient(part):
    """``filled`` takes bodies as steady; here they store heat."""
    from thrustwasher.model.parameters import as_numbers

    numbers = as_numbers(part.params)
    part.par[: len(numbers)] = numbers
    assert part.k.derive(part.par) == 0
    return part


def test_where_it_locks_itself_a_step_fails_and_nothing_moves():
    wide = {f"shaft_1_bearing_{k}_diameter": 1.5 for k in (1, 2)}
    wide |= {f"shaft_1_bearing_{k}_load_factor": 0.02 for k in (1, 2)}
    wide |= {f"shaft_1_bearing_{k}_viscous_factor": 0.0 for k in (1, 2)}
    part = Part("train", "handbook", TrainParams(**wide))
    assert part.step([100.0, 50.0, 353.15], H) == 0
    kept = part.state.copy()
    assert part.step([-100.0, 50.0, 353.15], H) == Status.MAX_ITERATIONS
    assert part["solver_status"] == Status.MAX_ITERATIONS
    assert part.state.tobytes() == kept.tobytes()
