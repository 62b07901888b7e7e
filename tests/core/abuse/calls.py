"""One random call of each kind, judged: right or refused by name; anything else is raised."""

import dataclasses
import math

import claims
import draws

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    ParameterError,
    SolveError,
    WasherParams,
    solve_clutch,
    solve_gearmesh,
    solve_washer,
)
from thrustwasher.model.registry import find_spec
from thrustwasher.model.spec import Signal

RIGHT, REFUSED, UNSOLVED = "right", "refused by name", "no solution, by name"
LEVELS = {
    "washer": ("field",),
    "gearmesh": ("field", "fine"),
    "clutch": ("closed", "stribeck", "field", "fine"),
}
POWER = Signal(name="power", unit="W", help="", low=-1e9, high=1e9)
SANE = {
    "washer": (solve_washer, WasherParams, {"load": 300.0, "speed": 953.0, "tilt": 0.002}),
    "clutch": (solve_clutch, ClutchParams, {"load": 9000.0, "speed": 5.0}),
    "gearmesh": (solve_gearmesh, GearMeshParams, {"power": 7500.0, "speed": 180.0}),
}


class Wrong(AssertionError):
    """An answer that calls itself right and is not, or a failure without a name."""


def say_if_wrong(found, *where):
    if found:
        raise Wrong(f"{'; '.join(found)}: {where}")


def named(error, names):
    """Return how it ended if the message is one line and names an argument; else raise."""
    text = str(error)
    if "\n" in text or not any(name in text for name in names):
        raise Wrong(f"refused without a name: {text!r}") from error
    return UNSOLVED if isinstance(error, SolveError) else REFUSED


def solve_once(model, rng):
    """Call a model's function with random parameters, point and level, and its mirror image."""
    solve, cls, _ = SANE[model]
    spec = find_spec(model)
    signals = list(spec.inputs)
    if model == "gearmesh":
        signals[0] = POWER
    changed, _ = draws.settings(rng, spec)
    point, legal = draws.point(rng, signals)
    if model == "gearmesh" and legal and rng.random() < 0.8:  # most powers ask for too much torque
        torque = draws.inside(rng, 0.0, 1e5)
        point["power"] = min(torque * abs(point["speed"]), 1e9)
    level = rng.choice(LEVELS[model])
    where = f"{changed} {point} {level}"
    known = [*changed, *point, "throw", "fidelity", *(f.name for f in dataclasses.fields(cls))]
    try:
        params = cls(**changed)
        result = solve(params, **point, fidelity=level)
    except (ParameterError, SolveError) as error:
        return named(error, known)
    say_if_wrong([] if legal else ["taken though outside its range"], where)
    say_if_wrong(judged(model, params, point, result), where, result)
    turned = {name: -point[name] for name in ("speed", "drum_speed") if name in point}
    mirror = solve(params, **{**point, **turned}, fidelity=level)
    share = 1e-8 if model == "washer" else 0.0  # a mesh is walked through the other way round
    odd = claims.close(mirror.friction_torque, -result.friction_torque, share)
    say_if_wrong([] if odd else ["not odd in speed"], where, result, mirror)
    return RIGHT


def judged(model, params, point, r):
    """Return what is wrong with a result."""
    found = [] if claims.finite(r) else ["not finite"]
    found += [r.status.name] if r.status.is_failure else []
    speed, oil = point["speed"], point["oil_temperature"]
    if model == "washer":
        return found + claims.broken(claims.washer(r))
    if model == "clutch":
        return found + claims.broken(claims.clutch(r, params, point["load"], speed, oil))
    return found + claims.broken(claims.gearmesh(r, speed, oil))


def sane_bits(model):
    """Return the bits of a sane answer: they stay the same whatever was called before."""
    solve, cls, point = SANE[model]
    return solve(cls(), **point).friction_torque.hex()


class Walk:
    """An instance that is set, stepped, rolled back and reset at random, and judged."""

    def __init__(self, spec, instance, tolerance=1e-11):
        self.spec, self.instance, self.tolerance = spec, instance, tolerance
        self.counts = {RIGHT: 0, REFUSED: 0, UNSOLVED: 0}
        self.time, self.inputs = 0.0, {}
        self.begin()

    def begin(self):
        self.inputs = {s.name: s.start or 0.0 for s in self.spec.inputs}
        self.instance.initialize(0.0, self.inputs)
        self.time = 0.0

    def move(self, rng):
        """Set, step and look; sometimes do it twice from the same state, or begin anew."""
        kind = rng.randrange(12)
        if kind == 0:
            self.instance.reset()
            self.begin()
        state, time = (self.instance.get_state() if kind < 4 else None), self.time
        values, legal = draws.point(rng, self.spec.inputs)
        step = rng.choice([1e-3, 1e-3, 1e-2, 1e-6, 0.3])
        first = self._try(values, step, legal)
        if state is None:
            return
        self.instance.set_state(state)
        self.time = time
        again = self._try(values, step, legal, count=False)
        say_if_wrong([] if first == again else ["a rolled back step differs"], values, step)
        if rng.random() < 0.5:
            data = self.instance.serialize(state)
            other = self.instance.deserialize(data)
            self.instance.set_state(other)
            self.time = time
            third = self._try(values, step, legal, count=False)
            say_if_wrong([] if third == first else ["a state from bytes differs"], values, step)
            self.instance.free_state(other)
        self.instance.free_state(state)

    def _try(self, values, step, legal, count=True):
        """Return outputs in hex, or the sentence of a failure; the time goes on in any case."""
        spec, instance = self.spec, self.instance
        known = [*values, "input", "step"]
        try:
            instance.set_inputs(list(values.values()))
            instance.step(self.time, step)
            found = dict(zip(instance.output_names, instance.outputs(), strict=True))
        except (ParameterError, SolveError) as error:
            self.counts[named(error, known)] += count
            self._cure()
            return type(error).__name__
        say_if_wrong([] if legal else ["taken though outside its range"], values)
        say_if_wrong(
            claims.broken(claims.outputs(spec, values, found, self.tolerance)), values, step, found
        )
        self.counts[RIGHT] += count
        self.time += step if math.isfinite(step) else 0.0
        self.inputs = values
        return tuple(x.hex() for x in found.values())

    def _cure(self):
        """After a refusal good values are taken, and the outputs are there."""
        self.instance.set_inputs(list(self.inputs.values()))
        found = dict(zip(self.instance.output_names, self.instance.outputs(), strict=True))
        wrong = claims.broken(claims.outputs(self.spec, self.inputs, found, self.tolerance))
        say_if_wrong(wrong, self.inputs)


def run_once(model, rng, make):
    """Run an instance with random parameters for some steps; it ends well or says why not."""
    spec = find_spec(model)
    changed, legal = draws.settings(rng, spec)
    known = [f.name for f in dataclasses.fields(spec.params)]
    known += [s.name for s in spec.inputs] + ["fidelity", "at the start"]
    try:
        walk = Walk(spec, make(spec, changed), changed.get("tolerance", 1e-11))
    except (ParameterError, SolveError) as error:
        return named(error, known)
    say_if_wrong([] if legal else ["taken though outside its range"], changed)
    try:
        for _ in range(8):
            walk.move(rng)
    except Wrong as error:
        raise Wrong(f"{error} with {changed}") from error
    return max(walk.counts, key=lambda end: walk.counts[end])
