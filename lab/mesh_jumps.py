"""Every number of a gear mesh over the whole range of every real parameter and input: what jumps.

Pairs of all kinds, one quantity at a time, the others as they are (``jumps.find_jumps``). Each
jump has its cause next to it; one without is a fault.
"""

import math
import sys
from collections.abc import Callable, Iterable, Iterator
from dataclasses import Field, dataclass, fields, replace
from functools import cache
from typing import Any

import numpy as np

from lab.jumps import Jump, Numbers, Scan, find_jumps
from thrustwasher.gearmesh.kernels import layout as k
from thrustwasher.gearmesh.kernels.constants import broken_rule, derive
from thrustwasher.gearmesh.kernels.load_sharing import shared
from thrustwasher.gearmesh.kernels.operating_point import solve_point
from thrustwasher.gearmesh.parameters import SPEC, GearMeshParams
from thrustwasher.gearmesh.solve import prepare

Changes = dict[str, Any]
POINT = {"load": 14.0, "speed": 510.0, "oil_temperature": 358.15}
NAMES = (*SPEC.real_outputs, "loss_factor", "contact_ratio")
OF_A_STEP = ("stored_heat", "oil_energy")  # of no point
ABOVE_OIL = [i for i, n in enumerate(NAMES) if n.endswith("temperature")]
FLOORS = {"scuffing_margin": 1.0, "film_thickness": 1e-12, "flash_rise": 1e-3, "flash_max": 1e-3}
# Of a number's size, temperatures over that of the oil, 1 K at least. Sums over the path that are
# made anew for each load cost more.
LEAST, LEAST_ELASTIC = 2e-4, 1e-3
PIECES, SMALLEST = 16, 1e-9  # of a scan to begin with, evenly and by the logarithm
BESIDE = (0.01, 0.02, 0.05, 0.1, 0.2, 0.3)  # the standard values, either way
NO_ROOT, HOTTEST, QUADRATURE = "no root", "hottest place", "quadrature"
CAUSES = {
    HOTTEST: "numbers of one place of the path: with local friction that place moves with load, "
    "speed and oil",
    NO_ROOT: "the rack has no room for its tip, as 23.2 degrees with 1.25 and 0.38: -1; refused "
    "with a root limit",
    QUADRATURE: "sums over the path change their nodes, as where the overlap passes 1: below 1e-3, "
    "their own error",
}
UNRATED = ("spur, contact ratio about 2", "paper", "paper, law iso", "paper, literal")
LEFT = {  # pair: causes of the jumps that are left; no other pair has any
    **{name: {NO_ROOT} for name in UNRATED},
    "helical, contact ratio about 1": {QUADRATURE},
    "law mixed": {HOTTEST, QUADRATURE},
    "law li-seireg": {HOTTEST, NO_ROOT},
    "paper, every place": {HOTTEST, NO_ROOT},
}
OF_A_PLACE = frozenset({
    "temperature", "film_thickness", "surface_temperature", "thermal_stress", "film_temperature",
    "flash_rise", "film_ratio", "friction_coefficient", "scuffing_friction", "modification_factor",
    "allowable_ratio", "contact_stress", "contact_pressure_max", "flash_max",
    "scuffing_safety", "scuffing_margin", "pitting_safety", "film_ratio_gf", "micropitting_safety",
    *(n for n in SPEC.real_outputs if n.endswith(("_aisi1020", "_aisi4340"))),
})  # fmt: skip
ROOT = frozenset({"root_stress", "root_safety"})
FINEST_SUM = 1e-3  # what the sums over the path may be off


