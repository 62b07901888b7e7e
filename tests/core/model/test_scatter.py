"""Tables [scatter]: laws by their closed forms, correlation, and what is wrong is named."""

import pickle

import numpy as np
import pytest
from scipy import stats

from thrustwasher import ParameterError, WasherParams, load_part
from thrustwasher.model.part_file import find_part, part_text, preset_parts
from thrustwasher.model.quantity import Quantity
from thrustwasher.model.registry import all_models, models_with_points
from thrustwasher.model.scatter import read_scatter

PLACES = {
    p.name: p
    for p in (
        Quantity(name="roughness", unit="m", nominal=5e-7, low=1.5e-7, high=1e-5),
        Quantity(name="share", unit="1", nominal=0.08, low=0.0, high=1.0),
        Quantity(name="tilt", unit="rad", nominal=0.002, low=0.0, high=0.01),
        Quantity(name="slip", unit="rad/s", nominal=-50.0, low=-1e3, high=1e3),
        Quantity(name="oil_temperature", unit="K", nominal=353.15, low=233.15, high=473.15),
        Quantity(name="rise", unit="K", nominal=40.0, low=0.0, high=400.0, relative=True),
        Quantity(name="bearing", unit="m", nominal=0.0, low=0.0, high=1e-3),
        Quantity(name="shear", unit="1", nominal="full", choices=("full", "liquid")),
        Quantity(name="cooling", unit="1", nominal=True, choices=(False, True)),
        Quantity(name="stage", unit="1", nominal=10, choices=tuple(range(1, 15))),
        Quantity(name="clutch.points.3", unit="Pa", nominal=4e5, low=0.0, high=1e7),
        Quantity(name="clutch.scale", unit="1", nominal=1.0, low=0.1, high=2.0),
    )
}
U = np.linspace(0.001, 0.999, 400)


def read(**table):
    return read_scatter("[scatter]", table, PLACES)


def law(name, given):
    return read(**{name: given}).sources[0].law


def between(low, high, frozen):
    """Return the quantiles of a distribution truncated at a range."""
    start, end = frozen.cdf(low), frozen.cdf(high)
    return frozen.ppf(start + U * (end - start))


@pytest.mark.parametrize(
    ("name", "given", "frozen"),
    [
        ("roughness", "10 %", stats.norm(5e-7, 5e-8)),
        ("roughness", "200 nm", stats.norm(5e-7, 2e-7)),
        ("roughness", 2e-7, stats.norm(5e-7, 2e-7)),
        ("slip", {"normal": "10 %"}, stats.norm(-50.0, 5.0)),
        ("share", "25 %", stats.norm(0.08, 0.02)),
        ("share", 0.02, stats.norm(0.08, 0.02)),
        ("oil_temperature", "3 K", stats.norm(353.15, 3.0)),
        ("oil_temperature", "3 degC", stats.norm(353.15, 3.0)),
        ("rise", "10 %", stats.norm(40.0, 4.0)),
        ("tilt", {"lognormal": 1.6}, stats.lognorm(np.log(1.6), scale=0.002)),
        ("tilt", {"lognormal": 5.0}, stats.lognorm(np.log(5.0), scale=0.002)),
        ("share", {"uniform": ["4 %", 0.16]}, stats.uniform(0.04, 0.12)),
        ("oil_temperature", {"uniform": ["60 degC", 373.15]}, stats.uniform(333.15, 40.0)),
        ("rise", {"uniform": ["30 degC", "50 K"]}, stats.uniform(30.0, 20.0)),
        ("tilt", {"uniform": [0.001, 0.02]}, stats.uniform(0.001, 0.019)),
    ],
)
def test_quantiles_are_those_of_the_law_truncated_at_the_range(name, given, frozen):
    place, found = PLACES[name], law(name, given)
    expected = between(place.low, place.high, frozen)
    np.testing.assert_allclose(found.value(U), expected, rtol=1e-9)
    outside = frozen.cdf(place.low) + frozen.sf(place.high)
    assert found.cut == pytest.approx(outside, abs=1e-12)


def test_a_truncated_normal_law_is_that_of_scipy():
    found = law("bearing", "0.3 mm")
    expected = stats.truncnorm(0.0, 1.0 / 0.3, scale=3e-4).ppf(U)
    np.testing.assert_allclose(found.value(U), expected, rtol=1e-9)


