"""Judder: a slipping pack whose friction falls with speed feeds the torsional mode.

The swing of the shaft's torque is measured in the run and held against the eigenvalue of the
driveline with the slope of the pack's own friction law. What the master adds by handing
capacities over once per step is computed as well: growth that is none of the physics is named.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .judder import FEW, Judder
from .pack_slope import capacity_slopes
from .scene import Scene
from .swing import Swing, fit_swing
from .torsion import PACKS, damping_limit_of, handed_over, matrix, torsional_mode

Array = NDArray[np.float64]
Places = NDArray[np.intp]
Signals = dict[str, Array]
PERIODS = 2.0  # of the mode in one window
LEAST_SAMPLES = 16  # in a window, for a fit
MOST_SAMPLES = 200
MOST_WINDOWS = 60
SMALL = 0.5  # of the greatest amplitude: up to there a swing counts as small
LEAST_SWING = 1e-4  # of the greatest shaft torque: less is no swing


class _Stretch(NamedTuple):
    """Points without a change of what sticks, and who rubs there."""

    places: Places
    rubbing: tuple[str, ...]
    held: tuple[str, ...]


class _Window(NamedTuple):
    """A stretch of some periods: the swing in it, slopes of the packs, eigenvalues.

    ``stepped`` is the mode with what the master adds.
    """

    swing: Swing
    slopes: Mapping[str, float]
    vehicle: float
    step: float
    mode: complex
    stepped: complex


def find_judder(scene: Scene, time: Array, signals: Signals) -> Judder | None:
    """Return how the shaft swings while a pack slips; None where it is rigid or does not swing."""
    gearbox = scene.parts["transmission"].params
    if not gearbox.shaft_stiffness:
        return None
    stretches = [s for s in _stretches(scene, time, signals) if len(s.places) >= LEAST_SAMPLES]
    if not stretches:
        return None
    stretch = max(stretches, key=lambda s: time[s.places[-1]] - time[s.places[0]])
    found = list(_windows(scene, time, signals, stretch))
    most = np.max(np.abs(signals["transmission.shaft_torque"]))
    found = [w for w in found if w.swing.amplitude > LEAST_SWING * most]
    if not found:
        return None
    return _judged(scene, time, signals, stretch, found)


def _stretches(scene: Scene, time: Array, signals: Signals) -> Iterator[_Stretch]:
    """Give every stretch in which a pack slips under a command that does not change."""
    ramp = scene.shift_start, scene.shift_start + scene.shift_duration
    sides = (time > ramp[0]).astype(int) + (time >= ramp[1])
    stuck = {p: signals[f"transmission.{p}_locked"] > 0.5 for p in PACKS}
    loaded = {p: signals[f"{p}.load"] > 0.0 for p in PACKS}
    key = sides + 4 * stuck["clutch"] + 8 * stuck["brake"]
    key += 16 * loaded["clutch"] + 32 * loaded["brake"]
    edges = np.flatnonzero(np.diff(key)) + 1
    for places in np.split(np.arange(len(time)), edges):
        i = places[len(places) // 2]
        rubbing = tuple(p for p in PACKS if loaded[p][i] and not stuck[p][i])
        during = ramp[0] < time[i] < ramp[1]
        if rubbing and not during:
            held = tuple(p for p in PACKS if stuck[p][i])
            yield _Stretch(places[1:], rubbing, held)  # the first point is of the change


def _windows(scene: Scene, time: Array, signals: Signals, stretch: _Stretch) -> Iterator[_Window]:
    """Give what the swing is in windows of some periods, and what it should be.

    Communication points may lie anywhere; the step of a window is its mean.
    """
    places, torque = stretch.places, signals["transmission.shaft_torque"]
    speed, t = signals["transmission.vehicle_speed"], time[stretch.places]
    slopes = _slopes(scene, signals, stretch, places[:1], None)
    modes = _modes(scene, slopes, stretch.held, float(speed[places[0]]), 0.0)
    if modes is None:
        return
    mode = modes[0]
    length = PERIODS * 2.0 * math.pi / mode.imag
    spare = float(t[-1] - t[0]) - length
    if spare < 0.0:
        return
    for begin in t[0] + np.linspace(0.0, spare, min(MOST_WINDOWS, 1 + int(4.0 * spare / length))):
        inside = places[(t >= begin) & (t <= begin + length)]
        if len(inside) < LEAST_SAMPLES:
            continue
        step = float(time[inside[-1]] - time[inside[0]]) / (len(inside) - 1)
        inside = inside[:: max(1, len(inside) // MOST_SAMPLES)]
        swing = fit_swing(time[inside], torque[inside], mode.real, mode.imag)
        if swing is None:
            continue
        slopes = _slopes(scene, signals, stretch, inside, swing.values(time[inside]) ** 2)
        vehicle = float(np.mean(speed[inside]))
        modes = _modes(scene, slopes, stretch.held, vehicle, step)
        if modes is not None:
            mode = modes[0]
            yield _Window(swing, slopes, vehicle, step, *modes)


def _slopes(
    scene: Scene, signals: Signals, stretch: _Stretch, inside: Places, weights: Array | None
) -> dict[str, float]:
    """Return the slopes of the packs that rub, as means over places.

    Friction that changes along a swing counts with the square of the swing: with that weight the
    mean slope does the same work in a period (integrate by parts).
    """
    found = {}
    for pack in stretch.rubbing:
        part = scene.parts[pack]
        values = capacity_slopes(part.params, part.fidelity, pack, signals, inside)
        found[pack] = float(np.average(values, weights=weights))
    return found


def _modes(
    scene: Scene, slopes: Mapping[str, float], held: tuple[str, ...], vehicle: float, step: float
) -> tuple[complex, complex] | None:
    """Return the eigenvalue of the mode without and with the master's part; None: no swing."""
    gearbox = scene.parts["transmission"].params
    mode = torsional_mode(matrix(gearbox, slopes, held, vehicle))
    if mode is None:
        return None
    looks_ahead = gearbox.capacity_extrapolation and gearbox.coupling == "capacity"
    late = handed_over(mode.imag * step, gearbox.torque_age, looks_ahead)
    with_master = {pack: slope * late for pack, slope in slopes.items()}
    stepped = torsional_mode(matrix(gearbox, with_master, held, vehicle))
    return mode, mode if stepped is None else stepped


