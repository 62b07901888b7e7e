"""Rows of real drivelines with exact speeds, and the same seen through sensors."""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from . import sensors
from .drive import FRICTION, RADIUS, STRIBECK, TABLE, Scene, run
from .plants import elastic, gearbox, ideal_slips, steps_of, two_shafts
from .verdict import Verdict, engagement, stays

Run = Callable[[str, int, str, float], list[Verdict]]
AFTER = 220  # steps after the exact lock
INERTIA, RATIO, STEPS, SLIP = (1e-3, 30.0), (0.01, 100.0), (25, 300), (5.0, 300.0)
CAPACITY, HELD = (1.0, 1000.0), (-0.3, 0.7)
ROUGH = (20.0, 300.0)  # first slips where the sensor's error is absolute


def rng_of(row: str, seed: int) -> np.random.Generator:
    """Return the random numbers of a row's driveline."""
    return np.random.default_rng([seed, zlib.crc32(row.encode())])


def spread(rng: np.random.Generator, ends: tuple[float, float]) -> float:
    """Return a value between the ends, evenly in its logarithm."""
    return float(math.exp(rng.uniform(*map(math.log, ends))))


@dataclass(frozen=True)
class Draw:
    """A random engagement: inertias, capacity after a ramp, first slip, torque to hold."""

    inertia: float  # kg m2, that the slip sees
    j1: float
    j2: float
    capacity: float
    ramp: float  # s
    first: float  # rad/s
    held: float  # N m
    push: tuple[float, float]  # on side 1, against side 2
    base: float  # rad/s of side 2
    lock: int  # steps to the exact lock, about
    step: float
    rng: np.random.Generator

    def strength(self, t: float) -> float:
        """Capacity over time."""
        return self.capacity * min(1.0, 0.1 + 0.9 * t / self.ramp)


def drawn(row: str, seed: int, step: float, slip: tuple[float, float] = SLIP) -> Draw:
    """Draw an engagement that the pack can hold and whose numbers are those of drivelines."""
    rng = rng_of(row, seed)
    if step <= 0:  # any step
        step = spread(rng, (1e-4, 5e-3))
    while True:
        inertia, ratio = spread(rng, INERTIA), spread(rng, RATIO)
        lock, first = round(spread(rng, STEPS)), spread(rng, slip)
        share, part = rng.uniform(*HELD), rng.uniform(0.05, 0.4)
        ramp = part * lock * step
        # impulse of the capacity less that of the torque to hold stops the slip
        mean = 1.0 - 0.5 * 0.9 * part
        capacity = inertia * first / (lock * step * (mean - share))
        if CAPACITY[0] <= capacity <= CAPACITY[1]:
            break
    j1, j2 = inertia * (1 + 1 / ratio), inertia * (1 + ratio)  # j2 = ratio j1
    held = share * capacity
    drive = rng.uniform(-1, 1) * capacity
    push = (drive, j2 * (held / inertia - drive / j1))
    base = rng.uniform(0.0, 200.0)
    return Draw(inertia, j1, j2, capacity, ramp, first, held, push, base, lock, step, rng)


def engaged(d: Draw, seed: int, kind: str = "equal", **more) -> Scene:
    """Return the rigid scene of a draw."""
    side = 1.0 if d.rng.random() < 0.5 else -1.0
    plant = two_shafts(d.j1, d.j2, d.base + side * d.first, d.base)
    push = (side * d.push[0], side * d.push[1])
    count = d.lock + AFTER
    given = {
        "plant": plant,
        "times": steps_of(d.step, count, kind, seed),
        "load": lambda t, s: [d.strength(t)] * len(s),
        "outside": lambda t: push,
        "capacity": d.capacity,
        "first": d.first,
        "inertia": [d.inertia],
        "age": seed % 3,
    }
    return Scene(**(given | more))


def rigid(seed: int, step: float) -> Scene:
    return engaged(drawn("rigid", seed, step), seed, exact=True)


