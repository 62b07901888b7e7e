"""An oil by its name or its data sheet: classes, laws, files, and what is refused."""

import json
import math
from itertools import pairwise
from pathlib import Path

import pytest

from thrustwasher import GearMeshParams, ParameterError, WasherParams, load_part, oil, run_sweep
from thrustwasher.cli import main
from thrustwasher.fmu.build import asked
from thrustwasher.model.oil import law_of, named_oils, too_stiff
from thrustwasher.model.oil_laws import FITTED, density, kinematic_viscosity, law_viscosity, walther
from thrustwasher.model.registry import find_model
from thrustwasher.shift import load_scene
from thrustwasher.studio.calibration.run_calibration import calibrate

ROOT = Path(__file__).parents[3]
SHEET = {"kinematic_viscosity_40": "46 cSt", "kinematic_viscosity_100": 6.8e-6, "density_15": 870}
J306 = {"75W": 3.8, "80W": 8.5, "80": (8.5, 11.0), "90": (13.5, 18.5), "140": (24.0, 32.5)}
J300 = {"0W": 3.8, "5W": 3.8, "10W": 4.1, "20": (6.9, 9.3), "30": (9.3, 12.5), "40": (12.5, 16.3)}
GM = {"Dexron III": (5.5, 10.0), "Dexron VI": (5.5, 6.4)}
MODELS = ("washer", "clutch", "gearmesh")


@pytest.mark.parametrize("name", named_oils())
def test_a_named_oil_lies_within_its_class(name):
    row = named_oils()[name]
    if row.standard == "ISO 3448":
        assert row.viscosity_40 == pytest.approx(float(name.split()[-1]), rel=0.1)
    elif row.standard in ("SAE J306", "SAE J300"):
        limits = J306 if row.standard == "SAE J306" else J300
        *winter, summer = name.removeprefix("SAE ").split("-")
        low, high = limits[summer]
        assert low <= row.viscosity_100 < high
        assert all(row.viscosity_100 >= limits[grade] for grade in winter)
    else:
        low, high = GM[row.standard]
        assert low <= row.viscosity_100 <= high
    assert 800.0 < row.density_15 < 950.0 and row.pour_point < 0.0


def test_the_sheets_viscosities_are_those_of_astm_d341_and_between_them_it_is_straight():
    found = oil(SHEET)
    for t, nu in ((313.15, 46e-6), (373.15, 6.8e-6)):
        rho = density(870.0, t)
        assert found.viscosity(t) == pytest.approx(nu * rho, rel=1e-12)
    nu = kinematic_viscosity(46e-6, 6.8e-6, math.sqrt(313.15 * 373.15))
    assert walther(nu) == pytest.approx(0.5 * (walther(46e-6) + walther(6.8e-6)), rel=1e-12)


@pytest.mark.parametrize("name", named_oils())
@pytest.mark.parametrize("key", MODELS)
def test_a_models_law_is_within_one_percent_and_errs_alike_at_four_temperatures(name, key):
    spec, found = find_model(key).spec, oil(name)
    spec.params(**found.parameters_for(key))  # within the parameters' ranges
    worst = found.worst_error(spec)
    assert worst < 0.01
    errors = [found.error(spec, FITTED[0] + i) for i in range(131)]
    turns = [e for e in errors if abs(e) > 0.98 * worst]
    signs = [math.copysign(1.0, e) for e in turns]
    assert 1 + sum(a != b for a, b in pairwise(signs)) >= 4
    law = law_of(spec)
    said = [getattr(spec.params(**found.parameters_for(key)), n) for n in law]
    assert law_viscosity(law, said, 353.15) == pytest.approx(found.viscosity(353.15), rel=worst)


def test_the_page_has_the_named_oils_with_the_largest_error_of_their_laws():
    text = (ROOT / "docs" / "oils.md").read_text("utf-8")
    washer, mesh = (find_model(key).spec for key in ("washer", "gearmesh"))
    for name, row in named_oils().items():
        numbers = " | ".join(f"{x:g}" for x in row[:4])
        assert f"| {name} | {numbers} | {row.standard}: " in text
    of_washer, of_mesh = (
        100.0 * max(oil(name).worst_error(spec) for name in named_oils()) for spec in (washer, mesh)
    )
    errors = f"at most {of_washer:.2f} % (washer, clutch) and {of_mesh:.2f} % (gear mesh)"
    assert errors in " ".join(text.split())


def test_a_name_sets_viscosity_and_density_and_no_more():
    given = oil("ISO VG 46").parameters_for("gearmesh")
    assert set(given) == {"oil_density", "viscosity_scale", "viscosity_b", "viscosity_c"}
    assert given["oil_density"] == pytest.approx(density(870.0, 313.15))
    assert set(oil("ISO VG 46").parameters_for("sump")) == {"oil_density"}
    assert oil(SHEET).parameters_for("washer") == oil("ISO VG 46").parameters_for("washer")


