"""The record of the oil sump."""

from ..model.record import Model
from ..model.spec import ModelSpec


class Sump(Model):
    """The oil sump."""

    key = "sump"
    wiring = (
        "Feed each part's oil_heat to one of heat_1 .. heat_7; factor_i says how many such parts "
        "there are. Feed temperature back as their oil_temperature.",
        "Or feed its oil_energy to energy_i: no heat is lost or counted twice whatever the steps, "
        "also where values arrive a step late. Heat under both heat_i and energy_i is refused.",
        "Heat is held over a step: the temperature errs by less than the heat of one step would "
        "warm the sump (0.05 K for 1 kJ).",
    )

    @property
    def spec(self) -> ModelSpec:
        """What an importer sees."""
        from .parameters import SPEC

        return SPEC


MODEL = Sump()
