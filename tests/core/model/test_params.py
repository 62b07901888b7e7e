"""Parameters of every model: each bounded, documented, checked by name and in its place."""

import importlib
import math
import pickle
import re
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from thrustwasher import ParameterError, WasherParams
from thrustwasher.fmu import model_kernels
from thrustwasher.fmu.model_kernels import content_digest, content_files
from thrustwasher.model.parameters import as_numbers, check_number
from thrustwasher.model.prepare import tables_of
from thrustwasher.model.registry import HELPERS, MODELS, find_spec, kernel_of
from thrustwasher.units import UNITS
from thrustwasher.washer.parameters import BODIES, MATERIAL

SPECS = [find_spec(key) for key in (*MODELS, *HELPERS)]
each_model = pytest.mark.parametrize("spec", SPECS, ids=lambda s: s.key)


@each_model
def test_every_field_says_what_it_is(spec):
    for f in fields(spec.params):
        about = f.metadata
        assert about["help"] and about["unit"], f.name
        if about["kind"] in ("real", "integer"):
            assert about["min"] <= f.default <= about["max"], f.name
        elif about["kind"] == "boolean":
            assert isinstance(f.default, bool), f.name
        else:
            assert f.default in about["options"], f.name


@each_model
def test_values_out_of_range_are_refused_by_name(spec):
    for f in fields(spec.params):
        about, bad = f.metadata, [math.nan, "something", None]
        if about["kind"] in ("real", "integer"):
            low, high = about["min"], about["max"]
            beyond = 1e-6 + 1e-8 * (high - low)  # more than rounding
            bad += [math.inf, -math.inf, low - abs(low) - beyond, high * 1.01 + 1e-9]
            allowed = [f"{high:g}"] if about["kind"] == "real" else []
        else:
            allowed = [repr(name) for name in about.get("options", ())]
        for value in bad:
            with pytest.raises(ParameterError) as caught:
                spec.params(**{f.name: value})
            message = str(caught.value)
            assert message.startswith(f"{f.name} = {value!r}") and "allowed" in message
            assert all(text in message for text in allowed), message


@each_model
def test_every_end_of_a_range_typed_in_a_display_unit_is_taken(spec):
    """Many of them come back a rounding error outside their range."""
    ranges = [(s.name, s.unit, *s.range) for s in spec.inputs]
    real = [f for f in fields(spec.params) if f.metadata["kind"] == "real"]
    ranges += [(f.name, f.metadata["unit"], f.metadata["min"], f.metadata["max"]) for f in real]
    for name, unit, low, high in ranges:
        for size, zero in UNITS.get(unit, {}).values():
            for end in (low, high):
                for typed in ((end - zero) / size * size + zero, end * (1.0 + 4e-16)):
                    taken = check_number(name, typed, unit, low, high)
                    assert low <= taken <= high and taken == pytest.approx(end, rel=1e-14)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"outside_map": "none", "inner_radius": -1.0}, r"^inner_radius = -1\.0 m, allowed"),
        ({"coupling_age": 1.5, "outside_map": "none"}, r"^coupling_age = 1\.5, allowed"),
        ({"heat_split": True}, r"^heat_split = True, allowed: 0 \.\. 1$"),
        ({"inner_radius": 20.0}, r"^inner_radius = 20\.0 m, allowed: .*did you mean 0\.02 m"),
    ],
)
def test_the_first_wrong_field_in_declared_order_is_named(given, says):
    with pytest.raises(ParameterError, match=says):
        WasherParams(**given)


def test_numbers_of_other_types_are_looked_at_one_by_one():
    same = WasherParams(heat_split=np.float64(0.25), coupling_age=2.0)
    assert as_numbers(same) == as_numbers(WasherParams(heat_split=0.25, coupling_age=2))
    off = as_numbers(replace(same, holding="off"))
    assert as_numbers(same, {"holding": "off", "of": "another model"}) == off != as_numbers(same)


