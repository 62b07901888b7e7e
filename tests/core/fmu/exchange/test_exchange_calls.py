"""Model exchange of every unit that has it: calls, modes, states, derivatives, by FMI 2 and 3."""

import ctypes
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from built import built_fmu
from exchanged import unit
from fmpy import read_model_description
from fmpy.fmi1 import FMICallException

from thrustwasher.fmu.description.interface import interface
from thrustwasher.model.registry import all_specs

SPECS = {s.key: s for s in all_specs(helpers=True)}
UNITS = [key for key, spec in SPECS.items() if spec.exchange]
each_unit = pytest.mark.parametrize("key", UNITS)
both = pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.slow)])


def at_work(key):
    """Return inputs at which something happens."""
    return {s.name: s.usual * 1.01 for s in SPECS[key].inputs if not s.name.startswith("energy_")}


def moved(u):
    """Return states away from the start by parts of their nominal values."""
    return u.x() + u.nominals() * np.linspace(0.02, 0.05, u.n)


@each_unit
def test_what_co_simulation_has_keeps_its_value_references(key):
    shown = interface(SPECS[key])
    assert [v.reference for v in shown.everything] == list(range(len(shown.everything)))
    assert all(v.reference >= len(shown.variables) for v in shown.exchanged)
    described = read_model_description(str(built_fmu(key, local=True)))
    for v, element in zip(shown.variables, described.modelVariables, strict=False):
        assert (v.name, v.reference) == (element.name, element.valueReference)


@each_unit
@both
def test_there_are_states_nominal_values_and_an_event_indicator(key, fmi):
    with unit(key, fmi) as u:
        u.start(**at_work(key))
        assert u.n > 0 and (u.nominals() > 0.0).all()
        assert len(u.z()) >= 1 and np.isfinite(u.z()).all()
        assert np.isfinite(u.dx()).all()
        listed = dict(zip(u.states, u.x(), strict=True))
        assert u.get(*listed) == list(listed.values()) or u.n == 1
        assert np.array_equal(np.atleast_1d(u.get(*(f"der({n})" for n in listed))), u.dx())


@each_unit
@both
def test_what_is_tried_and_rejected_leaves_no_trace(key, fmi):
    with unit(key, fmi) as u:
        u.start(**at_work(key))
        first, x = u.dx(), u.x()
        for size in (1e-3, -1e-2, 0.1):
            u.fmu.setTime(size)
            u.put(x + size * u.nominals())
            u.dx(), u.z()
        u.put(x)
        assert u.dx().tobytes() == first.tobytes()


@each_unit
@both
def test_derivatives_are_those_of_the_values(key, fmi):
    """Central differences of two sizes, extrapolated."""
    with unit(key, fmi) as u:
        u.start(**at_work(key))
        u.put(moved(u))
        shown = interface(SPECS[key])
        unknowns = [v.name for v in (*shown.outputs, *shown.derivatives) if v.type == "Real"]
        inputs = {v.name: v for v in shown.inputs if v.type == "Real"}
        inputs = {n: v for n, v in inputs.items() if not n.startswith(("energy_", "far_face"))}
        x, given = u.x(), dict(zip(inputs, np.atleast_1d(u.get(*inputs)), strict=True))
        sizes = {**{n: v.nominal or 1.0 for n, v in inputs.items()}}
        sizes |= dict(zip(u.states, u.nominals(), strict=True))

        def values(known, h):
            if known in given:
                u.set(**{known: given[known] + h})
            else:
                u.put(x + h * np.array([n == known for n in u.states]))
            found = np.atleast_1d(u.get(*unknowns))
            u.put(x)
            u.set(**given)
            return found

        for known, size in sizes.items():
            rough, fine = (
                (values(known, h) - values(known, -h)) / (2.0 * h)
                for h in (2e-4 * size, 1e-4 * size)
            )
            expected = (4.0 * fine - rough) / 3.0
            found = u.along(unknowns, [known], [1.0])
            room = np.abs(values(known, 0.0)) / size + np.abs(expected).max() * 1e-3
            assert np.all(np.abs(found - expected) <= 1e-6 * np.abs(expected) + 1e-8 * room), known


@each_unit
@both
def test_a_state_that_is_put_back_goes_on_with_the_same_bits(key, fmi):
    with unit(key, fmi) as u:
        u.start(**at_work(key))
        u.put(moved(u))
        before = u.x().tobytes() + u.dx().tobytes() + u.z().tobytes()
        got, put = (getattr(u.fmu, n, None) for n in ("getFMUstate", "setFMUstate"))
        got, put = got or u.fmu.getFMUState, put or u.fmu.setFMUState
        state = got()
        u.put(u.x() + u.nominals())
        u.dx()
        put(state)
        assert u.x().tobytes() + u.dx().tobytes() + u.z().tobytes() == before


@each_unit
@both
def test_each_instance_has_the_functions_of_its_own_kind_alone(key, fmi):
    with unit(key, fmi) as u, unit(key, fmi, "CoSimulation") as c:
        u.start(**at_work(key))
        instance, time = ctypes.c_void_p(u.fmu.component), ctypes.c_double(0.0)
        if fmi == 2:
            assert u.fmu.dll.fmi2DoStep(instance, time, ctypes.c_double(1e-3), 1) == 3
        else:
            assert u.fmu.dll.fmi3EnterStepMode(instance) == 3
        assert any(b"model exchange, not for co-simulation" in _bytes(a) for a in u.said + c.said)
        if fmi == 2:
            c.fmu.setupExperiment(startTime=0.0)
        c.fmu.enterInitializationMode()
        c.fmu.exitInitializationMode()
        set_time = c.fmu.dll.fmi2SetTime if fmi == 2 else c.fmu.dll.fmi3SetTime
        assert set_time(ctypes.c_void_p(c.fmu.component), time) == 3
        assert any(b"co-simulation, not for model exchange" in _bytes(a) for a in u.said + c.said)