@pytest.mark.parametrize("given", ["10 %", "9 um", {"lognormal": 9.0}, {"uniform": [0.0, 1.0]}])
def test_no_draw_leaves_the_range_even_at_the_ends(given):
    x = law("roughness", given).value(np.array([0.0, 1e-300, 0.5, 1.0 - 1e-16, 1.0]))
    assert np.isfinite(x).all() and x.min() >= 1.5e-7 and x.max() <= 1e-5


def test_a_choice_takes_its_values_by_weight():
    u = (np.arange(1000) + 0.5) / 1000.0
    assert law("shear", {"either": ["full", "liquid"]}).value(u).count("full") == 500
    stages = law("stage", {"either": [9, 10, 11], "weights": [1, 2, 1]}).value(u)
    assert [stages.count(s) for s in (9, 10, 11)] == [250, 500, 250]
    assert set(law("cooling", {"either": [True, False]}).value(u)) == {True, False}


@pytest.mark.parametrize(
    ("name", "given", "words"),
    [
        ("roughness", "10 %", "normal, standard deviation 10 %"),
        ("oil_temperature", "3 K", "normal, standard deviation 3 K"),
        ("roughness", 5e-8, "normal, standard deviation 0.05 µm"),
        ("tilt", {"lognormal": 1.6}, "lognormal, factor 1.6"),
        ("oil_temperature", {"uniform": [333.15, 373.15]}, "uniform 60 °C .. 100 °C"),
        ("shear", {"either": ["full", "liquid"]}, "either full or liquid"),
        ("cooling", {"either": [True, False], "weights": [3, 1]}, "either true (75 %) or false"),
    ],
)
def test_a_law_in_words(name, given, words):
    assert law(name, given).words().startswith(words)


def test_where_it_comes_from_is_kept():
    given = {"normal": "10 %", "source": "estimate"}
    assert [s.reason for s in read(roughness=given, tilt=0.001).sources] == ["estimate", ""]


def test_tables_within_tables_are_names_with_dots():
    nested = {"clutch": {"points": {"3": "5 %"}, "scale": "2 %"}}
    flat = {"clutch.points.3": "5 %", "clutch.scale": "2 %"}
    assert read(**nested).sources == read(**flat).sources
    with pytest.raises(ParameterError, match=r"clutch\.scale is there twice"):
        read(**nested, **{"clutch.scale": "3 %"})


def three():
    """Return three sources of which the first and the last go together."""
    return read(
        roughness={"lognormal": 1.3},
        share={"uniform": [0.04, 0.16]},
        tilt="0.5 mrad",
        correlation=[["tilt", "roughness", 0.8]],
    )


def test_correlation_is_that_of_the_normal_scores_and_keeps_each_law():
    n = 2**13
    scatter, u = three(), stats.qmc.Sobol(3, seed=1).random(n)
    rows = scatter.values(u)
    found = {name: np.array([row[name] for row in rows]) for name in scatter.names}
    scores = [stats.norm.ppf(stats.rankdata(x) / (n + 1)) for x in found.values()]
    np.testing.assert_allclose(np.corrcoef(scores), scatter.correlation, atol=0.005)
    for s in scatter.sources:
        quantiles = np.quantile(found[s.place.name], [0.05, 0.5, 0.95])
        np.testing.assert_allclose(quantiles, s.law.value([0.05, 0.5, 0.95]), rtol=0.003)


def test_correlated_sources_are_one_group_that_takes_its_own_columns_alone():
    scatter, rng = three(), np.random.default_rng(1)
    assert scatter.groups == ((0, 2), (1,))
    u, other = rng.random((4, 3)), rng.random((4, 3))
    mixed = u.copy()
    mixed[:, 1] = other[:, 1]
    before, after = scatter.values(u), scatter.values(mixed)
    for name in ("roughness", "tilt"):
        assert [row[name] for row in before] == [row[name] for row in after]
    assert [row["share"] for row in after] == [row["share"] for row in scatter.values(other)]


