"""Which inputs of the models move which outputs at once, as their descriptions say."""

import random

import pytest
from sampling import jump

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.stepper import DirectInstance
from thrustwasher.model.registry import all_specs, find_spec

H = 1e-3
NAMES = [spec.name for spec in all_specs()]
# Only by the heat of a starved gap, on a step along a straight profile of inputs.
FILM = "film_ratio film_thickness contact_torque contact_share viscosity friction_coefficient"
UNSEEN = {"WetClutch": {("drum_speed", name) for name in FILM.split()}}
UNSEEN["WetClutch"] |= {(name, "slip_bound") for name in ("load", "speed")}  # of a pack that knows
# Parameters under which different inputs act at once.
STANDINGS = {
    "ThrustWasher": [{"gear_far_face": "bulk"}, {"gear_far_face": "oil"}],
    # every mode of both packs
    "ShiftTransmission": [
        {"initial_engine_speed": 300.0},  # first gear: the brake holds
        {"initial_engine_speed": 300.0, "initial_drum_speed": 300.0},  # second gear
        {"initial_engine_speed": 0.0},  # at rest: both may hold
        {"initial_engine_speed": 300.0, "initial_drum_speed": 50.0},  # both slip
        {"actuation": "pressure"},
    ],
    "WetClutch": [
        {},
        {"starts_pressed": True},
        {"fidelity": "stribeck", "friction_law": "wang", "shear_temperature_slope": 1e-3},
        {"input_profile": "linear", "friction_law": "wang", "shear_temperature_slope": 1e-3},
    ],
    # endurance is the paper's, a safety against micropitting needs its limit, so does the root's
    "DrivelineLosses": [
        {"input_immersion": 0.1, "drum_immersion": 0.1, "drum_seal_diameter": 0.05}
    ],
    "GearTrain": [
        {"meshes": 3, "shaft_1_axial": "pushed"},
        {"shaft_2_axial": "O", "shaft_3_force_1_radial": 3e3, "shaft_3_force_1_axial": 1e3},
    ],
    "GearMesh": [
        {"permissible_film_ratio": 0.3, "root_limit": 430e6},
        {"film_heat": "atan", "steel": "AISI4340"},
    ],
}
CASES = {
    "ThrustWasher": 40,
    "WetClutch": 200,
    "GearMesh": 100,
    "GearTrain": 20,
    "ShiftTransmission": 600,
}


HEATS = {f"heat_{i}": f"energy_{i}" for i in range(1, 8)}
TAKEN_ONE_WAY = HEATS | {energy: heat for heat, energy in HEATS.items()}


def one_way(spec, rng, values):
    """Return the values in order; the sump takes the heat of a part as power or as energy."""
    for heat, energy in HEATS.items():
        if heat in values:
            values[rng.choice([heat, energy])] = 0.0
    return list(values.values())


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.slow
def test_only_listed_inputs_move_an_output_at_once_and_all_of_them_the_real_ones(name):
    spec, rng = find_spec(name), random.Random(5)
    standings = STANDINGS.get(name, [{}])
    seen, far = set(), 0.2 if name == "ShiftTransmission" else 0.0  # where packs stick
    for case in range(CASES.get(name, 5)):
        given = standings[case % len(standings)]
        if name == "ShiftTransmission":
            bearings = {f"{gear}_bearing_coefficient": 0.02 for gear in ("sun", "ring")}
            given = given | {"ring_mesh": True} | bearings
            given |= {"needle_count": 18 * (case % 2)}
        with DirectInstance(spec, parameters=given) as direct:
            point = one_way(spec, rng, jump(spec, rng, far))
            direct.initialize(inputs=dict(zip(direct.input_names, point, strict=True)))
            for i in range(rng.choice([0, 5])):  # at the start too
                direct.step(i * H, H)
            for i, signal in enumerate(spec.inputs):
                direct.set_inputs(point)
                before = direct.outputs()
                changed = list(point)
                can_be_nothing = name == "ShiftTransmission" and rng.random() < 0.1
                changed[i] = 0.0 if can_be_nothing else jump(spec, rng, far)[signal.name]
                if signal.name in TAKEN_ONE_WAY:  # the other way says nothing meanwhile
                    changed[direct.input_names.index(TAKEN_ONE_WAY[signal.name])] = 0.0
                direct.set_inputs(changed)
                pairs = zip(spec.outputs, before, direct.outputs(), strict=True)
                seen |= {(signal.name, output.name) for output, a, b in pairs if a != b}
    listed = {(i, v.name) for v in interface(spec).variables for i in v.depends}
    real = {signal.name for signal in spec.outputs if signal.kind == "real"}
    assert seen <= listed
    assert {pair for pair in listed - seen if pair[1] in real} == UNSEEN.get(name, set())
