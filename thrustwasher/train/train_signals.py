"""Inputs, outputs and plugs of the gear train."""

from typing import Any

from ..model.spec import Exchange, Signal, Terminal, output
from ..tribology.holding.parameters import BRISTLE, bend_state, largest_capacity
from .kernels import layout as L

INPUTS = (
    Signal(
        name="torque",
        unit="N.m",
        help="torque on the input shaft; against its speed the output drives",
        low=-1e6,
        high=1e6,
        nominal=150.0,
        start=0.0,
        first=150.0,
    ),
    Signal(
        name="speed",
        unit="rad/s",
        help="speed of the input shaft, either sign",
        low=-5e3,
        high=5e3,
        nominal=300.0,
        start=0.0,
        first=300.0,
    ),
    Signal(
        name="oil_temperature",
        unit="K",
        help="temperature of the oil",
        low=233.15,
        high=473.15,
        nominal=300.0,
        start=353.15,
        verified=(253.15, 423.15),
    ),
)
ALL = tuple(s.name for s in INPUTS)
FORCES = {"tangential": "tangential", "radial": "separating", "axial": "axial (towards +x)"}
SAFETIES = {
    "pitting": "flanks are expected to pit; lower the torque or widen the gears",
    "root": "teeth are expected to break at the root; lower the torque or take a larger module",
    "scuffing": "flanks are expected to scuff; lower torque, speed or oil temperature",
}
NO_MESH, NO_SHAFT = " (-1: no such mesh)", " (-1: no such shaft)"


def _out(name: str, unit: str, nominal: float, text: str, **more: Any) -> Signal:
    return output(name, unit, nominal, text, ALL, **more)


def _least(name: str) -> Signal:
    return _out(f"{name}_safety", "1", 1.0, f"minimum {name} safety of all meshes (1000: no limit)")


def _of_mesh(i: int) -> list[Signal]:
    found = [
        _out(f"mesh_{i}_loss", "W", 100.0, f"mesh {i}: tooth friction{NO_MESH}"),
        _out(f"mesh_{i}_bulk_temperature", "K", 300.0, f"mesh {i}: bodies of the gears{NO_MESH}"),
    ]
    for name, words in FORCES.items():
        text = f"mesh {i}: {words} force on the pinion{NO_MESH}"
        found.append(_out(f"mesh_{i}_{name}_force", "N", 1e3, text))
    for name in SAFETIES:
        text = f"mesh {i}: {name} safety (1000: no limit given){NO_MESH}"
        found.append(_out(f"mesh_{i}_{name}_safety", "1", 1.0, text))
    return found


def _of_bearing(i: int, k: int) -> list[Signal]:
    name, words = f"shaft_{i}_bearing_{k}", f"shaft {i}, bearing {k}: "
    rows = {
        "radial_force": ("N", 1e3, "radial force"),
        "axial_force": ("N", 1e3, "axial force that it takes"),
        "load": ("N", 1e3, "equivalent load P of ISO 281"),
        "loss": ("W", 10.0, "heat"),
        "life": ("s", 1e7, "basic rating life L10h of ISO 281 (at most 1e12 s)"),
    }
    return [
        _out(f"{name}_{key}", unit, nominal, f"{words}{text}{NO_SHAFT}")
        for key, (unit, nominal, text) in rows.items()
    ]


def _states(i: int) -> list[Signal]:
    kinds = {
        "regime": ("Regime", "lubrication regime of its hottest flank (film: no such mesh)"),
        "status": ("SolverStatus", "how it was solved"),
    }
    return [
        Signal(
            name=f"mesh_{i}_{name}",
            unit="1",
            kind="enumeration",
            type=kind,
            depends=ALL,
            help=f"mesh {i}: {text}",
        )
        for name, (kind, text) in kinds.items()
    ]


