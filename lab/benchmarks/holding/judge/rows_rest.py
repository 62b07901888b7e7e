"""Rows of units that rest beside each other, of saved states and of a long hold."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .drive import HOLDING, INPUTS, LEVER, OUTPUTS, PACK, TELLING, run
from .plants import gearbox, two_shafts
from .rows_plants import Run, drawn, engaged, rng_of, spread
from .units import Unit
from .verdict import Verdict, reversals

STEADY, STEPS, TURNS = 1e-3, 800, 10
MAP = 1  # the washer's quickest fidelity
LONG = 1_000_000


def beside(fmu: str, name: str) -> str:
    """Return another FMU of the same folder."""
    path = Path(fmu).with_name(f"{name}.fmu")
    if not path.exists():
        raise FileNotFoundError(f"{path}: build it beside {Path(fmu).name}")
    return str(path)


def told(*units: Unit) -> bool:
    """Tell whether a unit named the matter, and free them."""
    status = any(unit.status in TELLING for unit in units)
    found = status or any(unit.told() for unit in units)
    for unit in units:
        unit.close()
    return found


def washer_beside(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
    """Lock a shaft on which a washer rubs: both come to rest and stay."""
    d = drawn("washer", seed, step)
    capacity = max(d.capacity, 20.0)
    inertia = capacity * d.lock * d.step / d.first * 0.8
    held = -5.0 if seed == 0 else d.rng.uniform(-0.3, 0.5) * capacity
    age, h = seed % 2, d.step
    pack = Unit(
        fmu, INPUTS, OUTPUTS, **PACK, holding=HOLDING[holding],
        **({"coupling_inertia": inertia, "coupling_age": age} if holding == "given" else {}),
    )  # fmt: skip
    washer = Unit(beside(fmu, "ThrustWasher"), INPUTS, ("friction_torque", "energy"), fidelity=MAP)
    pack.start(load=0.1 * capacity / LEVER, speed=d.first)
    washer.start(load=300.0, speed=d.first)
    w, acted, rows = d.first, [pack.real[0], washer.real[0]], []
    for k in range(d.lock * 2 + STEPS):
        press = capacity * min(1.0, 0.1 + 0.9 * k * h / d.ramp)
        pack.set(press / LEVER, w)
        washer.set(300.0, w)
        pack.step(k * h, h)
        washer.step(k * h, h)
        now = [pack.real[0], washer.real[0]]
        use = now if age == 0 else acted
        w += h * (held - use[0] - use[1]) / inertia
        acted = now
        rows.append((w, *now))
    slip, torque, rub = np.array(rows)[-STEPS // 2 :].T
    why = []
    if np.ptp(torque) > STEADY * capacity:
        why.append(f"pack {torque.min():.4g} .. {torque.max():.4g} N m")
    if abs(torque.mean() + rub.mean() - held) > STEADY * capacity:
        why.append(f"pack and washer hold {torque.mean() + rub.mean():.4g} for {held:.4g} N m")
    if reversals(rub, 1e-3 * np.abs([r[2] for r in rows]).max()) > 3:
        why.append("washer reverses")
    if np.abs(slip).max() > 0.02 * d.first:
        why.append(f"slip {np.abs(slip).max():.3g} rad/s")
    return [Verdict(not why, told(pack, washer), "; ".join(why))]


def at_rest(names: tuple[str, ...], loaded: bool):
    """Return the row of losses on one shaft that spins down, and may stay under a small torque."""

    def one(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
        rng = rng_of("rest", seed)
        h = step if step > 0 else spread(rng, (1e-4, 5e-3))
        speed = {"GearTrain": "speed", "DrivelineLosses": "input_speed"}
        output = {"GearTrain": "loss_torque", "DrivelineLosses": "input_torque"}
        units = [Unit(beside(fmu, name), (speed[name],), (output[name],)) for name in names]
        first, age = spread(rng, (2.0, 50.0)), seed % 3
        for name, unit in zip(names, units, strict=True):
            more = {"torque": 0.0} if name == "GearTrain" else {"output_speed": 0.0}
            more |= {"drum_speed": 0.0, "planet_speed": 0.0} if name != "GearTrain" else {}
            unit.start(**{speed[name]: first}, **more)
        scale = sum(u.real[0] for u in units)
        n, steps = 0, spread(rng, (15, 200))
        inertia = scale * h * steps / first
        push = rng.uniform(-0.5, 0.5) * scale if loaded else 0.0
        w, waiting, rows = first, [scale] * age, []
        for n in range(round(8 * steps) + STEPS):
            for unit in units:
                unit.set(w)
                unit.step(n * h, h)
            waiting.append(sum(u.real[0] for u in units))
            loss = waiting.pop(0)
            w += h * ((push if n > 4 * steps else 0.0) - loss) / inertia
            rows.append((w, loss))
        slip, loss = np.array(rows).T
        end, why = slice(-STEPS // 2, None), []
        turns = reversals(loss[round(2 * steps) :], 0.01 * scale)
        if turns >= TURNS:
            why.append(f"{turns} reversals, {loss[end].min():.3g} .. {loss[end].max():.3g} N m")
        if np.ptp(loss[end]) > 0.02 * scale:
            why.append(f"torque {loss[end].min():.3g} .. {loss[end].max():.3g} N m at rest")
        if np.abs(slip[end]).max() > 0.1 * first:
            why.append(f"speed {np.abs(slip[end]).max():.2g} of {first:.2g} rad/s")
        return [Verdict(not why, told(*units), "; ".join(why))]

    return one


def slipping_beside(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
    """One pack holds a gear while the other one slips: no dips from step 12 on."""
    rng = rng_of("beside", seed)
    h = step if step > 0 else spread(rng, (1e-4, 5e-3))
    motor, vehicle = spread(rng, (0.05, 0.3)), spread(rng, (1.0, 10.0))
    low, high, speed = rng.uniform(2.0, 3.5), rng.uniform(0.9, 1.8), rng.uniform(20, 80)
    plant = gearbox(motor, vehicle, (low, high), np.array([low * speed * 1.3, speed]))
    torque, slips = rng.uniform(50, 150), rng.uniform(0.1, 0.4)
    inertia = [1 / (1 / motor + i**2 / vehicle) for i in (low, high)]
    age = seed % 3
    units = []
    for i in range(2):
        more: dict[str, float] = {"holding": HOLDING[holding]}
        if holding == "given":
            more |= {"coupling_inertia": inertia[i], "coupling_age": age}
        units.append(Unit(fmu, INPUTS, OUTPUTS, **(PACK | more)))
    partly = slips * torque
    load = [3.0 * torque, partly]
    for unit, c, slip in zip(units, load, plant.slip, strict=True):
        unit.start(load=c / LEVER, speed=slip)
    waiting = [[u.real[0] for u in units]] * age
    rows, dips = [], []
    n = round(0.6 / h) if h > 5e-4 else 1200
    road = low * torque - (low - high) * partly  # what reaches the vehicle at a constant speed
    for k in range(n):
        slip = plant.slip
        for i, unit in enumerate(units):
            unit.set(load[i] / LEVER, slip[i])
            unit.step(k * h, h)
        now = [u.real[0] for u in units]
        waiting.append(now)
        acted = waiting.pop(0)
        plant.advance((torque, road), acted, h)
        rows.append((*slip, *now))
        dips.append(abs(now[1]) < 0.999 * partly)
    slip_a, _, tau_a, _ = np.array(rows)[n // 2 :].T
    share = float(np.mean(dips[n // 2 :]))
    why = []
    if share:
        why.append(f"slipping pack below capacity in {100 * share:.0f} % of steps")
    if np.ptp(tau_a) > STEADY * load[0]:
        why.append(f"locked pack {tau_a.min():.5g} .. {tau_a.max():.5g} N m")
    if np.abs(slip_a).max() > 0.02 * low * speed * 0.3:
        why.append(f"slip of the locked pack {np.abs(slip_a).max():.3g} rad/s")
    return [Verdict(not why, told(*units), "; ".join(why), "", {"dips": share})]


def restored(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
    """Save a state in the first 30 steps and near the lock: it goes on with the same bits."""
    scene = engaged(drawn("state", seed, step), seed)
    rng = rng_of("state at", seed)
    trace = run(fmu, scene, holding)
    slip, t, h = trace.slip[:, 0], trace.times.tolist(), trace.steps.tolist()
    unit = Unit(fmu, INPUTS, OUTPUTS, **PACK, holding=HOLDING[holding],
                **({"coupling_inertia": scene.inertia[0], "coupling_age": scene.age}
                   if holding == "given" else {}))  # fmt: skip
    unit.start(load=scene.load(0.0, [0.0])[0] / LEVER, speed=slip[0])
    lock = len(slip) - 220
    marks = {int(rng.integers(0, 30)), int(rng.integers(max(0, lock - 15), lock + 15))}
    states, why = {}, []
    for k, s in enumerate(slip):
        if k in marks:
            states[k] = unit.save()
        unit.set(scene.load(t[k], [s])[0] / LEVER, s)
        unit.step(t[k], h[k])
    for k, state in states.items():
        unit.restore(state)
        for m in range(k, min(len(slip), k + 100)):
            unit.set(scene.load(t[m], [slip[m]])[0] / LEVER, slip[m])
            unit.step(t[m], h[m])
            now = (unit.real[0], unit.real[unit.at["energy"]], unit.locked)
            if now != (trace.torque[m, 0], trace.energy[m, 0], trace.locked[m, 0]):
                why.append(f"saved at {k}: other bits at {m}")
                break
    return [Verdict(not why, told(unit), "; ".join(why))]


def long_hold(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
    """Hold for a million steps."""
    d = drawn("million", seed, step)
    plant = two_shafts(d.j1, d.j2, d.base + d.first, d.base)
    unit = Unit(fmu, INPUTS, OUTPUTS, **PACK, holding=HOLDING[holding],
                **({"coupling_inertia": d.inertia} if holding == "given" else {}))  # fmt: skip
    unit.start(load=d.strength(0.0) / LEVER, speed=d.first)
    slip, h, most, error = d.first, d.step, 0.0, 0.0
    del plant
    for k in range(LONG):
        unit.set(d.strength(k * h) / LEVER, slip)
        unit.step(k * h, h)
        slip += h * (d.held - unit.real[0]) / d.inertia
        if k > 2 * d.lock + 100:
            most = max(most, abs(slip))
            error = max(error, abs(unit.real[0] - d.held))
    error /= d.capacity
    why = []
    if error > STEADY:
        why.append(f"torque off by {error:.2g} C")
    if most > 0.02 * d.first:
        why.append(f"slip {most:.3g} rad/s")
    return [Verdict(not why, told(unit), "; ".join(why), "", {"error": error, "slip": most})]


def changed(factors: tuple[float, float]) -> Run:
    """Return the row of a driveline whose second inertia changes while the pack holds.

    The torque to hold stays, in every second run it jumps.

    Right: 200 steps later it is at rest and locked, and has given back to the shafts at most three
    times (1 + d) of what the capacity makes of its own slip in a step.
    """

    def one(fmu: str, seed: int, holding: str, step: float) -> list[Verdict]:
        d = drawn(f"changed {factors}", seed, step)
        plant, h, age = two_shafts(d.j1, d.j2, d.base + d.first, d.base), d.step, seed % 3
        j2 = d.j2 * spread(d.rng, factors)
        inertia = d.j1 * j2 / (d.j1 + j2)
        held = d.held if seed % 2 else d.rng.uniform(-0.5, 0.7) * d.capacity
        push = (d.push[0], j2 * (held / inertia - d.push[0] / d.j1))
        unit = Unit(fmu, INPUTS, OUTPUTS, **PACK, holding=HOLDING[holding])
        unit.start(load=d.strength(0.0) / LEVER, speed=d.first)
        waiting, rows = [unit.real[0]] * age, []
        first = d.lock + 80
        for k in range(first + 260):
            if k == first:
                plant = two_shafts(d.j1, j2, *plant.state)
            slip = plant.slip[0]
            unit.set(d.strength(k * h) / LEVER, slip)
            unit.step(k * h, h)
            waiting.append(unit.real[0])
            acted = waiting.pop(0)
            plant.advance(push if k >= first else d.push, [acted], h)
            mean = 0.5 * (slip + plant.slip[0])
            rows.append((slip, acted * mean * h, unit.locked, *unit.real))
        table = np.array(rows, float)[first:]
        slip, work, locked, bound = (table[:, i] for i in (0, 1, 2, 3 + unit.at["slip_bound"]))
        made = d.capacity * h / inertia
        why, broken = [], []
        if np.abs(slip[-60:]).max() > 0.02 * made:
            why.append(f"slip {np.abs(slip[-60:]).max() / made:.2g} of that of a step")
        if not locked[-1]:
            why.append("not locked")
        drove = -work[work < 0.0].sum() / (d.capacity * made * h)
        if drove > 3.0 * (1 + age):
            why.append(f"drives, by {drove:.3g} of a step")
        lies = (locked > 0.0) & (np.abs(slip) > np.minimum(bound * (1 + 1e-9), made + d.first))
        if lies.any():
            broken.append(f"locked at slip in {int(lies.sum())} steps")
        if (np.diff(table[:, 3 + unit.at["energy"]]) < 0.0).any():
            broken.append("energy falls")
        numbers = {"drove": float(drove), "slip": float(np.abs(slip).max() / made)}
        return [Verdict(not why, told(unit), "; ".join(why), "; ".join(broken), numbers)]

    return one


REST: dict[str, Run] = {
    "washer next to a locked pack": washer_beside,
    "train at rest": at_rest(("GearTrain",), False),
    "train under a small torque": at_rest(("GearTrain",), True),
    "losses at rest": at_rest(("DrivelineLosses",), False),
    "losses under a small torque": at_rest(("DrivelineLosses",), True),
    "train and losses at rest": at_rest(("GearTrain", "DrivelineLosses"), False),
    "a pack slips next to a locked one": slipping_beside,
    "state restored": restored,
    "shaft 3 .. 1000 times heavier in the hold": changed((3.0, 1e3)),
    "shaft 3 .. 1000 times lighter in the hold": changed((1e-3, 1.0 / 3.0)),
}
SLOW: dict[str, Run] = {"a million held steps": long_hold}
