"""Scene files: what is taken, and one clear line for everything that is not."""

import math
from dataclasses import fields

import pytest

from thrustwasher.errors import ParameterError
from thrustwasher.shift import builtin_scenes, load_scene

TEXT = """
base = "planetary-sun"
{top}
[{table}]
{inside}
"""


def written(tmp_path, top="", table="clutch", inside=""):
    path = tmp_path / "mine.toml"
    path.write_text(TEXT.format(top=top, table=table, inside=inside), encoding="utf-8")
    return str(path)


@pytest.mark.parametrize("name", builtin_scenes())
def test_every_builtin_scene_loads_and_explains_itself(name):
    scene = load_scene(name)
    assert scene.name == name and scene.title and len(scene.description) > 20
    assert {"transmission", "clutch", "brake"} <= set(scene.parts)
    parameters = scene.parts["clutch"].parameters()
    known = [f.name for f in fields(scene.parts["clutch"].params)]
    assert list(parameters) == [*known, "fidelity"]


def test_the_default_set_can_be_built_and_the_reference_set_has_no_gears():
    p = load_scene("planetary-sun").parts["transmission"].params
    assert (p.sun_teeth + p.ring_teeth) % p.planets == 0
    assert p.ring_teeth - p.sun_teeth == 2 * p.planet_teeth
    assert load_scene("msl").parts["transmission"].params.planet_teeth == 0


def test_units_and_a_base_are_understood(tmp_path):
    inside = 'roughness = "10 um"\nfaces = 6\nfilm_dynamics = false'
    scene = load_scene(written(tmp_path, 'oil_temperature = "90 degC"', "clutch", inside))
    assert scene.name == "mine" and scene.oil_temperature == pytest.approx(363.15)
    assert scene.parts["transmission"].params.oil_temperature == scene.oil_temperature
    clutch = scene.parts["clutch"].params
    assert clutch.roughness == pytest.approx(1e-5, rel=1e-15)
    assert (clutch.faces, clutch.film_dynamics) == (6, False)
    assert scene.parts["transmission"].params.helix_angle == math.radians(20.0)


def test_a_part_may_start_from_a_preset(tmp_path):
    inside = 'preset = "paper"\nconduction = "carrier"'
    params = load_scene(written(tmp_path, "", "washer", inside)).parts["washer"].params
    assert (params.oil_cooling, params.conduction) == (False, "carrier")
    assert params.outer_radius == load_scene("planetary-sun").parts["washer"].params.outer_radius


def test_a_base_beside_the_file_is_found(tmp_path):
    written(tmp_path, "step = 2e-3")
    (tmp_path / "top.toml").write_text('base = "mine.toml"\nstop_time = 1.0\n', encoding="utf-8")
    scene = load_scene(tmp_path / "top.toml")
    assert (scene.step, scene.stop_time) == (2e-3, 1.0)


def test_the_command_is_a_ramp():
    scene = load_scene("planetary-sun")
    assert [scene.command(t) for t in (0.0, 0.1, 0.4, 9.0)] == [0.0, 0.0, 1.0, 1.0]
    assert scene.command(0.25) == pytest.approx(0.5)


def test_the_command_may_run_the_other_way(tmp_path):
    scene = load_scene(written(tmp_path, "", "shift", "from = 1\nto = 0.5"))
    assert [scene.command(t) for t in (0.0, 0.25, 9.0)] == [1.0, 0.75, 0.5]
    assert (scene.engaging, scene.releasing) == ("brake", "clutch")
    upshift = load_scene("planetary-sun")
    assert upshift.engaging == "clutch" and not upshift.alone
    assert load_scene("brake-test").alone


def test_the_choice_of_master_reaches_the_transmission():
    scene = load_scene("msl")
    assert scene.parts["transmission"].params.torque_age == 0
    assert scene.with_options(master="jacobi").parts["transmission"].params.torque_age == 1


