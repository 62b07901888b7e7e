"""Parameters of a gear train: flat, as an FMU has them; ``train_file`` reads them by names.

Mesh i joins shaft i, which is nearer to the input, and shaft i + 1.
"""

import math
from dataclasses import Field, dataclass, field, fields
from typing import Any

from ..errors import ParameterError, within
from ..gearmesh.parameters import GearMeshParams
from ..model.parameters import check_ranges, choice, count, extended, quantity, read_with
from ..model.spec import ModelSpec, Rule
from ..model.unread import condition_words
from .kernels import layout as L
from .train_signals import INPUTS, OUTPUTS, TERMINALS, absent_outputs

DRIVERS = {
    "pinion": "the pinion is on the shaft nearer to the input",
    "gear": "the gear is on the shaft nearer to the input",
}
HANDS = {"right": "the pinion's teeth run as a right-hand screw", "left": "as a left-hand screw"}
AXIAL = {
    "first": "the first bearing, whichever way",
    "second": "the second bearing, whichever way",
    "pushed": "that which the shaft is pushed to, as of two taper bearings face to face",
}
BEARINGS = {
    "ball": "deep groove ball bearing: life with the third power of the load",
    "angular": "angular contact ball bearing",
    "cylindrical": "cylindrical or needle roller bearing: power 10/3",
    "taper": "taper roller bearing",
}
PAIR = tuple(f.name for f in fields(GearMeshParams))
SHARED = tuple(PAIR[k] for k in L.SHARED)
# Of a mesh in a train: what decides no more than its status, and what decides nothing that a train
# tells.
FOR_STATUS = {"oil_conductivity", "oil_heat_capacity", "asperity_group", "hardness_factor"} | {
    *("area_law", "area_ratio", "switch", "asperity_base")
}
UNUSED = {"thermal_expansion", "permissible_film_ratio"}
BASIC = ("kind", "unit", "min", "max", "help", "options", "type", "relative")
CENTRE_LINE = "direction of the centre line from driver to driven, from y to z"
DEG, MM = math.radians(1.0), 1e-3
# The defaults, estimates of a reducer for an electric car of 150 kW: of each mesh its own, then
# those of its pair; of each shaft seals, then its bearings.
MESHES: tuple[dict[str, Any], ...] = (
    {"pinion_teeth": 25, "gear_ratio": 3.0, "normal_module": 2e-3, "helix_angle": 22 * DEG}
    | {"face_width": 32 * MM, "pinion_position": 30 * MM, "gear_position": 30 * MM},
    {"pinion_teeth": 21, "gear_ratio": 64 / 21, "normal_module": 3e-3, "helix_angle": 18 * DEG}
    | {"face_width": 46 * MM, "pinion_position": 85 * MM, "gear_position": 85 * MM, "hand": "left"}
    | {"angle": 40 * DEG, "gear_immersion": 0.2},
    {"pinion_teeth": 21, "gear_ratio": 3.0, "normal_module": 3e-3, "helix_angle": 18 * DEG}
    | {"face_width": 46 * MM, "pinion_position": 30 * MM, "gear_position": 30 * MM},
)
ALL_PAIRS: dict[str, Any] = {
    "hand": "right",
    "surface": "fine",
    "mean_roughness": 0.3e-6,
    "load_factor": 1.25,
    "root_limit": 430e6,
}
OIL: dict[str, float] = {  # Dexron VI
    "oil_density": 831.2,
    "viscosity_scale": 6.466e-5,
    "viscosity_b": 933.6,
    "viscosity_c": 117.2,
}
BALL, TAPER = (2.0, 4e-4, 0.56, 1.6), (4.0, 4e-4, 0.4, 1.6)  # f0, f1, X, Y
SHAFTS: tuple[dict[str, Any], ...] = (
    {"seals": 1, "seal_diameter": 35 * MM}
    | {"type": "ball", "diameter": 60 * MM, "capacity": 35.8e3, "section": 0.67, "end": 90 * MM},
    {"type": "taper", "diameter": 60 * MM, "capacity": 80e3, "section": 0.67, "end": 130 * MM},
    {"seals": 2, "seal_diameter": 45 * MM}
    | {"type": "taper", "diameter": 80 * MM, "capacity": 100e3, "section": 0.42, "end": 130 * MM},
    {"type": "taper", "diameter": 80 * MM, "capacity": 100e3, "section": 0.42, "end": 130 * MM},
)


