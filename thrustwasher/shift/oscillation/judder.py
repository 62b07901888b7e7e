"""Judder: a slipping pack whose friction falls with speed feeds the torsional mode.

The oscillation of the shaft's torque is measured in the run and held against the eigenvalue of the
driveline with the slope of the pack's own friction law. What the master adds by handing
capacities over once per step is computed as well: growth that is none of the physics is named.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...numerics.jit import Array
from ...transmission.kernels.shift_figures import FEW
from ..key_figures.figure_list import FIGURES, Found
from ..scene.connections import PACKS
from ..scene.scene import Scene
from .damped_oscillation import Oscillation, fit_oscillation
from .torsion import capacity_slopes, damping_limit_of, handed_over, matrix, torsional_mode

Places = NDArray[np.intp]
Signals = dict[str, Array]
PERIODS = 2.0  # of the mode in one window
LEAST_SAMPLES = 16  # in a window, for a fit
MOST_SAMPLES = 200
MOST_WINDOWS = 60
SMALL = 0.5  # of the maximum amplitude: up to there an oscillation counts as small
LEAST_AMPLITUDE = 1e-4  # of the maximum shaft torque: less is no oscillation
AGREES = 0.1, 1e-3  # of the predicted growth, and of the frequency


@dataclass(frozen=True, kw_only=True)
class Judder:
    """An oscillation of the shaft while a pack slips; rates in 1/s, frequencies in Hz."""

    pack: str  # The pack that slips, the one with the steepest fall of friction if both do
    start: float  # [s] The oscillation was judged from here
    end: float  # [s] ... to here.
    frequency: float
    growth: float  # Measured; below 0 the oscillation decays
    amplitude: float
    """[N m] of the shaft torque at its maximum, half of the way from crest to trough."""
    locks: int  # How often the pack stuck meanwhile
    slope: float  # [N m s/rad] of the pack's torque over its slip
    damping: float  # [N m s/rad] of the shaft
    limit_damping: float  # [N m s/rad] below which the oscillation grows
    mode_frequency: float  # Of the eigenvalue
    mode_growth: float  # Of the eigenvalue
    step_growth: float  # What handing capacities over once per step adds to the eigenvalue's growth
    step: float  # [s]
    scatter: float = 0.0  # Of measured less computed growth, from window to window

    @property
    def tolerance(self) -> float:
        """Growth [1/s] to which measured and computed growth are held to agree."""
        relative, absolute = AGREES
        angular = 2.0 * math.pi * self.mode_frequency
        return max(relative * abs(self.mode_growth), absolute * angular, self.scatter)

    @property
    def stick_slip(self) -> bool:
        """The pack sticks again and again: not the one lock-up that ends a shift."""
        return self.locks >= FEW

    @property
    def kind(self) -> str:
        """What the growth is.

        "physical": it grows as the eigenvalue says; "decaying": it decays, as the eigenvalue says;
        "numerical": the communication step makes the difference; "unexplained": another one.
        """
        more = self.growth - self.mode_growth
        if abs(more) <= self.tolerance:
            return "physical" if self.growth > 0.0 else "decaying"
        if abs(self.step_growth) > 0.5 * self.tolerance and more * self.step_growth > 0.0:
            return "numerical"
        return "decaying" if max(self.growth, self.mode_growth) <= 0.0 else "unexplained"

    def as_dict(self) -> dict[str, Any]:
        """Return all of it, the kind and a step that adds little included."""
        return {**asdict(self), "kind": self.kind, "good_step": self.good_step}

    @property
    def good_step(self) -> float:
        """Step [s] that would add half the tolerance; what it adds falls with its square."""
        share = 0.5 * self.tolerance / max(abs(self.step_growth), 1e-300)
        return float(self.step * min(1.0, share**0.5))


def judder_figures(found: Judder | None) -> Found:
    """Return the key figures of an oscillation; times are those of its beginning."""
    if found is None:
        return {}
    names = (name for name in FIGURES if name.startswith("judder_"))
    figures: Found = {n: (getattr(found, n.removeprefix("judder_")), None) for n in names}
    return {**figures, "judder_growth": (found.growth, found.start)}


class _Interval(NamedTuple):
    """Points without a change of what sticks, and who rubs there."""

    places: Places
    rubbing: tuple[str, ...]
    held: tuple[str, ...]


class _Window(NamedTuple):
    """An interval of some periods: the oscillation in it, slopes of the packs, eigenvalues.

    ``stepped`` is the mode with what the master adds.
    """

    fit: Oscillation
    slopes: Mapping[str, float]
    vehicle: float
    step: float
    mode: complex
    stepped: complex


def find_judder(scene: Scene, time: Array, signals: Signals) -> Judder | None:
    """Return how the shaft oscillates while a pack slips; None if it is rigid or at rest."""
    gearbox = scene.parts["transmission"].params
    if not gearbox.shaft_stiffness:
        return None
    intervals = [s for s in _intervals(scene, time, signals) if len(s.places) >= LEAST_SAMPLES]
    if not intervals:
        return None
    interval = max(intervals, key=lambda s: time[s.places[-1]] - time[s.places[0]])
    found = list(_windows(scene, time, signals, interval))
    most = np.max(np.abs(signals["transmission.shaft_torque"]))
    found = [w for w in found if w.fit.amplitude > LEAST_AMPLITUDE * most]
    if not found:
        return None
    return _judged(scene, time, signals, interval, found)


def _intervals(scene: Scene, time: Array, signals: Signals) -> Iterator[_Interval]:
    """Give every interval in which a pack slips under a command that does not change."""
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
            yield _Interval(places[1:], rubbing, held)  # the first point is of the change


def _windows(scene: Scene, time: Array, signals: Signals, interval: _Interval) -> Iterator[_Window]:
    """Give what the oscillation is in windows of some periods, and what it should be.

    Communication points may lie anywhere; the step of a window is its mean.
    """
    places, torque = interval.places, signals["transmission.shaft_torque"]
    speed, t = signals["transmission.vehicle_speed"], time[interval.places]
    slopes = _slopes(scene, signals, interval, places[:1], None)
    modes = _modes(scene, slopes, interval.held, float(speed[places[0]]), 0.0)
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
        oscillation = fit_oscillation(time[inside], torque[inside], mode.real, mode.imag)
        if oscillation is None:
            continue
        slopes = _slopes(scene, signals, interval, inside, oscillation.values(time[inside]) ** 2)
        vehicle = float(np.mean(speed[inside]))
        modes = _modes(scene, slopes, interval.held, vehicle, step)
        if modes is not None:
            mode = modes[0]
            yield _Window(oscillation, slopes, vehicle, step, *modes)


def _slopes(
    scene: Scene, signals: Signals, interval: _Interval, inside: Places, weights: Array | None
) -> dict[str, float]:
    """Return the slopes of the packs that rub, as means over places.

    Friction that changes along an oscillation counts with the square of the oscillation: with that
    weight the mean slope does the same work in a period (integrate by parts).
    """
    found = {}
    for pack in interval.rubbing:
        part = scene.parts[pack]
        values = capacity_slopes(part.params, part.fidelity, pack, signals, inside)
        found[pack] = float(np.average(values, weights=weights))
    return found


def _modes(
    scene: Scene, slopes: Mapping[str, float], held: tuple[str, ...], vehicle: float, step: float
) -> tuple[complex, complex] | None:
    """Return the eigenvalue of the mode without and with the master's part; None: there is none."""
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
    scene: Scene, time: Array, signals: Signals, interval: _Interval, found: list[_Window]
) -> Judder:
    """Return the verdict's numbers: means over the windows in which the oscillation is small."""
    gearbox = scene.parts["transmission"].params
    highest = max(found, key=lambda w: w.fit.amplitude)
    if highest is not found[0]:
        small = [w for w in found if w.fit.amplitude < SMALL * highest.fit.amplitude]
        found = small or found[:1]
    oscillation, mode, stepped = (
        sum(values) / len(found)
        for values in (
            [complex(w.fit.growth, w.fit.frequency) for w in found],
            [w.mode for w in found],
            [w.stepped for w in found],
        )
    )
    slopes = {p: float(np.mean([w.slopes[p] for w in found])) for p in interval.rubbing}
    pack = min(slopes, key=lambda p: slopes[p])
    vehicle = float(np.mean([w.vehicle for w in found]))
    half = 0.5 * PERIODS * 2.0 * math.pi / mode.imag
    locks, stuck_amplitude = _stick_slip(time, signals, pack, interval, 2.0 * math.pi / mode.imag)
    return Judder(
        pack=pack,
        start=found[0].fit.middle - half,
        end=found[-1].fit.middle + half,
        frequency=oscillation.imag / (2.0 * math.pi),
        growth=oscillation.real,
        amplitude=max(highest.fit.amplitude, stuck_amplitude),
        locks=locks,
        slope=slopes[pack],
        damping=gearbox.shaft_damping,
        limit_damping=damping_limit_of(gearbox, slopes, interval.held, vehicle),
        mode_frequency=mode.imag / (2.0 * math.pi),
        mode_growth=mode.real,
        step_growth=stepped.real - mode.real,
        step=float(np.mean([w.step for w in found])),
        scatter=float(np.std([w.fit.growth - w.mode.real for w in found])),
    )


def _stick_slip(
    time: Array, signals: Signals, pack: str, interval: _Interval, period: float
) -> tuple[int, float]:
    """Return how often the pack stuck from the interval on, and the oscillation [N m] meanwhile.

    Few lock-ups are the end of a shift, not stick-slip: then the oscillation is 0.
    """
    stuck = signals[f"transmission.{pack}_locked"] > 0.5
    locks = np.flatnonzero(stuck[1:] & ~stuck[:-1]) + 1
    locks = locks[locks > interval.places[0]]
    if len(locks) < FEW:
        return len(locks), 0.0
    torque = signals["transmission.shaft_torque"]
    spans = [(time > time[i] - period) & (time <= time[i]) for i in locks]
    return len(locks), max(0.5 * float(np.ptp(torque[s])) for s in spans)