def _judged(
    scene: Scene, time: Array, signals: Signals, stretch: _Stretch, found: list[_Window]
) -> Judder:  # fmt: skip
    """Return the verdict's numbers: means over the windows in which the swing is small."""
    gearbox = scene.parts["transmission"].params
    highest = max(found, key=lambda w: w.swing.amplitude)
    if highest is not found[0]:
        small = [w for w in found if w.swing.amplitude < SMALL * highest.swing.amplitude]
        found = small or found[:1]
    swing, mode, stepped = (
        sum(values) / len(found)
        for values in (
            [complex(w.swing.growth, w.swing.frequency) for w in found],
            [w.mode for w in found],
            [w.stepped for w in found],
        )
    )
    slopes = {p: float(np.mean([w.slopes[p] for w in found])) for p in stretch.rubbing}
    pack = min(slopes, key=lambda p: slopes[p])
    vehicle = float(np.mean([w.vehicle for w in found]))
    half = 0.5 * PERIODS * 2.0 * math.pi / mode.imag
    locks, stuck_swing = _stick_slip(time, signals, pack, stretch, 2.0 * math.pi / mode.imag)
    return Judder(
        pack=pack, start=found[0].swing.middle - half, end=found[-1].swing.middle + half,
        frequency=swing.imag / (2.0 * math.pi), growth=swing.real,
        amplitude=max(highest.swing.amplitude, stuck_swing), locks=locks, slope=slopes[pack],
        damping=gearbox.shaft_damping,
        limit_damping=damping_limit_of(gearbox, slopes, stretch.held, vehicle),
        mode_frequency=mode.imag / (2.0 * math.pi), mode_growth=mode.real,
        step_growth=stepped.real - mode.real, step=float(np.mean([w.step for w in found])),
        scatter=float(np.std([w.swing.growth - w.mode.real for w in found])),
    )  # fmt: skip


def _stick_slip(
    time: Array, signals: Signals, pack: str, stretch: _Stretch, period: float
) -> tuple[int, float]:
    """Return how often the pack stuck from the stretch on, and the swing [N m] meanwhile.

    Few lock-ups are the end of a shift, not stick-slip: then the swing is 0.
    """
    stuck = signals[f"transmission.{pack}_locked"] > 0.5
    locks = np.flatnonzero(stuck[1:] & ~stuck[:-1]) + 1
    locks = locks[locks > stretch.places[0]]
    if len(locks) < FEW:
        return len(locks), 0.0
    torque = signals["transmission.shaft_torque"]
    spans = [(time > time[i] - period) & (time <= time[i]) for i in locks]
    return len(locks), max(0.5 * float(np.ptp(torque[s])) for s in spans)
