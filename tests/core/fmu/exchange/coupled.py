"""Shafts and units that brake them: model exchange with one solver over all, and co-simulation."""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, field

import numpy as np
from exchanged import unit
from scipy.integrate import Radau
from scipy.optimize import brentq


@dataclass
class Part:
    """A unit on the shafts: its slip is a sum of their speeds, or a function of time."""

    key: str
    slip: tuple | Callable  # a factor for each shaft, or slip over time [rad/s]
    inputs: Callable = dict  # others, over time
    parameters: dict = field(default_factory=dict)
    torque: str = "friction_torque"  # the output that acts on the shafts, against the slip
    heat: tuple = ("energy",)

    def speed(self, t, speeds):
        return self.slip(t) if callable(self.slip) else float(np.dot(self.slip, speeds))

    def given(self, t, speeds):
        return self.inputs(t) | {"speed": self.speed(t, speeds)}


@dataclass
class Line:
    """Inertias [kg m2] under torques [N m], parts between them, speeds at the start [rad/s].

    A torque is a number or a function of time.
    """

    parts: list
    inertias: tuple = ()
    torques: tuple = ()
    speeds: tuple = ()
    jumps: tuple = ()  # times where inputs have a corner
    end: float = 1.0

    def accelerations(self, t, torques):
        found = np.array([x(t) if callable(x) else x for x in self.torques], float)
        for part, torque in zip(self.parts, torques, strict=True):
            if not callable(part.slip):
                found -= torque * np.array(part.slip)
        return found / np.array(self.inertias)


class _Host:
    """Calls of all units as a host of model exchange makes them."""

    def __init__(self, line, units):
        self.line, self.units, self.n = line, units, len(line.inertias)
        self.places = np.cumsum([self.n, *(u.n for u in units)])
        self.calls, self.stop = 0, line.end

    def start(self):
        for part, u in zip(self.line.parts, self.units, strict=True):
            u.start(0.0, **part.parameters, **part.given(0.0, self.line.speeds))
        return np.concatenate([np.array(self.line.speeds, float), *(u.x() for u in self.units)])

    def tell(self, t, y):
        spans = zip(self.places[:-1], self.places[1:], strict=True)
        for part, u, (a, b) in zip(self.line.parts, self.units, spans, strict=True):
            u.fmu.setTime(t)
            u.set(**part.given(min(t, self.stop - 1e-9), y[: self.n]))  # a jump at the stop: later
            u.put(y[a:b])

    def torques(self):
        return [u.get(p.torque) for p, u in zip(self.line.parts, self.units, strict=True)]

    def rates(self, t, y):
        self.calls += 1
        self.tell(t, y)
        shafts = self.line.accelerations(t, self.torques()) if self.n else []
        return np.concatenate([shafts, *(u.dx() for u in self.units)])

    def slopes(self, t, y):
        """Return the exact Jacobian, by the units' directional derivatives."""
        self.tell(t, y)
        found, n = np.zeros((y.size, y.size)), self.n
        for part, u, a in zip(self.line.parts, self.units, self.places, strict=False):
            turns = np.zeros(n) if callable(part.slip) else np.array(part.slip, float)
            rates, knowns = [part.torque, *(f"der({x})" for x in u.states)], ["speed", *u.states]
            own = np.array([u.along(rates, [known], [1.0]) for known in knowns]).T
            b, pull = slice(a, a + u.n), turns / np.array(self.line.inertias) if n else turns
            found[:n, :n] -= own[0, 0] * np.outer(pull, turns)
            found[:n, b] -= np.outer(pull, own[0, 1:])
            found[b, :n] += np.outer(own[1:, 0], turns)
            found[b, b] = own[1:, 1:]
        return found

    def signs(self, t, y):
        self.tell(t, y)
        return np.concatenate([u.z() for u in self.units])

    def nominals(self):
        return np.concatenate([np.full(self.n, 100.0), *(u.nominals() for u in self.units)])

    def next(self, t):
        """Return the next time at which the solver has to stop."""
        named = (self.line.end, *self.line.jumps, *(u.next_time for u in self.units))
        return min(x for x in named if x is not None and x > t + 1e-12)

    def crossed(self, before, solver):
        """Return the first time in the last step at which an indicator has changed its sign."""
        between, a, b = solver.dense_output(), solver.t_old, solver.t
        changed = np.flatnonzero((before > 0.0) != (self.signs(b, solver.y) > 0.0))
        times = []
        for k in changed:
            sign = lambda t, k=k: self.signs(t, between(t))[k]  # noqa: E731
            times.append(brentq(sign, a, b, xtol=1e-12) if sign(a) * sign(b) < 0.0 else b)
        if not times:
            return None
        t, h = min(times), 1e-12
        while t + h < b and np.all((self.signs(t + h, between(t + h)) > 0.0) == (before > 0.0)):
            h *= 4.0
        t = min(t + h, b)
        return t, between(t)


