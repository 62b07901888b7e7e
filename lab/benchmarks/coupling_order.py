"""Order of the coupling error in the communication step: inputs held, and inputs with rates.

Run: python -m lab.benchmarks.coupling_order [MILLISECONDS ...]

A clutch alone, `holding` = off: load and slip by smooth functions of time, known to the master.
Pack and transmission: the default shift without washer and mesh, stepped by masters as in hosts of
FMI 2.0. `parallel` steps all parts with the outputs of the last point, `in turn` the packs first.
Their rates are differences of the last two points; the transmission in turn gets the packs'
capacities at both ends of its step. `held`: `input_profile` of the packs is held, as it starts in
the FMUs, and the transmission does not extrapolate capacities; `extrapolated`: it does, with a
linear profile, as in `thrustwasher shift`. Errors are relative to a run with rates at a much
shorter step; times count from the first pressure, 0.1 s. The order is the slope of log(error) over
log(step), fitted to all steps: where pressure and engine torque have a corner inside a step single
errors scatter.
"""

import math
import sys
from collections.abc import Callable, Sequence

import numpy as np

from thrustwasher.clutch import parameters as clutch
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift import load_scene
from thrustwasher.shift.scene.connections import wired

STEPS = (1.0, 2.0, 5.0, 10.0)  # ms
ALONE = 0.4  # s
BEGIN = 0.1  # s, of the shift
CHAIN = ("transmission", "clutch", "brake")
Figures = dict[str, float]


def load(t: float) -> float:
    """Return the force on the clutch alone [N]."""
    return 2500.0 - 2000.0 * math.cos(math.pi * t / ALONE)


def slip(t: float) -> float:
    """Return its slip [rad/s]."""
    return 60.0 + 90.0 * math.cos(0.5 * math.pi * t / ALONE)


def alone(level: str, step: float, moving: bool) -> Figures:
    """Step a clutch through its profile; ``step`` [s]."""
    unit = DirectInstance(clutch.SPEC, parameters={"fidelity": level, "holding": "off"})
    unit.initialize(0.0, {"load": load(0.0), "speed": slip(0.0), "oil_temperature": 350.0})
    for i in range(round(ALONE / step)):
        t, end = i * step, (i + 1) * step
        unit.set_inputs([load(t), slip(t)])
        if moving:
            unit.set_rates([(load(end) - load(t)) / step, (slip(end) - slip(t)) / step])
        unit.step(t, step)
    names = ["energy", "temperature"]
    heated = dict(zip(names, unit.get(names), strict=True))
    return {"energy": heated["energy"], "temperature": heated["temperature"] - 350.0}


class Chain:
    """Packs and transmission of the default shift, and the values that pass between them."""

    def __init__(self, step: float, in_turn: bool, moving: bool, extrapolates: bool) -> None:
        scene = load_scene("planetary")
        own = {
            "capacity_extrapolation": extrapolates,
            "torque_age": 0 if in_turn else 1,
            "tolerance": 1e-10,
        }
        self.parts = {}
        for name in CHAIN:
            part = scene.parts[name]
            profile = {"input_profile": "linear" if extrapolates and not moving else "held"}
            more = own if name == "transmission" else profile
            self.parts[name] = DirectInstance(part.spec, parameters=part.parameters() | more)
        self.links = [k for k in wired(scene.parts) if k.source in CHAIN and k.target in CHAIN]
        self.step, self.in_turn, self.moving, self.n = step, in_turn, moving, 0
        self.stop = scene.stop_time
        self.outputs: dict[str, list[float]] = {}
        for one in self.parts.values():
            one.initialize(0.0)
        for _ in range(4):
            for name, one in self.parts.items():
                self.outputs[name] = one.outputs()
                for target in CHAIN:
                    self.parts[target].set_inputs(self.inputs(target, self.outputs))
        self.outputs = {name: one.outputs() for name, one in self.parts.items()}
        self.before = self.outputs

    def inputs(self, name: str, outputs: dict[str, list[float]]) -> list[float]:
        """Return the inputs of a part that belong to these outputs of the others."""
        one = self.parts[name]
        values = dict(zip(one.input_names, one.core.inp.tolist(), strict=True))
        for link in self.links:
            if link.target == name and link.source in outputs:
                place = self.parts[link.source].output_names.index(link.output)
                values[link.input] = outputs[link.source][place]
        return list(values.values())

    def advance(self, name: str, now: list[float], ahead: list[float]) -> None:
        """Step a part with its inputs, and with rates towards what they will be."""
        one = self.parts[name]
        one.set_inputs(now)
        if self.moving:
            one.set_rates([(b - a) / self.step for a, b in zip(now, ahead, strict=True)])
        one.step(self.n * self.step, self.step)

    def __call__(self) -> Figures:
        """Run to the end."""
        while self.n < round(self.stop / self.step):
            old, now = self.before, self.outputs
            given = {name: self.inputs(name, now) for name in CHAIN}
            ahead = {
                name: [
                    2.0 * b - a for a, b in zip(self.inputs(name, old), given[name], strict=True)
                ]
                for name in CHAIN
            }
            fresh: dict[str, list[float]] = {}
            for name in reversed(CHAIN):
                if name == "transmission" and self.in_turn:
                    ahead[name] = self.inputs(name, fresh)
                    given[name] = given[name] if self.moving else ahead[name]
                self.advance(name, given[name], ahead[name])
                fresh[name] = self.parts[name].outputs()
            self.before, self.outputs, self.n = now, fresh, self.n + 1
        names = ["lock_time", "release_time", "clutch_heat"]
        lock, release, heat = self.parts["transmission"].get(names)
        return {
            "lock-up": lock - BEGIN,
            "release": release - BEGIN,
            "clutch heat": heat,
            "clutch energy": self.parts["clutch"].get(["energy"])[0],
        }


def show(
    title: str, steps: Sequence[float], run: Callable[[float], Figures], true: Figures
) -> None:
    """Print errors at steps [ms] and their order."""
    found = [run(1e-3 * ms) for ms in steps]
    print(f"  {title}")
    for name, value in true.items():
        errors = [abs(f[name] / value - 1.0) for f in found]
        order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
        words = ", ".join(f"{1e2 * e:.2g}" for e in errors)
        print(f"    {name:14} {words} %; order {order:.1f}", flush=True)


def main(steps: Sequence[float]) -> None:
    """Print both parts."""
    print(f"errors at {', '.join(f'{ms:g}' for ms in steps)} ms")
    for level in ("stribeck", "field"):
        print(f"clutch alone, {level}")
        true = alone(level, 2e-5, True)
        for moving in (False, True):
            words = "with rates" if moving else "held"
            show(words, steps, lambda h, r=level, m=moving: alone(r, h, m), true)  # type: ignore[misc]
    print("pack and transmission")
    true = Chain(5e-5, True, True, True)()
    print("  " + ", ".join(f"{name} {value:.6g}" for name, value in true.items()))
    for in_turn in (False, True):
        order = "in turn" if in_turn else "parallel"
        for moving, extrapolates in ((False, False), (False, True), (True, True)):
            words = "with rates" if moving else "extrapolated" if extrapolates else "held"
            options = in_turn, moving, extrapolates
            show(f"{order}, {words}", steps, lambda h, o=options: Chain(h, *o)(), true)  # type: ignore[misc]


if __name__ == "__main__":
    main([float(x) for x in sys.argv[1:]] or STEPS)
