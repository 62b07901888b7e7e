"""A shift as an SSP package: valid, complete, and the same run under another master."""

import io
import re
import zipfile
from functools import cache
from pathlib import Path

import pytest
from scene_runs import instances as direct_instances
from scene_runs import slow_without_jit
from ssp_master import NS, bound, components, connections, description, run, values

from thrustwasher.errors import ParameterError
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.model.unread import unread
from thrustwasher.native.files import zipped
from thrustwasher.shift import cosimulate, load_scene
from thrustwasher.shift.ssp.changed_values import changed
from thrustwasher.shift.ssp.package import files
from thrustwasher.shift.ssp.system_structure import plan, prepared, start_values

SCENES = ("msl", "brake-test", "planetary-sun", "planetary", "judder")
FILES = ("SystemStructure.ssd", "Open.ssd", "Parts.ssd")
FIGURES = ("lock_time", "lock_speed", "clutch_heat", "brake_heat", "engine_speed")
ENOUGH = {"msl": 2.3, "brake-test": 1.6}  # s: past lock-up


def scene_of(name):
    """Return a scene up to just after its lock-up."""
    return load_scene(name).with_options(stop_time=ENOUGH.get(name))


def planned(name, starts=None):
    return plan(prepared(load_scene(name)), starts or {})


def packed(system):
    return zipped(files(system, tool="thrustwasher", date="2026-01-01T00:00:00Z"))


@cache
def package_of(name):
    return packed(planned(name))


@cache
def schema(name):
    import fmpy.ssp
    from lxml import etree

    return etree.XMLSchema(file=str(Path(fmpy.ssp.__file__).parent / "schema" / name))


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("file", FILES)
def test_the_description_is_valid(name, file):
    from lxml import etree

    with zipfile.ZipFile(io.BytesIO(package_of(name))) as zipped_files:
        root = etree.fromstring(zipped_files.read(file))
    whole, inline = (schema(f"SystemStructure{n}.xsd") for n in ("Description", "ParameterValues"))
    assert whole.validate(root), whole.error_log
    sets = root.findall(".//ssv:ParameterSet", NS)
    parts = len(planned(name).components)
    assert len(sets) == {"SystemStructure.ssd": 1 + parts, "Open.ssd": parts, "Parts.ssd": 0}[file]
    for found in sets:
        alone = etree.fromstring(etree.tostring(found))
        assert inline.validate(alone), inline.error_log


UNITS = (("SystemStructureDescription", "ssd"), ("ParameterSet", "ssv"))


def undefined_units(root):
    """Return the units that a file or a set of values refers to and does not define itself.

    The standard's text, section 6 (SSP 1.0 and 2.0), which no schema checks: the units of the
    enclosing file are none of an inline set.
    """
    found = []
    for name, space in UNITS:
        for scope in root.iter(f"{{{NS[space]}}}{name}"):
            known = {u.get("name") for u in scope.findall(f"{space}:Units/ssc:Unit", NS)}
            own = "ssv" if space == "ssv" else "ssc"
            used = {r.get("unit") for r in scope.iter(f"{{{NS[own]}}}Real")}
            found += sorted(used - known - {None})
    return found


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("file", FILES)
def test_every_set_of_values_defines_the_units_it_refers_to(name, file):
    root = description(package_of(name), file)
    assert undefined_units(root) == []
    for found in root.iter(f"{{{NS['ssv']}}}ParameterSet"):
        found.remove(found.find("ssv:Units", NS))
    assert bool(undefined_units(root)) == (file != "Parts.ssd")  # the check finds what is missing


@pytest.mark.parametrize("file", FILES)
def test_masters_find_the_step_in_the_notes_they_look_in(file):
    root = description(package_of("planetary-sun"), file)
    notes = {a.get("type"): a for a in root.iter(f"{{{NS['ssc']}}}Annotation")}
    places = {
        "org.openmodelica": ("FixedStepMaster", "stepSize"),
        "com.opensimulationplatform": ("FixedStepAlgorithm", "baseStepSize"),
        "com.avl.model.connect.ssp.task": ("Task", "deltaTime"),
    }
    found = {notes[of].find(f".//{{*}}{tag}").get(key) for of, (tag, key) in places.items()}
    assert found == {"0.001"}
    task = next(root.iter("{com.avl.model.connect.ssp.task}Task"))
    assert (task.get("stepType"), task.get("endType")) == ("parallel_single_thread", "end_time")


