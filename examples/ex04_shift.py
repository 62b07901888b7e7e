"""A gear shift of FMUs, and what half the communication step changes."""

import tempfile
from contextlib import ExitStack
from pathlib import Path

from thrustwasher.fmu.build import build
from thrustwasher.fmu.stepper import Instance
from thrustwasher.shift import cosimulate, load_scene


def lock_time(step: float, fmus: dict[str, Path]) -> float:
    scene = load_scene("msl").with_options(step=step)
    with ExitStack() as loaded:
        instances = {
            name: loaded.enter_context(
                Instance(fmus[part.spec.name], parameters=part.parameters(), name=name)
            )
            for name, part in scene.parts.items()
        }
        return cosimulate(scene, instances).figures["lock_time"]


def main() -> float:
    with tempfile.TemporaryDirectory() as folder:
        paths = build(["WetClutch", "ShiftTransmission"], target="python", out=Path(folder))
        fmus = {path.stem: path for path in paths}
        for step in (2e-3, 1e-3):
            locked = lock_time(step, fmus)
            print(f"step {1e3 * step:.1f} ms: the clutch locks at {locked:.6f} s")
    return locked


if __name__ == "__main__":
    main()
