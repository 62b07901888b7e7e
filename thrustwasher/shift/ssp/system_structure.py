"""The system of a shift as an SSP master runs it: components, connections, what each part gets.

The package's master is taken to be the simplest there is: all parts step at once with the values of
the last point, held. Nothing happens between the parts but handing values over; what this package
does beyond that (looking ahead over the delay) is inside the transmission and switched on by its
parameters.

Every part has an FMU of its own, whose defaults are the scene's: masters differ much in what they
do with the values in a package, and some do nothing. Those that read them were found to read an
output after they have set the inputs it depends on: ``PASSED_ON`` is for them.
"""

import re
import unicodedata
from collections.abc import Mapping
from dataclasses import fields
from typing import Any, NamedTuple

from ...errors import ParameterError
from ...model.spec import ModelSpec, Signal, tailored
from ...model.toml_tables import table_beside
from ...model.unread import unread
from ..cosim.system import Stepping
from ..run import connected
from ..scene.connections import COMMAND, SOURCE, SOURCE_SPEC, Link, wired
from ..scene.scene import Part, Scene

MASTER = "jacobi"
# What the values in the package say instead, for masters that pass values on until they agree.
PASSED_ON = {("transmission", "torque_age"): 0, (SOURCE, "lead"): 0.0}
OIL = "oil_temperature"
BORDER = table_beside(__file__, "border.toml")
Starts = Mapping[str, Mapping[str, float]]


class Component(NamedTuple):
    """One FMU of the system: its model, parameters, start values and connected inputs.

    Parameters that are not used are left out: the FMU has all of them as its defaults.
    """

    name: str
    spec: ModelSpec
    parameters: dict[str, Any]
    starts: dict[str, float]
    inputs: tuple[Signal, ...]

    @property
    def source(self) -> str:
        """Where its FMU lies in the package."""
        return f"resources/{self.name}.fmu"


class Border(NamedTuple):
    """An output of the system and where it comes from, or a parameter and where it goes."""

    name: str
    part: str
    signal: Signal


class Inlet(NamedTuple):
    """An input of the open system: the inputs of parts that it feeds, by part; its first value."""

    name: str
    signal: Signal
    feeds: dict[str, str]
    start: float


class Structure(NamedTuple):
    """All that the description of the system says."""

    scene: Scene
    components: list[Component]
    links: list[Link]
    border: list[Border]
    parameters: list[Border]
    inlets: list[Inlet]

    @property
    def title(self) -> str:
        """The scene's title, behind its name where the system has another one."""
        scene = self.scene
        is_told = identifier(scene.name) == scene.name or scene.name in scene.title
        return scene.title if is_told else f"{scene.name}: {scene.title}"


def identifier(name: str) -> str:
    """Return a name that every master takes, for a scene of any name.

    Letters of ASCII, digits and underscores, a letter first.

    Examples
    --------
    >>> identifier("mein gang"), identifier("Gang-\u00e4"), identifier("1st"), identifier("shift")
    ('mein_gang', 'Gang_a', 's_1st', 'shift')
    """
    plain = unicodedata.normalize("NFKD", name)
    plain = re.sub(
        r"\W", "_", "".join(c for c in plain if not unicodedata.combining(c)), flags=re.A
    )
    return plain if re.match("[A-Za-z]", plain) else f"s_{plain}"


def prepared(scene: Scene) -> Scene:
    """Return the scene as the package runs it: parallel, with a transmission set up for it."""
    if scene.sequence is not None:
        raise ParameterError("[sequence]: allowed in a package: one shift")
    return scene.with_options(master=MASTER)


def start_values(scene: Scene, instances: Mapping[str, Stepping]) -> Starts:
    """Return the inputs of every part of a prepared scene at the start, as they belong together.

    The instances are those of ``cosimulate``; they are initialized here.
    """
    system = connected(scene, instances)
    system.initialize(scene.start_time)
    return {n: dict(zip(p.input_names, p.inputs, strict=True)) for n, p in system.parts.items()}