def exchanged(line, tolerance=1e-4, fmi=2, longest=np.inf):
    """Return times, speeds, torques of all points, heat, steps, events, calls; longest step [s]."""
    with ExitStack() as stack:
        units = [stack.enter_context(unit(p.key, fmi)) for p in line.parts]
        host = _Host(line, units)
        t, y = 0.0, host.start()
        steps = events = 0
        rows, locks = [], []

        def noted(t, y):
            host.tell(t, y)
            rows.append((t, *y[: host.n], *host.torques()))
            for u in units:
                u.fmu.completedIntegratorStep()

        noted(t, y)
        while t < line.end - 1e-12:
            stop = host.stop = host.next(t)
            size = tolerance * host.nominals()
            given = {"rtol": tolerance, "atol": size, "jac": host.slopes, "max_step": longest}
            solver = Radau(host.rates, t, y, stop, **given)
            before, found = host.signs(t, y), None
            while solver.status == "running" and found is None:
                told = solver.step()
                assert solver.status != "failed", told
                steps += 1
                found = host.crossed(before, solver)
                t, y = found or (solver.t, solver.y)
                noted(t, y)
            events += 1
            assert events < 5000, "events without end"
            held = [u.get("locked") if "locked" in u.variables else None for u in units]
            host.stop = np.inf
            host.tell(t, y)
            for u in units:
                u.event(t)
            for k, u in enumerate(units):
                if held[k] is not None and u.get("locked") != held[k]:
                    locks.append((t, k, bool(u.get("locked"))))
        heat = sum(u.get(n) for p, u in zip(line.parts, units, strict=True) for n in p.heat)
    found = _columns(line, rows)
    more = {"steps": steps, "events": events, "calls": host.calls, "locks": locks}
    return found | {"heat": float(heat)} | more


def stepped(line, h=1e-4, fmi=2):
    """The same by co-simulation: the torques are held over a step."""
    with ExitStack() as stack:
        units = [stack.enter_context(unit(p.key, fmi, "CoSimulation")) for p in line.parts]
        speeds, n = np.array(line.speeds, float), round(line.end / h)
        for part, u in zip(line.parts, units, strict=True):
            u.fmu.setupExperiment(startTime=0.0) if u.fmi == 2 else None
            u.set(**part.parameters)
            u.fmu.enterInitializationMode()
            u.set(**part.given(0.0, speeds))
            u.fmu.exitInitializationMode()
        pairs = list(zip(line.parts, units, strict=True))
        rows = [(0.0, *speeds, *(u.get(p.torque) for p, u in pairs))]
        for k in range(n):
            for part, u in pairs:
                u.set(**part.given((k + 0.5) * h, speeds))
                u.fmu.doStep(k * h, h)
            torques = [u.get(p.torque) for p, u in pairs]
            if line.inertias:
                speeds = speeds + h * line.accelerations((k + 0.5) * h, torques)
            rows.append(((k + 1) * h, *speeds, *torques))
        heat = sum(u.get(n) for p, u in pairs for n in p.heat)
    return _columns(line, rows) | {"heat": float(heat)}


def _columns(line, rows):
    table, n = np.array(rows), len(line.inertias)
    return {"time": table[:, 0], "speeds": table[:, 1 : 1 + n], "torques": table[:, 1 + n :]}


def slip_of(line, run):
    """Return the slip of the first part at all points."""
    return np.array(
        [line.parts[0].speed(t, s) for t, s in zip(run["time"], run["speeds"], strict=True)]
    )


def lock_up(line, run):
    """Return when the slip of the first part has fallen to 2 % of its start [s]."""
    slip = slip_of(line, run)
    fallen = np.sign(slip[0]) * slip < 0.02 * abs(slip[0])
    k = int(np.argmax(fallen))
    (a, b), (u, v) = run["time"][k - 1 : k + 1], slip[k - 1 : k + 1]
    return float(a + (0.02 * slip[0] - u) * (b - a) / (v - u))
