"""A part at a point, and the loads at which a washer loses its film and gets it back."""

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np

from ...errors import ParameterError, SolveError
from ...model.levels import level_named
from ...model.part_file import PartFile, part_text
from ...model.prepare import tables_of
from ...model.quantity import Figure, Quantity
from ...model.scatter import Scatter
from ...washer.load_curve import MOST, LoadCurve, load_curve
from ...washer.parameters import face_of
from ..scatter.part_target import PartTarget, part_target
from .designs import Array, Effort, Row

FOLDS = {
    "film_lost_load": ("film_lost", "load at which the oil film is lost, from below"),
    "film_regained_load": ("film_regained", "load at which the oil film comes back, from above"),
}
SEARCHED = (9, 20)  # nodes of a load curve while designs are searched
OTHER_LEVEL = (
    "fidelity = {!r} answers for the part's own parameters alone: solved with {!r}, as "
    "parameters are varied"
)
MOST_LOAD = 1e4  # N, end of a load curve of the default face; of larger ones in proportion
AT = ("speed", "tilt", "oil_temperature", "far_face_temperature")  # inputs of a load curve


def _most_load(params: Any) -> float:
    """Return the end of a load curve [N]."""
    usual = type(params)()
    faces = [face_of(p.inner_radius, p.outer_radius) for p in (params, usual)]
    return min(MOST_LOAD * max(faces[0] / faces[1], 1.0), MOST)


