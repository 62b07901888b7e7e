"""A pack stepped along a recording: slip as recorded, or from the balance of torques."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ....clutch.kernels import advance as clutch_advance
from ....clutch.kernels import layout as k
from ....clutch.kernels import pack_outputs, rates
from ....clutch.solve import prepare
from ....errors import ParameterError, Status
from ....native.load import bound
from ....numerics.jit import Array
from ..traces.binned import OFF, Run
from ..traces.traced import History
from .traced_pack import TracedPack

SLIDES = 0.05  # of the largest slip: below it is near its end
WARMER = 1.0  # K
FIRST = 3  # means at the start that a measured temperature is taken from


@dataclass(frozen=True)
class Way:
    """What a pack did along a run, (m,) each."""

    torque: Array  # [N m]
    temperature: Array  # [K]
    slip: Array  # [rad/s]


def starts_engaged(run: Run, load: Array) -> bool:
    """Return whether a run begins under ``load`` [N], not at the point before it rises."""
    return bool(run.engaged[0] and load[0] > OFF * np.max(load))


def walk_pack(params: TracedPack, fidelity: str, run: Run) -> History | Status:
    """Return torque, temperature and slip along a run, (m,) each, or why there are none."""
    load = pressing_force(params, run)
    pack = params.pack()
    if starts_engaged(run, load) and not pack.starts_pressed:
        pack = replace(pack, starts_pressed=True)
    par, begin = prepare(pack, fidelity), run.inputs["speed"]
    warm = _start_temperature(run)
    way = _stepped(par, params, run, load, begin, warm)
    if not isinstance(way, Status) and "temperature" in run.values:
        other = _stepped(par, params, run, load, begin, warm + WARMER)
        if not isinstance(other, Status):
            warm += _colder(run, way.temperature, other.temperature)
        way = _stepped(par, params, run, load, begin, warm)
    if not isinstance(way, Status) and params.inertia and "slip" in run.values:
        way = _stepped(par, params, run, load, begin + _late(run, way.slip), warm)
    if isinstance(way, Status):
        return way
    torque = way.torque
    if params.inertia_between:
        hub = way.slip + run.inputs["drum_speed"]
        torque = torque + params.inertia_between * np.gradient(hub, run.time)
    torque = torque + params.torque_offset
    return {"friction_torque": torque, "temperature": way.temperature, "slip": way.slip}


def slip_by_torque(run: Run, rig: TracedPack) -> Run:
    """Return a run whose slip, while engaged, follows from its recorded torque.

    Each engagement begins with the slip that the run has there. What turns between the faces and
    the sensor is not slowed through it.
    """
    known = np.isfinite(run.values["friction_torque"])
    true = np.abs(run.values["friction_torque"][known] - rig.torque_offset)
    torque = np.interp(run.time, run.time[known], true)
    slip, inertia = run.inputs["speed"].copy(), rig.inertia - rig.inertia_between
    if inertia <= 0.0:
        raise ParameterError(
            f"inertia_between = {rig.inertia_between:g} kg.m2, allowed: below inertia "
            f"({rig.inertia:g} kg.m2)"
        )
    for i in range(1, len(slip)):
        if run.engaged[i] and run.engaged[i] == run.engaged[i - 1]:
            mean = 0.5 * (torque[i] + torque[i - 1]) + rig.drag_torque
            slip[i] = _after(slip[i - 1], mean * (run.time[i] - run.time[i - 1]) / inertia)
            if slip[i - 1] == 0.0:
                slip[i] = 0.0
    return replace(run, inputs={**run.inputs, "speed": slip})


def pressing_force(params: TracedPack, run: Run) -> Array:
    """Return the force on the plates [N]: without that of the piston's springs, and later."""
    force = np.maximum(run.inputs["load"] - params.kiss_pressure * params.piston_area, 0.0)
    if not params.fill_time:
        return force
    return np.interp(run.time - params.fill_time, run.time, force)


def _start_temperature(run: Run) -> float:
    """Return how warm the plates are at the start [K]: as measured there, else as the oil."""
    known = run.values.get("temperature")
    if known is None:
        return float(run.inputs["oil_temperature"][0])
    return float(known[np.isfinite(known)][:FIRST].mean())


def _colder(run: Run, here: Array, warmer: Array) -> float:
    """Return by how much the start should be warmer to meet the recording best [K].

    ``here``, ``warmer``: (m,) temperatures [K] from two starts ``WARMER`` apart. A few means at the
    start scatter, and all that follows would lie nearly as far off.
    """
    measured = run.values["temperature"]
    known = np.isfinite(measured)
    rise, weight = (warmer - here)[known] / WARMER, run.counts["temperature"][known]
    size = float(weight @ rise**2)
    return float(weight @ (rise * (measured - here)[known])) / size if size > 0.0 else 0.0


