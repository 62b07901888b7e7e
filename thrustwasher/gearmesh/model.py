"""The record of the gear mesh."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from ..model.record import Command, Ladder, Model, Sweep, Values, Variants
from ..model.spec import ModelSpec, Signal

if TYPE_CHECKING:
    from .solve import GearMeshResult

KERNELS = ("thrustwasher.gearmesh.kernels.operating_point",)
BOX = {
    "load": (1.0, 200.0, "log"),
    "speed": (1.0, 700.0, "log"),
    "oil_temperature": (250.0, 400.0, "linear"),
}


class GearMesh(Model):
    """The gear mesh."""

    key = "gearmesh"
    wiring = (
        "Subtract friction_torque from the torque that the mesh transmits, at the pinion.",
        "In a ShiftTransmission plug it into the terminal mesh: one pair stands for one planet.",
        "Of a planetary set mates_pinion is 2, mates_gear the number of planets: bodies count "
        "once then.",
    )
    command = Command(
        help="temperatures, stresses, safety and loss of a gear mesh at one point",
        examples=(
            'thrustwasher gearmesh --power "60 kW" --speed "3000 rpm" --plot mesh.png',
            'thrustwasher gearmesh --power "60 kW" --speed "3000 rpm" --set '
            '"face_width=30 mm" --oil "ISO VG 220"',
        ),
        title="gear mesh, {pinion_teeth} teeth, ratio {gear_ratio:g},",
        closing="{limits}; {iterations} iterations, {fidelity}",
        ranks=True,
        plot="draw temperatures and safety or stress factors over the pinion's teeth",
        instead={
            "load": Signal(
                name="power",
                unit="W",
                low=-1e9,
                high=1e9,
                start=7500.0,
                help="power at the pinion; below 0 the gear drives (law efficiency)",
            )
        },
        extra={
            "asperity_temperature": ("K", "temperature of the asperities of the flank"),
            "normal_module": ("m", "normal module of the teeth"),
            "centre_distance": ("m", "distance of the two gear axes"),
            "pinion_diameter": ("m", "pitch circle of the pinion"),
            "gear_diameter": ("m", "pitch circle of the gear"),
            "contact_ratio": ("1", "mean number of tooth pairs in contact"),
            "overlap_ratio": (
                "1",
                "overlap of a helical pair: below 1 the share that bears evenly",
            ),
            "start_of_contact": (
                "1",
                "x_s: start of contact along the line of action, 0 interferes",
            ),
            "sliding_speed": ("m/s", "sliding speed where the flank is hottest"),
            "slide_roll_ratio": ("1", "sliding over mean rolling speed where contact starts"),
            "hertz_width": ("m", "full width of the line contact"),
            "hertz_pressure": (
                "Pa",
                "peak pressure of the line contact where the flank is hottest",
            ),
            "viscosity": ("Pa.s", "viscosity of the oil that is sheared"),
            "area_ratio": ("1", "nominal over real area of contact that flash heat enters"),
        },
        variants=Variants(
            head="steel",
            rows={"AISI 1020": "aisi1020", "AISI 4340": "aisi4340"},
            columns={
                "modification_factor": "K",
                "allowable_ratio": "allowable ratio",
                "stress_utilization": "of endurance limit",
            },
            chosen="these gears",
        ),
    )
    quick = True
    ladder = Ladder(
        part="mesh",
        kernels={"field": KERNELS, "fine": KERNELS},
        only={"fine": {"film_heat": "atan"}},  # with the loss as heat both are one to rounding
        boxes={"default": BOX, "planetary": BOX, "planetary.ring_mesh": BOX},
    )

    @property
    def spec(self) -> ModelSpec:
        """What an importer sees."""
        from .parameters import SPEC

        return SPEC

    @property
    def solve(self) -> "Callable[..., GearMeshResult]":
        """What solves it at a point."""
        from .solve import solve_gearmesh

        return solve_gearmesh

    def place(self, point: Values) -> Values:
        """Return the inputs: the power as a torque of the pinion."""
        from .solve import under_torque

        return under_torque(point)

    def back(self, inputs: Values) -> Values:
        """Return the point: the pinion's torque as a power."""
        from .solve import at_power

        return at_power(inputs)

    @property
    def sweep(self) -> Sweep:
        """What a sweep of it does otherwise."""
        from .solve import SWEEP

        return SWEEP


MODEL = GearMesh()
