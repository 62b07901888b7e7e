"""Which inputs of the models move which outputs at once, as their descriptions say."""

import random
from contextlib import contextmanager
from zipfile import ZipFile

import needed
import pytest
from built import built_fmu
from sampling import jump

from thrustwasher import ParameterError, WasherParams, build_fmu, load_part, solve_washer
from thrustwasher.errors import SolveError
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.stepper import DirectInstance, Instance
from thrustwasher.model.registry import all_specs, find_spec
from thrustwasher.washer.parameters import SPEC

H = 1e-3
NAMES = [spec.name for spec in all_specs()]
# Only by the heat of a starved gap, on a step along a straight profile of inputs.
FILM = "film_ratio film_thickness contact_torque contact_share viscosity friction_coefficient"
UNSEEN = {"WetClutch": {("drum_speed", name) for name in FILM.split()}}
UNSEEN["WetClutch"] |= {(name, "slip_bound") for name in ("load", "speed")}  # of a pack that knows
# Parameters under which different inputs act at once.
STANDINGS = {
    "ThrustWasher": [{"gear_far_face": "bulk"}, {"gear_far_face": "oil"}],
    # every mode of both packs
    "ShiftTransmission": [
        {"initial_engine_speed": 300.0},  # first gear: the brake holds
        {"initial_engine_speed": 300.0, "initial_drum_speed": 300.0},  # second gear
        {"initial_engine_speed": 0.0},  # at rest: both may hold
        {"initial_engine_speed": 300.0, "initial_drum_speed": 50.0},  # both slip
        {"actuation": "pressure"},
    ],
    "WetClutch": [
        {},
        {"starts_pressed": True},
        {"fidelity": "stribeck", "friction_law": "wang", "shear_temperature_slope": 1e-3},
        {"input_profile": "linear", "friction_law": "wang", "shear_temperature_slope": 1e-3},
    ],
    # endurance is the paper's, a safety against micropitting needs its limit, so does the root's
    "DrivelineLosses": [
        {"input_immersion": 0.1, "drum_immersion": 0.1, "drum_seal_diameter": 0.05}
    ],
    "GearTrain": [
        {"meshes": 3, "shaft_1_axial": "pushed"},
        {"shaft_2_axial": "O", "shaft_3_force_1_radial": 3e3, "shaft_3_force_1_axial": 1e3},
    ],
    "GearMesh": [
        {"permissible_film_ratio": 0.3, "root_limit": 430e6},
        {"film_heat": "atan", "steel": "AISI4340"},
    ],
}
CASES = {
    "ThrustWasher": 40,
    "WetClutch": 200,
    "GearMesh": 100,
    "GearTrain": 20,
    "ShiftTransmission": 600,
}


HEATS = {f"heat_{i}": f"energy_{i}" for i in range(1, 8)}
TAKEN_ONE_WAY = HEATS | {energy: heat for heat, energy in HEATS.items()}


def one_way(spec, rng, values):
    """Return the values in order; the sump takes the heat of a part as power or as energy."""
    for heat, energy in HEATS.items():
        if heat in values:
            values[rng.choice([heat, energy])] = 0.0
    return list(values.values())


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.slow
def test_only_listed_inputs_move_an_output_at_once_and_all_of_them_the_real_ones(name):
    spec, rng = find_spec(name), random.Random(5)
    standings = STANDINGS.get(name, [{}])
    seen, far = set(), 0.2 if name == "ShiftTransmission" else 0.0  # where packs stick
    for case in range(CASES.get(name, 5)):
        given = standings[case % len(standings)]
        if name == "ShiftTransmission":
            bearings = {f"{gear}_bearing_coefficient": 0.02 for gear in ("sun", "ring")}
            given = given | {"ring_mesh": True} | bearings
            given |= {"needle_count": 18 * (case % 2)}
        with DirectInstance(spec, parameters=given) as direct:
            point = one_way(spec, rng, jump(spec, rng, far))
            direct.initialize(inputs=dict(zip(direct.input_names, point, strict=True)))
            for i in range(rng.choice([0, 5])):  # at the start too
                direct.step(i * H, H)
            for i, signal in enumerate(spec.inputs):
                direct.set_inputs(point)
                before = direct.outputs()
                changed = list(point)
                can_be_nothing = name == "ShiftTransmission" and rng.random() < 0.1
                changed[i] = 0.0 if can_be_nothing else jump(spec, rng, far)[signal.name]
                if signal.name in TAKEN_ONE_WAY:  # the other way says nothing meanwhile
                    changed[direct.input_names.index(TAKEN_ONE_WAY[signal.name])] = 0.0
                direct.set_inputs(changed)
                pairs = zip(spec.outputs, before, direct.outputs(), strict=True)
                seen |= {(signal.name, output.name) for output, a, b in pairs if a != b}
    listed = {(i, v.name) for v in interface(spec).variables for i in v.depends}
    real = {signal.name for signal in spec.outputs if signal.kind == "real"}
    assert seen <= listed
    assert {pair for pair in listed - seen if pair[1] in real} == UNSEEN.get(name, set())


# One FMU from a part or a model: where it lies, and what is refused.

PART = 'model = "gearmesh"\nname = "MyPair"\n[parameters]\npinion_teeth = 23\n'


@pytest.fixture
def part(tmp_path):
    file = tmp_path / "pair.toml"
    file.write_text(PART)
    return file


def named(path):
    with ZipFile(path) as fmu:
        return f'modelName="{path.stem}"' in fmu.read("modelDescription.xml").decode()


