"""The gear mesh's page: teeth and path of contact, temperatures, safety and film along it."""

import math

from ...gearmesh.kernels import layout
from ...gearmesh.parameters import SPEC
from ..report.web_worker import WebWorker, numbers_of
from .view import View

GROUP = (
    "profile_shift_pinion profile_shift_gear working_centre_distance "
    "profile_shift_gear_from_distance addendum addendum_gear tip_shortening tip_diameter_pinion "
    "tip_diameter_gear tool_addendum load_sharing stiffness_at_ends tip_relief_pinion "
    "tip_relief_length_pinion tip_relief_gear tip_relief_length_gear internal"
).split()
TEETH = SPEC.params.__dataclass_fields__["pinion_teeth"].metadata
MOST_TORQUE = next(s.high for s in SPEC.inputs if s.name == "load") or math.inf  # [N m]

VIEW = View(
    worker=WebWorker(
        script="gearmesh_worker",
        calls="broken_rule derive step solve_point place_mesh tips tip_thickness pitch_of "
        "gear_shift film_ratio_at".split(),
        layout=numbers_of(layout, MOST_TORQUE=MOST_TORQUE, MOST_TEETH=TEETH["max"]),
        levels={n: {"code": k} for k, n in enumerate(SPEC.fidelities, 1) if n in SPEC.levels},
    ),
    page="gearmesh",
    main="pinion_teeth gear_ratio normal_module face_width helix_angle friction_law".split(),
    group=("Profile shift, tips and load sharing", GROUP),
    figures="contact_ratio friction_torque friction_power film_ratio bulk_temperature flash_max "
    "scuffing_safety pitting_safety".split(),
    solve="solve_gearmesh",
    params="GearMeshParams",
    terms="film_ratio_gf is the minimum film along the path of contact over the mean roughness Ra. "
    "A safety against micropitting needs a permissible_film_ratio, endurance under thermal "
    "stress film_heat = atan and one of the two steels of its paper.",
    load="power",
    verified_point=lambda point: {**point, "load": abs(point["power"] / point["speed"])},
    spans={
        "power": (100.0, 1e5),
        "speed": (1.0, 1000.0),
        "oil_temperature": (253.15, 423.15),
        "profile_shift_pinion": (-1.0, 1.0),
        "profile_shift_gear": (-1.0, 1.0),
        "tip_shortening": (0.0, 0.3),
        "stiffness_at_ends": (0.3, 1.0),
        "tip_relief_pinion": (0.0, 1e-4),
        "tip_relief_gear": (0.0, 1e-4),
        "tip_relief_length_pinion": (0.0, 0.02),
        "tip_relief_length_gear": (0.0, 0.02),
    },
)
