"""Units as FMI wants them: exponents of the base units, display units, declared types."""

from dataclasses import dataclass
from math import pi

from ..units import exponents
from .interface import Variable

__all__ = ["DISPLAY", "TYPES", "RealType", "declared_type", "display_unit", "exponents"]

# unit -> display units: (name, factor, offset); display value = factor x value + offset
DISPLAY: dict[str, tuple[tuple[str, float, float], ...]] = {
    "K": (("degC", 1.0, -273.15),),
    "rad/s": (("rpm", 30.0 / pi, 0.0),),
    "rad": (("deg", 180.0 / pi, 0.0), ("mrad", 1e3, 0.0)),
    "m": (("mm", 1e3, 0.0), ("um", 1e6, 0.0)),
    "N": (("kN", 1e-3, 0.0),),
    "W": (("kW", 1e-3, 0.0),),
    "J": (("kJ", 1e-3, 0.0),),
    "Pa": (("MPa", 1e-6, 0.0), ("GPa", 1e-9, 0.0)),
    "Pa.s": (("mPa.s", 1e3, 0.0),),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class RealType:
    """A declared type: what a number means, whatever variable has it."""

    name: str
    quantity: str
    unit: str
    display: str | None = None
    low: float | None = None
    nominal: float = 1.0
    relative: bool = False


TYPES = (
    RealType(name="Temperature", quantity="ThermodynamicTemperature", unit="K", display="degC",
             low=0.0, nominal=300.0),
    RealType(name="TemperatureDifference", quantity="TemperatureDifference", unit="K",
             nominal=10.0, relative=True),
    RealType(name="AngularVelocity", quantity="AngularVelocity", unit="rad/s", display="rpm",
             nominal=100.0),
    RealType(name="Angle", quantity="Angle", unit="rad", display="mrad", nominal=1e-3),
    RealType(name="Torque", quantity="Torque", unit="N.m", nominal=10.0),
    RealType(name="Force", quantity="Force", unit="N", nominal=1e3),
    RealType(name="Length", quantity="Length", unit="m", nominal=0.01),
    RealType(name="Pressure", quantity="Pressure", unit="Pa", display="MPa", nominal=1e6),
    RealType(name="Power", quantity="Power", unit="W", nominal=100.0),
    RealType(name="Energy", quantity="Energy", unit="J", display="kJ", nominal=1e3),
    RealType(name="Viscosity", quantity="DynamicViscosity", unit="Pa.s", display="mPa.s",
             nominal=0.01),
    RealType(name="Fraction", quantity="Dimensionless", unit="1"),
)  # fmt: skip


def declared_type(v: Variable) -> RealType | None:
    """Return the declared type of a real variable, if its unit has one."""
    fitting = (t for t in TYPES if t.unit == v.unit and t.relative == v.relative)
    return next(fitting, None)


def display_unit(v: Variable) -> str | None:
    """Return the unit people say: films in um, geometry in mm, elastic moduli in GPa."""
    declared = declared_type(v)
    size = v.nominal or 0.0
    if v.unit == "m" and size:
        return "um" if size < 1e-4 else "mm"
    if v.unit == "Pa" and size >= 1e9:
        return "GPa"
    return declared.display if declared else None
