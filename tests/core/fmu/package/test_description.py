"""modelDescription.xml of both FMI versions against schemas and the list it is made from; plugs."""

import fnmatch
import re
from functools import cache
from pathlib import Path

import fmpy
import pytest
from fmpy import read_model_description
from lxml import etree
from toy.spec import SPEC as TOY

from thrustwasher.errors import EnvironmentProblem
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.description.model_description import (
    REAL_TYPES,
    declared_type,
    description,
    generation_date,
    terminals_and_icons,
)
from thrustwasher.model.registry import all_specs

IDENTIFIERS = re.compile(r"[A-Za-z_]\w*\.[A-Za-z_]\w*")  # of the structured naming convention
SCHEMAS = Path(fmpy.__file__).parent / "schema"
SPECS = [TOY, *all_specs()]
each_spec = pytest.mark.parametrize("spec", SPECS, ids=lambda s: s.name)
each_fmi = pytest.mark.parametrize("fmi", [2, 3])


def written(spec, fmi=2, **options):
    """Return a description, which tests share: they only read it."""
    return tree_of(spec.name, fmi, **options)


@cache
def tree_of(name, fmi, **options):
    (spec,) = (s for s in SPECS if s.name == name)
    return etree.fromstring(description(interface(spec), fmi=fmi, guid="0", **options))


def as_built(spec, fmi, native):
    """Return the description of an FMU for Python, or of a native one, model exchange included."""
    return written(spec, fmi, derivatives=native, moving=native, exchange=native)


@cache
def schema_of(fmi, name="ModelDescription"):
    return etree.XMLSchema(etree.parse(SCHEMAS / f"fmi{fmi}" / f"fmi{fmi}{name}.xsd"))


@each_spec
@each_fmi
@pytest.mark.parametrize("native", [False, True])
def test_the_description_keeps_to_the_schema(spec, fmi, native):
    tree, schema = as_built(spec, fmi, native), schema_of(fmi)
    assert schema.validate(tree), schema.error_log


@each_spec
def test_the_terminals_keep_to_the_schema_and_name_variables(spec):
    schema = schema_of(3, "TerminalsAndIcons")
    tree = etree.fromstring(terminals_and_icons(interface(spec)))
    assert schema.validate(tree), schema.error_log
    members = {e.get("variableName") for e in tree.iter("TerminalMemberVariable")}
    assert members and members <= {v.name for v in interface(spec).variables}


@each_spec
def test_every_variable_is_written_as_it_is_listed(spec):
    read = written(spec).findall("ModelVariables/ScalarVariable")
    assert len(read) == len(interface(spec).variables)
    for element, v in zip(read, interface(spec).variables, strict=True):
        assert element.get("name") == v.name
        assert int(element.get("valueReference")) == v.reference
        assert element.get("variability") == v.variability
        (body,) = element
        assert body.tag == v.type
        gone = v.type_name == "Fidelity" and spec.successors
        ends = () if gone else (("min", v.low), ("max", v.high))
        for attribute, value in (*ends, ("start", v.start)):
            given = body.get(attribute)
            if v.type != "Boolean":
                assert (None if given is None else float(given)) == value, (v.name, attribute)
        if v.type == "Real":
            assert body.get("unit") == v.unit


@each_spec
def test_units_types_and_enumerations_that_are_used_are_defined(spec):
    tree = written(spec)
    units = {e.get("name") for e in tree.iter("Unit")}
    types = {e.get("name") for e in tree.iter("SimpleType")}
    for body in tree.findall("ModelVariables/ScalarVariable/*"):
        assert body.get("unit") in {None, *units}
        assert body.get("declaredType") in {None, *types}
    assert set(interface(spec).enumerations) <= types


@each_spec
def test_a_temperature_difference_is_not_shown_as_a_temperature(spec):
    relative = [v for v in interface(spec).variables if v.relative]
    for body in written(spec).findall("ModelVariables/ScalarVariable/Real"):
        name = body.getparent().get("name")
        assert (body.get("relativeQuantity") == "true") == (name in {v.name for v in relative})
    for v in relative:
        assert "displayUnit" not in REAL_TYPES[declared_type(v)]


