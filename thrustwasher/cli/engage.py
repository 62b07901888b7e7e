"""``thrustwasher engage``: a wet pack closes under a rising force while its slip runs out."""

from __future__ import annotations

import argparse
import csv
import time
from pathlib import Path
from typing import Any

from ..models._params import check_number
from ..models.clutch_params import SPEC
from ..units import format_quantity, parse_quantity
from . import _options, _output

HELP = "engage a wet pack: torque, film and interface temperature over time"
COLUMNS = {
    "time": "s", "load": "N", "speed": "rad/s", "friction_torque": "N.m", "contact_torque": "N.m",
    "viscous_torque": "N.m", "torque_capacity": "N.m", "temperature": "K", "film_thickness": "m",
    "film_ratio": "1", "friction_coefficient": "1", "contact_share": "1", "friction_power": "W",
    "heat_flux": "W/m2", "energy": "J", "regime": "",
}  # fmt: skip
TABLE = ("time", "load", "speed", "friction_torque", "viscous_torque", "temperature", "film_ratio")
LINES = 16
LONGEST = 3600.0  # s
MAX_POINTS = 200_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    _options.add_inputs(parser, SPEC)
    parser.add_argument(
        "--duration", default="0.5 s", help="time from the start to zero slip [s], default 0.5 s"
    )
    parser.add_argument(
        "--ramp",
        default="0.1 s",
        help="time in which the load rises to its value [s], default 0.1 s",
    )
    parser.add_argument("--step", default="1 ms", help="distance of the points [s], default 1 ms")
    _options.add_parameters(parser, SPEC)
    _options.add_fidelity(parser, SPEC)
    parser.add_argument("--out", metavar="FILE", help="write all points as CSV")
    parser.add_argument("--plot", metavar="FILE", help="draw the engagement")
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")


def run(arguments: argparse.Namespace) -> int:
    """Engage, then print, write or draw."""
    if arguments.parameters:
        print(_options.parameter_table(SPEC))
        return 0
    point = _options.read_inputs(arguments, SPEC)
    params = _options.read_parameters(arguments, SPEC)
    times = {n: _seconds(n, getattr(arguments, n)) for n in ("duration", "ramp", "step")}
    out = arguments.out and _output.check_file(arguments.out, "--out", (".csv",))
    plot = arguments.plot and _output.check_file(arguments.plot, "--plot", _output.PLOT_SUFFIXES)

    began = time.perf_counter()
    result = _engage(params, point, times, arguments.fidelity)
    wall_time = time.perf_counter() - began
    if out:
        with _output.whole_file(out) as draft:
            _write_csv(draft, result)
        _output.note(f"wrote {out}")
    if plot:
        from ..report.clutch_plot import engagement_figure

        with _output.whole_file(plot) as draft:
            engagement_figure(result).savefig(draft)
        _output.note(f"wrote {plot}")
    if arguments.json:
        inputs = {**times, "oil_temperature": point["oil_temperature"]}
        given = {"parameters": _output.parameters_of(params)}
        _output.print_json({**result.as_dict(), **inputs, **given, "wall_time": wall_time})
    elif not out and not plot:
        _print_table(result)
    if not arguments.json:
        _print_summary(result)
    return 0


def _seconds(name: str, text: str) -> float:
    """Return a time [s]; the ramp may be zero, the others not."""
    low = 0.0 if name == "ramp" else 1e-6
    return check_number(name, parse_quantity(text, "s", name), "s", low, LONGEST)


def _engage(params: Any, point: dict[str, float], times: dict[str, float], rung: str) -> Any:
    """Return the engagement: load up in a straight ramp, slip down to zero at the end."""
    import numpy as np

    from ..errors import ParameterError
    from ..models.clutch_engagement import engage_clutch

    n = round(times["duration"] / times["step"])
    if not 1 <= n <= MAX_POINTS:
        raise ParameterError(
            f"step = {times['step']!r} s, allowed: duration/{MAX_POINTS} .. duration "
            f"({times['duration']!r} s)"
        )
    t = np.linspace(0.0, times["duration"], n + 1)
    rise = np.minimum(t / times["ramp"], 1.0) if times["ramp"] > 0.0 else np.ones_like(t)
    return engage_clutch(
        params, time=t, load=point["load"] * rise, fidelity=rung,
        speed=point["speed"] * (1.0 - t / times["duration"]),
        oil_temperature=point["oil_temperature"],
    )  # fmt: skip


def _write_csv(path: Path, result: Any) -> None:
    """Write one line per point; the unit stands in the head of each column."""
    with path.open("w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream)
        table.writerow(f"{name} [{unit}]" if unit else name for name, unit in COLUMNS.items())
        columns = [getattr(result, name) for name in COLUMNS]
        for row in zip(*columns, strict=True):
            table.writerow(v if isinstance(v, str) else repr(float(v)) for v in row)


def _print_table(result: Any) -> None:
    """Print some points, evenly spread."""
    print("".join(f"{name:>18}" for name in (*TABLE, "regime")))
    last = len(result.time) - 1
    for i in sorted({round(last * k / (LINES - 1)) for k in range(LINES)}):
        cells = [_output.shown(float(getattr(result, n)[i]), COLUMNS[n]) for n in TABLE]
        print("".join(f"{cell:>18}" for cell in (*cells, result.regime[i])))


def _print_summary(result: Any) -> None:
    """Say the largest torque and temperature, the heat, and when the asperities carry."""
    top = int(abs(result.friction_torque).argmax())
    hot = int(result.temperature.argmax())
    words = [
        f"largest torque {format_quantity(float(result.friction_torque[top]), 'N.m')} at "
        f"{format_quantity(float(result.time[top]), 's')}",
        f"hottest {format_quantity(float(result.temperature[hot]), 'K')} at "
        f"{format_quantity(float(result.time[hot]), 's')}",
        f"heat {format_quantity(float(result.energy[-1]), 'J')}",
    ]
    thin = (result.film_ratio < 1.0).nonzero()[0]
    words.append(
        f"boundary lubrication from {format_quantity(float(result.time[thin[0]]), 's')}"
        if len(thin)
        else "boundary lubrication was not reached"
    )
    print("; ".join(words))
    print(f"  {result.status.advice}; {result.fidelity}, {result.substeps} substeps")
