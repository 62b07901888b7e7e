"""An oil, turned into the parameters of every model that knows one.

It is given by a name, by a data sheet (kinematic viscosity at 40 and at 100 degC, density at
15 degC) or by points of its viscosity. ``oils.toml`` has the named ones.
"""

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cache
from typing import Any, NamedTuple

from ..errors import ParameterError, suggestion
from ..units import exact_quantity
from .oil_laws import (
    FITTED,
    ROELANDS,
    VOGEL,
    ZERO,
    Law,
    Points,
    density,
    fitted,
    kinematic_viscosity,
    law_viscosity,
    roelands,
    three_points,
    vogel,
)
from .registry import find_model
from .spec import ModelSpec
from .toml_tables import nothing_else, number, quantity, table_beside

# Key -> (unit, minimum, maximum, parameter of the parts).
NUMBERS = {
    "density": ("kg/m3", 500.0, 1500.0, "oil_density"),
    "heat_capacity": ("J/(kg.K)", 500.0, 5e3, "oil_heat_capacity"),
    "conductivity": ("W/(m.K)", 0.01, 1.0, "oil_conductivity"),
    "pressure_viscosity": ("1/Pa", 1e-9, 1e-7, "pressure_viscosity"),
}
SHEET = {
    "kinematic_viscosity_40": ("m2/s", 1e-6, 1e-2),
    "kinematic_viscosity_100": ("m2/s", 0.5e-6, 1e-2),
    "density_15": ("kg/m3", 500.0, 1500.0),
}
POINTS = {"viscosity": "Pa.s", "kinematic_viscosity": "m2/s"}
# What gives a viscosity and a density, all but the first key of points: one of these ways.
WAYS = (("name",), tuple(SHEET), ("viscosity",), ("kinematic_viscosity",))
VISCOSITY = tuple(key for way in WAYS for key in way)
KEYS = (*VISCOSITY, *NUMBERS, "base")
# Words in a name, or of ``base``, and the base of the oil that they mean; parameter of the parts.
BASES = {
    "mineral": "mineral",
    "pao": "pao",
    "polyalphaolefin": "pao",
    "ester": "ester",
    "polyglycol": "polyglycol",
    "pag": "polyglycol",
}
BASE = "base_oil"
PRESSED = "pressure_viscosity"
USUAL_DENSITY = 850.0  # kg/m3 of an oil that does not say it
AT = 313.15  # K, at which the density is that of the parts
FAR_OFF = 0.10  # relative error of a law that is worth a warning
STIFF = 150.0  # Pa s, the most that SAE J306 allows a gear oil in the cold


class Named(NamedTuple):
    """An oil of ``oils.toml``: mm2/s at 40 and 100 degC, kg/m3 at 15 degC, degC, class."""

    viscosity_40: float
    viscosity_100: float
    density_15: float
    pour_point: float
    standard: str


@cache
def named_oils() -> dict[str, Named]:
    """Return the oils that are known by a name."""
    return {name: Named(*row) for name, row in table_beside(__file__, "oils.toml")["oils"].items()}


