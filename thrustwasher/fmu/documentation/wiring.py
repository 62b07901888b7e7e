"""How to wire an FMU: feedthrough, steps that stay stable, and what a model wants of a host."""

from dataclasses import fields
from html import escape

from ...model.registry import MODELS, find_model
from ...model.spec import ModelSpec
from ..running.direct_instance import DirectInstance
from .markup import list_of, table

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


def wiring(spec: ModelSpec, *, runs: bool = True) -> str:
    """Return advice, feedthrough, the limit of explicit coupling and the terminals as HTML.

    The limit names the model's own slope if the model ``runs`` for it.
    """
    lines = [*GENERAL, f"Suggested step: {spec.step_size:g} s.", *_advice(spec)]
    plugs = [
        (t.name, t.kind, ", ".join(f"{member} = {name}" for name, member, _ in t.members), t.help)
        for t in spec.terminals
    ]
    parts = [list_of(lines), _feedthrough(spec), _limit(spec, runs)]
    if plugs:
        parts.append(table(("terminal", "kind", "members", "meaning"), plugs))
    return "\n".join(filter(None, parts))


def _advice(spec: ModelSpec) -> tuple[str, ...]:
    """Return what a model of the package says itself."""
    return find_model(spec.key).wiring if spec.key in MODELS else ()


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
    point = {s.name: s.start or s.nominal or 0.0 for s in spec.inputs}
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
