"""What was measured of each model, for the card on the page inside its FMU.

Each figure stands in docs/accuracy.md, with how it was measured; a test holds the two together.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Measured:
    """One row of the card: ``worst`` is the largest difference from ``against``."""

    quantity: str
    against: str
    worst: str


_MESHES = "values converged over meshes up to 129 x 512 nodes, twenty points of every regime"
_RADAU = "the equations written again, integrated by an implicit method at 1e-10"

CARDS: dict[str, tuple[Measured, ...]] = {
    "ThrustWasher": (
        Measured("friction torque, field / fine", _MESHES, "0.18 % / 0.092 %"),
        Measured("film ratio, field / fine", _MESHES, "0.030 / 0.0031"),
        Measured("mean temperature before distress, field / fine", _MESHES, "0.041 K / 0.020 K"),
        Measured("load at which the film is lost, field", "fine meshes", "0.32 %"),
        Measured("load at which it is regained, field", "fine meshes", "0.04 %"),
    ),
    "WetClutch": (
        Measured("torque under sudden load, 1 ms steps", _RADAU, "1e-7"),
        Measured("temperature under sudden load", _RADAU, "5e-7 K"),
        Measured("torque, inputs held for 1 ms of a smooth course", _RADAU, "2 %"),
        Measured("boundary friction", "extended precision", "1e-15"),
        Measured("contact integrals", "extended precision", "1e-10"),
    ),
    "GearMesh": (
        Measured("every closed form", "a second derivation, random meshes and loads", "1e-9"),
        Measured("loss with more than two pairs in contact", "numerical integration", "3e-5"),
    ),
    "ShiftTransmission": (
        Measured("speeds in first gear", "closed form of the Modelica scene", "see the tests"),
        Measured("lock time and speed", "event-driven reference", "falls with the step"),
        Measured("energy book", "output energy_residual, shown in every run", "see the output"),
    ),
}
NOTE = (
    "These are errors of the solution of the equations below. Whether they are the right equations "
    "for your part only a measurement tells; the open parameters are there to be fitted."
)
