"""What can scatter in a scene, by path; scenes with other values and their files."""

import re
from dataclasses import fields

import pytest
from scene_runs import changed

from thrustwasher.errors import ParameterError
from thrustwasher.model.oil import viscosity_of
from thrustwasher.shift import builtin_scenes, load_scene, with_fidelities
from thrustwasher.shift.scene.places import scene_places, scene_scatter
from thrustwasher.shift.scene.variation import scene_text, varied_scene
from thrustwasher.transmission.parameters import profile_points

# Path, a value, where the scene has it.
PATHS = [
    ("oil_temperature", 350.0, lambda s: s.oil_temperature),
    ("clutch.friction_scale", 1.1, lambda s: s.parts["clutch"].params.friction_scale),
    ("transmission.thrust_share", 0.05, lambda s: s.parts["transmission"].params.thrust_share),
    ("engine.inertia", 0.3, lambda s: s.parts["transmission"].params.input_inertia),
    ("engine.points.2", 190.0, lambda s: points(s, "engine_torque")[2][1]),
    ("engine.times.2", 0.47, lambda s: points(s, "engine_torque")[2][0]),
    ("pressure.clutch.points.3", 3.1e5, lambda s: points(s, "clutch_pressure")[3][1]),
    ("pressure.clutch.times.3", 0.41, lambda s: points(s, "clutch_pressure")[3][0]),
    (
        "pressure.brake.return_spring",
        3.1e4,
        lambda s: s.parts["transmission"].params.brake_return_spring,
    ),
    ("vehicle.mass", 1700.0, lambda s: s.vehicle.mass),
    (
        "sun_bearing.coefficient",
        0.005,
        lambda s: s.parts["transmission"].params.sun_bearing_coefficient,
    ),
    ("oil.density", 840.0, lambda s: s.parts["washer"].params.oil_density),
]
FACTORS = ("engine.torque_scale", "pressure.clutch.scale", "pressure.brake.scale")

CHOICE = "friction_temperature"


def points(scene, name):
    return profile_points(scene.parts["transmission"].params, name)


@pytest.mark.parametrize(("path", "value", "found"), PATHS, ids=[p[0] for p in PATHS])
def test_a_path_names_one_value_of_the_scene(path, value, found):
    scene = load_scene("planetary")
    place = scene_places(scene)[path]
    assert found(scene) == pytest.approx(place.nominal, rel=1e-12)
    assert place.low < value < place.high and found(varied_scene(scene, {path: value})) == value


@pytest.mark.slow
def test_every_place_holds_its_nominal_value():
    def bare(parts):
        """Values without the choice that a place of the table writes out: what auto means here."""
        found = {name: part.parameters() for name, part in parts.items()}
        return {n: {k: v for k, v in p.items() if k != CHOICE} for n, p in found.items()}

    scene = load_scene("planetary")
    for path, place in scene_places(scene).items():
        part, _, name = path.partition(".")
        own = getattr(scene.parts[part].params, name, None) if part in scene.parts else None
        if own is None or own == place.nominal:  # else 0 stands for another one's value
            varied = varied_scene(scene, {path: place.nominal})
            assert bare(varied.parts) == bare(scene.parts), path


def test_a_law_of_an_earlier_form_scatters_by_its_own_names():
    scene = load_scene("planetary-sun")
    varied = varied_scene(scene, {"washer.friction_constant": 0.5})
    slope = varied.parts["washer"].params.friction_reference
    assert scene_places(scene)["washer.friction_constant"].nominal == pytest.approx(0.48)
    assert slope == pytest.approx(scene.parts["washer"].params.friction_reference + 0.02)
    assert "washer.friction_constant" not in scene_places(load_scene("planetary"))


def test_factors_of_one_change_no_bit():
    plain = load_scene("planetary")
    one = varied_scene(plain, dict.fromkeys((*FACTORS, "oil.viscosity_scale"), 1.0))
    assert one.parts == plain.parts and one == plain


def test_a_factor_multiplies_a_whole_profile():
    plain = load_scene("planetary")
    scene = varied_scene(plain, {"engine.torque_scale": 1.04, "pressure.clutch.scale": 0.5})
    assert points(scene, "engine_torque") == [
        (t, 1.04 * x) for t, x in points(plain, "engine_torque")
    ]
    assert points(scene, "clutch_pressure") == [
        (t, 0.5 * x) for t, x in points(plain, "clutch_pressure")
    ]
    assert points(scene, "brake_pressure") == points(plain, "brake_pressure")


@pytest.mark.parametrize("oil", [None, "Dexron III"])
def test_the_viscosity_of_all_parts_is_multiplied(oil):
    plain = load_scene("planetary", oil)
    scene = varied_scene(plain, {"oil.viscosity_scale": 1.2})
    for name, part in scene.parts.items():
        before = plain.parts[name]
        known = viscosity_of(before.spec, before.params, 350.0)
        if known:
            assert viscosity_of(part.spec, part.params, 350.0) == pytest.approx(1.2 * known)


