"""A data set's folder: ``rig.toml`` (source, conditions), ``points.csv``, part or scene."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError, suggestion
from ...model.part_file import preset_part
from ...model.point import point_of
from ...model.registry import find_model, spec_of
from ...model.toml_tables import nothing_else, read_file
from ...settings import places
from ...storage.tables.column_names import renamed
from ...storage.tables.heads import USUAL, Wanted
from ...storage.tables.table import Table, numbers
from ...storage.tables.table_file import read_table
from ..evaluators.evaluator import Row
from ..evaluators.make import evaluator, gearbox, inputs_of, part_of

ORIGINS = ("table", "figure", "text", "fit")
TEXTS = ("title", "source", "measured", "conditions", "rights", "read", "reason")
KINDS = {
    "measured": "measured, on what is modelled, and compared blind",
    "other machine": "measured, on another machine than what is modelled",
    "calculated": "calculated by those who published it",
    "used": "measured, and used to choose a constant here",
    "not said": "the measured data set does not say what it is",
}
OTHERS = ("kind", "part", "scene", "gear", "vary", "fit", "coefficients")
ERROR = "_error"


@dataclass(frozen=True)
class DataSet:
    """What was measured, where it is published, and what stands for it here."""

    folder: Path
    texts: dict[str, str]
    target_name: str
    """The model, or the scene and the gear."""
    evaluator: Any
    """What stands for it here: a part, or a gearbox."""
    rows: tuple[Row, ...]
    """What it is asked, a row for each line of points."""
    figures: tuple[str, ...]
    """And the figure of each measured column: points are all rows of one after those of another."""
    not_measured: str
    """Inputs that are not in the points, and what is taken for them."""
    vary: str
    """The input over which points are drawn and, for a fit, divided."""
    fit: tuple[str, ...]
    """Parameters worth a fit, the first before the others."""
    output: str
    """What was measured, in words if there is more than one of it."""
    unit: str
    outputs: tuple[str, ...]
    """What was measured, of every point."""
    units: tuple[str, ...]
    inputs: dict[str, NDArray[np.float64]]
    """Columns [SI], of one length."""
    measured: NDArray[np.float64]
    error: NDArray[np.float64]
    """Standard deviation of the reading."""
    origin: tuple[str, ...]
    kind: str = "not said"
    """One of ``KINDS``; only "measured" is a test of the model."""
    input_units: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Name of the folder."""
        return self.folder.name