def test_a_model_goes_to_a_folder_under_its_name(tmp_path):
    needed.linker()
    path = build_fmu("gearmesh", tmp_path / "new", platforms=["linux64"])
    assert path == tmp_path / "new" / "GearMesh.fmu" and named(path)
    assert build_fmu("GearMesh", str(tmp_path / "new"), platforms=["linux64"]) == path


def test_a_part_is_built_from_its_file_or_itself_the_same(part, tmp_path):
    needed.linker()
    made = (part, str(part), load_part(part))
    paths = [build_fmu(one, tmp_path / str(i), platforms=["linux64"]) for i, one in enumerate(made)]
    assert [path.name for path in paths] == 3 * ["MyPair.fmu"] and all(map(named, paths))
    assert len({path.read_bytes() for path in paths}) == 1


def test_the_file_may_be_named(part, tmp_path):
    needed.linker()
    path = build_fmu(part, tmp_path / "other.fmu", fmi=3, platforms=["linux64"])
    with ZipFile(path) as fmu:
        assert 'fmiVersion="3.0"' in fmu.read("modelDescription.xml").decode()
    assert [p.name for p in tmp_path.iterdir() if p != part] == ["other.fmu"]


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (("washr", "."), "model = 'washr', allowed: ThrustWasher.*did you mean 'washer'"),
        (("none.toml", "."), "part = 'none.toml': cannot be read"),
        ((3, "."), "part_or_model = 3, allowed: the path of a part file"),
        (("washer", ""), "out = '', allowed: the path of an FMU"),
        (("washer", 3), "out = 3, allowed: the path of an FMU"),
        (("washer", __file__), "allowed: the path of an FMU .* or a folder"),
    ],
)
def test_what_is_not_allowed_is_named(given, said):
    with pytest.raises(ParameterError, match=said):
        build_fmu(*given)


def test_versions_and_platforms_are_those_of_build(tmp_path):
    with pytest.raises(ParameterError, match="fmi = 4, allowed: 2 or 3"):
        build_fmu("washer", tmp_path, fmi=4)
    with pytest.raises(ParameterError, match="'amiga'"):
        build_fmu("washer", tmp_path, platforms=["amiga"])


# Derivatives over tunable parameters, at any time; they leave no trace.

POINT = {"load": 300.0, "speed": 545.0, "tilt": 0.002}
OUTPUTS = ["friction_torque", "temperature", "film_ratio", "oil_flow"]
PAPER = {"oil_cooling": False, "film_heat_fraction": 0.8}
ways = pytest.mark.parametrize("way", ["kernels", "native-fmi2", "native-fmi3"])


def fmu_of(model, way):
    target, fmi = way.split("-fmi")
    return built_fmu(model, target=target, fmi=int(fmi), local=True)


@contextmanager
def washer(way, **parameters):
    if way == "kernels":
        yield DirectInstance(SPEC, parameters=parameters)
        return
    instance = Instance(fmu_of("washer", way), parameters=parameters)
    yield instance
    instance.close()


@ways
@pytest.mark.parametrize("parameters", [{}, PAPER], ids=["oil cools", "paper"])
def test_shares_of_heat_have_the_derivatives_of_the_solution(way, parameters):
    solved = solve_washer(WasherParams(**parameters), **POINT).sensitivities(OUTPUTS)
    with washer(way, **parameters) as instance:
        instance.initialize(inputs=POINT)
        instance.step(0.0, 1e-3)
        for name in ("heat_split", "film_heat_fraction") if parameters else ("heat_split",):
            found = instance.directional_derivative(OUTPUTS, [name], [2.0])
            for output, value in zip(OUTPUTS, found, strict=True):
                rows = solved[output]
                values = {p: getattr(WasherParams(**parameters), p) for p in rows}
                largest = max(abs(values[p] * slope) for p, slope in rows.items())
                off = abs(0.5 * value - rows[name]) * values[name]
                assert off <= 1e-6 * largest, (output, name)


@ways
def test_asking_leaves_no_trace(way):
    rows = []
    for asks in (False, True):
        with washer(way) as instance:
            instance.initialize(inputs=POINT)
            for k in range(3):
                instance.step(k * 1e-3, 1e-3)
                if asks:
                    instance.directional_derivative(OUTPUTS, ["heat_split", "load"], [1.0, 2.0])
            rows.append(instance.outputs())
    assert rows[0] == rows[1]


@ways
def test_what_a_rule_holds_has_none_and_says_so(way):
    if way == "kernels":
        pytest.skip("the shell knows the rules")
    with washer(way) as instance:
        instance.initialize(inputs=POINT)
        instance.step(0.0, 1e-3)
        with pytest.raises(SolveError, match="film_heat_fraction = 1 has no derivative here"):
            instance.directional_derivative(OUTPUTS, ["film_heat_fraction"], [1.0])
        with pytest.raises((SolveError, ParameterError), match="roughness: derivatives are of"):
            instance.directional_derivative(OUTPUTS, ["roughness"], [1.0])
        instance.step(1e-3, 1e-3)


def test_a_clutchs_torque_grows_with_its_friction_scale():
    instance = Instance(
        fmu_of("clutch", "native-fmi3"), parameters={"friction_scale": 0.9, "holding": "off"}
    )
    instance.initialize(inputs={"load": 9000.0, "speed": 2.0})
    for k in range(40):  # until the faces touch
        instance.step(k * 0.01, 0.01)
    (torque,) = instance.get(["friction_torque"])
    (slope,) = instance.directional_derivative(["friction_torque"], ["friction_scale"], [1.0])
    assert 0.5 * torque < 0.9 * slope < 1.001 * torque
    assert instance.get(["friction_torque"]) == [torque]
    instance.close()
