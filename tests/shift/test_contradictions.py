"""A scene whose gear meshes are not those of its planetary set says so when it is read."""

import pytest

from thrustwasher.shift import load_scene
from thrustwasher.shift.scene.scene_file import builtin_scenes


@pytest.mark.parametrize("name", builtin_scenes())
def test_the_built_in_scenes_contradict_nothing(name):
    assert load_scene(name).warnings == ()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "[mesh]\npinion_teeth = 20",
            "[mesh] pinion_teeth = 20, gear_ratio = 2.11111 (42.22 teeth",
        ),
        ("[ring_mesh]\ngear_ratio = 4.0", "[ring_mesh] pinion_teeth = 18, gear_ratio = 4"),
        ("[ring_mesh]\ninternal = false\naddendum_gear = 1.0", "[ring_mesh] internal = False, but"),
        ('[mesh]\nnormal_module = "1.6 mm"', "[mesh] centre distance = 0.0476"),
        ('[mesh]\nhelix_angle = "10 deg"', "[mesh] centre distance"),
        ("[transmission]\nhelix_angle = 0.0", "[mesh] helix_angle = 0.349066 rad, but"),
        ("[mesh]\nload_share = 0.5", "[mesh] load_share = 0.5 has no effect"),
        ('[mesh]\nmean_roughness = "2 um"', "[mesh] mean_roughness = 2e-06 m beside"),
    ],
)
def test_what_contradicts_the_set_is_said(tmp_path, text, said):
    path = tmp_path / "mine.toml"
    path.write_text(f'base = "planetary"\n{text}', encoding="utf-8")
    found = load_scene(path).warnings
    assert any(line.startswith(said) for line in found), found
    assert not any("\n" in line for line in found)
