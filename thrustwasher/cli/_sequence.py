"""``thrustwasher shift`` with a scene of several shifts: one line per shift, a page of the run."""

import argparse
from pathlib import Path
from typing import Any

from ..errors import ParameterError

REPORT, TABLE = "report.html", "shift.csv"


def check(arguments: argparse.Namespace, scene: Any) -> None:
    """Refuse what a scene of several shifts has no use for."""
    if arguments.ssp:
        raise ParameterError("--ssp: a package has one shift, allowed: a scene without [sequence]")
    if open_ := [name for name, part in scene.parts.items() if part.tolerance]:
        raise ParameterError(f"fidelity of {', '.join(open_)} = auto, allowed with [sequence]: a "
                             "rung by name (--fidelity PART=RUNG)")  # fmt: skip


def say(result: Any) -> None:
    """Print a line per shift."""
    oil = result.oil_temperature - 273.15
    print(f"{result.scene.title}: {len(result.shifts)} shifts, oil {oil[0]:.1f} .. {oil[-1]:.1f} "
          "degC")  # fmt: skip
    for shift, (start, way) in zip(result.shifts, result.scene.sequence.shifts, strict=True):
        figures = shift.figures
        lock, heat = figures["lock_time"], figures["slip_energy"] or 0.0
        locked = "does not lock" if lock is None else f"locks after {lock - start:.3f} s"
        print(f"  {start:8.1f} s  {way:4}  {locked}, {1e-3 * heat:.2f} kJ")
    for text in result.messages:
        print(text)


def write(result: Any, folder: Path) -> None:
    """Write page, plot and time series into a folder that is still a draft."""
    from ..report.html import render, save_plots
    from ..report.shift.sequence_report import sequence_page

    page = sequence_page(result)
    (folder / REPORT).write_text(render(page), encoding="utf-8")
    save_plots(page, folder)
    result.write_csv(folder / TABLE)
