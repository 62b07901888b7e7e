"""A sump in a shift: the parts' oil has its temperature, and it gets their heat."""

import numpy as np
import pytest
from scene_runs import changed, with_all_parts

from thrustwasher.shift import cosimulate


def test_the_oil_of_all_parts_is_the_sumps_and_every_washer_heats_it(tmp_path):
    text = "stop_time = 0.02\n[sump]\nvolume = 1e-4\nhousing_capacity = 0.0\nconductance = 0.0"
    s = cosimulate(*with_all_parts(changed(tmp_path, text))).signals
    oil = s["sump.temperature"]
    assert oil[0] == 358.15 and oil[-1] > oil[0]
    for part in ("clutch", "brake", "washer", "mesh", "ring_mesh", "losses"):
        assert (s[f"{part}.oil_temperature"][1:] == oil[:-1]).all()
    received = np.sum(8.0 * s["sump.heat_3"][1:]) * 1e-3
    factors = {1: 1.0, 2: 1.0, 4: 4.0, 5: 4.0, 6: 1.0, 7: 1.0}
    others = sum(f * np.sum(s[f"sump.heat_{i}"][1:]) * 1e-3 for i, f in factors.items())
    assert s["sump.received_heat"][-1] == pytest.approx(received + others, rel=1e-12)
    for port, power in ((6, "bearing_power"), (7, "loss_power")):
        assert (s[f"sump.heat_{port}"][1:] == s[f"transmission.{power}"][1:]).all()
    assert received > 0.0 and (s["sump.heat_3"][1:] == s["washer.oil_heat"][1:]).all()


def test_work_is_motion_load_heat_in_the_parts_and_heat_in_the_sump(tmp_path):
    """Driveline and parts count heat each over their own step: that difference is known."""
    r = cosimulate(*with_all_parts(changed(tmp_path, "stop_time = 0.5\n[sump]")))
    s, h, book = r.signals, np.diff(r.time), r.energy
    count = {"clutch": 1, "brake": 1, "washer": 8, "mesh": 4, "ring_mesh": 4}
    made = sum(n * s[f"{p}.energy"][-1] for p, n in count.items() if f"{p}.energy" in s)
    rest = [p for p in count if f"{p}.energy" not in s]
    made += sum(count[p] * np.sum(s[f"{p}.friction_power"][1:] * h) for p in rest)
    stored = sum(n * s[f"{p}.stored_heat"][-1] for p, n in count.items())
    coupling = sum(book[name] for name in ("clutch", "brake", "washers", "meshes")) - made
    sump = sum(s[f"sump.{name}"][-1] for name in ("stored_heat", "ambient_heat", "cooler_heat"))
    work = book["engine_work"]
    left = work - book["load_work"] - book["kinetic"] - stored - sump - coupling
    assert abs(left) < 1e-12 * work and abs(coupling) < 1e-5 * work
