"""What is recorded: of each name a function that computes it anew."""

import importlib.util
from collections.abc import Callable
from contextlib import redirect_stdout
from dataclasses import replace
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from lab.golden.record import Value, bits, numbers
from lab.verify import cases
from thrustwasher import calibrate, calibrate_traces, optimise, propagate, run_sweep
from thrustwasher.clutch.solve import ClutchParams
from thrustwasher.fmu.build import build
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.documentation.reference_results import input_rows
from thrustwasher.ladder.choose import levels_of
from thrustwasher.model.registry import all_specs
from thrustwasher.model.spec import ModelSpec
from thrustwasher.shift import load_scene
from thrustwasher.shift.from_fmus import fmu_instances, run_scene
from thrustwasher.shift.scene.scene import Scene
from thrustwasher.shift.scene.scene_file import builtin_scenes
from thrustwasher.shift.scene.sequence import sequence_of
from thrustwasher.studio.verification.reference_cache import SOURCES, answer, reference_points

EXAMPLES = Path(__file__).parents[2] / "examples"
SHIFTS = 2  # of a scene with a sequence
POINTS = 2  # of each case of the verification tables
Values = dict[str, Value]


def fmus() -> Values:
    """Return the outputs of all FMUs over their default experiment, in both FMI versions."""
    found: Values = {}
    specs = all_specs(helpers=True)
    with TemporaryDirectory() as folder:
        for fmi in (2, 3):
            names = [spec.name for spec in specs]
            for spec, path in zip(
                specs, build(names, fmi=fmi, out=Path(folder), local=True), strict=True
            ):
                found |= bits(f"{spec.name} FMI {fmi}:", _simulated(spec, path))
    return found


def _simulated(spec: ModelSpec, fmu: Path) -> dict[str, Any]:
    from fmpy import simulate_fmu

    names = [signal.name for signal in spec.outputs]
    rows = np.array(input_rows(spec))
    inputs = np.zeros(len(rows), [(n, float) for n in ("time", *(s.name for s in spec.inputs))])
    for name, column in zip(inputs.dtype.names or (), rows.T, strict=True):
        inputs[name] = column
    stop, step = interface(spec).experiment
    table = simulate_fmu(
        str(fmu),
        stop_time=stop,
        output_interval=step,
        output=names,
        input=inputs if spec.inputs else None,
        logger=lambda *_: None,
    )
    return {name: table[name] for name in names}


def shifts() -> Values:
    """Return all outputs of all built-in scenes, run by FMUs at their own levels and steps."""
    found: Values = {}
    for name in builtin_scenes():
        scene = _first_shifts(load_scene(name))
        with fmu_instances(scene) as make:
            result = run_scene(scene, make, guard=False)
        outputs = {f"{n}.{own.name}" for n, p in scene.parts.items() for own in p.spec.outputs}
        columns = {n: column for n, column in result.signals.items() if n in outputs}
        found |= bits(f"{name}:", columns)
    return found


def _first_shifts(scene: Scene) -> Scene:
    if scene.sequence is None:
        return scene
    own = sequence_of(scene)
    few = replace(own, shifts=own.shifts[:SHIFTS])
    return replace(scene, sequence=few, stop_time=few.shifts[-1][0] + own.window)


SWEEPS: dict[str, dict[str, object]] = {
    "washer": {"load": "300:1200:60, 1180:300:-60", "speed": [436.0, 953.0], "tilt": [0.0, 0.002]},
    "clutch": {"load": "1000:6000:500", "speed": "5:205:20", "oil_temperature": [300.0, 380.0]},
    "gearmesh": {"load": "50:300:25", "speed": "50:450:50", "oil_temperature": [300.0, 380.0]},
}


def sweeps() -> Values:
    """Return the outputs of three models over ranges of their inputs."""
    found: Values = {}
    for model, over in SWEEPS.items():
        table = run_sweep(model, over, workers=1)
        found |= bits(f"{model}:", {name: table[name] for name in table.outputs()})
    return found


