"""documentation/index.html of an FMU: the template in fmu_src filled from the model's lists."""

from dataclasses import fields
from pathlib import Path
from typing import Any

from ...errors import ParameterError, Status
from ...ladder.error_table import QUANTITIES, load_tables
from ...ladder.formats import shown_error
from ...model.prepare import tables_of
from ...model.registry import MODELS, find_model, find_spec
from ...model.spec import ModelSpec
from ...templates import filled
from ..description.interface import Interface, interface
from ..model_kernels import package_version
from ..package.licences import listed_licences
from ..package.model_sources import Order, source_folder
from ..running.direct_instance import DirectInstance
from .markup import data_uri, markup
from .reference_results import FOLDER

Rows = list[tuple[str, ...]]
WIDTH = 1e-3  # rad/s, of the central difference: small compared with every smoothing


def page(shown: Interface, folder: Path, order: Order, guid: str, *, runs: bool = True) -> str:
    """Return the page; ``folder`` holds the model's icon and readme, its title in the first line.

    With ``runs`` = False the model is not run for the slope of its torque.
    """
    spec, icon = shown.spec, folder / "icon.png"
    return filled(
        source_folder() / "documentation" / "index.html",
        spec=spec,
        target=order.target,
        fmi=order.fmi,
        guid=guid,
        platforms=order.platforms,
        version=package_version(),
        reference=FOLDER,
        icon=data_uri(icon) if icon.is_file() else "",
        usual=interface(find_spec(spec.key)).variables if spec.kind else (),
        shown=shown,
        statuses=sorted(Status),
        advice=find_model(spec.key).wiring if spec.key in MODELS else (),
        feedthrough=_feedthrough(spec),
        slope=_slope_words(spec, runs),
        accuracy_head=("fidelity", "within", "points", *QUANTITIES, "measured with"),
        accuracy=accuracy(spec),
        equations=equations(folder),
        licences=listed_licences(order.target, order.platforms, c_sources=order.c_sources),
    ).decode()


def accuracy(spec: ModelSpec) -> Rows:
    """Return the measured errors with the parameters it starts with, and its map's own check."""
    own = spec.kind != ""
    return _of_map(spec) + [
        (
            f"{level.fidelity} {chart.name or ''}".strip(),
            ", ".join(f"{n} {a.min:g} .. {a.max:g} {a.unit}" for n, a in level.box.items()),
            str(chart.points),
            *(shown_error(level.worst_anywhere(q, chart), unit) for q, unit in QUANTITIES.items()),
            f"version {table.version}",
        )
        for table in load_tables(spec.key, spec.table_of or spec.params())
        for level in table.levels
        for chart in level.charts
        if table.name == "default" or (own and not table.stale(level))
    ]


def _of_map(spec: ModelSpec) -> Rows:
    """Return what the check of a part's map has found, as a row; none if it has no map."""
    tables = tables_of(spec)
    if tables is None or not spec.kind:
        return []
    try:
        metadata: dict[str, Any] = tables.find(spec.table_of or spec.params()).metadata
    except ParameterError:  # no map was made for it
        return []
    held, units = metadata["held_out"], {s.name: s.unit for s in spec.inputs}
    box = ", ".join(
        f"{n} {low:g} .. {high:g} {units[n]}" for n, (low, high) in metadata["box"].items()
    )
    return [
        (
            f"{tables.level}, when built",
            box,
            str(held["points"]),
            shown_error(held["torque"], None),
            shown_error(held["temperature"], "K"),
            "-",
            shown_error(held["film_ratio"], "1"),
            "x".join(map(str, metadata.get("checked_on", ()))) + " nodes",
        )
    ]


def equations(folder: Path) -> str:
    """Return what the model's own page says, without its title, as HTML."""
    file = folder / "readme.md"
    readme = file.read_text("utf-8") if file.is_file() else ""
    title, _, rest = readme.partition("\n")
    return markup(rest if title.startswith("# ") else readme, folder, level=2)


def _feedthrough(spec: ModelSpec) -> Rows:
    """Return which outputs follow which inputs at once: a master sees them one step late."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for signal in spec.outputs:
        groups.setdefault(signal.depends, []).append(signal.name)
    return [(", ".join(names) or "-", ", ".join(found)) for names, found in groups.items()]


def _slope_words(spec: ModelSpec, runs: bool) -> str | None:
    """Return the slope of the model's torque if it ``runs`` for it; None: it has no slip."""
    inputs = {s.name: s for s in spec.inputs}
    if "speed" not in inputs or "friction_torque" not in spec.real_outputs:
        return None
    if not runs:
        return ""
    point = {s.name: s.usual for s in spec.inputs}
    slopes = [
        f"{slope(spec, point | {'speed': v}):.1e} at {v:g} rad/s" for v in (0.0, point["speed"])
    ]
    others = ", ".join(f"{n} = {x:g} {inputs[n].unit}" for n, x in point.items() if n != "speed")
    return f"Here c [N.m.s/rad] is {' and '.join(slopes)}, with {others}."


def slope(spec: ModelSpec, point: dict[str, float]) -> float:
    """Return d friction_torque/d speed [N.m.s/rad] at ``point``, films settled, nothing held."""
    known = {f.name for f in fields(spec.params)}
    alone = {n: x for n, x in (("starts_pressed", True), ("holding", "off")) if n in known}
    with DirectInstance(spec, parameters=alone) as model:
        model.initialize(0.0, point)
        torques = []
        for end in (-WIDTH, WIDTH):
            moved = point | {"speed": point["speed"] + end}
            model.set_inputs([moved[name] for name in model.input_names])
            torques += model.get(["friction_torque"])
    return (torques[1] - torques[0]) / (2.0 * WIDTH)