@dataclass(frozen=True, kw_only=True)
class _TrainParams:
    """A chain of gear pairs on parallel shafts, each shaft on two bearings.

    The defaults are estimates of a two-stage reducer of an electric car: 1 : 9.14, up to 300 N m.
    """

    meshes: int = count(2, 1, L.MESHES, "number of meshes; the shafts are one more")
    oil_volume: float = quantity(1.5e-3, "m3", 1e-6, 100.0, "oil that the gears dip into")
    starvation_constant: float = quantity(
        3e-8,
        "1",
        0.0,
        1e-6,
        "SKF's K_rs, all bearings: 3e-8 oil bath or jet (0: never starved)",
    )
    required_life: float = quantity(
        0.0,
        "s",
        0.0,
        1e12,
        "basic rating life below which a bearing is warned of (0: none)",
        only_for="warnings of results in Python",
    )

    def __post_init__(self) -> None:
        check_ranges(self)
        for i in range(int(self.meshes)):
            with within(f"mesh {i + 1}"):
                pair_of(self, i)
        for number in range(int(self.meshes) + 1):
            if _is_short(self, number + 1):
                raise ParameterError(RULES[number].message(self))


def _is_short(params: Any, shaft: int) -> bool:
    first, second = (getattr(params, f"shaft_{shaft}_bearing_{k}_position") for k in (1, 2))
    return bool(abs(first - second) < 1e-4)


def pair_of(params: Any, mesh: int) -> GearMeshParams:
    """Return the parameters of a pair, ``mesh`` from 0; ParameterError if they do not fit."""
    values = {PAIR[k]: getattr(params, f"mesh_{mesh + 1}_{PAIR[k]}") for k in L.OWN}
    values |= {PAIR[k]: getattr(params, PAIR[k]) for k in L.SHARED}
    return GearMeshParams(**values, holding="off")


def _taken(name: str, more: dict[str, Any], words: str = "", before: str = "") -> Any:
    """Return a field of the gear mesh, with another default; ``words`` before its help.

    ``before``: what stands before the names of the mesh's other parameters.
    """
    own: Field[Any] = next(f for f in fields(GearMeshParams) if f.name == name)
    meta = {key: value for key, value in own.metadata.items() if key in BASIC}
    text = words + meta["help"].removesuffix(condition_words(own.metadata))
    extra: dict[str, Any] = {
        key: tuple((first if first in SHARED else before + first, *rest) for first, *rest in by)
        for key in ("read_by", "read_with")
        if (by := own.metadata.get(key))
    }
    extra |= {"only_for": "the status of a mesh"} if name in FOR_STATUS else {}
    extra |= {"read_by": ()} if name in UNUSED else {}
    meta |= {**extra, "help": text + condition_words(extra)}
    return field(default=more.get(name, own.default), metadata=meta)


def _of_mesh(i: int) -> dict[str, Any]:
    own, words = {**ALL_PAIRS, **MESHES[i - 1]}, f"mesh {i}: "
    place = "along its shaft"
    found = {
        "driver": choice("pinion", DRIVERS, "Driver", f"{words}which gear is nearer to the input"),
        "hand": choice(own["hand"], HANDS, "Hand", f"{words}hand of the pinion's helix"),
        "pinion_position": _length(own["pinion_position"], f"{words}middle of the pinion {place}"),
        "gear_position": _length(own["gear_position"], f"{words}middle of the gear {place}"),
        "angle": quantity(own.get("angle", 0.0), "rad", -6.3, 6.3, f"{words}{CENTRE_LINE}"),
    }
    for gear in ("pinion", "gear"):
        text = f"{words}depth of the {gear} in the oil over its pitch diameter"
        found[f"{gear}_immersion"] = quantity(
            own.get(f"{gear}_immersion", 0.0), "1", 0.0, 0.5, text
        )
    found |= {PAIR[k]: _taken(PAIR[k], own, words, f"mesh_{i}_") for k in L.OWN}
    return {f"mesh_{i}_{name}": f for name, f in found.items()}


def _length(default: float, text: str) -> Any:
    return quantity(default, "m", -10.0, 10.0, text)