def _example(name: str) -> Any:
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    if spec is None or spec.loader is None:
        raise FileNotFoundError(EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    with redirect_stdout(StringIO()):
        spec.loader.exec_module(module)
    return module


def fits() -> Values:
    """Return what the fits of the examples find: friction law, recording, folds of a washer."""
    law, trace, folds = map(_example, ("ex06_calibrate", "ex17_engagement", "ex14_jackson_green"))
    friction = calibrate(
        ClutchParams(), speed=law.SLIP, load=law.FORCE, friction=law.read_rig()
    ).to_dict()
    recording = calibrate_traces(
        ClutchParams(), trace.TRACE, fit=tuple(trace.TRUTH), piston_area=trace.AREA
    ).to_dict()
    _, start, fit = folds.FITS[0]
    paper = calibrate(start, folds.read(), fit=fit, fidelity="field").to_dict()
    return (
        numbers("friction law:", friction)
        | numbers("engagements:", recording)
        | numbers("folds of a washer:", paper)
    )


SEARCHES: dict[tuple[str, str], dict[str, Any]] = {
    ("washer", "least friction with a film"): {
        "vary": {"roughness": "0.3 um:1 um", "washer_thickness": "0.5 mm:2 mm"},
        "minimise": "friction_torque",
        "limits": ["film_ratio>=18"],
        "at": {"load": "300 N", "speed": "953 rad/s", "tilt": 0.002},
    },
    ("gearmesh", "front of loss and safety"): {
        "vary": {"face_width": "15 mm:40 mm", "profile_shift_pinion": "0:0.4"},
        "minimise": "friction_power",
        "maximise": "pitting_safety",
        "points": 4,
    },
    ("planetary", "heat of a quick shift"): {
        "vary": {"clutch.friction_scale": "0.9:1.1"},
        "minimise": "slip_energy",
        "limits": ["lock_after_ramp_start<=0.9"],
    },
}


def searches() -> Values:
    """Return what searches find: a washer, the front of a gear mesh, a shift."""
    found: Values = {}
    for (target, what), options in SEARCHES.items():
        result = optimise(target, **options, workers=1).to_dict()
        found |= numbers(f"{target}, {what}:", result)
    return found


STUDIES: dict[str, dict[str, Any]] = {
    "washer": {"runs": 64, "outputs": ("friction_torque", "film_ratio")},
    "clutch": {"runs": 64, "outputs": ("friction_torque", "temperature")},
    "gearmesh": {"runs": 64, "outputs": ("friction_power", "temperature")},
    "planetary": {"runs": 8, "outputs": ("slip_energy", "peak_jerk"), "indices": False},
}


def scatter() -> Values:
    """Return bands and indices of the three models and of a shift, from a fixed seed."""
    found: Values = {}
    for target, options in STUDIES.items():
        result = propagate(target, **options, seed=1, workers=1).to_dict()
        found |= numbers(f"{target}:", result)
    return found


def tables() -> Values:
    """Return references and levels at the first random points of the verification tables."""
    found: Values = {}
    for model, source in SOURCES.items():
        for case in cases(model):
            for k, known in enumerate(reference_points(case, source, POINTS)):
                place = f"{model} {case.name}, {k}"
                found |= numbers(f"{place}, reference:", known.values)
                for level in levels_of(case.spec, case.params):
                    values = answer(model, case.params, level, known).values
                    found |= numbers(f"{place}, {level}:", values)
    return found


RECORDED: dict[str, tuple[str, Callable[[], Values]]] = {
    "fmus": ("bits", fmus),
    "shifts": ("bits", shifts),
    "sweeps": ("bits", sweeps),
    "fits": ("numbers", fits),
    "searches": ("numbers", searches),
    "scatter": ("numbers", scatter),
    "tables": ("numbers", tables),
}
