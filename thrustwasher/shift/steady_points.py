"""Efficiency of a gearbox that runs steadily in a gear, with the loss of every source."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, SolveError
from ..fmu.running.direct_instance import DirectInstance
from ..model.advice import of_whole_map
from ..model.parameters import check_number
from ..numerics.power_flow import power_flow
from ..plugins import called
from ..shown import Card, Tabled, Words, column_lines, plain_dict
from ..units import format_quantity
from .checks.steady_doubts import capacity, doubts_of_point
from .cosim.system import ConnectedPart, System
from .run import connected, remarks
from .scene.connections import PACKS
from .scene.scene import Part, Scene

GEARS = {"first": "brake", "second": "clutch"}  # and the pack that holds in it
# Column -> (unit, what it is); the losses add up to `loss`.
COLUMNS = {
    "torque": ("N.m", "at the input"),
    "speed": ("rad/s", "of the input"),
    "output_torque": ("N.m", "what is left at the output"),
    "output_speed": ("rad/s", "of the output"),
    "efficiency": (
        "1",
        "power out over power in, whichever shaft drives; or none",
    ),
    "loss": ("W", "power in less power out"),
    "mesh_loss": ("W", "tooth friction of all meshes"),
    "washer_loss": ("W", "all thrust washers of the planets"),
    "thrust_bearing_loss": ("W", "thrust bearings of sun and ring"),
    "pack_loss": ("W", "drag of the open pack, its film at its clearance"),
    "pump_loss": ("W", "oil pump"),
    "churning_loss": ("W", "churning gears into the oil"),
    "rolling_loss": ("W", "main bearings and the planets' needles"),
    "seal_loss": ("W", "shaft seals"),
    "warnings": ("1", "how many there are at this point; `doubts` has their words"),
}
SOURCES = tuple(name for name in COLUMNS if name.endswith("_loss"))
OF_LOSSES = {"pump": "pump", "churning": "churning", "rolling": "bearing", "seal": "seal"}
RANGES = {"torque": ("N.m", -1e5, 1e5), "speed": ("rad/s", -5e3, 5e3)}
FORCE = 1e6  # N: the pack that holds does hold, its capacity is no matter here
SWEEPS, SETTLED = 60, 1e-13  # of the torque
NEAR = 1e-7  # of an input: a washer, nine tenths of the time, is not solved again for less


@dataclass(frozen=True)
class EfficiencyMap(Tabled):
    """Columns over all points, torque fastest; NaN where a figure has no meaning."""

    scene: Scene
    gear: str
    columns: Mapping[str, NDArray[np.float64]]
    doubts: tuple[tuple[str, ...], ...]
    """What a reader must not miss at each point, a line each."""
    flow: tuple[str, ...] = ()
    """Which way power runs at each point, or why not: ``numerics.power_flow``."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a reader must not miss, a line each."""
        lost = "losses" in self.scene.parts
        none = (
            "there is no [losses] in this scene: oil pump, churning, bearings, seals are left out"
        )
        places = list(zip(self.columns["torque"], self.columns["speed"], strict=True))
        found = of_whole_map(places, self.doubts)
        return (*found, *self.scene.warnings, *remarks(self.scene), *(() if lost else (none,)))

    def _axes(self) -> list[str]:
        names = ("torque", "speed", "oil_temperature")
        return [n for n in names if n in self.columns and len(set(self.columns[n].tolist())) > 1]

    def to_dict(self) -> dict[str, Any]:
        """Return scene, gear, columns, balance and warnings as JSON can hold them, SI units."""
        names = ("gear", "columns", "flow", "doubts", "balance", "warnings")
        own = {name: getattr(self, name) for name in names}
        return plain_dict({"scene": self.scene.name, **own})

    def _columns(self) -> Mapping[str, NDArray[np.float64]]:
        return self.columns

    def _words(self) -> dict[str, Words]:
        return {name: Words(*words) for name, words in COLUMNS.items()}

    def _card(self) -> Card:
        title = f"{self.scene.title}, {self.gear} gear, {len(self.columns['torque'])} points"
        return Card(title, column_lines(self.columns, self._words()), (), self.warnings)

    @property
    def heading(self) -> str:
        """A line over its picture."""
        oil = format_quantity(self.scene.oil_temperature, "K")
        return f"{self.scene.title}, {self.gear} gear, oil {oil}"

    @property
    def balance(self) -> float:
        """Largest part of the power in that power out and losses do not account for."""
        c = self.columns
        power = c["torque"] * c["speed"]
        out = c["output_torque"] * c["output_speed"] + sum(c[name] for name in SOURCES)
        most = np.maximum(np.maximum(np.abs(power), c["loss"]), np.finfo(float).tiny)
        return float(np.max(np.abs(power - out) / most))


