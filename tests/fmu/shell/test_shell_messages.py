"""What the host is told: errors and warnings always, the rest when asked for; once, in words."""

import pytest
from shell_runs import GUID, MADE, last, needs_gcc, putting, run, toy_library
from toy.spec import SPEC as TOY

from thrustwasher.errors import Status
from thrustwasher.fmu.running.direct_instance import DirectInstance

pytestmark = needs_gcc
both = pytest.mark.parametrize("fmi", [2, 3])
HOT = {"load": 8000.0, "speed": 900.0, "oil_temperature": 300.0}
COOL = {"load": 0.0, "speed": 0.0, "oil_temperature": 300.0}


def said(fmi, script, category=""):
    replies = run(fmi, toy_library(), script)
    return [m for r in replies for m in r.messages if category in m.split(" ")[2]]


def heated():
    """Return the script of a disc that gets too hot and cools down, and what the core says."""
    core = DirectInstance(TOY, parameters={"heat_capacity": 1.0})
    core.initialize(inputs=HOT)
    script, events, efforts = putting(heat_capacity=1.0) + "enter 0\n" + putting(**HOT), [], []
    script += "leave\n"
    for i in range(20):
        inputs = HOT if i < 5 else COOL
        core.set_inputs(list(inputs.values()))
        core.step(i * 0.1, 0.1)
        events += core.core.events
        efforts.append(core.core.effort)
        script += putting(**inputs) + f"step {(i * 0.1).hex()} {(0.1).hex()}\n"
    return script, events, efforts


@both
def test_a_step_too_short_for_the_spacing_of_time_is_refused_with_both(fmi):
    """Half the spacing of doubles at 0.5 s; the next step, as long as that spacing, is taken."""
    script = MADE + "enter 0\nleave\nstep 0.5 5e-17\nstep 0.5 1.2e-16\n"
    *_, refused, taken = run(fmi, toy_library(), script)
    assert refused.status == 3 and taken.status == 0
    assert "step from t = 0.5 s by 5e-17 s: the time does not change" in refused.messages[0]
    assert refused.messages[0].endswith("its spacing is 1.1102230246251565e-16 s here")


@both
def test_events_are_told_once_and_as_the_core_words_them(fmi):
    script, events, _ = heated()
    told = said(fmi, MADE + script, "logEvents")
    assert [m.split("logEvents ")[1] for m in told] == events
    assert ["too hot" in e for e in events] == [True, False]
    assert "film_ratio = " in events[0] and "load = 8000 N" in events[0]


@both
def test_what_the_solver_took_is_told_in_every_step(fmi):
    script, _, efforts = heated()
    told = said(fmi, MADE + script, "logNonlinearSystems")
    assert [m.split("logNonlinearSystems ")[1] for m in told] == efforts
    assert "substeps: 1" in efforts[0]


@both
def test_advice_is_a_warning_given_once_also_to_hosts_that_log_nothing(fmi):
    told = said(fmi, f"make toy {GUID} 0\n" + heated()[0])
    assert len(told) == 1 and told[0].startswith(
        "1 toy logStatusWarning ToyClutch at t = 0.1 s: HOT"
    )
    assert Status.HOT.advice in told[0]


@both
def test_a_category_can_be_chosen_and_all_can_be_switched_off(fmi):
    script = heated()[0]
    kinds = {m.split(" ")[2] for m in said(fmi, MADE + "choose 1 logEvents\n" + script)}
    assert kinds == {"logEvents", "logStatusWarning"}
    kinds = {m.split(" ")[2] for m in said(fmi, MADE + "choose 0 logEvents\n" + script)}
    assert kinds == {"logNonlinearSystems", "logStatusWarning"}
    assert {m.split(" ")[2] for m in said(fmi, MADE + "choose 0\n" + script)} == {
        "logStatusWarning"
    }
    quiet = f"make toy {GUID} 0\n"
    assert len(said(fmi, quiet + "choose 1\n" + script)) == len(said(fmi, MADE + script)) == 23


@both
def test_an_unknown_category_is_named_and_changes_nothing(fmi):
    script = MADE + "choose 1 logEvents logNonsense#\n"
    reply = last(fmi, script)
    assert reply.status == 3 and "logNonsense." in reply.messages[0]  # FMI 2 gives # a meaning
    assert len(said(fmi, script + heated()[0])) == 24


@both
def test_errors_are_told_to_a_host_that_has_switched_logging_off(fmi):
    reply = last(fmi, f"make toy {GUID} 0\nenter 0\nleave\n" + putting(oil_temperature=24.0))
    assert reply.messages == [
        "3 toy logStatusError oil_temperature = 24 K is outside 233.15 .. 473.15 K; the value is "
        "not taken over. Did you mean 297.15 K (24 degC)?"
    ]


@both
def test_a_name_may_be_missing_or_too_long(fmi):
    long = last(fmi, f"make {'n' * 500} {GUID} 0\nstep 0 1\n").messages[0].split(" ")[1]
    assert set(long) == {"n"}
    assert last(fmi, f"make - {GUID} 0\nstep 0 1\n").messages[0].split(" ")[1] in (
        "ToyClutch",
        "NULL",
    )
