"""The thrust washer's page: load curve, discs, Stribeck curve."""

from collections.abc import Mapping
from typing import Any

from ..report.model_plots.washer_plots import curve_figure, field_figure
from ..report.shift.live_washer import WORKER
from ..washer.load_curve import load_curve
from ..washer.solve import RANGES
from ..washer.washer_result import SLIPS
from .view import Picture, View


def _pictures(params: Any, result: Any, point: Mapping[str, float]) -> list[Picture]:
    rest: Any = {name: value for name, value in point.items() if name != "load"}
    curve = load_curve(params, **rest, fidelity=result.fidelity)
    return [
        ("Over the washer at the start's point.", field_figure(result, point)),
        ("All solutions over the load, with the folds.", curve_figure(curve, rest)),
    ]


VIEW = View(
    worker=WORKER,
    page="washer_view",
    main=("roughness", "washer_thickness", "asperity_radius", "viscosity_exponent", "heat_split"),
    figures="friction_torque temperature film_thickness film_ratio branch distress "
    "temperature_max friction_coefficient".split(),
    solve="solve_washer",
    params="WasherParams",
    terms="Film 1 lies between carrier and washer, gap 2 between washer and gear.",
    more={"slips": SLIPS},
    pictures=_pictures,
    spans={
        "load": (10.0, 3000.0),
        "speed": (0.0, 1500.0),
        "tilt": (0.0, 0.005),
        "oil_temperature": (253.15, 423.15),
    },
    least={name: low for name, _, low, _ in RANGES},
)