def efficiency_map(
    scene: Scene,
    torque: Iterable[float],
    speed: Iterable[float],
    *,
    gear: str = "first",
    progress: bool | Callable[[int, int], None] | None = None,
) -> EfficiencyMap:
    """Return efficiency and losses of a scene's gearbox at steady points.

    Parameters
    ----------
    scene : its gearbox with all parts; profiles of engine and pressures do not count
    torque : at the input [N m], -1e5 .. 1e5; against the speed the output drives (coasting)
    speed : of the input [rad/s], -5000 .. 5000
    gear : "first", the brake holds, or "second", the clutch holds
    progress : True: a bar of tqdm, or a line, on the terminal; or called with points done and all

    Raises
    ------
    ParameterError : an argument is out of range; the message names it
    SolveError : a part has no solution at a point, or the sweeps between the parts do not settle

    Notes
    -----
    Nothing accelerates: the load at the output is what the balance of the shafts leaves. Bodies of
    washers and teeth are as warm as the point keeps them, oil has the scene's temperature, the pack
    that is open has its start's film. ``doubts`` says of each point what must not be missed:
    torque beyond the capacity of the pack that holds, safeties below 1, bodies above 150 degC,
    laws outside their ranges. ``flow`` says which shaft drives, efficiency is NaN where none does
    alone.
    """
    if gear not in GEARS:
        raise ParameterError(f"gear = {gear!r}, allowed: {', '.join(map(repr, GEARS))}")
    torques = sorted(check_number("torque", x, *RANGES["torque"]) for x in torque)
    speeds = [check_number("speed", x, *RANGES["speed"]) for x in speed]
    if not torques or not speeds:
        raise ParameterError("torque, speed: one value of each is required")
    rows, doubts, flow, holding = [], [], [], GEARS[gear]
    most = capacity(scene, holding)
    parts = {
        name: _steady(name, part, GEARS[gear])
        for name, part in scene.parts.items()
        if name != "sump"
    }
    held = {n: DirectInstance(p.spec, parameters=p.parameters()) for n, p in parts.items()}
    begun = False
    show = called("shown_progress")(progress, f"{gear} gear")
    for w in speeds:
        parts["transmission"] = _gearbox(scene.parts["transmission"], gear, w)
        own = replace(scene, parts=parts)
        gearbox = parts["transmission"]
        box = DirectInstance(gearbox.spec, parameters=gearbox.parameters())
        system = connected(own, {**held, "transmission": box})
        system.set_command(0.0 if gear == "first" else 1.0)
        system.transmission.initialize(0.0)
        for part in system.friction_parts:
            part.pull()
            if begun:
                part.refresh(0.0)
            else:
                part.initialize(0.0)
        begun = True
        for t in torques:
            rows.append(_point(system, gearbox.params, holding, t, w))
            out = rows[-1]["output_torque"] * rows[-1]["output_speed"]
            rows[-1]["efficiency"], way = power_flow(t * w, out)
            flow.append(way)
            shafts = system.transmission
            reaction = shafts.outputs[shafts.output_names.index(f"{holding}_reaction")]
            found = dict.fromkeys(doubts_of_point(own, system, holding, most, reaction))
            doubts.append(tuple(found))
            rows[-1]["warnings"] = len(found)
            if show:
                show(len(rows), len(torques) * len(speeds))
    columns = {name: np.array([row[name] for row in rows], float) for name in COLUMNS}
    return EfficiencyMap(scene, gear, columns, tuple(doubts), tuple(flow))


def _steady(name: str, part: Part, holding: str) -> Part:
    """Return a part whose bodies are as warm as its inputs keep them; packs are shut or open."""
    if name in PACKS:
        return replace(part, params=replace(part.params, starts_pressed=name == holding))
    if getattr(part.params, "thermal_mode", "") == "transient":
        return replace(part, params=replace(part.params, thermal_mode="quasi_steady"))
    return part


