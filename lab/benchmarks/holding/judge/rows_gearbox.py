"""Eighty shifts of a two-speed gearbox with a motor and a vehicle: one verdict per shift.

Power-on upshifts and power-off downshifts in turn. Right: the oncoming pack locks once, within
forty steps of ideal packs, and stays; or the failure is told (status) before its tenth reversal.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .drive import HOLDING, INPUTS, LEVER, OUTPUTS, PACK, TELLING
from .plants import gearbox
from .rows_plants import Run, rng_of
from .units import Unit
from .verdict import LATE_OTHERS, Verdict, reversals, stays

SHIFTS, TOLD_BEFORE, PARTS = 80, 10, 3
EIGHTH = 8  # seeds per gearbox, which makes eighty shifts
KEEPS = 3.0  # 1/s, of the vehicle's speed


@dataclass(frozen=True)
class Shift:
    """What one shift does."""

    torque: float  # of the motor
    on: float  # capacity of the oncoming pack
    ramp: float  # s
    leaves: float  # s after the oncoming pack begins, when the other one is open
    on_pack: int


def shift_of(rng: np.random.Generator, up: bool) -> Shift:
    """Draw a shift; the oncoming pack has 1.3 to 2.5 times the torque that it will hold."""
    torque = rng.uniform(40, 200) if up else -rng.uniform(15, 60)
    need = abs(torque) * rng.uniform(1.3, 2.5) + (0 if up else 40)
    ramp = rng.uniform(0.05, 0.3)
    meets = ramp * min(1.0, abs(torque) / need)  # the new pack takes the whole torque
    return Shift(torque, need, ramp, meets * rng.uniform(0.6, 1.2), 1 if up else 0)


def shifting(fmu: str, seed: int, holding: str, step: float, age: int) -> list[Verdict]:
    """Run eighty shifts; ``age`` 0: the driveline takes the torques of this step."""
    rng = rng_of("gearbox", seed)
    h = step if step > 0 else 1e-3
    motor, vehicle = rng.uniform(0.05, 0.2), rng.uniform(1.0, 4.0)
    low, high = rng.uniform(2.4, 3.4), rng.uniform(1.0, 1.8)
    speed = rng.uniform(30, 70)
    plant = gearbox(motor, vehicle, (low, high), np.array([low * speed, speed]))
    inertia = [1 / (1 / motor + i**2 / vehicle) for i in (low, high)]
    torque, n = 100.0, round(0.9 / h)
    keeps = 300.0
    load = [keeps, 0.0]
    units = []
    for i, slip in enumerate(plant.slip):
        given: dict[str, float] = {"holding": HOLDING[holding]}
        if holding == "given":
            given |= {"coupling_inertia": inertia[i], "coupling_age": age}
        units.append(Unit(fmu, INPUTS, OUTPUTS, **(PACK | given)))
        units[-1].start(load=load[i] / LEVER, speed=slip)
    acted = [u.real[0] for u in units]
    verdicts = []
    for k in range(-1, SHIFTS):
        up = k % 2 == 0
        s = Shift(torque, keeps, 1e-3, 0.0, 0) if k < 0 else shift_of(rng, up)
        on, off = s.on_pack, 1 - s.on_pack
        ideal, right, slips, status = plant.copy(), [], [], []
        off_from = load[off] if k >= 0 else 0.0
        for m in range(n):
            t = m * h
            coming, going = min(1.0, t / s.ramp), max(0.0, 1.0 - t / max(s.leaves, h))
            if k < 0:
                load = [keeps, 0.0]
            else:
                load[on] = s.on * coming
                load[off] = off_from * going if s.leaves > 0 else 0.0
            # the road takes the motor's torque by the present ratio, and keeps the speed
            ratio = min(max(plant.state[0] / plant.state[1], high), low)
            road = ratio * s.torque + KEEPS * vehicle * (plant.state[1] - speed)
            slip = plant.slip
            slips.append(slip[on])
            right.append(ideal.slip[on])
            torques = []
            for i, unit in enumerate(units):
                unit.set(load[i] / LEVER, slip[i])
                unit.step((n * (k + 1) + m) * h, h)
                torques.append(unit.real[0])
            status.append(units[on].status)
            acted, now = torques, acted
            plant.advance((s.torque, road), torques if age == 0 else now, h)
            for _ in range(PARTS):
                ideal.advance_ideal((s.torque, road), load, h / PARTS)
        if k >= 0:
            verdicts.append(
                judged(np.array(slips), np.array(right), np.array(status), inertia[on], s.on, h)
            )
            verdicts[-1].why += (
                f" (shift {k}, {'up' if up else 'down'})" if not verdicts[-1].ok else ""
            )
    for unit in units:
        unit.close()
    return verdicts


def judged(slip, right, status, inertia: float, capacity: float, h: float) -> Verdict:
    """Judge the oncoming pack of one shift."""
    ds, first = capacity * h / inertia, np.abs(right).max()
    band = max(0.02 * first, 0.45 * ds)
    late = stays(slip, band) - stays(right, 0.5 * band)
    turns = reversals(slip, 0.02 * ds)
    telling = np.flatnonzero(np.isin(status, TELLING))
    turned = reversals(slip[: telling[0]], 0.02 * ds) if len(telling) else TOLD_BEFORE
    why = []
    if late > LATE_OTHERS:
        why.append(f"{late} steps late")
    if turns >= TOLD_BEFORE:
        why.append(f"{turns} reversals")
    return Verdict(not why, turned < TOLD_BEFORE, "; ".join(why), "", {"late": late})


def of(age: int) -> Run:
    """Return the row of an order of exchange; a gearbox for every eighth seed."""

    def one(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
        return [] if seed % EIGHTH else shifting(fmu, seed, holding, step, age)

    return one


GEARBOX: dict[str, Run] = {
    "80 shifts, clutches first": of(0),
    "80 shifts, all at once": of(1),
}
