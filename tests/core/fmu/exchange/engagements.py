"""A pack between two inertias, by model exchange with a solver over both, and by co-simulation."""

import numpy as np
from scipy.integrate import solve_ivp


class Plant:
    """Two inertias [kg m2] under torques [N m]; the load [N] rises to its end in a time [s]."""

    def __init__(self, inertias, torques, load, rise, speeds, oil=350.0):
        self.inertias, self.torques, self.oil = inertias, torques, oil
        self.load, self.rise, self.speeds = load, rise, speeds

    def pressed(self, t):
        return self.load * min(max(t / self.rise, 0.01), 1.0)

    def accelerations(self, torque):
        (first, second), (drive, brake) = self.inertias, self.torques
        return np.array([(drive - torque) / first, (brake + torque) / second])

    @property
    def held(self):
        """The torque [N m] of a pack that holds."""
        (first, second), (drive, brake) = self.inertias, self.torques
        return (drive / first - brake / second) / (1.0 / first + 1.0 / second)

    def inputs(self, t, speeds):
        return {"load": self.pressed(t), "speed": speeds[0] - speeds[1]}


# inertias, torques, load, rise, speeds: short and long, soft and hard, from either side
TWELVE = [
    Plant((0.15, 1.0), (60.0, -20.0), 5000.0, 0.1, (100.0, 0.0)),
    Plant((0.15, 1.0), (60.0, -20.0), 5000.0, 0.3, (200.0, 0.0)),
    Plant((0.15, 1.0), (100.0, -20.0), 8000.0, 0.2, (200.0, 50.0)),
    Plant((0.15, 5.0), (60.0, -20.0), 5000.0, 0.1, (150.0, 40.0)),
    Plant((0.05, 1.0), (30.0, 0.0), 3000.0, 0.2, (300.0, 0.0)),
    Plant((1.0, 0.15), (20.0, -60.0), 5000.0, 0.1, (0.0, 100.0)),
    Plant((0.15, 1.0), (-50.0, 20.0), 5000.0, 0.2, (-100.0, 0.0)),
    Plant((0.3, 0.3), (40.0, -40.0), 4000.0, 0.05, (80.0, -20.0)),
    Plant((0.15, 1.0), (0.0, 0.0), 2000.0, 0.1, (50.0, 0.0)),
    Plant((0.15, 1.0), (80.0, -20.0), 9000.0, 0.5, (250.0, 0.0)),
    Plant((2.0, 10.0), (100.0, -100.0), 9000.0, 0.3, (60.0, 0.0)),
    Plant((0.15, 1.0), (60.0, -20.0), 5000.0, 0.1, (20.0, 0.0), 310.0),
]


def nominal(u):
    return np.concatenate([[100.0, 100.0], u.nominals()])


def exchanged(u, plant, end, tolerance=1e-6, method="Radau", **parameters):
    """Return times, slips, end torque, heat, steps, events; the solver owns pack and plant."""
    parameters |= {"starts_pressed": True, "oil_temperature": plant.oil}
    u.start(0.0, **parameters, **plant.inputs(0.0, plant.speeds))

    def rates(t, y):
        u.fmu.setTime(t)
        u.set(**plant.inputs(t, y[:2]))
        u.put(y[2:])
        return np.concatenate([plant.accelerations(u.get("friction_torque")), u.dx()])

    def indicator(k):
        def sign(t, y):
            rates(t, y)
            return float(u.z()[k])

        sign.terminal = True
        return sign

    signs = [indicator(k) for k in range(len(u.z()))]
    t, y, steps, events = 0.0, np.concatenate([plant.speeds, u.x()]), 0, 0
    times, slips, locks = [0.0], [y[0] - y[1]], []
    while t < end:
        stops = [s for s in (end, plant.rise, u.next_time) if s is not None and s > t + 1e-12]
        given = {"method": method, "rtol": tolerance, "atol": tolerance * nominal(u)}
        run = solve_ivp(rates, (t, min(stops)), y, events=signs, **given)
        assert run.success, run.message
        steps, t, y = steps + len(run.t) - 1, float(run.t[-1]), run.y[:, -1]
        times += run.t[1:].tolist()
        slips += (run.y[0] - run.y[1])[1:].tolist()
        if run.status == 1:
            t, y = beyond(rates, u, t, y)
        rates(t, y)
        before = u.get("locked")
        u.event(t)
        events += 1
        if u.get("locked") != before:
            locks.append((t, bool(u.get("locked"))))
        assert events < 300, "events without end"
    return {
        "time": np.array(times),
        "slip": np.array(slips),
        "torque": u.get("friction_torque"),
        "heat": u.get("energy"),
        "steps": steps,
        "events": events,
        "locks": locks,
    }


def beyond(rates, u, t, y):
    """Return the time and the values just behind an event, as hosts leave their root finders."""
    slope, h = rates(t, y), 1e-12
    rates(t - 1e-7, y - 1e-7 * slope)
    before = u.z() > 0.0
    while h < 1e-6:
        rates(t + h, y + h * slope)
        if np.any((u.z() > 0.0) != before):
            return t + h, y + h * slope
        h *= 4.0
    return t, y


def stepped(u, plant, end, h=1e-4):
    """The same by co-simulation: the torque is held over a step."""
    speeds, n = np.array(plant.speeds, float), round(end / h)
    if u.fmi == 2:
        u.fmu.setupExperiment(startTime=0.0)
    u.set(starts_pressed=True)
    u.fmu.enterInitializationMode()
    u.set(oil_temperature=plant.oil, **plant.inputs(0.0, speeds))
    u.fmu.exitInitializationMode()
    slips, torque = [speeds[0] - speeds[1]], u.get("friction_torque")
    for k in range(n):
        u.set(**plant.inputs((k + 0.5) * h, speeds))
        u.fmu.doStep(k * h, h)
        torque = u.get("friction_torque")
        speeds = speeds + h * plant.accelerations(torque)
        slips.append(speeds[0] - speeds[1])
    found = {"time": np.arange(n + 1) * h, "slip": np.array(slips), "torque": torque}
    return found | {"heat": u.get("energy")}


def lock_up(run):
    """Return when the slip has first come to nothing [s]: as it falls, from 2 % of its start on."""
    small = 0.02 * run["slip"][0]
    sign = np.sign(run["slip"][0])
    k = int(np.argmax(sign * run["slip"] < sign * small))
    t, s = run["time"][k - 1 : k + 1], run["slip"][k - 1 : k + 1]
    return float(t[0] + (small - s[0]) * (t[1] - t[0]) / (s[1] - s[0]))
