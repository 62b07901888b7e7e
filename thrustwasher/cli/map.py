"""``thrustwasher map``: build a washer's map, list the maps there are, check one."""

import argparse
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from ..errors import ParameterError
from ..model.advice import range_text
from ..model.part_file import is_part
from ..units import parse_quantity
from ..washer.parameters import SPEC
from .common import _options, _output

INPUTS = [signal for signal in SPEC.inputs if not signal.optional]  # a map has no others
BUILD = (  # options of a map to build alone
    *("fidelity", "out", "tolerance", "part", "preset", "settings", "oil"),
    *(signal.name for signal in INPUTS),
)
POINTS = 60  # by default
HELP = "tables of a washer's solutions for look-up: build, list, check"
EXAMPLES = (
    "thrustwasher map list",
    "thrustwasher part new washer --out w.toml && thrustwasher map build w.toml "
    "--load 100:400 --speed 400:900 --tilt 0.001:0.002",
)
OPTIONS = {
    "--fidelity LEVEL": "mesh to chart: fine, field; default: as the tolerance needs",
    "--out FILE": "default washer.twm, PART.twm of a part file",
    "--json": "one JSON object instead of words",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument("deed", choices=["build", "list", "check"], help="what to do")
    parser.add_argument("file", nargs="?", help="build: a part file (.toml); check: the map file")
    _options.add(parser, OPTIONS)
    points = "held-out points of the check, default 60"
    parser.add_argument("--points", default=POINTS, metavar="N", type=int, help=points)
    parser.add_argument(
        "--tol",
        "--tolerance",
        dest="tolerance",
        metavar="X",
        help="relative error of the torque allowed, default 0.005",
    )
    _options.add_workers(parser)
    group = parser.add_argument_group("box of a map to build: LOW:HIGH, or one value to fix")
    for signal in INPUTS:
        group.add_argument(
            _options.option_name(signal.name),
            dest=signal.name,
            metavar="LOW:HIGH",
            help=f"{signal.help} [{signal.unit}]",
        )
    _options.add_parameters(parser, SPEC)


def run(arguments: argparse.Namespace) -> int:
    """Do what is asked."""
    if not 2 <= arguments.points <= 100_000:
        raise ParameterError(f"--points = {arguments.points}, allowed: 2 .. 100000")
    usual: dict[str, Any] = {"points": POINTS, "file": None, "workers": None}
    usual = usual if arguments.deed == "list" else {}
    if arguments.deed != "build":
        _options.refuse_unused(arguments, f"map {arguments.deed}", BUILD, **usual)
    return {"build": _build, "list": _list, "check": _check}[arguments.deed](arguments)


def _build(arguments: argparse.Namespace) -> int:
    if arguments.file:
        if not is_part(arguments.file):
            raise ParameterError("build: a part file (.toml) is required; the map to write: --out")
        if arguments.part or arguments.preset:
            raise ParameterError(f"build {arguments.file}: allowed: without --part and --preset")
        arguments.part = arguments.file
    usual = f"{Path(arguments.file).stem if arguments.file else 'washer'}.twm"
    out = _output.check_file(arguments.out or usual, "--out", (".twm",))
    part = _options.read_part(arguments, SPEC)
    from ..washer.map.map_plan import DEFAULT_BOX, TOLERANCE, coverable

    params, box = part.params, part.box | coverable(part.box)
    box |= {
        s.name: _span(getattr(arguments, s.name), s.name, s.unit)
        for s in INPUTS
        if getattr(arguments, s.name)
    }

    from ..ladder.own_tables import serves
    from ..native.files import write
    from ..washer.map.map_build import make_map
    from ..washer.map.map_tables import TABLES, keep_own

    tolerance = parse_quantity(arguments.tolerance or TOLERANCE, "1", "tolerance")
    journal, kept = out.with_name(f"{out.name}.journal"), "the curves that are done"
    with _output.going_on(arguments, journal, lambda *_: None, kept) as progress:

        def show(label: str) -> Callable[[int, int], None]:
            """Return what shows how far a part of the work is, and marks that some is done."""
            line = _output.time_left(label)

            def both(done: int, total: int) -> None:
                progress(done, total)
                line(done, total)

            return both

        metadata = make_map(
            params,
            Path(out),
            box=box,
            tolerance=tolerance,
            fidelity=arguments.fidelity,
            workers=arguments.workers,
            points=arguments.points,
            progress=show,
        )
    if left := [s for s in INPUTS if s.name not in box]:
        spans = (f"{s.name} = {range_text(s, DEFAULT_BOX[s.name])}" for s in left)
        _output.note(f"taken by default: {', '.join(spans)}")
    warnings = replace(part, box=box).oil_warnings
    _options.tell_oil(part)
    _output.warn(warnings)
    plain = not arguments.fidelity and not any(getattr(arguments, s.name) for s in INPUTS)
    if arguments.file and plain and not serves(TABLES, params, box, tolerance):
        keep_own(params, lambda path: write(path, Path(out).read_bytes()))
    more = {"warnings": warnings, **_options.oil_record(part)}
    _show({**metadata, **more} if arguments.json else metadata, str(out), arguments.json)
    return 0


def _span(text: str, name: str, unit: str) -> tuple[float, float]:
    """Return LOW:HIGH, or one value twice, in SI."""
    parts = text.split(":")
    if len(parts) > 2 or not all(p.strip() for p in parts):
        raise ParameterError(f"--{name} = {text!r}, allowed: LOW:HIGH or one value")
    ends = [parse_quantity(p, unit, name) for p in parts]
    return float(ends[0]), float(ends[-1])


def _list(arguments: argparse.Namespace) -> int:
    from ..washer.map.map_file import all_maps, map_folders

    maps = all_maps()
    if arguments.json:
        _output.print_json({"maps": [{"file": str(m.path), **m.metadata} for m in maps]})
        return 0
    for m in maps:
        _show(m.metadata, str(m.path), False)
    if not maps:
        folders = ", ".join(map(str, map_folders()))
        print(f"no map in {folders}; make one with `thrustwasher map build`")
    return 0


def _check(arguments: argparse.Namespace) -> int:
    if not arguments.file:
        raise ParameterError("check: the map file is required, `thrustwasher map check FILE`")
    from ..processes import runner
    from ..washer.map.map_check import check_map, mesh_of
    from ..washer.map.map_file import read_map
    from ..washer.parameters import WasherParams

    file = read_map(arguments.file)
    try:
        params = WasherParams(**file.metadata["params"])
    except (KeyError, TypeError):
        raise ParameterError(
            f"map = {arguments.file!r}: its metadata names no parameters"
        ) from None
    with runner(arguments.workers or 1) as run:
        verdict = check_map(
            params,
            arguments.file,
            points=arguments.points,
            grid=mesh_of(file.metadata),
            run=run,
            progress=_output.time_left("held-out points"),
        )
    metadata = {**file.metadata, "held_out": asdict(verdict)}
    _show(metadata, arguments.file, arguments.json)
    return 0


def _show(metadata: dict[str, Any], path: str, as_json: bool) -> None:
    """Print metadata, as one JSON object or in words."""
    if as_json:
        _output.print_json({"file": path, **metadata})
        return
    from ..washer.map.map_check import mesh_of

    known = {s.name: s for s in INPUTS}
    box = ", ".join(
        f"{name} {range_text(known[name], ends)}" for name, ends in metadata["box"].items()
    )
    print(f"{path}: {box}")
    finer = ""
    if metadata.get("finer_lines"):
        finer = (
            f", {metadata['finer_lines']} on a finer one (the torque was up to "
            f"{metadata['mesh_made_good']:.1%} off without them)"
        )
    print(
        f"  tolerance {metadata['tolerance']:g}: {metadata['lines']} curves on the "
        f"{metadata['built_from']} mesh{finer}, {metadata['build_s']:g} s with "
        f"{metadata['workers']} processes"
    )
    held = metadata["held_out"]
    if held:
        nodes = "{} x {} nodes".format(*mesh_of(metadata))
        print(
            f"  held out ({held['points']:g} points on {nodes}): torque within "
            f"{held['torque']:.2g} (rms {held['torque_rms']:.2g}), "
            f"{held['torque_near_fold']:.2g} within 3 % of a fold; film "
            f"ratio {held['film_ratio']:.2g}; temperature {held['temperature']:.2g} K; oil within "
            f"{held['oil']:.2g}; loads of {held['folds']:g} folds {held['fold_load']:.2g}"
        )
