"""Rows of prescribed slip: nothing answers, so that a pack can only slide.

Right is the heat of sliding, to 1 % at the end and at every time from 0.1 s on, and nothing that no
unit may do: torque that drives, booked heat or temperature that falls, ``locked`` beyond
``slip_bound``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from . import traces
from .drive import HOLDING, INPUTS, LEVER, OUTPUTS, PACK, TELLING
from .plants import two_shafts
from .rows_plants import Run, drawn, rng_of, spread
from .units import Unit
from .verdict import FALL, Verdict

STEPS, WITHIN, FROM = 2000, 0.01, 0.1  # of a run; of the heat; s
STEP_RANGE = (1e-4, 1e-2)  # s, where any step is asked for


def pack(fmu: str, holding: str, load: float, slip: float, inertia: float = 0.1) -> Unit:
    """Return a pack at its first point; ``given`` is told something, as a host would."""
    more: dict[str, float] = {"holding": HOLDING[holding]}
    if holding == "given":
        more |= {"coupling_inertia": inertia, "coupling_age": 1}
    unit = Unit(fmu, INPUTS, OUTPUTS, **(PACK | more))
    unit.start(load=load / LEVER, speed=slip)
    return unit


def stepped(unit: Unit, slip: Any, capacity: Any, h: float, t: float = 0.0) -> np.ndarray:
    """Step a unit along slips and capacities; return outputs, locked and status of each step."""
    rows = []
    for k, (s, c) in enumerate(zip(slip.tolist(), capacity.tolist(), strict=True)):
        unit.set(c / LEVER, s)
        unit.step(t + k * h, h)
        rows.append((*unit.real, unit.locked, unit.status))
    return np.array(rows, float)


def judged(unit: Unit, slip: Any, rows: np.ndarray, h: float, before: float = 0.0) -> Verdict:
    """Judge a run along a prescribed slip; ``before``: heat booked when it began."""
    at = unit.at
    torque, energy = rows[:, at["friction_torque"]], rows[:, at["energy"]]
    capacity, heat = rows[:, at["torque_capacity"]], rows[:, at["temperature"]]
    status = rows[:, -1].astype(int)
    scale = np.abs(capacity).max()
    sliding, mine = np.cumsum(capacity * np.abs(slip)) * h, np.cumsum(torque * slip) * h
    drives = torque * slip < -1e-9 * scale * np.abs(slip).max()
    some = sliding > 1e-3 * sliding[-1]
    late = some & (np.arange(1, len(slip) + 1) * h > FROM - 1e-9)
    ratio = mine[some] / sliding[some]
    after = (mine[late] / sliding[late]) if late.any() else ratio[-1:]
    end = mine[-1] / sliding[-1]
    booked = (energy[-1] - before) / sliding[-1]
    why, broken = [], []
    if abs(end - 1) > WITHIN:
        why.append(f"heat {end:.3g} of sliding")
    if abs(booked - 1) > WITHIN:
        why.append(f"energy {booked:.3g} of sliding")
    if np.abs(after - 1).max() > WITHIN:
        why.append(f"heat {after[np.argmax(np.abs(after - 1))]:.3g} of sliding on the way")
    if drives.any():
        broken.append(f"drives in {int(drives.sum())} of {len(slip)} steps")
    fall = np.diff(energy, prepend=before)
    if fall.min() < -FALL * max(energy.max(), 1e-300):
        broken.append(f"energy falls by {-fall.min() / energy.max():.2g} of all")
    # cooling takes at most what an open pack loses: heat over oil falls by less than 2 % in a step
    cold = np.diff(heat, prepend=heat[0])
    if (cold < -max(0.02, 2 * h) * (heat - heat.min() + 1e-3)).any():
        broken.append(f"temperature falls by {-cold.min():.3g} K")
    bound = rows[:, at["slip_bound"]] if "slip_bound" in at else 0.1 * np.abs(slip).max()
    lies = (rows[:, -2] > 0) & (np.abs(slip) > bound * (1 + 1e-9))
    if lies.any():
        broken.append(f"locked at slip in {int(lies.sum())} steps")
    if not np.isfinite(rows).all():
        broken.append("not finite")
    told = bool(unit.told()) or bool(np.isin(status, TELLING).any()) or unit.failed > 0
    numbers = {
        "end": end,
        "least": float(after.min()),
        "created": float((-torque * slip)[drives].sum() * h),
    }
    ok = not why and not broken
    return Verdict(ok, told, "; ".join(why), "; ".join(broken), numbers)


def along(name: str, make: Callable[..., np.ndarray], ripple: bool = False) -> Run:
    """Return the row of a trace."""

    def one(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
        rng = rng_of(name, seed)
        h = step if step > 0 else spread(rng, STEP_RANGE)
        slip = make(rng, STEPS)
        capacity = np.full(STEPS, spread(rng, (5.0, 60.0)))
        if ripple:
            capacity = capacity * traces.rippling(slip, rng)
        if rng.random() < 0.5:
            capacity *= np.minimum(1.0, 0.05 + np.arange(STEPS) / rng.uniform(20, 300))
        unit = pack(fmu, holding, capacity[0], slip[0])
        verdict = judged(unit, slip, stepped(unit, slip, capacity, h), h)
        unit.close()
        return [verdict]

    return one


def one_long_step(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
    """Make a single step of 10 s at one slip."""
    rng = rng_of("long", seed)
    slip = np.array([spread(rng, (0.1, 20.0)) * rng.choice([-1, 1])])
    capacity = np.array([spread(rng, (5.0, 60.0))])
    unit = pack(fmu, holding, capacity[0], slip[0])
    verdict = judged(unit, slip, stepped(unit, slip, capacity, 10.0), 10.0)
    unit.close()
    return [verdict]


def after_a_lock(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
    """Let a driveline answer until the pack holds; then the host prescribes a sine."""
    d = drawn("taken over", seed, step)
    plant = two_shafts(d.j1, d.j2, d.base + d.first, d.base)
    unit = pack(fmu, holding, d.strength(0.0), d.first, d.inertia)
    h, n = d.step, d.lock + 80
    acted = unit.real[0]
    for k in range(n):
        unit.set(d.strength(k * h) / LEVER, plant.slip[0])
        unit.step(k * h, h)
        plant.advance(d.push, [acted], h)
        acted = unit.real[0]
    before = unit.real[unit.at["energy"]]
    size = d.first * spread(d.rng, (0.02, 1.0))
    period = spread(d.rng, (10, 200))
    slip = size * np.sin(2 * np.pi * np.arange(1000) / period)
    capacity = np.full(1000, d.capacity)
    rows = stepped(unit, slip, capacity, h, n * h)
    verdict = judged(unit, slip, rows, h, before)
    unit.close()
    return [verdict]


SLIP: dict[str, Run] = {
    **{name: along(name, make) for name, make in traces.TRACES.items()},
    "load ripples with the slip": along("load ripple", traces.sine, ripple=True),
    "prescribed after a lock": after_a_lock,
    "one step of 10 s": one_long_step,
}
