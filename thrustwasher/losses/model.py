"""The record of the driveline losses."""

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

from ..model.record import Command, Model, Sweep
from ..model.spec import ModelSpec

if TYPE_CHECKING:
    from .solve import LossesResult


class DrivelineLosses(Model):
    """Bearings, churning, oil pump and seals of a planetary gearbox."""

    key = "losses"
    wiring = (
        "Subtract input_torque, output_torque and drum_torque from what drives these shafts.",
        "planet_torque is of one planet, against its carrier; the powers count all planets.",
        "Feed oil_heat or oil_energy to an OilSump, and its temperature back as oil_temperature.",
    )
    command = Command(
        help="losses of bearings, churning, oil pump and seals at one point",
        examples=(
            'thrustwasher losses --input-speed "3000 rpm" --plot losses.png',
            'thrustwasher losses --input-speed "3000 rpm" --oil "SAE 75W-90" '
            '--oil-temperature "0 degC"',
        ),
        title="driveline losses",
        ranks=True,
        plot="draw heat by source over speed and oil temperature",
    )
    sweep = Sweep(not_shown=("oil_energy",))  # of a step, not of a point

    @property
    def spec(self) -> ModelSpec:
        """What an importer sees."""
        from .parameters import SPEC

        return SPEC

    @property
    def solve(self) -> "Callable[..., LossesResult]":
        """What solves it at a point."""
        from .solve import solve_losses

        return solve_losses

    def doubts(self, params: object, inputs: Mapping[str, float]) -> Iterable[str]:
        """Return which laws a point is outside of."""
        from .solve import doubts_of_point

        return doubts_of_point(params, inputs)


MODEL = DrivelineLosses()
