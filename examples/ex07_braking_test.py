"""A brake stops an inertia: the published test, then with a moving oil film, cold and hot."""

from dataclasses import replace

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift import Scene, ShiftResult, cosimulate, load_scene


def brake(scene: Scene) -> ShiftResult:
    """Run a scene with the kernels in this process, without FMUs."""
    instances = {
        name: DirectInstance(part.spec, parameters=part.parameters())
        for name, part in scene.parts.items()
    }
    return cosimulate(scene, instances)


def main() -> float:
    published = load_scene("brake-test-sample")
    result = brake(published)
    for entry in result.comparison():
        print(f"{entry['text']}: published {entry['published']:.4g}, here {entry['run']:.4g}")

    moving = replace(published.parts["brake"], fidelity="field")
    for celsius in (24.0, 60.0, 90.0):
        scene = replace(
            published,
            oil_temperature=celsius + 273.15,
            parts={**published.parts, "brake": moving},
        ).checked()
        figures = brake(scene).figures
        share, taken = figures["brake_viscous_share"], figures["lock_after_half_ramp"]
        print(f"oil {celsius:g} degC: {taken:.3f} s, {share:.0%} of the heat made in the oil")
    return result.figures["lock_after_half_ramp"]


if __name__ == "__main__":
    main()
