"""modelDescription.xml of FMI 2.0, from the list of variables alone."""

from xml.etree.ElementTree import Element, SubElement

from ..models._spec import ModelSpec
from . import xml_parts as parts
from .interface import Variable, enumerations, variables
from .xml_parts import LOG_CATEGORIES, default_experiment, log_categories, text

__all__ = [
    "CAPABILITIES",
    "LOG_CATEGORIES",
    "default_experiment",
    "description",
    "log_categories",
    "text",
]

# What an import tool may do; every entry is proved by a test.
CAPABILITIES = {
    "needsExecutionTool": "false",
    "canHandleVariableCommunicationStepSize": "true",
    "canInterpolateInputs": "false",
    "maxOutputDerivativeOrder": "0",
    "canRunAsynchronuously": "false",
    "canBeInstantiatedOnlyOncePerProcess": "false",
    "canNotUseMemoryManagementFunctions": "true",
    "canGetAndSetFMUstate": "true",
    "canSerializeFMUstate": "true",
    "providesDirectionalDerivative": "false",
}
SECTIONS = {"outputs": "Outputs", "initial": "InitialUnknowns"}


def description(spec: ModelSpec, *, guid: str, derivatives: bool = False) -> Element:
    """Return the model description; ``derivatives``: the binary has directional ones."""
    root = Element("fmiModelDescription", {
        "fmiVersion": "2.0", "guid": guid, "numberOfEventIndicators": "0", **parts.head(spec),
    })  # fmt: skip
    flags = CAPABILITIES | {"providesDirectionalDerivative": str(derivatives).lower()}
    SubElement(root, "CoSimulation", {"modelIdentifier": spec.name, **flags})
    found = variables(spec)
    parts.add_units(root, found)
    _types(root, spec, found)
    parts.add_log_categories(root, spec)
    parts.add_experiment(root, spec)
    listed = SubElement(root, "ModelVariables")
    for v in found:
        scalar = SubElement(listed, "ScalarVariable", parts.head_attributes(v))
        SubElement(scalar, v.type, parts.value_attributes(v))
    _structure(root, found)
    return root


def _types(root: Element, spec: ModelSpec, found: tuple[Variable, ...]) -> None:
    definitions = SubElement(root, "TypeDefinitions")
    for t in parts.used_types(found):
        simple = SubElement(definitions, "SimpleType", {"name": t.name})
        SubElement(simple, "Real", parts.type_attributes(t))
    for name, items in sorted(enumerations(spec).items()):
        simple = SubElement(definitions, "SimpleType", {"name": name})
        listed = SubElement(simple, "Enumeration")
        for item in items:
            SubElement(listed, "Item", {"name": item.name, "value": str(item.value),
                                        "description": item.help})  # fmt: skip


def _structure(root: Element, found: tuple[Variable, ...]) -> None:
    """FMI 2 counts variables from 1 here."""
    structure = SubElement(root, "ModelStructure")
    sections = {part: SubElement(structure, name) for part, name in SECTIONS.items()}
    for part, unknown, known in parts.unknowns(found):
        SubElement(sections[part], "Unknown", {
            "index": str(unknown.reference + 1),
            "dependencies": " ".join(str(v.reference + 1) for v in known),
            "dependenciesKind": " ".join("dependent" for _ in known),
        })  # fmt: skip
