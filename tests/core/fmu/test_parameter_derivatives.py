"""Derivatives over tunable parameters, at any time; they leave no trace."""

from contextlib import contextmanager

import pytest
from built import built_fmu

from thrustwasher import WasherParams, solve_washer
from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.washer.parameters import SPEC

POINT = {"load": 300.0, "speed": 545.0, "tilt": 0.002}
OUTPUTS = ["friction_torque", "temperature", "film_ratio", "oil_flow"]
PAPER = {"oil_cooling": False, "film_heat_fraction": 0.8}
ways = pytest.mark.parametrize("way", ["kernels", "native-fmi2", "native-fmi3"])


def fmu_of(model, way):
    target, fmi = way.split("-fmi")
    return built_fmu(model, target=target, fmi=int(fmi), local=True)


@contextmanager
def washer(way, **parameters):
    if way == "kernels":
        yield DirectInstance(SPEC, parameters=parameters)
        return
    instance = Instance(fmu_of("washer", way), parameters=parameters)
    yield instance
    instance.close()


@ways
@pytest.mark.parametrize("parameters", [{}, PAPER], ids=["oil cools", "paper"])
def test_shares_of_heat_have_the_derivatives_of_the_solution(way, parameters):
    solved = solve_washer(WasherParams(**parameters), **POINT).sensitivities(OUTPUTS)
    with washer(way, **parameters) as instance:
        instance.initialize(inputs=POINT)
        instance.step(0.0, 1e-3)
        for name in ("heat_split", "film_heat_fraction") if parameters else ("heat_split",):
            found = instance.directional_derivative(OUTPUTS, [name], [2.0])
            for output, value in zip(OUTPUTS, found, strict=True):
                rows = solved[output]
                values = {p: getattr(WasherParams(**parameters), p) for p in rows}
                largest = max(abs(values[p] * slope) for p, slope in rows.items())
                off = abs(0.5 * value - rows[name]) * values[name]
                assert off <= 1e-6 * largest, (output, name)


@ways
def test_asking_leaves_no_trace(way):
    rows = []
    for asks in (False, True):
        with washer(way) as instance:
            instance.initialize(inputs=POINT)
            for k in range(3):
                instance.step(k * 1e-3, 1e-3)
                if asks:
                    instance.directional_derivative(OUTPUTS, ["heat_split", "load"], [1.0, 2.0])
            rows.append(instance.outputs())
    assert rows[0] == rows[1]


@ways
def test_what_a_rule_holds_has_none_and_says_so(way):
    if way == "kernels":
        pytest.skip("the shell knows the rules")
    with washer(way) as instance:
        instance.initialize(inputs=POINT)
        instance.step(0.0, 1e-3)
        with pytest.raises(SolveError, match="film_heat_fraction = 1 has no derivative here"):
            instance.directional_derivative(OUTPUTS, ["film_heat_fraction"], [1.0])
        with pytest.raises((SolveError, ParameterError), match="roughness: derivatives are of"):
            instance.directional_derivative(OUTPUTS, ["roughness"], [1.0])
        instance.step(1e-3, 1e-3)


def test_a_clutchs_torque_grows_with_its_friction_scale():
    instance = Instance(
        fmu_of("clutch", "native-fmi3"), parameters={"friction_scale": 0.9, "holding": "off"}
    )
    instance.initialize(inputs={"load": 9000.0, "speed": 2.0})
    for k in range(40):  # until the faces touch
        instance.step(k * 0.01, 0.01)
    (torque,) = instance.get(["friction_torque"])
    (slope,) = instance.directional_derivative(["friction_torque"], ["friction_scale"], [1.0])
    assert 0.5 * torque < 0.9 * slope < 1.001 * torque
    assert instance.get(["friction_torque"]) == [torque]
    instance.close()