MESHES, SHAFTS = range(1, L.MESHES + 1), range(1, L.SHAFTS + 1)
OUTPUTS = (
    _out("loss_torque", "N.m", 1.0, "all losses as a torque on the input shaft, sign of its speed"),
    _out("output_torque", "N.m", 1e3, "torque that is left at the output, about the same axis"),
    output("output_speed", "rad/s", 100.0, "speed of the output shaft, same axis", ("speed",)),
    _out("efficiency", "1", 1.0, "what comes out over what goes in (-1: nothing comes out)"),
    _out("loss", "W", 100.0, "power in less power out"),
    _out("mesh_loss", "W", 100.0, "tooth friction of all meshes"),
    _out("bearing_loss", "W", 100.0, "heat of all bearings"),
    output("seal_loss", "W", 10.0, "heat of all shaft seals", ALL[1:]),
    output("churning_loss", "W", 100.0, "heat of all churning gears into the oil", ALL[1:]),
    _out("oil_heat", "W", 100.0, "heat that reaches the oil, mean of the step"),
    output("oil_energy", "J", 1e3, "heat that has gone into the oil since the start"),
    *map(_least, SAFETIES),
    _out("bearing_life", "s", 1e7, "minimum basic rating life L10h of all bearings"),
    *(signal for i in MESHES for signal in _of_mesh(i)),
    *(signal for i in SHAFTS for k in (1, 2) for signal in _of_bearing(i, k)),
    *(signal for i in MESHES for signal in _states(i)),
    Signal(
        name="solver_status",
        unit="1",
        kind="enumeration",
        type="SolverStatus",
        depends=ALL,
        help="how the last solution was obtained",
    ),
)


_BODIES = tuple(f"mesh_{i}_body_temperature" for i in MESHES)
_STATES = (*_BODIES, "bend")


def _needs(s: Signal) -> tuple[str, ...]:
    """Return what acts on an output in model exchange."""
    if s.name in {"oil_energy", "output_speed"}:
        return ("oil_energy",) if s.name == "oil_energy" else ("speed",)
    return (*ALL, *_STATES)


EXCHANGE = Exchange(
    kernel="thrustwasher.train.kernels.exchange",
    states=(
        *(
            output(name, "K", 300.0, f"mesh {i}: temperature of the bodies as a state")
            for i, name in zip(MESHES, _BODIES, strict=True)
        ),
        bend_state("bend", "of the bristle that holds the input shaft at rest"),
        output("oil_energy", "J", 1e3, "heat that has gone into the oil since the start"),
    ),
    needs={
        **{s.name: _needs(s) for s in OUTPUTS if s.kind == "real"},
        **{f"der({name})": (*ALL, *_STATES) for name in (*_STATES, "oil_energy")},
        **{f"start({name})": ALL for name in _STATES},
    },
    indicators=tuple(
        f"mesh {i}: {text}"
        for i in MESHES
        for text in (
            "film ratio 3, from film to mixed",
            "film ratio 1, from mixed to boundary",
            "the temperature from which the film is hot",
            "the ends of the laws: of the oil's temperature, the asperities', their hardness",
        )
    ),
    parameters=(
        *BRISTLE,
        largest_capacity("at rest and pitting_safety 3", 10.0),
    ),
)


def absent_outputs(params: Any) -> frozenset[str]:
    """Return the outputs without a value: of meshes and shafts that are not there, no limit."""
    meshes = int(params.meshes)
    found = {
        s.name
        for s in OUTPUTS
        for i in range(meshes + 1, L.SHAFTS + 1)
        if s.name.startswith((f"mesh_{i}_", f"shaft_{i + 1}_"))
    }
    no_root = [i for i in range(1, meshes + 1) if getattr(params, f"mesh_{i}_root_limit") == 0.0]
    found |= {f"mesh_{i}_root_safety" for i in no_root}
    return frozenset(found | ({"root_safety"} if len(no_root) == meshes else set()))


def _plug(name: str, kind: str, text: str, *members: tuple[str, str, str]) -> Terminal:
    return Terminal(name=name, kind=f"thrustwasher.{kind}", help=text, members=members)


TERMINALS = (
    _plug(
        "shaft",
        "MeshFlange",
        "Speed and torque of the input shaft in, the losses as a torque on it out",
        ("speed", "w", "signal"),
        ("loss_torque", "tau", "outflow"),
        ("torque", "load", "signal"),
    ),
    _plug(
        "oil",
        "HeatPort",
        "Oil temperature in, heat to the oil out",
        ("oil_temperature", "T", "signal"),
        ("oil_heat", "Q_flow", "outflow"),
    ),
    _plug(
        "oil_by_energy",
        "HeatEnergyPort",
        "Oil temperature in, heat to the oil since the start out",
        ("oil_temperature", "T", "signal"),
        ("oil_energy", "E", "outflow"),
    ),
)
