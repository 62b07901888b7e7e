"""What must not be missed at a steady point of a gearbox."""

from collections.abc import Iterator

from ...errors import Status
from ...model.advice import warnings_of
from ...model.registry import MODELS, find_model, outside_laws
from ...units import format_quantity as say
from ..cosim.system import ConnectedPart, System
from ..key_figures.figure_list import FILM_SPEED
from ..scene.connections import PACKS
from ..scene.scene import Scene

AGES = 423.15  # K: rule of thumb; above it transmission fluid ages fast
BODIES = ("temperature_max", "bulk_temperature")  # outputs: of bodies that the oil wets


def capacity(scene: Scene, pack: str) -> float:
    """Return the torque [N m] that a pack can hold under the maximum load of its scene."""
    gearbox = scene.parts["transmission"].params
    load = float(getattr(gearbox, f"{pack}_force"))
    if gearbox.actuation == "pressure":
        own = [getattr(gearbox, f"{pack}_{n}") for n in ("return_spring", "piston_area")]
        count = getattr(gearbox, f"{pack}_pressure_points")
        most = max(
            (getattr(gearbox, f"{pack}_pressure_{i + 1}") for i in range(count)), default=0.0
        )
        load = max(most - own[0], 0.0) * own[1]
    return capacity_at(scene, pack, load)


def capacity_at(scene: Scene, pack: str, load: float) -> float:
    """Return the torque [N m] that a pack can hold at rest under a load [N]; else infinity."""
    part = scene.parts[pack]
    if part.spec.key not in MODELS:  # a pack from elsewhere
        return float("inf")
    solved = find_model(part.spec.key).solve(
        part.params,
        load=load,
        speed=0.0,
        oil_temperature=scene.oil_temperature,
        fidelity=part.fidelity,
        throw=False,
    )
    return float(solved.torque_capacity)


def doubts_of_point(
    scene: Scene, system: System, holding: str, most: float, reaction: float
) -> Iterator[str]:
    """Yield what must not be missed where ``system`` has come to rest.

    ``most``: torque that the pack which holds can hold; ``reaction``: that it has.
    """
    if abs(reaction) > most:
        times = f": {abs(reaction) / most:.2f} times as much in all" if most else ""
        yield (
            f"{holding}: {say(abs(reaction), 'N.m')} to hold, its capacity at the maximum load of "
            f"this scene is {say(most, 'N.m')}: it would slip; press it harder or give it more "
            f"faces{times}"
        )
    for name, part in system.parts.items():
        if name not in (holding, "transmission"):
            yield from (f"{name}: {text}" for text in _of_part(scene, name, part))


def _of_part(scene: Scene, name: str, part: ConnectedPart) -> Iterator[str]:
    params = scene.parts[name].params
    inputs = dict(zip(part.input_names, part.inputs, strict=True))
    outputs = dict(zip(part.output_names, part.outputs, strict=True))
    speed, absent = inputs.get("speed"), part.spec.absent(params)
    if speed is not None and abs(speed) < FILM_SPEED and name not in PACKS:
        return  # it does not turn
    status = Status(int(outputs.get("solver_status", 0)))
    more = outside_laws(part.spec.key, params, inputs)
    yield from warnings_of(part.spec, status, inputs, outputs, more)
    for key, value in outputs.items():
        if key in absent:
            continue
        if key.endswith("_safety") and value < 1.0:
            yield f"{key} = {value:.3g}, below 1"
        if key in BODIES and AGES < value <= _limit(part, key):
            yield f"{key} = {say(value, 'K')}: above {say(AGES, 'K')} transmission fluid ages fast"


def _limit(part: ConnectedPart, name: str) -> float:
    """Return the temperature from which on there is a warning of the model's own."""
    return next((s.limit for s in part.spec.outputs if s.name == name and s.limit), float("inf"))