def test_parameters_that_rounding_put_outside_are_the_ends_of_their_ranges():
    low = WasherParams.__dataclass_fields__["oil_density"].metadata["min"]
    assert WasherParams(oil_density=math.nextafter(low, 0.0)).oil_density == low
    with pytest.raises(ParameterError, match="oil_density"):
        WasherParams(oil_density=low * (1.0 - 1e-9))


@each_model
def test_an_unknown_parameter_is_refused(spec):
    with pytest.raises(TypeError, match="rougness"):
        spec.params(rougness=1e-6)


@each_model
def test_no_parameter_is_called_like_an_input_or_an_output(spec):
    """They share one name space in the FMU."""
    names = {f.name for f in fields(spec.params)}
    assert names.isdisjoint(s.name for s in (*spec.inputs, *spec.outputs))


@each_model
def test_the_kernels_arrays_are_as_long_as_the_lists(spec):
    k, reals = kernel_of(spec), [s for s in spec.outputs if s.kind == "real"]
    assert k.N_PARAM == len(fields(spec.params)) + 1 and k.NINP == len(spec.inputs)
    assert (k.NOUT, k.NIOUT) == (len(reals), len(spec.outputs) - len(reals))


@pytest.mark.parametrize("key", ["washer", "clutch", "gearmesh"])
def test_places_of_parameters_are_those_of_their_names(key):
    """Of a numbered row the first has a name, the others follow."""
    spec = find_spec(key)
    names = [*(f.name for f in fields(spec.params)), "fidelity"]
    places = {n: at for n, at in vars(kernel_of(spec).L).items() if n.startswith("P_")}
    assert {n: names[at].upper() for n, at in places.items()} == {n: n[2:] for n in places}
    rest = [n for n in names if f"P_{n.upper()}" not in places]
    assert [n for n in rest if not re.search(r"_[2-9]$|_\d\d$", n)] == []


def test_a_material_has_one_place_for_all_bodies_with_their_own_behind_it():
    names = [f.name for f in fields(WasherParams)]
    for name in MATERIAL:
        place = names.index(name)
        assert names[place + 1 : place + 4] == [f"{name}_{body}" for body in BODIES]
    names.append("fidelity")
    numbers = as_numbers(WasherParams(friction_law="constant", conduction="rotating"))
    assert numbers[names.index("friction_law")] == 2.0
    assert numbers[names.index("conduction")] == 3.0
    assert numbers[names.index("outer_radius")] == 0.0227


@each_model
def test_parameters_are_at_home_in_their_model_and_can_be_sent_to_other_processes(spec):
    home = find_spec(spec.key).kernel.partition(".kernels")[0]
    assert spec.params.__module__.startswith(f"{home}.")
    assert pickle.loads(pickle.dumps(spec.params())) == spec.params()


@each_model
def test_an_edit_of_any_code_of_a_model_changes_its_digest_and_one_of_comments_does_not(
    spec, monkeypatch, tmp_path
):
    home = Path(importlib.import_module(spec.params.__module__).__file__).parent
    own = {path for path in home.iterdir() if path.suffix in (".py", ".toml")}
    assert own and own <= set(content_files(spec.kernel, spec.params.__module__, False))
    before = content_digest(spec)
    for path in own:
        text, seen = path.read_text("utf-8"), []
        for edit in ("\n# a comment\n", "\nedited = 1\n"):
            edited = tmp_path / path.name
            edited.write_text(text + edit, "utf-8")
            files = [edited if p == path else p for p in content_files_of(spec)]
            monkeypatch.setattr(model_kernels, "content_files", lambda *given, now=files: now)
            model_kernels._content_digest.cache_clear()
            seen.append(content_digest(spec) == before)
            monkeypatch.undo()
        assert seen == [path.suffix == ".py", False], path
    model_kernels._content_digest.cache_clear()


def content_files_of(spec):
    return content_files(spec.kernel, spec.params.__module__, tables_of(spec) is not None)
