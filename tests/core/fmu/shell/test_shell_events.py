"""A step that ends where a Boolean output changes, for hosts that want it; else nothing changes."""

import pytest
from shell_runs import GUID, SANITIZED, needs_gcc, putting, ref, run, taking, toy_library

pytestmark = needs_gcc
H = 0.1
HOT = {"load": 2000.0, "speed": 100.0, "oil_temperature": 300.0}
COLD = {"load": 0.0, "speed": 0.0, "oil_temperature": 300.0}
RATE = 0.5 * (0.05 + 0.1) * 2 * 2000.0 * (0.05 + 0.001 * 100.0) * 100.0  # K/s, with 1 J/K
LIMIT = 200.0 / RATE  # s: a disc that was cold becomes too hot; the toy makes one explicit step
INTERNAL, EVENTS, EARLY = "", " e", " r"  # what the host lets the FMU do


def begun(how, **inputs):
    made = f"make toy {GUID} 1{how}\n"
    leave = "leave\n" + ("call fmi3EnterStepMode\n" if how.strip() else "")
    return made + putting(heat_capacity=1.0) + "enter 0\n" + putting(**(COLD | inputs)) + leave


def step(t, h):
    return f"step {float(t).hex()} {float(h).hex()}\n"


def handled(n):
    """Return the calls of a host that is told of an event."""
    return "call fmi3EnterEventMode\ncall fmi3UpdateDiscreteStates\ncall fmi3EnterStepMode\n" * n


def ended(script):
    """Return what the last step of a script said: event, early return, last time."""
    reply = run(3, toy_library(), script + "extra ended\n")[-1]
    assert reply.status == 0
    return tuple(reply.values)


def test_a_step_ends_where_the_output_changes_and_the_rest_of_it_follows():
    assert 0.02 < LIMIT < 0.9 * H
    event, early, time = ended(begun(EARLY, **HOT) + step(0.0, H))
    assert (event, early) == (1, 1)
    assert 0.0 <= time - LIMIT <= 1e-7
    script = begun(EARLY, **HOT) + step(0.0, H) + handled(1) + step(time, H - time)
    assert ended(script) == (0, 0, H)


def test_the_outputs_are_those_at_the_instant():
    names = ["time", "temperature_rise", "hot", "steps"]
    script = begun(EARLY, **HOT) + step(0.0, H) + taking(names)
    (time, rise), (steps,), (hot,) = (r.values for r in run(3, toy_library(), script)[-3:])
    assert time == pytest.approx(LIMIT, abs=1e-7) and hot == 1
    assert 200.0 < rise <= 200.0 + 1e-7 * RATE
    assert steps == 1  # trials leave nothing behind


@pytest.mark.parametrize("how", [INTERNAL, EVENTS])
def test_without_early_return_the_step_is_whole(how):
    assert ended(begun(how, **HOT) + step(0.0, H)) == (float(how == EVENTS), 0, H)


@pytest.mark.parametrize("how", [EVENTS, EARLY])
def test_without_an_event_all_hosts_get_the_same_bits(how):
    names = ["time", "friction_torque", "temperature_rise", "energy", "hot", "steps"]
    script = "".join(step(i * 0.01, 0.01) + taking(names) for i in range(20))
    plain = run(3, toy_library(), begun(INTERNAL, speed=20.0, load=100.0) + script)
    other = run(3, toy_library(), begun(how, speed=20.0, load=100.0) + script)
    n = 20 * 4  # replies
    assert [r.values for r in plain[-n:]] == [r.values for r in other[-n:]]


def test_a_change_at_the_end_of_a_step_does_not_shorten_it():
    assert ended(begun(EARLY, **HOT) + step(0.0, LIMIT * 0.99)) == (0, 0, LIMIT * 0.99)
    assert ended(begun(EARLY, **HOT) + step(0.0, LIMIT + 1e-8))[:2] == (1, 0)


def test_after_eight_early_returns_in_a_row_a_step_is_whole():
    """Heated and cooled in turn at its limit the disc would change in every step, at once."""
    script, time, times, early = begun(EARLY, **HOT), 0.0, [], []
    for n in range(13):
        script += putting(**(COLD if n % 2 or n > 9 else HOT)) + step(time, H)
        _, is_early, time = ended(script)
        script += handled(1)
        times.append(time)
        early.append(is_early)
    assert early[:9] == [1] * 8 + [0]
    assert times[7] < LIMIT + 1e-5 and times[8] == times[7] + H
    assert early[9:] == [0, 1, 0, 0]  # time has gone on: a new row


def test_at_the_end_of_a_step_the_host_is_called_back_and_may_read():
    made = f"make toy {GUID} 1 a\nenter 0\n" + putting(**HOT) + "leave\n"
    script = made + step(0.0, H) + step(H, H) + taking(["energy", "time"]) + "extra heard\n"
    replies = run(3, toy_library(), script)
    energy, time = replies[-2].values
    assert replies[-1].values == [2, time, energy, 1]
    said = [m for r in replies for m in r.messages if "not allowed within intermediateUpdate" in m]
    assert len(said) == 6 and all(m.endswith("return from it first") for m in said)
    refused = [m for r in replies for m in r.messages if "fmi3FreeInstance is not allowed" in m]
    assert len(refused) == 2


def test_inputs_that_move_have_moved_as_far_as_the_step_went():
    """The load rises from 0 to 4000 N: the toy heats with the middle of what it went through."""
    script = begun(" x", speed=HOT["speed"]) + f"put derivative {ref('load')} 4000\n"
    script += step(0.0, H) + taking(["load"]) + "extra ended\n"
    load, (event, early, time) = (r.values for r in run(3, toy_library(), script)[-2:])
    instant = (H * LIMIT) ** 0.5
    assert (event, early) == (1, 1) and 0.0 <= time - instant <= 1e-7
    assert load == pytest.approx([4000.0 * time / H])


@pytest.mark.slow
def test_the_search_keeps_to_its_memory():
    script = begun(EARLY, **HOT) + step(0.0, H) + "save 0\nrestore 0\ndrop\n"
    library = toy_library(SANITIZED)
    replies = run(3, library, script, flags=SANITIZED)
    assert all(r.status == 0 for r in replies)
