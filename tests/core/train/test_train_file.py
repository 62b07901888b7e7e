"""A scene ``[train]``: names, defaults, a chain of meshes, what is refused; what parts can do."""

import json
import math
import re
from dataclasses import fields
from pathlib import Path

import pytest

from thrustwasher import ParameterError, load_part, load_scene, optimise, propagate, run_shift
from thrustwasher.cli import main
from thrustwasher.model.part_file import find_part, part_text, preset_part
from thrustwasher.train.parameters import SPEC, TrainParams
from thrustwasher.train.solve import solve_train
from thrustwasher.train.train_file import load_train
from thrustwasher.train.train_map import train_map

SCENE = Path(__file__).parents[3] / "examples" / "ev-reducer.toml"
TEXT = SCENE.read_text("utf-8")
BEARING = next(line for line in TEXT.splitlines() if line.startswith("  { type"))


def written(folder, text):
    path = folder / "mine.toml"
    path.write_text(text, "utf-8")
    return path


def test_the_example_is_the_built_in_one_and_what_a_train_is_by_default():
    mine, built_in = load_part(SCENE), preset_part(SPEC, "ev-reducer")
    assert mine == built_in and mine.name == "EvReducer"
    plain, oily = TrainParams(), ("oil_density", "viscosity_scale", "viscosity_b", "viscosity_c")
    used = [f.name for f in fields(plain) if not f.name.startswith(("mesh_3", "shaft_4"))]
    other = {n for n in used if getattr(mine.params, n) != getattr(plain, n)}
    assert other == {*oily}  # rounded by default
    for name in oily:
        assert getattr(mine.params, name) == pytest.approx(getattr(plain, name), rel=1e-3)


PUSHED = TEXT.replace(
    "[train.meshes.first]",
    """[[train.shafts.differential.forces]]
position = "160 mm"
radial = "3 kN"
direction = "33.3 deg"
axial = "0.5 kN"

[train.meshes.first]""",
)


@pytest.mark.parametrize("text", [TEXT, PUSHED], ids=["plain", "pushed"])
def test_written_again_it_is_nested_with_the_same_names_and_numbers(tmp_path, text):
    mine = load_part(written(tmp_path, text))
    again = part_text(mine)
    found = load_part(written(tmp_path, again))
    assert found.params == mine.params and found.box == mine.box and found.names == mine.names
    assert found.scatter == mine.scatter and found.description == mine.description
    assert "[train.meshes.second]" in again and 'helix_angle = "22 deg"' in again
    assert "mesh_1" not in again
    assert ('direction = "33.3 deg"' in again) == ("33.3" in text)


def test_bearings_with_names_of_their_own_keep_them(tmp_path):
    ends = "bearings.left = { type = 'ball', position = '0 mm', diameter = '60 mm', C = '35 kN' }\n"
    ends += ends.replace("left", "right").replace("0 mm", "90 mm", 1)
    first, last = TEXT.index("bearings = ["), TEXT.index("]\n", TEXT.index("bearings = [")) + 2
    mine = load_part(written(tmp_path, TEXT[:first] + ends + TEXT[last:]))
    found = load_part(written(tmp_path, part_text(mine)))
    assert found.names == mine.names and "rotor.right." in found.names
    assert found.params == mine.params


def test_shafts_are_a_chain_from_the_input_whatever_their_order(tmp_path):
    turned = TEXT.replace("[train]\n", '[train]\ninput = "differential"\n')
    found = load_train(written(tmp_path, turned))
    assert found.shafts == ("differential", "middle", "rotor")
    assert found.meshes == ("second", "first")
    p = found.part.params
    assert (p.mesh_1_driver, p.mesh_1_pinion_teeth, p.shaft_3_seals) == ("gear", 21, 1)
    r = solve_train(p, torque=-1000.0, speed=50.0)
    assert r.output_speed == pytest.approx(50.0 * 64 / 21 * 3.0) and r.flow == "output to input"


