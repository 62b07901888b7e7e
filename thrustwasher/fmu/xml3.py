"""modelDescription.xml of FMI 3.0, from the same list of variables as that of FMI 2.0."""

from xml.etree.ElementTree import Element, SubElement

from ..models._spec import ModelSpec
from . import xml_parts as parts
from .interface import Variable, enumerations, variables

# What an import tool may do; every entry is proved by a test.
CAPABILITIES = {
    "needsExecutionTool": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canGetAndSetFMUState": "true",
    "canSerializeFMUState": "true",
    "canHandleVariableCommunicationStepSize": "true",
    "maxOutputDerivativeOrder": "0",
    "providesIntermediateUpdate": "false",
    "mightReturnEarlyFromDoStep": "false",
    "canReturnEarlyAfterIntermediateUpdate": "false",
    "hasEventMode": "false",
}
DERIVATIVES = ("providesDirectionalDerivatives", "providesAdjointDerivatives")
# Enumerations are read and written as 64-bit integers, whole numbers as 32-bit ones.
TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Enumeration"}
SECTIONS = {"outputs": "Output", "initial": "InitialUnknown"}


def description(spec: ModelSpec, *, guid: str, derivatives: bool = False) -> Element:
    """Return the model description; ``derivatives``: the binary has derivatives."""
    root = Element("fmiModelDescription", {
        "fmiVersion": "3.0", "instantiationToken": guid, **parts.head(spec),
    })  # fmt: skip
    given = dict.fromkeys(DERIVATIVES, str(derivatives).lower())
    SubElement(root, "CoSimulation", {"modelIdentifier": spec.name, **CAPABILITIES, **given})
    found = variables(spec)
    parts.add_units(root, found)
    _types(root, spec, found)
    parts.add_log_categories(root, spec)
    parts.add_experiment(root, spec)
    listed = SubElement(root, "ModelVariables")
    for v in found:
        SubElement(listed, TYPES[v.type], parts.head_attributes(v) | parts.value_attributes(v))
    _structure(root, found)
    return root


def _types(root: Element, spec: ModelSpec, found: tuple[Variable, ...]) -> None:
    definitions = SubElement(root, "TypeDefinitions")
    for t in parts.used_types(found):
        SubElement(definitions, "Float64Type", {"name": t.name, **parts.type_attributes(t)})
    for name, items in sorted(enumerations(spec).items()):
        listed = SubElement(definitions, "EnumerationType", {"name": name})
        for item in items:
            SubElement(listed, "Item", {"name": item.name, "value": str(item.value),
                                        "description": item.help})  # fmt: skip


def _structure(root: Element, found: tuple[Variable, ...]) -> None:
    structure = SubElement(root, "ModelStructure")
    for part, unknown, known in parts.unknowns(found):
        SubElement(structure, SECTIONS[part], {
            "valueReference": str(unknown.reference),
            "dependencies": " ".join(str(v.reference) for v in known),
            "dependenciesKind": " ".join("dependent" for _ in known),
        })  # fmt: skip
