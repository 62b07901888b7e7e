"""Lives of three reducers, derived apart from this code by an engineer's own statics.

The numbers are those of rigid shafts, ideal teeth and ISO 281 with the axial loads of pairs in O
and X that catalogues of taper and angular contact bearings print; so friction is taken out here.
Loads and lives were balanced about an arbitrary point there, and the pair's logic compared with
SKF's load cases. L10h in hours, bearing by bearing from the input on; drive, then coast.
"""

from pathlib import Path

import pytest

from thrustwasher.model.part_file import load_part
from thrustwasher.train.solve import solve_train

RPM = 0.10471975511965977
REDUCERS = [
    ("one-stage", 180.0, 2900.0, (13370.19, 149646.41, 154381.98, 2597455.67)),
    ("one-stage", -180.0, 2900.0, (44215.86, 12448.24, 618772.09, 152242.46)),
    ("two-stages", 95.0, 2930.0, (5533.72, 14255.36, 125345.41, 99668.83, 147751.17, 170837.26)),
    ("two-stages", -95.0, 2930.0, (11887.50, 5312.85, 155726.52, 295681.39, 217780.20, 83417.26)),
    ("chain-and-propeller", 120.0, 2200.0, (26321.95, 14594.20, 41808.44, 180696.86)),
    ("chain-and-propeller", -120.0, 2200.0, (37117.55, 12620.29, 180000.91, 822492.44)),
]


@pytest.mark.parametrize(("name", "torque", "speed", "hours"), REDUCERS)
def test_lives_are_those_that_were_derived_apart(name, torque, speed, hours):
    part = load_part(Path(__file__).parent / "reducers" / f"{name}.toml")
    r = solve_train(part.params, torque=torque, speed=speed * RPM)
    shafts = range(1, len(hours) // 2 + 1)
    lives = [getattr(r, f"shaft_{i}_bearing_{k}_life") / 3600.0 for i in shafts for k in (1, 2)]
    assert lives == pytest.approx(hours, rel=2e-8, abs=0.006)
