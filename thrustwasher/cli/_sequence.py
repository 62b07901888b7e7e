"""``thrustwasher shift`` with a scene of several shifts: one line per shift, a plot of the oil."""

import argparse
import sys
import time
from pathlib import Path
from typing import Any

from ..errors import ParameterError
from . import _output
from .build import chosen_target

PLOT, TABLE = "sequence.png", "shift.csv"


def run(arguments: argparse.Namespace, scene: Any, fmu_instances: Any) -> int:
    """Run all shifts with instances made as for a shift, write plot and time series."""
    from ..shift import run_sequence

    if arguments.ssp:
        raise ParameterError("--ssp: a package has one shift, allowed: a scene without [sequence]")
    if open_ := [name for name, part in scene.parts.items() if part.tolerance]:
        raise ParameterError(f"fidelity of {', '.join(open_)} = auto, allowed with [sequence]: a "
                             "rung by name (--fidelity PART=RUNG)")  # fmt: skip
    folder = None if arguments.no_report else _output.check_folder(arguments.out, "--out")
    progress = _output.time_left(scene.name) if sys.stderr.isatty() else None
    began = time.perf_counter()
    with fmu_instances(scene, chosen_target(arguments.fmu)) as make:
        instances = {name: make(name, part) for name, part in scene.parts.items()}
        result = run_sequence(scene, instances, progress=progress)
    if folder:
        with _output.whole_folder(folder) as draft:
            _write(result, draft)
    total, out = time.perf_counter() - began, str(folder) if folder else None
    if arguments.json:
        _output.print_json({**result.as_dict(), "total_time": total, "out": out})
    else:
        _say(result)
    return 0


def _say(result: Any) -> None:
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


def _write(result: Any, folder: Path) -> None:
    from ..report.html import picture
    from ..report.panels.sequence_plot import sequence_figure

    (folder / PLOT).write_bytes(picture(sequence_figure(result), dpi=110))
    result.write_csv(folder / TABLE)