@cache
def pairs() -> dict[str, tuple[GearMeshParams, str]]:
    """Return the pairs that are scanned, each with its level."""
    spur = GearMeshParams(
        normal_module=2e-3, face_width=0.02, root_limit=430e6, permissible_film_ratio=0.1
    )
    planet = GearMeshParams.preset("planet", root_limit=430e6, permissible_film_ratio=0.1)
    elastic: Changes = {"load_sharing": "elastic"}
    relieved: Changes = {
        **elastic,
        "tip_relief_pinion": 8e-6,
        "tip_relief_gear": 6e-6,
        "tip_relief_length_pinion": 1e-3,
        "tip_relief_length_gear": 0.8e-3,
    }
    narrow: Changes = {"face_width": 8e-3}
    many: Changes = {"pinion_teeth": 60, "root_limit": 0.0}
    ring: Changes = {"internal": True, "addendum_gear": 0.8}
    larger: Changes = {
        "gear_ratio": 24 / 30,
        "pinion_teeth": 30,
        "mates_gear": 3,
        "reversed_bending": 0.7,
    }
    shift: Changes = {"profile_shift_pinion": 0.3, "profile_shift_gear": -0.1}
    low: Changes = {
        "gear_ratio": 57 / 38,
        "pinion_teeth": 38,
        "normal_module": 1.75e-3,
        "helix_angle": math.radians(15.0),
        "face_width": 21e-3,
        "profile_shift_pinion": 1.6915,
        "profile_shift_gear": 2.0003,
        "addendum": 0.42,
    }
    given: Changes = {
        "profile_shift_pinion": 0.3,
        "profile_shift_gear_from_distance": True,
        "working_centre_distance": 60.5e-3,
    }
    found = {
        "spur": spur,
        "spur, contact ratio about 2": replace(spur, **many),
        "spur, shifted": replace(spur, **shift),
        "spur, distance given": replace(spur, **given),
        "spur, elastic": replace(spur, **elastic),
        "spur, relieved": replace(spur, **relieved),
        "helical, overlap below 1": replace(planet, **narrow),
        "helical, overlap above 1": planet,
        "helical, contact ratio about 1": replace(planet, **low),
        "helical, elastic": replace(planet, **narrow, **elastic),
        "helical, relieved": replace(planet, **relieved),
        "ring, helical": replace(planet, gear_ratio=74 / 18, **ring),
        "ring, spur": replace(spur, gear_ratio=4.0, **ring),
        "planet larger than sun": replace(planet, **larger),
        "bronze on steel": replace(spur, material_gear="bronze"),
        "law iso": replace(planet, friction_law="iso"),
        "law constant": replace(planet, friction_law="constant"),
        "law mixed": replace(planet, friction_law="mixed"),
        "law li-seireg": GearMeshParams(friction_law="li-seireg"),
        "paper": GearMeshParams.preset("paper"),
        "paper, law iso": GearMeshParams.preset("iso"),
        "paper, literal": GearMeshParams.preset("literal"),
    }
    levels = {name: (params, "field") for name, params in found.items()}
    return {**levels, "paper, every place": (found["paper"], "fine")}


REAL = {f.name: f for f in fields(GearMeshParams) if f.metadata["kind"] == "real"}
INDEX = {f.name: i for i, f in enumerate(fields(GearMeshParams))}
QUANTITIES = (*REAL, *POINT)


@dataclass(frozen=True, slots=True)
class Found:
    """A jump of a pair, with its cause ("" if none is known)."""

    pair: str
    quantity: str
    jump: Jump
    cause: str

    def names(self) -> tuple[str, ...]:
        """Return the outputs that jump."""
        return tuple(NAMES[i] for i in self.jump.which)


class Asked:
    """A pair as the kernels take it, to be asked with one quantity changed."""

    def __init__(self, name: str) -> None:
        params, self.level = pairs()[name]
        self.params = params
        self.base = prepare(params, self.level)
        self.work, self.state, self.count = np.zeros(k.NWORK), np.zeros(k.NSTATE), 0.0

    def numbers(self, quantity: str, value: float) -> Numbers | None:
        """Return the outputs, temperatures above the oil's; None where the rules refuse."""
        par, point = self.base.copy(), dict(POINT)
        if quantity in point:
            point[quantity] = value
        else:
            par[INDEX[quantity]] = value
            if broken_rule(par):
                return None
        derive(par)
        load, speed, oil = point["load"], point["speed"], point["oil_temperature"]
        self.work[: k.N_FIELD] = 0.0
        here = shared(par, load, self.work)
        self.count = float(here[k.D_PLACES])
        solve_point(here, load, speed, oil, load * speed, self.state, 0.0, self.work)
        found = np.array([*self.work[: k.NOUT], here[k.D_LOSS], here[k.D_CONTACT_RATIO]])
        found[k.F_TORQUE] = self.work[k.F_MEAN_FRICTION] * here[k.D_LOSS] * load
        found[k.F_POWER] = found[k.F_TORQUE] * speed
        found[ABOVE_OIL] -= oil
        found[[NAMES.index(n) for n in OF_A_STEP]] = 0.0
        if not np.isfinite(found).all():
            raise ValueError(f"{quantity} = {value!r}: not finite")
        return found

    def places(self, quantity: str, value: float) -> tuple[float, float]:
        """Return which place is the hottest, and how many there are."""
        self.numbers(quantity, value)
        return float(self.work[k.W_PLACE]), self.count

    def start(self, quantity: str) -> list[float]:
        """Return where a scan begins: the whole range, and the standard values one by one."""
        if quantity in POINT:
            signal = next(s for s in SPEC.inputs if s.name == quantity)
            low = max(signal.low or 0.0, 0.0)  # signs do not matter
            return _places(low, signal.high or 0.0, [POINT[quantity]])
        field = REAL[quantity]
        low, high = field.metadata["min"], field.metadata["max"]
        own: list[Any] = [field.default, getattr(self.params, quantity), 0.0, 1.0]
        counts = field.metadata.get("at_zero")
        if callable(counts):  # what counts where nothing is given
            own.append(counts(self.params))
        if _stands_for_another(field):
            own = [x for x in own if x > 0.0]
            return [x for x in _places(low, high, own) if x > 0.0]
        return _places(low, high, own)


