"""The command gearmesh: the library's numbers in words, in JSON and in a picture."""

import json

import numpy as np
import pytest

from thrustwasher import GearMeshParams, solve_gearmesh
from thrustwasher.cli import main
from thrustwasher.models.gearmesh_params import PRESETS
from thrustwasher.report.gearmesh_plot import gearmesh_figure
from thrustwasher.report.gearmesh_plot import over_teeth as sweep

POINT = ["--power", "7500", "--speed", "180"]
FIELDS = {"contact_stress", "hertz_width", "film_thickness", "film_ratio", "surface_temperature",
          "film_temperature", "asperity_temperature", "flash_rise", "thermal_stress",
          "modification_factor", "allowable_ratio", "friction_coefficient", "start_of_contact",
          "sliding_speed", "status", "power", "speed", "oil_temperature", "preset",
          "wall_time"}  # fmt: skip


def run_json(words, capsys):
    assert main(["gearmesh", *words, "--json"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    return json.loads(out)


def refusal(words, capsys):
    assert main(["gearmesh", *words]) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and "Traceback" not in err
    return err


def test_json_has_every_field_and_input_in_full_precision(capsys):
    record = run_json(POINT, capsys)
    assert set(record) >= FIELDS
    result = solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0)
    for name in ("asperity_temperature", "film_thickness", "modification_factor_aisi1020"):
        assert record[name] == getattr(result, name)
    assert (record["status"], record["preset"]) == ("OK", "bounded")
    assert (record["power"], record["speed"], record["oil_temperature"]) == (7500.0, 180.0, 299.85)


def test_units_presets_and_settings_reach_the_model(capsys):
    words = ["--power", "7.5 kW", "--speed", "1718.873 rpm", "--oil-temperature", "60 degC",
             "--preset", "literal", "--set", "pinion_teeth=30", "--set", "steel=AISI1020",
             "--set", "face_width=40 mm"]  # fmt: skip
    record = run_json(words, capsys)
    assert record["speed"] == pytest.approx(180.0, abs=1e-3)
    assert record["oil_temperature"] == pytest.approx(333.15)
    parameters = record["parameters"]
    assert (parameters["area_law"], parameters["pinion_teeth"]) == ("constant", 30)
    assert parameters["face_width"] == pytest.approx(0.04)
    assert record["modification_factor"] == record["modification_factor_aisi1020"]


@pytest.mark.parametrize("preset", PRESETS)
def test_every_preset_answers(preset, capsys):
    record = run_json([*POINT, "--preset", preset], capsys)
    expected = solve_gearmesh(GearMeshParams.preset(preset), power=7500.0, speed=180.0)
    assert record["asperity_temperature"] == expected.asperity_temperature


def test_table_speaks_to_a_gear_engineer(capsys):
    assert main(["gearmesh", *POINT]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    lines = {line.split()[0]: line for line in out.splitlines()}
    assert "27.308 °C" in lines["surface_temperature"] and "°C" in lines["asperity_temperature"]
    assert "233.32 MPa" in lines["contact_stress"] and "MPa" in lines["thermal_stress"]
    assert "°C" not in lines["flash_rise"] and " K " in lines["flash_rise"]
    steels = [line for line in out.splitlines() if line.startswith("  AISI")]
    assert [line.split()[1] for line in steels] == ["1020", "4340"]
    assert "these gears" in steels[1] and "these gears" not in steels[0]
    result = solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0)
    shown = [float(text) for text in steels[0].split()[2:5]]
    assert shown == pytest.approx(
        [result.modification_factor_aisi1020, result.allowable_ratio_aisi1020,
         result.stress_utilization_aisi1020], rel=1e-4,
    )  # fmt: skip


def test_bare_call_is_the_papers_case(capsys):
    assert main(["gearmesh"]) == 0
    out = capsys.readouterr().out
    assert "20 teeth, ratio 2, at power 7.5 kW, speed 180 rad/s, oil_temperature 26.7 °C" in out


def test_the_closed_rung_can_be_asked_for(capsys):
    assert run_json([*POINT, "--fidelity", "closed"], capsys)["fidelity"] == "closed"


def test_interference_is_refused_with_the_least_number_of_teeth(capsys):
    line = refusal([*POINT, "--set", "pinion_teeth=14"], capsys)
    assert "pinion_teeth = 14" in line and "15 and more" in line


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--power", "much"], ["power", "'much'", "W"]),
        (["--power", "1e12"], ["power", "W"]),
        (["--speed", "0"], ["speed", "0", "rad/s"]),
        (["--preset", "rosy"], ["preset", "rosy", "literal"]),
        (["--set", "f0=0.01"], ["f0", "0.01"]),
        (["--set", "surfac=fine"], ["surfac", "surface?"]),
        (["--plot", "x.gif"], ["--plot", ".png"]),
    ],
)
def test_wrong_input_is_one_line_that_names_it(words, named, capsys):
    line = refusal(words, capsys)
    assert [text for text in named if text not in line] == []


