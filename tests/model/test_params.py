"""Parameters of the washer: every field bounded, documented and checked by name."""

import math
from dataclasses import fields

import pytest

from thrustwasher import ParameterError, WasherParams
from thrustwasher.model.parameters import as_numbers
from thrustwasher.washer.kernels import layout
from thrustwasher.washer.parameters import BODIES, MATERIAL, SPEC

FIELDS = fields(WasherParams)
REALS = [f for f in FIELDS if f.metadata["kind"] == "real"]
CHOICES = [f for f in FIELDS if f.metadata["kind"] == "enumeration"]


@pytest.mark.parametrize("f", FIELDS, ids=lambda f: f.name)
def test_every_field_says_what_it_is(f):
    assert f.metadata["help"] and f.metadata["unit"]
    if f.metadata["kind"] == "real":
        assert f.metadata["min"] <= f.default <= f.metadata["max"]
    elif f.metadata["kind"] == "boolean":
        assert isinstance(f.default, bool)
    else:
        assert f.default in f.metadata["options"]


@pytest.mark.parametrize("f", REALS, ids=lambda f: f.name)
def test_values_out_of_range_are_refused_by_name(f):
    low, high = f.metadata["min"], f.metadata["max"]
    for value in (
        math.nan,
        math.inf,
        -math.inf,
        low - 1e-6 - abs(low),
        high * 1.01 + 1e-9,
        "1",
        None,
    ):
        with pytest.raises(ParameterError) as caught:
            WasherParams(**{f.name: value})
        message = str(caught.value)
        assert message.startswith(f"{f.name} = {value!r}") and "allowed" in message
        assert f"{high:g}" in message


@pytest.mark.parametrize("f", CHOICES, ids=lambda f: f.name)
def test_unknown_choices_are_refused_with_the_known_ones(f):
    with pytest.raises(ParameterError) as caught:
        WasherParams(**{f.name: "something"})
    assert all(repr(name) in str(caught.value) for name in f.metadata["options"])
    for name in f.metadata["options"]:
        assert getattr(WasherParams(**{f.name: name}), f.name) == name


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"gear_inner_radius": 0.0111}, "gear_inner_radius"),
        ({"gear_inner_radius": 0.0227}, "gear_inner_radius"),
        ({"inner_radius": 0.02}, "gear_inner_radius"),
        ({"outer_radius": 0.9}, "outer_radius"),
        ({"friction_load_min": 2000.0}, "friction_load_min"),
        ({"friction_pressure_min": 2e6}, "friction_pressure_min"),
    ],
)
def test_fields_that_contradict_each_other_are_refused(change, named):
    with pytest.raises(ParameterError, match=named):
        WasherParams(**change)


def test_an_unknown_parameter_is_refused():
    with pytest.raises(TypeError, match="rougness"):
        WasherParams(rougness=1e-6)


def test_fields_fill_the_kernels_parameters_in_order():
    names = [*(f.name for f in FIELDS), "fidelity"]
    places = {n: place for n, place in vars(layout).items() if n.startswith("P_")}
    own = [f"{name}_{body}" for name in MATERIAL for body in BODIES]
    assert [n for n in names if n not in own] == [names[place] for place in places.values()]
    for n, place in places.items():
        assert names[place].upper().endswith(n.removeprefix("P_"))
    for name in MATERIAL:
        place = names.index(name)
        assert names[place + 1 : place + 4] == [f"{name}_{body}" for body in BODIES]
    assert len(as_numbers(WasherParams())) == layout.N_PARAM - 1 == layout.P_FIDELITY
    numbers = as_numbers(WasherParams(friction_law="constant", conduction="rotating"))
    assert numbers[names.index("friction_law")] == 2.0
    assert numbers[names.index("conduction")] == 3.0
    assert numbers[names.index("outer_radius")] == 0.0227


def test_no_parameter_is_called_like_an_input_or_an_output():
    """They share one name space in the FMU."""
    names = {f.name for f in FIELDS}
    assert names.isdisjoint(s.name for s in (*SPEC.inputs, *SPEC.outputs))