@pytest.mark.parametrize(
    "name", ["iso vg46", "ISOVG 46", "VG 46", "sae 75w90", "75W-90", "dexron-vi"]
)
def test_a_name_is_known_however_it_is_written(name):
    assert oil(name).name in ("ISO VG 46", "SAE 75W-90", "Dexron VI")


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("ISO VG 48", "did you mean 'ISO VG 46'"),
        ("46", "oil = '46', allowed: ISO VG 22"),
        (
            {"name": "ISO VG 46", "density_15": 870},
            "name together with density_15, allowed: one way",
        ),
        ({"name": "ISO VG 46", "density": 870}, "density together with name"),
        (
            {**SHEET, "viscosity": [[313.15, 0.04]]},
            "kinematic_viscosity_40 together with viscosity",
        ),
        ({"kinematic_viscosity_40": "46 cSt"}, "kinematic_viscosity_100 is missing"),
        ({**SHEET, "kinematic_viscosity_100": "60 cSt"}, "below that at 40 degC"),
        ({**SHEET, "density_15": 0.87}, "density_15 = 0.87 kg/m3, allowed: 500 .. 1500"),
        ({"heat_capacity": 2000.0}, "allowed: a name, or kinematic_viscosity_40"),
        (46, "oil = 46, allowed: a name"),
    ],
)
def test_what_is_no_oil_is_refused_in_one_line(given, said):
    with pytest.raises(ParameterError) as refused:
        oil(given)
    assert said in str(refused.value) and "\n" not in str(refused.value)


def test_oil_outside_of_its_laws_or_too_cold_to_flow_is_a_warning():
    spec = find_model("gearmesh").spec
    assert oil("Dexron VI").warnings([spec], 353.15) == []
    cold = oil("ISO VG 460").warnings([spec], 253.15)
    assert "does not flow below about -12 degC" in cold[0]
    assert "gearmesh +79 %" in cold[1]


def test_oil_that_is_all_but_solid_is_a_warning(capsys):
    assert main(["gearmesh", "--power", "5 kW", "--oil-temperature", "-20 degC", "--json"]) == 0
    stiff, thick, light = json.loads(capsys.readouterr().out)["warnings"]
    assert light.startswith("load F_bt/b = ")
    assert "the viscosity is 350 Pa.s by the law of the gearmesh" in stiff
    assert "no law of the film holds there" in thick
    assert too_stiff(find_model("gearmesh").spec, GearMeshParams(), 263.15) == []


def test_python_and_calibration_warn_of_the_oil_as_the_command_line_does(cold):
    part = load_part(cold)
    expected = {t.split(":")[0]: t for t in part.oil_warnings}
    assert list(expected) == ["oil_temperature = -30 degC"] and len(part.oil_warnings) == 3
    at = {"oil_temperature": 243.15, "speed": 200.0}
    table = run_sweep(part, {"load": [100.0]}, at=at)
    data = {"load": [100.0], **at, "friction_torque": [float(table["friction_torque"][0])]}
    fit = calibrate(part, data, fit=["viscosity_scale"])
    for warnings in (table.warnings, fit.warnings, part.solve(load=100.0, **at).warnings):
        assert set(part.oil_warnings) <= set(warnings)


def test_an_oil_that_is_changed_is_that_oil_no_more(cold, capsys):
    words = ["washer", "--part", str(cold), "--load", "100", "--oil-temperature", "20 degC"]
    assert main([*words, "--set", "viscosity_scale=1e-4", "--json"]) == 0
    out, err = capsys.readouterr()
    assert "oil" not in json.loads(out) and "ISO VG 460" not in err
    assert "viscosity_scale: given in addition to the oil of the part, which it is no more" in err


# Files, commands, scenes, FMUs


