"""Times of a scene count from the start of the run: in a package, in its parts, under any start."""

from dataclasses import replace

import numpy as np
import pytest
from scene_runs import changed as scene_in
from scene_runs import instances
from ssp_master import description, run

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.native.files import zipped
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.ssp.changed_values import changed
from thrustwasher.shift.ssp.package import files
from thrustwasher.shift.ssp.system_structure import plan, prepared

ROUNDING = 1e-9
QUIET = ("clutch", "brake", "transmission")  # the parts of a scene that are kept
BASE = load_scene("planetary")


def scene(folder, start=0.0):
    """Return the pressed shift to 0.2 s, all times of its file later by ``start``."""
    text = f"start_time = {start}\nstop_time = {start + 0.2}\n"
    for name in ("engine", "pressure.clutch", "pressure.brake"):
        own = BASE.table
        for word in name.split("."):
            own = own[word]
        text += f"[{name}]\npoints = {[[t + start, x] for t, x in own['points']]}\n"
    whole = scene_in(folder, text)
    gearbox = whole.parts["transmission"]
    quiet = replace(gearbox, params=replace(gearbox.params, washers=0, input_inertia=0.3))
    parts = {n: p for n, p in whole.parts.items() if n in QUIET} | {"transmission": quiet}
    return replace(whole, parts=parts)


def packed(found):
    system = plan(prepared(found), {})
    made = files(system, tool="thrustwasher", date="2026-01-01T00:00:00Z")
    return system, description(zipped(made))


def parts_of(system):
    """Return the parts as a host has them that reads no values of a package."""
    return {p.name: DirectInstance(p.spec) for p in system.components}


def test_a_package_started_later_runs_the_same_shift_later(tmp_path):
    system, root = packed(scene(tmp_path))
    now, later = (run(root, parts_of(system), start=t) for t in (0.0, 5.0))
    assert now["transmission.clutch_filled_time"] == pytest.approx(0.1075, abs=1e-6)
    assert now["clutch.energy"] > 0.0
    for name, x in now.items():
        is_time = name.endswith("_time") and x != -1.0  # of the host; -1: never
        at = x + 5.0 if is_time else x
        assert later[name] == pytest.approx(at, rel=ROUNDING, abs=1e-7), name


def test_a_scene_that_starts_later_is_the_same_shift_later_alone_and_in_a_package(tmp_path):
    """What its file says are times of its own clock."""
    now, later = scene(tmp_path), scene(tmp_path, 2.0)
    one, other = (cosimulate(s, instances(s)) for s in (now, later))
    assert other.time == pytest.approx(one.time + 2.0, rel=1e-12)
    for name in ("transmission.engine_speed", "transmission.brake_piston_pressure"):
        assert other.signals[name] == pytest.approx(one.signals[name], rel=ROUNDING), name
    (system, root), (_, own) = packed(later), packed(now)
    assert np.ptp(one.signals["transmission.brake_piston_pressure"]) > 1e5
    rows = [run(root, parts_of(system)), run(own, parts_of(plan(prepared(now), {})))]
    speeds = [row["transmission.engine_speed"] for row in rows]
    assert speeds[0] == pytest.approx(speeds[1], rel=ROUNDING)


def test_a_time_that_is_set_in_a_package_counts_from_the_start_too(tmp_path):
    told = {"command.start": "50 ms", "transmission.engine_torque_time_2": "0.2 s"}
    system = plan(prepared(changed(scene(tmp_path, 2.0), told)), {})
    found = {p.name: p.parameters for p in system.components}
    assert found["command"]["start"] == pytest.approx(0.05, rel=1e-12)
    assert found["transmission"]["engine_torque_time_2"] == pytest.approx(0.2, rel=1e-12)
