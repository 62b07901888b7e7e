"""Parameters of a plain journal bearing."""

from dataclasses import dataclass

from thrustwasher.model.parameters import check_ranges, quantity
from thrustwasher.model.toml_tables import spec_beside


@dataclass(frozen=True, slots=True, kw_only=True)
class JournalParams:
    """A shaft in a bush, with oil of one viscosity."""

    radius: float = quantity(25e-3, "m", 1e-3, 1.0, "radius of the shaft")
    width: float = quantity(20e-3, "m", 1e-3, 1.0, "width of the bearing")
    clearance: float = quantity(25e-6, "m", 1e-6, 1e-3, "radial clearance")
    viscosity: float = quantity(0.02, "Pa.s", 1e-4, 10.0, "viscosity of the oil")

    def __post_init__(self) -> None:
        check_ranges(self)


SPEC = spec_beside(__file__, JournalParams)
LOAD, SPEED, OIL = SPEC.inputs
