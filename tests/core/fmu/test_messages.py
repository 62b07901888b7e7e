"""What native FMUs of the models tell: events once, advice once per change, counts per step."""

import pytest

from thrustwasher.cli import main
from thrustwasher.errors import Status
from thrustwasher.fmu.build import build
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.fmu.running.loading import Messages, description, instantiate, unpack
from thrustwasher.fmu.stepper import Instance
from thrustwasher.model.registry import find_spec

H = 1e-3


class Listener:
    """A native FMU that keeps what it logs as (status, category, text)."""

    def __init__(self, path):
        self.said = Messages()
        folder = unpack(path)
        described = description(folder)
        self.references = {v.name: v.valueReference for v in described.modelVariables}
        self.fmu = instantiate(folder, described, "heard", self.said)

    def begin(self, **inputs):
        self.fmu.setupExperiment()
        self.fmu.enterInitializationMode()
        self.set(**inputs)
        self.fmu.exitInitializationMode()

    def set(self, **inputs):
        self.fmu.setReal([self.references[name] for name in inputs], list(inputs.values()))

    def heard(self, category):
        return [text for _, kind, text in self.said if kind == category]


@pytest.fixture
def listen(natives):
    made = []

    def open_(name):
        made.append(Listener(natives[name]))
        return made[-1]

    yield open_
    for listener in made:
        listener.fmu.freeInstance()


@pytest.mark.parametrize("made", ["natives", "fmus"])
def test_a_parameter_that_others_overrule_is_told_once_when_initialization_ends(made, request):
    path = request.getfixturevalue(made)["ShiftTransmission"]
    given = {"engine_torque": 120.0, "engine_torque_points": 1, "engine_torque_1": 90.0}
    with Instance(path, parameters=given) as fmu:
        fmu.initialize()
        fmu.step(0.0, H)
        (text,) = fmu.warnings
    assert text.endswith(": engine_torque = 120 N.m is not used: engine_torque_points = 1")


def test_the_washer_tells_once_when_the_film_is_lost_and_once_when_it_is_back(listen):
    washer = listen("ThrustWasher")
    washer.begin(load=800.0, speed=545.0, tilt=2e-3, oil_temperature=297.15)
    for i, load in enumerate([800, 900, 1000, 1100, 1100, 1100, 900, 700, 500, 500, 500]):
        washer.set(load=float(load))
        washer.fmu.doStep(i * H, H)
    lost, regained = washer.heard("logEvents")
    assert "film lost" in lost and "film regained" in regained
    assert all("load = " in text and "film_ratio = " in text for text in (lost, regained))
    warnings = washer.heard("logStatusWarning")
    assert len(warnings) == 1 and Status.DISTRESS.advice in warnings[0]
    assert len(washer.heard("logNonlinearSystems")) == 11
    assert "Newton iterations: " in washer.heard("logNonlinearSystems")[0]


def test_the_transmission_tells_each_lock_and_each_break_away(listen):
    shift = listen("ShiftTransmission")
    shift.begin(clutch_torque=0.0, brake_torque=400.0, shift_command=0.0)
    for i in range(1000):
        t = i * H
        shift.set(clutch_torque=600.0 * min(t, 0.5), brake_torque=max(0.0, 400.0 - 1000.0 * t))
        shift.fmu.doStep(t, H)
    texts = [text.split(": ")[1].split(";")[0] for text in shift.heard("logEvents")]
    assert texts == ["brake broke away", "clutch locked"]
    assert shift.heard("logNonlinearSystems") == []


def test_a_reading_between_steps_hides_no_event_and_a_restored_state_repeats_it(listen):
    washer = listen("ThrustWasher")
    washer.begin(load=300.0, speed=545.0, tilt=2e-3, oil_temperature=297.15)
    washer.fmu.doStep(0.0, H)
    state = washer.fmu.getFMUstate()
    for count in (1, 2):
        washer.set(load=1200.0)
        assert washer.fmu.getBoolean([washer.references["distress"]]) == [1]
        washer.fmu.doStep(H, H)
        assert len(washer.heard("logEvents")) == count
        washer.fmu.setFMUstate(state)
    washer.fmu.freeFMUstate(state)


def test_advice_is_told_once_in_a_run_and_counted_at_its_end(listen):
    washer = listen("ThrustWasher")
    washer.begin(load=300.0, speed=545.0, tilt=2e-3, oil_temperature=297.15)
    oils = [297.15, 250.0, 250.0, 297.15, 297.15, 250.0]
    for i, oil in enumerate(oils):
        washer.set(oil_temperature=oil)
        washer.fmu.doStep(i * H, H)
    warnings = washer.heard("logStatusWarning")
    assert len(warnings) == 1 and Status.OUTSIDE_VERIFIED.name in warnings[0]
    washer.fmu.terminate()
    assert washer.heard("logStatusWarning")[1:] == [
        "ThrustWasher: oil_temperature left the verified range 2 times in this run; the first is "
        "told above"
    ]


