"""documentation/index.html of an FMU: the template in fmu_src filled from the model's lists."""

from collections.abc import Sequence
from dataclasses import fields
from html import escape
from pathlib import Path

from ...errors import Status
from ...ladder.card import load_cards
from ...ladder.card_parts import QUANTITIES
from ...model.registry import MODELS, find_model
from ...model.spec import ModelSpec
from ..description.interface import Variable, enumerations, variables
from ..model_kernels import package_version
from ..package.licences import listed_licences
from ..package.model_sources import source_folder
from ..running.direct_instance import DirectInstance
from .markup import data_uri, list_of, markup, table
from .reference_results import FOLDER

Rows = list[tuple[str, ...]]
WIDTH = 1e-3  # rad/s, of the central difference: small beside every smoothing
GENERAL = (
    "All values are SI: kelvin, radian, newton. An input that is not connected reads 0; 0 K is "
    "refused, every other input takes it.",
    "Outputs are valid after the initialization and at the end of each step.",
    "Any communication step is accepted, also steps of different length.",
)
LIMIT = """<p>A torque that resists slip, fed back over one communication step, is an explicit
method. With the slope c of friction_torque over speed, the inertia J that the slip sees
(J1 J2/(J1 + J2) of two shafts) and the step H, it is stable for H c/J &lt; 2 and without
oscillation below 1 if the torque is fresh in each step, stable below 1 and without overshoot below
1/4 if it is one step old. {slope} Where c is negative the system itself is unstable, and no step
cures it. A linearly implicit master that uses the directional derivatives (native FMU) has no such
limit.</p>"""


def page(
    spec: ModelSpec, folder: Path, *, target: str, fmi: int, guid: str, platforms: Sequence[str],
    runs: bool = True,
) -> str:  # fmt: skip
    """Return the page.

    ``folder`` holds the model's icon and readme, whose first line is the title. With ``runs`` =
    False the model is not run for the slope of its torque, and need not be compiled for this
    Python.
    """
    from jinja2 import Environment, StrictUndefined  # late: what is built already needs none

    found = variables(spec)
    icon = folder / "icon.png"
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    template = (source_folder() / "documentation" / "index.html").read_text("utf-8")
    return environment.from_string(template).render(
        spec=spec, target=target, fmi=fmi, guid=guid, platforms=platforms,
        version=package_version(), reference=FOLDER,
        table=table,
        icon=data_uri(icon) if icon.is_file() else "",
        inputs=_settable(found, "input"), parameters=_settable(found, "parameter"),
        outputs=[(v.name, _unit(v), v.help) for v in found if v.causality == "output"],
        enumerations=[(name, str(i.value), i.name, i.help)
                      for name, items in enumerations(spec).items() for i in items],
        wiring=wiring(spec, runs=runs),
        statuses=[(str(int(s)), s.name, "failure" if s.is_failure else "advice" if s else "-",
                   s.advice) for s in sorted(Status)],
        accuracy_head=("fidelity", "within", "points", *QUANTITIES, "measured with"),
        accuracy=accuracy(spec), equations=_equations(folder),
        licences=listed_licences(target, platforms),
    )  # fmt: skip


def _settable(found: tuple[Variable, ...], causality: str) -> Rows:
    shown = [v for v in found if v.causality == causality]
    return [
        (v.name, _unit(v), "" if v.low is None or v.high is None else f"{v.low:g} .. {v.high:g}",
         f"{v.start:g}", v.help) for v in shown
    ]  # fmt: skip


def _unit(v: Variable) -> str:
    return v.unit if v.type == "Real" else v.type_name or v.type


def accuracy(spec: ModelSpec) -> Rows:
    """Return what the model's cards say of the default parameters: a row for each card."""
    rungs = list(spec.fidelities)
    found = [card for card in load_cards(spec.key)
             if card.params.name == "default" and card.fidelity in rungs]  # fmt: skip
    found.sort(key=lambda card: (rungs.index(card.fidelity), card.chart or ""))
    return [
        (
            f"{card.fidelity} {card.chart or ''}".strip(),
            ", ".join(f"{n} {a.min:g} .. {a.max:g} {a.unit}" for n, a in card.envelope.items()),
            str(card.held_out.n),
            *map(card.shown_worst, QUANTITIES),
            f"version {card.package['version']}",
        )
        for card in found
    ]


def _equations(folder: Path) -> str:
    file = folder / "readme.md"
    readme = file.read_text("utf-8") if file.is_file() else ""
    title, _, rest = readme.partition("\n")
    return markup(rest if title.startswith("# ") else readme, folder, level=2)


def wiring(spec: ModelSpec, *, runs: bool = True) -> str:
    """Return advice, feedthrough, the limit of explicit coupling and the terminals as HTML.

    The limit names the model's own slope if the model ``runs`` for it.
    """
    advice = find_model(spec.key).wiring if spec.key in MODELS else ()
    lines = [*GENERAL, f"Suggested step: {spec.step_size:g} s.", *advice]
    plugs = [
        (t.name, t.kind, ", ".join(f"{member} = {name}" for name, member, _ in t.members), t.help)
        for t in spec.terminals
    ]
    parts = [list_of(lines), _feedthrough(spec), _limit(spec, runs)]
    if plugs:
        parts.append(table(("terminal", "kind", "members", "meaning"), plugs))
    return "\n".join(filter(None, parts))


def _feedthrough(spec: ModelSpec) -> str:
    """Say which outputs follow which inputs at once: a master sees them one step late."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for signal in spec.outputs:
        groups.setdefault(signal.depends, []).append(signal.name)
    rows = [(", ".join(names) or "-", ", ".join(o)) for names, o in groups.items()]
    return (
        "<p>Which inputs act at once, within the same point of time. A master with fixed steps "
        "sees such an output one step late.</p>" + table(("inputs", "outputs"), rows)
    )


def _limit(spec: ModelSpec, runs: bool) -> str:
    inputs, outputs = ({s.name: s for s in side} for side in (spec.inputs, spec.outputs))
    if "speed" not in inputs or "friction_torque" not in outputs:
        return ""
    if not runs:
        return LIMIT.format(slope="")
    point = {s.name: s.usual for s in spec.inputs}
    said = [
        f"{slope(spec, point | {'speed': v}):.1e} at {v:g} rad/s" for v in (0.0, point["speed"])
    ]
    others = ", ".join(f"{n} = {x:g} {inputs[n].unit}" for n, x in point.items() if n != "speed")
    return LIMIT.format(slope=escape(f"Here c [N.m.s/rad] is {' and '.join(said)}, with {others}."))


def slope(spec: ModelSpec, point: dict[str, float]) -> float:
    """Return d friction_torque/d speed [N.m.s/rad] at the inputs ``point``, films settled."""
    settled = {"starts_pressed"} & {f.name for f in fields(spec.params)}
    with DirectInstance(spec, parameters=dict.fromkeys(settled, True)) as model:
        model.initialize(0.0, point)
        torques = []
        for end in (-WIDTH, WIDTH):
            moved = point | {"speed": point["speed"] + end}
            model.set_inputs([moved[name] for name in model.input_names])
            torques += model.get(["friction_torque"])
    return (torques[1] - torques[0]) / (2.0 * WIDTH)
