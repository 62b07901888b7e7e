"""The gear mesh's page: temperatures, safety and film along the path of contact."""

from collections.abc import Mapping
from typing import Any

from ..gearmesh.kernels import layout
from ..gearmesh.parameters import SPEC
from ..report.model_plots.gearmesh_plot import gearmesh_figure
from ..report.web_worker import WebWorker, numbers_of
from .view import Picture, View


def _pictures(params: Any, result: Any, point: Mapping[str, float]) -> list[Picture]:
    words = "Over the number of the pinion's teeth at the start's point."
    return [(words, gearmesh_figure(result, point, params))]


VIEW = View(
    worker=WebWorker(
        script="gearmesh_worker",
        calls=("broken_rule", "derive", "solve_point"),
        layout=numbers_of(layout),
        rungs={n: {"code": k} for k, n in enumerate(SPEC.fidelities, 1) if n in SPEC.rungs},
    ),
    page="gearmesh_view",
    main="pinion_teeth gear_ratio normal_module face_width helix_angle friction_law".split(),
    figures="friction_torque friction_power film_ratio bulk_temperature flash_max "
    "scuffing_safety pitting_safety".split(),
    solve="solve_gearmesh",
    params="GearMeshParams",
    terms="film_ratio_gf is the least film along the path of contact over the mean roughness Ra. A "
    "safety against micropitting needs a permissible_film_ratio, endurance under thermal "
    "stress film_heat = atan and one of the two steels of its paper.",
    pictures=_pictures,
    load="power",
    card_point=lambda point: {**point, "load": abs(point["power"] / point["speed"])},
    spans={"power": (100.0, 1e5), "speed": (1.0, 1000.0), "oil_temperature": (253.15, 423.15)},
)
