"""Plugs joined by the rule alone: equal signals, flows that sum up to zero."""

import io
import zipfile
from xml.etree.ElementTree import fromstring

import pytest
from built import built_fmu
from scene_runs import instances, slow_without_jit
from ssp_master import connections, description, run
from test_ssp import FIGURES, packed, scene_of

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift.ssp.system_structure import plan, prepared, start_values

JOINED = {
    "clutch": "shaft_capacity",
    "brake": "shaft_capacity",
    "washer": "shaft",
    "mesh": "shaft",
    "ring_mesh": "shaft",
    "losses": "shafts",
}
FLOWS = ("inflow", "outflow")


def plugs_of(model, fmi):
    """Return causality of the variables of an FMU, and member -> (variable, kind) of its plugs."""
    options = {"terminals": True} if fmi == 2 else {}
    path = built_fmu(model, fmi=fmi, local=True, **options)
    with zipfile.ZipFile(io.BytesIO(path.read_bytes())) as archive:
        description, terminals = (
            fromstring(archive.read(name))
            for name in ("modelDescription.xml", "terminalsAndIcons/terminalsAndIcons.xml")
        )
    causes = {v.get("name"): v.get("causality") for v in description.find("ModelVariables")}
    plugs = {
        t.get("name"): {
            m.get("memberName"): (m.get("variableName"), m.get("variableKind")) for m in t
        }
        for t in terminals.find("Terminals")
    }
    return causes, plugs


def joined(one, other):
    """Return wires (part, output, part, input, factor) between two plugs.

    Each is given as name of the part, causalities, members.
    """
    (_, _, mine), (_, _, theirs) = one, other
    assert mine.keys() == theirs.keys()
    for member in mine:
        ends = [(name, causes, *members[member]) for name, causes, members in (one, other)]
        ends.sort(key=lambda end: end[1][end[2]] == "input")
        (source, gives, output, kind), (target, takes, into, wanted) = ends
        assert (gives[output], takes[into]) == ("output", "input")
        assert (kind in FLOWS) == (wanted in FLOWS)
        yield source, output, target, into, -1.0 if kind == wanted and kind in FLOWS else 1.0


def wires_by_plugs(system, fmi):
    """Return the wires between the transmission and the friction parts of a system."""
    causes, plugs = plugs_of("ShiftTransmission", fmi)
    for part in system.components:
        if part.name in JOINED:
            own, terminals = plugs_of(part.spec.kind, fmi)
            yield from joined(
                ("transmission", causes, plugs[part.name]),
                (part.name, own, terminals[JOINED[part.name]]),
            )


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.slow
def test_all_plugs_together_are_the_wires_of_the_scene(fmi):
    """Two meshes of one kind share speed and load; what no plug has is not of a flange."""
    system = plan(prepared(scene_of("planetary")), {})
    by_plugs = set(wires_by_plugs(system, fmi))
    own = {tuple(k) for k in system.links}
    assert {factor for *_, factor in by_plugs} == {1.0}
    assert {wire[:4] for wire in by_plugs} <= own
    left = {wire[3] for wire in own - {wire[:4] for wire in by_plugs}}
    assert left <= {"shift_command", "drum_speed", "far_face_temperature"}


@slow_without_jit
@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.slow
def test_packs_joined_by_their_plugs_make_the_shift_of_the_scene(fmi):
    scene = scene_of("brake-test")
    system = plan(prepared(scene), start_values(prepared(scene), instances(scene)))
    root = description(packed(system))
    plugged = list(wires_by_plugs(system, fmi))
    rest = [
        w for w in connections(root) if w[0] and w[2] and w not in {wire[:4] for wire in plugged}
    ]
    assert {wire[3] for wire in rest} <= {"shift_command", "drum_speed"}

    def shift(wires):
        return run(root, {p.name: DirectInstance(p.spec) for p in system.components}, wires)

    by_plugs, own = shift([*plugged, *((*wire, 1.0) for wire in rest)]), shift(None)
    for figure in FIGURES:
        assert by_plugs[f"transmission.{figure}"] == own[f"transmission.{figure}"]
