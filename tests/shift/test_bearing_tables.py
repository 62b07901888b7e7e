"""The tables [sun_bearing] and [ring_bearing], and what a scene is asked while it is read."""

import pytest
from scene_runs import real_shift, shift

from thrustwasher.errors import ParameterError
from thrustwasher.shift import builtin_scenes, load_scene


def scene(tmp_path, text, base="planetary"):
    path = tmp_path / "mine.toml"
    path.write_text(f'base = "{base}"\n{text}', encoding="utf-8")
    return load_scene(path)


def test_a_table_is_a_needle_bearing_unless_it_says_otherwise(tmp_path):
    given = '[sun_bearing]\n[ring_bearing]\nbetween = ["carrier", "case"]\nmean_radius = "40 mm"'
    p = scene(tmp_path, given, base="planetary-sun").parts["transmission"].params
    assert (p.sun_bearing_shaft_1, p.sun_bearing_shaft_2) == ("sun", "carrier")
    assert (p.ring_bearing_shaft_1, p.ring_bearing_shaft_2) == ("carrier", "case")
    assert p.sun_bearing_coefficient == p.ring_bearing_coefficient == 0.004
    assert p.ring_bearing_mean_radius == 0.04


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[sun_bearing]\nbetween = ["sun", "housing"]', "sun, carrier, ring, case"),
        ('[sun_bearing]\nbetween = ["sun", "sun"]', "two different shafts"),
        ('[ring_bearing]\nbetween = "ring"', "two different shafts"),
        ('[ring_bearing]\nradius = 0.03', "mean_radius"),
        ('[ring_bearing]\ncoefficient = 2.0', "ring_bearing_coefficient"),
        ('[transmission]\nsun_bearing_coefficient = 0.01', "allowed: one of them"),
        ('[transmission]\nengine_start_time = 0.2', "beside [engine]"),
        ('[transmission]\nclutch_force = 900.0', "beside [pressure]"),
    ],
)  # fmt: skip
def test_what_would_not_act_is_refused(tmp_path, text, said):
    with pytest.raises(ParameterError) as refused:
        scene(tmp_path, text)
    assert said in str(refused.value) and "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[transmission]\nwashers = 6", "6 with planets = 4"),
        ("[transmission]\nwasher_radius = 0.02", "washer_radius = 0.02 m"),
        ('[sun_bearing]\nbetween = ["ring", "case"]', "not at the sun"),
        ("[transmission]\nhelix_angle = 0.0", "spur teeth"),
        ("stop_time = 0.9", "cut off"),
    ],
)
def test_what_is_doubtful_is_a_warning(tmp_path, text, said):
    found = scene(tmp_path, text).warnings
    assert any(said in line for line in found) and not any("\n" in line for line in found)


@pytest.mark.parametrize("name", builtin_scenes())
def test_built_in_scenes_are_in_no_doubt(name):
    assert load_scene(name).warnings == ()


def test_bearings_are_in_the_book_which_closes():
    run = real_shift("planetary")
    loss = run.figures["bearing_loss"]
    assert loss == run.energy["bearings"] == run.signals["transmission.bearing_heat"][-1]
    assert 60.0 < loss < 100.0 and 80.0 < run.figures["peak_bearing_power"] < 130.0
    assert run.energy["residual_share"] < 1e-12
    assert not any("rests on no bearing" in line for line in run.messages)


def test_a_thrust_without_a_bearing_is_said():
    run = shift("planetary-sun", stop_time=0.02, parts={"mesh": None, "washer": None})
    assert "bearing_loss" not in run.figures and run.energy["bearings"] == 0.0
    assert any("the sun's and the ring's thrust" in line for line in run.messages)
    assert not any("thrust" in line for line in shift("msl", stop_time=0.02).messages)
