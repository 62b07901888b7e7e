"""The commands of models: same numbers as the library, in JSON, tables, CSV and pictures."""

import csv
import json

import numpy as np
import pytest
from curves import traced

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    WasherParams,
    solve_clutch,
    solve_gearmesh,
    solve_washer,
)
from thrustwasher.cli import engage, main
from thrustwasher.gearmesh.parameters import SPEC as MESH_SPEC
from thrustwasher.model.part_file import preset_parts

WASHER = {"load": 300.0, "speed": 953.0, "tilt": 0.002}
PACK = {"load": 9000.0, "speed": -2.0}
MESH = {"power": 7500.0, "speed": 180.0}
SOLVED = {
    "washer": (WASHER, {}, solve_washer, WasherParams),
    "clutch": (PACK, {"faces": 4}, solve_clutch, ClutchParams),
    "gearmesh": (MESH, {}, solve_gearmesh, GearMeshParams),
}
ENGAGE = ["engage", "--load", "5898", "--speed", "350", "--duration", "60 ms", "--ramp", "20 ms"]


def words_of(command, point=(), settings=()):
    given = [text for name, value in dict(point).items() for text in (f"--{name}", f"{value!r}")]
    sets = [text for name, value in dict(settings).items() for text in ("--set", f"{name}={value}")]
    return [command, *given, *sets]


def told(words, capsys):
    """Return the JSON object that a command prints; its warnings are all that stderr has."""
    assert main([*words, "--json"]) == 0
    out, err = capsys.readouterr()
    record = json.loads(out)
    assert err.splitlines() == [f"warning: {text}" for text in record["warnings"]]
    return record


def shown(words, capsys):
    """Return what a command prints for a person."""
    assert main(words) == 0
    out, err = capsys.readouterr()
    assert all(line.startswith("warning: ") for line in err.splitlines())
    return out


@pytest.mark.parametrize("command", SOLVED)
def test_json_has_every_result_and_input_in_full_precision(command, capsys):
    point, settings, solve, params = SOLVED[command]
    record = told(words_of(command, point, settings), capsys)
    result = solve(params(**settings), **point)
    for name in result.__dataclass_fields__:
        if isinstance(getattr(result, name), float | str) and not name.startswith("_"):
            assert record[name] == getattr(result, name), name
    assert {name: record[name] for name in point} == point
    assert settings.items() <= record["parameters"].items()
    assert record["status"] == result.status.name and record["wall_time"] > 0.0
    assert record["oil_temperature"] > 273.0


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("washer", ["friction_torque", " N·m ", " °C ", "branch", "grid 10x32"]),
        ("clutch", ["friction pack\n  load ", "5 kN", "input, default: ", "shear_ratio", "field,"]),
        ("gearmesh", ["20 teeth, ratio 2\n  power ", " 7.5 kW ", "180 rad/s (1718.9 rpm)"]),
    ],
)
def test_a_bare_call_answers_with_a_table_for_a_person(command, words, capsys):
    out = shown([command], capsys)
    assert [w for w in words if w not in out] == []


def test_inputs_stand_first_with_where_they_come_from(tmp_path, capsys):
    part = tmp_path / "mine.toml"
    part.write_text('model = "washer"\nname = "Mine"\n[box]\ntilt = "1.5 mrad"\n', "utf-8")
    lines = shown(["washer", "--part", str(part), "--load", "200"], capsys).splitlines()
    assert lines[0] == "thrust washer: Mine"
    told = [
        (line.split()[0], line.partition("input, ")[2].partition(":")[0]) for line in lines[1:6]
    ]
    assert told == [
        ("load", "given"),
        ("speed", "default"),
        ("tilt", "from the part's [box]"),
        ("oil_temperature", "default"),
        ("friction_torque", ""),
    ]


def test_faces_are_not_parallel_by_default_as_these_would_run_dry(capsys):
    point = ["washer", "--load", "300", "--speed", "953"]
    tilted = told(point, capsys)
    assert tilted["tilt"] == 2e-3 and tilted["contact_load"] == 0.0 and not tilted["warnings"]
    parallel = told([*point, "--tilt", "0"], capsys)
    assert parallel["contact_load"] == pytest.approx(300.0)
    assert parallel["friction_torque"] > 5.0 * tilted["friction_torque"]
    assert "parallel faces build no pressure" in parallel["warnings"][0]