@dataclass(frozen=True, kw_only=True)
class Oil:
    """An oil: its viscosity and density, and what else is known of it."""

    name: str = ""
    """Of a named one."""
    viscosity_40: float = 0.0
    """Kinematic viscosity at 40 degC [m2/s]; 0 of an oil that is given by points."""
    viscosity_100: float = 0.0
    """The same at 100 degC."""
    density_15: float = 0.0
    """Density at 15 degC [kg/m3]."""
    points: Points = ()
    """Temperatures [K] and dynamic viscosities [Pa s] of an oil that is given by them."""
    rest: Mapping[str, float] = field(default_factory=dict)
    """Other numbers [SI] by their key: heat_capacity, conductivity, pressure_viscosity, density."""
    doubts: tuple[str, ...] = ()
    """What was assumed of it."""
    base: str = ""
    """What it is based on: "mineral", "pao", "ester" or "polyglycol"; "" if that is not said."""

    def viscosity(self, temperature: float) -> float:
        """Return the dynamic viscosity [Pa s] by ASTM D341; of an oil of a name or a sheet."""
        nu = kinematic_viscosity(self.viscosity_40, self.viscosity_100, temperature)
        return nu * density(self.density_15, temperature)

    def parameters_for(self, model: str | ModelSpec) -> dict[str, Any]:
        """Return the parameters of a model ("washer", "clutch", "gearmesh", ...) that it sets.

        ParameterError: the model knows no oil, or the viscosity has no law.

        >>> round(oil("ISO VG 46").parameters_for("washer")["oil_density"], 1)
        854.2
        """
        spec = model if isinstance(model, ModelSpec) else find_model(model).spec
        names, found = _names(spec), dict(self.rest)
        if self.density_15:
            found["density"] = density(self.density_15, AT)
        known: dict[str, Any] = {
            p: found[k] for k, (*_, p) in NUMBERS.items() if k in found and p in names
        }
        if self.base and BASE in names:
            known[BASE] = self.base
        if law := law_of(spec):
            if self.density_15:
                constants = fitted(law, self.viscosity_40, self.viscosity_100, self.density_15)
                known |= dict(zip(law, constants, strict=True))
            elif self.points:
                points = three_points(self.points, found.get("density", USUAL_DENSITY))
                through = vogel if law == VOGEL else roelands
                known |= dict(zip(law, through(points), strict=True))
        return known

    def is_in(self, spec: ModelSpec, params: object) -> bool:
        """Tell if a model's parameters are those that it sets."""
        return all(getattr(params, n) == x for n, x in self.parameters_for(spec).items())

    def error(self, spec: ModelSpec, temperature: float) -> float:
        """Return how far a model's law lies above ASTM D341 at a temperature [K], relative."""
        law = law_of(spec)
        if not (law and self.density_15):
            return 0.0
        constants = fitted(law, self.viscosity_40, self.viscosity_100, self.density_15)
        return law_viscosity(law, constants, temperature) / self.viscosity(temperature) - 1.0

    def worst_error(self, spec: ModelSpec) -> float:
        """Return the largest relative error of a model's law over 20 .. 150 degC."""
        low, high = FITTED
        return max(abs(self.error(spec, low + 0.01 * i * (high - low))) for i in range(101))

    def words(self, *specs: ModelSpec) -> str:
        """Say in one line what it is, how well the models' laws follow it, what stays theirs."""
        laws: dict[str, float] = {s.key: self.worst_error(s) for s in specs if law_of(s)}
        shown = ", ".join(f"{key} {100 * error:.2g} %" for key, error in laws.items())
        stay = {p for s in specs for *_, p in NUMBERS.values() if p in _names(s)}
        stay -= {p for s in specs for p in self.parameters_for(s)}
        by_base = PRESSED in stay
        stay -= {PRESSED}
        return "; ".join(
            filter(
                None,
                (
                    f"oil {self}",
                    f"density of the parts {density(self.density_15, AT):.4g} kg/m3, that at "
                    "40 degC",
                    f"largest error of the viscosity law to ASTM D341 over 20 .. 150 degC: {shown}"
                    if shown
                    else "",
                    f"given in addition to it: {', '.join(self.rest)}" if self.rest else "",
                    f"the part's own stay: {', '.join(sorted(stay))}" if stay else "",
                    f"{PRESSED}, unless given, by base oil and viscosity (ISO/TR 15144-1)"
                    if by_base
                    else "",
                ),
            )
        )

    def warnings(self, specs: Iterable[ModelSpec], temperature: float) -> list[str]:
        """Say what makes results doubtful with oil of a temperature [K]."""
        t, found = temperature - ZERO, list(self.doubts)
        pour = named_oils()[self.name].pour_point if self.name else None
        if pour is not None and t < pour:
            found.append(
                f"oil_temperature = {t:.4g} degC: {self.name} does not flow below about "
                f"{pour:g} degC (an estimate); take another oil"
            )
        errors = {s.key: self.error(s, temperature) for s in specs}
        if far := {key: x for key, x in errors.items() if abs(x) > FAR_OFF}:
            shown = ", ".join(f"{key} {100 * x:+.0f} %" for key, x in far.items())
            found.append(
                f"oil_temperature = {t:.4g} degC: the viscosity differs from ASTM D341 "
                f"({shown}), the laws hold over 20 .. 150 degC; set the viscosity "
                "parameters for this range"
            )
        return found

    def __str__(self) -> str:
        """Return name or numbers."""
        numbers = (
            f"{1e6 * self.viscosity_40:.4g} mm2/s at 40 degC, {1e6 * self.viscosity_100:.4g}"
            f" at 100 degC, {self.density_15:.4g} kg/m3 at 15 degC"
        )
        if self.base:
            numbers += f", base {self.base}"
        if not self.name:
            return numbers
        standard = named_oils()[self.name].standard
        return f"{self.name}, typical values of the class {standard} (estimates): {numbers}"

    def as_dict(self, *specs: ModelSpec) -> dict[str, Any]:
        """Return it as JSON shows it: SI units, errors of the laws over 20 .. 150 degC."""
        return {
            "name": self.name or None,
            "kinematic_viscosity_40": self.viscosity_40,
            "kinematic_viscosity_100": self.viscosity_100,
            "density_15": self.density_15,
            "worst_difference": {s.key: self.worst_error(s) for s in specs if law_of(s)},
            **({"base": self.base} if self.base else {}),
            **self.rest,
        }

    def as_toml(self) -> str:
        """Return the value of ``oil`` in a file; read back it is the same oil."""
        table: dict[str, Any] = dict(self.rest)
        if self.base:
            table["base"] = f'"{self.base}"'
        if self.name:
            table = {"name": f'"{self.name}"'} | table
        else:
            values = (self.viscosity_40, self.viscosity_100, self.density_15)
            table = {
                k: json.dumps(exact_quantity(x, SHEET[k][0])) if k != "density_15" else x
                for k, x in zip(SHEET, values, strict=True)
            } | table
        return f"{{{', '.join(f'{key} = {value}' for key, value in table.items())}}}"