def test_a_mesh_takes_a_preset_or_a_part_and_what_stands_beside(tmp_path):
    lines = '[parameters]\nnormal_module = "2.5 mm"\npinion_teeth = 23\nface_width = "30 mm"\n'
    (tmp_path / "pair.toml").write_text(f'model = "gearmesh"\nname = "Pair"\n{lines}')
    own = TEXT.replace("pinion_teeth = 25\n", 'part = "pair.toml"\n').replace(
        'normal_module = "2 mm"\n', ""
    )
    p = load_part(written(tmp_path, own)).params
    assert (p.mesh_1_pinion_teeth, p.mesh_1_normal_module) == (23, 2.5e-3)
    assert p.mesh_1_face_width == 0.032  # stands next to
    planet = TEXT.replace("pinion_teeth = 25\n", 'preset = "planet"\n')
    assert load_part(written(tmp_path, planet)).params.mesh_1_pinion_teeth == 18


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('gear = "middle"', 'gear = "midle"', "gear = 'midle', allowed: 'rotor' or 'middle'"),
        ('gear = "differential"', 'gear = "rotor"', "a chain of meshes, without branches"),
        ('gear = "middle"', 'gear = "rotor"', "pinion and gear are on the same shaft"),
        ("[train.meshes.second]", "[train.meshes.rotor]", "'rotor' is a shaft and a mesh"),
        ('hand = "right"', 'hand = "up"', "allowed: 'right' or 'left'"),
        ('position = "85 mm"\n', "", "'position' or 'pinion_position' is missing"),
        ("pinion_teeth = 25", "pinion_tooth = 25", "did you mean 'pinion_teeth'"),
        ('type = "ball", position = "0 mm"', 'position = "0 mm"', "'type' is missing"),
        ('position = "90 mm"', 'position = "0 mm"', "allowed: apart from"),
        ("pinion_teeth = 21", "pinion_teeth = 5", "mesh 2: pinion_teeth = 5"),
        ("[train]\n", "[train]\noil_volum = 3\n", "did you mean 'oil_volume'"),
        ('arrangement = "X"', 'axial = "pushed"', "middle.: 'arrangement' is missing, allowed"),
        ('arrangement = "X"', 'arrangement = "T"', "arrangement = 'T', allowed: 'O' or 'X'"),
        ('arrangement = "X"', 'arrangement = "X"\naxial = "first"', "one of the two"),
        ("Y = 1.6", "Y = 0", "middle.bearing_1_y_factor = 0.0, .* or give"),
        (BEARING, f"{BEARING}\n{BEARING}", "exactly two"),
        ("seals = 2", "seals = 2\nforces = [{}, {}, {}]", "2 tables at most"),
        ("seals = 2", "seals = 2\nforces = [{ radial = 3 }]", "force 1: radial without 'position'"),
        (
            "seals = 2",
            'seals = 2\nforces = [{ position = "1 mm", radial = "3 N" }]',
            "force 1: radial without 'direction'",
        ),
    ],
)
def test_what_is_wrong_is_named(old, new, words, tmp_path):
    assert old in TEXT
    with pytest.raises(ParameterError, match=words):
        load_part(written(tmp_path, TEXT.replace(old, new, 1)))


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        ("train --part {} --set normal_module=3mm", "first.normal_module"),
        ("train --part {} --set second.normal_modul=3mm", "second.normal_module"),
        ("train --set normal_module=3mm", "mesh_1_normal_module"),
        ("sweep {} --over normal_module=2mm:3mm:n3", "first.normal_module"),
        ("scatter {} --set gear_immersion=0.1", "first.gear_immersion"),
        ("optimise {} --vary second.face_widht=40mm:50mm --minimise loss", "second.face_width"),
        ("optimise {} --vary first.face_width=30mm:40mm --minimise first.los", "first.loss"),
    ],
)
def test_suggestions_are_names_of_this_file(words, meant, capsys):
    assert main(words.format(SCENE).split()) == 2
    assert f"did you mean {meant}?" in capsys.readouterr().err


def test_names_of_the_file_are_taken(tmp_path, capsys):
    told = []
    for name in ("first.normal_module", "mesh_1_normal_module"):
        assert main(["train", "--part", str(SCENE), "--set", f"{name}=2.1mm", "--json"]) == 0
        told.append(json.loads(capsys.readouterr().out)["loss"])
    assert told[0] == told[1]
    out = tmp_path / "rows.csv"
    assert main(["sweep", str(SCENE), "--over", "first.load_factor=1,2", "--out", str(out)]) == 0
    capsys.readouterr()
    by_file = load_part(SCENE).scattered({"first.load_factor": "5 %"}).names
    assert by_file == ("first.load_factor",)
    flat = load_part(SCENE).scattered({"mesh_1_load_factor": "5 %"}).names
    assert flat == by_file
    head = out.read_text().partition("\n")[0].split(",")
    assert "first.load_factor" in head and "rotor.bearing_1_life [s]" in head
    assert not [name for name in head if name.startswith(("mesh_1_", "mesh_2_", "shaft_1_"))]
    with pytest.raises(ParameterError, match=r"did you mean .first\.load_factor"):
        load_part(written(tmp_path, TEXT.replace('"first.load_factor"', '"load_factor"')))