def jumps(seed: int, step: float) -> Scene:
    """Outside torque that jumps three times while the pack holds."""
    d = drawn("jumps", seed, step)
    scene = engaged(d, seed, exact=True)
    marks = [d.lock + 60 + 50 * k for k in range(3)]
    levels = [d.rng.uniform(-0.75, 0.75) * d.capacity for _ in marks]
    push = scene.outside(0.0)

    def outside(t: float) -> tuple[float, float]:
        k = round(t / d.step)
        level = [level for mark, level in zip(marks, levels, strict=True) if k >= mark]
        return (push[0], d.j2 * (level[-1] / d.inertia - push[0] / d.j1)) if level else push

    return replace(scene, outside=outside, watched=marks)


def varied(seed: int, step: float) -> Scene:
    return engaged(drawn("varied", seed, step), seed, kind="varied")


def ripple(periods: tuple[float, float]) -> Callable[[int, float], Scene]:
    """Outside torque with a sine of 0.1 to 0.33 of capacity; ``periods``: in steps."""

    def scene(seed: int, step: float) -> Scene:
        d = drawn("ripple", seed, step)
        found = engaged(d, seed)
        size = min(d.rng.uniform(0.1, 0.33), 0.95 - abs(d.held) / d.capacity) * d.capacity
        period, phase = spread(d.rng, periods) * d.step, d.rng.uniform(0, 2 * math.pi)
        push, whole = found.outside(0.0), d.j1 / d.inertia  # the pack sees a part of the torque

        def outside(t: float) -> tuple[float, float]:
            return push[0] + whole * size * math.sin(2 * math.pi * t / period + phase), push[1]

        return replace(found, outside=outside)

    return scene


def shaft(per_period: int) -> Callable[[int, float], Scene]:
    """Engine, pack, hub, elastic shaft, vehicle; ``per_period`` steps in the open pack's period."""

    def scene(seed: int, step: float) -> Scene:
        d = drawn("elastic", seed, step)  # side 2: hub and vehicle
        # slip lasts 15 steps or more, if the hub alone is slowed
        least = 15 * d.capacity * d.step / (d.inertia * d.first)
        near = d.inertia * spread(d.rng, (max(0.1, min(least, 0.8)), 0.8))
        hub = near * d.j1 / (d.j1 - near)
        vehicle = d.j2 - hub
        damping = d.rng.uniform(0.01, 0.04)
        period = per_period * d.step * d.rng.uniform(1.0, 1.1)
        other = hub * vehicle / d.j2
        stiffness = other * (2 * math.pi / period) ** 2
        damper = 2 * damping * math.sqrt(stiffness * other)
        base = engaged(d, seed, inertia=[near])
        brake = base.outside(0.0)[1]
        at_start = math.copysign(d.strength(0.0), base.plant.slip[0])
        twist = (brake + vehicle * (at_start - brake) / d.j2) / stiffness
        speeds = base.plant.state
        state = np.array([speeds[0], speeds[1], speeds[1], twist])
        plant = elastic(d.j1, hub, vehicle, stiffness, damper, state)
        return replace(base, plant=plant)

    return scene


def hand_over(seed: int, step: float) -> Scene:
    """One pack holds a gear; return the scene in which another, of another ratio, takes over."""
    rng = rng_of("hand over", seed)
    step = step if step > 0 else spread(rng, (1e-4, 5e-3))
    motor, vehicle = spread(rng, (0.02, 0.5)), spread(rng, (0.3, 10.0))
    torque = rng.uniform(30.0, 150.0)
    low, high = rng.uniform(2.0, 3.5), rng.uniform(0.9, 1.8)
    speed = rng.uniform(20.0, 80.0)
    motor_speed = low * speed
    first = motor_speed - high * speed
    whole = 1 / (1 / motor + high**2 / vehicle)
    steps = spread(rng, (60, 300))
    hold = whole * (torque / motor)  # without road load, in the new gear
    strength = hold + whole * first / (steps * step)
    ramp, gone = rng.uniform(0.2, 0.6) * steps * step, rng.uniform(0.3, 0.8) * steps * step
    start = 10 * step

    def load(t: float, s) -> list[float]:
        going = max(0.0, 1.0 - max(0.0, t - start) / gone)
        coming = min(1.0, max(0.0, t - start) / ramp)
        return [3.0 * torque * going, strength * coming]

    count = round(1.6 * steps) + AFTER
    return Scene(
        plant=gearbox(motor, vehicle, (low, high), np.array([motor_speed, speed])),
        times=steps_of(step, count, "equal", seed),
        load=load,
        outside=lambda t: (torque, 0.0),
        capacity=strength,
        first=first,
        inertia=[1 / (1 / motor + low**2 / vehicle), whole],
        age=seed % 3,
        judged=1,
    )