@each_spec
def test_structure_lists_outputs_with_their_inputs_and_initial_unknowns_with_parameters(spec):
    tree = written(spec)
    found = interface(spec).variables
    outputs = [v for v in found if v.causality == "output"]
    parameters = {v.name for v in found if v.causality == "parameter"}
    inputs = {v.name for v in found if v.causality == "input"}
    for part, extra in (("Outputs", set()), ("InitialUnknowns", parameters)):
        unknowns = tree.findall(f"ModelStructure/{part}/Unknown")
        assert [int(u.get("index")) for u in unknowns] == [v.reference + 1 for v in outputs]
        for unknown, v in zip(unknowns, outputs, strict=True):
            needed, known = {*v.depends, *extra}, unknown.get("dependencies")
            if known is None:  # which says: on everything
                assert part == "InitialUnknowns" and needed == {*inputs, *parameters}
                continue
            numbers = [int(n) for n in known.split()]
            assert {found[n - 1].name for n in numbers} == needed
            assert numbers == sorted(numbers)
            assert unknown.get("dependenciesKind") is None  # which says: all dependent


@each_spec
@each_fmi
def test_no_description_is_larger_than_150_kb(spec, fmi):
    """Hosts read it whole; the train's, of 545 variables, was 740 kB and then 221."""
    assert len(etree.tostring(as_built(spec, fmi, native=True), encoding="utf-8")) <= 150_000


@each_fmi
def test_what_is_left_out_is_what_the_first_body_of_a_kind_says(fmi):
    """A mesh, shaft or bearing has the descriptions of the first one."""
    (spec,) = (s for s in SPECS if s.key == "train")
    found = {
        v.get("name"): v.get("description")
        for v in as_built(spec, fmi, True).find("ModelVariables")
    }
    silent = {name for name, text in found.items() if text is None}
    assert {"mesh_2_hand", "mesh_3_loss", "shaft_1_bearing_2_type"} <= silent
    assert all(found[re.sub(r"_\d_", "_1_", name)] for name in silent)


@each_spec
def test_the_default_experiment_has_at_most_a_thousand_steps(spec):
    experiment = written(spec).find("DefaultExperiment")
    assert float(experiment.get("stopTime")) <= 1000 * float(experiment.get("stepSize"))


def test_the_date_comes_from_the_environment_and_ends_with_z(monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    assert generation_date() == "2023-11-14T22:13:20Z"
    monkeypatch.delenv("SOURCE_DATE_EPOCH")
    assert generation_date() == generation_date()
    assert generation_date().endswith("Z")


@pytest.mark.parametrize("given", ["99999999999999", "253402300800", "9" * 30, "-1", "1e9", "soon"])
def test_a_date_that_cannot_be_written_is_refused(given, monkeypatch):
    """The last second that the format has is that of 9999-12-31."""
    monkeypatch.setenv("SOURCE_DATE_EPOCH", given)
    with pytest.raises(EnvironmentProblem, match=r"SOURCE_DATE_EPOCH = .* 0 \.\. 253402300799"):
        generation_date()
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "253402300799")
    assert generation_date() == "9999-12-31T23:59:59Z"


@each_spec
def test_every_variable_says_the_same_in_both_versions(spec):
    types = {"Real": "Float64", "Integer": "Int32"}
    old = written(spec).findall("ModelVariables/ScalarVariable")
    new = list(written(spec, 3).find("ModelVariables"))
    for scalar, variable in zip(old, new, strict=True):
        (body,) = scalar
        assert variable.tag == types.get(body.tag, body.tag)
        said = dict(variable.attrib)
        of_three = {name: said.pop(name, "false") for name in ["intermediateUpdate"]}
        assert said == {**scalar.attrib, **body.attrib}
        is_real_output = variable.tag == "Float64" and scalar.get("causality") == "output"
        assert of_three == {"intermediateUpdate": str(is_real_output).lower()}


@each_spec
def test_units_categories_and_experiment_are_the_same_in_both_versions(spec):
    old, new = written(spec), written(spec, 3)
    for part in ("UnitDefinitions", "LogCategories", "DefaultExperiment"):
        assert etree.tostring(old.find(part)) == etree.tostring(new.find(part))


@each_spec
def test_types_and_their_items_are_the_same_in_both_versions(spec):
    def said(simple):
        head = {**simple.attrib, **(simple[0].attrib if simple.tag == "SimpleType" else {})}
        return head, [dict(item.attrib) for item in simple.iter("Item")]

    old, new = (list(written(spec, v).find("TypeDefinitions")) for v in (2, 3))
    assert [said(t) for t in old] == [said(t) for t in new]
    assert {t.tag for t in new} <= {"Float64Type", "EnumerationType"}