def oil(given: str | Mapping[str, object]) -> Oil:
    """Return an oil.

    Parameters
    ----------
    given : a name such as "ISO VG 46" (``named_oils``, in capitals or not, with blanks or not), or
        a data sheet, a mapping or the same as text: kinematic_viscosity_40 and
        kinematic_viscosity_100 [m2/s, or with unit: "46 cSt"], density_15 [kg/m3]; next to either
        heat_capacity [J/(kg K)], conductivity [W/(m K)], pressure_viscosity [1/Pa], base
        (mineral, pao, ester, polyglycol), which may end a name: "ISO VG 320 PAO"

    Raises
    ------
    ParameterError : no such oil, numbers that are none of an oil's, or more than one way at once

    Examples
    --------
    >>> from thrustwasher import WasherParams, oil
    >>> WasherParams(**oil("ISO VG 46").parameters_for("washer")).oil_density < 870.0
    True
    >>> oil("kinematic_viscosity_40=46 cSt, kinematic_viscosity_100=6.8 cSt, density_15=870").name
    ''
    """
    return sheet_oil("oil", given)


def sheet_oil(where: str, given: object) -> Oil:
    """Return the oil of a name or a data sheet; ``where`` begins the message of an error."""
    found = read_oil(where, given)
    if found is None or not found.density_15:
        raise ParameterError(f"{where} = {given!r}, allowed: a name, or {', '.join(SHEET)}")
    return found