def test_the_file_of_a_draw_is_that_draw_to_the_bit(tmp_path):
    scene = load_scene("planetary").with_options(step=5e-4, master="jacobi")
    scene = with_fidelities(scene, ["washer=fine"])
    values = {path: value for path, value, _ in PATHS} | {"pressure.clutch.scale": 0.97}
    path = tmp_path / "draw.toml"
    path.write_text(scene_text(scene, values))
    read, made = load_scene(path), varied_scene(scene, values)
    differ = {
        f.name for f in fields(read) if f.compare and getattr(read, f.name) != getattr(made, f.name)
    }
    assert differ == {"name"}


def test_a_draw_of_a_file_with_an_oil_of_the_command_line(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('base = "planetary"\ntitle = "mine"\n')
    scene = load_scene(path, "Dexron III")
    draw = tmp_path / "there" / "draw.toml"
    draw.parent.mkdir()
    draw.write_text(scene_text(scene, {"clutch.friction_scale": 1.01}))
    assert load_scene(draw).parts == varied_scene(scene, {"clutch.friction_scale": 1.01}).parts


def test_a_base_hands_its_scatter_down(tmp_path):
    text = '[scatter]\ntransmission.thrust_share = "10 %"\n"clutch.faces" = { either = [4, 6] }'
    scene = changed(tmp_path, text, "planetary")
    base, found = scene_scatter(load_scene("planetary")), scene_scatter(scene)
    assert found.names == (*base.names, "clutch.faces")
    laws = {s.place.name: s.law.words() for s in found.sources}
    assert laws["transmission.thrust_share"] == "normal, standard deviation 10 %"
    assert laws["clutch.friction_scale"] == "normal, standard deviation 6 %"


def test_a_part_brings_its_own_scatter_but_for_what_the_scene_gives(tmp_path):
    (tmp_path / "pack.toml").write_text(
        'model = "clutch"\nname = "Pack"\n[scatter]\nfriction_scale = "4 %"\nroughness = "5 %"\n'
        'load = "5 %"\ncontact_modulus = "9 %"\n'
        'correlation = [["roughness", "friction_scale", 0.5], ["roughness", "load", 0.1]]\n'
    )
    text = '[clutch]\npart = "pack.toml"\ncontact_modulus = 1e7\n'
    text += '[scatter]\nclutch.friction_scale = "7 %"\n'
    found = scene_scatter(changed(tmp_path, text, "planetary"))
    laws = {s.place.name: s.law.words() for s in found.sources}
    assert laws["clutch.roughness"] == "normal, standard deviation 5 %"
    assert laws["clutch.friction_scale"] == "normal, standard deviation 7 %"
    assert not {"clutch.load", "clutch.contact_modulus"} & {*laws}
    joined = [{found.names[i] for i in group} for group in found.groups if len(group) > 1]
    assert joined == [{"clutch.roughness", "clutch.friction_scale"}]


def test_what_a_scene_has_not_does_not_scatter_and_that_is_said(tmp_path):
    found = scene_scatter(changed(tmp_path, "[transmission]\nwashers = 0", "planetary"))
    assert "washer.roughness" not in found.names
    assert any(w.startswith("scatter of washer.roughness:") for w in found.warnings)


@pytest.mark.parametrize("name", builtin_scenes())
def test_builtin_scatters_are_clean_and_have_a_source(name):
    found = scene_scatter(load_scene(name))
    assert found.warnings == () and all(source.reason for source in found.sources)


def test_the_default_scene_has_sixteen():
    assert len(scene_scatter(load_scene("planetary")).sources) == 16


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[scatter]\nclutch.friction_scal = "5 %"', "'clutch.friction_scale'"),
        ('[scatter]\nclutches.friction_scale = "5 %"', "'clutch.friction_scale'"),
        ('[scatter]\npressure.clutch.points.7 = "5 %"', "'pressure.clutch.points"),
        ('[scatter]\nclutch.oil_temperature = "3 K"', "there is no 'clutch.oil_temperature'"),
        ('[scatter]\noil_temperature = "3 %"', "oil_temperature: normal = '3 %'"),
        ('[scatter]\ntransmission.engine_torque = "3 %"', "'transmission.engine_torque'"),
        ("scatter = 3", "scatter = 3, allowed: a table [scatter]"),
        ("[engine]\ntorque_scale = 0.0", "torque_scale = 0.0, allowed: 0.01 .. 100"),
        ("[pressure.clutch]\nscale = true", "[pressure.clutch]: scale = True"),
        ("[oil]\nviscosity_scale = 200.0", "viscosity_scale = 200.0, allowed: 0.01 .. 100"),
        (
            '[scatter]\nclutch.faces = { either = [4, 6] }\n"clutch.faces" = { either = [2, 4] }',
            "clutch.faces is there twice",
        ),
    ],
)
def test_a_wrong_line_is_refused_in_words(tmp_path, text, words):
    with pytest.raises(ParameterError, match=re.escape(words)):
        changed(tmp_path, text, "planetary")


@pytest.mark.parametrize("path", ["clutch.friction", "pressure.clutch.points.9", "no", "a.b"])
def test_a_value_at_no_path_is_refused(path):
    with pytest.raises(ParameterError, match="there is no "):
        varied_scene(load_scene("planetary"), {path: 1.0})
