"""Events of FMI 3.0 as FMPy handles them: where a step ends, and that nothing else is different."""

import ctypes
import math
import subprocess
import sys
from pathlib import Path

import needed
import numpy as np
import pytest
from built import built_fmu
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Slave

from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.model.registry import find_spec

H = 0.01
# The engine's torque falls from 200 to 50 N m; a brake of 180 N m breaks away, a clutch of 150 N m
# locks. No input changes, so that the step does not matter.
UPSHIFT = {
    "engine_torque_points": 2,
    "engine_torque_time_1": 0.0,
    "engine_torque_time_2": 0.5,
    "engine_torque_1": 200.0,
    "engine_torque_2": 50.0,
    "clutch_torque": 150.0,
    "brake_torque": 180.0,
}
FLAGS = ["brake_locked", "clutch_locked"]
MOTION = ["engine_speed", "drum_speed", "release_time", "lock_time", "engine_work", "clutch_heat"]
internal = {"use_event_mode": False, "early_return_allowed": False}
at_steps = {"use_event_mode": True, "early_return_allowed": False}
early = {"use_event_mode": True, "early_return_allowed": True}


@pytest.fixture(scope="module")
def transmission():
    return str(built_fmu("transmission", fmi=3, local=True))


@pytest.fixture(scope="module")
def washer():
    return str(built_fmu("washer", fmi=3, local=True))


def shifted(fmu, step, how):
    return simulate_fmu(
        fmu, stop_time=1.5, output_interval=step, start_values=UPSHIFT, output=FLAGS + MOTION, **how
    )


def changes(result, name):
    """Return the times of the rows where a flag has just changed."""
    flag = result[name].astype(int)
    return result["time"][1:][np.diff(flag) != 0]


def at_points(result, step):
    """Return the last row at each regular communication point."""
    points = np.arange(round(1.5 / step) + 1) * step
    return result[np.searchsorted(result["time"], points + 1e-9) - 1]


def test_steps_end_at_break_away_and_lock_up(transmission):
    """To 1e-6 s at steps of 10 ms, next to a run of 0.1 ms steps that handles them inside."""
    fine, coarse = shifted(transmission, 1e-4, internal), shifted(transmission, H, early)
    (broke_away,), (locked,) = (changes(coarse, name) for name in FLAGS)
    assert broke_away == pytest.approx(fine["release_time"][-1], abs=1e-6)
    assert locked == pytest.approx(fine["lock_time"][-1], abs=1e-6)
    for instant in (broke_away, locked):
        assert abs(instant / H - round(instant / H)) > 0.1


@pytest.mark.parametrize("how", [at_steps, early], ids=["event mode", "early return"])
def test_between_events_all_hosts_see_the_same(transmission, how):
    plain, other = shifted(transmission, H, internal), shifted(transmission, H, how)
    a, b = at_points(plain, H), at_points(other, H)
    rtol = 0.0 if how is at_steps else 1e-9  # an early return divides a step
    for name in FLAGS + MOTION:
        np.testing.assert_allclose(b[name], a[name], rtol=rtol, atol=1e3 * rtol, err_msg=name)


def test_without_early_return_events_are_told_at_the_end_of_the_step(transmission):
    result = shifted(transmission, H, at_steps)
    for name in FLAGS:
        (instant,) = changes(result, name)
        assert instant / H == pytest.approx(round(instant / H), abs=1e-9)
        assert (result["time"] == instant).sum() == 2  # before and after event mode


def loaded(fmu, h, how, **start):
    """A washer whose load rises over the fold where its film is lost, and falls again."""
    rows = [(0.0, 200.0), (1.0, 2500.0), (2.0, 100.0)]
    load = np.array(rows, dtype=[("time", float), ("load", float)])
    return simulate_fmu(
        fmu,
        stop_time=2.0,
        output_interval=h,
        input=load,
        output=["distress", "film_ratio", "energy"],
        start_values=start,
        **how,
    )


def test_a_steady_washer_loses_and_regains_its_film_where_the_load_is_set(washer):
    """Without a memory the film follows the load at once: the event is at the step's beginning."""
    plain, found = loaded(washer, 0.02, internal), loaded(washer, 0.02, early)
    lost, regained = changes(found, "distress")
    assert changes(plain, "distress") == pytest.approx([lost + 0.02, regained + 0.02])
    assert plain["energy"][-1] == found["energy"][-1]


