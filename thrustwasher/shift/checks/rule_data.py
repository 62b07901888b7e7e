"""What the rules of a shift's warnings know of its scene: numbers, and rows by part; JSON types."""

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any

from ...clutch.kernels import layout as clutch_layout
from ...clutch.parameters import ClutchParams
from ...clutch.solve import LINING, LININGS, ROUNDED, WARMTH, range_of_warmth
from ...errors import ParameterError, Status
from ...model.advice import VERIFIED, range_text
from ...model.registry import MODELS
from ...transmission.kernels.directional_derivative import LEAST_WASHER_LOAD
from ...transmission.kernels.shift_figures import FEW
from ..key_figures.events_and_phases import GEARS, STANDSTILL
from ..key_figures.figure_list import FILM_SPEED
from ..scene.connections import MESHES, PACKS
from ..scene.scene import Part, Scene
from ..warning_texts import KINDS, TEXTS
from .capacity import grip, holding

Row = dict[str, Any]
ROOM = 1e-6  # of a box's width
STATUS_RANKS = {Status.STALLED: 0, Status.CHATTER: 0, Status.HOT: 1}  # places in KINDS
WIDE = 1e300  # an end that there is not
TURNING = 1.0  # [rad/s] a washer slower than this needs no film
LEAST_LOAD = 1.0  # [N] the washer in a run takes a smaller load as this
STEELS = ("1020", "4340")
NUMBERS = {
    "standstill": STANDSTILL,
    "few": FEW,
    "film_speed": FILM_SPEED,
    "turning": TURNING,
    "least_load": LEAST_LOAD,
    "least_washer_load": LEAST_WASHER_LOAD,
}


def scene_values(scene: Scene, step: float) -> Row:
    """Return what all runs of a scene have in common; ``step``: that of the run [s]."""
    parts, washer = scene.parts, scene.parts.get("washer")
    return {
        **NUMBERS,
        "alone": scene.alone,
        "start_time": scene.start_time,
        "stop_time": scene.stop_time,
        "step": step,
        "scene_step": scene.step,
        "oil_temperature": scene.oil_temperature,
        "packs": [_pack(scene, *pair) for pair in (PACKS, PACKS[::-1])],
        "statuses": [row for n, p in parts.items() for row in _statuses(n, p)],
        "laws": [],
        "boxes": [row for n, p in parts.items() for row in _boxes(n, p)],
        "linings": [row for pack in PACKS for row in _lining(pack, parts[pack])],
        "warm": [row for pack in PACKS for row in _warmth(pack, parts[pack])],
        "washers": [{}] if washer else [],
        "maps": [*map_rows(washer)] if washer and washer.fidelity == "map" else [],
        "dry": [*_dry(washer)],
        **part_rows({name: (part.spec, part.params) for name, part in parts.items()}),
    }


def run_values(scene: Scene, figures: Mapping[str, Any]) -> Row:
    """Return the shift of a run, and its flare."""
    flare = figures.get("flare")
    return {
        "engaging": scene.engaging,
        "releasing": scene.releasing,
        "shift_start": scene.shift_start,
        "shift_end": scene.shift_start + scene.shift_duration,
        "until": scene.required_until,
        "flare": flare.value if flare else None,
        "flare_time": flare.time if flare else None,
    }


def part_rows(parts: Mapping[str, tuple[Any, Any]]) -> Row:
    """Return what parts, each its model and parameters, endure: temperatures and teeth."""
    limits = [
        {"part": name, "output": f"{name}.{s.name}", "limit": s.limit}
        for name, (spec, _) in parts.items()
        for s in spec.outputs
        if s.limit
    ]
    rated = "mesh" in parts and getattr(parts["mesh"][1], "film_heat", "") == "loss"

    def having(output: str) -> list[str]:
        there = [name for name in MESHES if name in parts and "mesh" in parts]
        return [n for n in there if _has(*parts[n], output)]

    steels = {f"utilizations_{x}": _named(having, f"stress_utilization_aisi{x}") for x in STEELS}
    safeties = [
        {
            "kind": kind,
            "signals_of": _named(having, f"{kind}_safety"),
            "speeds": [f"{name}.speed" for name in having(f"{kind}_safety")],
        }
        for kind in ("pitting", "scuffing")
    ]
    return {
        "limits": limits,
        "stresses": [] if rated else [steels],
        "safeties": safeties if rated else [],
        "hot_part": TEXTS["hot_part"],
    }


def _has(spec: Any, params: Any, output: str) -> bool:
    return any(s.name == output for s in spec.outputs) and output not in spec.absent(params)


def _named(having: Any, output: str) -> list[str]:
    return [f"{name}.{output}" for name in having(output)]