def _bytes(message):
    return b" ".join(x if isinstance(x, bytes) else str(x).encode() for x in message)


@each_unit
def test_states_that_are_no_numbers_ask_for_a_shorter_step(key):
    with unit(key) as u:
        u.start(**at_work(key))
        first = u.dx()
        bad = u.x()
        bad[0] = np.nan
        with pytest.raises(FMICallException, match=r"discard"):
            u.put(bad)
        assert u.dx().tobytes() == first.tobytes()


@each_unit
def test_the_order_of_calls_of_openmodelica_works(key):
    """Time of a new instance, no experiment, states in event mode, one pass, no next time."""
    with unit(key) as u:
        f = u.fmu
        f.setTime(0.5)
        f.enterInitializationMode()
        f.exitInitializationMode()
        x = u.x()
        f.setTime(0.5)
        u.put(x)
        assert len(u.z()) == u.description.numberOfEventIndicators
        f.enterEventMode()
        *_, defined, next_time = f.newDiscreteStates()
        assert defined or next_time > 1e300
        f.enterContinuousTimeMode()
        assert np.isfinite(u.dx()).all()
        f.completedIntegratorStep()


@each_unit
def test_parameters_that_are_set_while_it_initializes_act(key):
    """As OpenModelica 1.28 sets them; one state of its own shows that they are taken."""
    rates = []
    for early in (True, False):
        with unit(key) as u:
            given = {v.name: _start(v) for v in u.variables.values() if v.causality == "parameter"}
            given |= {n: 0.1 for n in ("rest_damping_time",) if n in given}
            u.fmu.setupExperiment(startTime=0.0)
            u.set(**(given if early else {}))
            u.fmu.enterInitializationMode()
            u.set(**({} if early else given))
            u.set(**at_work(key))
            u.fmu.exitInitializationMode()
            u.put(moved(u))
            u.update()
            rates.append(u.dx().tobytes())
    assert rates[0] == rates[1]


def _start(v):
    return {"Real": float, "Boolean": lambda x: x == "true"}.get(v.type, int)(v.start)


@each_unit
def test_times_beyond_the_end_and_beyond_events_are_answered(key):
    with unit(key) as u:
        u.start(**at_work(key))
        for t in (1e6, 0.0, -1.0, 3.0):
            u.fmu.setTime(t)
            assert np.isfinite(u.dx()).all()


@each_unit
@pytest.mark.slow
def test_a_checker_finds_nothing(key):
    command = [Path(sys.executable).parent / "fmutool", "-input"]
    command += [str(built_fmu(key, local=True)), "-check"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert "seems to be compliant" in done.stdout + done.stderr


@each_unit
@both
def test_in_co_simulation_states_are_those_of_the_outputs_and_derivatives_their_change(key, fmi):
    """Film ratio and temperatures are outputs too; a bristle there is none."""
    step, same = 0.01, {"film": "film_ratio", "plate_temperature_1": "temperature"}
    same |= {"body_temperature": "bulk_temperature"}
    same |= {f"mesh_{i}_body_temperature": f"mesh_{i}_bulk_temperature" for i in (1, 2)}
    with unit(key, fmi, "CoSimulation") as u:
        u.fmu.setupExperiment(startTime=0.0) if fmi == 2 else None
        u.fmu.enterInitializationMode()
        u.set(**at_work(key))
        u.fmu.exitInitializationMode()
        states = [n for n in u.states if not n.endswith("bend")]
        others = [n for n in states if n in same and same[n] in u.variables]
        rates, before = [f"der({n})" for n in states], np.array(u.get(*states, "time"))
        assert not np.any(u.get(*rates))
        for k in range(5):
            u.fmu.doStep(k * step, step)
            now = np.array(u.get(*states, "time"))
            assert u.get(*rates, "time")[:-1] == list((now - before)[:-1] / step)
            assert [u.get(n) for n in others] == [u.get(same[n]) for n in others]
            before = now
        assert np.any(np.array(u.get(*rates)) != 0.0)


@both
def test_rings_in_co_simulation_have_the_heat_that_is_stored_in_them(fmi):
    with unit("clutch", fmi, "CoSimulation") as u:
        u.fmu.setupExperiment(startTime=0.0) if fmi == 2 else None
        u.set(fidelity=5)
        u.fmu.enterInitializationMode()
        u.set(load=20e3, speed=50.0, oil_temperature=350.0, drum_speed=100.0)
        u.fmu.exitInitializationMode()
        rings = [f"plate_temperature_{k}" for k in range(1, 5)]
        assert u.get(*rings) == [350.0] * 4
        for k in range(20):
            u.fmu.doStep(k * 0.01, 0.01)
        hot = u.get(*rings)
        assert min(hot) > 350.5 and len(set(hot)) == 4
        assert min(hot) <= u.get("temperature") <= max(hot)