def test_groups_are_joined_over_several_pairs_in_the_order_of_their_first():
    lines = dict.fromkeys(("slip", "roughness", "rise", "share", "tilt"), "5 %")
    pairs = [["tilt", "share", 0.2], ["roughness", "tilt", 0.1], ["slip", "rise", 0.0]]
    assert read(**lines, correlation=pairs).groups == ((0,), (1, 3, 4), (2,))


def test_without_a_table_nothing_scatters():
    assert read().values(np.zeros((2, 0))) == [{}, {}]


def test_values_are_plain_and_the_whole_goes_to_another_process():
    scatter = pickle.loads(pickle.dumps(read(tilt="5 %", shear={"either": ["full", "liquid"]})))
    (row,) = scatter.values(np.array([[0.5, 0.9]]))
    assert row == {"tilt": pytest.approx(0.002), "shear": "liquid"}
    assert [type(x) for x in row.values()] == [float, str]


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"roughness": "100 %"}, ["roughness: 24.", "0.15 µm .. 10 µm", "cut off"]),
        ({"share": {"uniform": [-0.1, 0.4]}}, ["share: 20 %", "0 .. 1"]),
        ({"share": {"uniform": [0.1, 0.2]}}, ["uniform 0.1 .. 0.2", "nominal value is 0.08"]),
        ({"stage": {"either": [8, 9]}}, ["either 8 or 9", "nominal value is 10"]),
    ],
)
def test_what_is_doubtful_is_a_warning(table, words):
    (text,) = read(**table).warnings
    assert all(word in text for word in words), text


BOTH = {"roughness": "5 %", "tilt": "5 %", "share": "5 %"}


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"roughnes": "10 %"}, ["'roughnes'", "did you mean 'roughness'?"]),
        ({"roughness": "0 %"}, ["normal = '0 %'", "above 0"]),
        ({"roughness": -1e-7}, ["normal = -1e-07", "above 0"]),
        ({"roughness": 1e9}, ["so wide that it is uniform", "or uniform"]),
        ({"clutch.scale": "15000000 %"}, ["clutch.scale", "so wide", "in 0.1 .. 2"]),
        ({"clutch.scale": "191 %"}, ["no wider than that range"]),  # 1.9
        ({"roughness": {"lognormal": 70.0}}, ["roughness", "so wide"]),  # 66.7 from end to end
        ({"roughness": 1e-300}, ["nothing compared with", "of that size"]),
        ({"roughness": "3 N"}, ["normal = '3 N'", "um"]),
        ({"roughness": True}, ["normal = True", "a number or a text"]),
        ({"roughness": [1, 2]}, ["normal = [1, 2]", "a number or a text"]),
        ({"roughness": {"gauss": 1}}, ["'gauss'", "normal, lognormal, uniform, either"]),
        ({"roughness": {"normal": "1 %", "uniform": [0, 1]}}, ["allowed: one of normal"]),
        ({"roughness": {"normal": "1 %", "sourc": "x"}}, ["'sourc'", "source"]),
        ({"roughness": {"normal": "1 %", "source": 3}}, ["source = 3", "a text"]),
        ({"roughness": {"normal": "1 %", "weights": [1]}}, ["weights", "with either"]),
        ({"oil_temperature": "3 %"}, ["normal = '3 %'", "absolute temperature", '"3 K"']),
        ({"oil_temperature": {"lognormal": 1.1}}, ["lognormal = 1.1", "absolute temperature"]),
        ({"bearing": "10 %"}, ["normal = '10 %'", "nominal value of 0", "in m"]),
        ({"bearing": {"lognormal": 1.3}}, ["nominal value of 0"]),
        ({"slip": {"lognormal": 1.3}}, ["nominal value -50 rad/s", "above 0"]),
        ({"tilt": {"lognormal": 1.0}}, ["lognormal = 1.0", "above 1"]),
        ({"tilt": {"lognormal": "1.6 rad"}}, ["lognormal = '1.6 rad'", "a finite number"]),
        ({"tilt": {"uniform": [0.002, 0.001]}}, ["uniform", "low < high"]),
        ({"tilt": {"uniform": [0.001]}}, ["uniform", "[low, high]"]),
        ({"tilt": {"uniform": "12"}}, ["uniform", "[low, high]"]),
        ({"tilt": {"uniform": [0.1, 0.2]}}, ["uniform", "within 0 rad .. 10 mrad"]),
        ({"tilt": {"either": [0.1, 0.2]}}, ["either", "normal, lognormal or uniform"]),
        ({"shear": "10 %"}, ["normal = '10 %'", "either", "full, liquid"]),
        ({"stage": "10 %"}, ["either", "whole numbers 1 .. 14"]),
        ({"shear": {"either": ["full", "none"]}}, ["'none'", "two or more of full, liquid"]),
        ({"shear": {"either": ["full"]}}, ["two or more of full, liquid"]),
        ({"shear": {"either": ["full", "full"]}}, ["each value once"]),
        ({"cooling": {"either": [1, 0]}}, ["false, true"]),
        ({"shear": {"either": ["full", "liquid"], "weights": [1]}}, ["weights = [1]", "2 numbers"]),
        ({"shear": {"either": ["full", "liquid"], "weights": [1, 0]}}, ["above 0"]),
        ({"shear": {"either": ["full", "liquid"], "weights": [1, 10**400]}}, ["2 numbers"]),
        ({"correlation": 3}, ["correlation = 3", "[name, name, number]"]),
        (BOTH | {"correlation": [["tilt", 0.3]]}, ["[name, name, number]"]),
        (BOTH | {"correlation": [["tilt", ["share"], 0.3]]}, ["[name, name, number]"]),
        (BOTH | {"correlation": [["tilt", "slip", 0.3]]}, ["'slip' does not scatter", "tilt"]),
        (BOTH | {"correlation": [["tilt", "share", 1.0]]}, ["between -1 and 1"]),
        (BOTH | {"correlation": [["tilt", "tilt", 0.5]]}, ["two names"]),
        (
            BOTH | {"correlation": [["tilt", "share", 0.5], ["share", "tilt", 0.5]]},
            ["each pair once"],
        ),
        (
            {
                "tilt": "5 %",
                "shear": {"either": ["full", "liquid"]},
                "correlation": [["tilt", "shear", 0.5]],
            },
            ["shear is a choice"],
        ),
        (
            BOTH | {"correlation": [["roughness", "tilt", 0.9], ["tilt", "share", 0.9]]},
            ["not positive definite", "roughness, tilt, share", "make them smaller"],
        ),
    ],
)
def test_what_is_wrong_is_named(table, words):
    with pytest.raises(ParameterError) as caught:
        read(**table)
    text = str(caught.value)
    assert text.startswith("[scatter]: ") and "\n" not in text
    assert all(word in text for word in words), text


