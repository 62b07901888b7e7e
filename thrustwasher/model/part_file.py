"""Part files: your own part as TOML, and the presets that come with the package.

A part file names its model and holds parameters with units, the box of inputs it is meant for and
notes::

    model = "washer"
    name = "MyWasher"

    oil = "ISO VG 46"

    [parameters]
    roughness = "0.5 um"

    [box]
    load = ["20 N", "1850 N"]

    [scatter]
    roughness = "10 %"

Presets are such files, in ``data/parts/MODEL/NAME.toml``. What a file leaves out is at its default.
"""

import json
import logging
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cache, cached_property
from pathlib import Path
from typing import Any, TypeVar

from ..errors import ParameterError, Suggesting, within
from ..face_load import LIMITED, over_limits
from ..logs import warn
from ..shown import text_of
from ..units import exact_quantity, format_quantity
from .levels import level_named
from .oil import Oil, oil_doubts, refuse_two_ways, sheet_oil
from .parameters import (
    allowed,
    check_number,
    earlier_of,
    held_choices,
    other_names_of,
    plainly_named,
    renewed_values,
    with_changes,
)
from .point import point_of
from .quantity import Figure, Quantity, part_quantities
from .registry import MODELS, find_model
from .scatter import Scatter, read_scatter
from .spec import ModelSpec, tailored
from .toml_tables import (
    key_text,
    nothing_else,
    number,
    parse,
    read_file,
    read_value,
    unknown,
    value_text,
)
from .unread import unread, why_unread

TEXTS = ("model", "name", "description", "fidelity", "notes")
TABLES = ("parameters", "box", "limits", "scatter")
MOST_GIVEN = 20  # parameters in the short text of a part
LONGEST_NAME = 60  # characters, of a name that becomes that of files
SUFFIX = ".toml"
Box = dict[str, tuple[float, float]]
Named = TypeVar("Named", Quantity, Figure)


