"""The record of the thrust washer."""

import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..errors import ParameterError
from ..face_load import FACE_LOADS, Face
from ..model.record import Command, Fits, Ladder, Model, Option, Sweep
from ..model.spec import ModelSpec, Tables

if TYPE_CHECKING:
    from .washer_result import WasherResult

MESHED = tuple(f"thrustwasher.washer.kernels.{name}" for name in ("solve", "outputs", "constants"))


def read_grid(text: str) -> tuple[int, int]:
    """Return (n_r, n_theta); the model checks its limits."""
    match = re.fullmatch(r"\s*(\d{1,5})\s*[xX,]\s*(\d{1,5})\s*", text)
    if match is None:
        raise ParameterError(f"grid = {text!r}, allowed: two node counts as in 9x32")
    return int(match[1]), int(match[2])


GRID = Option(
    name="grid",
    help="nodes along the radius x around, e.g. 9x32 or 17x64",
    metavar="RxT",
    read=read_grid,
)
BRANCH = Option(
    name="branch",
    help="solution to take where several exist; default: a washer loaded up from light load",
    choices=("film", "contact"),
)


class Washer(Model):
    """The thrust washer."""

    key = "washer"
    alone = ("map",)
    wiring = (
        "The model is quasi-steady: the step only decides how finely the inputs are followed.",
        "Near the load at which the film is lost the torque jumps: a master that iterates should "
        "save the state first and go back to it.",
    )
    command = Command(
        help="friction, film and temperatures of a thrust washer at one point",
        examples=(
            'thrustwasher washer --load 300 --speed "9100 rpm" --oil "ISO VG 46" --plot washer.png',
            'thrustwasher washer --load 300 --speed "9100 rpm" --sensitivities friction_torque',
        ),
        title="thrust washer",
        closing="{iterations} iterations, {fidelity}, grid {grid[0]}x{grid[1]}",
        ranks=True,
        plot="draw film, pressures, temperatures and the flow of the oil",
        options=(GRID, BRANCH),
        more=("curve", "map"),
        extra={
            "fluid_load": ("N", "carried by the oil film"),
            "contact_load": ("N", "carried by the asperities"),
            "washer_tilt_x": ("rad", "rotation of the washer about x"),
            "washer_tilt_y": ("rad", "rotation of the washer about y"),
            "branch": ("1", "which of the possible solutions this is"),
            **FACE_LOADS,
            "error_estimate": (
                "1",
                "expected relative error of friction_torque, from the solution; on pages to try "
                "a part in: from its verification table",
            ),
        },
    )
    ladder = Ladder(
        part="washer",
        kernels={
            "map": ("thrustwasher.washer.kernels.map.map_step",),
            "field": MESHED,
            "fine": MESHED,
        },
        boxes={
            "default": {
                "load": (20.0, 1850.0, "log"),
                "speed": (50.0, 1400.0, "log"),
                "tilt": (1e-3, 3e-3, "log"),
                "oil_temperature": (290.0, 400.0, "linear"),
            },
            "planetary": {
                "load": (2.0, 200.0, "log"),
                "speed": (1.0, 650.0, "log"),
                "tilt": (0.8e-3, 1.6e-3, "log"),
                "oil_temperature": (250.0, 400.0, "linear"),
            },
        },
    )

    def face(self, params: Any) -> Face:
        """Return the face between carrier and washer, which turns with the gear."""
        from .parameters import washer_face

        return washer_face(params)

    @property
    def spec(self) -> ModelSpec:
        """What an importer sees."""
        from .parameters import SPEC

        return SPEC

    @property
    def solve(self) -> "Callable[..., WasherResult]":
        """What solves it at a point."""
        from .solve import solve_washer

        return solve_washer

    def doubt(self, result: Any) -> str:
        """Return a warning if there is a solution on the other branch too."""
        from .solve import other_branch

        return other_branch(result)

    def tables(self) -> Tables:
        """Return the maps."""
        from .map.map_tables import TABLES

        return TABLES

    def of_one_level(self, spec: ModelSpec, level: str) -> ModelSpec:
        """Return a washer that only looks up in its map."""
        if level not in self.alone:
            return super().of_one_level(spec, level)
        from .map.map_alone import map_alone

        return map_alone(spec)

    @property
    def sweep(self) -> Sweep:
        """What a sweep of it does otherwise."""
        from .draws import SWEEP

        return SWEEP

    @property
    def fits(self) -> Fits:
        """The loads of the folds, and exact derivatives."""
        from .fits import FITS

        return FITS


MODEL = Washer()
