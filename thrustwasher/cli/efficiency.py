"""``thrustwasher efficiency``: what a gearbox loses in a gear, by source, over torque and speed."""

import argparse
import time
from typing import Any

from ..errors import ParameterError
from ..sweep.axes import Place, parse_values, split_settings
from ..units import format_quantity
from .common import _options, _output

HELP = "efficiency of a scene's gearbox in a gear, with the loss of every source"
VALUES = "NAME=VALUES, e.g. torque=50:250:50 or speed=1000rpm:4000rpm:n7"
USUAL = {"torque": "25:250:n10", "speed": "1000 rpm:4000 rpm:n7"}
OPTIONS = {
    "--over NAME=VALUES ...": "torque [N m] and speed [rad/s] of the input: torque=50:250:50 "
    "(start:stop:step), speed=1000rpm:4000rpm:n7 (7 values, even), torque=100,200; default "
    "torque=25:250:n10, speed=1000rpm:4000rpm:n7",
    "--gear NAME": "first: the brake holds, second: the clutch holds; default first",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "scene",
        nargs="?",
        default="planetary",
        metavar="SCENE",
        help="a built-in scene or a TOML file; default planetary",
    )
    _options.add(parser, OPTIONS)
    parser.set_defaults(gear="first")
    _options.add_oil(parser)
    _output.add_targets(parser, out="write all points as CSV", plot="draw the map")


def run(arguments: argparse.Namespace) -> int:
    """Solve all points, then print, write or draw."""
    given = split_settings(arguments.over, "--over", VALUES)
    targets = _output.targets(arguments)

    from ..shift import load_scene
    from ..shift.steady_points import COLUMNS, GEARS, RANGES, efficiency_map

    if unknown := [name for name in given if name not in RANGES]:
        raise ParameterError(f"--over {unknown[0]}: allowed: {' and '.join(RANGES)}")
    if arguments.gear not in GEARS:
        raise ParameterError(f"--gear {arguments.gear}: allowed: {' or '.join(GEARS)}")
    places = {
        name: Place(name, True, {"kind": "real", "unit": unit, "min": low, "max": high})
        for name, (unit, low, high) in RANGES.items()
    }
    over = {n: parse_values(given.get(n, USUAL[n]), place) for n, place in places.items()}
    scene = load_scene(arguments.scene, arguments.oil)
    began = time.perf_counter()
    found = efficiency_map(
        scene, **over, gear=arguments.gear, progress=_output.time_left("efficiency:")
    )
    wall_time = time.perf_counter() - began
    _output.warn(found.warnings)
    units = {name: unit for name, (unit, _) in COLUMNS.items()}
    columns = {name: series.tolist() for name, series in found.columns.items()}
    texts = ["; ".join(lines) for lines in found.doubts]
    targets.write({**units, "doubts": ""}, {**columns, "doubts": texts})
    if targets.plot:
        from ..report.model_plots.efficiency_plot import efficiency_figure

        targets.draw(efficiency_figure(found))
    if arguments.json:
        points = [
            {**dict(zip(COLUMNS, row, strict=True)), "doubts": lines}
            for row, lines in zip(_rows(found), found.doubts, strict=True)
        ]
        told: dict[str, Any] = {"scene": scene.name, "gear": found.gear, "points": points}
        told |= {"balance": found.balance, "wall_time": wall_time, "warnings": found.warnings}
        _output.print_json(told)
        return 0
    if not any(targets):
        shown = {n: units[n] for n in ("torque", "speed", "efficiency", "loss", "warnings")}
        _output.print_table(shown, columns, 16)
    for line in _largest(found):
        print(line)
    return 0


def _rows(found: Any) -> Any:
    return zip(*(series.tolist() for series in found.columns.values()), strict=True)


def _largest(found: Any) -> list[str]:
    """Return the losses by source where torque and speed are greatest."""
    from ..shift.steady_points import COLUMNS, SOURCES

    c = found.columns
    i = int((c["torque"] * c["speed"]).argmax())
    at = f"{format_quantity(c['torque'][i], 'N.m')}, {format_quantity(c['speed'][i], 'rad/s')}"
    whole = c["loss"][i]
    lines = [
        f"{found.scene.title}, {found.gear} gear, oil "
        f"{format_quantity(found.scene.oil_temperature, 'K')}; at {at}: "
        f"efficiency {100.0 * c['efficiency'][i]:.2f} %, loss {format_quantity(whole, 'W')}, of it"
    ]
    for name in sorted(SOURCES, key=lambda n: -c[n][i]):
        if c[name][i] != 0.0:
            part = f"{format_quantity(c[name][i], 'W')} ({100.0 * c[name][i] / whole:.1f} %)"
            lines.append(f"  {part:22}  {COLUMNS[name][1]}")
    return [*lines, f"Power in is power out and losses within {found.balance:.1e}."]