# Part files

PART = """
model = "washer"
name = "Mine"

[parameters]
roughness = "0.4 um"

[box]
load = ["20 N", "1.2 kN"]
oil_temperature = "80 degC"

[scatter]
roughness_washer = "10 %"
oil_temperature = { normal = "3 K", source = "sensor" }
friction_constant = 0.05
cavity_shear = { either = ["full", "liquid"], weights = [3, 1] }
load = { lognormal = 1.2 }
correlation = [["load", "oil_temperature", 0.5]]
"""


@pytest.fixture
def mine(tmp_path):
    path = tmp_path / "mine.toml"

    def read_part(*change: str):
        path.write_text(PART.replace(*change) if change else PART)
        return load_part(path)

    return read_part


def test_a_part_scatters_about_its_own_values(mine):
    part = mine()
    nominal = {s.place.name: s.place.nominal for s in part.scattered().sources}
    assert nominal == {
        "roughness_washer": 4e-7,  # 0 in the file: that of every surface
        "oil_temperature": 353.15,  # from the box
        "friction_constant": pytest.approx(0.48),
        "cavity_shear": "full",
        "load": 300.0,
    }
    there = part.scattered(inputs={"load": 800.0}).sources[-1]
    assert there.law.value(np.array([0.5])) == pytest.approx(800.0)
    assert part.scattered({"tilt": "5 %"}).names == ("tilt",)


def test_changed_parameters_carry_their_scatter_with_them(mine):
    part = mine('"0.4 um"', '"0.8 um"')
    assert part.scattered().sources[0].law.spread == pytest.approx(8e-8)


def test_a_part_is_written_back_with_its_scatter(mine, tmp_path):
    part, path = mine(), tmp_path / "again.toml"
    path.write_text(part_text(part))
    again = load_part(path)
    assert again.scatter == part.scatter != {}
    assert again.scattered() == part.scattered()


