"""Efficiency of a gear train, losses by source and limits, over torque, speed, oil temperature."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, Status
from ..model.advice import of_whole_map
from ..model.parameters import check_number
from ..numerics.power_flow import SELF_LOCKING
from ..plugins import called
from ..shown import Card, Tabled, Words, column_lines, plain_dict
from ..units import format_quantity
from .parameters import SPEC
from .solve import LOCKED, solve_train
from .train_file import TrainScene

RANGES = {s.name: (s.unit, *s.range) for s in SPEC.inputs}
SOURCES = ("mesh_loss", "bearing_loss", "seal_loss", "churning_loss")
WARNINGS = Words("1", "how many there are at this point; `doubts` has their words")
LEFT_OUT = ("oil_heat", "oil_energy")


@dataclass(frozen=True)
class TrainMap(Tabled):
    """Columns over all points, torque fastest, then speed; NaN where a figure has no meaning."""

    scene: TrainScene
    columns: Mapping[str, NDArray[np.float64]]
    words: Mapping[str, Words]
    """Unit and meaning of each column."""
    flow: tuple[str, ...]
    """Which way power runs at each point, or why there is no efficiency."""
    doubts: tuple[tuple[str, ...], ...]
    """What a reader must not miss at each point, a line each."""

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a reader must not miss, a line each."""
        places = list(zip(self.columns["torque"], self.columns["speed"], strict=True))
        return (*self.scene.part.oil_warnings, *of_whole_map(places, self.doubts))

    @property
    def balance(self) -> float:
        """Largest part of the power in that power out and losses do not account for."""
        c = self.columns
        power = c["torque"] * c["speed"]
        out = c["output_torque"] * c["output_speed"] + sum(c[name] for name in SOURCES)
        most = np.maximum(np.maximum(abs(power), c["loss"]), np.finfo(float).tiny)
        found = (abs(power - out) / most)[np.isfinite(out)]
        return float(found.max()) if len(found) else 0.0

    @property
    def heading(self) -> str:
        """A line over its picture, which shows the first oil temperature."""
        oil = format_quantity(float(self.columns["oil_temperature"][0]), "K")
        return f"{self.scene.title}, oil {oil}"

    def _axes(self) -> list[str]:
        names = ("torque", "speed", "oil_temperature")
        return [n for n in names if n in self.columns and len(set(self.columns[n].tolist())) > 1]

    def to_dict(self) -> dict[str, Any]:
        """Return columns, flow, doubts, balance and warnings as JSON can hold them, SI units."""
        names = ("columns", "flow", "doubts", "balance", "warnings")
        own = {name: getattr(self, name) for name in names}
        return plain_dict({"scene": self.scene.title, **own})

    def _columns(self) -> Mapping[str, NDArray[np.float64]]:
        return self.columns

    def _words(self) -> Mapping[str, Words]:
        return self.words

    def _card(self) -> Card:
        title = f"{self.scene.title}, {len(self.columns['torque'])} points"
        return Card(title, column_lines(self.columns, self.words), (), self.warnings)


def train_map(
    scene: TrainScene,
    torque: Iterable[float],
    speed: Iterable[float],
    oil_temperature: Iterable[float] = (353.15,),
    *,
    progress: bool | Callable[[int, int], None] | None = None,
) -> TrainMap:
    """Return efficiency, losses and limits of a gear train at steady points.

    Parameters
    ----------
    scene : of ``load_train``
    torque : on the input shaft [N m]; against the speed the output drives
    speed : of the input shaft [rad/s]
    oil_temperature : [K]
    progress : True: a bar of tqdm, or a line, on the terminal; or called with points done and all

    Raises
    ------
    ParameterError : an argument is out of range; the message names it
    SolveError : a mesh has no solution at a point (no case is known)
    """
    given = {"torque": torque, "speed": speed, "oil_temperature": oil_temperature}
    axes = {n: [check_number(n, x, *RANGES[n]) for x in values] for n, values in given.items()}
    if not all(axes.values()):
        raise ParameterError("torque, speed, oil_temperature: one value of each is required")
    axes["torque"].sort()
    params, names = scene.part.params, _names(scene)
    points = list(product(*reversed(axes.values())))
    rows, doubts, flow = [], [], []
    show = called("shown_progress")(progress, scene.title) if progress else None
    for n, values in enumerate(points, 1):
        point = dict(zip(reversed(axes), values, strict=True))
        row, way, said = _point(scene, params, point)
        rows.append(row)
        flow.append(way)
        doubts.append(said)
        if show:
            show(n, len(points))
    columns = {own: np.array([row[name] for row in rows], float) for name, own in names.items()}
    words = {s.name: Words(s.unit, s.help) for s in (*SPEC.inputs, *SPEC.outputs)}
    words["warnings"] = WARNINGS
    told = {own: words[name] for name, own in names.items()}
    return TrainMap(scene, columns, told, tuple(flow), tuple(doubts))


def _point(
    scene: TrainScene, params: Any, point: dict[str, float]
) -> tuple[dict[str, float], str, tuple[str, ...]]:
    """Return row, flow and doubts at a point; a train that locks itself has no figures."""
    found = solve_train(params, **point, fidelity=scene.part.fidelity, throw=False)
    locked = found.status == Status.MAX_ITERATIONS
    said = (LOCKED,) if locked else tuple(map(scene.part.own_text, found.warnings))
    shown = {name: np.nan if locked else getattr(found, name) for name in _figures(params)}
    shown["efficiency"] = found.efficiency
    flow = SELF_LOCKING if locked else found.flow
    return {**point, **shown, "warnings": float(len(said))}, flow, said


def _figures(params: Any) -> list[str]:
    absent = SPEC.absent(params)
    return [n for n in SPEC.real_outputs if n not in absent and n not in LEFT_OUT]


def _names(scene: TrainScene) -> dict[str, str]:
    """Return what inputs, outputs and warnings are called with the names of the scene."""
    plain = [s.name for s in SPEC.inputs] + _figures(scene.part.params) + ["warnings"]
    return {name: scene.part.own_text(name) for name in plain}
