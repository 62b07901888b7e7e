"""modelDescription.xml of FMI 3.0 against its schema and against that of FMI 2.0."""

from pathlib import Path

import fmpy
import pytest
from fmpy import read_model_description
from lxml import etree
from toy.spec import SPEC as TOY

from thrustwasher.fmu import xml, xml3
from thrustwasher.fmu.interface import all_specs, variables
from thrustwasher.fmu.xml_parts import text

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3ModelDescription.xsd"
each_spec = pytest.mark.parametrize("spec", [TOY, *all_specs()], ids=lambda s: s.name)


def written(spec, version=xml3, **options):
    return etree.fromstring(text(version.description(spec, guid="0", **options)))


@each_spec
@pytest.mark.parametrize("derivatives", [False, True])
def test_the_description_keeps_to_the_schema(spec, derivatives):
    schema = etree.XMLSchema(etree.parse(SCHEMA))
    assert schema.validate(written(spec, derivatives=derivatives)), schema.error_log


@each_spec
def test_fmpy_reads_it_and_finds_nothing(spec, tmp_path):
    file = tmp_path / "modelDescription.xml"
    file.write_bytes(text(xml3.description(spec, guid="0")))
    read = read_model_description(str(file))
    assert [v.name for v in read.modelVariables] == [v.name for v in variables(spec)]
    assert read.fmiVersion == "3.0" and read.coSimulation.modelIdentifier == spec.name


@each_spec
def test_every_variable_says_the_same_in_both_versions(spec):
    types = {"Real": "Float64", "Integer": "Int32"}
    old = written(spec, xml).findall("ModelVariables/ScalarVariable")
    new = list(written(spec).find("ModelVariables"))
    for scalar, variable in zip(old, new, strict=True):
        (body,) = scalar
        assert variable.tag == types.get(body.tag, body.tag)
        assert dict(variable.attrib) == {**scalar.attrib, **body.attrib}


@each_spec
def test_units_categories_and_experiment_are_the_same_in_both_versions(spec):
    old, new = written(spec, xml), written(spec)
    for part in ("UnitDefinitions", "LogCategories", "DefaultExperiment"):
        assert etree.tostring(old.find(part)) == etree.tostring(new.find(part))


@each_spec
def test_types_and_their_items_are_the_same_in_both_versions(spec):
    def said(simple):
        head = {**simple.attrib, **(simple[0].attrib if simple.tag == "SimpleType" else {})}
        return head, [dict(item.attrib) for item in simple.iter("Item")]

    old, new = (list(written(spec, v).find("TypeDefinitions")) for v in (xml, xml3))
    assert [said(t) for t in old] == [said(t) for t in new]
    assert {t.tag for t in new} <= {"Float64Type", "EnumerationType"}


@each_spec
def test_the_structure_is_that_of_fmi_2_by_value_references(spec):
    def listed(tree, path, key, offset):
        return [
            (int(u.get(key)) - offset, [int(n) - offset for n in u.get("dependencies").split()],
             u.get("dependenciesKind"))
            for u in tree.findall(f"ModelStructure/{path}")
        ]  # fmt: skip

    old, new = written(spec, xml), written(spec)
    for two, three in (
        ("Outputs/Unknown", "Output"),
        ("InitialUnknowns/Unknown", "InitialUnknown"),
    ):
        assert listed(old, two, "index", 1) == listed(new, three, "valueReference", 0)


@each_spec
def test_the_flags_are_these(spec):
    flags = dict(written(spec, derivatives=True).find("CoSimulation").attrib)
    assert flags.pop("modelIdentifier") == spec.name
    assert flags.pop("maxOutputDerivativeOrder") == "0"
    assert {flag for flag, said in flags.items() if said == "true"} == {
        "canHandleVariableCommunicationStepSize", "canGetAndSetFMUState", "canSerializeFMUState",
        "providesDirectionalDerivatives", "providesAdjointDerivatives",
    }  # fmt: skip
    assert {flag for flag, said in flags.items() if said == "false"} == {
        "needsExecutionTool", "canBeInstantiatedOnlyOncePerProcess",
        "providesIntermediateUpdate", "mightReturnEarlyFromDoStep", "hasEventMode",
        "canReturnEarlyAfterIntermediateUpdate",
    }  # fmt: skip


@each_spec
def test_the_two_targets_of_fmi_2_differ_in_guid_and_derivatives_only(spec):
    python = text(xml.description(spec, guid="a"))
    native = text(xml.description(spec, guid="b", derivatives=True))
    flag = b'providesDirectionalDerivative="%s"'
    assert native.count(flag % b"true") == native.count(b'guid="b"') == 1
    back = native.replace(flag % b"true", flag % b"false").replace(b'guid="b"', b'guid="a"')
    assert back == python
