"""A part's box decides what is not given; what is doubtful is said before the figures."""

import csv
import json
import math

import numpy as np
import pytest

from thrustwasher import (
    ClutchParams,
    GearMeshParams,
    ParameterError,
    WasherParams,
    engage_clutch,
    load_curve,
    load_part,
    run_sweep,
    solve_clutch,
    solve_gearmesh,
    solve_washer,
)
from thrustwasher.cli import main
from thrustwasher.model.idle import kept_warnings
from thrustwasher.model.part_file import find_part, preset_parts
from thrustwasher.model.registry import find_spec, models_with_points
from thrustwasher.studio.calibration.run_calibration import calibrate
from thrustwasher.washer.kernels.regime_and_status import is_verified
from thrustwasher.washer.kernels.workspace import Point
from thrustwasher.washer.parameters import SPEC

BOXED = 'model = "washer"\nname = "W"\n[box]\nload = ["20 N", "600 N"]\ntilt = "1.5 mrad"\n'
BOXED += 'oil_temperature = "80 degC"\n'
FIXED = {"tilt": 1.5e-3, "oil_temperature": 353.15}
MESH = 'model = "gearmesh"\nname = "M"\n[box]\nload = ["-20 N.m", "20 N.m"]\nspeed = "100 rad/s"\n'


@pytest.fixture
def boxed(tmp_path):
    path = tmp_path / "boxed.toml"
    path.write_text(BOXED)
    return path


@pytest.fixture
def told(capsys):
    """Return what a command's JSON object holds, its warnings checked against standard error."""

    def run(*words):
        assert main([*map(str, words), "--json"]) == 0
        out, err = capsys.readouterr()
        record = json.loads(out)
        said = [line for line in err.splitlines() if line.startswith("warning: ")]
        assert said == [f"warning: {text}" for text in record["warnings"]]
        return record

    return run


def test_a_part_is_solved_inside_its_box_on_the_command_line_and_in_python(boxed, told):
    part = load_part(boxed)
    expected = solve_washer(WasherParams(), load=300.0, speed=300.0, **FIXED)
    record = told("washer", "--part", boxed, "--speed", "300")
    assert record["friction_torque"] == expected.friction_torque
    assert record["taken"] == {"box": FIXED, "default": {"load": 300.0}}
    assert part.solve(speed=300.0).friction_torque == expected.friction_torque
    far = {"far_face_temperature": 0.0}
    assert part.starts == {"load": 300.0, "speed": 545.0, **FIXED, **far}
    plain = solve_washer(WasherParams(), load=300.0, speed=300.0, tilt=2e-3)
    assert (plain.branch, expected.branch) == ("film", "contact")  # the box decides the branch


def test_the_text_names_what_was_taken(boxed, capsys):
    assert main(["washer", "--part", str(boxed), "--load", "100"]) == 0
    lines = [line.split(":")[0].split() for line in capsys.readouterr().out.splitlines()[1:5]]
    assert [" ".join(words) for words in lines] == [
        "load 100 N input, given",
        "speed 545 rad/s (5204.4 rpm) input, default",
        "tilt 1.5 mrad input, from the part's [box]",
        "oil_temperature 80 °C input, from the part's [box]",
    ]


