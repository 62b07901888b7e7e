"""The compiled loop steps FMUs as the Python loop does: same numbers, same errors, same counts."""

from dataclasses import replace

import numba
import numpy as np
import pytest
from built import built_fmu
from toy.places import TOY_SLAVES
from toy.spec import SPEC as TOY

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.scene.scene import Part

pytestmark = pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="nothing is compiled then")
MODELS = ["ShiftTransmission", "WetClutch"]
KINDS = ["native-fmi2", pytest.param("native-fmi3", marks=pytest.mark.fmi3), "python-fmi2"]
STEPS = 60


@pytest.fixture(scope="module", params=KINDS)
def fmus(request):
    """The FMUs of one kind by name, the toy among them."""
    target, _, version = request.param.partition("-fmi")
    options = {"target": target, "fmi": int(version), "local": True}
    made = [built_fmu(model, **options) for model in MODELS]
    made.append(built_fmu(TOY.key, sources=TOY_SLAVES, **options))
    return {path.stem: path for path in made}


def planetary(master="gauss-seidel", start=0.01, duration=0.04):
    """Return the first steps of the default shift, without what takes long to build."""
    scene = load_scene("planetary-sun").with_options(stop_time=STEPS * 1e-3, master=master)
    parts = {name: part for name, part in scene.parts.items() if name not in ("washer", "mesh")}
    return replace(scene, parts=parts, shift_start=start, shift_duration=duration)


def with_toy(force, **parameters):
    """Return the scene with the toy as its clutch, pressed with ``force``."""
    scene = planetary()
    gearbox = scene.parts["transmission"]
    params = replace(gearbox.params, coupling="torque", clutch_force=force)
    toy = Part(spec=TOY, fidelity="coarse", params=TOY.params(**parameters))
    parts = {**scene.parts, "transmission": replace(gearbox, params=params), "clutch": toy}
    return replace(scene, parts=parts)


def run(scene, fmus, compiled, **options):
    """Run a scene; return the result, or the failure, and the instances."""
    made = {
        name: Instance(fmus[part.spec.name], parameters=part.parameters(), name=name)
        for name, part in scene.parts.items()
    }
    try:
        return cosimulate(scene, made, compiled=compiled, **options), made
    except (ParameterError, SolveError) as failure:
        return failure, made
    finally:
        for instance in made.values():
            instance.close()


def same(a, b):
    return all(np.array_equal(a.signals[name], b.signals[name]) for name in a.signals)


@pytest.mark.parametrize("master", ["gauss-seidel", "jacobi"])
def test_every_signal_is_equal_to_the_bit(fmus, master):
    scene = planetary(master)
    (slow, _), (quick, _) = (run(scene, fmus, compiled) for compiled in (False, True))
    assert np.ptp(quick.signals["clutch.film_ratio"]) > 0.0
    assert same(slow, quick)
    assert quick.events == slow.events and quick.figures == slow.figures


def in_process(scene):
    """Run a scene with the kernels of this process."""
    parts = {n: DirectInstance(p.spec, parameters=p.parameters()) for n, p in scene.parts.items()}
    return cosimulate(scene, parts)


def test_derivatives_through_fmi_correct_the_torques_as_those_of_the_kernels(fmus):
    """Python FMUs have none: there the outputs' differences serve, and the run says so."""
    scene = planetary("linearly-implicit")
    gearbox = scene.parts["transmission"]
    gearbox = replace(gearbox, params=replace(gearbox.params, coupling="torque"))
    scene = replace(scene, parts={**scene.parts, "transmission": gearbox})
    (found, made), wanted = run(scene, fmus, None), in_process(scene)
    exact = made["clutch"].gives_derivatives
    assert any("took differences" in message for message in found.messages) is not exact
    slip, other = (r.signals["transmission.clutch_speed"] for r in (found, wanted))
    np.testing.assert_allclose(slip, other, rtol=1e-9 if exact else 2e-4)
    with pytest.raises(ParameterError, match="master 'gauss-seidel' or 'jacobi'"):
        raise run(scene, fmus, True)[0]


def test_calls_and_their_time_are_counted(fmus):
    (slow, _), (quick, _) = (run(planetary(), fmus, compiled) for compiled in (False, True))
    assert [c.steps for c in quick.cost] == [c.steps for c in slow.cost] == [STEPS] * 3
    assert all(0.0 < c.wall_time < quick.wall_time for c in quick.cost)
    assert sum(c.wall_time for c in quick.cost) + quick.overhead == pytest.approx(quick.wall_time)


@pytest.mark.parametrize(
    ("force", "kind", "text"),
    [
        (9500.0, SolveError, "clutch at t = 0.048 s: .*MAX_ITERATIONS"),
        (60000.0, ParameterError, "clutch at t = 0.017 s: load = 10500 N is outside 0 .. 10000 N"),
    ],
)
def test_a_failure_is_told_as_by_the_python_loop(fmus, force, kind, text):
    (slow, _), (quick, made) = (run(with_toy(force), fmus, compiled) for compiled in (False, True))
    assert isinstance(slow, SolveError) and isinstance(slow.__cause__, kind)
    assert str(quick) == str(slow)
    assert type(quick) is type(slow) and type(quick.__cause__) is type(slow.__cause__)
    with pytest.raises(SolveError, match=text):
        raise quick
    assert made["clutch"].calls > 5


def test_a_warning_does_not_stop_a_run_and_is_kept(fmus, monkeypatch):
    monkeypatch.setattr("thrustwasher.shift.run.key_figures", lambda *_: [])  # a toy has none
    scene = with_toy(8000.0, heat_capacity=1.0)
    (slow, told), (quick, retold) = (run(scene, fmus, compiled) for compiled in (False, True))
    assert same(slow, quick)
    assert max(quick.signals["clutch.solver_status"]) > 0.0
    assert len(told["clutch"].warnings) == 1
    assert retold["clutch"].warnings == told["clutch"].warnings


def test_progress_is_told_to_the_end(fmus):
    told = []
    run(planetary(), fmus, True, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (STEPS, STEPS) and told == sorted(set(told))


def test_fmus_are_stepped_compiled_unless_asked_otherwise(fmus, monkeypatch):
    monkeypatch.setattr(Instance, "step", lambda *_: pytest.fail("stepped from Python"))
    assert len(run(planetary(), fmus, None)[0].time) == STEPS + 1


def test_kernels_without_fmus_are_stepped_in_python():
    scene = planetary()
    parts = {n: DirectInstance(p.spec, parameters=p.parameters()) for n, p in scene.parts.items()}
    with pytest.raises(ParameterError, match="with FMUs for all parts"):
        cosimulate(scene, parts, compiled=True)
    assert len(cosimulate(scene, parts).time) == STEPS + 1
