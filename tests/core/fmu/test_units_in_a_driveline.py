"""Units in a driveline of the host: two inertias for a pack, a shaft for a washer or for teeth."""

import numpy as np
import pytest
from built import built_fmu

from thrustwasher.errors import Status
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.model.registry import find_spec

H, ENGINE, OUTPUT = 1e-3, (0.15, 100.0), (1.0, 20.0)  # s; kg m2, N m
INERTIA = ENGINE[0] * OUTPUT[0] / (ENGINE[0] + OUTPUT[0])
HOLDING = (OUTPUT[0] * ENGINE[1] + ENGINE[0] * OUTPUT[1]) / (ENGINE[0] + OUTPUT[0])
SHOWN = ["friction_torque", "locked", "plant_inertia", "plant_age", "energy", "solver_status"]


def engaged(unit, delay, *, until=0.7, step=H, torques=None):
    """Two inertias whose pack is pressed; return slip, torque and others after each step."""
    speed, rows, waiting, work = [200.0, 0.0], [], [0.0] * delay, 0.0
    loads = {"load": 200.0, "speed": 200.0, "oil_temperature": 363.15}
    unit.initialize(0.0, loads)
    for n in range(round(until / step)):
        slip = speed[0] - speed[1]
        given = {**loads, "load": min(200.0 + 2e4 * n * step, 6000.0), "speed": slip}
        unit.set_inputs([given.get(name, 0.0) for name in unit.input_names])
        unit.step(n * step, step)
        shown = unit.get(SHOWN)
        waiting.append(shown[0])
        acting = waiting.pop(0)
        engine = torques(n * step) if torques else ENGINE[1]
        speed[0] += step * (engine - acting) / ENGINE[0]
        speed[1] += step * (acting - OUTPUT[1]) / OUTPUT[0]
        work += acting * 0.5 * (slip + speed[0] - speed[1]) * step
        rows.append((speed[0] - speed[1], work, *shown))
    return np.array(rows).T


@pytest.fixture(scope="module")
def reference():
    """Slip, work and what the kernels show, torques fresh and a step old."""
    return [engaged(DirectInstance(find_spec("clutch")), delay) for delay in (0, 1)]


@pytest.mark.parametrize("delay", [0, 1])
def test_a_pack_locks_once_and_holds_with_the_torque_the_driveline_needs(reference, delay):
    slip, work, torque, locked, inertia, age, energy, status = reference[delay]
    assert (slip[1:] * slip[:-1] > -1e-12).all()
    assert abs(slip[-1]) < 1e-10 and torque[-1] == pytest.approx(HOLDING, rel=1e-9)
    assert locked[-1] and inertia[-1] == pytest.approx(INERTIA, rel=1e-6) and age[-1] == delay
    assert energy[-1] == pytest.approx(work[-1], rel=1e-9)
    assert (status == Status.OK).all()


@pytest.mark.parametrize("target", ["native", "python"])
@pytest.mark.parametrize("delay", [0, 1])
def test_fmus_hold_as_the_kernels_do(reference, target, delay):
    with Instance(built_fmu("clutch", target=target, local=True)) as unit:
        found = engaged(unit, delay)
    assert found.tobytes() == reference[delay].tobytes()


@pytest.mark.fmi3
@pytest.mark.parametrize("delay", [0, 1])
def test_fmi_3_holds_as_fmi_2(reference, delay):
    with Instance(built_fmu("clutch", fmi=3, local=True)) as unit:
        found = engaged(unit, delay)
    assert found.tobytes() == reference[delay].tobytes()


def test_a_lock_is_taken_up_again_from_a_state_in_its_middle(reference):
    """By other instances, from serialized bytes; a step that is repeated gives the same."""
    slip, _, _, locked, *_ = reference[0]
    last = int(np.argmax(locked))
    with Instance(built_fmu("clutch", local=True)) as one:
        with Instance(built_fmu("clutch", local=True)) as other:
            one.initialize(0.0, {"load": 200.0, "speed": 200.0, "oil_temperature": 363.15})
            other.initialize(0.0, {})
            for n in range(last + 20):
                load = min(200.0 + 2e4 * n * H, 6000.0)
                now = [load, slip[n - 1] if n else 200.0, 363.15, 0.0]
                state = one.get_state()
                kept = one.serialize(state)
                results = []
                for again in (one, one, other):
                    back = again.deserialize(kept)
                    again.set_state(back)
                    again.free_state(back)
                    again.set_inputs(now)
                    again.step(n * H, H)
                    results.append(again.outputs())
                one.free_state(state)
                assert results[0] == results[1] == results[2]


def test_events_tell_of_lock_and_break_away():
    """The engine's torque rises beyond the capacity and falls again."""

    def torques(t):
        return 600.0 if 0.9 <= t < 0.95 else ENGINE[1]

    with Instance(built_fmu("clutch", local=True)) as unit:
        unit.log(True)
        slip, *_ = engaged(unit, 0, until=1.4, torques=torques)
        told = [text for _, category, text in unit.notes if category == "logEvents"]
    assert [text.partition("s: ")[2].partition(";")[0] for text in told] == [
        "the pack holds",
        "the pack slips",
        "the pack holds",
    ]
    assert np.abs(slip[920:945]).min() > 0.1 and abs(slip[-1]) < 1e-9


