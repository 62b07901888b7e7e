"""Shifts with the kernels in this process; a washer with Petroff's torque keeps it quick."""

from dataclasses import replace
from functools import cache
from time import perf_counter

import numba
import pytest

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift import cosimulate, load_scene

NO_DRAG = {"washer": None, "mesh": None, "transmission": {"washers": 0}}
NOMINAL = """
[engine]
points = [[0.0, 253.0], [0.42, 253.0], [0.46, 188.0], [0.79, 188.0], [0.83, 250.0], [0.87, 253.0]]
[pressure.clutch]
points = [[0.1, 0.0], [0.11, "40 kPa"], [0.2, "40 kPa"], [0.4, "336 kPa"], [0.79, "355 kPa"],
          [0.9, "420 kPa"], [0.97, "720 kPa"]]
"""  # profiles of the default shift that suit its nominal values, not its scatter
KEPT = 12  # runs
_runs = {}
slow_without_jit = pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="minutes without JIT")


class PetroffWasher:
    """Stands in for the washer: torque proportional to speed, always a thick film."""

    def __init__(self, spec):
        self.input_names = [s.name for s in spec.inputs]
        self.output_names = [s.name for s in spec.outputs]
        self.values = [0.0] * len(self.input_names)
        self.calls, self.wall_time = 0, 0.0
        self.instantiate_time = self.initialize_time = 0.0
        self.log = []

    def initialize(self, start_time, inputs):
        self.values = [inputs[n] for n in self.input_names]

    def set_inputs(self, values):
        self.values = list(values)

    def step(self, t, h):
        begin = perf_counter()
        self.calls += 1
        self.log.append((t, h, *self.values))
        self.wall_time += perf_counter() - begin

    def outputs(self):
        _, speed, _, oil, *_ = self.values
        known = {
            "friction_torque": 7.5e-5 * speed,
            "temperature": oil,
            "temperature_max": oil,
            "film_ratio": 6.0,
            "friction_power": 7.5e-5 * speed**2,
            "regime": 1.0,
        }
        return [known.get(n, 0.0) for n in self.output_names]


def instances(scene):
    """Return an instance for every part."""
    return {
        name: PetroffWasher(part.spec)
        if name == "washer"
        else DirectInstance(part.spec, parameters=part.parameters())
        for name, part in scene.parts.items()
    }


def shift(name, *, parts=None, **options):
    """Run a scene by name; ``parts`` maps a part to changed parameters, or to None to leave it.

    A ``fidelity`` among the parameters is the part's level. The last runs are kept: tests of a
    file share them.
    """
    key = repr((name, parts, options))
    if key not in _runs:
        while len(_runs) >= KEPT:
            del _runs[next(iter(_runs))]
        _runs[key] = _run(name, parts, options)
    return _runs[key]


def _run(name, parts, options):
    scene = load_scene(name).with_options(**options)
    changed = dict(scene.parts)
    for part, values in (parts or {}).items():
        if values is None:
            del changed[part]
        else:
            given = dict(values)
            level = given.pop("fidelity", changed[part].fidelity)
            params = replace(changed[part].params, **given)
            changed[part] = replace(changed[part], params=params, fidelity=level)
    scene = replace(scene, parts=changed)
    return cosimulate(scene, instances(scene))


def changed(folder, text, base="planetary"):
    """Return a scene as a file of the folder changes it."""
    path = folder / "mine.toml"
    path.write_text(f'base = "{base}"\n{text}', encoding="utf-8")
    return load_scene(path)


def with_all_parts(scene):
    """Return a scene and an instance for every part, the washer among them."""
    parts = scene.parts.items()
    return scene, {n: DirectInstance(p.spec, parameters=p.parameters()) for n, p in parts}


@cache
def real_shift(name):
    """Return a scene's result with its own washer."""
    return cosimulate(*with_all_parts(load_scene(name)))


@cache
def default_shift():
    """Return the result of the sun-driven scene at its own step."""
    return shift("planetary-sun")