def _late(run: Run, slip: Array) -> Array:
    """Return by how much the slip should begin higher to meet the recorded one best, (m,) [rad/s].

    One value for each engagement, from where it slips: a single mean at its beginning scatters, and
    all that follows would lie as far off.
    """
    found, off = np.zeros(len(slip)), run.values["slip"] - slip
    floor = SLIDES * float(np.abs(run.values["slip"]).max())
    slides = (np.abs(slip) > floor) & (np.abs(run.values["slip"]) > floor)
    for number in range(1, int(run.engaged.max(initial=0)) + 1):
        mine = run.engaged == number
        counted = mine & slides
        weight = run.counts["slip"][counted]
        if weight.sum() > 0.0:
            found[mine] = float(off[counted] @ weight / weight.sum())
    return found


def _stepped(
    par: Any, rig: TracedPack, run: Run, load: Array, begin: Array, warm: float
) -> Way | Status:
    """Return a pack's way along a run; with ``rig.inertia`` its slip follows while it is engaged.

    ``begin``: (m,) slip [rad/s] where it does not follow, so at the beginning of each engagement;
    ``warm``: temperature of the plates [K] at the start.
    Slip by Heun's method: its end is first guessed by the torque at the beginning, the pack is
    stepped to there, then the mean of both torques counts. Where slip has ended the pack holds the
    drag.
    """
    work, out = np.zeros(k.NWORK), np.zeros(k.NOUT)
    oil, drum, time = run.inputs["oil_temperature"], run.inputs["drum_speed"], run.time
    slip = begin.copy()
    torque, temperature = np.empty(len(time)), np.empty(len(time))
    status = _begin(par, float(load[0]), float(oil[0]), warm, work)
    faces, before, is_held = par[k.P_FACES], float(slip[0]), False
    advance = bound(clutch_advance.advance, par=par, work=work)
    fill_outputs = bound(pack_outputs.fill_outputs, par=par, work=work, out=out)
    mean_surface = bound(pack_outputs.mean_surface, par=par, work=work)
    for i, now in enumerate(time):
        aim = float(slip[i])
        is_free = bool(
            rig.inertia and i and run.engaged[i] and run.engaged[i] == run.engaged[i - 1]
        )
        if not is_free:
            is_held = False
        elif is_held:
            aim = 0.0
        else:
            rate = (abs(torque[i - 1]) + rig.drag_torque) / rig.inertia
            aim = _after(before, rate * (now - time[i - 1]))
        if i and status == Status.OK:
            ends = (load[i - 1], before, oil[i - 1], load[i], aim, oil[i], drum[i - 1], drum[i])
            power, proposed = out[k.O_POWER] / faces, work[k.W_PROPOSED]
            status = advance(ends, now - time[i - 1], power, proposed)
        if Status(status).is_failure:
            return Status(status)
        fill_outputs(load[i], aim, drum[i])
        temperature[i], _ = mean_surface()
        torque[i] = out[k.O_TORQUE]
        if is_free and is_held:
            torque[i] = -_sign(float(begin[0])) * rig.drag_torque
        elif is_free:
            mean = 0.5 * (abs(torque[i - 1]) + (abs(torque[i]) if aim else abs(torque[i - 1])))
            rate = (mean + rig.drag_torque) / rig.inertia
            end = _after(before, rate * (now - time[i - 1]))
            if end == 0.0 and before != 0.0:
                is_held = True
            aim = end
        slip[i] = before = aim
    return Way(torque, temperature, slip)


def _begin(par: Any, load: float, oil: float, warm: float, work: Array) -> int:
    """Set the pack's memory at the start, its plates at ``warm`` [K]; return a status."""
    status = clutch_advance.load_memory(par, load, oil, np.zeros(k.NSTATE), work)
    if status == Status.OK and not rates.moves_film(par):
        work[k.W_NOW + k.Y_FILM] = 1.0
        status = clutch_advance.settle_film(par, load, work)
    each = 1 + int(par[k.D_MODES])
    for ring in range(int(par[k.D_RINGS])):
        work[k.W_NOW + k.Y_HEAT + ring * each] = warm
    return int(status)


def _after(slip: float, fall: float) -> float:
    """Return what is left of a slip that falls in size; not through 0."""
    return _sign(slip) * max(abs(slip) - fall, 0.0)


def _sign(slip: float) -> float:
    return -1.0 if slip < 0.0 else 1.0