def test_a_grave_warning_comes_before_inputs_outside_their_ranges(listen):
    """Hot oil and a hot contact in the same step, both again and again; the core says the same."""
    washer, direct = listen("ThrustWasher"), DirectInstance(find_spec("washer"))
    start = {"load": 300.0, "speed": 545.0, "tilt": 2e-3, "oil_temperature": 297.15}
    washer.begin(**start)
    direct.initialize(0.0, start)
    told = direct.core.advice()
    for i in range(8):
        load, oil = ((300.0, 297.15), (1500.0, 425.0))[i % 2]
        washer.set(load=load, oil_temperature=oil)
        washer.fmu.doStep(i * H, H)
        direct.set_inputs([load, 545.0, 2e-3, oil])
        direct.step(i * H, H)
        told += direct.core.advice()
    first, second = washer.heard("logStatusWarning")
    assert Status.HOT.name in first and "oil_temperature = 425 K" in second
    washer.fmu.terminate()
    counts = washer.heard("logStatusWarning")[2:]
    assert [text.split(" times")[0] for text in counts] == [
        "ThrustWasher: HOT 4",
        "ThrustWasher: oil_temperature left the verified range 4",
    ]
    assert washer.heard("logStatusWarning") == told + direct.core.counts()


def test_a_pack_tells_once_of_steps_longer_than_its_own_and_the_advised_one(listen):
    """FMPy without an output interval makes 8 ms of 1 ms over 5 s."""
    pack, direct = listen("WetClutch"), DirectInstance(find_spec("clutch"))
    at = {"load": 0.0, "speed": 200.0, "oil_temperature": 353.15}
    direct.initialize(0.0, at)
    pack.begin(**at)
    told = []
    for i in range(20):
        load = 5000.0 * min(1.0, i * 0.08)
        pack.set(load=load)
        pack.fmu.doStep(i * 8e-3, 8e-3)
        direct.set_inputs([load, 200.0, 353.15, 0.0])
        direct.step(i * 8e-3, 8e-3)
        told += [text for kind, text in direct.core.messages() if kind == "logStatusWarning"]
    heard = pack.heard("logStatusWarning")
    assert heard == told and sum("longer than advised_step" in text for text in heard) == 1


BOXED = """
model = "gearmesh"
name = "Boxed"
[box]
load = ["0 N.m", "50 N.m"]
"""


def test_an_input_that_leaves_box_or_verified_range_is_told_once_in_a_run_and_solved(tmp_path):
    path = tmp_path / "boxed.toml"
    path.write_text(BOXED)
    (native,) = build([str(path)], out=tmp_path, platforms=["linux64"])
    mesh = Listener(native)
    profile = [(40.0, 300.0), (60.0, 300.0), (61.0, 430.0), (40.0, 430.0), (60.0, 300.0)]
    mesh.begin(load=40.0, speed=180.0, oil_temperature=300.0)
    for i, (load, oil) in enumerate(profile):
        mesh.set(load=load, oil_temperature=oil)
        mesh.fmu.doStep(i * H, H)
    mesh.fmu.terminate()
    first, second, count = mesh.heard("logStatusWarning")
    assert "0.002 s: load = 60 N.m is outside 0 .. 50 N.m, the part's box: solved all the" in first
    assert "0.003 s: OUTSIDE_VERIFIED: oil_temperature = 430 K is outside 253.15 .. 423" in second
    assert count == "Boxed: load left the part's box 2 times in this run; the first is told above"


def test_a_new_pack_engages_with_a_word_on_its_slip_only(tmp_path):
    """From the open pack at full slip to a stop under load, as ``part new`` writes the part.

    The slip is prescribed: it does not answer, which is said once.
    """
    part = tmp_path / "pack.toml"
    assert main(["part", "new", "clutch", "--name", "Pack", "--out", str(part)]) == 0
    (native,) = build([str(part)], out=tmp_path, platforms=["linux64"])
    pack = Listener(native)
    pack.begin(load=0.0, speed=-100.0, oil_temperature=353.15)
    for i in range(500):
        pack.set(load=50.0 * min(i, 100), speed=min(-100.0 + 0.25 * i, 0.0))
        pack.fmu.doStep(i * H, H)
    pack.fmu.terminate()
    (told,) = pack.heard("logStatusWarning")
    assert ": UNANSWERED: " in told and "right for a prescribed slip" in told
