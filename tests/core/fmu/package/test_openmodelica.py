"""What OpenModelica's importer makes a block of: names, types, states, by its rules.

Read in its source of August 2026 (FMIImpl.c, CodegenFMU.tpl): each variable becomes a declaration,
its name with ``_`` for ``.[] ,()``; types of enumerations are written with their items as they
are; the clock of FMI 3 is left out, that of FMI 2 is declared like any other.
"""

import re

import pytest
from lxml import etree

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.description.model_description import description
from thrustwasher.model.registry import all_specs

UNITS = [s for s in all_specs(helpers=True) if s.exchange]
KEYWORDS = set(  # Modelica 3.6, section 2.3.3
    "algorithm and annotation block break class connect connector constant constrainedby der "
    "discrete each else elseif elsewhen encapsulated end enumeration equation expandable extends "
    "external false final flow for function if import impure in initial inner input loop model "
    "not operator or outer output package parameter partial protected public pure record "
    "redeclare replaceable return stream then true type when while within".split()
)
OWN = {"time", "logLevel", "debugLogging", "fmuWorkingDir"}  # Modelica's, and the block's
each_unit = pytest.mark.parametrize("spec", UNITS, ids=lambda s: s.name)
both = pytest.mark.parametrize("fmi", [2, 3])


def tree_of(spec, fmi, plain=True):
    options = {"derivatives": True, "moving": True, "exchange": True}
    return etree.fromstring(description(interface(spec), fmi=fmi, guid="0", plain=plain, **options))


def declared(tree, fmi):
    """Return the names that the block declares."""
    found = tree.find("ModelVariables")
    kept = [v for v in found if fmi == 2 or v.get("causality") != "independent"]
    return [re.sub(r"[.\[\] ,()]", "_", v.get("name")) for v in kept]


@each_unit
@both
def test_every_name_is_one_of_modelica_and_no_other(spec, fmi):
    names = declared(tree_of(spec, fmi), fmi)
    assert all(re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) for name in names)
    assert not KEYWORDS & set(names) and not OWN & set(names)
    assert len(set(names)) == len(names)
    assert not any(name.startswith(("fmi_", "flow")) for name in names)  # the block's own


@each_unit
@both
def test_variables_are_numbers_and_no_type_has_items(spec, fmi):
    tree = tree_of(spec, fmi)
    kinds = {v[0].tag if fmi == 2 else v.tag for v in tree.find("ModelVariables")}
    assert kinds <= ({"Real", "Integer"} if fmi == 2 else {"Float64", "Int32"})
    assert not tree.findall("TypeDefinitions//Item")


@each_unit
@both
def test_states_and_indicators_are_counted_as_the_importer_counts(spec, fmi):
    """By the lists of derivatives and, in FMI 3, of indicators; every derivative is of a state."""
    tree = tree_of(spec, fmi)
    variables = list(tree.find("ModelVariables"))
    places = {"2": ("Derivatives/Unknown", "index"), "3": ("ContinuousStateDerivative",) * 2}
    listed = tree.findall(f"ModelStructure/{places[str(fmi)][0]}")
    assert len(listed) == len(interface(spec).continuous) > 0
    for unknown in listed:
        if fmi == 2:
            rate = variables[int(unknown.get("index")) - 1]
            state = variables[int(rate[0].get("derivative")) - 1]
        else:
            by = {v.get("valueReference"): v for v in variables}
            rate = by[unknown.get("valueReference")]
            state = by[rate.get("derivative")]
        assert rate.get("name") == f"der({state.get('name')})"
    signs = int(tree.get("numberOfEventIndicators", 0))
    assert (signs if fmi == 2 else len(tree.findall("ModelStructure/EventIndicator"))) >= 1
    assert tree.find("ModelExchange").get("modelIdentifier") == spec.name


def test_without_plain_it_would_not_open():
    """A clock called time in FMI 2, and items that are words of Modelica."""
    tree = tree_of(next(s for s in UNITS if s.key == "clutch"), 2, plain=False)
    assert "time" in declared(tree, 2)
    assert KEYWORDS & {e.get("name") for e in tree.findall("TypeDefinitions//Item")}