def test_a_train_is_shown_with_the_names_of_its_file(capsys):
    assert main(["train", "--preset", "ev-reducer"]) == 0
    out = capsys.readouterr().out
    assert "\n  second.pitting_safety " in out and "\n  rotor.bearing_1_life " in out
    assert "mesh_1" not in out and "no such" not in out


def test_units_grids_and_settings_reach_the_model(capsys):
    words = "washer --load 0.3kN --speed 9100.479rpm --tilt 2mrad --oil-temperature 40degC"
    record = told(f"{words} --set roughness=0.4um --grid 9x24".split(), capsys)
    assert record["speed"] == pytest.approx(953.0, abs=1e-3)
    assert record["oil_temperature"] == pytest.approx(313.15)
    assert record["parameters"]["roughness"] == pytest.approx(4e-7)
    assert record["grid"] == [9, 24]


@pytest.mark.parametrize("preset", preset_parts(MESH_SPEC))
def test_settings_change_a_preset(preset, capsys):
    words = [*words_of("gearmesh", MESH), "--preset", preset, "--set", "steel=AISI1020"]
    record = told([*words, "--set", "pinion_teeth=30", "--fidelity", "fine"], capsys)
    params = GearMeshParams.preset(preset, steel="AISI1020", pinion_teeth=30)
    expected = solve_gearmesh(params, **MESH, fidelity="fine")
    assert record["asperity_temperature"] == expected.asperity_temperature
    assert record["modification_factor"] == record["modification_factor_aisi1020"]
    assert (record["preset"], record["fidelity"]) == (preset, "fine")


def test_the_table_of_a_mesh_sets_both_steels_side_by_side(capsys):
    out = shown([*words_of("gearmesh", MESH), "--preset", "paper"], capsys)
    lines = {line.split()[0]: line for line in out.splitlines()}
    assert "27.308 °C" in lines["surface_temperature"] and "233.32 MPa" in lines["contact_stress"]
    assert "°C" not in lines["flash_rise"] and " K " in lines["flash_rise"]
    steels = [line for line in out.splitlines() if line.startswith("  AISI")]
    assert [line.split()[1] for line in steels] == ["1020", "4340"]
    assert "these gears" in steels[1] and "these gears" not in steels[0]


@pytest.mark.parametrize(
    "words",
    [
        "washer",
        "clutch",
        pytest.param("clutch --set friction_law=constant", marks=pytest.mark.slow),
        pytest.param("gearmesh --power 0 --speed 0", marks=pytest.mark.slow),
    ],
)
def test_a_picture_is_drawn_and_named(words, tmp_path, capsys):
    target = tmp_path / "shown.svg"
    assert main([*words.split(), "--plot", str(target)]) == 0
    assert "<svg" in target.read_text("utf-8")
    assert f"wrote {target}" in capsys.readouterr().err


def test_curve_json_names_branches_and_folds(capsys):
    record = told(["curve", "--speed", "545", "--tilt", "0.002"], capsys)
    assert [fold["kind"] for fold in record["folds"]] == ["film_lost", "film_regained"]
    assert {point["branch"] for point in record["points"]} == {"film", "unstable", "contact"}
    curve = traced()
    assert record["folds"][0]["load"] == curve.folds[0].load
    assert len(record["points"]) == len(curve.points)


def test_curve_ranks_what_moves_its_folds(tmp_path, capsys):
    words = ["curve", "--speed", "545", "--tilt", "0.002", "--grid", "9x20", "--sensitivities"]
    record = told(words, capsys)
    slopes, changes = record["fold_sensitivities"], record["change_per_percent"]
    assert list(changes) == ["film_lost_load", "film_regained_load"] and len(slopes) == 2
    for row, change in zip(slopes, changes.values(), strict=True):
        assert change["outer_radius"] == pytest.approx(0.01 * 0.0227 * row["outer_radius"])
        assert abs(next(iter(change.values()))) == max(map(abs, change.values()))
    assert main([*words, "--plot", str(tmp_path / "ranking.png")]) == 0
    assert (tmp_path / "ranking.png").exists()