@pytest.mark.parametrize("name", SCENES)
def test_every_parameter_of_the_scene_that_is_used_stands_in_the_package(name):
    scene = prepared(load_scene(name))
    found = bound(description(package_of(name)))
    assert set(found) == {"command", *scene.parts}
    for part, given in scene.parts.items():
        told = found[part]
        numbers = {k: v for k, v in given.parameters().items() if not isinstance(v, str)}
        idle = {k for k in numbers if unread(given.params, k, given.fidelity)}
        if part == "transmission":
            numbers["torque_age"] = 0
        assert {k: told.get(k) for k in numbers} == {**numbers, **dict.fromkeys(idle)}
        assert {s.name for s in given.spec.inputs} <= set(told)
        if part != "transmission":
            assert told["oil_temperature"] == scene.oil_temperature


def test_a_package_has_no_bindings_of_what_points_and_switches_overrule():
    """Six points of engine torque, pressure of pistons, a rigid shaft: see the scene's file."""
    told = bound(description(package_of("planetary")))["transmission"]
    assert told["engine_torque_points"] == 6 and "engine_torque_6" in told
    idle = {"engine_torque", "engine_torque_7", "clutch_force", "brake_force", "vehicle_inertia"}
    assert not idle & told.keys()


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("file", ["SystemStructure.ssd", "Open.ssd"])
def test_the_system_shows_parameters_that_act_with_the_values_of_their_parts(name, file):
    """Whoever opens it changes an engine torque without opening a part."""
    system = planned(name)
    root = description(packed(system), file)
    top = root.find("ssd:System", NS)
    above = values(top.find("ssd:ParameterBindings", NS))
    wired = {given: (part, into) for source, given, part, into in connections(root) if not source}
    shown = {c.get("name"): c.get("kind") for c in top.findall("ssd:Connectors/ssd:Connector", NS)}
    parameters = {n for n, kind in shown.items() if kind == "parameter"}
    inputs = {n for n, kind in shown.items() if kind == "input"}
    assert above.keys() == parameters | inputs and len(parameters) >= 3
    defaults = {p.name: p.parameters for p in system.components}
    assert all(above[n] == defaults[wired[n][0]][wired[n][1]] for n in parameters)
    has_source = file == "SystemStructure.ssd"
    assert ("shift_start" in parameters) == has_source == ("command" in components(root))
    assert has_source or inputs == {"oil_temperature", "engine_torque_input", "shift_command"}
    assert has_source or above["oil_temperature"] == system.scene.oil_temperature
    assert has_source or above["shift_command"] == system.scene.shift_from


@pytest.mark.parametrize("name", SCENES)
def test_defaults_are_for_late_values_and_those_written_for_fresh_ones(name):
    system = planned(name)
    found = components(description(packed(system)))
    defaults = {p.name: p.parameters for p in system.components}
    assert defaults["command"]["lead"] == system.scene.step
    assert defaults["transmission"]["torque_age"] == 1
    assert values(found["command"])["lead"] == values(found["transmission"])["torque_age"] == 0


@pytest.mark.parametrize("file", FILES)
def test_a_plain_package_has_connectors_of_real_numbers_and_no_booleans(file):
    """For ovfmi, estim8, sofirpy, which stop at any other type."""
    told = dict(tool="thrustwasher", date="2026-01-01T00:00:00Z")
    made = files(planned("planetary-sun"), plain=True, **told)
    root = description(zipped(made), file)
    kinds = {c[0].tag.rpartition("}")[2] for c in root.iter(f"{{{NS['ssd']}}}Connector")}
    assert kinds == {"Real"}
    values = {p[0].tag.rpartition("}")[2] for p in root.iter(f"{{{NS['ssv']}}}Parameter")}
    assert values == (set() if file == "Parts.ssd" else {"Real", "Integer"})


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("file", FILES)
def test_connections_join_connectors_of_one_kind_and_unit(name, file):
    root = description(package_of(name), file)
    system = root.find("ssd:System", NS)
    places = {None: system, **components(root)}
    found = {
        (part, c.get("name")): (c.get("kind"), c[0].tag, c[0].get("unit"))
        for part, element in places.items()
        for c in element.findall("ssd:Connectors/ssd:Connector", NS)
    }
    fed = set()
    for source, output, target, into in connections(root):
        a, b = found[source, output], found[target, into]
        assert a[1:] == b[1:]
        assert a[0] == b[0] if source is None or target is None else a[0] == "output"
        fed.add((target, into))
    inputs = {key for key, (kind, *_) in found.items() if kind in ("input", "parameter")}
    assert {key for key in inputs if key[0]} <= fed
    if file != "Open.ssd":
        assert not any(name == "oil_temperature" for _, name in found)
        assert not any(found[key][0] == "input" for key in inputs if key[0] is None)
    units = {u.get("name") for u in root.findall("ssd:Units/ssc:Unit", NS)}
    assert {unit for *_, unit in found.values() if unit} <= units
    assert all(p.get("unit") in units for p in root.iter(f"{{{NS['ssv']}}}Real"))
    # OMSimulator takes "part.connector" apart by its first word and stops at an enumeration.
    border = {c.get("name") for c in system.findall("ssd:Connectors/ssd:Connector", NS)}
    assert not border & set(places) and (border or file == "Parts.ssd")
    assert not [e.tag for e in root.iter() if "Enumeration" in e.tag]


