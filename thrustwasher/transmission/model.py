"""The record of the planetary set between engine and vehicle."""

from ..model.record import Model
from ..model.spec import ModelSpec


class Transmission(Model):
    """The planetary set with engine, vehicle, clutch and brake."""

    key = "transmission"
    wiring = (
        "coupling = capacity (default): feed the packs' torque_capacity. Lock-up and break-away "
        "are located inside the step; no step limit comes from friction.",
        "coupling = torque: feed the packs' friction_torque. With 389 N.m over 0.1 rad/s and the "
        "0.1157 kg.m2 of the default set, steps above 0.06 ms are unstable when torques are one "
        "step old; prefer capacity.",
        "torque_age says how many steps old the torques are: 0 if the packs step first "
        "(Gauss-Seidel), 1 if all step at once (Jacobi).",
        "Give shift_command its value at the end of the step.",
    )

    @property
    def spec(self) -> ModelSpec:
        """What an importer sees."""
        from .parameters import SPEC

        return SPEC


MODEL = Transmission()
