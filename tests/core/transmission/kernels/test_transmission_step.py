"""The transmission's step: the kernels' contract, closed forms, and located stick and slip."""

import math
from dataclasses import fields

import pytest
from closed_forms.lock_up import engagement, reduced_inertia
from closed_forms.planetary import pitch_radius, planet_forces
from hypothesis import given, settings
from hypothesis import strategies as st
from kernel_part import Part

from thrustwasher.errors import Status
from thrustwasher.transmission.bearings import SHAFT
from thrustwasher.transmission.kernels import layout as L
from thrustwasher.transmission.parameters import SPEC, TransmissionParams

NAMES = [s.name.removesuffix("_torque").replace("shift_", "") for s in SPEC.inputs]


class Gearbox(Part):
    def __init__(self, **params):
        super().__init__("transmission", "rigid", **params)
        self.out[:], self.iout[:] = 0.0, 0

    def step(self, dt, **inputs):
        assert set(inputs) <= set(NAMES), NAMES
        return super().step([inputs.get(name, 0.0) for name in NAMES], dt)


FREE = {"engine_torque": 0.0, "load_torque": 0.0, "washers": 0}


def test_the_arrays_are_laid_out_as_the_lists_say():
    def names(start, skip=()):
        return [n[len(start) :].lower() for n in vars(L) if n.startswith(start) and n not in skip]

    found = [f.name for f in fields(TransmissionParams)] + ["fidelity"]
    named = names("P_", ("P_CLUTCH_PROFILE", "P_ENGINE_PROFILE"))
    assert [found[getattr(L, f"P_{n.upper()}")] for n in named] == named
    assert len(found) == L.N_PARAM
    assert found[L.P_CLUTCH_PISTON_AREA + L.N_OWN] == "brake_piston_area"
    assert found[L.P_CLUTCH_PISTON_AREA + L.OWN_LAG] == "clutch_pressure_lag"
    assert found[L.P_CLUTCH_PROFILE] == "clutch_pressure_points"
    assert found[L.P_ENGINE_PROFILE + 1 + L.MAX_POINTS] == "engine_torque_1"
    assert names("O_") == [s.name for s in SPEC.outputs if s.kind == "real"]
    others = [s.name for s in SPEC.outputs if s.kind != "real"]
    assert names("IO_") == [n.replace("solver_", "") for n in others]
    assert [s.name.split("_")[0] for s in SPEC.inputs[:4]] == names("I_")[:4]


def test_clutch_locks_two_free_inertias_when_the_closed_form_says():
    """Massless ring, brake open: the clutch acts with (1 + 1/r) between sun and carrier."""
    box = Gearbox(**FREE | {"drum_inertia": 0.0, "engine_torque": 40.0, "initial_drum_speed": 9.0})
    sun, carrier = 350.0, (350.0 + 2.2 * 9.0) / 3.2
    exact = engagement(300.0 * (1 + 1 / 2.2), 40.0, 0.0, 0.25, 8.0, sun, carrier)
    while not box["clutch_locked"]:
        assert box.step(0.01, clutch=300.0) == 0
    assert box["lock_time"] == pytest.approx(exact.lock_time, rel=1e-12)
    assert box["lock_speed"] == pytest.approx(exact.speed, rel=1e-12)
    assert box["clutch_heat"] == pytest.approx(exact.heat, rel=1e-12)
    assert box["clutch_speed"] == 0.0


@pytest.mark.parametrize("drum_inertia", [0.0, 0.01, 0.3])
def test_slip_sees_the_reduced_inertia(drum_inertia):
    box = Gearbox(**FREE | {"drum_inertia": drum_inertia})
    box.step(0.0)
    slip = box["clutch_speed"]
    box.step(1e-3, clutch=100.0)
    expected = 100.0 / reduced_inertia(2.2, 0.25, drum_inertia, 8.0)
    assert (slip - box["clutch_speed"]) / 1e-3 == pytest.approx(expected, rel=1e-10)


def test_the_lock_up_does_not_depend_on_the_communication_step():
    times = []
    for n in (1, 7, 100):
        box = Gearbox(drum_inertia=0.02)
        for _ in range(n):
            assert box.step(2.0 / n, clutch=350.0) == 0
        times.append(box["lock_time"])
    assert times == pytest.approx([times[0]] * 3, rel=1e-11) and times[0] > 0.0


