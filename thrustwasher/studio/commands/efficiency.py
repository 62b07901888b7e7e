"""``thrustwasher efficiency``: what a gearbox loses, by source, over torque and speed."""

import argparse
import time
from collections.abc import Mapping
from typing import Any

from ...cli.common import _options, _output
from ...errors import ParameterError
from ...model.oil import oil
from ...model.quantity import Quantity
from ...numerics.power_flow import FLOWS, FORWARD
from ...settings import split_settings
from ...units import format_quantity
from ..sweep.axes import parse_values
from . import _reducer_report

HELP = "efficiency of a gearbox or gear train, with the loss of each source"
EXAMPLES = (
    "thrustwasher efficiency ev-reducer --plot efficiency.png",
    "thrustwasher efficiency planetary --gear first --over torque=-50:150:50 --out efficiency.csv",
)
VALUES = "NAME=VALUES, e.g. torque=-100:250:50 or speed=1000rpm:4000rpm:n7"
USUAL = {"torque": "25:250:n10", "speed": "1000 rpm:4000 rpm:n13"}
OPTIONS = {
    "--over NAME=VALUES ...": "torque [N m] and speed [rad/s] of the input: torque=50:250:50 "
    "(start:stop:step), speed=1000rpm:4000rpm:n7 (7 values, even), torque=-50,200 (coasting: "
    "against the speed), of a gear train oil_temperature=40degC,80degC too; default "
    "torque=25:250:n10, speed=1000rpm:4000rpm:n13, of a gear train 33 each, up to the ends of its "
    "[box]",
    "--gear NAME": "first: the brake holds, second: the clutch holds; default first",
}
GRID = 33  # torques, and speeds, of a gear train: lines of a map without kinks
LOSS_MAP = ".vtlm"
RPM = 9.549296585513721  # of a rad/s
NEAR = 1.01  # of the smallest margin: as good as that
LEAST = ("pitting_safety", "root_safety", "scuffing_safety", "bearing_life")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    what = "a built-in scene, a gear train (ev-reducer) or a TOML file; default planetary"
    _options.add_subject(parser, "scene", "SCENE", what, "planetary", asked=False)
    _options.add(parser, OPTIONS)
    parser.set_defaults(gear=None)
    parser.add_argument("--report", metavar="FILE", help=_reducer_report.HELP)
    _options.add_oil(parser)
    _output.add_targets(
        parser, out="write all points as CSV, or a loss map of VECTO (.vtlm)", plot="draw the map"
    )


def run(arguments: argparse.Namespace) -> int:
    """Solve all points, then print, write or draw."""
    from ...train.train_file import is_train

    given = split_settings(arguments.over, "--over", VALUES)
    targets = _output.targets(arguments, (".csv", LOSS_MAP))
    report = _reducer_report.target(arguments.report)
    if report and not is_train(arguments.scene):
        raise ParameterError(f"--report {report}: allowed: of a gear train")
    began = time.perf_counter()
    found = (_of_train if is_train(arguments.scene) else _of_scene)(arguments, given)
    wall_time = time.perf_counter() - began
    _output.warn(found.warnings)
    units = {name: words.unit for name, words in found._words().items()}
    columns = {name: series.tolist() for name, series in found.columns.items()}
    texts = ["; ".join(lines) for lines in found.doubts]
    words = {"flow": found.flow, "doubts": texts}
    if targets.out and targets.out.suffix.lower() == LOSS_MAP:
        _output.write_text(targets.out, _loss_map(found.columns))
        _output.note(f"wrote {targets.out}")
    else:
        targets.write({**units, "flow": "", "doubts": ""}, {**columns, **words})
    if targets.plot:
        from ..report.model_plots.efficiency_plot import efficiency_figure

        targets.draw(efficiency_figure(found))
    if report:
        _reducer_report.write(report, found.scene, _worst(found))
    if arguments.json:
        points = [
            {**dict(zip(columns, row, strict=True)), "flow": way, "doubts": lines}
            for row, way, lines in zip(_rows(found), found.flow, found.doubts, strict=True)
        ]
        told: dict[str, Any] = {**_name_of(found), "points": points}
        told |= {"balance": found.balance, "wall_time": wall_time, "warnings": found.warnings}
        _output.print_json(told)
        return 0
    if not any(targets):
        names = ("torque", "speed", "oil_temperature", "efficiency", "loss", "warnings")
        shown = {n: units[n] for n in names if n in units}
        if {*found.flow} != {FORWARD}:
            shown |= {"flow": ""}
        _output.print_table(shown, {**columns, "flow": found.flow}, 20 if "flow" in shown else 16)
    for line in _largest(found):
        print(line)
    return 0


def _loss_map(columns: Mapping[str, Any]) -> str:
    """Return a torque loss map as VECTO reads it: speed, torque and torque loss of the input."""
    import numpy as np

    speed, torque = columns["speed"], columns["torque"]
    if len(np.unique(columns.get("oil_temperature", [0.0]))) > 1:
        raise ParameterError(f"--out FILE{LOSS_MAP}: one oil_temperature is allowed in a loss map")
    if not (speed > 0.0).all() or not np.isfinite(columns["loss"]).all():
        raise ParameterError(
            f"--out FILE{LOSS_MAP}: speeds above 0 rad/s and a loss at every point are required; "
            "narrow --over"
        )
    lost = columns["loss"] / speed
    lines = ["Input Speed [rpm],Input Torque [Nm],Torque Loss [Nm]"]
    for i in np.lexsort((torque, speed)):
        lines.append(f"{RPM * speed[i]:.10g},{torque[i]:.10g},{lost[i]:.10g}")
    return "\n".join([*lines, ""])


