"""terminalsAndIcons.xml: torque and speed as one plug for tools that know terminals."""

from xml.etree.ElementTree import Element, SubElement

from ..models._spec import ModelSpec


def terminals_and_icons(spec: ModelSpec) -> Element:
    """Return the file's tree; FMI 2 FMUs carry it too, in the 3.0 format."""
    root = Element("fmiTerminalsAndIcons", {"fmiVersion": "3.0"})
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
