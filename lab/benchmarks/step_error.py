"""Errors of the communication step: as a run estimates them, and as they are.

Run: python -m lab.benchmarks.step_error [SCENE ...]

The truth is a run at 0.05 ms; the error of lock-up time is relative to the time since the shift's
start. The last column is what the run at twice the step alone would have said.
"""

import sys
from dataclasses import replace

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift import Scene, ShiftResult, cosimulate, load_scene
from thrustwasher.shift.checks.step_error import errors_between, recorded_parts, step_error

SCENES = ("planetary", "planetary-downshift", "planetary-sun")
STEPS = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0)  # ms
TRUE = 0.05  # ms


class AnyStep(Scene):
    """A scene whose step may be longer than makes sense."""

    __slots__ = ()

    def check_step(self) -> None:
        """Let every step pass."""


def run(scene, given=None):
    parts = scene.parts.items()
    made = {n: DirectInstance(p.spec, parameters=p.parameters()) for n, p in parts}
    return cosimulate(scene, {**made, **(given or {})})


def main(names):
    for name in names:
        loaded = load_scene(name)
        fields = {f: getattr(loaded, f) for f in loaded.__dataclass_fields__}
        scene, truth = AnyStep(**fields), None
        print(f"{name}: estimated / true error in %; [by twice the step]")
        for ms in STEPS:
            found: ShiftResult = run(replace(scene, step=1e-3 * ms))
            played = recorded_parts(scene, found.time, found.signals)
            truth = truth or run(replace(scene, step=1e-3 * TRUE), played)
            twice = errors_between(run(replace(scene, step=2e-3 * ms), played), found, 1.0)
            said = step_error(
                found,
                lambda s, given: {
                    n: given.get(n) or DirectInstance(p.spec, parameters=p.parameters())
                    for n, p in s.parts.items()
                },
                cosimulate,
            ).errors()
            true = errors_between(found, truth, 1.0)
            words = (
                f"{n} {1e2 * said[n]:.2g} / {1e2 * true[n]:.2g} [{1e2 * twice[n]:.2g}]"
                for n in true
            )
            print(f"  {ms:4g} ms  {', '.join(words)}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:] or SCENES)