def test_a_draw_is_parameters_and_inputs(mine):
    part = mine()
    params, inputs = part.varied({"roughness_washer": 5e-7, "load": 250.0})
    assert params == WasherParams(roughness=4e-7, roughness_washer=5e-7)
    assert inputs == {"load": 250.0}
    by_load, _ = part.varied({"friction_constant": 0.53, "inner_radius": 0.012})
    given = {"friction_constant": 0.53, "friction_load_min": 260.5, "friction_load_max": 1725.6}
    expected = WasherParams(roughness=4e-7, inner_radius=0.012, **given)
    assert by_load.friction_reference == pytest.approx(expected.friction_reference, rel=1e-12)
    assert by_load.friction_pressure_min == pytest.approx(expected.friction_pressure_min)
    with pytest.raises(ParameterError, match="roughness_washer"):
        part.varied({"roughness_washer": 1e-9})


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("roughness_washer =", "roughness_wascher =", ["'roughness_wascher'", "roughness_washer"]),
        ("roughness_washer =", "fidelity =", ["'fidelity'"]),
        ('{ normal = "3 K", source = "sensor" }', '"1 %"', ["oil_temperature", "3 K"]),
    ],
)
def test_what_is_wrong_in_a_part_file_is_named(mine, old, new, words):
    with pytest.raises(ParameterError) as caught:
        mine(old, new)
    assert all(word in str(caught.value) for word in ["mine.toml", *words]), caught.value


def test_a_scatter_that_is_no_table_is_named(mine):
    with pytest.raises(ParameterError, match=r"scatter = 3, allowed: a table \[scatter\]"):
        mine(PART[PART.index("[parameters]") :], "scatter = 3")


def test_what_has_no_effect_is_a_warning():
    part = find_part("washer")
    (text,) = part.scattered({"dry_friction": "10 %"}).warnings
    assert "scatter of dry_friction has no effect: read by friction_law = constant only" in text
    either = {"either": ["load", "constant"]}
    assert part.scattered({"dry_friction": "10 %", "friction_law": either}).warnings == ()


@pytest.mark.parametrize(
    ("model", "preset", "name", "nominal"),
    [
        ("washer", "bronze", "yield_strength_washer", 150e6),
        ("washer", "bronze", "yield_strength_gear", 0.993e9),
        ("washer", None, "oil_supply_temperature", 297.15),
        ("washer", None, "far_face_temperature", 297.15),
        ("clutch", None, "effective_radius", 0.0749932886),
        ("clutch", None, "drum_speed", 0.0),
        ("gearmesh", None, "sigma_rms", 2.26e-6),
        ("gearmesh", None, "mean_roughness", 2.26e-6 / 2.0**0.5),
        ("gearmesh", None, "effective_roughness", 4.5e-5),
        ("gearmesh", None, "contact_limit", 1500e6),
        ("gearmesh", None, "addendum_gear", 1.0),
        ("gearmesh", None, "normal_module", 2.0 * 0.254 / 60.0),
        ("gearmesh", None, "bulk_heat_capacity", 20993.17236),
    ],
)
def test_zero_that_means_another_value_scatters_about_that(model, preset, name, nominal):
    part = find_part(model) if preset is None else preset_parts(find_part(model).spec)[preset]
    assert part.places()[name].nominal == pytest.approx(nominal, rel=1e-9)


@pytest.mark.parametrize("model", models_with_points())
def test_defaults_and_presets_scatter_and_say_why(model):
    for part in (find_part(model), *preset_parts(find_part(model).spec).values()):
        scatter = part.scattered()
        assert len(scatter.sources) >= 6 and scatter.warnings == ()
        for s in scatter.sources:
            assert "estimate" in s.reason or "docs/papers" in s.reason, s.place.name
        for row in scatter.values(np.random.default_rng(1).random((100, len(scatter.sources)))):
            part.varied(row)


@pytest.mark.parametrize("model", all_models(), ids=lambda m: m.key)
def test_every_parameter_and_input_has_a_place(model):
    part = find_part(model.key)
    for name, place in part.places().items():
        if place.choices:
            assert place.nominal in place.choices, name
        else:
            assert place.low <= place.nominal <= place.high, name
