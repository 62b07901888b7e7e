"""Wrong input over all commands: exit status 2, one line that says what to do, nothing written."""

import shlex

import pytest

from thrustwasher.cli import main

FILES = {
    "washer.toml": 'model = "washer"\nname = "W"\n[box]\ntilt = "1.5 mrad"\n',
    "mesh.toml": 'model = "gearmesh"\nname = "M"\n',
    "typo.toml": 'model = "washer"\nname = "W"\n[parameters]\nrougness = "1 um"\n',
    "bare.toml": 'model = "washer"\nname = "W"\n[parameters]\nroughness = 0.5\n',
    "box.toml": 'model = "washer"\nname = "W"\n[box]\noil_temperature = 80\n',
    "turned.toml": 'model = "washer"\nname = "W"\n[box]\nload = "500:20"\n',
    "no-model.toml": 'name = "W"\n',
    "broken.toml": "model = \n",
    "sped.csv": "load,sped\n300,500\n",
    "points.csv": "load,speed\n300,500\n",
    "comma.csv": "load;speed\n300;1,5\n",
    "law.csv": "sped [rpm],load,friction\n10,300,0.1\n",
    "torque.csv": "load,speed,friction_torqe\n300,500,0.1\n",
    "empty.csv": "",
    "page.txt": "",
    "old.json": "{}",
}
KELVIN = "did you mean 353.15 K (80 degC)?"
TABLE = [
    ("wahser", "did you mean washer?"),
    ("washer --oil-temperature 80", KELVIN),
    ("curve --oil-temperature 80", KELVIN),
    ("clutch --oil-temperature 80", KELVIN),
    ("gearmesh --oil-temperature 80", KELVIN),
    ("engage --oil-temperature 80", KELVIN),
    ("sweep washer --over load=50:500:50 --oil-temperature 80", KELVIN),
    ("washer --oil-temperature 212", "did you mean 373.15 K (212 degF)?"),
    ("washer --speed 3000", "did you mean 314.159 rad/s (3000 rpm)?"),
    ("curve --speed 6000", "did you mean 628.319 rad/s (6000 rpm)?"),
    ("sweep washer --over speed=3000,6000", "did you mean 314.159 rad/s (3000 rpm)?"),
    ("gearmesh --speed 12000", "did you mean 1256.64 rad/s (12000 rpm)?"),
    ("washer --tilt 2", "did you mean 0.002 rad (2 mrad)?"),
    ("washer --tilt 0.1", "did you mean 0.00174533 rad (0.1 deg)?"),
    ("washer --load -5", "load = -5.0 N, allowed: 0 .. 10000 N"),
    ("washer --load 0", "load = 0.0 N, allowed: 1 .. 10000 N"),
    ("washer --load '300 K'", "allowed: a finite number in N, or one in kN, MN, daN"),
    ("washer --load abc", "load = 'abc', allowed: a finite number in N"),
    ("washer --load '1,5 kN'", "; the decimal sign is a point"),
    ("washer --laod 300", "; did you mean --load?"),
    ("washer --grid 9", "grid = '9', allowed: two node counts as in 9x32"),
    ("washer --branch up", "invalid choice: 'up'"),
    ("washer --fidelity feild", "'feild', allowed: 'map' or 'field' or 'fine' or 'auto:TOLERANCE'"),
    (
        "washer --oil 'kinematic_viscosity_40=46cSt,kinematic_viscosity_100=7cSt,density_15=0.87'",
        "did you mean 870 kg/m3 (0.87 g/cm3)?",
    ),
    ("washer --set roughness=0.5", "did you mean 5e-07 m (0.5 um)?"),
    ("washer --set rougness=1um", "did you mean roughness?"),
    ("washer --set roughness", "allowed: NAME=VALUE"),
    ("washer --set friction_law=dry", "friction_law = 'dry', allowed: 'load' or 'constant'"),
    ("washer --preset brass", "invalid choice: 'brass'"),
    ("washer --part nowhere.toml", "cannot be read (No such file or directory)"),
    ("washer --part mesh.toml", "--part mesh.toml: is one of GearMesh, allowed: ThrustWasher"),
    ("washer --part typo.toml", "there is no 'rougness' here; did you mean 'roughness'?"),
    ("washer --part bare.toml", "did you mean 5e-07 m (0.5 um)?"),
    ("washer --part box.toml", KELVIN),
    ("washer --part turned.toml", "load = '500:20', allowed: low <= high"),
    ("washer --plot new/washer.png", "there is no folder new; make it first"),
    ("curve --plot new/curve.png", "there is no folder new; make it first"),
    ("washer --plot washer.gif", "allowed: a file name ending in .png, .svg or .pdf"),
    ("curve --out page.txt", "allowed: a file name ending in .csv"),
    ("clutch --set inner_radius=64", "did you mean 0.064 m (64 mm)?"),
    ("clutch --set faces=2.5", "faces = 2.5, allowed: 1 .. 100, a whole number"),
    ("gearmesh --speed 0", "speed = 0.0 rad/s, allowed: from 0.075 rad/s on"),
    ("engage --duration 0", "duration = 0.0 s, allowed: 1e-06 .. 3600 s"),
    ("engage --step 2", "step = 2.0 s, allowed: duration/200000 .. duration"),
    ("sweep washr --over load=50:500:50", "did you mean 'washer'?"),
    ("sweep washer", "over: nothing is varied, allowed: NAME=VALUES"),
    ("sweep washer --over laod=50:500:50", "did you mean load?"),
    ("sweep washer --over load=50:500", "allowed: start:stop:step"),
    ("sweep washer --points sped.csv", "column 'sped' is not known; did you mean speed?"),
    ("sweep washer --points empty.csv", "empty.csv: is empty"),
    ("sweep washer --points comma.csv", "the decimal sign is a point"),
    ("sweep washer --over load=50:500:50 --workers none", "allowed: a whole number from 1 on"),
    ("calibrate law.csv", "column 'sped [rpm]' is not known; did you mean speed?"),
    ("calibrate washer torque.csv --fit roughness", "did you mean friction_torque?"),
    ("calibrate washer", "the file with the measured points is missing (DATA.csv)"),
    ("calibrate washer points.csv --fit roughness", "data: no measured output"),
    ("part new washr", "did you mean 'washer'?"),
    ("part new washer --name 2nd", "name = '2nd', allowed: letters, digits and _"),
    ("part check no-model.toml", "'model' is missing"),
    ("part check broken.toml", "not valid TOML"),
    ("part", "the following arguments are required: deed"),
    ("map build points.csv", "a part file (.toml) is required"),
    ("map build --load 20:500:3", "allowed: LOW:HIGH or one value"),
    ("map check points.csv", "allowed: a file written by `thrustwasher map build`"),
    ("map check", "the map file is required"),
    ("cards whasher", "; did you mean 'washer'?"),
    ("build Wsher", "allowed: ThrustWasher, WetClutch"),
    ("build GearMesh --platforms amiga", "'amiga', allowed: linux64"),
    ("explore sumpf", "model = 'sumpf'"),
    ("explore washer --out page.txt", "allowed: a file name ending in .html or .htm"),
    ("shift --scene planetry", "did you mean 'planetary'?"),
    ("shift --scene nowhere.toml", "cannot be read"),
    ("shift --step fast", "step = 'fast', allowed: a finite number in s"),
    ("shift --fidelity wahser=map", "wahser"),
    ("chart --draw old.json", "is no chart.json of this version"),
    ("washer --load 300 --load 500", "argument --load: is given twice"),
    ("washer --oil '75W-90' --oil 'ISO VG 46'", "argument --oil: is given twice"),
    ("washer --set roughness=5e-7 --set roughness=4e-7", "roughness is given twice"),
    ("curve --load 300:300", "load_max = 300 N, allowed: above load_min"),
    ("part check mesh.toml --set normal_module=3", "--set: has no effect with part check"),
    ("part check mesh.toml --out new.toml", "--out: has no effect with part check"),
    ("part list washer --preset bronze", "--preset: has no effect with part list"),
    ("map list washer.toml", "washer.toml: has no effect with map list"),
    ("map list --tol 0.1", "--tol: has no effect with map list"),
    ("map check map.twm --load 20:300", "--load: has no effect with map check"),
    ("cards washer --points 30", "--points: has no effect with cards that are listed"),
    ("build GearMesh --tol 0.1", "--tol: has no effect with models without a part file"),
    ("shift --list --scene msl", "--scene: has no effect with --list"),
    ("shift --ssp a.ssp --no-guard", "--no-guard: has no effect with --ssp"),
    ("doctor --speed 3", "unrecognized arguments: --speed 3"),
]


STATED = [  # with the unit that was meant
    "washer --speed '30000 rpm'",
    "washer --oil-temperature '-300 degC'",
    "curve --speed '5e5 rpm'",
    "sweep washer --over 'speed [rpm]=30000'",
    "washer --set roughness=0.5mm",
    "washer --part thick.toml",
]


@pytest.mark.parametrize("words", STATED)
def test_a_unit_that_is_written_is_not_asked_for(words, tmp_path, monkeypatch, capsys):
    (tmp_path / "thick.toml").write_text(
        'model = "washer"\nname = "W"\n[parameters]\nroughness = "0.5 mm"\n'
    )
    monkeypatch.chdir(tmp_path)
    assert main(shlex.split(words)) == 2
    err = capsys.readouterr().err
    assert "allowed: " in err and "did you mean" not in err


@pytest.mark.parametrize(("words", "said"), TABLE, ids=[words for words, _ in TABLE])
def test_wrong_input_is_one_line_and_nothing_is_written(words, said, tmp_path, monkeypatch, capsys):
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    assert main(shlex.split(words)) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.count("\n") == 1 and "Traceback" not in err
    assert err.startswith("thrustwasher") and said in err
    assert {p.name for p in tmp_path.iterdir()} == set(FILES)
