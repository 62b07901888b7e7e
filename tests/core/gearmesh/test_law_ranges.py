"""Every empirical law of mesh and losses says where it is outside its range, with the limit."""

import math
from dataclasses import replace

import pytest

from thrustwasher import GearMeshParams, solve_gearmesh, solve_losses
from thrustwasher.gearmesh import law_ranges as mesh
from thrustwasher.losses import loss_ranges as losses
from thrustwasher.losses.parameters import LossesParams
from thrustwasher.model.advice import LawRange

PAIR = GearMeshParams(normal_module=4e-3, face_width=0.02)
HIGH = {"pinion_teeth": 120, "addendum": 1.4, "normal_module": 2e-3}
SHIFTED = {"profile_shift_pinion": 1.1, "profile_shift_gear": 1.1, "pinion_teeth": 60}
ELASTIC = {"load_sharing": "elastic"}
INSIDE = {"power": 40e3, "speed": 200.0}  # 266 N/mm, 8 m/s
OUTSIDE = [  # range; pair and point outside of it; pair inside
    (mesh.LOAD, {}, {"power": 20e3}, {}),
    (mesh.LOAD, {"friction_law": "iso"}, {"power": 20e3}, {}),
    (mesh.LOAD, {"friction_law": "mixed"}, {"power": 20e3}, {}),
    (mesh.SLOW, {}, {"speed": 1300.0, "power": 300e3}, {}),
    (mesh.SLOW, {"friction_law": "iso"}, {"speed": 20.0, "power": 4e3}, {}),
    (mesh.STIFF, ELASTIC, {"power": 9e3}, ELASTIC),
    (mesh.STIFF, ELASTIC, {"power": 300e3}, ELASTIC),
    (mesh.SHIFTS, {**SHIFTED, **ELASTIC}, {}, {**SHIFTED, **ELASTIC, "profile_shift_gear": 0.5}),
    (mesh.CONTACT, HIGH, {}, {**HIGH, "addendum": 1.1}),
    (mesh.HELIX, {"helix_angle": math.radians(35.0)}, {}, {"helix_angle": math.radians(25.0)}),
    (mesh.ANGLE, {"pressure_angle": math.radians(27.0)}, {}, {}),
]


def said_of(limits: LawRange, lines):
    return [s for s in lines if f"{limits.quantity} = " in s and f"the range of {limits.law}" in s]


@pytest.mark.parametrize(("limits", "changes", "point", "inside"), OUTSIDE)
def test_a_mesh_outside_the_range_of_a_law_says_so_with_the_limit(limits, changes, point, inside):
    lines = solve_gearmesh(replace(PAIR, **changes), **{**INSIDE, **point}).warnings
    (line,) = said_of(limits, lines)
    assert any(f"{side:g}" in line for side in (limits.low, limits.high))
    near = solve_gearmesh(replace(PAIR, **inside), **INSIDE).warnings
    assert said_of(limits, near) == []


USUAL = {"input_speed": 209.4, "output_speed": 100.0, "oil_temperature": 353.15}
LOSSES = [
    ("Froude number", {"output_speed": 900.0}),
    ("Reynolds number", {"output_speed": 100.0, "oil_temperature": 253.15}),
    ("depth over diameter", {"output_immersion": 0.05}),
    ("heated and starved", {"output_speed": 240.0, "oil_temperature": 253.15}),
    ("speed times mean diameter", {"input_speed": 2200.0}),
    ("their formula falls below", {"oil_temperature": 405.0}),
    ("speed of the lip", {"input_speed": 1800.0}),
    ("viscosity ratio kappa", {}),
]


@pytest.mark.parametrize(("words", "point"), LOSSES)
def test_losses_outside_the_range_of_a_law_say_so(words, point):
    changes = {k: v for k, v in point.items() if k == "output_immersion"}
    at = {k: v for k, v in point.items() if k not in changes}
    said = solve_losses(LossesParams(**changes), **{**USUAL, **at}).warnings
    assert any(words in line for line in said)
    cool = {**USUAL, "oil_temperature": 323.15}  # kappa above 1
    assert solve_losses(LossesParams(), **cool).warnings == ()


def test_every_range_of_a_law_is_tried_here():
    assert {id(r) for r in mesh.LAW_RANGES} == {id(r) for r, *_ in OUTSIDE}
    of_trains = {id(losses.LIGHT_LOAD)}  # which know a bearing's C: tests/core/train
    assert len({id(r) for r in losses.LAW_RANGES} - of_trains) == len(LOSSES)
