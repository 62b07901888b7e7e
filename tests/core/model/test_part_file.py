"""Part files: what is written is read back to the bit; what is wrong is named."""

import pytest

from thrustwasher import ParameterError, WasherParams, load_part
from thrustwasher.model.part_file import part_text, preset_parts
from thrustwasher.model.registry import all_models
from thrustwasher.shift import load_scene
from thrustwasher.units import exact_quantity, parse_quantity

MINE = """
model = "washer"
name = "Mine"

[parameters]
roughness = "0.4 um"
thermal_mode = "transient"
oil_cooling = false

[box]
load = ["20 N", "1.2 kN"]
oil_temperature = "80 degC"
"""


@pytest.fixture
def mine(tmp_path):
    def write(*changes: tuple[str, str]):
        path, text = tmp_path / "mine.toml", MINE
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        path.write_text(text)
        return path

    return write


def test_a_part_is_its_parameters_its_box_and_its_name(mine):
    part = load_part(mine())
    changed = WasherParams(roughness=0.4e-6, thermal_mode="transient", oil_cooling=False)
    assert (part.name, part.params, part.fidelity) == ("Mine", changed, "field")
    assert part.box == {"load": (20.0, 1200.0), "oil_temperature": (353.15, 353.15)}


def test_a_range_is_a_list_or_a_text_and_notes_may_be_a_table(mine):
    path = mine(('["20 N", "1.2 kN"]', '"20 N:1.2 kN"'))
    path.write_text(path.read_text() + '\n[notes]\ndrawing = "4711"\nrevision = 3\n')
    part = load_part(path)
    assert part.box["load"] == (20.0, 1200.0)
    assert part.notes == "drawing: 4711; revision: 3"


@pytest.mark.parametrize("model", all_models(), ids=lambda m: m.key)
def test_presets_written_and_read_again_are_the_same_to_the_bit(model, tmp_path):
    for name, part in preset_parts(model.spec).items():
        path = tmp_path / f"{name}.toml"
        path.write_text(part_text(part))
        again = load_part(path)
        assert (again.params, again.box, again.notes) == (part.params, part.box, part.notes)


@pytest.mark.parametrize(
    ("value", "unit"),
    [(5.15e-7, "m"), (0.1, "m"), (1 / 3, "rad"), (297.15, "K"), (6.8e9, "1/m2"), (1e5 / 3, "Pa")],
)
def test_a_number_with_a_readable_unit_is_the_same_number(value, unit):
    assert parse_quantity(exact_quantity(value, unit), unit, "x") == value


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"0.4 um"', '"0.4 N"', ["[parameters]", "roughness", "0.4 N", "um"]),
        ('"0.4 um"', '"4 m"', ["[parameters]", "roughness = 4.0 m", "1e-05 m"]),
        ("roughness", "roughnes", ["[parameters]", "'roughnes'", "roughness"]),
        ('"transient"', '"quick"', ["thermal_mode", "'quick'", "quasi_steady"]),
        ("false", '"no"', ["oil_cooling", "'no'", "true or false"]),
        ('name = "Mine"', 'name = "my washer"', ["name = 'my washer'", "letters, digits and _"]),
        ('name = "Mine"', 'name = "Nul"', ["name = 'Nul'", "device of Windows"]),
        ('name = "Mine"', "", ["'name' is missing"]),
        ('"washer"', '"whasher"', ["model = 'whasher'", "ThrustWasher", "did you mean 'washer'?"]),
        ('"1.2 kN"', '"300 kN"', ["[box]", "load = 300000.0 N", "0 .. 200000 N"]),
        ('["20 N", "1.2 kN"]', '["1.2 kN", "20 N"]', ["[box]", "load", "low <= high"]),
        ('["20 N", "1.2 kN"]', '["1 N", "2 N", "3 N"]', ["[box]", "load", "[low, high]"]),
        ("oil_temperature =", "oil =", ["[box]", "'oil'"]),
        ("[box]", "[boxes]", ["'boxes'", "box"]),
        ("[box]", "[box", ["not valid TOML"]),
    ],
)
def test_what_is_wrong_in_a_part_file_is_named(mine, old, new, words):
    path = mine((old, new))
    with pytest.raises(ParameterError) as caught:
        load_part(path)
    for word in ["mine.toml", *words]:
        assert word in str(caught.value)


@pytest.mark.parametrize(
    ("text", "line", "code"),
    [
        ('model = "washer"\nname = "A"\ndescription = "bell \\u0007"', 3, "0007"),
        (
            'model = "washer"\nnotes = "\\\\b \\t"\ndescription = "x \\uFFFE y"\nname = "A"',
            3,
            "FFFE",
        ),
        ("model = 'washer'\nnotes = '\\b'\ndescription = " + '"""\nfirst\n\\b"""', 5, "0008"),
        ('model = "washer"\n[parameters]\n"rough\\u001bness" = 1', 3, "001B"),
    ],
)
def test_characters_that_no_xml_may_hold_are_refused_with_their_line(tmp_path, text, line, code):
    """Before, they went into an FMU and an SSP that nothing could read, with exit status 0."""
    (tmp_path / "mine.toml").write_text(text, "utf-8")
    with pytest.raises(ParameterError, match=rf"mine\.toml': line {line}: character U\+{code} in"):
        load_part(tmp_path / "mine.toml")
    scene = 'base = "msl"\ntitle = "1\\u0001"'
    (tmp_path / "scene.toml").write_text(scene, "utf-8")
    with pytest.raises(ParameterError, match=r"scene\.toml': line 2: character U\+0001"):
        load_scene(tmp_path / "scene.toml")


def test_a_byte_order_mark_as_of_windows_editors_is_no_part_of_the_text(mine):
    path = mine()
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))
    assert load_part(path).name == "Mine"
    path.write_bytes(MINE.encode("utf-16"))
    with pytest.raises(ParameterError, match="not UTF-8 text"):
        load_part(path)


def test_a_file_that_is_none_is_named(tmp_path):
    with pytest.raises(ParameterError, match=r"nowhere.toml.*cannot be read"):
        load_part(tmp_path / "nowhere.toml")
