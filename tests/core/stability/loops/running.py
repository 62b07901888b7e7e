"""Step two or three FMUs in a loop with a master, and find the step at which something ends."""

import numpy as np

from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.model.registry import find_spec
from thrustwasher.shift.cosim.loop import Recorder, Run, advance_in_python
from thrustwasher.shift.cosim.system import ConnectedPart, System
from thrustwasher.shift.masters.master import MASTERS
from thrustwasher.shift.scene.connections import Link

EXACT = 0.005  # a limit is bisected to this part of itself


def made(spec, fmus, **parameters):
    """Return an FMU of a model, or its kernels in this process where there is none."""
    if spec.name in fmus:
        return Instance(fmus[spec.name], parameters=parameters)
    return DirectInstance(spec, parameters=parameters)


def body_and_law(fmus, body, law):
    """Return a system: a body whose position and speed a law answers with a force."""
    from loops.specs import BODY, LAW

    parts = {
        "body": ConnectedPart("body", BODY, made(BODY, fmus, **body)),
        "law": ConnectedPart("law", LAW, made(LAW, fmus, **law)),
    }
    links = [Link("body", n, "law", n) for n in ("position", "speed")]
    return System(parts, [*links, Link("law", "force", "body", "force")], hub="body")


def gearbox_and_clutch(fmus, gearbox, clutch, brake=0.0):
    """Return a system: a transmission and its clutch; ``brake``: the torque its brake sends."""
    coupling = gearbox.get("coupling", "capacity")
    found = {
        "transmission": gearbox,
        "clutch": {"input_profile": "linear", "holding": "off", **clutch},
    }
    parts = {}
    for name, parameters in found.items():
        spec = find_spec(name)
        parts[name] = ConnectedPart(name, spec, made(spec, fmus, **parameters))
    parts["transmission"].inputs[1] = brake
    output = {"capacity": "torque_capacity", "torque": "friction_torque"}[coupling]
    links = [Link("transmission", f"clutch_{n}", "clutch", n) for n in ("load", "speed")]
    extrapolates = gearbox.get("capacity_extrapolation", True) and coupling == "capacity"
    return System(
        parts,
        [*links, Link("clutch", output, "transmission", "clutch_torque")],
        carries_on=["clutch_torque"] if extrapolates else [],
    )


def march(system, master, h, n):
    """Start a system again and take ``n`` steps; return the signals at all points."""
    for part in system.parts.values():
        part.instance.reset()
    time = h * np.arange(n + 1.0)
    recorder = Recorder(system, n + 1)
    run = Run(system, MASTERS[master].schedule(system), time, h, np.ones(n + 1), recorder)
    system.set_command(1.0)
    system.initialize(0.0)
    recorder.keep(0)
    advance_in_python(run, 0, n)
    return recorder.signals()


def last_step(holds, low, high):
    """Return the largest step for which ``holds``: True at ``low``, False at ``high``."""
    assert holds(low) and not holds(high)
    while high > (1.0 + EXACT) * low:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if holds(middle) else (low, middle)
    return (low * high) ** 0.5


def dies_out(deviation):
    """Tell if a deviation from the rest point does not grow."""
    size, n = np.abs(deviation), len(deviation)
    if not size.max() < 4.0 * size[0]:
        return False
    before, last = (np.square(w).mean() for w in (size[n // 2 : 3 * n // 4], size[3 * n // 4 :]))
    return last <= max(before, (1e-9 * size[0]) ** 2)


def keeps_its_side(deviation):
    """Tell if a deviation goes to zero without passing through it."""
    noise = 1e-9 * abs(deviation[0])
    return bool((deviation * np.sign(deviation[0]) > -noise).all())
