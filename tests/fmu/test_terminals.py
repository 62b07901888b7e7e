"""Plugs fit: what is joined has the same kind and members, each driven by one side only."""

import pytest

from thrustwasher.fmu.interface import all_specs, variables

PLUGS = {
    f"{spec.name}.{t.name}": (t, {v.name: v for v in variables(spec)})
    for spec in all_specs()
    for t in spec.terminals
}
JOINED = [
    ("WetClutch.shaft", "ShiftTransmission.clutch"),
    ("WetClutch.shaft", "ShiftTransmission.brake"),
    ("WetClutch.shaft_capacity", "ShiftTransmission.clutch"),
    ("WetClutch.shaft_capacity", "ShiftTransmission.brake"),
    ("ThrustWasher.shaft", "ShiftTransmission.washer"),
    ("GearMesh.shaft", "ShiftTransmission.mesh"),
]


def members(plug):
    terminal, found = PLUGS[plug]
    return {member: found[name] for name, member, _ in terminal.members}


@pytest.mark.parametrize("kind", sorted({t.kind for t, _ in PLUGS.values()}))
def test_terminals_of_a_kind_have_the_same_members_in_every_fmu(kind):
    sets = {
        frozenset((member, flow) for _, member, flow in t.members)
        for t, _ in PLUGS.values()
        if t.kind == kind
    }
    assert len(sets) == 1


@pytest.mark.parametrize(("one", "other"), JOINED)
def test_what_is_joined_fits(one, other):
    assert PLUGS[one][0].kind == PLUGS[other][0].kind
    mine, theirs = members(one), members(other)
    assert mine.keys() == theirs.keys()
    for name, v in mine.items():
        assert {v.causality, theirs[name].causality} == {"input", "output"}
        assert v.unit == theirs[name].unit


def test_the_plugs_are_these():
    assert {name: set(members(name)) for name in PLUGS} == {
        "ThrustWasher.shaft": {"w", "tau", "load", "tilt"},
        "ThrustWasher.oil": {"T", "Q_flow"},
        "WetClutch.shaft": {"w", "tau", "load"},
        "WetClutch.shaft_capacity": {"w", "tau", "load"},
        "WetClutch.oil": {"T", "Q_flow"},
        "GearMesh.shaft": {"w", "tau", "load"},
        "GearMesh.oil": {"T", "Q_flow"},
        "ShiftTransmission.clutch": {"w", "tau", "load"},
        "ShiftTransmission.brake": {"w", "tau", "load"},
        "ShiftTransmission.mesh": {"w", "tau", "load"},
        "ShiftTransmission.washer": {"w", "tau", "load", "tilt"},
    }
    assert members("WetClutch.shaft")["tau"].name == "friction_torque"
    assert members("WetClutch.shaft_capacity")["tau"].name == "torque_capacity"
