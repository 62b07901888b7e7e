"""The list of variables says what the dataclass and the kernel say."""

from dataclasses import fields

import pytest
from toy.spec import SPEC as TOY

from thrustwasher.errors import ParameterError, Status
from thrustwasher.fmu.description.interface import interface
from thrustwasher.model.registry import all_specs
from thrustwasher.units import exponents

SPECS = [TOY, *all_specs()]
each_spec = pytest.mark.parametrize("spec", SPECS, ids=lambda s: s.name)


@each_spec
def test_references_count_through_time_inputs_parameters_outputs_late_inputs(spec):
    found = interface(spec).variables
    first, late = ([s.name for s in spec.inputs if s.late == late] for late in (False, True))
    expected = ["time", *first, *(f.name for f in fields(spec.params))]
    expected += ["fidelity", *(s.name for s in spec.outputs), *late]
    assert [v.name for v in found] == expected
    assert [v.reference for v in found] == list(range(len(found)))
    assert len({v.name for v in found}) == len(found)


@each_spec
def test_every_variable_is_described_bounded_and_started_within_its_range(spec):
    for v in interface(spec).variables:
        assert len(v.help.split()) >= 4, v.name
        exponents(v.unit)
        if v.causality in ("input", "parameter"):
            low, high = v.bounds
            assert low <= v.start <= high, v.name


@each_spec
def test_inputs_that_a_host_leaves_open_are_allowed_to_be_zero(spec):
    for v in interface(spec).variables:
        if v.causality == "input" and v.unit != "K":
            assert v.low <= 0.0 <= v.high, v.name


@each_spec
def test_first_outputs_are_the_same_everywhere_and_status_is_complete(spec):
    items = interface(spec).enumerations["SolverStatus"]
    assert {i.name: i.value for i in items} == {s.name: int(s) for s in Status}
    assert all(i.help for i in items)


@pytest.mark.parametrize(
    ("unit", "expected"),
    [
        ("1", {}),
        ("1/m2", {"m": -2}),
        ("m3/s", {"m": 3, "s": -1}),
        ("J/(kg.K)", {"m": 2, "s": -2, "K": -1}),
        ("N.m", {"kg": 1, "m": 2, "s": -2}),
        ("kg.m2", {"kg": 1, "m": 2}),
        ("N.m.s/rad", {"kg": 1, "m": 2, "s": -1, "rad": -1}),
    ],
)
def test_units_in_base_units(unit, expected):
    assert exponents(unit) == expected


def test_an_unknown_unit_is_refused():
    with pytest.raises(ParameterError, match="furlong"):
        exponents("furlong/s")