def test_bearings_may_have_names_of_their_own(tmp_path):
    """``input.left.life``: a table of two bearings by name in place of a list."""
    given = TEXT[: TEXT.index("bearings = [")], TEXT[TEXT.index("bearings = [") :]
    pair = given[1][: given[1].index("]\n") + 1]
    first, second = re.findall(r"\{.*\}", pair)
    named = f"bearings.left = {first}\nbearings.right = {second}"
    scene = load_train(written(tmp_path, TEXT.replace(pair, named)))
    listed = load_train(SCENE)
    assert scene.part.params == listed.part.params
    shaft = listed.shafts[0]
    found = train_map(scene, [50.0], [300.0])
    plain = train_map(listed, [50.0], [300.0])
    assert found.columns[f"{shaft}.left.life"] == plain.columns[f"{shaft}.bearing_1_life"]
    assert scene.part.own_text("shaft 1, bearing 2: too fast") == f"{shaft}, right: too fast"
    assert scene.part.flat_name(f"{shaft}.right.capacity") == "shaft_1_bearing_2_capacity"


def test_what_is_not_there_is_said_to_have_no_effect():
    p = TrainParams(mesh_3_face_width=0.05, shaft_1_bearing_1_pressure_centre=0.01)
    said = solve_train(p, torque=150.0, speed=500.0).warnings[:2]
    assert said[0].startswith("mesh_3_face_width = 50 mm has no effect: read by meshes >= 3 only")
    name = "shaft_1_bearing_1_pressure_centre = 10 mm"
    assert said[1].startswith(f"{name} has no effect: read by shaft_1_axial = O or X only")


def test_taper_bearings_need_an_arrangement_and_balls_take_any():
    """Flat, as an FMU has it: ``axial`` is O or X too, ``arrangement`` another name of it."""
    with pytest.raises(ParameterError, match="shaft_2_axial = 'first', allowed: 'O' or 'X'"):
        TrainParams(shaft_2_axial="first")
    balls = {f"shaft_2_bearing_{k}_type": "ball" for k in (1, 2)}
    r = solve_train(TrainParams(shaft_2_axial="first", **balls), torque=150.0, speed=500.0)
    assert r.shaft_2_bearing_1_axial_force > 0.0 == r.shaft_2_bearing_2_axial_force
    assert TrainParams(shaft_2_arrangement="O") == TrainParams(shaft_2_axial="O")
    double = {f"shaft_2_bearing_{k}_induced_factor": 0.0 for k in (1, 2)}
    assert TrainParams(shaft_2_axial="second", **double).shaft_2_axial == "second"


def test_a_map_tells_how_far_it_is():
    told = []
    scene = load_train(SCENE)
    train_map(scene, [50.0], [200.0, 300.0], progress=lambda *now: told.append(now))
    assert told == [(1, 2), (2, 2)]
    train_map(scene, [50.0], [300.0], progress=True)
    with pytest.raises(ParameterError, match="progress = 7"):
        train_map(scene, [50.0], [300.0], progress=7)


def test_a_map_has_the_names_of_the_scene():
    found = train_map(load_train(SCENE), [-50.0, 50.0], [-300.0, 300.0], [313.15, 353.15])
    c = found.columns
    assert found.balance < 1e-14 and len(c["torque"]) == 8
    assert c["mesh_loss"] == pytest.approx(c["first.loss"] + c["second.loss"], rel=1e-14)
    assert c["bearing_life"] == pytest.approx(
        [min(c[n][i] for n in c if n.endswith("_life") and "." in n) for i in range(8)]
    )
    assert found.flow[:4] == (
        "input to output",
        "output to input",
        "output to input",
        "input to output",
    )
    assert [text for lines in found.doubts for text in lines if text.startswith("first: load")]


