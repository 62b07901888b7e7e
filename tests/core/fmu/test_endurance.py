"""Thousands of instances, and processes that end cleanly."""

import json

import pytest

CYCLES = """
import json, sys
from thrustwasher.fmu.stepper import Instance

def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096

sizes = {}
for i in range(int(sys.argv[2])):
    with Instance(sys.argv[1]) as fmu:
        fmu.initialize()
        fmu.step(0.0, 1e-3)
        fmu.step(1e-3, 1e-3)
        fmu.outputs()
    sizes[i + 1] = resident()
print(json.dumps([sizes[200], sizes[i + 1], len(sys.path)]))
"""

RESETS = CYCLES.replace(
    "    with Instance(sys.argv[1]) as fmu:", "    fmu.reset()\n    if True:"
).replace("sizes = {}", "sizes = {}\nfmu = Instance(sys.argv[1])")

TOGETHER = """
import sys
from thrustwasher.fmu.stepper import Instance
for _ in range(2):
    running = [Instance(path) for path in sys.argv[1:] for _ in range(2)]
    for fmu in running:
        fmu.initialize()
        fmu.step(0.0, 1e-3)
        fmu.outputs()
    for fmu in running:
        fmu.close()
print("done")
"""


@pytest.mark.slow
def test_two_thousand_instances_neither_crash_nor_eat_memory(python_toy, run_child):
    before, after, path_entries = json.loads(run_child(CYCLES, python_toy, 2000))
    assert (after - before) / 1800 < 20_000  # bytes per instance
    assert path_entries < 20


@pytest.mark.slow
def test_two_thousand_resets_keep_memory_flat(python_toy, run_child):
    before, after, _ = json.loads(run_child(RESETS, python_toy, 2000))
    assert (after - before) / 1800 < 2_000


def test_different_fmus_live_in_one_process_twice_each(python_toy, fmus, run_child):
    others = [fmus["WetClutch"], fmus["ShiftTransmission"]]
    assert run_child(TOGETHER, python_toy, *others) == "done"