def test_a_far_face_counts_only_where_it_is_at_an_input(boxed, tmp_path, capsys):
    path = tmp_path / "far.toml"
    path.write_text(BOXED + 'far_face_temperature = "90 degC"\n')
    assert main(["washer", "--part", str(path)]) == 2
    assert "with gear_far_face = 'bulk' (here 'oil')" in capsys.readouterr().err
    over = {"load": [200.0, 300.0]}
    with pytest.raises(ParameterError, match="with gear_far_face = 'bulk'"):
        run_sweep(load_part(path), over)
    both = run_sweep(load_part(path), {**over, "gear_far_face": ["oil", "bulk"]})
    assert any("with gear_far_face = 'bulk' (here 'oil')" in text for text in both.warnings)
    path.write_text(path.read_text() + '[parameters]\ngear_far_face = "bulk"\n')
    assert main(["washer", "--part", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert any(line.split()[:3] == ["far_face_temperature", "90", "°C"] for line in lines)


def test_a_curve_needs_no_option_that_the_box_fixes(boxed, told):
    record = told("curve", "--part", boxed, "--speed", "953")
    curve = load_curve(WasherParams(), speed=953.0, **FIXED)
    assert [fold["load"] for fold in record["folds"]] == [fold.load for fold in curve.folds]
    assert record["taken"]["box"] == FIXED


def test_a_sweep_of_a_part_and_one_at_its_box_are_the_same(boxed, tmp_path, capsys):
    out = tmp_path / "rows.csv"
    assert main(["sweep", str(boxed), "--over", "load=300,700", "--out", str(out)]) == 0
    notes = capsys.readouterr().err
    assert "taken from the part's box: tilt = 1.5 mrad" in notes
    assert "warning: 1 of 2 points, as load = 700 N, are outside 20 N .. 600 N" in notes
    with out.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    plain = run_sweep("washer", {"load": [300.0, 700.0]}, at=FIXED)
    assert [float(row["friction_torque [N.m]"]) for row in rows] == [*plain["friction_torque"]]
    of_part = run_sweep(load_part(boxed), {"load": [300.0, 700.0]})
    assert np.array_equal(of_part["friction_torque"], plain["friction_torque"])


def test_a_calibration_takes_the_box_for_what_has_no_column(tmp_path):
    path = tmp_path / "mesh.toml"
    path.write_text(MESH + '[parameters]\nfriction_law = "constant"\n')
    truth = GearMeshParams(friction_law="constant", constant_friction=0.06)
    torque = [5.0, 10.0]
    loss = [solve_gearmesh(truth, power=100.0 * t, speed=100.0).friction_torque for t in torque]
    data = {"load": torque, "friction_torque": loss}
    found = calibrate(load_part(path), data, fit=["constant_friction"])
    assert found.params.constant_friction == pytest.approx(0.06, rel=1e-6)
    short = {name: column[:1] for name, column in data.items()}
    exact = calibrate(load_part(path), short, fit=["constant_friction"])
    assert any("as many values as parameters" in text for text in exact.warnings)


def test_the_power_of_a_mesh_is_that_of_the_torque_in_its_box(tmp_path, told):
    path = tmp_path / "mesh.toml"
    path.write_text(MESH)
    part = load_part(path)
    assert part.starts["load"] == 20.0 and part.starts["speed"] == 100.0
    record = told("gearmesh", "--part", path)
    assert record["power"] == record["taken"]["box"]["power"] == 2000.0
    assert part.solve(load=15.0) == part.solve(power=1500.0)
    assert "load = 30 N·m is outside" in part.solve(power=3000.0).warnings[0]
    with pytest.raises(ParameterError, match="allowed: one of both"):
        part.solve(load=15.0, power=1500.0)


def test_a_point_outside_the_box_is_solved_with_a_warning_first(boxed, told):
    record = told("washer", "--part", boxed, "--load", "700")
    assert record["warnings"][0].startswith("load = 700 N is outside 20 N .. 600 N, the part's box")
    assert load_part(boxed).solve(load=700.0).warnings == tuple(record["warnings"])


WASHER, MESH_15 = (solve_washer, WasherParams()), {"power": 15e3, "speed": 180.0}
TILTED, HOT_OIL = {"tilt": 2e-3}, {"power": 7500.0, "speed": 180.0, "oil_temperature": 470.0}
LIMITED = GearMeshParams(permissible_film_ratio=5.0)
LONG = {"time": [0.0, 60.0], "load": 9e3, "speed": 100.0}
DOUBTFUL = [
    (solve_clutch, ClutchParams(), {"load": 9e3, "speed": 5.0}, "temperature = "),
    (*WASHER, {"load": 3e3, "speed": 1400.0, **TILTED}, "temperature_max = "),
    (*WASHER, {"load": 5e3, "speed": 1400.0, **TILTED}, "film_thickness = -"),
    (*WASHER, {"load": 1.3e3, "speed": 545.0, **TILTED}, "film_ratio = "),
    (*WASHER, {"load": 300.0, "speed": 1900.0, **TILTED}, "is outside -1500 rad/s .. 1500 rad/s"),
    (*WASHER, {"load": 1.0, "speed": 953.0, **TILTED}, "stick_margin = "),
    (load_curve, WasherParams(), {"speed": 545.0, **TILTED}, "temperature_max = "),
    (solve_gearmesh, GearMeshParams.preset("planet"), MESH_15, "pitting_safety = "),
    (solve_gearmesh, LIMITED, MESH_15, "micropitting_safety = "),
    (solve_gearmesh, GearMeshParams(), HOT_OIL, "oil_temperature = 196.9 °C is outside"),
    (engage_clutch, ClutchParams(), LONG, "temperature = "),
]


@pytest.mark.parametrize(("solve", "params", "point", "words"), DOUBTFUL)
def test_a_doubtful_result_says_so(solve, params, point, words):
    warnings = solve(params, **point).warnings
    assert isinstance(warnings, tuple) and any(words in text for text in warnings)
    assert all("\n" not in text for text in warnings)


FAST, SLOW = {"speed": 1400.0}, {"speed": 0.1, "contact_modulus": 3e5}
HOT = {"speed": 545.0, "oil_temperature": 353.15}
ROWS = [
    ("washer", [700.0, 1500.0], HOT, "2 of 2 points, at worst temperature_max = "),
    ("washer", [20.0, 100.0], FAST, "1 of 2 points, at worst stick_margin = "),
    ("washer", [100.0, 5e3], FAST, "1 of 2 points, at worst film_thickness = -"),
    ("clutch", [10.0, 1e5], SLOW, "1 of 2 points, at worst film_ratio = -"),
    ("gearmesh", [100.0, 5e3, 9e3], {"speed": 180.0}, "2 of 3 points, at worst scuffing_safety = "),
]


@pytest.mark.parametrize(("model", "loads", "at", "words"), ROWS)
def test_a_sweep_says_what_is_beyond_a_bound_in_its_rows(tmp_path, model, loads, at, words):
    table = run_sweep(model, {"load": loads}, at=at)
    assert any(text.startswith(words) for text in table.warnings)
    to_file = run_sweep(model, {"load": loads}, at=at, out=tmp_path / "rows.csv", keep=False)
    assert to_file.warnings == table.warnings


def test_pieces_of_a_table_are_counted_together(monkeypatch, tmp_path):
    monkeypatch.setattr("thrustwasher.studio.sweep.sweep_table.CHUNK", 1)
    over, at = {"load": [700.0, 1500.0], "tilt": [2e-3, 1e-3]}, {"oil_temperature": 353.15}
    table = run_sweep("washer", over, at=at)
    to_file = run_sweep("washer", over, at=at, out=tmp_path / "rows.csv", keep=False)
    assert to_file.warnings == table.warnings != ()


@pytest.mark.parametrize("model", models_with_points())
def test_defaults_and_presets_have_no_warning_at_their_own_points(model):
    """But that a mesh which hardly bears, or a bearing in mixed friction, is not as its law."""
    known = ("load F_bt/b", "viscosity ratio kappa")
    parts = {"default": find_part(model), **preset_parts(find_part(model).spec)}
    for name, part in parts.items():
        said = [x for x in part.solve().warnings if not any(words in x for words in known)]
        assert said == [], name


def test_the_other_branch_between_the_folds_is_named(told):
    (text,) = told("washer", "--load", "800")["warnings"]
    assert "lies between two folds" in text and "'contact'" in text
    assert told("washer", "--load", "800", "--branch", "film")["warnings"] == []
    assert told("washer", "--load", "300")["warnings"] == []


def test_verified_ranges_are_those_of_the_kernel():
    ranges = [signal.verified for signal in SPEC.inputs[:4]]
    assert is_verified(Point(*(high for _, high in ranges), 0.0))
    assert is_verified(Point(0.0, ranges[1][0], 0.0, ranges[3][0], 0.0))
    for i, (_, high) in enumerate(ranges):
        beyond = [300.0, 545.0, 2e-3, 297.15]
        beyond[i] = high * 1.001
        assert not is_verified(Point(*beyond, 0.0))


def test_a_part_says_what_it_keeps_of_another_size(tmp_path):
    def said(model, text, preset=""):
        start = find_part(model) if not preset else preset_parts(find_part(model).spec)[preset]
        return kept_warnings(
            type(start)(
                spec=start.spec,
                name="X",
                fidelity=start.fidelity,
                parameters={**start.parameters, **text},
            )
        )

    larger = said("washer", {"outer_radius": 0.03})
    assert any(
        "gear_inner_radius = 15.6 mm is still that of the default" in line for line in larger
    )
    (beside,) = said("washer", {"roughness": 3e-7}, "bronze")
    assert beside.startswith("roughness_washer = 0.8 µm stands in place of roughness = 0.3 µm")
    assert "oil_flow" in said("clutch", {"faces": 8})[0]
    assert said("washer", {}) == said("washer", {}, "bronze") == ()


def test_speeds_that_are_probably_in_rpm_are_doubted(told):
    text = told("gearmesh", "--speed", "1800")["warnings"][0]
    assert "did you mean 188.496 rad/s (1800 rpm)?" in text
    as_typed = told("gearmesh", "--speed", "1800 rad/s")["warnings"]
    assert not any("did you mean" in text for text in as_typed)


def test_the_scenes_are_listed_with_their_titles(capsys):
    assert main(["shift", "--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert any(line.split()[:2] == ["planetary-cold", "Upshift"] for line in lines)


# A point that cannot be solved is refused by name, in one line, with what is allowed.

CALLS = {
    "washer": (solve_washer, WasherParams(), {"load": 300.0, "speed": 545.0, "tilt": 2e-3}),
    "curve": (load_curve, WasherParams(), {"speed": 545.0, "tilt": 2e-3}),
    "clutch": (solve_clutch, ClutchParams(), {"load": 5e3, "speed": 40.0}),
    "gearmesh": (solve_gearmesh, GearMeshParams(), {"power": 7500.0, "speed": 180.0}),
}
NO_NUMBERS = (math.nan, math.inf, "much")


def rows():
    for call, (_, _, point) in CALLS.items():
        spec = find_spec("washer" if call == "curve" else call)
        ranges = {s.name: (s.low, s.high) for s in spec.inputs} | {"power": (-1e9, 1e9)}
        for name in (*point, "oil_temperature"):
            low, high = ranges[name]
            for value in (*NO_NUMBERS, low - 1e-3, 1.01 * high):
                yield call, name, value
        yield call, "fidelity", "best"


@pytest.mark.parametrize(("call", "name", "value"), rows())
def test_a_wrong_value_is_named_with_what_is_allowed(call, name, value):
    solve, params, point = CALLS[call]
    with pytest.raises(ParameterError) as refused:
        solve(params, **{**point, name: value})
    message = str(refused.value)
    assert message.startswith(f"{name} = {value!r}")
    assert ("a number in" if value == "much" else "allowed: ") in message
    assert "\n" not in message


WRONG = [
    ("washer", {"load": 0.0}, "load = 0.0 N, allowed: 1 .. 200000 N"),
    ("washer", {"grid": (1, 32)}, r"grid = \(1, 32\) .*, allowed: .* 5 x 8"),
    ("washer", {"grid": (10.5, 32)}, r"grid = \(10.5, 32\)"),
    ("washer", {"grid": 10}, "grid = 10"),
    ("washer", {"grid": (10, 32, 4)}, "grid = "),
    ("washer", {"grid": (1000, 32)}, r"grid = \(1000, 32\) .*, allowed: .*129"),
    ("washer", {"branch": "middle"}, "branch = 'middle', allowed: 'film' or 'contact'"),
    ("curve", {"load_min": 0.0}, "load_min"),
    ("curve", {"load_min": 500.0, "load_max": 400.0}, "load_max"),
    ("gearmesh", {"power": 1.0, "speed": 0.0}, "speed = 0.0 rad/s, allowed: from 1e-07"),
    ("gearmesh", {"power": 1e9, "speed": 1.0}, "speed = 1.0 rad/s, allowed: from 100 "),
]


@pytest.mark.parametrize(("call", "change", "message"), WRONG)
def test_what_only_one_function_takes_is_named_too(call, change, message):
    solve, params, point = CALLS[call]
    with pytest.raises(ParameterError, match=message):
        solve(params, **{**point, **change})
