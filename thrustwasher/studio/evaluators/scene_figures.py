"""What a study reads from a run of a scene: figures, outcomes, signals over time."""

import math
from collections.abc import Sequence

import numpy as np

from ...model.quantity import Figure
from ...shift.key_figures.events_and_phases import Signals, find_events, turning
from ...shift.key_figures.figure_list import FIGURES, usual_rows
from ...shift.key_figures.key_figures import key_figures
from ...shift.scene.connections import DIRECT, MESHES
from ...shift.scene.scene import Part, Scene
from ...shift.shift_result import ShiftResult
from .evaluator import Array

WASHER_SERIES = ("washer.friction_torque", "washer.film_ratio")
SERIES = (
    "transmission.clutch_reaction",
    "transmission.brake_reaction",
    "vehicle.acceleration",
    "transmission.output_torque",
    "transmission.engine_speed",
    "clutch.temperature",
    *WASHER_SERIES,
)
# As the shift begins: name -> signal, words, unit.
AT_START = {
    "washer_torque": (
        "washer.friction_torque",
        "washer, friction torque as the shift begins",
        "N.m",
    ),
    "washer_film_ratio": ("washer.film_ratio", "washer, film ratio as the shift begins", "1"),
}
SAFETIES = ("pitting_safety", "scuffing_safety", "micropitting_safety")
# Key figure -> figure of ``report.shift.usual``, where the names differ.
USUAL = {"minimum_pitting_safety": "pitting_safety", "minimum_scuffing_safety": "scuffing_safety"}
UNSAFE, NO_LOCK, LOST = "_safety_below_1", "no_lock_up", "film_lost"


def figures_of(nominal: ShiftResult) -> tuple[Figure, ...]:
    """Return the figures that the nominal run has; a swing of the shaft is not looked for."""
    pack, usual, found = nominal.scene.engaging, usual_rows(), []
    for f in nominal.key_figures:
        if f.value is None or f.name.startswith("judder_"):
            continue
        key = USUAL.get(f.name, f.name)
        known = usual.get(key) or usual.get(key.replace(f"_{pack}_", "_{pack}_"))
        low, high = known[1] if known else (-math.inf, math.inf)
        scale = known[4] if known and len(known) > 4 else 1.0
        found.append(Figure(f.name, f.unit, f.text, low * scale, high * scale, f.difference))
    for name, (signal, words, unit) in AT_START.items():
        if signal in nominal.signals:
            found.append(Figure(name, unit, words))
    return tuple(found)


def outcomes_of(scene: Scene) -> tuple[str, ...]:
    """Return what a run of a scene says yes or no to."""
    lost = [LOST for name in DIRECT if name in scene.parts]
    meshes = [n for n in MESHES if n in scene.parts and _safeties(scene.parts[n])]
    return (*lost, *(n + UNSAFE for n in meshes), NO_LOCK)


def series_of(nominal: ShiftResult) -> tuple[str, ...]:
    """Return the signals that a study follows over time."""
    known = {*nominal.signals}
    if nominal.scene.vehicle:
        known = known - {"transmission.output_torque"} | {"vehicle.acceleration"}
    return tuple(name for name in SERIES if name in known)


def is_of_washers(figure: str) -> bool:
    """Tell if a figure depends on what washers do, or on what decides on them alone."""
    reading = FIGURES[figure].reading.split() if figure in FIGURES else []
    signal = reading[1] if reading else ""
    return (
        figure in AT_START
        or figure == "washer_distress_time"
        or signal.startswith("washer.")
        or signal == "transmission.washer_load"
    )


def values_of(
    scene: Scene, time: Array, signals: Signals, figures: Sequence[str], outcomes: Sequence[str]
) -> Array:
    """Return figures and outcomes of a run; NaN where there is no such figure."""
    events = find_events(scene, time, signals)
    found = {f.name: f.value for f in key_figures(scene, time, signals, events)}
    for name, (signal, *_) in AT_START.items():
        if signal in signals:
            found[name] = float(np.interp(scene.shift_start, time, signals[signal]))
    row = [found.get(name) for name in figures]
    for name in outcomes:
        if name == LOST:
            yes = bool(((signals["washer.distress"] > 0.5) & turning(signals)).any())
        elif name == NO_LOCK:
            yes = found["lock_time"] is None
        else:
            mesh = name.removesuffix(UNSAFE)
            yes = any(
                bool((signals[f"{mesh}.{safety}"] < 1.0).any())
                for safety in _safeties(scene.parts[mesh])
            )
        row.append(float(yes))
    return np.array([math.nan if x is None else x for x in row])


def series_values(
    scene: Scene, time: Array, signals: Signals, names: Sequence[str], at: Array
) -> Array:
    """Return signals of a run at the instants ``at`` (n_t,) [s]: (signals, n_t)."""
    rows = []
    for name in names:
        if name == "vehicle.acceleration":
            assert scene.vehicle is not None
            values = scene.vehicle.reach * signals["transmission.output_acceleration"]
        else:
            values = signals[name]
        rows.append(np.interp(at, time, values))
    return np.array(rows).reshape(len(names), len(at))


def _safeties(part: Part) -> list[str]:
    """Return the safeties that a mesh has a value of."""
    outputs = {s.name for s in part.spec.outputs} - part.spec.absent(part.params)
    return [name for name in SAFETIES if name in outputs]
