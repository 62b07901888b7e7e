"""The record of the gear train."""

import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from ..model.record import Command, Model, Sweep
from ..model.spec import ModelSpec


class GearTrain(Model):
    """A gearbox of gear pairs on parallel shafts."""

    key = "train"
    scene_of = "a gear train"
    wiring = (
        "Subtract loss_torque from the torque of the input shaft: the rest goes through.",
        "Or drive the output with output_torque; its inertia, over the ratio squared, belongs to "
        "the host: nothing accelerates in here.",
        "Feed oil_heat or oil_energy to an OilSump, and its temperature back as oil_temperature.",
    )
    command = Command(
        help="losses, forces and limits of a gear train at one point",
        examples=(
            'thrustwasher train --torque "150 N.m" --speed "6000 rpm"',
            'thrustwasher train --torque "-80 N.m" --speed "9000 rpm" --oil "ISO VG '
            '100" --plot train.png',
        ),
        title="gear train, {meshes} meshes",
        closing="{flow}; {fidelity}",
        plot="draw losses by source, and over torque of either sign",
        report="write a report of a few pages as HTML: loss map, losses, safeties, lives",
        report_by="write_reducer_report",
        extra={"flow": ("1", "which way power runs, or why there is no efficiency")},
    )

    @property
    def spec(self) -> ModelSpec:
        """What an importer sees."""
        from .parameters import SPEC

        return SPEC

    @property
    def solve(self) -> Callable[..., Any]:
        """What solves it at a point."""
        from .solve import solve_train

        return solve_train

    @property
    def sweep(self) -> Sweep:
        """What a sweep of it does otherwise."""
        from .train_signals import SAFETIES

        least = {f"{name}_safety": (1.0, f"below 1: {text}") for name, text in SAFETIES.items()}
        return Sweep(not_shown=("oil_energy",), least=least)

    def doubts(self, params: Any, inputs: Mapping[str, float]) -> Iterable[str]:
        """Return what must not be missed at a point."""
        from .solve import doubts_of_point

        return doubts_of_point(params, inputs)

    def own_names(self, source: str | None) -> Callable[[str], str]:
        """Return what gives names and texts the file's names of shafts and meshes."""
        from .train_file import load_train

        scene = None if source is None else load_train(source)

        def named(text: str) -> str:
            there = re.sub(r" \(-1: no such \w+\)$", "", text)  # what is shown is there
            return there if scene is None else scene.part.own_text(there)

        return named

    def flat(self, where: str, table: dict[str, Any], folder: Path | None) -> dict[str, Any]:
        """Return the table of a part file of a scene ``[train]``."""
        from .train_file import flat_part

        return flat_part(where, table, folder)

    def nested(self, part: Any) -> Iterable[str]:
        """Return the lines of the file of a train, but its box and scatter."""
        from .train_text import train_lines

        return train_lines(part)


MODEL = GearTrain()
