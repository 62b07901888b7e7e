"""The page of the driveline losses: heat by source over the speeds."""

from ...losses.kernels import step
from ...losses.parameters import SPEC
from ..report.web_worker import WebWorker, numbers_of
from .view import View

SPEEDS = ("input_speed", "output_speed", "drum_speed", "planet_speed")
VIEW = View(
    worker=WebWorker(
        script="losses_worker",
        calls=("derive", "step"),
        layout=numbers_of(step),
        levels={name: {"code": k} for k, name in enumerate(SPEC.fidelities, 1)},
    ),
    page="losses",
    main="line_pressure pump_displacement output_immersion drum_immersion planet_load_factor "
    "bearing_viscous_factor".split(),
    figures="oil_heat bearing_power churning_power pump_power seal_power input_torque".split(),
    solve="solve_losses",
    params="LossesParams",
    load="tooth_force",
    spans={
        **dict.fromkeys(SPEEDS, (-700.0, 700.0)),
        "tooth_force": (0.0, 1e4),
        "oil_temperature": (253.15, 423.15),
        "line_pressure": (0.0, 3e6),
        "pump_displacement": (0.0, 4e-5),
    },
)