@each_spec
def test_the_structure_is_that_of_fmi_2_by_value_references(spec):
    def listed(tree, path, key, offset):
        return [
            (
                int(u.get(key)) - offset,
                [int(n) - offset for n in u.get("dependencies", "").split()],
                "dependencies" in u.attrib,
            )
            for u in tree.findall(f"ModelStructure/{path}")
        ]

    old, new = written(spec), written(spec, 3)
    for two, three in (
        ("Outputs/Unknown", "Output"),
        ("InitialUnknowns/Unknown", "InitialUnknown"),
    ):
        assert listed(old, two, "index", 1) == listed(new, three, "valueReference", 0)


MOVING = {2: {"canInterpolateInputs"}, 3: {"providesIntermediateUpdate"}}
STATES_2 = {"canGetAndSetFMUstate", "canSerializeFMUstate"}
STATES_3 = {"canGetAndSetFMUState", "canSerializeFMUState"}
VARIABLE = "canHandleVariableCommunicationStepSize"
CAN = {
    2: {*STATES_2, VARIABLE, "canNotUseMemoryManagementFunctions"},
    3: {*STATES_3, VARIABLE, "hasEventMode", "providesIntermediateUpdate"},
}
DERIVATIVES = {
    2: {"providesDirectionalDerivative"},
    3: {"providesDirectionalDerivatives", "providesAdjointDerivatives"},
}


@each_spec
@each_fmi
@pytest.mark.parametrize("native", [False, True])
def test_the_flags_are_these(spec, fmi, native):
    tree = as_built(spec, fmi, native)
    flags = dict(tree.find("CoSimulation").attrib)
    assert flags.pop("modelIdentifier") == spec.name
    assert flags.pop("maxOutputDerivativeOrder") == "0"
    can = {flag for flag, said in flags.items() if said == "true"}
    early = {"mightReturnEarlyFromDoStep"} if fmi == 3 and interface(spec).switches else set()
    more = DERIVATIVES[fmi] | (MOVING[fmi] if spec.inputs else set())
    assert can == CAN[fmi] | early | (more if native else set())
    assert {flags[flag] for flag in flags.keys() - can} == {"false"}


@each_spec
def test_the_two_targets_of_fmi_2_differ_in_guid_and_two_flags_only(spec):
    python = description(interface(spec), fmi=2, guid="a")
    native = description(interface(spec), fmi=2, guid="b", derivatives=True, moving=True)
    back = native.replace(b'guid="b"', b'guid="a"')
    for flag in (b'providesDirectionalDerivative="%s"', b'canInterpolateInputs="%s"'):
        back = back.replace(flag % b"true", flag % b"false")
    assert back == python != native


@each_spec
def test_in_fmi_3_inputs_may_be_set_and_outputs_read_within_a_step(spec):
    tree = written(spec, 3, moving=True).find("ModelVariables")
    marked = [v for v in tree if v.get("intermediateUpdate") == "true"]
    inputs = [v.get("name") for v in marked if v.get("causality") == "input"]
    assert sorted(inputs) == sorted(s.name for s in spec.inputs)
    outputs = [v.get("name") for v in marked if v.get("causality") == "output"]
    assert len(inputs) + len(outputs) == len(marked)
    assert sorted(outputs) == sorted(s.name for s in spec.outputs if s.kind == "real")


def test_a_reader_sees_degrees_celsius_rpm_and_micrometres(fmus):
    description = read_model_description(str(fmus["ThrustWasher"]))
    shown = {v.name: v for v in description.modelVariables}
    assert shown["oil_temperature"].declaredType.displayUnit == "degC"
    assert shown["film_thickness"].displayUnit == "um"
    units = {u.name: {d.name: d for d in u.displayUnits} for u in description.unitDefinitions}
    assert float(units["rad/s"]["rpm"].factor) == pytest.approx(9.549296585513721, rel=1e-15)
    assert float(units["K"]["degC"].offset) == -273.15


PLUGS = {
    f"{spec.name}.{t.name}": (t, {v.name: v for v in interface(spec).variables})
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
    ("GearMesh.shaft", "ShiftTransmission.ring_mesh"),
    *(
        (f"{name}.{plug}", f"OilSump.part_1{plug.removeprefix('oil')}")
        for name in ("ThrustWasher", "WetClutch", "GearMesh")
        for plug in ("oil", "oil_by_energy")
    ),
]


def members(plug):
    terminal, found = PLUGS[plug]
    return {member: found[name] for name, member, _ in terminal.members}


def kinds(plug):
    return {member: kind for _, member, kind in PLUGS[plug][0].members}


