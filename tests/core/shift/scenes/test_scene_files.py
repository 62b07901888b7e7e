"""Scene files: what is taken of them."""

import math
from dataclasses import fields

import pytest
from scene_runs import changed

from thrustwasher.shift import builtin_scenes, load_scene


@pytest.mark.parametrize("name", builtin_scenes())
def test_every_builtin_scene_loads_and_explains_itself(name):
    scene = load_scene(name)
    assert scene.name == name and scene.title and len(scene.description) > 20
    assert {"transmission", "clutch", "brake"} <= set(scene.parts)
    parameters = scene.parts["clutch"].parameters()
    known = [f.name for f in fields(scene.parts["clutch"].params)]
    assert list(parameters) == [*known, "fidelity"]


def test_units_and_a_base_are_understood(tmp_path):
    text = """oil_temperature = "90 degC"
[clutch]
roughness = "10 um"
faces = 6
film_dynamics = false"""
    scene = changed(tmp_path, text, "planetary-sun")
    assert scene.name == "mine" and scene.oil_temperature == pytest.approx(363.15)
    assert scene.parts["transmission"].params.oil_temperature == scene.oil_temperature
    clutch = scene.parts["clutch"].params
    assert clutch.roughness == pytest.approx(1e-5, rel=1e-15)
    assert (clutch.faces, clutch.film_dynamics) == (6, False)
    assert scene.parts["transmission"].params.helix_angle == math.radians(20.0)


def test_the_command_is_a_ramp():
    scene = load_scene("planetary-sun")
    assert [scene.command(t) for t in (0.0, 0.1, 0.4, 9.0)] == [0.0, 0.0, 1.0, 1.0]
    assert scene.command(0.25) == pytest.approx(0.5)


def test_the_command_may_run_the_other_way(tmp_path):
    scene = changed(tmp_path, "[shift]\nfrom = 1\nto = 0.5", "planetary-sun")
    assert [scene.command(t) for t in (0.0, 0.25, 9.0)] == [1.0, 0.75, 0.5]
    assert (scene.engaging, scene.releasing) == ("brake", "clutch")
    upshift = load_scene("planetary-sun")
    assert upshift.engaging == "clutch" and not upshift.alone
    assert load_scene("brake-test").alone