@pytest.mark.parametrize("preset", PRESETS)
def test_plot_is_written_with_both_surfaces(preset, tmp_path, capsys):
    target = tmp_path / "mesh.svg"
    assert main(["gearmesh", *POINT, "--preset", preset, "--plot", str(target)]) == 0
    assert "<svg" in target.read_text("utf-8")
    assert str(target) in capsys.readouterr().err


def test_the_sweep_begins_at_the_least_number_of_teeth_and_marks_what_is_refused():
    point = {"power": 7500.0, "speed": 180.0, "oil_temperature": 299.85}
    teeth, sweeps = sweep(GearMeshParams(gear_ratio=5.0), point, "field")
    assert (teeth[0], teeth[-1]) == (16, 60)
    assert all(r is not None for row in sweeps.values() for r in row)
    many = GearMeshParams(gear_ratio=5.0, pinion_teeth=80)
    teeth, sweeps = sweep(many, point, "field")
    assert teeth[-1] == 80
    at_20 = sweeps["rough"][teeth.index(20)]
    alone = solve_gearmesh(GearMeshParams(gear_ratio=5.0), **point)
    assert at_20.asperity_temperature == alone.asperity_temperature


def test_the_plot_draws_temperatures_and_both_steels():
    point = {"power": 7500.0, "speed": 180.0, "oil_temperature": 299.85}
    params = GearMeshParams(gear_ratio=5.0)
    teeth, sweeps = sweep(params, point, "field")
    figure = gearmesh_figure(teeth, sweeps, solve_gearmesh(params, **point), 20, point)
    labels = [text for axes in figure.axes for text in axes.get_legend_handles_labels()[1]]
    for words in ("surface $T_s$", "asperities, rough ground", "asperities, fine ground",
                  "AISI 1020, rough ground", "AISI 4340, fine ground"):  # fmt: skip
        assert words in labels
    rough = next(line for line in figure.axes[0].lines if "rough" in str(line.get_label()))
    expected = [r.asperity_temperature - 273.15 for r in sweeps["rough"]]
    factors = figure.axes[2]
    shown = {text.get_text() for text in factors.get_legend().get_texts()}
    drawn = [line for line in factors.lines if np.any(np.isfinite(line.get_ydata()))]
    assert shown == {line.get_label() for line in drawn if "AISI" in line.get_label()}
    assert "AISI 4340, rough ground" in shown
    assert list(rough.get_ydata()) == pytest.approx(expected)
    assert "kW" in figure.get_suptitle() and "°C" in figure.get_suptitle()


def test_flanks_of_ones_own_are_drawn_beside_the_two_ground_surfaces():
    point = {"power": 7500.0, "speed": 180.0, "oil_temperature": 299.85}
    own = GearMeshParams(gear_ratio=5.0, sigma_rms=1.2e-6, effective_roughness=3e-5)
    teeth, sweeps = sweep(own, point, "field")
    assert list(sweeps) == ["rough", "fine", "given"]
    at_20 = {name: row[teeth.index(20)].asperity_temperature for name, row in sweeps.items()}
    assert at_20["rough"] > at_20["given"] > at_20["fine"]
    assert at_20["given"] == solve_gearmesh(own, **point).asperity_temperature
    plain = sweep(GearMeshParams(gear_ratio=5.0), point, "field")[1]
    assert list(plain) == ["rough", "fine"]
    assert plain["rough"] == sweeps["rough"]


def test_the_plot_can_be_drawn_of_a_mesh_without_load(tmp_path):
    target = tmp_path / "idle.png"
    assert main(["gearmesh", "--power", "0", "--speed", "0", "--plot", str(target)]) == 0
    assert target.read_bytes()[:4] == b"\x89PNG"


def test_help_says_what_each_preset_changes(capsys):
    assert main(["gearmesh", "--help"]) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert "[W]; -1e+09 .. 1e+09 W, default 7500" in text
    assert "bounded: the defaults; literal: face_width = 1.0, viscosity_at = inlet" in text