def _of_shaft(i: int) -> dict[str, Any]:
    own, words = SHAFTS[i - 1], f"shaft {i}: "
    axial = "first" if own["type"] == "ball" else "pushed"
    found = {
        "axial": choice(axial, AXIAL, "Axial", f"{words}which bearing takes the axial force"),
        "seals": count(
            own.get("seals", 0),
            0,
            4,
            f"{words}number of lip seals",
            read_by=((f"shaft_{i}_seal_diameter", ">", 0.0),),
        ),
        "seal_diameter": quantity(
            own.get("seal_diameter", 0.0),
            "m",
            0.0,
            1.0,
            f"{words}diameter under a lip seal",
            read_by=((f"shaft_{i}_seals", ">", 0),),
        ),
    }
    for k in (1, 2):
        found |= {f"bearing_{k}_{n}": f for n, f in _of_bearing(own, k, f"{words}bearing {k}: ")}
    return {f"shaft_{i}_{name}": f for name, f in found.items()}


def _of_bearing(own: dict[str, Any], k: int, words: str) -> Any:
    f0, f1, x, y = BALL if own["type"] == "ball" else TAPER
    place = 0.0 if k == 1 else own["end"]
    yield "type", choice(own["type"], BEARINGS, "Bearing", f"{words}type")
    yield "position", _length(place, f"{words}along its shaft")
    text = f"{words}mean of bore and outer diameter"
    yield "diameter", quantity(own["diameter"], "m", 1e-3, 2.0, text)
    text = f"{words}outer less inner diameter over the mean one"
    yield "section", quantity(own["section"], "1", 0.05, 1.5, text)
    text = f"{words}basic dynamic load rating C"
    yield "capacity", quantity(own["capacity"], "N", 10.0, 1e8, text)
    yield "x_factor", quantity(x, "1", 0.0, 10.0, f"{words}X of the equivalent load X F_r + Y F_a")
    yield "y_factor", quantity(y, "1", 0.0, 10.0, f"{words}Y of it")
    yield "viscous_factor", quantity(f0, "1", 0.0, 50.0, f"{words}f0 of Palmgren's viscous torque")
    text = f"{words}f1 of Palmgren's load torque"
    yield "load_factor", quantity(f1, "1", 0.0, 0.02, text)


_MORE = {PAIR[k]: _taken(PAIR[k], OIL) for k in L.SHARED}
for _i in range(1, L.MESHES + 1):
    _MORE |= read_with((("meshes", ">=", _i),), _of_mesh(_i)) if _i > 1 else _of_mesh(_i)
for _i in range(1, L.SHAFTS + 1):
    _there = (("meshes", ">=", _i - 1),)  # the shaft behind that mesh
    _MORE |= read_with(_there, _of_shaft(_i)) if _i > 2 else _of_shaft(_i)
TrainParams: Any = extended(_TrainParams, "TrainParams", _MORE)
RULES = tuple(
    Rule(
        f"shaft_{i}_bearing_2_position = {{shaft_{i}_bearing_2_position}}, allowed: apart from "
        f"shaft_{i}_bearing_1_position = {{shaft_{i}_bearing_1_position}} by 0.1 mm and more"
    )
    for i in range(1, L.SHAFTS + 1)
)
SPEC = ModelSpec(
    key="train",
    name="GearTrain",
    help="Gear train on parallel shafts: losses of meshes, bearings, seals, churning; limits",
    params=TrainParams,
    fidelities={"handbook": "meshes with friction along their paths, statics, handbook's losses"},
    default_fidelity="handbook",
    inputs=INPUTS,
    outputs=OUTPUTS,
    kernel="thrustwasher.train.kernels.step",
    rules=RULES,
    terminals=TERMINALS,
    absent=absent_outputs,
    # Run up under torque, work, coast down through no torque, stand, turn back.
    profile=(
        (0.0, 0.0, 0.0, 300.0),
        (0.3, 100.0, 300.0, 300.0),
        (0.6, 200.0, 500.0, 340.0),
        (0.8, -100.0, 500.0, 340.0),
        (0.9, -20.0, 0.0, 340.0),
        (1.0, 30.0, -30.0, 340.0),
    ),
    scatter={
        "oil_temperature": {"normal": "4 K", "source": "estimate"},
        "torque": {"normal": "2 %", "source": "estimate"},
        "mesh_1_load_factor": {"uniform": [1.0, 1.4], "source": "estimate"},
        "mesh_2_load_factor": {"uniform": [1.0, 1.4], "source": "estimate"},
        "shaft_1_bearing_1_load_factor": {"normal": "25 %", "source": "estimate"},
        "shaft_2_bearing_1_load_factor": {"normal": "25 %", "source": "estimate"},
        "mesh_2_gear_immersion": {"normal": "20 %", "source": "estimate"},
    },
)
