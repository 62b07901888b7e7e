"""Parameters of the wet clutch; ``interface.toml`` has its inputs and outputs."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any, Self

from ..errors import ParameterError
from ..face_load import Face, even_radius, worn_peak
from ..model.parameters import check_ranges, check_rules, choice, count, flag, other_names, quantity
from ..model.part_file import preset_params
from ..model.spec import Rule
from ..model.toml_tables import spec_beside
from ..tribology.holding.parameters import coupling_age, coupling_inertia, holding_choice
from .exchange import EXCHANGE
from .kernels.layout import N_POINTS, N_TABLE, NO_POINT, START_FRICTION, START_SPEED

FRICTION_LAWS = {
    "wang": "boundary friction of Wang, Wei & Wu (2012), Eq 12, with the shear ratio's speed law",
    "constant": "the constant coefficient constant_friction",
    "table": "a measured curve over slip speed: table_friction_0 .. 5 at 0 and table_speed_1 .. 5",
}

INPUT_PROFILES = {
    "held": "inputs stay as they are during a step; all outputs are those at its end",
    "linear": "inputs run straight from point to point; outputs after a step are of its start",
}

FRICTION_DATA = {
    "total": "friction measured on a settled pack, shear of its oil included",
    "boundary": "friction of the asperities alone (a test rig at low speed): "
    "all shear of oil is added",
}

FRICTION_TEMPERATURE = {
    "auto": "by friction_temperature_slope on the start values' table and on law wang; not at all "
    "on law constant, fidelity closed or a table of your own",
    "slope": "by friction_temperature_slope, any law",
    "points": "by 2 to 5 points, any law; of law constant they are the coefficient",
}

OF_TABLE = (("friction_law", "table"),)
OF_POINTS = (("friction_temperature", "points"),)
OF_WANG = (("friction_law", "wang"),)
OVER_SPEED = (  # the level closed has the constant law
    *(("fidelity", level) for level in ("stribeck", "field", "fine")),
    ("self", "constant"),
)
WITH_FILM = tuple(("fidelity", level) for level in ("field", "fine"))


def _coefficient(place: int, where: str) -> Any:
    return quantity(
        START_FRICTION[place],
        "1",
        0.0,
        2.0,
        f"coefficient of the table law {where}",
        read_by=OF_TABLE,
        decides="friction_temperature",
    )


def _table_speed(place: int) -> Any:
    return quantity(
        START_SPEED[place],
        "m/s",
        0.0,
        1e4,
        f"slip speed of point {place} of the table law",
        read_by=OF_TABLE,
        decides="friction_temperature",
    )


def _point_temperature(place: int) -> Any:
    return quantity(
        NO_POINT,
        "K",
        NO_POINT,
        873.15,
        f"temperature of point {place} of friction over temperature; counts with "
        "friction_temperature = points",
        read_by=OF_POINTS,
    )


def _point_friction(place: int) -> Any:
    return quantity(
        0.0,
        "1",
        0.0,
        2.0,
        f"coefficient at point_temperature_{place}, 0: no such point; counts with "
        "friction_temperature = points",
        read_by=OF_POINTS,
    )


def _warmer(place: int) -> Rule:
    last = f"{{point_temperature_{place - 1}}}" if place > 1 else f"{NO_POINT:g}"
    return Rule(
        f"point_temperature_{place} = {{point_temperature_{place}}} K, allowed: above {last} K "
        "(friction_temperature = points, which rise)"
    )


def _rising(place: int) -> Rule:
    last = f"{{table_speed_{place - 1}}}" if place > 1 else "0.0"
    return Rule(
        f"table_speed_{place} = {{table_speed_{place}}} m/s, allowed: above {last} m/s "
        "(the points of the table rise)"
    )


RULES = (
    Rule("inner_radius = {inner_radius} m, allowed: below outer_radius ({outer_radius} m)"),
    *(_rising(place) for place in range(1, N_TABLE + 1)),
    Rule(
        "groove_width = {groove_width} m, allowed: below pi (inner_radius + outer_radius)"
        "/groove_count, the distance of {groove_count} grooves at the mean radius"
    ),
    Rule(
        "friction_temperature = points with point_friction_1 = {point_friction_1}, "
        "point_friction_2 = {point_friction_2}, allowed: 2 to 5 points, each above 0"
    ),
    Rule(
        "point_friction_1 .. 5 = {point_friction_1}, {point_friction_2}, {point_friction_3}, "
        "{point_friction_4}, {point_friction_5}, allowed: above 0 from the first on, 0 behind the "
        "last point"
    ),
    *(_warmer(place) for place in range(1, N_POINTS + 1)),
)


@other_names
@dataclass(frozen=True, slots=True, kw_only=True)
class ClutchParams:
    """A pack of wet friction plates: geometry, lining, friction law, oil and steel.

    Defaults: a pack of a passenger car's transmission with an organic lining in transmission fluid,
    its friction over slip speed a table typical of such linings (an estimate). Asperities: Shock
    and Vibration 2021, 5522998. Permeability, oil cooling and speed smoothing are estimates. The
    law of Wang, Wei & Wu (2012) is ``friction_law = "wang"``; its speed law was lost with the
    paper's figures and is fitted to the prose.
    """

    inner_radius: float = quantity(0.064, "m", 1e-3, 1.0, "inner radius of the friction faces")
    outer_radius: float = quantity(0.085, "m", 2e-3, 2.0, "outer radius of the friction faces")
    faces: int = count(4, 1, 100, "number of friction faces in the pack")
    effective_radius: float = quantity(
        0.0,
        "m",
        0.0,
        10.0,
        "radius the friction acts at (0: from the face's radii)",
        overrides=("inner_radius", "outer_radius"),
        at_zero=attrgetter("friction_radius"),
    )
    friction_law: str = choice(
        "table",
        FRICTION_LAWS,
        "ClutchFrictionLaw",
        "law of friction over slip speed",
        read_by=OVER_SPEED,
    )
    friction_data: str = choice(
        "total", FRICTION_DATA, "FrictionData", "what the law of friction was measured on"
    )
    friction_scale: float = quantity(
        1.0, "1", 0.1, 2.0, "factor on the coefficient of the law of friction", tunable=True
    )
    friction_temperature: str = choice(
        "auto",
        FRICTION_TEMPERATURE,
        "FrictionTemperature",
        "how friction changes with the interface temperature",
    )
    friction_temperature_slope: float = quantity(
        -1e-3,
        "1/K",
        -1e-2,
        1e-2,
        "change of ln(friction) per kelvin, within -20 .. 200 degC; counts with "
        "friction_temperature = slope, with auto on the start values' table and on law wang only",
        read_by=(("friction_temperature", "auto"), ("friction_temperature", "slope")),
    )
    reference_temperature: float = quantity(
        373.15,
        "K",
        233.15,
        523.15,
        "interface temperature the law of friction holds at",
    )
    point_temperature_1: float = _point_temperature(1)
    point_friction_1: float = _point_friction(1)
    point_temperature_2: float = _point_temperature(2)
    point_friction_2: float = _point_friction(2)
    point_temperature_3: float = _point_temperature(3)
    point_friction_3: float = _point_friction(3)
    point_temperature_4: float = _point_temperature(4)
    point_friction_4: float = _point_friction(4)
    point_temperature_5: float = _point_temperature(5)
    point_friction_5: float = _point_friction(5)
    constant_friction: float = quantity(
        0.12,
        "1",
        0.0,
        2.0,
        "coefficient of the constant law (friction_temperature = points: that of the points)",
        read_by=(("friction_law", "constant"), ("fidelity", "closed")),
    )
    table_friction_0: float = _coefficient(0, "at standstill")
    table_speed_1: float = _table_speed(1)
    table_friction_1: float = _coefficient(1, "at table_speed_1")
    table_speed_2: float = _table_speed(2)
    table_friction_2: float = _coefficient(2, "at table_speed_2")
    table_speed_3: float = _table_speed(3)
    table_friction_3: float = _coefficient(3, "at table_speed_3")
    table_speed_4: float = _table_speed(4)
    table_friction_4: float = _coefficient(4, "at table_speed_4")
    table_speed_5: float = _table_speed(5)
    table_friction_5: float = _coefficient(5, "at table_speed_5 and above")
    indentation: float = quantity(
        0.1, "1", 1e-12, 1.0, "asperity's indentation width over 2 R", read_by=OF_WANG
    )
    plough_weight: float = quantity(
        0.085275, "1", 0.0, 1.0, "weight of the ploughing share", read_by=OF_WANG
    )
    hardness_ratio: float = quantity(
        6.0, "1", 1.0, 20.0, "hardness over shear strength of lining", read_by=OF_WANG
    )
    adhesion_factor: float = quantity(
        1.0,
        "1",
        0.1,
        10.0,
        "factor on the adhesive share (1: as published; pi/2: full s/p)",
        read_by=OF_WANG,
    )
    shear_floor: float = quantity(
        0.30, "1", 0.0, 1.0, "shear ratio s/s_m at very high slip speed", read_by=OF_WANG
    )
    stick_speed: float = quantity(
        1.185, "m/s", 0.0, 50.0, "slip speed below which s/s_m is 1", read_by=OF_WANG
    )
    decay_speed: float = quantity(
        2.872, "m/s", 1e-3, 100.0, "decay of s/s_m above stick_speed", read_by=OF_WANG
    )
    kink_width: float = quantity(
        0.0,
        "m/s",
        0.0,
        1.0,
        "rounds the kink at stick_speed (0: sharp, as the law says)",
        read_by=OF_WANG,
    )
    shear_temperature_slope: float = quantity(
        0.0,
        "1/K",
        -0.1,
        0.1,
        "relative change of s/s_m per kelvin (0: none, as published)",
        read_by=OF_WANG,
    )
    roughness: float = quantity(8.41e-6, "m", 1e-8, 1e-4, "combined RMS roughness of lining, steel")
    contact_modulus: float = quantity(2.7e7, "Pa", 1e5, 1e11, "contact modulus of the lining")
    asperity_density: float = quantity(7e7, "1/m2", 1e5, 1e12, "lining's asperities per area")
    asperity_radius: float = quantity(8e-4, "m", 1e-7, 1e-2, "radius of the lining's asperities")
    lining_thickness: float = quantity(1e-3, "m", 0.0, 0.02, "thickness of the permeable lining")
    permeability: float = quantity(
        1e-13, "m2", 0.0, 1e-9, "permeability of the lining along its plane"
    )
    land_share: float = quantity(
        0.8,
        "1",
        0.05,
        1.0,
        "share of a face that is not groove",
        belongs_to=("groove_count", "groove_width"),
    )
    groove_count: int = count(
        24,
        0,
        1000,
        "number of radial grooves in a face (0: none)",
        belongs_to=("inner_radius", "outer_radius"),
    )
    groove_width: float = quantity(
        2e-3, "m", 1e-5, 0.1, "width of a groove at its foot", read_by=(("groove_count", ">", 0),)
    )
    groove_depth: float = quantity(4e-4, "m", 1e-5, 0.01, "depth of the grooves")
    initial_film: float = quantity(1.5e-4, "m", 1e-6, 1e-2, "film thickness of the open pack")
    separating_force: float = quantity(
        200.0,
        "N",
        0.0,
        1e5,
        "force that parts two closed plates (springs, waviness), 0 at initial_film; counts in a "
        "pack that is not pressed",
        read_by=WITH_FILM,
    )
    starts_pressed: bool = flag(
        False,
        "film is settled at the start (False: pack starts open)",
        read_by=(("film_dynamics", True), ("self", True)),
        of_a_run=True,
    )
    film_dynamics: bool = flag(
        True,
        "field fidelity level: oil takes time to leave and resists shear (False: film "
        "settled, no shear)",
        read_by=(*WITH_FILM, ("self", False)),
    )
    shear_heating: bool = flag(
        True,
        "field fidelity level: oil between the faces is thinned by its own shear (False: as "
        "the faces)",
        read_by=WITH_FILM,
    )
    oil_flow: float = quantity(
        1e-3 / 60.0,
        "m3/s",
        0.0,
        1.0,
        "oil fed to the pack; limits its drag and cooling (0: as much as it takes)",
        belongs_to=("inner_radius", "outer_radius", "faces"),
    )
    oil_density: float = quantity(850.0, "kg/m3", 500.0, 1500.0, "density of the oil")
    oil_heat_capacity: float = quantity(
        2050.0, "J/(kg.K)", 500.0, 5000.0, "heat capacity of the oil"
    )
    oil_conductivity: float = quantity(0.145, "W/(m.K)", 0.01, 2.0, "heat conductivity of the oil")
    viscosity_constant: float = quantity(
        3.545, "1", 0.0, 6.0, "G_o of the Roelands law (0: viscosity is viscosity_scale, constant)"
    )
    viscosity_exponent: float = quantity(
        1.053, "1", 0.2, 3.0, "S_o of the Roelands law", read_by=(("viscosity_constant", ">", 0.0),)
    )
    viscosity_scale: float = quantity(6.31e-5, "Pa.s", 1e-6, 10.0, "scale of the Roelands law")
    steel_thickness: float = quantity(2e-3, "m", 1e-4, 0.1, "thickness of a steel plate")
    steel_density: float = quantity(7850.0, "kg/m3", 500.0, 2e4, "density of the steel plates")
    steel_heat_capacity: float = quantity(475.0, "J/(kg.K)", 50.0, 5e3, "heat capacity of steel")
    steel_conductivity: float = quantity(
        50.0,
        "W/(m.K)",
        1.0,
        500.0,
        "heat conductivity of the steel plates",
        read_by=(("contact_rise", True),),
    )
    contact_rise: bool = flag(
        False, "interface hotter than the plate's mean by conduction (semi-infinite at first)"
    )
    heat_transfer: float = quantity(
        1000.0, "W/(m2.K)", 0.0, 1e5, "cooling by the oil of an open face, or without grooves"
    )
    speed_smoothing: float = quantity(
        0.1,
        "rad/s",
        1e-6,
        100.0,
        "slip over which friction_torque passes through zero where nothing is held",
        read_by=(("holding", "off"),),
    )
    input_profile: str = choice(
        "held",
        INPUT_PROFILES,
        "InputProfile",
        "what load and slip do between two steps",
        of_a_run=True,
    )
    holding: str = holding_choice("the pack")
    coupling_inertia: float = coupling_inertia()
    coupling_age: int = coupling_age()
    probing: bool = flag(
        True,
        "the pack asks: its torque is lower by 2 to 50 % in a dozen steps of an engagement (False: "
        "holding = given is trusted, identified never holds)",
        read_by=(("holding", "identified"), ("holding", "given")),
        of_a_run=True,
    )

    def __post_init__(self) -> None:
        check_ranges(self)
        from .kernels.constants import broken_rule

        check_rules(self, RULES, broken_rule)

    @classmethod
    def preset(cls, name: str, **changes: object) -> "ClutchParams":
        """Return the parameters of a preset, some of them changed.

        ``"paper"``: the sample of Wang, Wei & Wu (2012), two plain faces of 85 x 65 mm, with their
        law of friction.

        Raises
        ------
        ParameterError : no such preset, or a parameter out of range
        """
        made: ClutchParams = preset_params(SPEC, name, changes)
        return made

    @property
    def lining_area(self) -> float:
        """Area of all friction faces [m2]."""
        return self.faces * math.pi * (self.outer_radius**2 - self.inner_radius**2)

    @property
    def friction_radius(self) -> float:
        """Radius [m] friction acts at: the one that was set, or that of even pressure."""
        return float(self.effective_radius) or even_radius(self.inner_radius, self.outer_radius)

    def temperature_law(self, fidelity: str = "") -> str:
        """Return what changes friction with temperature: "slope", "points", "" for nothing.

        ``fidelity``: the level; "" if it is not known and is not closed.
        """
        found = self.friction_temperature
        if found == "auto":
            own = [getattr(self, f"table_friction_{n}") for n in range(N_TABLE + 1)]
            own += [getattr(self, f"table_speed_{n}") for n in range(1, N_TABLE + 1)]
            starts = (*START_FRICTION, *START_SPEED[1:])
            table = self.friction_law == "table" and all(
                math.isclose(a, b, rel_tol=1e-12) for a, b in zip(own, starts, strict=True)
            )
            shipped = (table or self.friction_law == "wang") and fidelity != "closed"
            found = "slope" if shipped else ""
        return "" if found == "slope" and not self.friction_temperature_slope else found

    def decided(self, fitted: Iterable[str] = ()) -> Self:
        """Return the same pack with what ``friction_temperature`` = auto lets act written out.

        Values next to it then have the friction over temperature that it has. ``fitted``: names of
        parameters that are to act too, the slope among them.
        """
        acts = "friction_temperature_slope" in fitted or self.temperature_law() == "slope"
        if self.friction_temperature == "auto" and acts:
            return replace(self, friction_temperature="slope")
        return self

    @property
    def face(self) -> Face:
        """The friction faces."""
        area, peak = self.lining_area / self.faces, worn_peak(self.inner_radius, self.outer_radius)
        return Face(area, self.faces, self.friction_radius, peak)

    @classmethod
    def with_table(
        cls, speed: Sequence[float], friction: Sequence[float], **others: Any
    ) -> "ClutchParams":
        """Return parameters whose friction follows a measured curve.

        Parameters
        ----------
        speed : 2 to 6 slip speeds [m/s] at the mean radius, rising, the first one 0
        friction : coefficients [-] at these speeds; straight in between, the last one holds above
        others : further parameters

        Examples
        --------
        >>> ClutchParams.with_table([0.0, 1.0, 10.0], [0.12, 0.11, 0.13]).friction_law
        'table'
        """
        n = len(speed)
        if len(friction) != n or not 2 <= n <= N_TABLE + 1 or speed[0] != 0.0:
            raise ParameterError(
                f"speed, friction: {n} and {len(friction)} values from {speed[0]!r} m/s on, "
                f"allowed: 2 .. {N_TABLE + 1} pairs, the first at 0 m/s"
                if n
                else "speed: no values"
            )
        table: dict[str, Any] = {"table_friction_0": friction[0]}
        for k in range(1, N_TABLE + 1):
            inside = k < n
            # points that are not given lie above the last one, at its value
            table[f"table_speed_{k}"] = speed[k] if inside else speed[-1] + 1.0 + k
            table[f"table_friction_{k}"] = friction[k] if inside else friction[-1]
        return cls(friction_law="table", **table, **others)


SPEC = spec_beside(__file__, ClutchParams, RULES, exchange=EXCHANGE)
LOAD, SPEED, OIL, DRUM = SPEC.inputs