@pytest.mark.slow
def test_a_washer_with_a_memory_loses_its_film_within_a_step(washer):
    """Next to a run that is asked at the instant and just before it: flag false, then true."""
    found = loaded(washer, 0.02, early, thermal_mode=2)
    lost, _ = changes(found, "distress")
    start = np.floor(lost / 0.02) * 0.02
    assert 1e-4 < lost - start < 0.02 - 1e-4
    for end, expected in ((lost, 1), (lost - 2e-7, 0)):
        load = np.array([(0.0, 200.0), (1.0, 2500.0)], dtype=[("time", float), ("load", float)])
        result = simulate_fmu(
            washer,
            stop_time=end,
            output_interval=0.02,
            input=load,
            output=["distress"],
            start_values={"thermal_mode": 2},
        )
        assert result["distress"][-1] == expected


# The step that a model would like: a property of the motion, whatever step it is asked with.

STEPS = [4e-3, 2e-3, 1e-3]
END = 0.1  # s


def asked(model, step, inputs, until=END, **parameters):
    """Return the advice at the end of a run at equal steps; ``inputs`` of time and step."""
    instance = DirectInstance(find_spec(model), parameters=parameters)
    instance.initialize(0.0, inputs(0.0, step))
    for i in range(round(until / step)):
        given = inputs(i * step, step)
        instance.set_inputs([given.get(name, 0.0) for name in instance.input_names])
        instance.step(i * step, step)
    return instance.get(["advised_step"])[0]


def pressed(rise):
    """A pack at a steady slip; its load rises by ``rise`` N/s and is that of each step's end."""
    return lambda t, h: {"load": 2000.0 + rise * (t + h), "speed": 80.0, "oil_temperature": 300.0}


BEND = 2e4  # N m/s2


def capacity(t):
    return 100.0 + BEND * t * t


def received(t, h):
    """A clutch whose capacity bends, the brake open."""
    return {"clutch_torque": capacity(t), "shift_command": 1.0}


def test_over_the_clutchs_step_the_capacity_moves_by_one_percent():
    """The film settled and the coefficient constant the capacity is in proportion to the load."""
    level = {"fidelity": "closed", "friction_temperature_slope": 0.0}
    for step in STEPS:
        found = asked("clutch", step, pressed(1e4), **level)
        assert found == pytest.approx(0.01 * (2000.0 + 1e4 * END) / 1e4, rel=1e-3)


def test_the_clutchs_advice_does_not_depend_on_the_step_it_is_asked_with():
    found = [asked("clutch", step, pressed(2e4)) for step in STEPS]
    assert np.ptp(found) < 0.1 * min(found)


@pytest.mark.parametrize("model", ["clutch", "transmission"])
def test_where_nothing_moves_the_step_may_grow_fivefold(model):
    warm = {"oil_temperature": 297.15} if model == "clutch" else {}
    assert asked(model, 1e-3, lambda t, h: warm) == pytest.approx(5e-3)


def test_the_transmissions_step_is_that_of_what_extrapolation_leaves():
    """A straight line misses a parabola by 2 BEND h^2; allowed is 1 % of the largest torque."""
    for step in STEPS:
        expected = np.sqrt(0.01 * capacity(END - step) / (2.0 * BEND))
        found = asked("transmission", step, received)
        assert found == pytest.approx(min(expected, 5.0 * step), rel=1e-6)


def test_what_is_held_asks_for_smaller_steps():
    for step in STEPS:
        moved = capacity(END - step) - capacity(END - 2.0 * step)
        expected = 0.01 * capacity(END - step) / moved * step
        found = asked("transmission", step, received, capacity_extrapolation=False)
        assert found == pytest.approx(max(expected, 0.2 * step), rel=1e-6)


@pytest.mark.slow
def test_a_washer_without_memory_wants_no_step_and_one_with_it_does():
    def loaded(t, h):
        return {"load": 300.0, "speed": 545.0, "tilt": 0.002, "oil_temperature": 297.15}

    assert asked("washer", 0.02, loaded) == 0.0
    assert 1e-3 < asked("washer", 0.02, loaded, thermal_mode="transient") < 1.0


# Inputs that move within a step, in the models' own FMUs, as hosts give them.

RATES_H = 2e-3
STARTS = {
    "clutch": {"load": 3000.0, "speed": 80.0, "oil_temperature": 340.0, "drum_speed": 40.0},
    "transmission": {"clutch_torque": 60.0, "engine_torque_input": 150.0, "shift_command": 0.2},
    "gearmesh": {"load": 60.0, "speed": 200.0, "oil_temperature": 350.0},
}


def profile(model, t):
    """Return all inputs, smooth in time."""
    wave = 1.0 + 0.3 * math.sin(20.0 * t)
    names = [s.name for s in find_spec(model).inputs]
    return [STARTS[model].get(n, 0.0) * (1.0 if n == "oil_temperature" else wave) for n in names]


