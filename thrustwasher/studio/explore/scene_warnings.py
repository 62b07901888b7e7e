"""What the page of a scene reads its warnings from: texts, limits, constants; JSON types."""

import math
from collections.abc import Iterator
from typing import Any

from ...clutch.kernels import layout as clutch_layout
from ...clutch.parameters import ClutchParams
from ...clutch.solve import LINING, LININGS, ROUNDED, WARMTH, range_of_warmth
from ...errors import Status
from ...model.advice import VERIFIED, range_text
from ...model.registry import MODELS
from ...model.spec import ModelSpec
from ...shift.account.summary import SHEARED
from ...shift.account.worst_moments import LEAST_LOAD, TURNING
from ...shift.checks import capacity, holding
from ...shift.checks.run_doubts import MOST_OUTSIDE, OTHER_STEP, ROOM, STATUS_RANKS
from ...shift.key_figures.events_and_phases import GEARS, STANDSTILL
from ...shift.key_figures.figure_list import FILM_SPEED
from ...shift.key_figures.key_figures import TIE_UP_SHARE
from ...shift.scene.connections import MESHES, PACKS
from ...shift.scene.doubts import idle_parameters
from ...shift.scene.scene import Part, Scene
from ...shift.warning_texts import KINDS, RANKS, TEXTS, warning
from ...transmission.kernels.directional_derivative import LEAST_WASHER_LOAD
from ...transmission.kernels.shift_figures import FEW
from ...transmission.parameters import PROFILES, profile_points
from ...washer.kernels.regime_and_status import LEAST_TILT
from ...washer.map.look_up import OF_BOX, OUTSIDE, WasherMap
from ...washer.parameters import face_of
from ...washer.washer_result import BEYOND, COUNTS

STEELS = ("1020", "4340")
OWN_TEXTS = {
    "lining": LINING,
    "warmth_range": WARMTH,
    "verified": VERIFIED,
    "dry_range": BEYOND,
    "map_box": OF_BOX,
    "given": "{text}",
}
NUMBERS = {
    "settled": capacity.SETTLED,
    "kiss": holding.KISS,
    "standstill": STANDSTILL,
    "turns_share": holding.TURNS_SHARE,
    "numerical": holding.NUMERICAL,
    "flare": holding.FLARE,
    "few": FEW,
    "tie_up_share": TIE_UP_SHARE,
    "sheared": SHEARED,
    "film_speed": FILM_SPEED,
    "turning": TURNING,
    "least_load": LEAST_LOAD,
    "least_washer_load": LEAST_WASHER_LOAD,
}


def warning_data(scene: Scene, step: float) -> dict[str, Any]:
    """Return what the rules of the page's warnings read; ``step``: that of the run [s]."""
    gearbox = scene.parts["transmission"].params
    always = dict.fromkeys((*scene.warnings, *idle_parameters(scene)))
    for name in PROFILES:  # the page finds these of its own profiles
        for last, _ in profile_points(gearbox, name)[-1:]:
            always.pop(warning("cut_off", profile=name, last=last, stop=scene.stop_time), None)
    washer = scene.parts.get("washer")
    return {
        "texts": TEXTS | OWN_TEXTS,
        "ranks": RANKS | dict.fromkeys(OWN_TEXTS, len(KINDS) - 1),
        "always": [*always],
        "of_scene": [text for text in always if text in scene.warnings],
        "step": [step, scene.step] if abs(step / scene.step - 1.0) > OTHER_STEP else None,
        "statuses": {
            int(s): [s.advice, s.name, STATUS_RANKS.get(s, RANKS["status"])] for s in Status
        },
        "outside": int(Status.OUTSIDE_VERIFIED),
        "distress": int(Status.DISTRESS),
        "parts": {n: _ranges(p.spec) for n, p in scene.parts.items() if _has_status(p.spec)},
        "boxes": [*_boxes(scene)],
        "linings": {pack: _lining(scene.parts[pack]) for pack in PACKS},
        "warmth": {pack: _warmth(scene.parts[pack]) for pack in PACKS},
        "holding": {pack: _holding(scene, pack) for pack in PACKS},
        "reserve": capacity.RESERVE,
        "gears": GEARS,
        "springs": {pack: getattr(gearbox, f"{pack}_return_spring") for pack in PACKS},
        "limits": [
            [name, s.name, s.limit]
            for name, part in scene.parts.items()
            for s in part.spec.outputs
            if s.limit
        ],
        "map": _map(washer),
        "dry": _dry(washer),
        "alone": scene.alone,
        "oil": scene.oil_temperature,
        "teeth": _teeth(scene),
        "checked_outside": _outside(scene),
        **NUMBERS,
    }


