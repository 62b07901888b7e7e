"""The record of the gear mesh."""

from ..model.record import Command, Ladder, Model, Sweep, Variants

_BOX = {
    "load": (1.0, 200.0, "log"), "speed": (1.0, 700.0, "log"),
    "oil_temperature": (250.0, 400.0, "linear"),
}  # fmt: skip
MODEL = Model(
    key="gearmesh",
    name="GearMesh",
    interface="thrustwasher.gearmesh.parameters:SPEC",
    command=Command(
        help="temperatures, stresses and loss of a gear mesh at one power and speed",
        solve="thrustwasher.gearmesh.solve:solve_gearmesh",
        figure="thrustwasher.report.model_plots.gearmesh_plot:gearmesh_figure",
        figure_help="draw temperatures and factors over the pinion's teeth",
        title="gear mesh, {pinion_teeth} teeth, ratio {gear_ratio:g},",
        closing="{iterations} iterations, {fidelity}",
        instead={
            "load": {"name": "power", "unit": "W", "low": -1e9, "high": 1e9, "start": 7500.0,
                     "help": "transmitted power, of which the size counts"},
        },
        place="thrustwasher.gearmesh.solve:under_torque",
        extra={
            "asperity_temperature": ("K", "temperature of the asperities of the flank"),
            "contact_ratio": ("1", "mean number of tooth pairs in contact"),
            "start_of_contact": (
                "1", "x_s: start of contact along the line of action, 0 interferes",
            ),
            "sliding_speed": ("m/s", "sliding speed where the flank is hottest"),
            "slide_roll_ratio": ("1", "sliding over mean rolling speed where contact starts"),
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
    ),
    ladder=Ladder(
        # With loss and heat along the path `stribeck`, `field` and `fine` are one to rounding.
        kernels={"field": ("thrustwasher.gearmesh.kernels.operating_point",)},
        boxes={"default": _BOX, "planetary": _BOX, "planetary.ring_mesh": _BOX},
        part="mesh",
        references="thrustwasher.study.reference_gearmesh:SOURCE",
        chart="thrustwasher.study.charts.gearmesh_chart:GEARMESH",
    ),
    # A power in place of the torque is turned into one, row by row.
    sweep=Sweep(more_inputs=({
        "name": "power", "unit": "W", "help": "transmitted power instead of the torque",
        "low": -1e9, "high": 1e9,
    },)),
    explore="thrustwasher.explore.gearmesh_page:VIEW",
    wiring=(
        "Subtract friction_torque from the torque that the mesh transmits, at the pinion.",
        "In a ShiftTransmission plug it into the terminal mesh: one pair stands for one "
        "planet.",
    ),
)  # fmt: skip
