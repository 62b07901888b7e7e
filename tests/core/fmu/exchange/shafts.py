"""One shaft that a unit brakes: by model exchange with a solver over both, by co-simulation."""

import numpy as np
from engagements import beyond
from scipy.integrate import solve_ivp


class Shaft:
    """An inertia [kg m2] under a torque [N m], both signs as the speed's; inputs of the unit.

    ``drive`` and each of ``inputs``: a number or a function of time [s], which jumps at ``jumps``.
    ``brake``: the output that brakes the shaft; ``heat``: outputs whose sum is the heat made.
    """

    def __init__(self, inertia, speed, drive=0.0, jumps=(), **inputs):
        self.inertia, self.speed, self.drive, self.jumps = inertia, speed, drive, jumps
        self.given = inputs

    def inputs(self, t, speed):
        return {n: _at(x, t) for n, x in self.given.items()} | {"speed": speed}

    def driven(self, t):
        return _at(self.drive, t)


def _at(x, t):
    return float(x(t)) if callable(x) else x


def jump(before, after, at):
    """Return a function of time that jumps."""
    return lambda t: after if t >= at else before


HEATS = {
    "gearmesh": ("friction_torque", ("oil_energy", "stored_heat")),
    "train": ("loss_torque", ("oil_energy",)),
}


def pressed(t):
    """From exactly no load."""
    return 400.0 * min(max((t - 0.1) / 0.3, 0.0), 1.0)


WARM = {"oil_temperature": 330.0}
AT_ONCE = {"thermal_mode": 1}  # all heat goes into the oil
SHAFTS = {
    "mesh, coast": ("gearmesh", Shaft(0.002, 50.0, load=40.0, **WARM), {}),
    "mesh, held": ("gearmesh", Shaft(0.002, 50.0, 0.05, load=40.0, **WARM), {}),
    "mesh, jump": (
        "gearmesh",
        Shaft(0.02, 50.0, jumps=(0.3,), load=jump(40.0, 400.0, 0.3), **WARM),
        {},
    ),
    "mesh, from no load": (
        "gearmesh",
        Shaft(0.02, 50.0, jumps=(0.1, 0.4), load=pressed, **WARM),
        {},
    ),
    "mesh, fast and cold": (
        "gearmesh",
        Shaft(0.02, -500.0, load=2000.0, oil_temperature=280.0),
        {},
    ),
    "train, coast": ("train", Shaft(0.01, 40.0, torque=40.0, **WARM), AT_ONCE),
    "train, held": ("train", Shaft(0.05, 20.0, 0.2, torque=150.0, **WARM), AT_ONCE),
    "train, driven by its output": ("train", Shaft(0.05, 20.0, torque=-150.0, **WARM), AT_ONCE),
    "train, jump": (
        "train",
        Shaft(0.05, 20.0, jumps=(0.2,), torque=jump(0.0, 200.0, 0.2), **WARM),
        AT_ONCE,
    ),
    "train, warm bodies": ("train", Shaft(0.05, -30.0, torque=150.0, **WARM), {}),
}


def exchanged(u, shaft, end, brake, heat, tolerance=1e-6, method="Radau", **parameters):
    """Return times, speeds, torque, heat, steps, events."""
    u.start(0.0, **parameters, **shaft.inputs(0.0, shaft.speed))
    scale = np.concatenate([[100.0], u.nominals()])

    def rates(t, y):
        u.fmu.setTime(t)
        u.set(**shaft.inputs(min(t, stop - 1e-9), y[0]))
        u.put(y[1:])
        return np.concatenate(
            [[(shaft.driven(min(t, stop - 1e-9)) - u.get(brake)) / shaft.inertia], u.dx()]
        )

    def indicator(k):
        def sign(t, y):
            rates(t, y)
            return float(u.z()[k])

        sign.terminal = True
        return sign

    signs = [indicator(k) for k in range(len(u.z()))]
    t, y, steps, events = 0.0, np.concatenate([[shaft.speed], u.x()]), 0, 0
    times, speeds, torques, calls = [0.0], [shaft.speed], [u.get(brake)], 0
    while t < end - 1e-12:
        stops = [s for s in (end, *shaft.jumps, u.next_time) if s is not None and s > t + 1e-12]
        stop = min(stops)
        given = {"method": method, "rtol": tolerance, "atol": tolerance * scale}
        run = solve_ivp(rates, (t, stop), y, events=signs, **given)
        assert run.success, run.message
        calls += run.nfev
        for x, v, *states in zip(run.t[1:], *run.y[:, 1:], strict=True):
            rates(x, np.array([v, *states]))
            u.fmu.completedIntegratorStep()
            torques.append(u.get(brake))
        steps, t, y = steps + len(run.t) - 1, float(run.t[-1]), run.y[:, -1]
        times, speeds = times + run.t[1:].tolist(), speeds + run.y[0, 1:].tolist()
        if run.status == 1:
            stop = end
            t, y = beyond(rates, u, t, y)
        rates(t, y)
        u.event(t, **shaft.inputs(t, y[0]))
        events += 1
        assert events < 300, "events without end"
    u.fmu.setTime(end)
    return _found(times, speeds, torques, sum(u.get(n) for n in heat)) | {
        "steps": steps,
        "events": events,
        "calls": calls,
    }


def stepped(u, shaft, end, brake, heat, h=1e-4, **parameters):
    """The same by co-simulation: the torque is held over a step."""
    if u.fmi == 2:
        u.fmu.setupExperiment(startTime=0.0)
    u.set(**parameters)
    u.fmu.enterInitializationMode()
    u.set(**shaft.inputs(0.0, shaft.speed))
    u.fmu.exitInitializationMode()
    v, speeds, torques, n = shaft.speed, [shaft.speed], [u.get(brake)], round(end / h)
    for k in range(n):
        u.set(**shaft.inputs((k + 0.5) * h, v))
        u.fmu.doStep(k * h, h)
        torques.append(u.get(brake))
        v += h * (shaft.driven((k + 0.5) * h) - torques[-1]) / shaft.inertia
        speeds.append(v)
    return _found(np.arange(n + 1) * h, speeds, torques, sum(u.get(n) for n in heat))


def _found(times, speeds, torques, heat):
    return {
        "time": np.array(times),
        "speed": np.array(speeds),
        "torque": np.array(torques),
        "heat": heat,
    }


def stop_of(run):
    """Return when the speed has first fallen to 2 % of that at the start [s]."""
    small = 0.02 * run["speed"][0]
    k = int(np.argmax(np.sign(small) * (run["speed"] - small) < 0.0))
    t, s = run["time"][k - 1 : k + 1], run["speed"][k - 1 : k + 1]
    return float(t[0] + (small - s[0]) * (t[1] - t[0]) / (s[1] - s[0]))