@dataclass(frozen=True, kw_only=True)
class PartFile:
    """Your own part: its model, its parameters and the inputs it is meant for."""

    spec: ModelSpec
    """The model."""
    name: str
    """Name of its FMU."""
    parameters: dict[str, Any] = field(default_factory=dict)
    """Values [SI] of the parameters that are given; all others are at their defaults."""
    fidelity: str
    """The level that it is solved with where no other is requested."""
    box: Box = field(default_factory=dict)
    """Range [SI] of each input that it is meant for; an input that is not there has no bounds."""
    limits: Mapping[str, float] = field(default_factory=dict)
    """What its faces bear [SI]: pressure, sliding, their product, power and energy per area."""
    oil: Oil | None = None
    """The oil that gave some of the parameters."""
    scatter: Mapping[str, Any] = field(default_factory=dict)
    """How parameters and inputs scatter: the table as it is written, so that a law relative to a
    nominal value follows that."""
    description: str = ""
    notes: str = ""
    names: Mapping[str, str] = field(default_factory=dict)
    """How names begin in the file, such as ``first.``, and in the model, ``mesh_1_``."""

    def __repr__(self) -> str:
        """Return model, name and what is given, in a few lines."""
        units = {f.name: f.metadata["unit"] for f in fields(self.spec.params)}
        given = [
            f"{self.own_name(name)} = {text_of(value, units.get(name, '1'))}"
            for name, value in self.parameters.items()
        ]
        if len(given) > MOST_GIVEN:
            given = [*given[:MOST_GIVEN], f"and {len(given) - MOST_GIVEN} more"]
        oil = f", {self.oil.name}" if self.oil else ""
        head = f"PartFile: {self.name}, a {self.spec.key}, {self.fidelity}{oil}"
        return "\n  ".join([head, *given])

    def flat_name(self, name: str) -> str:
        """Return the model's name for one of the file's, or a text that begins with it."""
        return flat_name(self.spec, self.names, name)

    def own_name(self, name: str) -> str:
        """Return the file's name for one of the model."""
        found = ((own, flat) for own, flat in self.names.items() if name.startswith(flat))
        own, flat = next(found, ("", ""))
        return own + name.removeprefix(flat)

    def own_text(self, text: str) -> str:
        """Return a name of the model, or words that begin with what it is of, as the file has it.

        ``mesh_1_loss`` is first.loss then, and "mesh 1: ..." is "first: ...".
        """
        for own, flat in self.names.items():
            if text.startswith(flat):
                return own + text.removeprefix(flat)
            words = re.sub(r"_(\d+)_", r" \1, ", flat).removesuffix(", ")
            if re.match(rf"{words}[:,]", text):
                return own.removesuffix(".").replace(".", ", ") + text.removeprefix(words)
        return text

    def suggesting(self, known: Mapping[str, Any]) -> Suggesting[Any]:
        """Return what is known by name; suggested are the names of what this part reads."""
        found, params = Suggesting(known), self.params
        own = {f.name for f in fields(params)}
        found.suggested = [
            self.own_name(name)
            for name in known
            if name not in own or not unread(params, name, self.fidelity)
        ]
        return found

    @cached_property
    def params(self) -> Any:
        """All parameters: ``WasherParams``, ``ClutchParams`` and so on."""
        return self.spec.params(**self.parameters)

    @property
    def model(self) -> ModelSpec:
        """The model as its FMU shows it: this part's name and values, inputs inside its box."""
        names = [s.name for s in self.spec.inputs]
        starts = {s.name: self.inside(s.name, s.in_fmus) for s in self.spec.inputs}
        profile = tuple((t, *map(self.inside, names, row)) for t, *row in self.spec.profile)
        return tailored(
            self.spec,
            {**self.parameters, "fidelity": level_named(self.spec, self.fidelity)},
            starts,
            profile=profile,
            **self.about,
        )

    @property
    def about(self) -> dict[str, Any]:
        """What the FMU says of this part, next to its values: fields of the model's record."""
        text = self.description.rstrip(".") or self.spec.help
        return {
            "name": self.name,
            "help": text,
            "box": self.box,
            "notes": "; ".join(filter(None, (self.notes, self.oil_words))),
        }

    @property
    def oil_words(self) -> str:
        """What is to be known of its oil; of one that has a name or a data sheet."""
        return self.oil.words(self.spec) if self.oil else ""

    @property
    def oil_warnings(self) -> list[str]:
        """What is doubtful of its oil in its box."""
        ends = self.box.get("oil_temperature", ())
        return oil_doubts(self.oil, self.spec, self.params, ends)

    def with_oil(self, given: Oil) -> "PartFile":
        """Return the part with another oil."""
        changed = {**self.parameters, **given.parameters_for(self.spec)}
        return replace(self, oil=given, parameters=changed)

    @property
    def starts(self) -> dict[str, float]:
        """Value [SI] of each of the model's inputs where none is given: its default in the box."""
        return find_model(self.spec.key).place(point_of(self, {}).values)

    def solve(self, **inputs: Any) -> Any:
        """Return the result at an operating point, with the part's level unless another is given.

        Parameters
        ----------
        inputs : of the model's ``solve_*`` [SI] (a gear mesh takes ``load``, the pinion's torque,
            for ``power`` too), and its other arguments such as ``fidelity``. An input that is not
            given is the model's default, moved into the box

        Returns
        -------
        The result; its ``warnings`` name values outside the box too.

        Raises
        ------
        ParameterError, SolveError : as of ``solve_*``; ParameterError too where the model is not
            solved at points
        """
        model = find_model(self.spec.key)
        if model.command is None:
            raise ParameterError(f"{self.spec.name}: is not solved at operating points")
        known = {s.name: s for s in (*self.spec.inputs, *model.inputs())}
        given = {
            name: check_number(name, value, known[name].unit, *known[name].range)
            for name, value in inputs.items()
            if name in known
        }
        point = point_of(self, given)
        more = {name: value for name, value in inputs.items() if name not in known}
        result = model.solve(self.params, **point.values, **{"fidelity": self.fidelity, **more})
        over = self.over_limits(result)
        found = replace(result, warnings=(*point.warnings, *over, *result.warnings))
        warn(found, logging.getLogger(__name__))
        return found

    def over_limits(self, result: Any) -> list[str]:
        """Return a line for each limit of its faces that a result passes, at its worst moment."""
        values = {n: getattr(result, n) for n in self.limits if hasattr(result, n)}
        most = {n: float(max(x) if hasattr(x, "__len__") else x) for n, x in values.items()}
        return over_limits(self.limits, most)

    def places(self, inputs: Mapping[str, float] | None = None) -> Suggesting[Quantity]:
        """Return what of the part can scatter, by name; ``inputs`` [SI], others at their starts."""
        found = part_quantities(self.spec, self.params, {**self.starts, **(inputs or {})})
        return self.named(found)

    def named(self, known: Mapping[str, Named]) -> Suggesting[Named]:
        """Return quantities or figures under the names of the file, and what it suggests."""
        if not self.names:
            return self.suggesting(known)
        own = {n: replace(x, name=self.own_name(x.name)) for n, x in known.items()}
        found = Suggesting({self.own_name(name): x for name, x in own.items()})
        found.suggested = self.suggesting(known).suggested
        return found

    def scattered(
        self,
        table: Mapping[str, object] | None = None,
        inputs: Mapping[str, float] | None = None,
    ) -> Scatter:
        """Return how the part scatters, by its own table or by another one.

        ``inputs`` [SI] are those of the point that it is solved at; ParameterError if something in
        the table is not allowed.
        """
        places, params = self.places(inputs), self.params
        others = other_names_of(self.spec.params).items()
        also = {other: places[self.own_name(name)] for other, name in others}
        given = self.scatter if table is None else table
        also |= {flat: x for n, x in places.items() if (flat := self.flat_name(n)) != n}
        known = Suggesting({**places, **also})
        known.suggested = places.suggested
        scatter = read_scatter("[scatter]", given, known)
        idle = {}
        for name in scatter.names:
            failing = unread(params, self.flat_name(name), self.fidelity)
            if failing and not any(self.own_name(c.by) in scatter.names for c in failing):
                idle[name] = why_unread(params, failing, self.fidelity)
        doubts = (f"scatter of {name} {why}" for name, why in idle.items())
        return replace(scatter, warnings=(*scatter.warnings, *doubts))

    def varied(self, values: Mapping[str, Any]) -> tuple[Any, dict[str, float]]:
        """Return the parameters, and the inputs among ``values`` [SI], of one draw of its scatter.

        ParameterError if the parameters do not go together.
        """
        names = {s.name for s in self.spec.inputs}
        if self.names:
            values = {_flat_start(self.names, n): value for n, value in values.items()}
        own = {n: value for n, value in values.items() if n not in names}
        inputs = {n: value for n, value in values.items() if n in names}
        own |= held_choices(self.params, own)
        return with_changes(self.params, self.parameters, own), inputs

    def inside(self, name: str, value: float) -> float:
        """Return the value of an input, moved into the box."""
        low, high = self.box.get(name, (-math.inf, math.inf))
        return min(max(value, low), high)


