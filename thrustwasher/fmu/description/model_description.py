"""modelDescription.xml of FMI 2.0 and 3.0, and terminalsAndIcons.xml, from a model's lists."""

from xml.etree.ElementTree import Element, SubElement

from ...model.spec import ModelSpec
from . import xml_parts as parts
from .interface import Variable, enumerations, variables

# What an import tool may do; every entry is proved by a test.
CAPABILITIES = {
    2: {
        "needsExecutionTool": "false",
        "canHandleVariableCommunicationStepSize": "true",
        "canInterpolateInputs": "false",
        "maxOutputDerivativeOrder": "0",
        "canRunAsynchronuously": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
    },
    3: {
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
    },
}
DERIVATIVES = {
    2: ("providesDirectionalDerivative",),
    3: ("providesDirectionalDerivatives", "providesAdjointDerivatives"),
}
# In FMI 3 enumerations are 64-bit integers, whole numbers 32-bit ones; order as in tables.h.
TYPES = {"Real": "Float64", "Integer": "Int32", "Boolean": "Boolean", "Enumeration": "Enumeration"}
LISTS = {"outputs": "Outputs", "initial": "InitialUnknowns"}  # of FMI 2
ELEMENTS = {"outputs": "Output", "initial": "InitialUnknown"}  # of FMI 3


def description(spec: ModelSpec, *, fmi: int, guid: str, derivatives: bool = False) -> Element:
    """Return the model description; ``derivatives``: the binary has directional ones."""
    second = fmi == 2
    own = {"guid": guid, "numberOfEventIndicators": "0"} if second else {"instantiationToken": guid}
    root = Element("fmiModelDescription", {"fmiVersion": f"{fmi}.0", **own, **parts.head(spec)})
    given = dict.fromkeys(DERIVATIVES[fmi], str(derivatives).lower())
    flags = {"modelIdentifier": spec.name, **CAPABILITIES[fmi], **given}
    SubElement(root, "CoSimulation", flags)
    found = variables(spec)
    parts.add_units(root, found)
    _types(root, spec, found, second)
    categories = SubElement(root, "LogCategories")
    for name, meaning in parts.log_categories(spec).items():
        SubElement(categories, "Category", {"name": name, "description": meaning})
    stop, step = map(parts.number, parts.default_experiment(spec))
    SubElement(root, "DefaultExperiment", {
        "startTime": "0.0", "stopTime": stop, "tolerance": "1e-06", "stepSize": step,
    })  # fmt: skip
    listed = SubElement(root, "ModelVariables")
    for v in found:
        head, value = parts.head_attributes(v), parts.value_attributes(v)
        if second:
            SubElement(SubElement(listed, "ScalarVariable", head), v.type, value)
        else:
            SubElement(listed, TYPES[v.type], head | value)
    _structure(root, found, second)
    return root


def _types(root: Element, spec: ModelSpec, found: tuple[Variable, ...], second: bool) -> None:
    definitions = SubElement(root, "TypeDefinitions")
    used = {parts.declared_type(v) for v in found if v.type == "Real"}
    for t in sorted(filter(None, used), key=lambda t: t.name):
        name, said = {"name": t.name}, parts.type_attributes(t)
        if second:
            SubElement(SubElement(definitions, "SimpleType", name), "Real", said)
        else:
            SubElement(definitions, "Float64Type", name | said)
    for type_name, items in sorted(enumerations(spec).items()):
        name = {"name": type_name}
        if second:
            listed = SubElement(SubElement(definitions, "SimpleType", name), "Enumeration")
        else:
            listed = SubElement(definitions, "EnumerationType", name)
        for item in items:
            SubElement(listed, "Item", {"name": item.name, "value": str(item.value),
                                        "description": item.help})  # fmt: skip


def _structure(root: Element, found: tuple[Variable, ...], second: bool) -> None:
    """FMI 2 counts variables from 1 here, and has a list for each part."""
    structure = SubElement(root, "ModelStructure")
    key, first = ("index", 1) if second else ("valueReference", 0)
    sections = {part: SubElement(structure, name) for part, name in LISTS.items() if second}
    for part, unknown, known in parts.unknowns(found):
        where, tag = (sections[part], "Unknown") if second else (structure, ELEMENTS[part])
        SubElement(where, tag, {
            key: str(unknown.reference + first),
            "dependencies": " ".join(str(v.reference + first) for v in known),
            "dependenciesKind": " ".join("dependent" for _ in known),
        })  # fmt: skip


def terminals_and_icons(spec: ModelSpec, *, icon: bool = True) -> Element:
    """Return torque and speed as one plug; FMI 2 FMUs carry the file too, in the 3.0 format."""
    root = Element("fmiTerminalsAndIcons", {"fmiVersion": "3.0"})
    if icon:
        graphics = SubElement(root, "GraphicalRepresentation")
        corners = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
        SubElement(graphics, "CoordinateSystem", {**corners, "suggestedScalingFactorTo_mm": "0.1"})
        SubElement(graphics, "Icon", corners)
    if not spec.terminals:
        return root
    listed = SubElement(root, "Terminals")
    for terminal in spec.terminals:
        plug = SubElement(listed, "Terminal", {
            "name": terminal.name, "matchingRule": "plug", "terminalKind": terminal.kind,
            "description": terminal.help,
        })  # fmt: skip
        for variable, member, kind in terminal.members:
            SubElement(plug, "TerminalMemberVariable", {
                "variableName": variable, "memberName": member, "variableKind": kind,
            })  # fmt: skip
    return root
