"""Runs that model exchange and co-simulation share: engagements, several units, noise, rest."""

import numpy as np
from coupled import Line, Part
from engagements import TWELVE
from shafts import HEATS, SHAFTS

PRESSED = {"starts_pressed": True}
WASHER = {"fidelity": 1}  # by its map, which co-simulation takes too


def ramp(t, begin, end, before, after):
    return before + (after - before) * min(max((t - begin) / (end - begin), 0.0), 1.0)


def noise(seed, low, high, lines=12):
    """Return a function of time: sines at random frequencies [Hz], of deviation 1."""
    rng = np.random.default_rng(seed)
    turns = 2.0 * np.pi * rng.uniform(low, high, lines)
    phases, size = rng.uniform(0.0, 2.0 * np.pi, lines), np.sqrt(2.0 / lines)
    return lambda t: float(size * np.sum(np.sin(turns * t + phases)))


def pack(slip, load, oil=350.0, **more):
    inputs = lambda t: {"load": load(t), "oil_temperature": oil}  # noqa: E731
    return Part("clutch", slip, inputs, PRESSED | more)


def known(inertias):
    """Return what co-simulation needs where several packs hold the same two shafts."""
    return {"holding": 2, "coupling_inertia": 1.0 / sum(1.0 / x for x in inertias)}


def engagement(plant):
    return Line(
        [pack((1.0, -1.0), plant.pressed, plant.oil)],
        plant.inertias,
        plant.torques,
        plant.speeds,
        (0.01 * plant.rise, plant.rise),
    )


def on_shaft(key, shaft, parameters):
    """Return a run of a mesh or a train that brakes one shaft."""
    torque, heat = HEATS[key]
    inputs = lambda t: {n: x for n, x in shaft.inputs(t, 0.0).items() if n != "speed"}  # noqa: E731
    part = Part(key, (1.0,), inputs, parameters, torque, heat)
    return Line([part], (shaft.inertia,), (shaft.drive,), (shaft.speed,), shaft.jumps)


LINE = {"inertias": (0.15, 1.0), "torques": (60.0, -20.0)}
BETWEEN = (1.0, -1.0)
HANDING = Line(
    [
        pack(BETWEEN, lambda t: ramp(t, 0.5, 0.7, 5000.0, 0.0), **known(LINE["inertias"])),
        pack(BETWEEN, lambda t: ramp(t, 0.3, 0.5, 0.0, 5000.0), **known(LINE["inertias"])),
    ],
    speeds=(20.0, 0.0),
    jumps=(0.3, 0.5, 0.7),
    **LINE,
)
PARALLEL = Line(
    [
        pack(BETWEEN, lambda t: ramp(t, 0.0, 0.1, 50.0, 3000.0)),
        pack(BETWEEN, lambda t: ramp(t, 0.0, 0.2, 50.0, 2000.0)),
    ],
    speeds=(100.0, 0.0),
    jumps=(0.1, 0.2),
    **LINE,
)
WASHER_BESIDE = Line(
    [
        pack((1.0,), lambda t: ramp(t, 0.0, 0.1, 50.0, 2000.0)),
        Part(
            "washer",
            (1.0,),
            lambda t: {"load": 300.0, "tilt": 0.002, "oil_temperature": 320.0},
            WASHER,
            heat=("oil_energy",),
        ),
    ],
    (0.05,),
    (5.0,),
    (100.0,),
    (0.1,),
)
TREMBLE, SHAKE, BEAT = noise(3, 5.0, 50.0), noise(4, 5.0, 50.0), noise(6, 5.0, 50.0)
SLIDING = Line(
    [pack(lambda t: 100.0 + 15.0 * SHAKE(t), lambda t: 4000.0 * (1.0 + 0.1 * BEAT(t)))],
)
THROUGH_ZERO = Line(
    [pack(lambda t: 10.0 * TREMBLE(t), lambda t: 4000.0 * (1.0 + 0.1 * BEAT(t)))],
)
HELD = Line(
    [pack(BETWEEN, lambda t: ramp(t, 0.0, 0.1, 50.0, 5000.0) * (1.0 + 0.1 * BEAT(t)))],
    speeds=(50.0, 0.0),
    jumps=(0.1,),
    **LINE,
)
NOISE = {
    "noise on slip and load, sliding": SLIDING,
    "noise on slip and load, through 0": THROUGH_ZERO,
    "noise on the load of a pack that locks": HELD,
}
CASES = {
    **{f"engagement {k + 1}": engagement(plant) for k, plant in enumerate(TWELVE)},
    "two packs hand over at rest": HANDING,
    "two packs in parallel": PARALLEL,
    "washer next to a pack that locks": WASHER_BESIDE,
    **NOISE,
    **{name: on_shaft(*SHAFTS[name]) for name in SHAFTS},
}