def flat_name(spec: ModelSpec, names: Mapping[str, str], text: str) -> str:
    """Return a text with the model's name at its head if that is a file's name there.

    ``names``: how names begin in the file and in the model.
    """
    flat = _flat_start(names, text)
    if flat == text:
        return text
    known = {f.name for f in fields(spec.params)} | {s.name for s in spec.outputs}
    return flat if re.split(r"\W", flat, maxsplit=1)[0] in known else text


def _flat_start(names: Mapping[str, str], text: str) -> str:
    """Return a text with the model's start of a name in place of the file's."""
    head = next((own for own in names if text.startswith(own)), "")
    return names[head] + text.removeprefix(head) if head else text


def load_part(path: str | Path) -> PartFile:
    """Return the part of a part file.

    Raises
    ------
    ParameterError : the file cannot be read, or something in it is not allowed

    Examples
    --------
    >>> part = load_part("washer.toml")  # doctest: +SKIP
    >>> solve_washer(part.params, load=300.0, speed=953.0, tilt=0.002)  # doctest: +SKIP
    """
    where = f"part {str(path)!r}"
    part = _part(where, read_file("part", path), Path(path).parent)
    with within(f"{where} [parameters]"):
        try:
            part.params  # noqa: B018  (raises what the model says about them)
        except ParameterError as problem:
            text = str(problem)
            for own, flat in part.names.items():
                text = re.sub(rf"\b{flat}", own, text)
            raise ParameterError(text) from None
    with within(where):
        part.scattered()
    return part


def is_part(name: str) -> bool:
    """Return whether a word names a part file, not a model."""
    return name.endswith(SUFFIX)


def holds_part(path: str | Path, what: str = "target") -> bool:
    """Return whether a file is that of a part, not of a shift; ParameterError if there is none.

    ``what`` the file is, in that error.
    """
    table = read_file(what, path)
    return "model" in table or bool(scene_of_part(table))


def find_part(name: str) -> PartFile:
    """Return the part of a part file, of a built-in scene, or of that model with all defaults."""
    if is_part(name):
        return load_part(name)
    if name not in MODELS and (found := scene_parts().get(name)):
        return found
    spec = find_model(name).spec
    return PartFile(spec=spec, name=spec.name, fidelity=spec.default_fidelity, scatter=spec.scatter)


def _preset_folder(key: str) -> Path:
    return Path(__file__).parents[1] / "data" / "parts" / key


