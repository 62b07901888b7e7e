"""Examples of the Modelica Standard Library with packs in model exchange as friction elements.

Modelica.Mechanics.Rotational.Examples: CoupledClutches, LossyGearDemo1 and 2. A pack of the level
closed with the constant law has a capacity proportional to its load, as those elements have.
"""

import math

import numpy as np
from coupled import Line, Part, exchanged
from exchanged import unit
from scipy.integrate import Radau

from thrustwasher import ClutchParams, solve_clutch
from thrustwasher.clutch.parameters import FRICTION_LAWS
from thrustwasher.model.registry import find_spec

CLOSED = {
    "fidelity": list(find_spec("clutch").fidelities).index("closed") + 1,
    "friction_law": list(FRICTION_LAWS).index("constant") + 1,
}
EACH = (
    1e-3
    * solve_clutch(  # N m of capacity for 1 N
        ClutchParams(friction_law="constant"), load=1e3, speed=0.0, fidelity="closed"
    ).torque_capacity
)


def coupled_clutches(tolerance=1e-6):
    """Four inertias of 1 kg m2, three clutches of 10 N m; without the peak of the friction at rest.

    The first is pressed by a cosine of 0.2 Hz, the others from 0.4 and 0.9 s on, the first inertia
    driven by 10 N m at 5 Hz.
    """
    own = CLOSED | {"largest_capacity": 10.0, "rest_angle": 1e-5}
    loads = (
        lambda t: 10.0 * max(0.0, math.cos(0.4 * math.pi * t)),
        lambda t: 10.0 * (t >= 0.4),
        lambda t: 10.0 * (t >= 0.9),
    )
    parts = [
        Part(
            "clutch",
            tuple(float(i == k) - float(i == k + 1) for i in range(4)),
            lambda t, load=load: {"load": load(t) / EACH, "oil_temperature": 350.0},
            own,
        )
        for k, load in enumerate(loads)
    ]
    drive = lambda t: 10.0 * math.sin(10.0 * math.pi * t)  # noqa: E731
    speeds = (10.0, 0.0, 0.0, 0.0)
    line = Line(parts, (1.0,) * 4, (drive, 0.0, 0.0, 0.0), speeds, (0.4, 0.9), 0.83)
    return exchanged(line, tolerance, longest=2e-3)


def lossy_gear(number, tolerance=1e-6, angle=1e-6, end=0.5):
    """A gear of ratio 2 between 1 and 1.5 kg m2 that loses half of the driving side's torque.

    Friction 0.5 max(abs(tau_a), abs(tau_b)/2) on the first shaft: with the efficiency 0.5 either
    way that is LossyGear's loss in all quadrants, and what it holds at rest. Demo 2 adds the
    friction of a bearing, 0.5 N m and 0.5 N m s/rad. Columns: time, Inertia2.w, Inertia2.phi.
    """
    with unit("clutch") as mesh, unit("clutch") as bearing:
        units = [mesh, bearing][:number]
        for u in units:
            own = CLOSED | {"largest_capacity": 20.0, "rest_angle": angle}
            u.start(0.0, **own, load=1.0, speed=0.0, oil_temperature=350.0)
        start = [u.x() for u in units]
        bend = mesh.states.index("bend")

        def rates(t, y):
            speed, _, *bends = y
            for u, x, z in zip(units, start, bends, strict=True):
                u.fmu.setTime(t)
                x[bend] = z
                u.put(x)
            given = {"speed": speed, "oil_temperature": 350.0}
            drive, outside = 10.0 * math.sin(2.0 * math.pi * t), -10.0 + 2.5 * t
            if number == 2:
                bearing.set(load=(0.5 + 0.5 * abs(speed)) / EACH, **given)
                drive -= bearing.get("friction_torque")
            load = last[0]
            for _ in range(60):  # the tooth force depends on its friction: a contraction by 0.36
                mesh.set(load=load / EACH, **given)
                loss = mesh.get("friction_torque")
                slowed = (outside + 2.0 * drive - 2.0 * loss) / (0.5 * 1.5 + 2.0 * 1.0)
                before = drive - slowed
                new = 0.5 * max(abs(before), abs(before - loss))
                done = abs(new - load) < 1e-12 * (1.0 + new)
                load = new
                if done:
                    break
            last[0] = load
            return np.array([slowed, 0.5 * speed, *(u.dx()[bend] for u in units)])

        last, y = [1.0], np.zeros(2 + len(units))
        size = tolerance * np.array([1e-2, 1e-3, *([1e-6] * len(units))])
        solver = Radau(rates, 0.0, y, end, rtol=tolerance, atol=size, max_step=2e-3)
        rows = [(0.0, 0.0, 0.0)]
        while solver.status == "running":
            solver.step()
            rows.append((solver.t, 0.5 * solver.y[0], solver.y[1]))
        assert solver.status == "finished"
    return dict(zip(("time", "Inertia2.w", "Inertia2.phi"), np.array(rows).T, strict=True))