def _gearbox(part: Part, gear: str, speed: float) -> Part:
    """Return the transmission in a gear, at a speed of its input, without engine and load."""
    params = replace(
        part.params,
        engine_torque=0.0,
        engine_torque_points=0,
        load_torque=0.0,
        rolling_torque=0.0,
        grade_torque=0.0,
        shaft_stiffness=0.0,
        shaft_damping=0.0,
        initial_twist=0.0,
        initial_engine_speed=speed,
        initial_drum_speed=0.0 if gear == "first" else speed,
        actuation="command",
        clutch_force=FORCE,
        brake_force=FORCE,
        coupling="capacity",
    )
    return replace(part, params=params)


def _point(
    system: System, params: object, pack: str, torque: float, speed: float
) -> dict[str, float]:
    """Return a row of the map; ``system`` has that speed, ``pack`` holds."""
    box = system.transmission
    engine, load = (box.input_names.index(f"{n}_torque_input") for n in ("engine", "load"))
    drive = box.input_names.index("clutch_torque")
    shown, apart = box.output_names.index("output_acceleration"), max(1.0, 0.1 * abs(torque))
    box.inputs[engine] = torque

    def acceleration(x: float) -> float:
        box.inputs[load] = x
        box.refresh(0.0)
        return box.outputs[shown]

    last = None
    for _ in range(SWEEPS):
        box.pull()
        left = box.inputs[load]
        for _ in range(2):  # straight but for the corner of the thrust bearings
            one, two = acceleration(left), acceleration(left + apart)
            left -= one * apart / (two - one)
        acceleration(left)
        now = [left, *box.inputs[drive:]]
        if last and max(abs(a - b) for a, b in zip(now, last, strict=True)) <= SETTLED * (
            1.0 + abs(left)
        ):
            break
        last = now
        for part in system.friction_parts:
            _solve_again(part)
    else:
        raise SolveError(
            f"torque = {torque:.6g} N.m, speed = {speed:.6g} rad/s: parts and shafts did not come "
            f"to agree in {SWEEPS} sweeps"
        )
    if not box.outputs[box.output_names.index(f"{pack}_locked")]:
        raise SolveError(f"torque = {torque:.6g} N.m: the {pack} does not hold so much")
    return _row(system, params, torque, speed)


def _solve_again(part: ConnectedPart) -> None:
    """Solve a part at its present inputs, a washer unless it was solved next to them."""
    solved = part.inputs[:]
    part.pull()
    pairs = zip(part.inputs, solved, strict=True)
    moved = any(abs(now - before) > NEAR * max(abs(now), abs(before)) for now, before in pairs)
    if moved or part.name != "washer":
        part.refresh(0.0)
    else:
        part.inputs[:] = solved


def _row(system: System, params: Any, torque: float, speed: float) -> dict[str, float]:
    box = dict(zip(system.transmission.output_names, system.transmission.outputs, strict=True))
    given = dict(zip(system.transmission.input_names, system.transmission.inputs, strict=True))
    left, turned = given["load_torque_input"], box["output_speed"]
    drag = box["drag_torque"] * (box["engine_speed"] - turned)
    washers = params.washers * abs(given["washer_torque"] * box["washer_speed"])
    row = {
        "torque": torque,
        "speed": speed,
        "output_torque": left,
        "output_speed": turned,
        "loss": torque * speed - left * turned,
        "mesh_loss": abs(drag) - washers,
        "washer_loss": washers,
        "thrust_bearing_loss": box["bearing_power"],
        "pack_loss": box["clutch_reaction"] * box["clutch_speed"]
        + box["brake_reaction"] * box["brake_speed"],
    }
    row |= {f"{name}_loss": 0.0 for name in OF_LOSSES}
    if part := system.parts.get("losses"):
        own = dict(zip(part.output_names, part.outputs, strict=True))
        share = box["loss_power"] / own["oil_heat"] if own["oil_heat"] > 0.0 else 0.0
        row |= {f"{n}_loss": share * own[f"{source}_power"] for n, source in OF_LOSSES.items()}
    return row