@pytest.fixture
def cold(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "cold.toml"
    path.write_text(
        'model = "washer"\nname = "Cold"\noil = "ISO VG 460"\n[box]\nload = ["50 N", "300 N"]\n'
        'speed = "200 rad/s"\ntilt = "2 mrad"\noil_temperature = "-30 degC"\n'
    )
    return path


@pytest.fixture
def mine(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["part", "new", "washer", "--oil", "iso vg 46", "--out", "mine.toml"]) == 0
    return tmp_path / "mine.toml"


def test_a_part_file_keeps_its_oil(mine, capsys):
    text = mine.read_text()
    parameters = text.partition("[scatter]")[0]
    assert 'oil = {name = "ISO VG 46"}' in parameters and "viscosity_scale =" not in parameters
    assert load_part(mine).params == WasherParams(**oil("ISO VG 46").parameters_for("washer"))
    capsys.readouterr()
    assert main(["part", "check", str(mine)]) == 0
    told = capsys.readouterr().out
    assert "typical values of the class ISO 3448 (estimates)" in told
    assert "washer 0.26 %" in told and "the part's own stay: oil_conductivity" in told
    assert main(["part", "check", str(mine), "--oil", "75W-90", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["oil"]["name"] == "SAE 75W-90"


def test_a_sheet_in_a_part_file_comes_back(mine, capsys):
    words = "kinematic_viscosity_40=46 mm2/s, kinematic_viscosity_100=6.8 cSt, density_15=870"
    assert main(["part", "new", "clutch", "--oil", words]) == 0
    assert 'kinematic_viscosity_100 = "6.8 mm2/s"' in (mine.parent / "clutch.toml").read_text()
    assert load_part("clutch.toml").oil == oil(SHEET)


def test_parameters_beside_an_oil_are_refused(mine, capsys):
    mine.write_text(
        'model = "washer"\nname = "A"\noil = "ISO VG 46"\n[parameters]\noil_density = 900\n'
    )
    with pytest.raises(ParameterError, match="oil together with oil_density, which it sets"):
        load_part(mine)
    for words in (["washer"], ["curve"], ["part", "new", "washer"], ["sweep", "washer"]):
        assert main([*words, "--oil", "ISO VG 46", "--set", "viscosity_scale=1e-4"]) == 2
        assert "--oil together with viscosity_scale" in capsys.readouterr().err


def test_a_command_solves_with_the_oil_and_says_so(mine, capsys):
    capsys.readouterr()
    point = ["gearmesh", "--power", "5 kW", "--json"]
    assert main([*point, "--oil", "ISO VG 100", "--oil-temperature", "-35 degC"]) == 0
    out, err = capsys.readouterr()
    told = json.loads(out)
    assert told["oil"]["worst_difference"]["gearmesh"] < 0.01
    assert (
        told["parameters"]["viscosity_b"]
        == oil("ISO VG 100").parameters_for("gearmesh")["viscosity_b"]
    )
    assert len(told["warnings"]) == 6 and all(f"warning: {w}\n" in err for w in told["warnings"])
    assert "the part's own stay: oil_conductivity, oil_heat_capacity; pressure_viscosity, " in err
    assert "unless given, by base oil and viscosity (ISO/TR 15144-1)" in err


def test_a_scenes_oil_is_replaced_as_a_whole():
    scene = load_scene("planetary", oil="Dexron VI")
    for key, model in (("washer", "washer"), ("clutch", "clutch"), ("mesh", "gearmesh")):
        own = oil("Dexron VI").parameters_for(model)
        assert {n: getattr(scene.parts[key].params, n) for n in own} == own
    assert scene.parts["washer"].params.oil_heat_capacity == 2050.0  # the scene's own stays
    assert (
        "given in addition to it: heat_capacity, conductivity, pressure_viscosity" in scene.notes[0]
    )
    assert scene.warnings == () and load_scene("planetary").notes == ()
    assert load_scene("brake-test").published
    assert load_scene("brake-test", oil="ISO VG 46").published is None


def test_a_scene_may_name_its_oil_and_one_without_is_a_warning(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text('base = "planetary-sun"\noil = "ISO VG 32"\n')
    assert load_scene(path).warnings == ()
    path.write_text('base = "planetary-sun"\n')
    assert "each part has an oil of its own" in load_scene(path).warnings[0]
    path.write_text('base = "planetary"\n[oil]\nname = "ISO VG 32"\ndensity = 800\n')
    with pytest.raises(ParameterError, match="density together with name"):
        load_scene(path)
    path.write_text(
        'base = "planetary-sun"\n[oil]\nkinematic_viscosity = [[313.15, 3e-5], [373.15, 5e-6]]\n'
    )
    assert "850 kg/m3 is taken" in load_scene(path).warnings[0]


def test_fmus_are_built_with_an_oil():
    (washer,) = asked(["washer"], "ISO VG 46")
    assert washer.name == "ThrustWasher" and "ISO VG 46" in washer.notes
    assert washer.params().oil_density == pytest.approx(854.2, rel=1e-4)
    assert len(asked(None, "ISO VG 46")) == len(asked(None))
    with pytest.raises(ParameterError, match="CommandSource knows no oil"):
        asked(["CommandSource"], "ISO VG 46")


@pytest.mark.parametrize(
    ("given", "base"),
    [
        ("ISO VG 320 PAO", "pao"),
        ("Polyglycol ISO VG 220", "polyglycol"),
        ({"name": "ISO VG 320", "base": "ester"}, "ester"),
        ("name=VG 320, base=mineral", "mineral"),
        ("ISO VG 320", ""),
    ],
)
def test_the_base_of_an_oil_reaches_the_friction_of_the_gears(given, base):
    """Schlenk's law has an X_L of its own for each base; a class of viscosity says none."""
    found = oil(given)
    assert found.base == base and oil(found.as_toml()).base == base
    assert found.parameters_for("gearmesh").get("base_oil", "") == base
    assert "base_oil" not in found.parameters_for("washer")
    with pytest.raises(ParameterError, match="base = 'tar', allowed: mineral"):
        oil({"name": "ISO VG 320", "base": "tar"})