def _of_scene(arguments: argparse.Namespace, given: Mapping[str, str]) -> Any:
    from ...shift import load_scene
    from ...shift.steady_points import GEARS, RANGES, efficiency_map

    gear = arguments.gear or "first"
    if gear not in GEARS:
        raise ParameterError(f"--gear {gear}: allowed: {' or '.join(GEARS)}")
    over = _axes(given, RANGES, USUAL)
    scene = load_scene(arguments.scene, arguments.oil)
    return efficiency_map(scene, **over, gear=gear, progress=_output.time_left("efficiency:"))


def _of_train(arguments: argparse.Namespace, given: Mapping[str, str]) -> Any:
    from ...train.train_file import load_train
    from ...train.train_map import RANGES, train_map

    if arguments.gear is not None:
        raise ParameterError(f"--gear {arguments.gear}: a gear train has one gear, that it shows")
    scene = load_train(arguments.scene, arguments.oil and oil(arguments.oil))
    box = scene.part.box
    usual = {n: f"{text.rpartition(':')[0]}:n{GRID}" for n, text in USUAL.items()}
    usual["oil_temperature"] = "80 degC"
    for name in usual.keys() & box.keys() - {"oil_temperature"}:
        usual[name] = f"{box[name][1] / GRID!r}:{box[name][1]!r}:n{GRID}"
    over = _axes(given, RANGES, usual)
    return train_map(scene, **over, progress=_output.time_left("efficiency:"))


def _axes(given: Mapping[str, str], ranges: Any, usual: Mapping[str, str]) -> dict[str, list[Any]]:
    if unknown := [name for name in given if name not in ranges]:
        raise ParameterError(f"--over {unknown[0]}: allowed: {' and '.join(ranges)}")
    places = {
        name: Quantity(name=name, unit=unit, low=low, high=high, is_input=True)
        for name, (unit, low, high) in ranges.items()
    }
    return {n: parse_values(given.get(n, usual[n]), place) for n, place in places.items()}


def _name_of(found: Any) -> dict[str, str]:
    gear = getattr(found, "gear", None)
    return {"scene": found.scene.name, "gear": gear} if gear else {"scene": found.scene.title}


def _rows(found: Any) -> Any:
    return zip(*(series.tolist() for series in found.columns.values()), strict=True)


def _largest(found: Any) -> list[str]:
    """Return the losses by source where torque and speed are highest, and lowest limits."""
    from ...shift.steady_points import SOURCES as OF_SCENE
    from ...train.train_map import SOURCES as OF_TRAIN

    c, words = found.columns, found._words()
    i = int(abs(c["torque"] * c["speed"]).argmax())
    whole, way = c["loss"][i], found.flow[i]
    efficient = f"efficiency {100.0 * c['efficiency'][i]:.2f} %"
    if way != FORWARD:
        efficient = f"{way}, {efficient}" if c["efficiency"][i] > 0.0 else f"{way}: {FLOWS[way]}"
    lines = [
        f"{found.heading}; at {_place(c, i)}: {efficient}, loss "
        f"{format_quantity(whole, 'W')}, of it"
    ]
    sources = [name for name in {**dict.fromkeys(OF_TRAIN), **dict.fromkeys(OF_SCENE)} if name in c]
    for name in sorted(sources, key=lambda n: -c[n][i]):
        if c[name][i] != 0.0:
            part = f"{format_quantity(c[name][i], 'W')} ({100.0 * c[name][i] / whole:.1f} %)"
            lines.append(f"  {part:22}  {words[name].help}")
    if found.scene.__class__.__name__ == "TrainScene":
        lines += _limits(found)
    return [*lines, f"Power in is power out and losses within {found.balance:.1e}."]


def _worst(found: Any) -> list[dict[str, float]]:
    """Return the point of most power, and those where a margin is clearly smaller, each once."""
    import numpy as np

    c = found.columns
    most = int(abs(c["torque"] * c["speed"]).argmax())
    known = [n for n in LEAST if n in c and not np.isnan(c[n]).all()]
    least = {n: int(np.nanargmin(c[n])) for n in known}
    places = [most, *(i for n, i in least.items() if not c[n][most] <= NEAR * c[n][i])]
    names = ("torque", "speed", "oil_temperature")
    return [{n: float(c[n][i]) for n in names} for i in dict.fromkeys(places)]


def _place(c: Mapping[str, Any], i: int) -> str:
    return f"{format_quantity(c['torque'][i], 'N.m')}, {format_quantity(c['speed'][i], 'rad/s')}"


def _limits(found: Any) -> list[str]:
    """Return the minimum of each limit over all points, where it is and of what."""
    import numpy as np

    c, lines = found.columns, []
    for name in LEAST:
        if name not in c or np.isnan(c[name]).all():
            continue
        end = name if name.endswith("_safety") else "life"  # "middle.left.life" too
        i = int(np.nanargmin(c[name]))
        own = [n for n in c if n != name and n.endswith(end)]
        of = next(n for n in own if c[n][i] == c[name][i]).removesuffix(end).rstrip("._")
        value = format_quantity(c[name][i], found._words()[name].unit)
        lines.append(f"  minimum {name} {value}: {of}, at {_place(c, i)}")
    return lines
