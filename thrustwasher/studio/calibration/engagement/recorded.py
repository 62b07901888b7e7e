"""Recordings of a pack as they are given, with every input that it is stepped by."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from os import PathLike
from typing import Any

import numpy as np

from ....clutch.parameters import DRUM, LOAD, OIL, SPEED
from ....errors import ParameterError
from ....model.part_file import PartFile
from ....storage.tables.given import columns_given, is_table
from ....storage.tables.table import Columns
from ....units import format_quantity
from ..measured import SLIDING, with_speed
from ..traces.recording import Recording, recording
from .traced_pack import TracedPack

COLUMNS = {
    "time": "s",
    "load": "N",
    "pressure": "Pa",
    "speed": "rad/s",
    "sliding_speed": "m/s",
    "oil_temperature": "K",
    "drum_speed": "rad/s",
    "friction_torque": "N.m",
    "temperature": "K",
}
MEASURED = ("friction_torque", "temperature")
NEEDED = (("load", "pressure"), ("speed", SLIDING), MEASURED)
SIGNALS = {"load": LOAD, "speed": SPEED, "oil_temperature": OIL, "drum_speed": DRUM}
UNDER_ZERO = 0.02  # of the largest load: a reading this far below 0 is an offset


def read_recordings(
    recordings: Any, rig: TracedPack
) -> tuple[list[Recording], list[str], dict[str, str]]:
    """Return the recordings, files read, with ``load`` for ``pressure``.

    Second: what was not plain. Third: units of columns as the first file with one has them.
    """
    found, said, written = [], [], dict[str, str]()
    for name, given in _named(recordings):
        of_file: dict[str, Any] = {name: given}
        if not isinstance(given, Mapping):
            from ..traces.trace_file import read_trace

            if isinstance(given, str | PathLike):
                of_file, _, remarks = read_trace(given, COLUMNS, MEASURED, NEEDED)
            else:
                own_columns = columns_given(given, COLUMNS, MEASURED)
                of_file, remarks = {name: own_columns}, list(own_columns.remarks)
            said += [f"{name}: read with {', '.join(remarks)}."] if remarks else []
        for own, columns in of_file.items():
            written = {**(columns.units if isinstance(columns, Columns) else {}), **written}
            slip = with_speed(columns, rig.friction_radius, own)
            found.append(_with_load(recording(own, slip, COLUMNS, MEASURED), rig))
    if not found:
        raise ParameterError("recordings: none, allowed: one or more")
    return found, said, written


def _named(recordings: Any) -> Iterator[tuple[str, Any]]:
    """Yield the name of each recording, and its columns or the path of its file."""
    if isinstance(recordings, Mapping):
        if recordings and all(isinstance(x, Mapping) or is_table(x) for x in recordings.values()):
            yield from recordings.items()
            return
        recordings = [recordings]
    elif is_table(recordings):
        recordings = [recordings]
    if not isinstance(recordings, Iterable):
        raise ParameterError(
            f"recordings: {type(recordings).__name__}, allowed: columns by name, or several of them"
        )
    for k, given in enumerate(recordings):
        name = str(given) if isinstance(given, str | PathLike) else f"recording {k + 1}"
        if not isinstance(given, Mapping) and not is_table(given):
            raise ParameterError(
                f"{name}: {type(given).__name__}, allowed: columns by their names, or a file"
            )
        yield name, given


def _with_load(whole: Recording, rig: TracedPack) -> Recording:
    """Return a recording with the force that its pressure makes.

    Around 0 it scatters to both sides: cut at 0 it would have a mean above, and too little scatter.
    """
    inputs = dict(whole.inputs)
    if ("load" in inputs) == ("pressure" in inputs):
        raise ParameterError(f"{whole.name}: allowed: a column load [N] or pressure [Pa], one")
    if "pressure" in inputs:
        if not rig.piston_area:
            raise ParameterError(
                f"{whole.name}: has pressure, which needs piston_area [m2] (--piston-area)"
            )
        inputs["load"] = inputs.pop("pressure") * rig.piston_area
    load = inputs["load"]
    largest = float(load.max())
    if largest <= 0.0:
        raise ParameterError(f"{whole.name}: load is never above 0 N, nothing is engaged")
    low = load < -UNDER_ZERO * largest
    if low.any():
        row = int(np.argmax(low))
        raise ParameterError(
            f"{whole.name}: load of row {row + 1} is {format_quantity(float(load[row]), 'N')}, "
            f"allowed: not below 0 (but for an offset of {100 * UNDER_ZERO:g} % of the largest)"
        )
    return replace(whole, inputs=inputs)


def completed(
    whole: Recording, part: PartFile, rig: TracedPack, held: Mapping[str, float]
) -> Recording:
    """Return a recording with every input in its range, those held or by default as columns."""
    inputs, outputs = dict(whole.inputs), dict(whole.outputs)
    for name, value in held.items():
        if name in inputs:
            raise ParameterError(
                f"{name}: is a column of {whole.name} and held, allowed: one of both"
            )
        inputs[name] = np.full(len(whole.time), value)
    if "speed" not in inputs:
        raise ParameterError(
            f"{whole.name}: has no column speed (slip); with inertia the slip before the "
            "engagement is enough (--set speed=VALUE)"
        )
    if rig.inertia and "speed" in whole.inputs:
        outputs["slip"] = inputs["speed"]
    if not outputs:
        raise ParameterError(
            f"{whole.name}: nothing is measured, allowed: {', '.join(MEASURED)}, with inertia speed"
        )
    for name, signal in SIGNALS.items():
        if name not in inputs:
            inputs[name] = np.full(len(whole.time), part.starts[name])
        low, high = signal.range
        low -= UNDER_ZERO * float(inputs[name].max()) if name == "load" else 0.0
        bad = (inputs[name] < low) | (inputs[name] > high)
        if bad.any():
            row = int(np.argmax(bad))
            raise ParameterError(
                f"{whole.name}: {name} of row {row + 1} is {inputs[name][row]:.6g} {signal.unit}, "
                f"allowed: {low:g} .. {high:g} {signal.unit}"
            )
    return replace(whole, inputs=inputs, outputs=outputs)