@pytest.mark.parametrize(
    ("top", "table", "inside", "message"),
    [
        ("stop_tim = 2.0", "clutch", "", r"there is no 'stop_tim' here; did you mean 'stop_time'"),
        (
            "",
            "clutch",
            "inner_radios = 0.1",
            r"\[clutch\]: there is no 'inner_radios' here; did you",
        ),
        ("", "clutch", "faces = 0", r"\[clutch\]: faces = 0, allowed: 1 .. 100"),
        ("", "clutch", "faces = 2.5", r"\[clutch\]: faces = 2.5, allowed: 1 .. 100"),
        ("", "clutch", "roughness = true", r"\[clutch\]: roughness = True, a number in m"),
        ("", "clutch", 'roughness = "1 kg"', r"\[clutch\]: .*roughness.*kg"),
        ("", "clutch", "inner_radius = 0.2", r"\[clutch\]: inner_radius = 0.2 m, allowed: below"),
        ("", "clutch", 'fidelity = "best"', r"\[clutch\]: fidelity = 'best', allowed: 'closed' or"),
        (
            "",
            "clutch",
            'friction_law = "dry"',
            r"\[clutch\]: friction_law = 'dry', allowed: 'wang'",
        ),
        (
            "",
            "transmission",
            'preset = "paper"',
            r"\[transmission\]: preset = .*allowed: none",
        ),
        (
            "",
            "washer",
            'preset = "peper"',
            r"\[washer\]: preset = 'peper', allowed: 'bronze' or 'paper'",
        ),
        ("", "transmission", "oil_temperature = 300", r"oil_temperature cannot be set here"),
        ("", "transmission", "torque_age = 1", r"torque_age cannot be set here"),
        ("", "shift", "begin = 1", r"\[shift\]: there is no 'begin' here"),
        ("", "shift", "duration = -1", r"\[shift\]: duration = -1.0 s, allowed: 0 .."),
        ("", "shift", "to = 1.5", r"\[shift\]: to = 1.5, allowed: 0 .. 1$"),
        ("step = 0", "clutch", "", r"step = 0.0 s, allowed: 1e-06 .. 1 s"),
        ("stop_time = 0", "clutch", "", r"stop_time = 0.0 s, allowed: start_time \+ 1"),
        ("step = 1e-6\nstop_time = 9", "clutch", "", r"stop_time = 9.0 s, allowed: start_time"),
        (
            'master = "euler"',
            "clutch",
            "",
            r"master = 'euler', allowed: 'gauss-seidel' or 'jacobi'",
        ),
        ("oil_temperature = 24", "clutch", "", r"oil_temperature = 24.0 K, allowed: 233.15"),
        ("title = 3", "clutch", "", r"title = 3, allowed: a text"),
        ("shift = 3", "clutch", "", r"shift = 3, allowed: a table \[shift\]"),
        ("step = nan", "clutch", "", r"step"),
        ("master_tolerance = 1e-4", "clutch", "", "master_tolerance: there is no step-doubling"),
        ('master = "step-doubling"', "clutch", "", "allowed: .*; there is no step-d"),
    ],
)
def test_what_is_wrong_is_named(tmp_path, top, table, inside, message):
    with pytest.raises(ParameterError, match=message) as caught:
        load_scene(written(tmp_path, top, table, inside))
    assert "\n" not in str(caught.value) and "mine" in str(caught.value)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("planetry", "scene = 'planetry', allowed: .* did you mean 'planetary'"),
        ("nowhere.toml", r"scene = 'nowhere.toml': cannot be read \(No such file"),
        ("", "scene = '', allowed: brake-test, "),
    ],
)
def test_a_missing_scene_is_named(name, message):
    with pytest.raises(ParameterError, match=message):
        load_scene(name)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"stop_time = = 1", "not valid TOML"),
        (b"\xff\xfe\x00", "cannot be read"),
        (b"stop_time = 1.0", "'transmission' is missing"),
        (b'base = "loop.toml"', "go round in a circle"),
        (b"base = 3", "base = 3, allowed: a scene's name"),
    ],
)
def test_a_broken_file_is_named(tmp_path, content, message):
    path = tmp_path / "loop.toml"
    path.write_bytes(content)
    with pytest.raises(ParameterError, match=message):
        load_scene(path)
