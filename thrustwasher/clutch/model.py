"""The record of the wet clutch."""

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from ..face_load import FACE_LOADS, Face
from ..model.record import Command, Fits, Ladder, Model, Sweep
from ..model.spec import ModelSpec, Signal

if TYPE_CHECKING:
    from .solve import ClutchResult

KERNELS = tuple(f"thrustwasher.clutch.kernels.{n}" for n in ("advance", "pack_outputs", "steady"))
BOX = {
    "load": (50.0, 10000.0, "log"),
    "speed": (1.0, 450.0, "log"),
    "oil_temperature": (250.0, 400.0, "linear"),
}


class Clutch(Model):
    """The wet clutch."""

    key = "clutch"
    wiring = (
        "Into a ShiftTransmission: wire torque_capacity to it with coupling = capacity, there "
        "stick and slip are decided inside the step and no step limit comes from friction; or "
        "friction_torque with coupling = torque.",
        "In another driveline wire friction_torque between its two shafts: with holding = "
        "identified (the default) the pack finds the inertia that its slip sees and the delay of "
        "its torque, locks, holds and breaks away, at the host's step. With holding = off the "
        "torque rises near zero slip from -capacity to +capacity over speed_smoothing, the "
        "stiffest spring of the system: then the limit below holds, a larger speed_smoothing "
        "relaxes it in proportion.",
        "Give the slip its sign; the torque has the same sign and acts against the slip.",
    )
    command = Command(
        help="friction torque and temperatures of a wet pack at one point",
        examples=(
            'thrustwasher clutch --load 3000 --speed "50 rpm" --plot pack.png',
            "thrustwasher clutch --load 3000 --speed 2 --set faces=8 --sensitivities",
        ),
        title="friction pack",
        ranks=True,
        plot="draw shear ratio, coefficient and torque over slip",
        more=("engage",),
        instead={  # a slip that a pack bears for ever
            "speed": Signal(
                name="speed",
                unit="rad/s",
                low=-5000.0,
                high=5000.0,
                start=3.0,
                help="slip speed between the two sides of the pack",
            )
        },
        extra={  # some are outputs that mean something else here
            "shear_ratio": ("1", "share of the full adhesive shear strength, s/s_m"),
            "friction_torque": (
                "N.m",
                "friction torque of the pack, sign of the slip, 0 without slip",
            ),
            "temperature": ("K", "interface temperature if this slip lasted for ever"),
            **FACE_LOADS,
        },
    )
    quick = True
    ladder = Ladder(
        part="clutch",
        kernels={"field": KERNELS, "fine": KERNELS},
        boxes={"default": BOX, "planetary": BOX},
    )

    @property
    def spec(self) -> ModelSpec:
        """What an importer sees."""
        from .parameters import SPEC

        return SPEC

    @property
    def solve(self) -> "Callable[..., ClutchResult]":
        """What solves it at a point."""
        from .solve import solve_clutch

        return solve_clutch

    def doubts(self, params: Any, inputs: Mapping[str, float]) -> Iterable[str]:
        """Return what the lining does not bear."""
        from .solve import doubts_of_lining

        return doubts_of_lining(params, inputs["load"])

    def face(self, params: Any) -> Face:
        """Return the friction faces of a pack."""
        face: Face = params.face
        return face

    @property
    def sweep(self) -> Sweep:
        """What a sweep of it does otherwise: a pack that slips for ever."""
        from .solve import SWEEP

        return SWEEP

    @property
    def fits(self) -> Fits:
        """The coefficient of friction, which a law of its own follows."""
        return Fits(
            units={"friction": "1"},
            sliding_radius=lambda params: float(params.friction_radius),
            at_mean=True,
        )


MODEL = Clutch()