def parallel(seed: int, step: float) -> Scene:
    """Two packs on the same shafts; each is told its share of the inertia."""
    d = drawn("parallel", seed, step)
    share = d.rng.uniform(0.3, 0.7)
    scene = engaged(d, seed, exact=True)
    push, first = scene.outside(0.0), scene.plant.state
    return replace(
        scene,
        plant=two_shafts(d.j1, d.j2, float(first[0]), float(first[1]), packs=2),
        load=lambda t, s: [share * d.strength(t), (1 - share) * d.strength(t)],
        inertia=[share * d.inertia, (1 - share) * d.inertia],
        outside=lambda t: push,
    )


def changing(seed: int, step: float) -> Scene:
    """Friction that rises or falls by 30 % from standstill to the first slip."""
    d = drawn("changing", seed, step)
    slope = d.rng.uniform(-0.3, 0.3)
    pack = {"fidelity": STRIBECK, "friction_law": TABLE, "table_friction_0": FRICTION}
    for k in range(1, 6):
        pack[f"table_speed_{k}"] = d.first * RADIUS * k / 5
        pack[f"table_friction_{k}"] = FRICTION * (1 + slope * k / 5)

    def load(t: float, s) -> list[float]:
        return [d.strength(t)] * len(s)

    scene = engaged(d, seed, pack=pack)

    def right(t: float, s) -> list[float]:
        return [d.strength(t) * (1 + slope * min(1.0, abs(v) / d.first)) for v in s]

    scene.__dict__["ideal"] = ideal_slips(scene.plant, scene.outside, right, scene.times)
    return replace_kept(scene, load=load)


def replace_kept(scene: Scene, **more) -> Scene:
    """Return a scene with other values and the ideal run of the first."""
    kept = scene.__dict__["ideal"]
    other = replace(scene, **more)
    other.__dict__["ideal"] = kept
    return other


def twice(seed: int, step: float) -> Scene:
    """Return a scene whose host steps the unit twice per value of the slip."""
    return engaged(drawn("twice", seed, step), seed, repeats=2)


def seen_by(name: str, make, quantum: float = 0.0, sigma=None) -> Callable[[int, float], Scene]:
    """Return a rigid scene seen through a sensor; ``make(first, seed)`` makes it."""

    def scene(seed: int, step: float) -> Scene:
        d = drawn("sensor", seed, step, ROUGH)  # the same drivelines for all sensors
        noise = sigma(d.first) if sigma else 0.0
        return engaged(d, seed, sensor=make(d.first, seed), quantum=quantum, sigma=noise)

    scene.__name__ = name
    return scene


def noise(share: float):
    make = lambda first, seed: sensors.noisy(share * first, seed)  # noqa: E731
    return seen_by(f"noise {share:g}", make, sigma=lambda first: share * first)