@pytest.mark.parametrize("kind", sorted({t.kind for t, _ in PLUGS.values()}))
def test_terminals_of_a_kind_have_the_same_members_in_every_fmu(kind):
    """Torque and heat flow out of parts that make them; all else counts in one sense."""
    sets = {
        frozenset(
            (member, flow.removeprefix("out").removeprefix("in")) for _, member, flow in t.members
        )
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


@pytest.mark.parametrize(("one", "other"), JOINED)
def test_what_flows_out_of_a_part_flows_into_the_other_without_a_change_of_sign(one, other):
    opposite = {"outflow": "inflow", "signal": "signal"}
    assert {m: opposite[k] for m, k in kinds(one).items()} == kinds(other)
    assert "outflow" in kinds(one).values()


def test_an_engine_drives_the_input_shaft_and_the_output_shaft_drives_a_vehicle():
    """Torque along the speed of a shaft brings power in where it flows in."""
    plugs = {n: f"ShiftTransmission.{n}" for n in ("input_shaft", "output_shaft")}
    flows = {n: (members(p)["tau"].name, kinds(p)["tau"]) for n, p in plugs.items()}
    assert flows == {
        "input_shaft": ("engine_torque_input", "inflow"),
        "output_shaft": ("load_torque_input", "outflow"),
    }


@each_spec
def test_each_parameter_has_a_second_name_with_its_group_in_fmi_3_and_a_group_in_fmi_2(spec):
    """All but the fidelity and, of a shift, the oil's temperature; no name occurs twice."""
    shown = interface(spec)
    plain = [v.name for v in shown.parameters]
    elements = {e.get("name"): e for e in written(spec, 3).find("ModelVariables")}
    second = {n: a.get("name") for n in plain for a in elements[n].findall("Alias")}
    listed = written(spec).findall("VendorAnnotations/Tool/Groups/Group")
    grouped = {
        n: g.get("name")
        for g in listed
        for pattern in g.get("parameters").split()
        for n in fnmatch.filter(plain, pattern)
    }
    alike = {n for n in grouped if re.match(r"(mesh|shaft)_\d_", n)}  # the plain name says it
    assert {n: name.split(".")[0] for n, name in second.items()} == {
        n: group for n, group in grouped.items() if n not in alike
    }
    names = [*(v.name for v in shown.variables), *second.values()]
    assert len(set(names)) == len(names) and all(map(IDENTIFIERS.fullmatch, second.values()))
    if spec is not TOY:
        assert set(plain) - second.keys() - alike <= {"fidelity", "oil_temperature"}


@each_spec
@each_fmi
def test_only_levels_that_there_are_stand_in_the_list(spec, fmi):
    path = {2: "TypeDefinitions/SimpleType[@name='Fidelity']/Enumeration/Item"}
    path[3] = "TypeDefinitions/EnumerationType[@name='Fidelity']/Item"
    numbers = {name: i for i, name in enumerate(spec.fidelities, 1)}
    found = {e.get("name"): int(e.get("value")) for e in written(spec, fmi).findall(path[fmi])}
    assert found == {n: i for n, i in numbers.items() if n not in spec.successors}


@each_spec
@each_fmi
def test_plain_outputs_are_real_and_the_others_local(spec, fmi):
    schema, tree, shown = schema_of(fmi), written(spec, fmi, plain=True), interface(spec)
    assert schema.validate(tree), schema.error_log
    found = {e.get("name"): e.get("causality") for e in tree.find("ModelVariables")}
    types = {e[0].tag if fmi == 2 else e.tag for e in tree.find("ModelVariables")}
    assert types <= ({"Real", "Integer"} if fmi == 2 else {"Float64", "Int32"})
    values = {e.get("name"): e[0] if fmi == 2 else e for e in tree.find("ModelVariables")}
    for v in shown.parameters:
        whole = v.type in ("Boolean", "Enumeration")
        assert not whole or {"min", "max", "start"} <= set(values[v.name].attrib)
    assert fmi == 2 or all(
        e.get("initial") for e in tree.find("ModelVariables") if e.get("name") != "time"
    )
    wanted = {v.name: "output" if v.type == "Real" else "local" for v in shown.outputs}
    assert {name: found[name] for name in wanted} == wanted
    first = 3 - fmi  # FMI 2 counts from 1
    listed = {v.reference + first for v in shown.outputs if v.type == "Real"}
    kinds = {2: ("Outputs/Unknown", "InitialUnknowns/Unknown"), 3: ("Output", "InitialUnknown")}
    for kind in kinds[fmi]:
        places = tree.findall(f"ModelStructure/{kind}")
        assert {int(e.get("index") or e.get("valueReference")) for e in places} == listed