def test_a_held_drum_stays_at_exactly_zero_and_carries_r_tau():
    box = Gearbox()
    for _ in range(50):
        box.step(1e-2, brake=380.0)
        assert box["brake_speed"] == 0.0 and box["brake_locked"] == 1.0
        assert box["brake_reaction"] == pytest.approx(-2.2 * box["input_tooth_torque"], rel=1e-12)
    assert box["engine_speed"] == pytest.approx(3.2 * box["output_speed"], rel=1e-15)


def test_break_away_comes_where_the_capacity_crosses_the_reaction():
    """Brake capacity falls linearly; the reaction at constant speed is known in closed form."""
    box = Gearbox(load_torque=0.0, drum_inertia=0.0, washers=0)
    inertia = 0.25 + 8.0 / 3.2**2  # first gear, seen by the engine
    reaction = 2.2 * (150.0 - 0.25 * 150.0 / inertia)
    box.step(0.01, brake=404.0)
    n = 0
    while box["brake_locked"]:
        n += 1
        assert n < 40 and box.step(0.01, brake=404.0 - 10.0 * n) == 0
    # The capacity received at t is 404 - 1000 t, and extrapolated in between.
    assert box["release_time"] == pytest.approx((404.0 - reaction) / 1000.0, rel=1e-10)
    assert box["clutch_locked"] == 0.0 and box["brake_speed"] < 0.0


def test_a_pack_without_capacity_never_sticks():
    box = Gearbox(**FREE | {"initial_engine_speed": 0.0})
    box.step(0.01)
    assert box["clutch_locked"] == box["brake_locked"] == 0.0


def test_both_packs_hold_everything_still_and_say_so():
    box = Gearbox(initial_engine_speed=60.0)
    for _ in range(200):
        assert box.step(0.01, clutch=500.0, brake=500.0) == 0
    assert box["clutch_locked"] == box["brake_locked"] == 1.0
    assert box["engine_speed"] == box["output_speed"] == box["drum_speed"] == 0.0
    assert box["solver_status"] == Status.STALLED
    assert box["clutch_reaction"] == pytest.approx(box["brake_reaction"]) == 150.0
    box.step(0.01, clutch=500.0, brake=0.0)
    assert box["solver_status"] == 0.0 and box["engine_speed"] > 0.0


def test_an_engine_turned_on_inside_a_step_starts_there():
    box = Gearbox(
        **FREE | {"engine_torque": 20.0, "engine_start_time": 0.037, "initial_engine_speed": 0.0}
    )
    for _ in range(2):
        box.step(0.05, brake=1e4)
    inertia = 0.25 + 8.0 / 3.2**2
    assert box["engine_speed"] == pytest.approx(20.0 * 0.063 / inertia, rel=1e-12)


def test_locked_clutch_breaks_away_and_locks_again_within_one_step():
    """Capacity dips under the reaction and is received again: both events are located."""
    box = Gearbox(**FREE | {"engine_torque": 150.0, "initial_drum_speed": 350.0})
    box.step(0.01, clutch=300.0)
    box.step(0.01, clutch=300.0)
    assert box["clutch_locked"] == 1.0
    box.step(0.05, clutch=10.0)
    assert box["clutch_locked"] == 0.0 and box["clutch_speed"] > 0.0
    events = box["events"]
    for _ in range(20):
        box.step(0.05, clutch=300.0)
    assert box["clutch_locked"] == 1.0 and box["events"] == events + 1


def test_a_dip_of_the_slip_below_zero_inside_one_step_is_not_missed():
    """Capacity falls from 400 N m to 0: slip dips through zero and is positive again at the end."""
    found = []
    for n in (1, 50):
        box = Gearbox(
            **FREE
            | {"engine_torque": 150.0, "initial_engine_speed": 144.3, "initial_drum_speed": 100.0}
        )
        box.step(1e-3, clutch=408.0)
        for i in range(n):
            box.step(0.05 / n, clutch=400.0 * (1.0 - i / n))
        assert box["clutch_speed"] > 0.0 and box["events"] == 2.0
        found.append((box["lock_time"], box["lock_speed"], box["clutch_speed"]))
    assert found[0] == pytest.approx(found[1], rel=1e-9)


def test_drag_alone_holds_the_planets_but_not_the_clutch():
    box = Gearbox(**FREE | {"initial_drum_speed": 350.0, "engine_torque": 1.0, "washers": 8})
    for _ in range(10):
        assert box.step(0.01, washer=0.5) == 0
    assert box["clutch_speed"] == 0.0 and box["clutch_locked"] == 0.0
    assert box["drag_torque"] > 0.0 and box["clutch_reaction"] == 0.0