@cache
def _preset_files(key: str) -> dict[str, PartFile]:
    folder = _preset_folder(key)
    if not folder.is_dir():
        return {}
    files = [f for f in folder.iterdir() if f.name.endswith(SUFFIX)]
    return {
        f.name.removesuffix(SUFFIX): _part(
            f"preset {f.name!r}", parse(f.name, f.read_text("utf-8"))
        )
        for f in sorted(files, key=lambda f: f.name)
    }


def preset_parts(spec: ModelSpec) -> dict[str, PartFile]:
    """Return the presets of a model by name."""
    return _preset_files(spec.key)


@cache
def scene_parts() -> dict[str, PartFile]:
    """Return the built-in scenes that are parts, such as "ev-reducer", a gear train, by name."""
    having = [find_model(key) for key in MODELS if find_model(key).scene_of]
    return {name: part for model in having for name, part in preset_parts(model.spec).items()}


def preset_file(spec: ModelSpec, name: str) -> Path:
    """Return where a preset's file lies; ParameterError if there is none of that name."""
    preset_part(spec, name)
    return _preset_folder(spec.key) / f"{name}{SUFFIX}"


def preset_part(spec: ModelSpec, name: str) -> PartFile:
    """Return a preset; ParameterError if there is none of that name."""
    known = preset_parts(spec)
    if name not in known:
        names = " or ".join(map(repr, known)) or f"none, {spec.name} has no presets"
        raise ParameterError(f"preset = {name!r}, allowed: {names}")
    return known[name]


def preset_params(spec: ModelSpec, preset: str | None, changes: Mapping[str, object]) -> Any:
    """Return a model's parameters: its defaults, or those of a preset, some of them changed."""
    start = {} if preset is None else preset_part(spec, preset).parameters
    return spec.params(**{**start, **changes})


def scene_of_part(table: Mapping[str, Any]) -> str:
    """Return the key of the model that a file is a scene of, such as [train]; "" if of none."""
    found = (key for key in MODELS if key in table and find_model(key).scene_of)
    return "" if "model" in table else next(found, "")


def _part(where: str, table: dict[str, Any], folder: Path | None = None) -> PartFile:
    names: dict[str, str] = {}
    if key := scene_of_part(table):
        table = find_model(key).flat(where, table, folder)
        names = table.pop("names", {})
    known = (*TEXTS, *TABLES, "oil")
    nothing_else(where, [k for k in table if k not in known], known)
    if isinstance(table.get("notes"), dict):
        table = {**table, "notes": "; ".join(f"{k}: {v}" for k, v in table["notes"].items())}
    for key in TEXTS:
        if not isinstance(table.get(key, ""), str):
            raise ParameterError(f"{where}: {key} = {table[key]!r}, allowed: a text")
    for key in TABLES:
        if not isinstance(table.get(key, {}), dict):
            raise ParameterError(f"{where}: {key} = {table[key]!r}, allowed: a table [{key}]")
    for key in ("model", "name"):
        if key not in table:
            raise ParameterError(f"{where}: {key!r} is missing")
    with within(where):
        spec = find_model(table["model"]).spec
        name = checked_name(table["name"])
        fidelity = table.get("fidelity", spec.default_fidelity)
        level_named(spec, fidelity)
    parameters = read_parameters(f"{where} [parameters]", spec, table.get("parameters", {}))
    own = None
    if "oil" in table:
        own = sheet_oil(f"{where}: oil", table["oil"])
        refuse_two_ways(f"{where}: oil", own, spec, parameters)
        parameters |= own.parameters_for(spec)
    return PartFile(
        spec=spec,
        name=name,
        parameters=parameters,
        fidelity=fidelity,
        oil=own,
        box=_box(f"{where} [box]", spec, table.get("box", {})),
        limits=_limits(f"{where} [limits]", spec, table.get("limits", {})),
        scatter=table.get("scatter", {}),
        description=table.get("description", ""),
        notes=table.get("notes", ""),
        names=names,
    )


def usual_name(spec: ModelSpec) -> str:
    """Return the name of a part that has been given none."""
    return f"My{spec.key.capitalize()}"


def checked_name(name: str) -> str:
    """Return the name of a part if it can be that of an FMU and its files."""
    device = re.fullmatch(r"con|prn|aux|nul|(com|lpt)\d", name.lower())  # no file on Windows
    if name.isidentifier() and name.isascii() and len(name) <= LONGEST_NAME and not device:
        return name
    raise ParameterError(
        f"name = {name!r}, allowed: letters, digits and _, no digit in front, at most "
        f"{LONGEST_NAME} characters; no name of a device of Windows (CON, NUL)"
    )


