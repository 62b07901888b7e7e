"""Parameters that a host changes in a run, in the models' own libraries."""

from typing import Any, NamedTuple

import pytest
from shell_runs import GUID, model_library, needs_linux, putting, run, taking

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.model.registry import all_specs, find_spec

pytestmark = needs_linux
H = 1e-3
WASHER = {"load": 400.0, "speed": 300.0, "tilt": 2e-3, "oil_temperature": 353.15}
MESH = {"load": 60.0, "speed": 200.0, "oil_temperature": 350.0}
PACK = {"load": 3000.0, "speed": 50.0, "oil_temperature": 350.0}
SLOW, GIVEN = {"speed": 1e-3}, {"holding": "given"}  # held: the shaft nearly stands
WAYS = ["fmi2", "fmi3", "event mode"]
each_way = pytest.mark.parametrize("way", WAYS)


class Case(NamedTuple):
    model: str
    name: str
    new: float
    inputs: dict[str, float]
    fixed: dict[str, Any]  # other parameters; enumerations by number
    output: str


CASES = [
    Case("washer", "heat_split", 0.8, WASHER, {}, "temperature"),
    Case("washer", "film_heat_fraction", 0.5, WASHER, {"oil_cooling": 0}, "temperature"),
    Case(
        "gearmesh", "constant_friction", 0.1, MESH, {"friction_law": "constant"}, "friction_torque"
    ),
    Case("gearmesh", "efficiency", 0.9, MESH, {"friction_law": "efficiency"}, "friction_torque"),
    Case(
        "gearmesh",
        "efficiency_back",
        0.9,
        MESH | {"load": -60.0},
        {"friction_law": "efficiency"},
        "friction_torque",
    ),
    Case("washer", "coupling_inertia", 0.2, WASHER | SLOW, GIVEN, "friction_torque"),
    Case("gearmesh", "coupling_inertia", 1e-3, MESH | SLOW, GIVEN, "friction_torque"),
    Case(
        "clutch",
        "coupling_inertia",
        0.2,
        PACK | {"speed": 0.02},
        GIVEN | {"starts_pressed": 1},
        "friction_torque",
    ),
    Case("clutch", "friction_scale", 0.5, PACK, {"starts_pressed": 1}, "friction_torque"),
]
CLUTCH = CASES[-1]


def numbers(case):
    """Return the fixed parameters as numbers."""
    laws = {f.name: list(f.metadata.get("options", [])) for f in fields_of(case)}
    return {k: laws[k].index(v) + 1 if isinstance(v, str) else v for k, v in case.fixed.items()}


def fields_of(case):
    return find_spec(case.model).params.__dataclass_fields__.values()


class Host:
    """Writes the script of a run, in one of three ways to call an FMU."""

    def __init__(self, case, way):
        self.spec, self.fmi = find_spec(case.model), 2 if way == "fmi2" else 3
        self.events = way == "event mode"
        self.names = [s.name for s in self.spec.outputs]
        self.script = f"make tuned {GUID} 1{' e' if self.events else ''}\n"
        self.put(**numbers(case))
        self.script += ("setup 0\n" if self.fmi == 2 else "") + "enter 0\n"
        self.put(**case.inputs)
        self.script += "leave\n" + self.back()
        self.n = 0

    def back(self):
        return "call fmi3EnterStepMode\n" if self.events else ""

    def put(self, **values):
        self.script += putting(self.spec, **values)
        return self

    def tune(self, **values):
        self.script += "call fmi3EnterEventMode\n" if self.events else ""
        self.put(**values)
        self.script += self.back()
        return self

    def steps(self, n):
        for _ in range(n):
            self.script += f"step {self.n * H!r} {H!r}\n" + taking(self.names, self.spec)
            self.n += 1
        return self

    def say(self, line):
        self.script += line + "\n"
        return self

    def answers(self):
        replies = run(self.fmi, model_library(self.spec.key), self.script)
        assert all(r.status == 0 for r in replies), [r for r in replies if r.status]
        return [r.values for r in replies if r.values]


def test_these_are_all_of_them():
    found = {
        (s.key, v.name)
        for s in all_specs()
        for v in interface(s).variables
        if v.variability == "tunable"
    }
    assert found == {(c.model, c.name) for c in CASES}


@pytest.mark.parametrize(
    ("case", "way"), [*((case, "fmi2") for case in CASES), *((CLUTCH, way) for way in WAYS[1:])]
)
def test_a_change_counts_from_the_next_step_on_as_in_the_core_to_the_bit(case, way):
    spec = find_spec(case.model)
    core = DirectInstance(spec, parameters=case.fixed)
    core.initialize(0.0, case.inputs)
    reference = next(v.reference for v in interface(spec).variables if v.name == case.name)
    names = [s.name for s in spec.outputs]
    wanted, real = [], [s.name for s in spec.outputs if s.kind == "real"]
    for i in range(5):
        if i == 3:
            core.core.set([reference], [case.new], "Real")
        core.step(i * H, H)
        shown = dict(zip(names, core.outputs(), strict=True))
        wanted.append([shown[name] for name in real])
    found = Host(case, way).steps(3).tune(**{case.name: case.new}).steps(2).answers()
    assert [v for v in found if len(v) == len(real)] == wanted
    kept, new = (row[real.index(case.output)] for row in wanted[2:4])
    assert abs(new - kept) > 1e-4 * abs(kept)


@each_way
def test_the_state_carries_the_value_also_as_bytes(way, tmp_path):
    file, new = tmp_path / "state", {CLUTCH.name: CLUTCH.new}
    one = Host(CLUTCH, way).steps(2).tune(**new).say("save 0").say(f"write 0 {file}")
    first = one.steps(2).answers()
    other = Host(CLUTCH, way).say(f"read 1 {file}").say("restore 1")
    other.script += taking([CLUTCH.name], other.spec)
    other.n = 2
    second = other.steps(2).answers()
    assert second[0] == [CLUTCH.new] and second[1:] == first[1 - len(second) :]


@each_way
def test_a_value_out_of_range_or_against_a_rule_is_refused(way):
    def refused(case, value, after=""):
        host = Host(case, way).steps(1).tune(**{case.name: value})
        host.script += after
        return run(host.fmi, model_library(host.spec.key), host.script)

    said = [r.messages[-1] for r in refused(CLUTCH, 3.0) if r.status]
    assert len(said) == 1 and "friction_scale = 3 is outside 0.1 .. 2" in said[0]
    cooled = CASES[1]._replace(fixed={"oil_cooling": 1})
    said = [r.messages[-1] for r in refused(cooled, 0.5, "step 1e-3 1e-3\n") if r.status]
    assert len(said) == 1 and "film_heat_fraction = 0.5, allowed: 1 with oil_cooling" in said[0]