def test_the_command_draws_writes_and_tells(tmp_path, capsys):
    out, plot = tmp_path / "map.csv", tmp_path / "map.png"
    over = ["--over", "torque=-100:100:100", "--over", "speed=-300,0,300"]
    over += ["--over", "oil_temperature=40degC,80degC"]
    assert main(["efficiency", str(SCENE), *over, "--out", str(out), "--plot", str(plot)]) == 0
    said = capsys.readouterr().out
    for words in ("tooth friction of all meshes", "minimum bearing_life", ": rotor.bearing_1, at"):
        assert words in said
    assert out.read_text().splitlines()[0].startswith("torque [N.m],speed [rad/s],oil_temperature")
    assert plot.stat().st_size > 10_000
    assert main(["efficiency", "ev-reducer", *over[:4], "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert len(told["points"]) == 9 and told["balance"] < 1e-14
    assert told["points"][0]["flow"] == "input to output"
    assert main(["efficiency", "ev-reducer", "--gear", "first"]) == 2
    assert "a gear train has one gear" in capsys.readouterr().err


def test_a_train_that_locks_itself_has_a_word_in_the_map(tmp_path):
    wide = TEXT.replace(
        'diameter = "60 mm", section = 0.67', 'diameter = "1.5 m", f1 = 0.02, section = 0.67'
    )
    found = train_map(load_train(written(tmp_path, wide)), [-100.0], [50.0])
    assert found.flow == ("self-locking",) and math.isnan(found.columns["efficiency"][0])
    assert found.doubts[0][0].startswith("self-locking")


@pytest.mark.slow
def test_it_scatters_and_is_optimised_as_any_part():
    found = propagate(str(SCENE), at={"torque": 150.0, "speed": 500.0}, runs=32, seed=1)
    drawn = found.sample["efficiency"]
    assert 0.98 < min(drawn) < max(drawn) < 0.99
    best = optimise(
        str(SCENE),
        vary={"mesh_1_helix_angle": "15 deg:25 deg"},
        minimise="loss",
        limits=["mesh_1_pitting_safety>=1.2"],
        at={"torque": 150.0, "speed": 500.0},
    )
    assert best.best.figures["loss"] < best.start["loss"]


@pytest.mark.parametrize("load", [load_scene, run_shift])
@pytest.mark.parametrize("named", ["ev-reducer", str(SCENE), "flat"])
def test_a_shift_of_it_is_refused_with_the_commands_that_take_it(tmp_path, load, named):
    if named == "flat":
        named = str(written(tmp_path, 'model = "train"\nname = "Mine"\n'))
    words = (
        rf"scene = '{named}': is a gear train, without a shift: `thrustwasher efficiency {named}`"
    )
    with pytest.raises(ParameterError, match=words) as told:
        load(named)
    assert "\n" not in str(told.value) and "explore, sweep, scatter, optimise" in str(told.value)


@pytest.mark.slow
def test_the_built_in_one_goes_by_its_name_alone():
    by_name = propagate("ev-reducer", at={"torque": 150.0, "speed": 500.0}, runs=8, seed=1)
    by_file = propagate(str(SCENE), at={"torque": 150.0, "speed": 500.0}, runs=8, seed=1)
    assert list(by_name.sample["loss"]) == list(by_file.sample["loss"])
    assert find_part("ev-reducer") == preset_part(SPEC, "ev-reducer")


def test_the_command_solves_a_point(capsys):
    assert main(["train", "--torque", "150", "--speed", "500", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["efficiency"] == pytest.approx(0.98381, abs=1e-5)
    assert told["mesh_3_loss"] is None and told["flow"] == "input to output"
    assert find_part("train").params == TrainParams()


def test_forces_from_outside_are_tables_of_a_shaft(tmp_path):
    chain = """
[[train.shafts.differential.forces]]
position = "160 mm"
radial = "2 kN"
direction = "90 deg"

[[train.shafts.differential.forces]]
position = "-40 mm"  # no part of an axial force or a moment
axial = "-500 N"
moment = "30 N.m"
moment_direction = "180 deg"

[train.meshes.first]
"""
    scene = load_train(written(tmp_path, TEXT.replace("[train.meshes.first]", chain)))
    p, plain = scene.part.params, load_part(SCENE).params
    changed = {f.name: getattr(p, f.name) for f in fields(p)}
    changed = {n: v for n, v in changed.items() if v != getattr(plain, n)}
    of = "shaft_3_force_"
    assert changed == pytest.approx(
        {f"{of}1_position": 0.16, f"{of}1_radial": 2e3, f"{of}1_direction": math.pi / 2.0}
        | {f"{of}2_axial": -500.0, f"{of}2_moment": 30.0}
        | {f"{of}2_moment_direction": math.pi}
    )
    maps = [train_map(s, [150.0], [500.0]).columns for s in (scene, load_train(SCENE))]
    names = ("differential.bearing_2_radial_force", "loss", "bearing_life")
    assert all(maps[0][name] != maps[1][name] for name in names[:2])
