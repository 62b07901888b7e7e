"""Parameters of a gear train: flat, as an FMU has them; ``train_file`` reads them by names.

Mesh i joins shaft i, which is nearer to the input, and shaft i + 1.
"""

import math
from dataclasses import Field, dataclass, field, fields
from typing import Any

from ..errors import within
from ..gearmesh.parameters import GearMeshParams
from ..losses.kernels.skf_series import SERIES
from ..losses.parameters import FULL_FILM, LAWS
from ..model.parameters import (
    check_ranges,
    check_rules,
    choice,
    count,
    extended,
    naming_unknown,
    other_names,
    quantity,
    read_with,
)
from ..model.spec import ModelSpec, Rule
from ..model.unread import condition_words
from .kernels import layout as L
from .train_signals import EXCHANGE, INPUTS, OUTPUTS, TERMINALS, absent_outputs

DRIVERS = {
    "pinion": "the pinion is on the shaft nearer to the input",
    "gear": "the gear is on the shaft nearer to the input",
}
HANDS = {"right": "the pinion's teeth run as a right-hand screw", "left": "as a left-hand screw"}
AXIAL = {
    "first": "the first bearing, whichever way",
    "second": "the second bearing, whichever way",
    "pushed": "that which the shaft is pushed to",
    "O": "both back to back without preload: radial forces act outside the pair and induce axial",
    "X": "both face to face without preload: radial forces act inside the pair and induce axial",
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
    bearing_law: str = choice("palmgren", LAWS, "BearingLaw", "law of the bearings' torques")
    bearing_sliding_friction: float = quantity(
        0.05, "1", 0.0, 0.3, FULL_FILM, read_by=(("bearing_law", "skf"),)
    )

    def __post_init__(self) -> None:
        check_ranges(self)
        for i in range(int(self.meshes)):
            with within(f"mesh {i + 1}"):
                pair_of(self, i)
        from .kernels.step import broken_rule

        check_rules(self, RULES, broken_rule)


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
    axial, other = "first" if own["type"] == "ball" else "X", f"shaft_{i}_arrangement"
    text = f"{words}which bearing takes the axial force; of taper or angular contact ones O or X"
    found = {
        "axial": choice(axial, AXIAL, "Axial", text, also=other),
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
        bearing = _of_bearing(own, i, k, f"{words}bearing {k}: ")
        found |= {f"bearing_{k}_{n}": f for n, f in bearing}
    for k in range(1, L.PUSHES + 1):
        force = _of_force(f"shaft_{i}_force_{k}", f"{words}force {k} from outside: ")
        found |= {f"force_{k}_{n}": f for n, f in force}
    return {f"shaft_{i}_{name}": f for name, f in found.items()}


def _of_bearing(own: dict[str, Any], shaft: int, k: int, words: str) -> Any:
    f0, f1, x, y = BALL if own["type"] == "ball" else TAPER
    place = 0.0 if k == 1 else own["end"]
    pair = tuple((f"shaft_{shaft}_axial", name) for name in ("O", "X"))
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
    text = f"{words}e: up to F_a = e F_r, P is F_r (0: up to where X F_r + Y F_a is)"
    yield "e_factor", quantity(0.0, "1", 0.0, 10.0, text)
    text = (
        f"{words}axial force in an arrangement O or X that it makes of its radial one, over that "
        "(below 0: taper 0.5/Y, angular contact e, others 0)"
    )
    yield "induced_factor", quantity(-1.0, "1", -1.0, 10.0, text, read_by=pair)
    text = f"{words}distance of its pressure centre from position, in an arrangement O or X"
    yield "pressure_centre", quantity(0.0, "m", 0.0, 10.0, text, read_by=pair)
    law = {name: (("bearing_law", name),) for name in LAWS}
    text = f"{words}f0 of Palmgren's viscous torque"
    yield "viscous_factor", quantity(f0, "1", 0.0, 50.0, text, read_by=law["palmgren"])
    text = f"{words}f1 of Palmgren's load torque"
    yield "load_factor", quantity(f1, "1", 0.0, 0.02, text, read_by=law["palmgren"])
    text = f"{words}its series in SKF's tables of friction"
    yield "series", choice("none", SERIES, "BearingSeries", text, read_by=law["skf"])
    text = (
        f"{words}basic static load rating C0, of ball bearings with SKF's friction (0: not given)"
    )
    yield "static_capacity", quantity(0.0, "N", 0.0, 1e8, text, read_by=law["skf"])


def _of_force(own: str, words: str) -> Any:
    pushed, turned = (((f"{own}_{name}", "!=", 0.0),) for name in ("radial", "moment"))
    text = f"{words}where it acts along the shaft"
    yield "position", quantity(0.0, "m", -10.0, 10.0, text, read_by=pushed)
    yield "radial", quantity(0.0, "N", -1e8, 1e8, f"{words}across the shaft")
    text = f"{words}direction of radial, from y to z"
    yield "direction", quantity(0.0, "rad", -6.3, 6.3, text, read_by=pushed)
    yield "axial", quantity(0.0, "N", -1e8, 1e8, f"{words}along the shaft, towards +x")
    yield "moment", quantity(0.0, "N.m", -1e8, 1e8, f"{words}about an axis across the shaft")
    text = f"{words}direction of moment's axis, from y to z"
    yield "moment_direction", quantity(0.0, "rad", -6.3, 6.3, text, read_by=turned)


_MORE = {PAIR[k]: _taken(PAIR[k], OIL) for k in L.SHARED}
for _i in range(1, L.MESHES + 1):
    _MORE |= read_with((("meshes", ">=", _i),), _of_mesh(_i)) if _i > 1 else _of_mesh(_i)
for _i in range(1, L.SHAFTS + 1):
    _there = (("meshes", ">=", _i - 1),)  # the shaft behind that mesh
    _MORE |= read_with(_there, _of_shaft(_i)) if _i > 2 else _of_shaft(_i)
TrainParams: Any = naming_unknown(other_names(extended(_TrainParams, "TrainParams", _MORE)))


def _rules(i: int) -> tuple[Rule, ...]:
    """Return the rules of a shaft in the order of the kernel, ``layout.RULES`` of each."""

    def both(name: str) -> str:
        found = (f"shaft_{i}_bearing_{k}_{name}" for k in (1, 2))
        return ", ".join(f"{n} = {{{n}}}" for n in found)

    return (
        Rule(
            f"shaft_{i}_bearing_2_position = {{shaft_{i}_bearing_2_position}}, allowed: apart from "
            f"shaft_{i}_bearing_1_position = {{shaft_{i}_bearing_1_position}} by 0.1 mm and more"
        ),
        Rule(
            f"{both('pressure_centre')}, axial = {{shaft_{i}_axial}}: radial forces act "
            "at one place, allowed: apart by 0.1 mm and more"
        ),
        Rule(
            f"{both('y_factor')}, allowed: 0.001 and more of a taper or angular contact bearing, "
            "whose induced axial force follows from it; or give induced_factor"
        ),
        Rule(
            f"shaft_{i}_axial = {{shaft_{i}_axial}}, allowed: 'O' or 'X', as its taper or angular "
            "contact bearings induce axial forces in each other; or induced_factor = 0 of those "
            "that induce none"
        ),
        Rule(
            f"bearing_law = {{bearing_law}}, {both('type')}, {both('series')}: SKF's model has no "
            "constants for one of them, allowed: a series of its type, or bearing_law = 'palmgren'"
        ),
        Rule(
            f"bearing_law = {{bearing_law}}, {both('static_capacity')}, allowed: C0 above 0 N of a "
            "ball bearing"
        ),
    )


RULES = tuple(rule for i in range(1, L.SHAFTS + 1) for rule in _rules(i))
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
    exchange=EXCHANGE,
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