def load_data_set(
    path: str | Path, columns: Mapping[str, str] | None = None, wanted: Wanted = USUAL
) -> DataSet:
    """Return the measured data set of a folder.

    Parameters
    ----------
    path : of the folder with ``rig.toml``, ``points.csv`` and the part or scene that it names
    columns : columns of ``points.csv`` by the names that count, as ``--column`` takes them
    wanted : where the table stands in ``points.csv``

    Raises
    ------
    ParameterError : a file is missing or has something that is not allowed; the message says what
    """
    folder = Path(path)
    where = f"measured data set {str(folder)!r}"
    if not (folder / "rig.toml").is_file():
        raise ParameterError(f"{where}: there is no rig.toml in it")
    table = read_file("measured data set", folder / "rig.toml")
    nothing_else(where, table, (*TEXTS, *OTHERS))
    for key in TEXTS:
        if not isinstance(table.get(key), str) or not table[key].strip():
            raise ParameterError(f"{where}: {key} = {table.get(key)!r}, a text is required")
    if ("part" in table) == ("scene" in table):
        raise ParameterError(f"{where}: part or scene, allowed: the name of one of them")
    kind = str(table.get("kind", "not said"))
    if kind not in KINDS:
        raise ParameterError(f"{where}: kind = {kind!r}, allowed: {', '.join(KINDS)}")
    made: Any
    if "part" in table:
        made = evaluator(_part(folder, str(table["part"])))
        asked = places(made.part.spec)  # what the model is asked by at a point too: a gear's power
        outputs = {name: f.unit for name, f in made.measurable.items()}
    else:
        named, gear = str(table["scene"]), str(table.get("gear", "first"))
        made = gearbox(folder / named if named.endswith(".toml") else named, gear)
        asked = made.quantities
        outputs = {name: f.unit for name, f in made.figures.items()}
    inputs = {name: q.unit for name, q in asked.items() if q.is_input}
    known, origin = _columns(_points(folder / "points.csv", columns or {}, wanted), inputs, outputs)
    found = [name for name in known if name in outputs]
    if not found or (len(found) > 1 and "part" not in table):
        raise ParameterError(
            f"{where}: points.csv has the measured columns {', '.join(found) or 'none'}, allowed: "
            f"one of {', '.join(outputs)}"
        )
    rows = len(origin)
    origin = origin * len(found)  # a point for every measured column of a line
    vary = str(table.get("vary", next((n for n in known if n in inputs), "")))
    if vary not in known or vary not in inputs:
        raise ParameterError(f"{where}: vary = {vary!r}, allowed: an input that is a column")
    most = table.get("coefficients", 0)
    fitted = origin.count("fit")
    if fitted > (most if isinstance(most, int) else 0):
        raise ParameterError(
            f"{where}: {fitted} points are of a published fit with coefficients = {most!r}, "
            "allowed: at most as many points as the fit has coefficients"
        )
    several = len(found) > 1
    given = {name: known[name] for name in known if name in inputs}
    lines = zip(*(column.tolist() for column in given.values()), strict=True)
    points = [dict(zip(given, line, strict=True)) for line in lines]
    taken, target_name = "", made.name
    if "part" in table:
        taken, target_name = point_of(made.part, points[0]).taken, made.part.spec.name
        points = [inputs_of(made.part, point) for point in points]
    else:
        points = [{name: asked[name].check(x) for name, x in point.items()} for point in points]
    return DataSet(
        folder=folder,
        texts={key: " ".join(table[key].split()) for key in TEXTS},
        target_name=target_name,
        evaluator=made,
        rows=tuple(points),
        figures=tuple(found),
        not_measured=f"inputs without a column in points.csv: {taken}" if taken else "",
        vary=vary,
        fit=tuple(table.get("fit", ())),
        output=f"{len(found)} results" if several else found[0],
        unit="SI" if several else outputs[found[0]],
        outputs=tuple(name for name in found for _ in range(rows)),
        units=tuple(outputs[name] for name in found for _ in range(rows)),
        inputs={name: np.tile(column, len(found)) for name, column in given.items()},
        measured=np.concatenate([known[name] for name in found]),
        error=np.concatenate([known.get(name + ERROR, np.zeros(rows)) for name in found]),
        origin=origin,
        kind=kind,
        input_units=tuple(inputs[name] for name in given),
    )


def _part(folder: Path, named: str) -> Any:
    """Return the part of a file in the folder, of "MODEL" or of "MODEL PRESET"."""
    if named.endswith(".toml"):
        return part_of(str(folder / named))
    model, _, preset = named.partition(" ")
    spec = spec_of(find_model(model).key)
    return preset_part(spec, preset) if preset else part_of(spec.key)


def _points(path: Path, names: Mapping[str, str], wanted: Wanted) -> Table:
    """Return the table of the points."""
    if not path.is_file():
        raise ParameterError(f"{path}: cannot be read, a CSV file is required")
    return renamed(read_table(path, wanted), names)


def _columns(
    table: Table, inputs: dict[str, str], outputs: dict[str, str]
) -> tuple[dict[str, NDArray[np.float64]], tuple[str, ...]]:
    """Return the columns [SI] and the origin of every point."""
    path = table.path
    units = {**inputs, **outputs, **{n + ERROR: u for n, u in outputs.items()}}
    columns: dict[str, NDArray[np.float64]] = {}
    origin: tuple[str, ...] = ()
    for column in table.columns:
        name, difference = column.name, column.name.endswith(ERROR)
        if name == "origin":
            origin = tuple(column.cells)
            continue
        if name in table.used or name.startswith("_"):
            continue
        if name not in units:
            hint = suggestion(name, units, "did you mean {}? ")
            raise ParameterError(f"{path}: column {name!r} is not known; {hint}".rstrip("; "))
        values = numbers(column, table, units[name], difference=difference)
        if None in values:
            line = table.lines[values.index(None)]
            raise ParameterError(f"{path}, line {line}: {name} is missing")
        columns[name] = np.array(values, float)
    wrong = [text for text in origin if text not in ORIGINS]
    if wrong or not origin:
        said = f"{wrong[0]!r}" if wrong else "missing"
        raise ParameterError(f"{path}: origin {said}, allowed: {', '.join(ORIGINS)}")
    return columns, origin
