"""The key figures of a shift and its energy balance, read from its signals."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ...numerics.jit import Array
from ...transmission.kernels import shift_figures as K
from ..oscillation.judder import Judder, judder_figures
from ..scene.connections import MESHES, PACKS, SPEED
from ..scene.scene import Scene
from ..warning_texts import scope_of
from .comfort import comfort_figures, phase_figures
from .events_and_phases import Event, Signals, lock_up, turning
from .figure_list import FIGURES, FILM_SPEED, Found, KeyFigure, assemble

FULL = 0.999  # of the friction at lock-up: a little slip above the plateau is still full friction
LOSSES = {  # figure -> source of loss
    "pump_loss": "pump",
    "churning_loss": "churning",
    "rolling_loss": "bearing",
    "seal_loss": "seal",
}


def key_figures(
    scene: Scene, time: Array, signals: Signals, events: list[Event], judder: Judder | None = None
) -> list[KeyFigure]:
    """Return the numbers a shift is evaluated by, SI units; None where there is no such thing."""
    start, pack, other = scene.shift_start, scene.engaging, scene.releasing
    lock = lock_up(scene, events)
    middle = None if scene.kiss_end is not None else start + 0.5 * scene.shift_duration
    releases = (e.time for e in events if e.kind == f"{other}_released" and e.time >= start)
    release, end = next(releases, None), slip_end(scene, time, signals)
    found: Found = {
        "lock_time": (lock, None),
        "lock_after_ramp_start": (None if lock is None else lock - start, None),
        "lock_after_half_ramp": (None if lock is None or middle is None else lock - middle, None),
        "release_time": (release, None),
        **read_off(scene, time, signals),
        **_slip(scene, time, signals, lock),
        "shift_heat": (shift_heat(scene, time, signals, end), None),
        **friction_figures(scene, time, signals, lock),
        **pack_figures(scene, "clutch", time, signals),
        **pack_figures(scene, "brake", time, signals),
        **tie_up_figures(scene, time, signals),
        **phase_figures(scene, signals, events, lock),
        **comfort_figures(scene, time, signals, lock, None if end is None else float(time[end])),
        **judder_figures(judder),
        **loss_figures(scene, time, signals),
    }
    if "washer.friction_torque" in signals:
        lost = (signals["washer.distress"] > 0.5) & turning(signals)
        found["washer_distress_time"] = (float(np.sum(np.diff(time)[lost[1:]])), None)
    if not scene.alone:
        found["lock_speed"] = (_engine_speed(scene, time, signals, lock), None)
    return assemble(found, pack, other)


def _engine_speed(scene: Scene, time: Array, signals: Signals, lock: float | None) -> float | None:
    """Return the engine's speed at lock-up; the transmission itself keeps the clutch's last one.

    When the brake locks, the drum rests and the engine runs at 1 + r times the output.
    """
    if lock is None:
        return None
    if scene.engaging == "clutch":
        return float(signals["transmission.lock_speed"][np.searchsorted(time, lock)])
    gearbox = scene.parts["transmission"].params
    ratio = 1.0 + gearbox.ratio
    return float(ratio * np.interp(lock, time, signals["transmission.output_speed"]))


def read_off(scene: Scene, time: Array, signals: Signals) -> Found:
    """Return the figures that are read off one signal each; of what is not in use none."""
    packs = {"pack": scene.engaging, "other": scene.releasing}
    there = {part for part in scene.parts if part not in PACKS or in_use(part, signals)}
    if any(scene.bearings.values()):
        there.add("bearings")
    if "mesh" in there:
        paper = getattr(scene.parts["mesh"].params, "film_heat", "atan") == "atan"
        there |= {"meshes"} if paper else {"meshes", "bodies"}
    found: Found = {}
    for name, figure in FIGURES.items():
        if not figure.reading:
            continue
        reading, signal, *condition = figure.reading.format(**packs).split()
        part, _, quantity = signal.partition(".")
        if not {part, *condition[1:]} <= there:
            continue
        of_one = {part: signals[signal]} if signal in signals else {}
        known = of_all(scene, signals, quantity) if part == "meshes" else of_one
        if known:
            extreme = np.minimum if reading in ("minimum", "turning") else np.maximum
            speed = signals.get(f"{next(iter(known))}.{SPEED}", time)
            values: Array = extreme.reduce(list(known.values()))
            found[name] = READINGS[reading](values, time, speed)
    return found


def of_all(scene: Scene, signals: Signals, quantity: str) -> Signals:
    """Return a signal, or the sum of two ("a+b"), of all meshes in which it has a value."""
    found: Signals = {}
    for name in (name for name in MESHES if name in scene.parts):
        mesh, own = scene.parts[name], quantity.split("+")
        known = all(f"{name}.{one}" in signals for one in own)
        if known and mesh.spec.absent(mesh.params).isdisjoint(own):
            found[name] = np.sum([signals[f"{name}.{one}"] for one in own], axis=0)
    return found


def _slip(scene: Scene, time: Array, signals: Signals, lock: float | None) -> Found:
    """Return heat and power of the pack that engages, and the inertia that it stops alone."""
    pack = scene.engaging
    heat = float(signals[f"transmission.{pack}_heat"][-1])
    greatest = float(np.max(np.abs(signals[f"transmission.{pack}_speed"])))
    area = scene.parts[pack].params.lining_area
    found: Found = {
        "slip_energy_per_area": (heat / area, None),
        "peak_power": peak(np.abs(signals[f"{pack}.friction_power"]), time),
    }
    if scene.alone and lock is not None and greatest > 0.0:
        found["stopped_inertia"] = (2.0 * heat / greatest**2, None)
    return found


def slip_end(scene: Scene, time: Array, signals: Signals) -> int | None:
    """Return the point in time from which no pressed pack slips any more; None if one still does.

    A pack without load may turn on: it drags, but takes no part in the shift.
    """
    own = [signals[f"transmission.{pack}_{n}"] for pack in PACKS for n in ("load", "speed")]
    points, *rows = map(np.ascontiguousarray, (time, *own))
    end = K.slip_end(points, rows[0], rows[1], rows[2], rows[3], scene.shift_start)
    return None if end < 0 else end


def shift_heat(scene: Scene, time: Array, signals: Signals, end: int | None) -> float | None:
    """Return the heat [J] of both packs from the start of the shift to the end of its last slip."""
    if end is None:
        return None
    heat = np.sum([signals[f"transmission.{pack}_heat"] for pack in PACKS], axis=0)
    return float(K.shift_heat(np.ascontiguousarray(time), heat, scene.shift_start, end))


def energy_balance(signals: Signals) -> dict[str, float]:
    """Return every entry of the energy balance [J] and its errors with their shares.

    ``residual`` is the energy that no entry accounts for; its share is of the engine's work or, in
    a run without engine, of the kinetic energy that changed hands. ``coupling_difference`` is the
    clutch's heat on the mechanical side minus the heat its thermal side has booked: the error of
    exchanging signals once per step; its share is of that heat. Likewise for the brake.
    """

    def last(name: str) -> float:
        return float(signals[name][-1]) if name in signals else 0.0

    balance = {
        "engine_work": last("transmission.engine_work"),
        "kinetic": last("transmission.kinetic_change"),
        "load_work": last("transmission.load_work"),
        "clutch": last("transmission.clutch_heat"),
        "brake": last("transmission.brake_heat"),
        "washers": last("transmission.washer_heat"),
        "meshes": last("transmission.mesh_heat"),
        "bearings": last("transmission.bearing_heat"),
        "losses": last("transmission.loss_heat"),
        "shaft": last("transmission.shaft_heat"),
        "spring": last("transmission.shaft_energy"),
        "residual": last("transmission.energy_residual"),
    }
    whole = abs(balance["engine_work"]) or abs(balance["kinetic"])
    balance["residual_share"] = abs(balance["residual"]) / whole if whole else 0.0
    for pack, prefix in (("clutch", ""), ("brake", "brake_")):
        difference = balance[pack] - last(f"{pack}.energy")
        share = abs(difference) / balance[pack] if balance[pack] else 0.0
        balance[f"{prefix}coupling_difference"] = difference
        balance[f"{prefix}coupling_difference_share"] = share
    return balance


def loss_figures(scene: Scene, time: Array, signals: Signals) -> Found:
    """Return the heat of oil pump, churning, bearings and seals: that of the balance, divided.

    In each step the balance's heat is divided as the powers are at its end.
    """
    if "losses" not in scene.parts:
        return {}
    powers = {name: signals[f"losses.{source}_power"][1:] for name, source in LOSSES.items()}
    heat, whole = np.diff(signals["transmission.loss_heat"]), sum(powers.values())
    each = np.divide(heat, whole, out=np.zeros_like(heat), where=whole > 0.0)
    return {name: (float(np.sum(power * each)), None) for name, power in powers.items()}


def peak(values: Array, time: Array) -> tuple[float, float]:
    """Return the largest value and its time."""
    i = int(np.argmax(values))
    return float(values[i]), float(time[i])


def least(values: Array, time: Array) -> tuple[float | None, float | None]:
    """Return the minimum value and its time."""
    i = int(np.argmin(values))
    return (float(values[i]), float(time[i])) if np.isfinite(values[i]) else (None, None)


def in_use(pack: str, signals: Signals) -> bool:
    """Tell if a pack is ever pressed."""
    return bool(np.any(signals[f"{pack}.load"] > 0.0))


def carried_torque(pack: str, signals: Signals) -> Array:
    """Return the size of the torque that a pack carries [N m].

    A locked pack carries what the driveline asks of it. A slipping one carries its own friction:
    the driveline's reading of that overshoots for a step where the extrapolated capacity has a
    corner.
    """
    locked = signals[f"transmission.{pack}_locked"] > 0.5
    reaction, own = signals[f"transmission.{pack}_reaction"], signals[f"{pack}.friction_torque"]
    return np.abs(np.where(locked, reaction, own))


def pack_figures(scene: Scene, pack: str, time: Array, signals: Signals) -> Found:
    """Return the heat, flux and share of oil of one pack; of one in use only."""
    if not in_use(pack, signals):
        return {}
    area = scene.parts[pack].params.lining_area
    found: Found = {
        f"peak_{pack}_torque": peak(carried_torque(pack, signals), time),
        f"{pack}_heat_per_area": (float(signals[f"transmission.{pack}_heat"][-1]) / area, None),
        f"peak_{pack}_heat_flux": peak(np.abs(signals[f"{pack}.friction_power"]) / area, time),
    }
    if f"{pack}.oil_heat" in signals:
        given = float(np.sum(signals[f"{pack}.oil_heat"][1:] * np.diff(time)))
        found[f"{pack}_oil_heat"] = (given, None)
    if f"{pack}.viscous_torque" in signals:
        slip = signals[f"{pack}.speed"]
        oil, whole = (
            float(np.trapezoid(np.abs(signals[f"{pack}.{name}"] * slip), time))
            for name in ("viscous_torque", "friction_torque")
        )
        found[f"{pack}_viscous_share"] = (oil / whole if whole > 0.0 else None, None)
    return found


def friction_figures(scene: Scene, time: Array, signals: Signals, lock: float | None) -> Found:
    """Return the coefficient of the pack that engages, along its slip.

    The mean is the torque integrated over time by load, effective radius and faces integrated over
    time: with constant load the harmonic mean of the coefficient over speed, which is what a
    braking time measures. A coefficient belongs to the slip that the pack itself was given.
    """
    pack, start = scene.engaging, scene.shift_start
    coefficient = signals[f"{pack}.friction_coefficient"]
    slip = np.abs(signals[f"{pack}.speed"])
    stop = time[-1] if lock is None else lock
    during = np.flatnonzero((time >= start) & (time < stop) & (slip > 0.0))
    names = ("friction_start", "friction_middle", "friction_lock", "friction_mean")
    if len(during) < 2:
        return dict.fromkeys(names, (None, None))
    first, last = during[0], during[-1]
    middle = during[int(np.argmin(np.abs(slip[during] - 0.5 * slip[first])))]
    found: Found = {
        "friction_start": (float(coefficient[first]), float(time[first])),
        "friction_middle": (float(coefficient[middle]), float(time[middle])),
        "friction_lock": (None, None),
        "friction_mean": (_mean_friction(scene, time[during], signals, during), None),
    }
    if lock is not None:
        found["friction_lock"] = (float(coefficient[last]), float(time[last]))
        less = during[coefficient[during] < FULL * coefficient[last]]
        falls = np.max(coefficient[during]) * FULL <= coefficient[last]  # else nothing is full
        if falls and len(less) and less[-1] < last:
            pair = slice(less[-1], less[-1] + 2)
            full = FULL * coefficient[last]
            speed, when = (np.interp(full, coefficient[pair], v[pair]) for v in (slip, time))
            found["full_friction_speed"] = (float(speed), float(when))
    return found


def _mean_friction(
    scene: Scene, time: Array, signals: Signals, during: NDArray[np.intp]
) -> float | None:
    """Return the mean coefficient behind the torque of the slipping pack."""
    pack, params = scene.engaging, scene.parts[scene.engaging].params
    torque = np.abs(signals[f"transmission.{pack}_reaction"][during])
    load = signals[f"transmission.{pack}_load"][during]
    pressed = float(np.trapezoid(load, time)) * params.friction_radius * params.faces
    return float(np.trapezoid(torque, time)) / pressed if pressed > 0.0 else None


def tie_up_figures(scene: Scene, time: Array, signals: Signals) -> Found:
    """Return duration, torque and heat of a tie-up; nothing where the packs hand over cleanly.

    It begins when the torque of the pack that lets go changes its sign, and ends when that pack is
    no longer pressed. The heat is what it takes up meanwhile.
    """
    names = {"time": time, "releasing": scene.releasing, "shift_start": scene.shift_start}
    run = scope_of(names, signals)
    if not run["ties"]:
        return {}
    return {
        "tie_up_duration": (float(run["tie_up_duration"]), float(run["tie_up_begin"])),
        "tie_up_torque": (float(run["tie_up_torque"]), float(run["tie_up_time"])),
        "tie_up_heat": (float(run["tie_up_heat"]), None),
    }


def least_turning(values: Array, time: Array, speed: Array) -> tuple[float | None, float | None]:
    """Return the minimum value above FILM_SPEED, and its time.

    Where the speed passes FILM_SPEED between two samples the value is interpolated to that speed:
    the figure must not depend on where the samples happen to lie. A film ratio belongs to the speed
    that the part itself was given.
    """
    speed = np.abs(speed)
    fast = speed >= FILM_SPEED
    i = np.flatnonzero(fast[1:] != fast[:-1])
    done = (FILM_SPEED - speed[i]) / (speed[i + 1] - speed[i])
    found, times = (
        np.concatenate((v[fast], v[i] + done * (v[i + 1] - v[i]))) for v in (values, time)
    )
    return least(found, times) if len(found) else (None, None)


# What a figure is of a signal, its time and the part's speed.
READINGS: dict[str, Callable[[Array, Array, Array], tuple[float | None, float | None]]] = {
    "maximum": lambda values, time, _: peak(values, time),
    "minimum": lambda values, time, _: least(values, time),
    "turning": least_turning,
    "margin": lambda values, time, _: least(1.0 - values, time),
    "size": lambda values, time, _: peak(np.abs(values), time),
    "last": lambda values, *_: (float(values[-1]), None),
}
