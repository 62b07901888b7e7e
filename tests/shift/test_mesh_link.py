"""A gear mesh in the scene is taken: it gets torque and speed, and its loss enters the book."""

from dataclasses import replace

import pytest
from scene_runs import instances

from thrustwasher.clutch.parameters import ClutchParams
from thrustwasher.model.spec import ModelSpec, Signal
from thrustwasher.shift import Part, load_scene, run_shift

SPEC = ModelSpec(
    key="mesh",
    name="StandIn",
    help="loss in proportion to torque",
    params=ClutchParams,
    fidelities={"closed": "constant share"},
    default_fidelity="closed",
    inputs=tuple(
        Signal(name=n, unit="1", help="", start=0.0) for n in ("load", "speed", "oil_temperature")
    ),
    outputs=(Signal(name="friction_torque", unit="N.m", help=""),),
    kernel="none",
)
LOSS = 0.01


class StandInMesh:
    input_names = ("load", "speed", "oil_temperature")
    output_names = ("friction_torque",)
    calls, wall_time, instantiate_time, initialize_time = 0, 0.0, 0.0, 0.0

    def initialize(self, start_time, inputs):
        self.load = inputs["load"]

    def set_inputs(self, values):
        self.load = values[0]

    def step(self, t, h):
        self.calls += 1

    def outputs(self):
        return [LOSS * self.load]


def test_a_mesh_is_wired_and_its_heat_is_booked():
    scene = load_scene("planetary-sun").with_options(stop_time=0.1)
    parts = instances(scene) | {"mesh": StandInMesh()}
    mesh = Part(spec=SPEC, fidelity="closed", params=ClutchParams())
    r = run_shift(replace(scene, parts=scene.parts | {"mesh": mesh}), parts)
    torque, spin = (r.signals[f"transmission.mesh_{n}"] for n in ("load", "speed"))
    assert (r.signals["mesh.load"][1:] == torque[:-1]).all()
    # Sun and ring mesh of four planets: the ring's share is (1/18 - 1/66)/(1/18 + 1/30).
    meshes = 4 * (1 + (1 / 18 - 1 / 66) / (1 / 18 + 1 / 30))
    assert meshes == pytest.approx(4 * 1.4545, abs=1e-3)
    power = meshes * LOSS * torque * spin
    booked = ((power[1:] + power[:-1]) / 2 * r.step).sum()
    assert r.energy["meshes"] == pytest.approx(booked, rel=2e-3)
    assert r.energy["residual_share"] < 1e-9
    assert not any("gear mesh" in m for m in r.messages)