def closed_at_start(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
    """Let a pack that is closed at the start hold a small torque: at most twice of it acts."""
    rng = rng_of("closed", seed)
    step = step if step > 0 else spread(rng, (1e-4, 5e-3))
    capacity, inertia, ratio = 165.0, spread(rng, (0.01, 1.0)), spread(rng, RATIO)
    held = -5.4 if seed == 0 else rng.choice([-1, 1]) * spread(rng, (0.01, 0.1)) * capacity
    j1, j2 = inertia * (1 + 1 / ratio), inertia * (1 + ratio)
    drive = rng.uniform(-1, 1) * 10
    push = (drive, j2 * (held / inertia - drive / j1))
    speed = rng.uniform(0, 100)
    scene = Scene(
        plant=two_shafts(j1, j2, speed, speed),
        times=steps_of(step, 400, "equal", seed),
        load=lambda t, s: [capacity],
        outside=lambda t: push,
        capacity=capacity,
        first=1.0,
        inertia=[inertia],
        age=seed % 3,
    )
    trace = run(fmu, scene, holding)
    torque, why = trace.acted[:, 0], []
    most, last = float(np.abs(torque / held).max()), np.abs(torque[100:] / held - 1).max()
    if most > 2.001:
        why.append(f"acts with {most:.3g} times the torque to hold")
    if last > 0.02:
        why.append(f"holds with an error of {last:.2g}")
    return [Verdict(not why, trace.told, "; ".join(why), "", {"most": most})]


def long_enough(scene: Scene) -> Scene:
    """Return a scene in which ideal packs lock and then hold for 100 steps."""
    small = 1e-3 * abs(scene.first)
    for _ in range(4):
        lock = stays(scene.ideal[0][:, scene.judged], small)
        if lock + AFTER // 2 < len(scene.times):
            return scene
        h, last, n = scene.times[1], scene.times[-1], len(scene.times)
        scene = replace(scene, times=(*scene.times, *(last + h * (k + 1) for k in range(n))))
    raise RuntimeError("ideal packs do not lock: the driveline is drawn wrong")


def of(make: Callable[[int, float], Scene], holding: str | None = None) -> Run:
    """Return the run of a scene; ``holding`` overrules the command's."""

    @lru_cache(maxsize=512)
    def kept(seed: int, step: float) -> Scene:
        return long_enough(make(seed, step))

    def one(fmu: str, seed: int, wanted: str, step: float) -> list[Verdict]:
        scene = kept(seed, step)
        return [engagement(scene, run(fmu, scene, holding or wanted))]

    one.scene, one.holding = kept, holding  # type: ignore[attr-defined]
    return one


EXACT: dict[str, Run] = {
    "rigid": of(rigid),
    "jumps of outside torque": of(jumps),
    "steps x0.5, 1, 2": of(varied),
    "ripple 0.1 .. 0.33 C, 30 .. 300 steps": of(ripple((30, 300))),
    "ripple 0.1 .. 0.33 C, 8 .. 30 steps": of(ripple((8, 30))),
    "elastic, 30 steps a period": of(shaft(30)),
    "elastic, 12 steps a period": of(shaft(12)),
    "two packs hand over": of(hand_over),
    "two in parallel": of(parallel),
    "two in parallel, given": of(parallel, "given"),
    "capacity +-30 % with slip": of(changing),
    "master repeats each step": of(twice),
    "closed at the start": closed_at_start,
}
SENSORS: dict[str, Run] = {
    "0.1 rad/s": of(seen_by("0.1", lambda f, s: sensors.quantised(0.1), 0.1)),
    "1 rpm": of(seen_by("1 rpm", lambda f, s: sensors.quantised(sensors.RPM), sensors.RPM)),
    "12 bit": of(
        seen_by("12 bit", lambda f, s: sensors.quantised(sensors.TWELVE_BIT), sensors.TWELVE_BIT)
    ),
    **{f"noise {x:g} of the first slip": of(noise(x)) for x in (1e-5, 1e-4, 1e-3, 1e-2)},
    "noise 0.5 rpm": of(
        seen_by(
            "0.5 rpm",
            lambda f, s: sensors.noisy(0.5 * sensors.RPM, s),
            sigma=lambda f: 0.5 * sensors.RPM,
        )
    ),
    "lag 5 ms": of(seen_by("lag", lambda f, s: sensors.lagging(5e-3))),
    "one speed held 10 ms": of(seen_by("one", lambda f, s: sensors.refreshed(10e-3, False))),
    **{
        f"both speeds held {ms} ms": of(
            seen_by("both", lambda f, s, ms=ms: sensors.refreshed(ms * 1e-3, True))
        )
        for ms in (2, 10, 20)
    },
}