def test_chatter_is_a_warning_with_its_cure():
    with Instance(built_fmu("clutch", local=True), parameters={"holding": "off"}) as unit:
        *_, status = engaged(unit, 1)
        warned = [text for text in unit.warnings if "CHATTER" in text]
    assert (status == Status.CHATTER).any()
    assert len(warned) >= 1 and "set holding" in warned[0] and "shorter step" in warned[0]


def dragged(model, inertia, delay, outside, fixed, **parameters):
    """A shaft that turns at 5 rad/s, slowed by a unit's friction; speeds, torques, statuses."""
    unit = DirectInstance(find_spec(model), parameters=parameters)
    speed, rows, waiting = 5.0, [], [0.0] * delay
    unit.initialize(0.0, {**fixed, "speed": speed})
    for n in range(2500):
        given = {**fixed, "speed": speed}
        unit.set_inputs([given.get(name, 0.0) for name in unit.input_names])
        unit.step(n * H, H)
        torque, status = unit.get(["friction_torque", "solver_status"])
        waiting.append(torque)
        speed += H * (outside - waiting.pop(0)) / inertia
        rows.append((speed, torque, status))
    return np.array(rows).T


DRAGS = {
    "washer": (0.05, {"load": 300.0, "tilt": 2e-3, "oil_temperature": 363.15}, {"fidelity": "map"}),
    "gearmesh": (0.3, {"load": 100.0, "oil_temperature": 363.15}, {}),
}


@pytest.mark.parametrize("model", DRAGS)
@pytest.mark.parametrize("delay", [0, 1])
@pytest.mark.parametrize("inertia", [1e-4, 1e-3, 1e-2])
@pytest.mark.slow
def test_friction_that_drags_brings_its_shaft_to_rest(model, delay, inertia):
    """It creeps against the outside torque, steadily; given inertia and delay it never reverses."""
    outside, fixed, parameters = DRAGS[model]
    free = dragged(model, inertia, delay, outside, fixed, **parameters, holding="off")
    held = dragged(model, inertia, delay, outside, fixed, **parameters)
    assert np.ptp(held[0][-100:]) < 1e-6
    assert held[1][-1] == pytest.approx(outside, rel=1e-6)
    if inertia > 5e-3:  # it slides for some tens of steps, as if nothing were held
        sliding = int(np.argmax(free[0] < 0.5))
        assert held[1][:sliding] == pytest.approx(free[1][:sliding], rel=1e-12)
    given = {"holding": "given", "coupling_inertia": inertia, "coupling_age": delay}
    known = dragged(model, inertia, delay, outside, fixed, **parameters, **given)
    assert (known[0][1:] * known[0][:-1] > 0.0).all()
    assert 0.0 < known[0][-1] < 8.0 * H * outside / inertia


def test_teeth_that_chatter_say_so():
    outside, fixed, _ = DRAGS["gearmesh"]
    *_, status = dragged("gearmesh", 1e-3, 1, outside, fixed, holding="off")
    assert status[-1] == Status.CHATTER


@pytest.mark.parametrize("delay", [0, 1])
@pytest.mark.parametrize(
    ("model", "speed", "torque", "inertia"),
    [("losses", "input_speed", "input_torque", 5e-3), ("train", "speed", "loss_torque", 1e-3)],
)
def test_losses_bring_their_shaft_to_rest_and_leave_it_there(model, speed, torque, inertia, delay):
    unit, w, waiting, rows = DirectInstance(find_spec(model)), 20.0, [0.0] * delay, []
    unit.initialize(0.0, {"oil_temperature": 313.15, speed: w})
    for n in range(1000):
        given = {"oil_temperature": 313.15, speed: w}
        unit.set_inputs([given.get(name, 0.0) for name in unit.input_names])
        unit.step(n * H, H)
        waiting.append(unit.get([torque])[0])
        w -= H * waiting.pop(0) / inertia
        rows.append(w)
    assert np.abs(rows[-300:]).max() < 1e-9


@pytest.mark.parametrize("delay", [0, 1])
@pytest.mark.parametrize("holding", ["identified", "given"])
def test_teeth_beside_a_locked_pack_on_one_shaft_stand_still(holding, delay):
    """A pack that holds a shaft against 5 N m, a mesh whose friction acts on it too."""
    inertia, outside, slip, old, rows = 0.03, -5.0, 0.0, (0.0, 0.0), []
    told = {"holding": holding, "coupling_inertia": inertia, "coupling_age": delay}
    pack = {"friction_law": "constant", "fidelity": "stribeck"}
    pack, teeth = (
        DirectInstance(find_spec("clutch"), parameters={**told, **pack}),
        DirectInstance(find_spec("gearmesh"), parameters=told),
    )
    loads = {"clutch": 6000.0, "gearmesh": 100.0}
    units = {"clutch": pack, "gearmesh": teeth}
    for name, unit in units.items():
        unit.initialize(0.0, {"load": loads[name], "speed": 0.0, "oil_temperature": 353.15})
    for n in range(400):
        new = []
        for name, unit in units.items():
            given = {"load": loads[name], "speed": slip, "oil_temperature": 353.15}
            unit.set_inputs([given.get(key, 0.0) for key in unit.input_names])
            unit.step(n * H, H)
            new += unit.get(["friction_torque"])
        acting, old = (old if delay else new), new
        slip += H * (outside - acting[0] - acting[1]) / inertia
        rows.append((slip, *new))
    late = np.array(rows[300:])
    assert np.abs(late[:, 0]).max() < 1e-7 and np.ptp(late[:, 1]) < 1e-4
    assert late[-1, 1] == pytest.approx(outside, rel=1e-6)
