"""``thrustwasher engage``: a wet pack closes under a rising force while its slip runs out."""

import argparse
import time
from typing import Any

from ..clutch.parameters import SPEC
from ..model.parameters import check_number
from ..plugins import called
from ..units import format_quantity, parse_quantity
from .common import _options, _output

HELP = "engagement of a wet pack: torque, film and temperature over time"
EXAMPLES = (
    "thrustwasher engage --load 4000 --speed 100 --plot engagement.png",
    'thrustwasher engage --load 4000 --speed "955 rpm" --duration "0.5 s" --out engagement.csv',
)
COLUMNS = _output.columns(
    SPEC,
    (
        *("time", "load", "speed", "friction_torque", "contact_torque", "viscous_torque"),
        *("torque_capacity", "temperature", "film_thickness", "film_ratio"),
        *("friction_coefficient", "contact_share", "friction_power", "heat_flux", "energy"),
        *("oil_heat", "stored_heat", "regime"),
    ),
    time="s",
    regime="",
)
TABLE = (
    *("time", "load", "speed", "friction_torque", "viscous_torque", "temperature", "film_ratio"),
    "regime",
)
WIDTH = 18
TIMES = ("duration", "ramp", "step")
LONGEST = 3600.0  # s
MAX_POINTS = 200_000
OPTIONS = {
    "--duration TIME": "time from the start to zero slip [s], default 0.5 s",
    "--ramp TIME": "time in which the load rises to its value [s], default 0.1 s",
    "--step TIME": "distance of the points [s], default 1 ms",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    _options.add_inputs(parser, SPEC.inputs)
    _options.add(parser, OPTIONS)
    parser.set_defaults(duration="0.5 s", ramp="0.1 s", step="1 ms")
    _options.add_parameters(parser, SPEC)
    _options.add_fidelity(parser, SPEC)
    _output.add_targets(parser, out="write all points as CSV", plot="draw the engagement")


def run(arguments: argparse.Namespace) -> int:
    """Engage, then print, write or draw."""
    at = _options.read_point(arguments, SPEC, SPEC.inputs)
    point = at.there.values
    times = {name: _seconds(name, getattr(arguments, name)) for name in TIMES}
    targets = _output.targets(arguments)

    began = time.perf_counter()
    result = _engage(at.part.params, point, times, arguments.fidelity or at.part.fidelity)
    wall_time = time.perf_counter() - began
    warnings = at.warn(
        [*_short(times, point["load"]), *at.part.over_limits(result), *result.warnings]
    )
    series = {name: getattr(result, name) for name in COLUMNS}
    targets.write(COLUMNS, series)
    if targets.plot:
        targets.draw(called("engagement_figure")(result))
    if arguments.json:
        inputs = {**times, **{n: point[n] for n in ("oil_temperature", "drum_speed")}}
        _output.print_json({**result.to_dict(), **inputs, **at.record(warnings, wall_time)})
        return 0
    if at.there.taken:
        print(at.there.taken)
    if not any(targets):
        _output.print_table({name: COLUMNS[name] for name in TABLE}, series, WIDTH)
    _print_summary(result)
    return 0


def _short(times: dict[str, float], load: float) -> list[str]:
    """Return a warning of a load that does not come to its value."""
    ramp, duration = times["ramp"], times["duration"]
    if ramp <= duration:
        return []
    ends = format_quantity(load * duration / ramp, "N")
    return [
        f"ramp = {ramp:g} s is longer than duration = {duration:g} s: the load ends at {ends} of "
        f"{format_quantity(load, 'N')}; give a shorter ramp or a longer duration"
    ]


def _seconds(name: str, text: str) -> float:
    """Return a time [s]; the ramp may be zero, the others not."""
    low = 0.0 if name == "ramp" else 1e-6
    return check_number(name, parse_quantity(text, "s", name), "s", low, LONGEST)


def _engage(params: Any, point: dict[str, float], times: dict[str, float], level: str) -> Any:
    """Return the engagement: load up in a straight ramp, slip down to zero at the end."""
    import numpy as np

    from ..clutch.engagement import engage_clutch
    from ..errors import ParameterError

    n = round(times["duration"] / times["step"])
    if not 1 <= n <= MAX_POINTS:
        raise ParameterError(
            f"step = {times['step']!r} s, allowed: duration/{MAX_POINTS} .. duration "
            f"({times['duration']!r} s)"
        )
    times["step"] = times["duration"] / n  # the one that is used
    t = np.linspace(0.0, times["duration"], n + 1)
    if times["ramp"] < times["duration"]:  # a point where the ramp ends, or it would end later
        near = np.abs(t - times["ramp"]) < 1e-9 * times["duration"]
        t = t if near.any() else np.sort(np.append(t, times["ramp"]))
    rise = np.minimum(t / times["ramp"], 1.0) if times["ramp"] > 0.0 else np.ones_like(t)
    return engage_clutch(
        params,
        time=t,
        load=point["load"] * rise,
        fidelity=level,
        speed=point["speed"] * (1.0 - t / times["duration"]),
        oil_temperature=point["oil_temperature"],
        drum_speed=point["drum_speed"],
    )


def _print_summary(result: Any) -> None:
    """Say the largest torque and temperature, the heat, and when the asperities carry."""
    import numpy as np

    def at(name: str, index: object) -> str:
        return _output.text_of(float(getattr(result, name)[index]), COLUMNS[name], digits=4)

    top, hot = abs(result.friction_torque).argmax(), result.temperature.argmax()
    thin = (result.film_ratio < 1.0).nonzero()[0]
    begin = f"from {at('time', thin[0])}" if len(thin) else "was not reached"
    print(
        f"largest torque {at('friction_torque', top)} at {at('time', top)}; hottest "
        f"{at('temperature', hot)} at {at('time', hot)}; heat {at('energy', -1)}; "
        f"boundary lubrication {begin}"
    )
    step = format_quantity(float(np.diff(result.time).max()), "s")
    words = f"{result.fidelity}, points every {step}, {result.substeps} substeps"
    print(f"  {_output.status_words(result.status)}; {words}")