def read_parameters(where: str, spec: ModelSpec, table: Mapping[str, object]) -> dict[str, Any]:
    """Return the values [SI] of a table of parameters by their names."""
    known = {f.name: f.metadata for f in fields(spec.params)}
    earlier = earlier_of(spec.params)
    given = plainly_named(other_names_of(spec.params), table)
    nothing_else(where, [key for key in given if key not in known and key not in earlier], known)
    known |= earlier
    values = {key: read_value(where, key, value, known[key]) for key, value in given.items()}
    with within(where):
        return renewed_values(spec.params, values)


def _box(where: str, spec: ModelSpec, table: Mapping[str, object]) -> Box:
    """Return the ranges of inputs: two quantities, or one that is fixed."""
    inputs = {s.name: s for s in spec.inputs}
    found = {}
    for key, given in table.items():
        if key not in inputs:
            raise unknown(where, key, inputs)
        ends = given.split(":") if isinstance(given, str) else given
        ends = ends if isinstance(ends, list) else [ends]
        if len(ends) not in (1, 2):
            raise ParameterError(
                f"{where}: {key} = {given!r}, allowed: [low, high], 'low:high' or one value"
            )
        rule = inputs[key].unit, *inputs[key].range
        low, high = (number(where, key, x, rule) for x in (ends[0], ends[-1]))
        if low > high:
            raise ParameterError(f"{where}: {key} = {given!r}, allowed: low <= high")
        found[key] = low, high
    return found


def _limits(where: str, spec: ModelSpec, table: Mapping[str, Any]) -> dict[str, float]:
    """Return the limits of the faces [SI]."""
    if table and find_model(spec.key).face(spec.params()) is None:
        raise ParameterError(f"{where}: {spec.name} has no faces that it is for, allowed: none")
    nothing_else(where, table, LIMITED)
    return {k: number(where, k, x, (LIMITED[k][0], 1e-6, 1e12)) for k, x in table.items()}


def part_text(part: PartFile) -> str:
    """Return a part as the text of its file: every parameter on a line of its own, with its range.

    Read back, it gives the same numbers to the bit.
    """
    return "\n".join(_lines(part)) + "\n"


def _span(meta: Any) -> str:
    """Return the allowed range, with the units that a person would write."""
    if meta["kind"] != "real":
        return allowed(meta)
    ends = (format_quantity(meta[end], meta["unit"], difference=True) for end in ("min", "max"))
    return " .. ".join(ends)


def _lines(part: PartFile) -> Iterator[str]:
    if part.names:  # nested, as it was read
        yield from find_model(part.spec.key).nested(part)
    else:
        yield from _flat_lines(part)
    yield from _tables(part)


def _flat_lines(part: PartFile) -> Iterator[str]:
    yield f"model = {json.dumps(part.spec.key)}"
    yield f"name = {json.dumps(part.name)}  # of its FMU: letters, digits and _"
    for key in ("description", "notes"):
        yield f"{key} = {json.dumps(getattr(part, key), ensure_ascii=False)}"
    levels = " or ".join(part.spec.levels)
    yield f"fidelity = {json.dumps(part.fidelity)}  # {levels}"
    params = part.params
    is_in = part.oil and part.oil.is_in(part.spec, params)  # or it is not this oil any more
    set_by_oil = part.oil.parameters_for(part.spec) if part.oil and is_in else {}
    if part.oil and set_by_oil:
        yield f"oil = {part.oil.as_toml()}  # sets {', '.join(set_by_oil)}"
    yield ""
    yield "[parameters]"
    for f in fields(params):
        if f.name in set_by_oil:
            continue
        m, value = f.metadata, getattr(params, f.name)
        if m["kind"] == "real":
            value = exact_quantity(value, m["unit"], difference=bool(m.get("relative")))
        yield f"{f.name} = {json.dumps(value)}  # {m['help']}; {_span(m)}"


def _tables(part: PartFile) -> Iterator[str]:
    yield ""
    yield "[box]  # the inputs that it is meant for: [low, high], or one value"
    for s in part.spec.inputs:
        if s.name in part.box:
            ends = [exact_quantity(x, s.unit, difference=s.relative) for x in part.box[s.name]]
            yield f"{s.name} = {json.dumps(ends if ends[0] != ends[1] else ends[0])}  # {s.help}"
    if part.limits:
        yield ""
        yield "[limits]  # of the faces; what passes them is a warning"
        for name, x in part.limits.items():
            unit, words = LIMITED[name]
            yield f"{name} = {json.dumps(exact_quantity(x, unit))}  # {words}"
    if part.scatter:
        yield ""
        yield "[scatter]  # what is not named here is taken as known"
        for name, law in part.scatter.items():
            yield f"{key_text(part.own_name(name))} = {value_text(law)}"
