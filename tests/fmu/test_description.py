"""modelDescription.xml against schemas, checkers and the list it is made from."""

import subprocess
import sys
from pathlib import Path

import fmpy
import pytest
from fmpy import read_model_description
from lxml import etree
from toy.spec import SPEC as TOY

from thrustwasher.fmu import xml, xml_parts
from thrustwasher.fmu.interface import all_specs, enumerations, variables
from thrustwasher.fmu.terminals import terminals_and_icons
from thrustwasher.fmu.units import declared_type
from thrustwasher.fmu.validate import validate

SCHEMAS = Path(fmpy.__file__).parent / "schema"
SPECS = [TOY, *all_specs()]
NAMES = ["ThrustWasher", "WetClutch", "GearMesh", "ShiftTransmission"]
each_spec = pytest.mark.parametrize("spec", SPECS, ids=lambda s: s.name)


def written(spec):
    return etree.fromstring(xml.text(xml.description(spec, guid="0")))


@each_spec
def test_the_description_keeps_to_the_schema(spec):
    schema = etree.XMLSchema(etree.parse(SCHEMAS / "fmi2" / "fmi2ModelDescription.xsd"))
    assert schema.validate(written(spec)), schema.error_log


@each_spec
def test_the_terminals_keep_to_the_schema_and_name_variables(spec):
    schema = etree.XMLSchema(etree.parse(SCHEMAS / "fmi3" / "fmi3TerminalsAndIcons.xsd"))
    tree = etree.fromstring(xml.text(terminals_and_icons(spec)))
    assert schema.validate(tree), schema.error_log
    members = {e.get("variableName") for e in tree.iter("TerminalMemberVariable")}
    assert members and members <= {v.name for v in variables(spec)}


@pytest.mark.parametrize("name", NAMES)
def test_checkers_find_nothing(name, fmus):
    assert validate(fmus[name]) == []
    command = [Path(sys.executable).parent / "fmutool", "-input", fmus[name], "-check"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    said = done.stdout + done.stderr
    assert "seems to be compliant" in said
    assert not [line for line in said.splitlines() if line.startswith(("ERROR", "WARN", "CRIT"))]


@each_spec
def test_every_variable_is_written_as_it_is_listed(spec):
    read = written(spec).findall("ModelVariables/ScalarVariable")
    assert len(read) == len(variables(spec))
    for element, v in zip(read, variables(spec), strict=True):
        assert element.get("name") == v.name
        assert int(element.get("valueReference")) == v.reference
        assert element.get("variability") == v.variability
        (body,) = element
        assert body.tag == v.type
        for attribute, value in (("min", v.low), ("max", v.high), ("start", v.start)):
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
    assert set(enumerations(spec)) <= types


@each_spec
def test_a_temperature_difference_is_not_shown_as_a_temperature(spec):
    relative = [v for v in variables(spec) if v.relative]
    for body in written(spec).findall("ModelVariables/ScalarVariable/Real"):
        name = body.getparent().get("name")
        assert (body.get("relativeQuantity") == "true") == (name in {v.name for v in relative})
    for v in relative:
        assert declared_type(v).display is None


@each_spec
def test_structure_lists_outputs_with_their_inputs_and_initial_unknowns_with_parameters(spec):
    tree = written(spec)
    found = variables(spec)
    outputs = [v for v in found if v.causality == "output"]
    parameters = {v.name for v in found if v.causality == "parameter"}
    for part, extra in (("Outputs", set()), ("InitialUnknowns", parameters)):
        unknowns = tree.findall(f"ModelStructure/{part}/Unknown")
        assert [int(u.get("index")) for u in unknowns] == [v.reference + 1 for v in outputs]
        for unknown, v in zip(unknowns, outputs, strict=True):
            numbers = [int(n) for n in unknown.get("dependencies").split()]
            assert {found[n - 1].name for n in numbers} == {*v.depends, *extra}
            assert numbers == sorted(numbers)
            assert len(unknown.get("dependenciesKind").split()) == len(numbers)


@each_spec
def test_the_default_experiment_has_at_most_a_thousand_steps(spec):
    experiment = written(spec).find("DefaultExperiment")
    assert float(experiment.get("stopTime")) <= 1000 * float(experiment.get("stepSize"))


def test_the_date_comes_from_the_environment_and_ends_with_z(monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    assert xml_parts.generation_date() == "2023-11-14T22:13:20Z"
    monkeypatch.delenv("SOURCE_DATE_EPOCH")
    assert xml_parts.generation_date() == xml_parts.generation_date()
    assert xml_parts.generation_date().endswith("Z")


def test_a_reader_sees_degrees_celsius_rpm_and_micrometres(fmus):
    description = read_model_description(str(fmus["ThrustWasher"]))
    shown = {v.name: v for v in description.modelVariables}
    assert shown["oil_temperature"].declaredType.displayUnit == "degC"
    assert shown["film_thickness"].displayUnit == "um"
    units = {u.name: {d.name: d for d in u.displayUnits} for u in description.unitDefinitions}
    assert float(units["rad/s"]["rpm"].factor) == pytest.approx(9.549296585513721, rel=1e-15)
    assert float(units["K"]["degC"].offset) == -273.15
