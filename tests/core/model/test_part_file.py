"""Part files: what is written is read back to the bit; what is wrong is named."""

import numpy as np
import pytest

from thrustwasher import (
    ClutchParams,
    ParameterError,
    WasherParams,
    engage_clutch,
    follow_washer,
    load_part,
    optimise,
    propagate,
    solve_clutch,
    solve_washer,
)
from thrustwasher.cli import main
from thrustwasher.face_load import FACE_LOADS, LIMITED
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


# What tables of linings and bushings limit: the figures, their limits in parts, and warnings.

PACK = """model = "clutch"
name = "Pack"
[limits]
face_pressure = "0.2 MPa"
power_per_area = "0.5 MW/m2"
energy_per_area = "0.1 MJ/m2"
[scatter]
friction_scale = "5 %"
"""


def part(folder, text=PACK):
    (folder / "pack.toml").write_text(text, "utf-8")
    return str(folder / "pack.toml")


def test_of_a_washer_they_are_of_its_one_face():
    params = WasherParams()
    found = solve_washer(params, load=300.0, speed=-953.0, tilt=0.002)
    area = np.pi * (params.outer_radius**2 - params.inner_radius**2)
    assert found.face_pressure == pytest.approx(300.0 / area)
    assert params.inner_radius < found.sliding_speed / 953.0 < params.outer_radius
    assert found.pressure_velocity == found.face_pressure * found.sliding_speed
    assert found.power_per_area == pytest.approx(found.friction_power / area)


def test_of_a_pack_each_face_bears_the_whole_load_and_heat_is_shared():
    """Power over area is pressure times sliding times friction, whatever the number of faces."""
    for faces in (2, 7):
        params = ClutchParams(faces=faces, friction_law="constant", friction_data="total")
        found = solve_clutch(params, load=3000.0, speed=30.0)
        assert found.face_pressure == pytest.approx(3000.0 * faces / params.lining_area)
        heat = found.friction_coefficient * found.pressure_velocity
        assert found.power_per_area == pytest.approx(heat, rel=0.02)
        assert {*FACE_LOADS} <= {*found.to_dict()}


def test_a_plate_that_has_worn_evenly_bears_its_permissible_pressure_at_the_bore():
    """A face of 75 mm x 150 mm at 0.3 MPa: F = 2 pi p r_i (r_o - r_i) = 2650.7 N."""
    plate = ClutchParams(inner_radius=0.0375, outer_radius=0.075, friction_law="constant")
    found = solve_clutch(plate, load=2650.7188, speed=1.0, fidelity="closed")
    assert found.face_pressure_max == pytest.approx(0.3e6, rel=1e-7)
    assert found.face_pressure == pytest.approx(0.2e6, rel=1e-7)


def test_over_time_they_are_columns_with_the_energy():
    time = np.linspace(0.0, 0.3, 31)
    found = engage_clutch(
        ClutchParams(), time=time, load=4000.0 * np.minimum(time / 0.1, 1.0), speed=100.0
    )
    np.testing.assert_allclose(found.energy_per_area, found.energy / ClutchParams().lining_area)
    np.testing.assert_allclose(found.power_per_area, found.heat_flux)
    assert {*LIMITED} <= {*found.to_pandas().columns}
    hot = WasherParams(thermal_mode="transient")
    profile = follow_washer(hot, time=[0.0, 0.5, 1.0], load=300.0, speed=545.0, tilt=0.002)
    assert profile.pressure_velocity[0] == profile.face_pressure[0] * profile.sliding_speed[0]
    assert profile.energy_per_area[-1] > 0.0


def test_limits_of_a_part_are_warnings_where_they_are_passed(tmp_path, capsys):
    pack = load_part(part(tmp_path))
    words = "face_pressure = 305.2 kPa, above the part's limit 200 kPa"
    assert any(words in text for text in pack.solve(load=3000.0, speed=30.0).warnings)
    assert not any("limit" in text for text in pack.solve(load=1000.0, speed=30.0).warnings)
    path = str(tmp_path / "pack.toml")
    assert main(["clutch", "--part", path, "--load", "3000", "--speed", "30"]) == 0
    assert words in capsys.readouterr().err
    assert main(["engage", "--part", path, "--load", "5000", "--speed", "200"]) == 0
    said = capsys.readouterr().err
    assert "energy_per_area = 0.1706 J/mm²" in said and "power_per_area" in said


def test_limits_are_written_and_read_back(tmp_path):
    pack = load_part(part(tmp_path))
    again = load_part(part(tmp_path, part_text(pack)))
    assert (
        again.limits
        == pack.limits
        == {"face_pressure": 2e5, "power_per_area": 5e5, "energy_per_area": 1e5}
    )


@pytest.mark.parametrize(
    ("model", "limits", "words"),
    [
        ("washer", 'face_presure = "1 MPa"', "did you mean 'face_pressure'"),
        ("washer", 'face_pressure = "1 K"', "face_pressure"),
        ("washer", "face_pressure = -1.0", "allowed"),
        ("gearmesh", 'face_pressure = "1 MPa"', "no faces"),
    ],
)
def test_a_limit_that_is_none_is_refused(tmp_path, model, limits, words):
    with pytest.raises(ParameterError, match=words):
        load_part(part(tmp_path, f'model = "{model}"\nname = "A"\n[limits]\n{limits}\n'))


def test_studies_and_searches_have_them_as_figures(tmp_path):
    pack = load_part(part(tmp_path))
    found = propagate(pack, runs=16, indices=False, at={"load": 3000.0, "speed": 30.0})
    assert found.figures["face_pressure"].nominal == pytest.approx(305186.9, rel=1e-6)
    assert found.figures["face_pressure"].outside.value == 1.0  # above the part's limit
    low, _, high = found.figures["power_per_area"].quantiles.values()
    assert low < found.figures["power_per_area"].nominal < high
    best = optimise(
        pack,
        vary={"outer_radius": (0.08, 0.1)},
        minimise="friction_torque",
        limits=["face_pressure<=0.25 MPa"],
        at={"load": 3000.0, "speed": 30.0},
    )
    area = np.pi * (best.best.values["outer_radius"] ** 2 - ClutchParams().inner_radius ** 2)
    assert 3000.0 / area <= 2.5e5 * (1.0 + 1e-6)