@pytest.mark.parametrize("name", SCENES)
def test_defaults_of_the_parts_are_the_scenes(name):
    """A master that ignores the values in the package runs the same scene."""
    for part in planned(name).components:
        with DirectInstance(part.spec) as plain:
            given = DirectInstance(part.spec, parameters=part.parameters)
            assert plain.get(list(part.parameters)) == given.get(list(part.parameters))
            assert {s.name: s.start for s in part.spec.inputs} == part.starts


def test_a_value_that_is_set_stands_where_every_master_reads_it():
    """In the FMU's start values and in the package: FMPy reads the first alone."""
    told = {
        "clutch.friction_scale": "0.9",
        "engine_torque_1": "200",
        "command.start": "50 ms",
        "washer.thermal_mode": "transient",
    }
    scene = changed(load_scene("planetary"), told)
    system = plan(prepared(scene), {})
    starts = {p.name: p.parameters for p in system.components}
    read = bound(description(packed(system)))
    for found in (starts, read):
        assert found["clutch"]["friction_scale"] == 0.9
        assert found["transmission"]["engine_torque_1"] == 200.0
        assert found["command"]["start"] == 0.05
    assert starts["washer"]["thermal_mode"] == "transient"  # no enumerations in a package
    assert starts["brake"]["friction_scale"] == 1.0


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"clutch.friction_scal": "1"}, "did you mean clutch.friction_scale"),
        ({"clutch.friction_scale": "-1"}, "clutch.friction_scale = -1"),
        ({"engine_torque": "200"}, "not used in this scene, see engine_torque_points"),
        ({"clutch.friction_scale": "much"}, "clutch.friction_scale"),
    ],
)
def test_a_value_that_cannot_be_set_is_named(given, said):
    with pytest.raises(ParameterError, match=said):
        changed(load_scene("planetary"), given)


def test_the_page_names_parts_step_and_delay():
    page = files(planned("planetary-sun"), tool="thrustwasher 9", date="2026-01-01T00:00:00Z")
    text = page["documentation/index.html"].decode()
    for word in ("0.001 s", "torque_age", "WetClutch", "washer_temperature_max", "Parts.ssd"):
        assert word in text
    assert "http" not in text and "<script" not in text


def test_the_package_has_the_same_bytes_for_the_same_scene_and_a_sequence_has_none():
    assert packed(planned("msl")) == packed(planned("msl"))
    with pytest.raises(ParameterError, match="one shift"):
        planned("duty-cycle")


@slow_without_jit
@pytest.mark.parametrize("name", [pytest.param("msl", marks=pytest.mark.slow), "brake-test"])
@pytest.mark.slow
def test_a_master_that_passes_values_on_until_they_agree_runs_the_shift_of_this_package(name):
    """As OMSimulator's fixed-step master: it takes the values in the package over, then reads every
    output after it has set the inputs it depends on."""
    scene = scene_of(name)
    system = plan(prepared(scene), start_values(prepared(scene), direct_instances(scene)))
    root = description(packed(system))
    parts = {}
    for p in system.components:
        given = {k: v for k, v in bound(root)[p.name].items() if k in p.parameters}
        parts[p.name] = DirectInstance(p.spec, parameters=given)
    row = run(root, parts)
    own = cosimulate(scene, direct_instances(scene)).signals
    for figure in FIGURES:
        key = f"transmission.{figure}"
        assert row[key] == pytest.approx(own[key][-1], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("name", ["mein gang", "Gang-ä", "a&b", "shift.v2", "1st", "変速"])
def test_the_system_has_a_name_that_masters_take_and_the_title_keeps_the_words(name, tmp_path):
    path = tmp_path / f"{name}.toml"
    path.write_text('base = "msl"\ntitle = "My words"\n', "utf-8")
    made = files(
        plan(prepared(load_scene(path)), {}), tool="thrustwasher", date="2026-01-01T00:00Z"
    )
    from lxml import etree

    for file in FILES:
        root = etree.fromstring(made[file])
        assert re.fullmatch("[A-Za-z][A-Za-z0-9_]*", root.get("name"))
        assert root.find("ssd:System", NS).get("name") == root.get("name")
        assert root.get("description") == f"{name}: My words"