def rates(model, t):
    """Return the rates with which a step from ``t`` ends where the profile does."""
    pairs = zip(profile(model, t), profile(model, t + RATES_H), strict=True)
    return [(b - a) / RATES_H for a, b in pairs]


def run(instance, model):
    """Return the outputs after 20 steps with rates."""
    instance.initialize(0.0, dict(zip(instance.input_names, profile(model, 0.0), strict=True)))
    for i in range(20):
        instance.set_inputs(profile(model, i * RATES_H))
        instance.set_rates(rates(model, i * RATES_H))
        instance.step(i * RATES_H, RATES_H)
    return instance.outputs()


@pytest.mark.parametrize("model", STARTS)
def test_fmi_2_with_input_derivatives_is_the_kernels_to_the_bit(model):
    with Instance(built_fmu(model, local=True)) as fmu:
        assert run(fmu, model) == run(DirectInstance(find_spec(model)), model)


@pytest.mark.parametrize("model", STARTS)
def test_fmi_3_gets_the_inputs_at_the_end_of_a_step_in_a_callback(model, tmp_path):
    path = str(built_fmu(model, fmi=3, local=True))
    described = read_model_description(path)
    listed = described.modelVariables
    inputs, outputs = (
        [v for v in listed if v.causality == kind and v.type == "Float64"]
        for kind in ("input", "output")
    )
    wanted = [v.valueReference for v in inputs]
    fmu = FMU3Slave(
        guid=described.guid,
        unzipDirectory=extract(path, str(tmp_path)),
        modelIdentifier=described.coSimulation.modelIdentifier,
    )

    def at_time(_, time, *others):
        if others[0]:  # values are requested
            fmu.setFloat64(wanted, profile(model, time))

    fmu.instantiate(intermediateUpdate=at_time, requiredIntermediateVariables=wanted)
    fmu.enterInitializationMode(startTime=0.0)
    fmu.setFloat64(wanted, profile(model, 0.0))
    fmu.exitInitializationMode()
    for i in range(20):
        fmu.setFloat64(wanted, profile(model, i * RATES_H))
        fmu.doStep(i * RATES_H, RATES_H)
    found = fmu.getFloat64([v.valueReference for v in outputs])
    got = dict(zip([v.name for v in outputs], found, strict=True))
    fmu.freeInstance()
    direct = DirectInstance(find_spec(model))
    named = dict(zip(direct.output_names, run(direct, model), strict=True))
    assert got == pytest.approx({n: named[n] for n in got}, rel=1e-9, abs=1e-9)


# What a Python FMU says it can do, it can; what it says it cannot, it refuses.


@pytest.fixture
def bare(fmus, tmp_path):
    """A clutch that is given a logger and nothing else: no allocator, no environment."""
    path = str(fmus["WetClutch"])
    described = read_model_description(path)
    fmu = FMU2Slave(
        guid=described.guid,
        unzipDirectory=extract(path, str(tmp_path)),
        modelIdentifier="WetClutch",
    )
    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(lambda *_: None)
    fmu.instantiate(callbacks=callbacks)
    fmu.setupExperiment()
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    yield fmu
    fmu.freeInstance()


def test_it_runs_without_memory_functions(bare):
    bare.doStep(0.0, 1e-3)
    state = bare.getFMUstate()
    bare.setFMUstate(state)
    bare.freeFMUstate(state)
    assert bare.getReal([0]) == [1e-3]


def test_what_it_cannot_do_is_not_answered_with_ok(bare):
    one, real = (ctypes.c_uint * 1)(1), (ctypes.c_double * 1)(1.0)
    order = (ctypes.c_int * 1)(1)
    for call in (
        lambda: bare.fmi2GetDirectionalDerivative(bare.component, one, 1, one, 1, real, real),
        lambda: bare.fmi2SetRealInputDerivatives(bare.component, one, 1, order, real),
        lambda: bare.fmi2GetRealOutputDerivatives(bare.component, one, 1, order, real),
        lambda: bare.fmi2CancelStep(bare.component),
    ):
        with pytest.raises(FMICallException):
            call()
    bare.doStep(0.0, 1e-3)


@pytest.mark.parametrize("name", ["WetClutch"])  # native ones: test_native_package
@pytest.mark.slow
def test_checkers_find_nothing(name, fmus):
    tools = Path(sys.executable).parent
    done = subprocess.run([tools / "fmpy", "validate", fmus[name]], capture_output=True, text=True)
    assert (done.returncode, done.stdout.strip()) == (0, "No problems found."), done.stderr
    command = [needed.tool("fmutool"), "-input", fmus[name], "-check"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    said = done.stdout + done.stderr
    assert "seems to be compliant" in said
    assert not [line for line in said.splitlines() if line.startswith(("ERROR", "WARN", "CRIT"))]
