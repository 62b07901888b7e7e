"""The record of the command source."""

from ..model.record import Model
from ..model.spec import ModelSpec


class Command(Model):
    """The source of a shift command."""

    key = "command"

    @property
    def spec(self) -> ModelSpec:
        """What an importer sees."""
        from .parameters import SPEC

        return SPEC


MODEL = Command()
