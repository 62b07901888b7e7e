"""The record of the wet clutch."""

from ..model.record import Command, Fits, Ladder, Model, Sweep

_PACK = tuple(
    f"thrustwasher.clutch.kernels.{name}" for name in ("advance", "pack_outputs", "steady")
)
_BOX = {
    "load": (50.0, 10000.0, "log"), "speed": (1.0, 450.0, "log"),
    "oil_temperature": (250.0, 400.0, "linear"),
}  # fmt: skip
MODEL = Model(
    key="clutch",
    name="WetClutch",
    interface="thrustwasher.clutch.parameters:SPEC",
    command=Command(
        help="friction torque of a wet clutch or brake pack at one load and slip speed",
        solve="thrustwasher.clutch.solve:solve_clutch",
        figure="thrustwasher.report.model_plots.clutch_plot:slip_figure",
        figure_help="draw shear ratio, coefficient and torque over slip",
        title="friction pack",
        more=("engage",),
        extra={  # some are outputs that mean something else here
            "shear_ratio": ("1", "share of the full adhesive shear strength, s/s_m"),
            "friction_torque": (
                "N.m", "friction torque of the pack, sign of the slip, 0 without slip",
            ),
            "temperature": ("K", "interface temperature if this slip lasted for ever"),
        },
    ),
    ladder=Ladder(
        kernels={"field": _PACK, "fine": _PACK},
        boxes={"default": _BOX, "planetary": _BOX},
        part="clutch",
        references="thrustwasher.study.reference_clutch:SOURCE",
        chart="thrustwasher.study.charts.clutch_chart:CLUTCH",
    ),
    sweep=Sweep(
        walk="thrustwasher.clutch.solve:walk_steady",
        # it slips for ever: its heat has no end
        not_shown=("energy", "heat_flux", "viscosity", "oil_heat", "stored_heat"),
    ),
    fits=Fits(law="thrustwasher.clutch.calibration.calibration:calibrate"),
    explore="thrustwasher.explore.clutch_page:VIEW",
    wiring=(
        "Into a ShiftTransmission: wire torque_capacity to it with coupling = capacity, "
        "there stick and slip are decided inside the step and no step limit comes from "
        "friction; or friction_torque with coupling = torque.",
        "In another driveline wire friction_torque. Near zero slip it rises from "
        "-capacity to +capacity over speed_smoothing, the stiffest spring of the system: "
        "the limit below holds, a larger speed_smoothing relaxes it in proportion.",
        "Give the slip its sign; the torque has the same sign and acts against the slip.",
    ),
)  # fmt: skip
