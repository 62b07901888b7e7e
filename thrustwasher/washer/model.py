"""The record of the thrust washer."""

from ..model.record import Command, Fits, Ladder, Model, Option, Sweep

_FIELD = tuple(f"thrustwasher.washer.kernels.{name}" for name in ("solve", "outputs", "constants"))
GRID = Option(
    name="grid", help="nodes along the radius x around, e.g. 9x32 or 17x64", metavar="RxT",
    read="thrustwasher.cli._options:read_grid",
)  # fmt: skip
MODEL = Model(
    key="washer",
    name="ThrustWasher",
    interface="thrustwasher.washer.parameters:SPEC",
    command=Command(
        help="solve the thrust washer at one load, speed and tilt",
        solve="thrustwasher.washer.solve:solve_washer",
        figure="thrustwasher.report.model_plots.washer_plots:field_figure",
        figure_help="draw film, pressures, temperatures and the flow of the oil",
        title="thrust washer",
        warning="thrustwasher.washer.washer_result:hold_warning",
        more=("curve", "map"),
        closing="{iterations} iterations, {fidelity}, grid {grid[0]}x{grid[1]}",
        options=(
            GRID,
            Option(
                name="branch",
                help="solution wanted where several exist; default: a washer loaded up from light "
                "load",
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
    ),
    ladder=Ladder(
        kernels={
            "map": ("thrustwasher.washer.kernels.map.map_step",),
            "field": _FIELD,
            "fine": _FIELD,
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
        part="washer",
        references="thrustwasher.study.reference_washer:SOURCE",
        chart="thrustwasher.study.charts.washer_chart:WASHER",
    ),
    sweep=Sweep(not_shown=("energy", "stored_heat")),
    fits=Fits(
        curve="thrustwasher.washer.load_curve:fold_loads",
        more={
            "film_loss_load": ("N", "load at which the film is lost"),
            "film_regain_load": ("N", "load at which it is regained"),
        },
        without="load",
    ),
    explore="thrustwasher.explore.washer_page:VIEW",
    remark="thrustwasher.shift.thermal_need:thermal_need",
    wiring=(
        "The model is quasi-steady: the step only decides how finely the inputs are followed.",
        "Near the load at which the film is lost the torque jumps: a master that iterates "
        "should save the state first and go back to it.",
    ),
)