def read_oil(where: str, given: object) -> Oil | None:
    """Return the oil of a table or text; None of one that says nothing of any."""
    table = oil_table(where, given)
    nothing_else(where, table, KEYS)
    ways = [way for way in WAYS if any(key in table for key in way)]
    if len(ways) > 1:
        first, other = (next(key for key in way if key in table) for way in ways[:2])
        raise ParameterError(
            f"{where}: {first} together with {other}, allowed: one way to give an oil"
        )
    rest = {k: number(where, k, table[k], NUMBERS[k][:3]) for k in NUMBERS if k in table}
    way = ways[0] if ways else ()
    base = _base(where, table["base"]) if "base" in table else ""
    if "density" in rest and way in WAYS[:2]:
        raise ParameterError(
            f"{where}: density together with {way[0]}, which gives it, allowed: one"
        )
    if way == WAYS[0]:
        name, said = _name_and_base(table["name"])
        name, base = _found_name(where, name), base or said
        row = named_oils()[name]
        cold, warm = (float(f"{x}e-6") for x in row[:2])
        return Oil(
            name=name,
            viscosity_40=cold,
            viscosity_100=warm,
            density_15=row.density_15,
            rest=rest,
            base=base,
        )
    if way == WAYS[1]:
        return replace(_of_sheet(where, table, rest), base=base)
    if way:
        key = way[0]
        doubts: tuple[str, ...] = ()
        if key == "kinematic_viscosity" and "density" not in rest:
            doubts = (f"{key} without density: {USUAL_DENSITY:g} kg/m3 is taken; give density",)
        factor = 1.0 if key == "viscosity" else rest.setdefault("density", USUAL_DENSITY)
        return Oil(
            rest=rest,
            base=base,
            doubts=doubts,
            points=tuple((t, factor * x) for t, x in _pairs(where, key, table)),
        )
    return Oil(rest=rest, base=base) if rest or base else None


def _base(where: str, given: object) -> str:
    """Return the base of an oil that a word means."""
    word = given.strip().lower() if isinstance(given, str) else ""
    if word not in BASES:
        raise ParameterError(f"{where}: base = {given!r}, allowed: {', '.join(BASES)}")
    return BASES[word]


def _name_and_base(given: object) -> tuple[Any, str]:
    """Return a name without the word of its base that begins or ends it, and that base."""
    words = given.split() if isinstance(given, str) else []
    for place in (0, -1):
        if len(words) > 1 and (base := BASES.get(words[place].lower())):
            del words[place]
            return " ".join(words), base
    return given, ""


def _of_sheet(where: str, table: Mapping[str, object], rest: dict[str, float]) -> Oil:
    for key in SHEET:
        if key not in table:
            raise ParameterError(f"{where}: {key} is missing, required: {', '.join(SHEET)}")
    cold, warm, at_15 = (number(where, k, table[k], rule) for k, rule in SHEET.items())
    if not warm < cold:
        raise ParameterError(
            f"{where}: kinematic_viscosity_100 = {1e6 * warm:.6g} mm2/s, allowed: below that at "
            f"40 degC ({1e6 * cold:.6g} mm2/s)"
        )
    return Oil(viscosity_40=cold, viscosity_100=warm, density_15=at_15, rest=rest)


def _pairs(where: str, key: str, table: Mapping[str, object]) -> list[tuple[float, float]]:
    points = table[key]
    if not isinstance(points, list) or not all(isinstance(p, list) and len(p) == 2 for p in points):
        raise ParameterError(f"{where}: {key} = {points!r}, allowed: pairs [temperature, {key}]")
    return [
        (quantity(where, "temperature", t, "K"), quantity(where, key, x, POINTS[key]))
        for t, x in points
    ]


