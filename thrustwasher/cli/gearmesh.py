"""``thrustwasher gearmesh``: a pair of spur gears at the start of contact."""

from __future__ import annotations

import argparse
import dataclasses
import time
from typing import Any

from ..errors import ParameterError
from ..models.gearmesh_params import PRESETS, SPEC, GearMeshParams
from ..units import format_quantity, parse_quantity
from . import _fidelity, _options, _output

HELP = "temperatures, stresses and loss of a gear mesh at one power and speed"
POWER = 7500.0  # W
FEWEST_TEETH, MOST_TEETH = 5, 60
# Result fields that are no FMU output: unit and meaning.
EXTRA = {
    "asperity_temperature": ("K", "temperature of the asperities of the flank"),
    "contact_ratio": ("1", "mean number of tooth pairs in contact"),
    "start_of_contact": ("1", "x_s: start of contact along the line of action, 0 interferes"),
    "sliding_speed": ("m/s", "sliding speed at the start of contact"),
    "slide_roll_ratio": ("1", "sliding over mean rolling speed there"),
    "hertz_width": ("m", "full width of the line contact"),
    "hertz_pressure": ("Pa", "peak pressure of the line contact"),
    "viscosity": ("Pa.s", "viscosity of the oil that is sheared"),
    "area_ratio": ("1", "nominal over real area of contact that flash heat enters"),
}
STEELS = {"AISI 1020": "aisi1020", "AISI 4340": "aisi4340"}
PER_STEEL = {
    "modification_factor": "K",
    "allowable_ratio": "allowable ratio",
    "stress_utilization": "of endurance limit",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    point = _options.add_inputs(parser, SPEC, without="load")
    point.add_argument(
        "--power", metavar="QUANTITY", default=POWER,
        help=f"transmitted power, of which the size counts [W]; -1e9 .. 1e9 W, default {POWER:g}",
    )  # fmt: skip
    _options.add_parameters(parser, SPEC)
    parser.add_argument(
        "--preset", choices=list(PRESETS), default="bounded",
        help=f"what --set starts from; {_presets()}; default bounded",
    )  # fmt: skip
    _fidelity.add_fidelity(parser, SPEC)
    parser.add_argument(
        "--plot", metavar="FILE", help="draw temperatures and factors over the pinion's teeth"
    )
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")


def run(arguments: argparse.Namespace) -> int:
    """Solve, then print or draw."""
    if arguments.parameters:
        print(_options.parameter_table(SPEC))
        return 0
    power = parse_quantity(arguments.power, "W", "power")
    point = {"power": power, **_options.read_inputs(arguments, SPEC)}
    settings = _options.read_settings(arguments, SPEC)
    params = GearMeshParams.preset(arguments.preset, **settings)
    plot = arguments.plot and _output.check_file(arguments.plot, "--plot", _output.PLOT_SUFFIXES)

    from ..models.gearmesh import pinion_torque, solve_gearmesh

    place = {n: v for n, v in point.items() if n != "power"}
    place["load"] = pinion_torque(power, point["speed"])
    fidelity = _fidelity.rung(arguments.fidelity, SPEC, params, place)
    began = time.perf_counter()
    result = solve_gearmesh(params, **point, fidelity=fidelity)
    wall_time = time.perf_counter() - began
    if plot:
        from ..report.gearmesh_plot import gearmesh_figure

        teeth, sweeps = sweep(params, point, fidelity)
        with _output.whole_file(plot) as draft:
            gearmesh_figure(teeth, sweeps, result, params.pinion_teeth, point).savefig(draft)
        _output.note(f"wrote {plot}")
    if arguments.json:
        inputs = {**point, "preset": arguments.preset, "parameters": _output.parameters_of(params)}
        _output.print_json({**_output.scalars(result), **inputs, "wall_time": wall_time})
        return 0
    units = {"power": "W", **{s.name: s.unit for s in SPEC.inputs}}
    where = ", ".join(f"{n} {_output.shown(value, units[n])}" for n, value in point.items())
    print(f"gear mesh, {params.pinion_teeth} teeth, ratio {params.gear_ratio:g}, at {where}")
    _output.print_rows(_rows(result))
    _print_steels(result, params)
    print(f"  {result.status.advice}; {result.iterations} iterations, {result.fidelity}, "
          f"{wall_time:.3g} s")  # fmt: skip
    return 0


def sweep(
    params: GearMeshParams, point: dict[str, Any], fidelity: str
) -> tuple[list[int], dict[str, list[Any]]]:
    """Return tooth numbers and the results of each surface there, None where refused.

    "rough" and "fine" have the roughness of these surfaces; where the parameters name their own,
    "given" has that.
    """
    from ..models.gearmesh import solve_gearmesh

    def solved(teeth: int, changes: dict[str, Any]) -> Any:
        try:
            changed = dataclasses.replace(params, pinion_teeth=teeth, **changes)
            return solve_gearmesh(changed, **point, fidelity=fidelity)
        except ParameterError:
            return None

    own = ("sigma_rms", "effective_roughness", "mean_roughness")
    plain = dict.fromkeys(own, 0.0)
    surfaces = {name: {**plain, "surface": name} for name in ("rough", "fine")}
    if any(getattr(params, name) for name in own):
        surfaces["given"] = {}
    every = range(FEWEST_TEETH, max(MOST_TEETH, params.pinion_teeth) + 1)
    sweeps = {name: [solved(n, surface) for n in every] for name, surface in surfaces.items()}
    kept = [i for i in range(len(every)) if any(row[i] is not None for row in sweeps.values())]
    return [every[i] for i in kept], {n: [row[i] for i in kept] for n, row in sweeps.items()}


def _presets() -> str:
    """Say what each preset changes."""
    words = []
    for name, changes in PRESETS.items():
        settings = ", ".join(f"{key} = {value}" for key, value in changes.items())
        words.append(f"{name}: {settings or 'the defaults'}")
    return "; ".join(words)


def _rows(result: Any) -> list[tuple[str, str, str]]:
    """Return name, value, meaning of every field but those of one steel."""
    outputs = {s.name: (s.unit, s.help, s.relative) for s in SPEC.outputs}
    known = {name: (*words, False) for name, words in EXTRA.items()} | outputs
    rows = []
    for name in _output.scalars(result):
        per_steel = any(name == field or name.startswith(f"{field}_aisi") for field in PER_STEEL)
        if name in known and not per_steel:
            unit, words, difference = known[name]
            value = getattr(result, name)
            text = _output.shown(value, unit)
            if difference:
                text = format_quantity(value, unit, difference=True, digits=5)
            rows.append((name, text, words))
    return rows


def _print_steels(result: Any, params: GearMeshParams) -> None:
    """Print what thermal stress leaves of both steels' endurance limits."""
    heads = list(PER_STEEL.values())
    print("  " + "steel".ljust(22) + "".join(head.rjust(len(head) + 3) for head in heads))
    for words, suffix in STEELS.items():
        values = (getattr(result, f"{field}_{suffix}") for field in PER_STEEL)
        cells = (_output.shown(v, "1").rjust(len(h) + 3)
                 for v, h in zip(values, heads, strict=True))  # fmt: skip
        chosen = "  (these gears)" if params.steel == words.replace(" ", "") else ""
        print("  " + words.ljust(22) + "".join(cells) + chosen)
