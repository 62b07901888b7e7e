"""What a search has found."""

import math
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...model.quantity import Figure
from ...shown import Card, Line, Tabled, Words
from ..scatter.result import write_columns
from .design_problem import Problem, shown
from .designs import Array
from .robustness import Share

FRONT, BEST = "front.csv", "best.toml"


@dataclass(frozen=True, kw_only=True)
class Design:
    """One design: its values and its figures [SI] by name."""

    values: dict[str, float]
    figures: dict[str, float]
    text: str = field(default="", repr=False)
    """Its file."""


@dataclass(frozen=True, kw_only=True)
class Optimum(Tabled):
    """The best design, or a front of designs of which none beats another in both figures."""

    target: str
    kind: str
    problem: Problem
    best: Design
    """Of a front the one nearest to the best of both figures."""
    front: tuple[Design, ...]
    """By rising first figure; () with one figure."""
    start: dict[str, float]
    """Figures of the design as it was."""
    binding: tuple[str, ...]
    """Limits, and ends of the variables' ranges, that keep the best design from being better."""
    tries: int
    share: Share | None
    """Of the draws of its scatter that meet the limits; of a robust search."""
    tried: Array = field(repr=False)
    """Figures requested of all designs that were tried while searching (n, 1 or 2)."""
    feasible: NDArray[np.bool_] | None = field(default=None, repr=False)
    """Whether each of them is inside all limits (n,); None: it is not known."""
    warnings: tuple[str, ...]
    notes: tuple[str, ...]
    wall_time: float = 0.0

    def to_dict(self) -> dict[str, Any]:
        """Return what JSON can hold; NaN becomes None."""
        return {
            "target": self.target,
            "kind": self.kind,
            "goals": [g.words for g in self.problem.goals],
            "limits": [x.words for x in self.problem.limits],
            "best": self.best.values,
            "figures": _plain(self.best.figures),
            "start": _plain(self.start),
            "front": [{"values": d.values, "figures": _plain(d.figures)} for d in self.front],
            "binding": list(self.binding),
            "robust": None if self.share is None else asdict(self.share),
            "tries": self.tries,
            "wall_time": self.wall_time,
            "warnings": list(self.warnings),
            "notes": list(self.notes),
        }

    def _columns(self) -> dict[str, Any]:
        """Return a row for each design of the front, without a front the best one."""
        designs = self.front or (self.best,)
        values = {n: np.array([d.values[n] for d in designs]) for n in self.problem.names}
        return values | {n: np.array([d.figures[n] for d in designs]) for n in self.best.figures}

    def _words(self) -> dict[str, Words]:
        places = self.problem.variables
        known = {p.name: Words(p.unit, "", p.relative) for p in places}
        figures = self.problem.every_figure
        return known | {f.name: Words(f.unit, f.help, f.relative) for f in figures}

    def _card(self) -> Card:
        problem, best = self.problem, self.best
        lines = [
            Line(f.name, shown(f, best.figures[f.name]), f"{f.help}; was {self.before(f)}")
            for f in problem.every_figure
        ]
        lines += [
            Line(v.name, v.text(best.values[v.name]), f"was {v.text(v.nominal)}")
            for v in problem.variables
        ]
        wanted = " and ".join(g.words for g in problem.goals)
        title = f"{self.target}: {', '.join((wanted, *(x.words for x in problem.limits)))}"
        notes = [*self.notes]
        if self.front:
            notes.insert(0, f"The best of both of a front of {len(self.front)} designs.")
        if self.binding:
            notes.append(f"What binds: {', '.join(self.binding)}.")
        return Card(title, lines, notes, self.warnings)

    def before(self, figure: Figure) -> str:
        """Return a figure of the design as it was, as a person reads it; "-": it had none."""
        value = self.start[figure.name]
        return shown(figure, value) if math.isfinite(value) else "-"

    def write(self, folder: Path) -> None:
        """Write the file of the best design, and of a front all files and their table."""
        (folder / BEST).write_text(self.best.text, encoding="utf-8")
        if not self.front:
            return
        for number, design in enumerate(self.front, 1):
            (folder / front_file(number)).write_text(design.text, encoding="utf-8")
        columns: dict[str, Any] = {"design": [front_file(n + 1) for n in range(len(self.front))]}
        units = {v.name: v.unit for v in self.problem.variables}
        for name in units:
            columns[name] = np.array([d.values[name] for d in self.front])
        for goal in self.problem.goals:
            columns[goal.figure.name] = np.array([d.figures[goal.figure.name] for d in self.front])
            units[goal.figure.name] = goal.figure.unit
        write_columns(folder / FRONT, columns, units)


def front_file(number: int) -> str:
    """Return the name of the file of a design of the front, counted from 1."""
    return f"front-{number:02d}.toml"


def _plain(figures: dict[str, float]) -> dict[str, float | None]:
    return {name: x if math.isfinite(x) else None for name, x in figures.items()}