def oil_table(where: str, given: object) -> dict[str, Any]:
    """Return an oil as a table; also a text such as "kinematic_viscosity_40=46 cSt, ..."."""
    if isinstance(given, Mapping):
        return dict(given)
    if not isinstance(given, str):
        raise ParameterError(f"{where} = {given!r}, allowed: a name, or a table of its data sheet")
    if "=" not in given:
        return {"name": given}
    found: dict[str, Any] = {}
    for word in given.strip().removeprefix("{").removesuffix("}").split(","):
        key, equals, value = (part.strip() for part in word.partition("="))
        if not equals or key in found:
            raise ParameterError(f"{where} = {given!r}, allowed: a name, or KEY=VALUE, KEY=VALUE")
        found[key] = value.strip("'\"")
    return found


def _found_name(where: str, name: object) -> str:
    if not isinstance(name, str):
        raise ParameterError(f"{where}: name = {name!r}, allowed: a text")
    known = {_plain(n): n for n in named_oils()}
    plain = _plain(name)
    for key in (plain, f"sae{plain}", f"iso{plain}", f"isovg{plain.removeprefix('iso')}"):
        if key in known and not plain.isdigit():
            return known[key]
    alike = [key for key in known if re.sub(r"\d+", "", key) == re.sub(r"\d+", "", plain)]
    near = suggestion(plain, known, "{}") if not alike else min(alike, key=lambda k: _far(k, plain))
    hint = f"; did you mean {known[near]!r}?" if near else ""
    raise ParameterError(f"{where} = {name!r}, allowed: {', '.join(known.values())}{hint}")


def _far(name: str, other: str) -> int:
    """Return how far apart the numbers in two names are."""
    numbers = (map(int, re.findall(r"\d+", text)) for text in (name, other))
    return sum(abs(a - b) for a, b in zip(*numbers, strict=False))


def _plain(name: str) -> str:
    return re.sub(r"[\s_-]", "", name).lower()


def _names(spec: ModelSpec) -> set[str]:
    return {f.name for f in fields(spec.params)}


def law_of(spec: ModelSpec) -> Law | None:
    """Return the parameters of a model's law of viscosity; None if it has none."""
    return next((law for law in (ROELANDS, VOGEL) if set(law) <= _names(spec)), None)


def viscosity_of(spec: ModelSpec, params: object, temperature: float) -> float | None:
    """Return the viscosity [Pa s] by the law in a model's parameters; None if it has none."""
    law = law_of(spec)
    if law is None:
        return None
    scale, size, last = (getattr(params, name) for name in law)
    return law_viscosity(law, (scale, size, last), temperature)


def too_stiff(spec: ModelSpec, params: object, temperature: float) -> list[str]:
    """Say that the oil is all but solid at a temperature [K], by the law in the parameters."""
    found = viscosity_of(spec, params, temperature)
    if found is None or found <= STIFF:
        return []
    return [
        f"oil_temperature = {temperature - ZERO:.4g} degC: the viscosity is {found:.3g} Pa.s by "
        f"the law of the {spec.key}, above {STIFF:g} Pa.s no gear oil is used; give an oil that "
        "flows, or a warmer one"
    ]


def oil_doubts(
    given: Oil | None, spec: ModelSpec, params: object, temperatures: Iterable[float]
) -> list[str]:
    """Return what is doubtful of a part's oil at temperatures [K], each line once.

    An oil whose parameters were changed is not that oil any more: its law is not looked at.
    """
    found: dict[str, None] = {}
    named = given if given and given.is_in(spec, params) else None
    for t in temperatures:
        lines = named.warnings([spec], t) if named else []
        found |= dict.fromkeys([*lines, *too_stiff(spec, params, t)])
    return list(found)


def refuse_two_ways(what: str, given: Oil, spec: ModelSpec, others: Iterable[str]) -> None:
    """Raise ParameterError if parameters that an oil sets are given in addition to it."""
    sets = given.parameters_for(spec)
    if not sets:
        raise ParameterError(f"{what}: {spec.name} knows no oil; leave it out")
    for name in others:
        if name in sets:
            raise ParameterError(
                f"{what} together with {name}, which it sets, allowed: one of the two"
            )