def _pack(scene: Scene, pack: str, other: str) -> Row:
    """Return what gives the torque that a pack has to hold, and what it holds per load."""
    law, most = holding(scene.parts["transmission"].params, pack), grip(scene, pack)
    own = {"pack": pack, "other": other, "gear": GEARS[pack]}
    return own | law._asdict() | {"grip": None if math.isnan(most) else most}


def _statuses(name: str, part: Part) -> Iterator[Row]:
    """Yield what each status of a part is told with: the ranges that were left, else advice."""
    spec = part.spec
    if not any(s.name == "solver_status" for s in spec.outputs):
        return
    for status in sorted(Status):
        if status <= 0 or status == Status.DISTRESS:  # the film's loss has a rule of its own
            continue
        row = {"part": name, "status": f"{name}.solver_status", "code": int(status)}
        row["rank"] = STATUS_RANKS.get(status, KINDS.index("other"))
        is_outside = status == Status.OUTSIDE_VERIFIED
        left = [*_verified(name, part), *_borne(name, part)] if is_outside else []
        yield from (row | one for one in left)
        every = {end: [x for one in left for x in one[end]] for end in ("inputs", "lows", "highs")}
        advice = {"says": "advice", "advice": status.advice, "name": status.name}
        yield row | advice | every | {"laws": False}


def _verified(name: str, part: Part) -> Iterator[Row]:
    for s in (s for s in part.spec.inputs if s.verified):
        yield {
            "says": "range",
            "inputs": [f"{name}.{s.name}"],
            "lows": [s.verified[0]],
            "highs": [s.verified[1]],
            "name": s.name,
            "unit": s.unit,
            "relative": s.relative,
            "range": range_text(s, s.verified),
            "VERIFIED": VERIFIED,
        }


def _borne(name: str, part: Part) -> Iterator[Row]:
    for row in _lining(name, part):
        most = row["most"] * 1e6 / row["per_load"]
        own = {"inputs": [f"{name}.load"], "lows": [-WIDE], "highs": [most]}
        yield {"says": "lining", **own, **row}


def _boxes(name: str, part: Part) -> Iterator[Row]:
    units = {s.name: s.unit for s in part.spec.inputs}
    for key, (low, high) in part.labels.get("box", {}).items():
        room = ROOM * max(high - low, abs(high), abs(low))
        own = {"part": name, "key": key, "input": f"{name}.{key}", "unit": units[key]}
        yield own | {"minimum": low, "maximum": high, "room": room}


def _lining(name: str, part: Part) -> Iterator[Row]:
    """Yield pressure [Pa] per load [N], the highest [MPa] that a lining bears, and its kind."""
    p = part.params
    if part.spec.key in MODELS and isinstance(p, ClutchParams):
        kind, most = LININGS.get(p.friction_law, LININGS["table"])
        per_load = p.faces / p.lining_area / p.land_share
        own = {"part": name, "kind": kind, "most": most / 1e6, "LINING": LINING}
        yield own | {"per_load": per_load}


def _warmth(pack: str, part: Part) -> Iterator[Row]:
    """Yield the range of friction over temperature [K], room at its ends, what is too hot."""
    p = part.params
    if isinstance(p, ClutchParams) and (known := range_of_warmth(p, part.fidelity)):
        own = {"pack": pack, "minimum": known[0], "maximum": known[1], "rounded": ROUNDED}
        yield own | {"hot": clutch_layout.HOT_LIMIT, "WARMTH": WARMTH}


def map_rows(washer: Part) -> Iterator[Row]:
    """Yield the box of a washer's map, and what becomes of points outside."""
    from ...washer.kernels.regime_and_status import LEAST_TILT
    from ...washer.map.look_up import OF_BOX, OUTSIDE, WasherMap

    with suppress(ParameterError):  # another's washer: it answered without a map of ours
        ends = map(list, WasherMap(washer.params).box.values())
        box = dict(zip(("load", "speed", "tilts", "oil_temperature"), ends, strict=True))
        own = {"least_tilt": LEAST_TILT, "then": OUTSIDE[washer.params.outside_map]}
        yield {**box, **own, "OF_BOX": OF_BOX}


def _dry(washer: Part | None) -> Iterator[Row]:
    """Yield the range of a washer's dry friction over pressure."""
    if washer is None or getattr(washer.params, "friction_law", "") != "load":
        return
    from ...washer.parameters import face_of
    from ...washer.washer_result import BEYOND, COUNTS

    p = washer.params
    low, high = p.friction_pressure_min, p.friction_pressure_max
    yield {
        "low": low,
        "high": high,
        "range": [low, high],
        "face": face_of(p.inner_radius, p.outer_radius),
        "reference": p.friction_reference,
        "slope": p.friction_slope,
        "radius": 0.5 * (p.inner_radius + p.outer_radius),
        "counts": COUNTS,
        "BEYOND": BEYOND,
    }