def test_loads_on_planet_washer_and_mesh_are_the_closed_forms():
    box = Gearbox()
    box.step(1e-3, brake=380.0)
    helix = math.radians(20.0)
    sun, planet = pitch_radius(30, 1.5e-3, helix), pitch_radius(18, 1.5e-3, helix)
    forces = planet_forces(box["input_tooth_torque"], sun, planet, helix, 4)
    assert box["tooth_force"] == pytest.approx(forces.tangential, rel=1e-13)
    assert box["tilting_couple"] == pytest.approx(forces.couple, rel=1e-13)
    assert box["sun_thrust"] == pytest.approx(forces.sun_thrust, rel=1e-13)
    assert box["mesh_load"] == pytest.approx(forces.planet_torque, rel=1e-13)
    assert box["washer_load"] == pytest.approx(0.1 * forces.couple / 0.017, rel=1e-13)
    spin = (box["engine_speed"] - box["output_speed"]) * 30 / 18
    assert box["washer_speed"] == box["mesh_speed"] == pytest.approx(spin, rel=1e-13)


LEAST = 1e-9  # N m: what is smaller is lost beside rounding, and events in it are not located


def sizeable(low, high):
    return st.floats(low, high).map(lambda x: x if abs(x) >= LEAST else 0.0)


def often(value, others):
    return st.one_of(st.just(value), others)


torques = often(0.0, sizeable(0.0, 500.0))
rows = st.tuples(torques, torques, often(0.0, st.floats(-2.0, 2.0)))
shafts = st.permutations(list(SHAFT))
COEFFICIENTS = st.sampled_from([0.0, 0.0, 0.004, 0.05])
PARAMETERS = {
    "initial_engine_speed": st.floats(-400.0, 400.0),
    "initial_drum_speed": often(0.0, st.floats(-200.0, 200.0)),
    "drum_inertia": st.sampled_from([0.0, 0.01, 0.5]),
    "engine_torque": sizeable(-200.0, 200.0),
    "load_torque": sizeable(0.0, 500.0),
    "torque_age": st.sampled_from([0, 1]),
    "arrangement": st.sampled_from(["sun-input", "ring-input"]),
    "sun_bearing_coefficient": COEFFICIENTS,
    "ring_bearing_coefficient": COEFFICIENTS,
}
ELASTIC = {
    "carrier_inertia": st.just(0.3),
    "shaft_stiffness": st.floats(100.0, 1e5),
    "shaft_damping": st.floats(0.0, 50.0),
    "initial_twist": st.floats(-0.2, 0.2),
}
HEATS = [f"{name}_heat" for name in ("clutch", "brake", "washer", "mesh", "shaft", "bearing")]


@settings(max_examples=200, deadline=None)
@given(
    often({}, st.fixed_dictionaries(ELASTIC)),
    st.fixed_dictionaries(PARAMETERS),
    shafts,
    shafts,
    st.sampled_from([1e-4, 1e-3, 1e-2, 0.1]),
    st.lists(rows, min_size=3, max_size=40),
)
@pytest.mark.slow
def test_whatever_arrives_friction_takes_energy_and_the_book_closes(
    shaft, params, sun, ring, dt, received
):
    """With bearings between any shafts, and the output shaft rigid or elastic."""
    ends = {
        f"{name}_bearing_shaft_{i}": end
        for name, order in (("sun", sun), ("ring", ring))
        for i, end in enumerate(order[:2], 1)
    }
    box, heats = Gearbox(**shaft, **params, **ends), dict.fromkeys(HEATS, 0.0)
    twist = shaft.get("initial_twist", 0.0)
    turnover = 1.0 + 0.5 * shaft.get("shaft_stiffness", 0.0) * twist**2
    for clutch, brake, washer in received:
        assert box.step(dt, clutch=clutch, brake=brake, washer=washer, mesh=0.1) == 0
        turnover = max(turnover, abs(box["engine_work"]) + box["kinetic_energy"])
        for pack in ("clutch", "brake"):
            assert box[f"{pack}_reaction"] * box[f"{pack}_speed"] >= 0.0
            assert not box[f"{pack}_locked"] or box[f"{pack}_speed"] == 0.0
        assert all(box[name] >= heat - 1e-9 * turnover for name, heat in heats.items())
        heats = {name: box[name] for name in HEATS}
    assert abs(box["energy_residual"]) <= (1e-7 if shaft else 1e-8) * turnover
