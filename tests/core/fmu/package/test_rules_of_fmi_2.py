"""Rules of FMI 2.0 that no schema checks, of descriptions with model exchange.

As the VDM model of the standard words them (INTO-CPS Association, FMI-VDM-Model, fmi2/rule-model).
"""

import re

import pytest
from lxml import etree

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.description.model_description import description
from thrustwasher.model.registry import all_specs

PART = r"[A-Za-z_]\w*(\[\d+(,\d+)*\])?"
NAME = rf"{PART}(\.{PART})*"
UNITS = [s for s in all_specs(helpers=True) if s.exchange]
each_unit = pytest.mark.parametrize("spec", UNITS, ids=lambda s: s.name)
both = pytest.mark.parametrize("plain", [False, True], ids=["usual", "plain"])


def tree_of(spec, plain):
    options = {"derivatives": True, "moving": True, "exchange": True, "plain": plain}
    return etree.fromstring(description(interface(spec), fmi=2, guid="0", **options))


def listed(tree, kind):
    return [int(u.get("index")) for u in tree.findall(f"ModelStructure/{kind}/Unknown")]


@each_unit
@both
def test_initial_unknowns_are_what_is_calculated_at_the_start_in_order(spec, plain):
    """Outputs, states and derivatives whose initial is approx or calculated; no others."""
    tree = tree_of(spec, plain)
    variables = list(tree.find("ModelVariables"))
    rates = [v for v in variables if v[0].get("derivative")]
    states = [variables[int(v[0].get("derivative")) - 1] for v in rates]
    due = [
        i
        for i, v in enumerate(variables, 1)
        if v.get("initial") in ("approx", "calculated")
        and (v.get("causality") == "output" or v in rates or v in states)
    ]
    assert listed(tree, "InitialUnknowns") == due


@each_unit
@both
def test_outputs_are_all_listed_and_derivatives_are_of_continuous_states(spec, plain):
    tree = tree_of(spec, plain)
    variables = list(tree.find("ModelVariables"))
    outputs = [i for i, v in enumerate(variables, 1) if v.get("causality") == "output"]
    assert listed(tree, "Outputs") == outputs
    for i in listed(tree, "Derivatives"):
        rate = variables[i - 1]
        state = variables[int(rate[0].get("derivative")) - 1]
        assert {rate.get("variability"), state.get("variability")} == {"continuous"}
    for unknown in tree.iter("Unknown"):
        needs, kinds = (unknown.get(n) for n in ("dependencies", "dependenciesKind"))
        assert kinds is None or len(kinds.split()) == len(needs.split())


@each_unit
@both
def test_names_are_structured_and_start_values_stand_where_they_must(spec, plain):
    variables = list(tree_of(spec, plain).find("ModelVariables"))
    names = [v.get("name") for v in variables]
    assert len(set(names)) == len(names)
    assert all(re.fullmatch(rf"{NAME}|der\({NAME}\)", n, re.ASCII) for n in names)
    for v in variables:
        given = v.get("initial") in ("exact", "approx") or v.get("causality") == "input"
        must = given or v.get("causality") == "parameter"
        assert (v[0].get("start") is not None) == must, v.get("name")
        low, high, start = (v[0].get(n) for n in ("min", "max", "start"))
        if v[0].tag != "Boolean" and start is not None:
            assert low is None or float(low) <= float(start)
            assert high is None or float(start) <= float(high)
