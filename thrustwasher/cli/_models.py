"""The models that have a command for one operating point, a record each.

``_solve`` makes ``thrustwasher washer`` and so on from them. Dotted names ("module below
thrustwasher:name") are resolved when they are needed: help imports no solver and no plotter.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

from ._options import GRID, Option


@dataclass(frozen=True, kw_only=True)
class Variants:
    """Results side by side for several variants, such as two steels: a table below the others."""

    head: str  # what a row is; the parameter of this name holds the chosen one
    rows: Mapping[str, str]  # words -> ending of the fields' names
    columns: Mapping[str, str]  # field without its ending -> head
    chosen: str  # said of the row that the parameters choose

    def name(self, column: str, row: str) -> str:
        """Return the name of a field."""
        return f"{column}_{self.rows[row]}"

    def fields(self) -> set[str]:
        """Return all fields in the table, and those of the chosen variant, which it repeats."""
        table = {self.name(column, row) for column in self.columns for row in self.rows}
        return table | set(self.columns)


@dataclass(frozen=True, kw_only=True)
class ModelCommand:
    """What the command of a model needs to know beside the model's specification."""

    name: str
    help: str
    spec: str
    solve: str  # called with (parameters, **point, fidelity=, **options)
    figure: str  # called with (result, point, parameters)
    figure_help: str
    title: str  # may name parameters: "gear mesh, {pinion_teeth} teeth"
    closing: str  # how it was solved; may name results
    extra: Mapping[str, tuple[str, str]]  # results that are no output: unit and meaning
    # Name of a model's input -> fields of the signal that this command has instead of it.
    instead: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    place: Callable[[dict[str, float]], dict[str, float]] = dict  # the model's own inputs
    presets: str = ""  # mapping of names to the parameters that they change
    options: tuple[Option, ...] = ()  # more arguments of ``solve``
    variants: Variants | None = None
    more: tuple[str, ...] = ()  # other commands of this model, which are files


def resolve(name: str) -> Any:
    """Return what a dotted name stands for."""
    module, _, attribute = name.partition(":")
    return getattr(import_module(f"..{module}", __package__), attribute)


def _under_torque(point: dict[str, float]) -> dict[str, float]:
    """Return the inputs of a gear mesh: the power as a torque of the pinion."""
    from ..gearmesh.solve import pinion_torque

    power, rest = point["power"], {n: v for n, v in point.items() if n != "power"}
    return {**rest, "load": pinion_torque(power, point["speed"])}


WASHER = ModelCommand(
    name="washer",
    help="solve the thrust washer at one load, speed and tilt",
    spec="models.washer_params:SPEC",
    solve="models.washer:solve_washer",
    figure="report.washer_plots:field_figure",
    figure_help="draw pressure, film and temperature fields",
    title="thrust washer",
    more=("curve", "map"),
    closing="{iterations} iterations, {fidelity}, grid {grid[0]}x{grid[1]}",
    options=(
        GRID,
        Option(
            "branch",
            "solution wanted where several exist; default: a washer loaded up from light load",
            choices=("film", "contact"),
        ),
    ),
    extra={
        "fluid_load": ("N", "carried by the oil film"),
        "contact_load": ("N", "carried by the asperities"),
        "washer_tilt_x": ("rad", "rotation of the washer about x"),
        "washer_tilt_y": ("rad", "rotation of the washer about y"),
        "branch": ("1", "which of the possible solutions this is"),
        "error_estimate": ("1", "relative error expected in friction_torque"),
    },
)
CLUTCH = ModelCommand(
    name="clutch",
    help="friction torque of a wet clutch or brake pack at one load and slip speed",
    spec="models.clutch_params:SPEC",
    solve="models.clutch:solve_clutch",
    figure="report.clutch_plot:slip_figure",
    figure_help="draw shear ratio, coefficient and torque over slip",
    title="friction pack",
    more=("engage", "calibrate"),
    closing="{fidelity}",
    extra={  # some are outputs that mean something else here
        "shear_ratio": ("1", "share of the full adhesive shear strength, s/s_m"),
        "friction_torque": ("N.m", "friction torque of the pack, sign of the slip, 0 without slip"),
        "temperature": ("K", "interface temperature if this slip lasted for ever"),
    },
)
GEARMESH = ModelCommand(
    name="gearmesh",
    help="temperatures, stresses and loss of a gear mesh at one power and speed",
    spec="models.gearmesh_params:SPEC",
    solve="models.gearmesh:solve_gearmesh",
    figure="report.gearmesh_plot:gearmesh_figure",
    figure_help="draw temperatures and factors over the pinion's teeth",
    title="gear mesh, {pinion_teeth} teeth, ratio {gear_ratio:g},",
    closing="{iterations} iterations, {fidelity}",
    instead={
        "load": {"name": "power", "unit": "W", "low": -1e9, "high": 1e9, "start": 7500.0,
                 "help": "transmitted power, of which the size counts"},
    },
    place=_under_torque,
    presets="models.gearmesh_params:PRESETS",
    extra={
        "asperity_temperature": ("K", "temperature of the asperities of the flank"),
        "contact_ratio": ("1", "mean number of tooth pairs in contact"),
        "start_of_contact": ("1", "x_s: start of contact along the line of action, 0 interferes"),
        "sliding_speed": ("m/s", "sliding speed at the start of contact"),
        "slide_roll_ratio": ("1", "sliding over mean rolling speed there"),
        "hertz_width": ("m", "full width of the line contact"),
        "hertz_pressure": ("Pa", "peak pressure of the line contact"),
        "viscosity": ("Pa.s", "viscosity of the oil that is sheared"),
        "area_ratio": ("1", "nominal over real area of contact that flash heat enters"),
    },
    variants=Variants(
        head="steel",
        rows={"AISI 1020": "aisi1020", "AISI 4340": "aisi4340"},
        columns={"modification_factor": "K", "allowable_ratio": "allowable ratio",
                 "stress_utilization": "of endurance limit"},
        chosen="these gears",
    ),
)  # fmt: skip
MODELS = {model.name: model for model in (WASHER, CLUTCH, GEARMESH)}