@dataclass(frozen=True, kw_only=True)
class PartDesigns:
    """A part as what is varied, made by ``part_designs``."""

    part: PartFile
    inputs: Mapping[str, float]
    """All the model's own inputs [SI]."""
    reached: str
    target: PartTarget
    warnings: tuple[str, ...]
    kind: Literal["part"] = "part"

    @property
    def name(self) -> str:
        """Name of the part."""
        return self.part.name

    @cached_property
    def places(self) -> dict[str, Quantity]:
        """Its parameters and inputs."""
        return self.part.places(self.inputs)

    @cached_property
    def figures(self) -> dict[str, Figure]:
        """Its outputs; of a washer the loads of its folds too."""
        found = {f.name: f for f in self.target.figures}
        if self.part.spec.key == "washer":
            found |= {name: Figure(name, "N", words) for name, (_, words) in FOLDS.items()}
        return self.part.suggesting(found)

    @property
    def identity(self) -> dict[str, str]:
        """Model, parameters, point and what else decides the answers."""
        return self.target.identity

    @property
    def notes(self) -> tuple[str, ...]:
        """The level and the point."""
        return self.target.notes

    def effort(self, figures: Sequence[str], variables: int) -> Effort:
        """Return less work where each design takes a whole load curve."""
        if any(name in FOLDS for name in figures):
            return Effort(sample=3 * variables, starts=2, rounds=1, tries=15, polish=4)
        return Effort(sample=16 * variables, starts=3, rounds=2, tries=60)

    def solve(self, rows: Sequence[Row], figures: Sequence[str], whole: bool = False) -> Array:
        """Return figures of designs (n, m); load curves on few nodes unless ``whole``."""
        found = np.full((len(rows), len(figures)), np.nan)
        known = {f.name: i for i, f in enumerate(self.target.figures)}
        if any(name in known for name in figures):
            numbers, _ = self.target.solve([dict(row) for row in rows], np.ones(len(rows), bool))
            for column, name in enumerate(figures):
                if name in known:
                    found[:, column] = numbers[:, known[name]]
        if any(name in FOLDS for name in figures):
            for i, row in enumerate(rows):
                with suppress(ParameterError, SolveError):
                    loads = _loads(self._curve(row, whole))
                    for column, name in enumerate(figures):
                        if name in FOLDS:
                            found[i, column] = loads.get(name, math.nan)
        return found

    def slopes(
        self, row: Row, figures: Sequence[str], names: Sequence[str], whole: bool = False
    ) -> tuple[Array, Array] | None:
        """Return figures (m,) and their slopes (m, k); None over inputs or past a fold."""
        own = {f.name for f in fields(self.part.spec.params)}
        if self.reached != "below" or not own.issuperset(names):
            return None
        values = np.full(len(figures), np.nan)
        slopes = np.full((len(figures), len(names)), np.nan)
        try:
            tables = self._tables(row, figures, names, whole)
        except ParameterError:
            return None
        except SolveError:
            return values, slopes
        for i, name in enumerate(figures):
            if name in tables:
                values[i], table = tables[name]
                slopes[i] = [table[n] for n in names]
        return values, slopes

    def scatter(self, row: Row) -> Scatter:
        """Return how the part scatters about a design."""
        part, inputs = self._design(row)
        return part.scattered(None, inputs)

    def shorter_step(
        self, rows: Sequence[Row], figures: Sequence[str], gain: float
    ) -> tuple[None, str]:
        """Return nothing: a design is one operating point."""
        return None, ""

    def with_step(self, step: float) -> "PartDesigns":
        """Return the same: it has no time step."""
        return self

    def text(self, row: Row) -> str:
        """Return the part file of a design; inputs that are varied are its box."""
        part, inputs = self._design(row)
        box = {n: (x, x) for n, x in inputs.items() if n in row}
        return part_text(replace(part, box={**part.box, **box}))

    def _design(self, row: Row) -> tuple[PartFile, dict[str, float]]:
        """Return the part of a design, and its inputs; ParameterError."""
        params, inputs = self.part.varied(row)
        given = {f.name: getattr(params, f.name) for f in fields(params)}
        return replace(self.part, parameters=given), {**self.inputs, **inputs}

    def _curve(self, row: Row, whole: bool) -> LoadCurve:
        part, inputs = self._design(row)
        point: Any = {name: inputs[name] for name in AT}
        grid = None if whole else SEARCHED
        level = self.target.fidelity
        curve = load_curve(part.params, **point, fidelity=level, grid=grid)
        if not curve.folds:
            curve = load_curve(
                part.params, **point, fidelity=level, grid=grid, load_max=_most_load(part.params)
            )
        return curve

    def _tables(
        self, row: Row, figures: Sequence[str], names: Sequence[str], whole: bool
    ) -> dict[str, tuple[float, Mapping[str, float]]]:
        """Return value and derivatives of each figure that has them."""
        found: dict[str, tuple[float, Mapping[str, float]]] = {}
        of_point = [name for name in figures if name not in FOLDS]
        if of_point:
            part, inputs = self._design(row)
            result = part.solve(**inputs, fidelity=self.target.fidelity)
            slopes = result.sensitivities(of_point, names)
            found |= {name: (getattr(result, name), slopes[name]) for name in of_point}
        if len(of_point) < len(figures):
            curve = self._curve(row, whole)
            tables = curve.fold_sensitivities(names)
            for name, (kind, _) in FOLDS.items():
                for fold, table in zip(curve.folds, tables, strict=True):
                    if fold.kind == kind and table is not None and name not in found:
                        found[name] = fold.load, table
        return found


def part_designs(part: PartFile, inputs: Mapping[str, float], reached: str) -> PartDesigns:
    """Return a part as what is varied, at ``inputs`` [SI] of its model.

    ``reached``: as in ``part_target``. ParameterError: the model is not solved at points.
    """
    level, warnings = level_named(part.spec, part.fidelity), tuple[str, ...]()
    if tables_of(part.spec, level):  # made for the part as it is
        solver = part.spec.default_fidelity
        part, warnings = replace(part, fidelity=solver), (OTHER_LEVEL.format(level, solver),)
    target = part_target(part, Scatter(), inputs, reached)
    return PartDesigns(
        part=part, inputs=target.inputs, reached=reached, target=target, warnings=warnings
    )


def _loads(curve: LoadCurve) -> dict[str, float]:
    """Return the load of the first fold of each kind, by the figure's name."""
    first = {fold.kind: fold.load for fold in reversed(curve.folds)}
    return {name: first[kind] for name, (kind, _) in FOLDS.items() if kind in first}
