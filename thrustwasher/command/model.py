"""The record of the command source."""

from ..model.record import Model

MODEL = Model(
    key="command",
    name="CommandSource",
    interface="thrustwasher.command.parameters:SPEC",
)