def plan(scene: Scene, starts: Starts) -> Structure:
    """Return components, connections and outputs of a prepared scene."""
    parts = {SOURCE: _source(scene), **scene.parts}
    # The oil's temperature is a number, not a signal: masters that start every connected input at
    # zero would send 0 K for a step.
    used = [k for k in wired(parts) if k.input != OIL]
    used.append(Link(SOURCE, "command", "transmission", COMMAND))
    components = [_component(scene, n, p, used, starts.get(n, {})) for n, p in parts.items()]
    return Structure(
        scene=scene,
        components=components,
        links=used,
        border=_border(parts),
        parameters=_parameters(components),
        inlets=_inlets(scene, components, used),
    )


def _source(scene: Scene) -> Part:
    """Return the source of the scene's shift command, one step ahead: it arrives a step late."""
    params = SOURCE_SPEC.params(
        start=scene.shift_start,
        duration=scene.shift_duration,
        before=scene.shift_from,
        after=scene.shift_to,
        lead=scene.step,
    )
    level = SOURCE_SPEC.default_fidelity
    return Part(spec=SOURCE_SPEC, fidelity=level, params=params, start=scene.start_time)


def _component(
    scene: Scene, name: str, part: Part, used: list[Link], starts: Mapping[str, float]
) -> Component:
    """Return a part with all that it is given: parameters, and what its inputs hold at first."""
    fed = {k.input for k in used if k.target == name}
    values = {s.name: float(starts.get(s.name, s.start or 0.0)) for s in part.spec.inputs}
    if OIL in values:
        values[OIL] = scene.oil_temperature
    given = part.parameters()
    span = scene.stop_time - scene.start_time
    return Component(
        name=name,
        spec=tailored(
            part.spec, given, values, stop_time=span, step_size=scene.step, **part.labels
        ),
        parameters={n: x for n, x in given.items() if not unread(part.params, n, part.fidelity)},
        starts=values,
        inputs=tuple(s for s in part.spec.inputs if s.name in fed),
    )


def _border(parts: Mapping[str, Part]) -> list[Border]:
    """Return the outputs of the system; those of the transmission keep their plain names.

    None has the name of a part: OMSimulator would look for it inside that part.
    """
    found = []
    for part, names in BORDER["shown"].items():
        if part in parts:
            known = {s.name: s for s in parts[part].spec.outputs}
            found += [Border(shown_as(part, n), part, known[n]) for n in names]
    return found


def shown_as(part: str, name: str) -> str:
    """Return what something of a part is called at the system's border."""
    return {"transmission": "", SOURCE: "shift_"}.get(part, f"{part}_") + name


def _parameters(components: list[Component]) -> list[Border]:
    """Return the parameters of the system: those listed that the scene uses."""
    found = []
    for part in components:
        about = {f.name: f.metadata for f in fields(part.spec.params)}
        for name in BORDER["parameters"].get(part.name, ()):
            if name in part.parameters:
                signal = Signal(name=name, unit=about[name]["unit"], help=about[name]["help"])
                found.append(Border(shown_as(part.name, name), part.name, signal))
    return found


def _inlets(scene: Scene, components: list[Component], used: list[Link]) -> list[Inlet]:
    """Return the inputs of the open system; the oil of a part with a sump is the sump's."""
    inputs = {p.name: {s.name: s for s in p.spec.inputs} for p in components}
    fed = {(k.target, k.input) for k in used}
    oil = {n: OIL for n, own in inputs.items() if OIL in own and (n, OIL) not in fed}
    found = []
    if oil:
        found.append(Inlet(OIL, inputs[next(iter(oil))][OIL], oil, scene.oil_temperature))
    for name, into in BORDER["inputs"].items():
        start = scene.shift_from if into == COMMAND else 0.0
        signal = inputs["transmission"][into]
        found.append(Inlet(name, signal, {"transmission": into}, start))
    return found