def test_curve_table_and_picture(tmp_path, capsys):
    table, picture = tmp_path / "curve.csv", tmp_path / "curve.png"
    words = ["curve", "--speed", "545", "--out", str(table), "--plot", str(picture)]
    assert main(words) == 0
    assert "film lost at" in capsys.readouterr().out
    with table.open(encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    assert rows[0][0] == "load [N]"
    thickness = [float(row[2]) for row in rows[1:]]
    assert thickness == sorted(thickness, reverse=True)
    assert picture.read_bytes()[:4] == b"\x89PNG"


def test_a_curve_without_fold_says_so(capsys):
    assert "no fold" in shown(["curve", "--speed", "136", "--tilt", "0.002"], capsys)


def test_an_engagement_has_every_point_and_the_inputs(capsys):
    found = told(ENGAGE, capsys)
    assert len(found["time"]) == 61 and found["time"][-1] == pytest.approx(0.06)
    assert found["load"][0] == 0.0 and found["load"][20] == pytest.approx(5898.0)
    assert found["speed"][-1] == 0.0 == found["friction_torque"][-1]
    assert found["status"] == "OK" and found["oil_temperature"] == 297.15
    assert set(engage.COLUMNS) <= set(found) and found["wall_time"] > 0.0


def test_an_engagement_is_a_table_and_a_summary(capsys):
    text = shown(ENGAGE, capsys)
    assert "largest torque" in text and "N·m" in text and "mixed" in text


def test_a_ramp_that_does_not_end_is_a_warning(capsys):
    assert main(["engage", "--load", "6 kN", "--ramp", "1 s", "--duration", "0.5 s"]) == 0
    assert "the load ends at 3 kN of 6 kN" in capsys.readouterr().err
    assert main(["engage", "--load", "6 kN", "--ramp", "0.5 s", "--duration", "0.5 s"]) == 0
    assert "ramp" not in capsys.readouterr().err


def test_an_engagement_is_written_whole(tmp_path):
    table, picture = tmp_path / "e.csv", tmp_path / "e.png"
    assert main([*ENGAGE, "--out", str(table), "--plot", str(picture)]) == 0
    rows = list(csv.reader(table.read_text("utf-8").splitlines()))
    assert rows[0][:3] == ["time [s]", "load [N]", "speed [rad/s]"] and len(rows) == 62
    assert np.isfinite([float(v) for v in rows[-1][:-1]]).all()
    assert picture.stat().st_size > 10_000
    assert sorted(p.name for p in tmp_path.iterdir()) == ["e.csv", "e.png"]


@pytest.mark.parametrize("command", SOLVED)
@pytest.mark.slow
def test_sensitivities_rank_parameters_by_what_one_percent_changes(command, tmp_path, capsys):
    point, settings, solve, params = SOLVED[command]
    words = words_of(command, point, settings)
    out = shown([*words, "--sensitivities", "friction_torque"], capsys)
    line = [x for x in out.splitlines() if x.startswith("  friction_torque  ")][-1]
    result = solve(params(**settings), **point)
    changes = result.sensitivities(["friction_torque"], per_percent=True)["friction_torque"]
    order = sorted(changes, key=lambda name: -abs(changes[name]))
    assert [part.split()[0] for part in line.removeprefix("  friction_torque").split(",")] == (
        order[:4]
    )
    picture = tmp_path / "ranking.svg"
    assert main([*words, "--sensitivities", "friction_torque", "--plot", str(picture)]) == 0
    assert order[0] in picture.read_text("utf-8")
    capsys.readouterr()
    record = told([*words, "--sensitivities"], capsys)
    assert record["change_per_percent"]["friction_torque"] == pytest.approx(changes, rel=1e-9)
    assert record["sensitivities"].keys() == result.sensitivities().keys()