def _has_status(spec: ModelSpec) -> bool:
    return any(s.name == "solver_status" for s in spec.outputs)


def _ranges(spec: ModelSpec) -> list[list[Any]]:
    """Return inputs with a range that the accuracy was verified for."""
    return [
        [s.name, s.unit, s.relative, *s.verified, range_text(s, s.verified)]
        for s in spec.inputs
        if s.verified
    ]


def _boxes(scene: Scene) -> Iterator[list[Any]]:
    for name, part in scene.parts.items():
        units = {s.name: s.unit for s in part.spec.inputs}
        for key, (low, high) in part.labels.get("box", {}).items():
            room = ROOM * max(high - low, abs(high), abs(low))
            yield [name, key, units[key], low, high, room]


def _lining(part: Part) -> list[Any] | None:
    """Return pressure [Pa] per load [N], the highest that the lining bears and its kind."""
    p = part.params
    if part.spec.key not in MODELS or not isinstance(p, ClutchParams):
        return None
    kind, most = LININGS.get(p.friction_law, LININGS["table"])
    return [p.faces / p.lining_area / p.land_share, most, kind]


def _warmth(part: Part) -> list[float] | None:
    """Return the range of friction over temperature [K], room at its ends, what is too hot."""
    p = part.params
    known = range_of_warmth(p, part.fidelity) if isinstance(p, ClutchParams) else None
    return [*known, ROUNDED, clutch_layout.HOT_LIMIT] if known else None


def _holding(scene: Scene, pack: str) -> list[float | None]:
    """Return what gives the torque that holds, and the torque per load that the pack has."""
    grip = capacity.grip(scene, pack)
    found = capacity.holding(scene.parts["transmission"].params, pack)
    return [*found, None if math.isnan(grip) else grip]


def _map(washer: Part | None) -> dict[str, Any] | None:
    """Return the box of a washer that is solved by its map."""
    if washer is None or washer.fidelity != "map":
        return None
    box = [list(ends) for ends in WasherMap(washer.params).box.values()]
    then = OUTSIDE[washer.params.outside_map]
    return {"box": box, "tilt": LEAST_TILT, "most": MOST_OUTSIDE, "then": then}


def _dry(washer: Part | None) -> dict[str, float] | None:
    """Return the range of a washer's dry friction over pressure, None where it has none."""
    if washer is None or getattr(washer.params, "friction_law", "") != "load":
        return None
    p = washer.params
    return {
        "low": p.friction_pressure_min,
        "high": p.friction_pressure_max,
        "face": face_of(p.inner_radius, p.outer_radius),
        "reference": p.friction_reference,
        "slope": p.friction_slope,
        "radius": 0.5 * (p.inner_radius + p.outer_radius),
        "counts": COUNTS,
    }


def _teeth(scene: Scene) -> dict[str, Any]:
    """Return meshes with each quantity that is warned of."""
    rated = "mesh" in scene.parts and scene.parts["mesh"].params.film_heat == "loss"

    def having(name: str) -> list[str]:
        found = [n for n in MESHES if n in scene.parts and "mesh" in scene.parts]
        return [
            n
            for n in found
            if any(s.name == name for s in scene.parts[n].spec.outputs)
            and name not in scene.parts[n].spec.absent(scene.parts[n].params)
        ]

    stress = {steel: having(f"stress_utilization_aisi{steel}") for steel in STEELS}
    kinds = ("pitting", "scuffing")
    return {
        "stress": {} if rated else stress,
        "safety": {kind: having(f"{kind}_safety") for kind in kinds} if rated else {},
    }


def _outside(scene: Scene) -> list[str]:
    """Return what only the command line checks, in a few words each."""
    gearbox, washer = scene.parts["transmission"].params, scene.parts.get("washer")
    found = ["the error of the communication step"]
    if washer is not None and washer.params.thermal_mode != "transient":
        found.append("whether the washers' steady temperatures hold")
    if any(part.tolerance for part in scene.parts.values()):
        found.append("the fidelity levels that auto chose")
    if gearbox.shaft_stiffness:
        found.append("judder of the shaft")
    if gearbox.coupling == "torque":
        found.append("chatter of the packs")
    if scene.oil_temperature < 283.15:
        found.append("drag after a cold release")
    if "losses" in scene.parts:
        found.append("ranges of the laws of driveline losses")
    return found
