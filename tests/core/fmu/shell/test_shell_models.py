"""The models' own libraries: the same bits and words as the Python core, bare in a C host."""

import math
import random

import pytest
from sampling import jump
from shell_runs import GUID, model_library, needs_linux, run
from twin import Twin

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.running.core import Mode
from thrustwasher.model.registry import find_spec
from thrustwasher.model.unread import all_conditions

pytestmark = needs_linux
CHEAP = ["clutch", "gearmesh", "transmission", "command"]
H = 1e-3


def vary_parameters(twin, rng):
    """Set some parameters a little off their start, and the fidelity; a bare library has no map."""
    found = [v for v in interface(twin.spec).variables if v.causality == "parameter"]
    values = {}
    for v in rng.sample(found, min(5, len(found))):
        if v.type == "Real" and v.low <= v.start * 1.01 <= v.high:
            values[v.name] = v.start * 1.01
    levels = [i for i, name in enumerate(twin.spec.fidelities, 1) if name != "map"]
    twin.put(**values, fidelity=rng.choice(levels))


def run_of(spec, seed, n):
    """Return a twin that has requested a run with everything that happens to instances."""
    twin, rng = Twin(spec, GUID), random.Random(seed)
    for part in range(3):
        vary_parameters(twin, rng)
        twin.begin(0.5 * part)
        twin.put(**jump(spec, rng))
        twin.leave()
        for i in range(n // 3):
            if spec.inputs and i % 10 == 3:
                twin.put(**{**jump(spec, rng), spec.inputs[0].name: math.nan})
                twin.step(0.5 * part + i * H, H)
            twin.put(**jump(spec, rng))
            if i % 4 == 0:
                twin.take()  # readings between setting and stepping change nothing that follows
            twin.step(0.5 * part + i * H, H)
            twin.take()
            if i == 20:
                twin.save(0)
            if i == 40:
                twin.restore(0)
        twin.reset()
    return twin


@pytest.mark.parametrize(
    ("model", "fmi"),
    [
        *((m, 2) for m in CHEAP),
        ("clutch", 3),
        *(pytest.param(m, 3, marks=pytest.mark.fmi3) for m in CHEAP if m != "clutch"),
    ],
)
def test_300_steps_are_the_cores_to_the_bit(model, fmi):
    twin = run_of(find_spec(model), 7, 300)
    replies = run(fmi, model_library(model), twin.script)
    twin.check(replies)


@pytest.mark.parametrize(("model", "fmi"), [("clutch", 2), ("transmission", 3), ("train", 2)])
def test_what_is_set_and_not_used_is_said_as_the_core_says_it(model, fmi):
    spec, rng, said = find_spec(model), random.Random(3), []
    twin = Twin(spec, GUID)
    conditions = all_conditions(spec.params)
    deciding = {c.by for own in conditions.values() for c in own if c.by}
    found = [v for v in interface(spec).parameters if v.name in conditions.keys() | deciding]
    for _ in range(40):
        values = {}
        for v in rng.sample(found, rng.choice([1, 2, 5, 12])):
            other = rng.randint(int(v.low), int(v.high)) if v.type != "Real" else 1.01 * v.start
            values[v.name] = other if v.low <= other <= v.high else v.start
        twin.put(**values)
        twin.begin()
        twin.leave()
        said += twin.core.advice() if twin.core.mode == Mode.STEPPING else []
        twin.reset()
    replies = run(fmi, model_library(model), twin.script)
    twin.check(replies, words=False)
    told = [m.split("logStatusWarning ")[1] for r in replies for m in r.messages if "Warning" in m]
    assert told == said and sum(" is not used: " in text for text in said) > 10


@pytest.mark.slow
def test_the_washers_steps_are_the_cores_to_the_bit():
    twin = run_of(find_spec("washer"), 7, 30)
    twin.check(run(2, model_library("washer"), twin.script))


# One argument or two: functions of the C library's that a host may have of its own.
OWN = """
#define OF_ONE(f) double f(double x); double f(double x) { return x - x + 42.0; }
#define OF_TWO(f) double f(double x, double y); double f(double x, double y) { return x - y; }
OF_ONE(exp) OF_ONE(exp2) OF_ONE(expm1) OF_ONE(log) OF_ONE(log1p) OF_ONE(log2) OF_ONE(log10)
OF_ONE(sin) OF_ONE(cos) OF_ONE(tan) OF_ONE(asin) OF_ONE(acos) OF_ONE(atan) OF_ONE(asinh)
OF_ONE(sinh) OF_ONE(cosh) OF_ONE(tanh) OF_ONE(erf) OF_ONE(erfc) OF_ONE(cbrt) OF_ONE(sqrt)
OF_ONE(floor) OF_ONE(ceil) OF_ONE(fabs)
OF_TWO(pow) OF_TWO(fmod) OF_TWO(hypot) OF_TWO(atan2) OF_TWO(nextafter)
void sincos(double x, double *a, double *b);
void sincos(double x, double *a, double *b) { *a = *b = x; }
"""


@pytest.mark.parametrize(
    "model", ["clutch", "gearmesh", pytest.param("washer", marks=pytest.mark.slow)]
)
def test_a_host_with_mathematical_functions_of_its_own_changes_no_bit(model, tmp_path):
    """It is linked so that libraries see its names before those of the C library."""
    (tmp_path / "own.c").write_text(OWN)
    script = run_of(find_spec(model), 3, 30).script
    own = ("-O1", "-fno-builtin", "-rdynamic", str(tmp_path / "own.c"))
    plain, found = (run(2, model_library(model), script, flags=f) for f in (("-O1",), own))
    assert found == plain