def _stands_for_another(field: Field[Any]) -> bool:
    """Tell if 0 means that something else decides: then it is no neighbour of small values."""
    meta = field.metadata
    known = ("overrides" in meta or "at_zero" in meta) or field.name.endswith("_gear")
    relief = field.name.startswith("tip_relief") or field.name == "profile_shift_gear"
    more = ("bulk_conductance", "permissible_film_ratio", "root_limit", "normal_module")
    return field.default == 0.0 and (known or field.name in more) and not relief


def _places(low: float, high: float, own: Iterable[float]) -> list[float]:
    top = max(abs(low), abs(high))
    found = {*np.linspace(low, high, PIECES + 1)}
    small = np.geomspace(max(low, SMALLEST * top), top, PIECES + 1)
    found |= {*small, *(-small)}
    for x in own:
        size = x or top
        found |= {x, *(x + d * size for d in BESIDE), *(x - d * size for d in BESIDE)}
    return sorted({float(x) for x in found if low <= x <= high})


def scan(pair: str, quantity: str) -> tuple[Scan, list[Found]]:
    """Return the scan of a quantity over its whole range, and its jumps with their causes."""
    asked = Asked(pair)
    least = LEAST if asked.params.load_sharing == "rigid" else LEAST_ELASTIC
    floors = np.array([
        1.0 if i in ABOVE_OIL else FLOORS.get(name, 1e-9) for i, name in enumerate(NAMES)
    ])  # fmt: skip
    numbers: Callable[[float], Numbers | None] = lambda x: asked.numbers(quantity, x)  # noqa: E731
    found = find_jumps(numbers, asked.start(quantity), least, floors)
    jumps = [Found(pair, quantity, j, _cause(asked, quantity, j)) for j in found.jumps]
    return found, jumps


def _cause(asked: Asked, quantity: str, jump: Jump) -> str:
    """Return why numbers jump, "" if nothing explains it."""
    names = {NAMES[i] for i in jump.which}
    first, last = (asked.numbers(quantity, x) for x in (jump.low, jump.high))
    if names <= ROOT and first is not None and last is not None:
        at = NAMES.index("root_stress")
        return NO_ROOT if min(first[at], last[at]) == k.NO_DATA else ""
    (one, few), (other, many) = (asked.places(quantity, x) for x in (jump.low, jump.high))
    if few != many and jump.size < FINEST_SUM:
        return QUADRATURE
    return HOTTEST if names <= OF_A_PLACE and one != other else ""


def scan_all(
    names: Iterable[str] | None = None, quantities: Iterable[str] = QUANTITIES
) -> Iterator[tuple[str, int, int, list[Found]]]:
    """Yield of each pair its name, places with numbers, places refused, jumps."""
    wanted = tuple(quantities)
    for pair in names or pairs():
        scans = [scan(pair, quantity) for quantity in wanted]
        jumps = [jump for _, found in scans for jump in found]
        yield pair, sum(s.values for s, _ in scans), sum(s.refused for s, _ in scans), jumps


if __name__ == "__main__":
    for name, values, refused, jumps in scan_all(sys.argv[1:] or None):
        print(f"{name}: {values} places, {refused} refused, {len(jumps)} jumps", flush=True)
        for j in jumps:
            print(f"  {j.cause or '?'}: {j.quantity} = {j.jump.low!r}, {j.jump.size:.2g},", end=" ")
            print(" ".join(j.names()), flush=True)
