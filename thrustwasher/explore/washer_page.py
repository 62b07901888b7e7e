"""The thrust washer's page: load curve, discs, Stribeck curve."""

from collections.abc import Mapping
from typing import Any

from ..model.record import resolve
from ..numerics.banded import N_SIDES
from ..washer.kernels import layout, newton, workspace
from ..washer.kernels.constants import size_of_par
from ..washer.kernels.workspace import size_of_state, size_of_work
from ..washer.load_curve import load_curve
from ..washer.parameters import SPEC
from ..washer.solve import GRIDS, RANGES
from ..washer.washer_result import SLIPS
from .view import Picture, View, numbers_of


def _pictures(params: Any, result: Any, point: Mapping[str, float]) -> list[Picture]:
    rest: Any = {name: value for name, value in point.items() if name != "load"}
    curve = load_curve(params, **rest, fidelity=result.fidelity)
    draw, draw_curve = (
        resolve(f"thrustwasher.report.model_plots.washer_plots:{name}")
        for name in ("field_figure", "curve_figure")
    )
    return [
        ("Over the washer at the start's point.", draw(result, point)),
        ("All solutions over the load, with the folds.", draw_curve(curve, rest)),
    ]


VIEW = View(
    worker="washer_worker",
    page="washer_view",
    calls="step broken_rule derive_grid enter_curve find_fold recall remember walk_to newton "
    "outputs_at".split(),
    layout=numbers_of(
        layout,
        MODE_LOAD=newton.LOAD,
        NO_FLOOR=newton.NO_FLOOR,
        N_SIDES=N_SIDES,
        N_NODAL=workspace.N_NODAL,
    ),
    rungs={
        name: {
            "grid": GRIDS[name],
            "code": list(SPEC.fidelities).index(name) + 1,
            "sizes": {
                "par": size_of_par(*GRIDS[name]),
                "state": size_of_state(*GRIDS[name]),
                "work": layout.N_HEAD + size_of_work(*GRIDS[name]),
            },
        }
        for name in ("field", "fine")
    },
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
