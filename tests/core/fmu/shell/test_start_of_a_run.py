"""A unit's own times count from the start of the run, which a state keeps; both FMI versions."""

import pytest
from shell_runs import GUID, model_library, needs_gcc, putting, run, taking

from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.model.registry import find_spec

pytestmark = needs_gcc
both = pytest.mark.parametrize("fmi", [2, 3])
SPEC = find_spec("CommandSource")
MADE = f"make toy {GUID} 1\n"
RAMP = {"start": 0.125, "duration": 0.25}
H = 1.0 / 64.0  # of which times are whole numbers: no rounding


def begun(start):
    at = start.hex()
    return MADE + putting(SPEC, **RAMP) + f"setup {at}\nenter {at}\nleave\n"


def steps(start, first=0, n=32):
    command = taking(["command"], SPEC)
    return "".join(
        f"step {(start + k * H).hex()} {H.hex()}\n{command}" for k in range(first, first + n)
    )


def values(replies):
    return [r.values[0] for r in replies if r.values]


def direct(start, n=32):
    """Return what the Python target gives, and its state in the middle as bytes."""
    source = DirectInstance(SPEC, parameters=RAMP)
    source.initialize(start)
    found = []
    for k in range(n):
        source.step(start + k * H, H)
        found.append(source.outputs()[0])
    return found, source


@both
@pytest.mark.parametrize("start", [5.0, -3.0])
def test_a_ramp_begins_as_long_after_the_start_whenever_that_is(fmi, start):
    library = model_library("CommandSource")
    zero = values(run(fmi, library, begun(0.0) + steps(0.0)))
    assert zero[7] == 0.0 < zero[8] and zero[22] < zero[23] == zero[-1] == 1.0
    assert values(run(fmi, library, begun(start) + steps(start))) == zero == direct(start)[0]


@both
def test_a_state_keeps_the_start(fmi, tmp_path):
    """Read by a process that begins at another time; a reset forgets it."""
    library, file = model_library("CommandSource"), tmp_path / "state"
    whole = values(run(fmi, library, begun(5.0) + steps(5.0)))
    run(fmi, library, begun(5.0) + steps(5.0, n=12) + f"save 0\nwrite 0 {file}\nforget 0\n")
    fresh = begun(0.0) + f"read 0 {file}\nrestore 0\nforget 0\n" + steps(5.0, 12, 20)
    assert values(run(fmi, library, fresh)) == whole[12:]
    again = begun(5.0) + "step 5 1\nreset\n" + begun(0.0).removeprefix(MADE) + steps(0.0)
    assert values(run(fmi, library, again)) == whole


def test_a_state_of_the_python_target_keeps_the_start():
    whole, _ = direct(5.0)
    _, half = direct(5.0, 12)
    other = DirectInstance(SPEC, parameters=RAMP)
    other.initialize(0.0)
    other.set_state(other.deserialize(half.serialize(half.get_state())))
    found = []
    for k in range(12, 32):
        other.step(5.0 + k * H, H)
        found.append(other.outputs()[0])
    assert found == whole[12:]
