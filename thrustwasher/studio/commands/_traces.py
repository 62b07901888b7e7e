"""Recordings over time as the calibrate command takes them."""

import argparse
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ...cli.common._table import named_table, tell
from ...errors import ParameterError
from ...units import parse_quantity

if TYPE_CHECKING:
    from ...model.spec import ModelSpec
    from ...storage.tables.heads import Wanted
    from ...storage.tables.table import Table
    from ..calibration.traces.recording import Traces

OPTIONS = {
    "--piston-area AREA": "of recordings with pressure: area that it acts on, e.g. '55 cm2'",
    "--inertia J": "of recordings over time: inertia that the pack stops, as its slip sees it; "
    "slip then follows from the balance of torques",
    "--drag-torque TORQUE": "torque in addition to the pack's that slows the slip, with --inertia",
    "--torque-at PLACE": "where torque was recorded: pack or hub, default pack",
    "--inertia-between J": "inertia between the faces and the hub's sensor",
    "--torque-offset TORQUE": "of recordings: torque that the sensor shows in addition to the true "
    "one; or in --fit torque_offset",
}
SHOWN = 12  # names that a message lists
UNITS = {
    "piston_area": "m2",
    "inertia": "kg.m2",
    "drag_torque": "N.m",
    "inertia_between": "kg.m2",
    "torque_offset": "N.m",
}


def read_tables(
    paths: Sequence[str], names: Sequence[str], wanted: "Wanted"
) -> tuple[list["Table"], bool]:
    """Return the tables of files, and whether they are recordings over time.

    ParameterError if some have a column ``time`` and others not, or if several have none.
    """
    from ...storage.tables.known_columns import time_hint
    from ..calibration.traces.trace_file import is_trace

    tables = [named_table(path, names, wanted) for path in paths]
    over_time = [is_trace(table) for table in tables]
    if any(over_time) and not all(over_time):
        trace, settled = paths[over_time.index(True)], paths[over_time.index(False)]
        raise ParameterError(
            f"{trace} has a column time and {settled} has none: a recording over time and settled "
            "points cannot be fitted together, allowed: one kind; "
            f"{time_hint(tables[over_time.index(False)].columns)}".rstrip("; ")
        )
    if len(tables) > 1 and not any(over_time):
        raise ParameterError(
            f"{paths[0]}, {paths[1]}: have no column time; allowed: one file of settled points, or "
            f"recordings with a column time; {time_hint(tables[0].columns)}".rstrip("; ")
        )
    return tables, all(over_time)


def read_recordings(tables: Sequence["Table"], kind: "Traces") -> dict[str, Any]:
    """Return columns by the files' names, and say what was read and passed over."""
    from ..calibration.traces.trace_file import columns_of, is_trace

    found: dict[str, Any] = {}
    paths = [table.path for table in tables]
    for table in tables:
        if paths.count(table.path) > 1:
            raise ParameterError(f"{table.path}: is given twice, allowed: once")
        needed = kind.needed if is_trace(table) else (("time",), *kind.needed)
        own, passed, remarks = columns_of(table, kind.columns, kind.measured, needed)
        force = kind.needed[0]
        if passed and not any({*force} & {*columns} for columns in own.values()):
            raise ParameterError(
                f"{table.path}: column {' or '.join(force)} is missing; found, but not known: "
                f"{', '.join(passed[:SHOWN])}; say what they hold, with the unit if it is not "
                f'theirs: --column "{force[0]} [N]={passed[0]}"'
            )
        found |= own
        tell(table.path, remarks, passed)
    return found


def rig_options(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return what the command says of the test rig, SI units."""
    found: dict[str, Any] = {}
    for name, unit in UNITS.items():
        text = getattr(arguments, name)
        if text is not None:
            found[name] = parse_quantity(text, unit, name)
    if arguments.torque_at is not None:
        found["torque_at"] = arguments.torque_at
    return found


def refuse_rig(arguments: argparse.Namespace) -> None:
    """Raise ParameterError for an option of recordings next to settled points."""
    for name in (*UNITS, "torque_at"):
        if getattr(arguments, name) is not None:
            option = f"--{name.replace('_', '-')}"
            raise ParameterError(f"{option}: allowed: with recordings, which have a column time")


def may_be_recording(tables: Sequence["Table"]) -> bool:
    """Tell if a column without the name time probably holds it."""
    from ...storage.tables.known_columns import time_like

    return any(time_like(table.columns) for table in tables)


def bounds_of(texts: Mapping[str, str], spec: "ModelSpec") -> dict[str, tuple[float, float]]:
    """Return bounds by parameter of a model, from texts LOW:HIGH."""
    from ...settings import find_place, places

    found, known = {}, places(spec)
    for name, text in texts.items():
        ends = text.split(":")
        if len(ends) != 2:
            raise ParameterError(f"--bounds {name}={text}: allowed: NAME=LOW:HIGH")
        place = find_place(name, known, spec)
        low, high = (float(place.check(end)) for end in ends)
        found[name] = low, high
    return found
