"""Every function in every mode, walked through from the one table; and all that is no good call."""

import shutil
import struct
import zlib

import pytest
from shell_runs import BEGUN, GUID, MADE, last, needs_gcc, putting, ref, run, taking, toy_library

from thrustwasher.fmu.shell import c_tables, call_table

pytestmark = needs_gcc
WAYS = {
    call_table.INSTANTIATED: "",
    call_table.INITIALIZING: "enter 0\n",
    call_table.STEPPING: "enter 0\nleave\n",
    call_table.TERMINATED: "enter 0\nleave\nend\n",
    call_table.EVENTS: "enter 0\nleave\n",  # FMI 3, of an instance made for it
}
EVENTS = f"make toy {GUID} 1 e\nenter 0\nleave\n"
FORBIDDEN = "is not allowed in state"
both = pytest.mark.parametrize("fmi", [2, 3])


FOR_STEPS = "the instance was made for co-simulation, not for model exchange"


def is_exchange_only(fmi, name):
    modes = call_table.CALLS[fmi][name]
    return modes & call_table.EXCHANGING and not modes & (call_table.STEPPING | call_table.EVENTS)


def every_call(fmi):
    return [
        (mode, name)
        for mode in WAYS
        for name in call_table.CALLS[fmi]
        if name != "FreeInstance" and (fmi == 3 or mode != call_table.EVENTS)
    ]


@both
def test_every_function_is_allowed_in_the_modes_of_the_table_and_in_no_other(fmi):
    made = {mode: f"make toy {GUID} 1 e\n" if mode == call_table.EVENTS else MADE for mode in WAYS}
    script = "".join(
        f"{made[mode]}{WAYS[mode]}call fmi{fmi}{name}\ndrop\n" for mode, name in every_call(fmi)
    )
    replies = iter(run(fmi, toy_library(), script))
    for mode, name in every_call(fmi):
        for _ in range(1 + WAYS[mode].count("\n")):
            assert next(replies).status == 0
        reply = next(replies)
        said = [text for text in reply.messages if FORBIDDEN in text]
        if is_exchange_only(fmi, name):
            assert reply.status == 3 and FOR_STEPS in reply.messages[-1]
        elif mode & call_table.CALLS[fmi][name]:
            assert said == [], (mode, name)
        else:
            assert reply.status == 3 and len(said) == 1, (mode, name)
            assert (
                f"fmi{fmi}{name} {FORBIDDEN} {call_table.MODES[mode][0]}; call fmi{fmi}" in said[0]
            )
        if name in call_table.DECLINED[fmi]:
            assert reply.status == 3 and call_table.DECLINED[fmi][name] in reply.messages[-1]
        next(replies)


@both
def test_a_forbidden_call_changes_nothing(fmi, tmp_path):
    wrong = [
        name for name, modes in call_table.CALLS[fmi].items() if not modes & call_table.STEPPING
    ]
    tries = "".join(f"call fmi{fmi}{name}\n" for name in wrong)
    script = (
        f"{BEGUN}step 0 1e-3\nsave 0\nwrite 0 {tmp_path}/a\n{tries}save 1\nwrite 1 {tmp_path}/b\n"
    )
    replies = run(fmi, toy_library(), script)
    assert [r.status for r in replies[7 : 7 + len(wrong)]] == [3] * len(wrong)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


@both
@pytest.mark.parametrize(
    ("way", "name", "first"),
    [
        ("", "DoStep", "EnterInitializationMode"),
        ("enter 0\n", "DoStep", "ExitInitializationMode"),
        ("enter 0\nleave\n", "EnterInitializationMode", "Reset"),
        ("enter 0\nleave\nend\n", "DoStep", "Reset"),
    ],
)
def test_the_message_says_what_to_call_first(fmi, way, name, first):
    message = last(fmi, f"{MADE}{way}call fmi{fmi}{name}\n").messages[-1]
    assert message.endswith(f"; call fmi{fmi}{first} first")


@both
def test_no_function_needs_an_instance_to_answer(fmi):
    names = call_table.CALLS[fmi]
    replies = run(
        fmi, toy_library(), "".join(f"call fmi{fmi}{n}\n" for n in names if n != "FreeInstance")
    )
    assert {r.status for r in replies} == {3}
    assert last(fmi, "drop\n").status == 0


@both
def test_versions_are_told_without_an_instance(fmi):
    assert last(fmi, "extra version\n").status == 0


@both
def test_arrays_that_are_missing_or_of_the_wrong_length_are_errors(fmi):
    reply = last(fmi, BEGUN + "extra no-arrays\n")
    assert reply.status == 0 and reply.values[0] >= 12  # 0 of them did not return Error
    assert len(reply.messages) == reply.values[0]
    assert last(fmi, BEGUN + "put real\n").status == 0  # no values: nothing to do


@both
@pytest.mark.parametrize("guid", ["-", "another", GUID + "0", GUID[:-1], GUID.upper()])
def test_a_description_of_another_build_is_refused_and_both_are_named(fmi, guid):
    reply = last(fmi, f"make toy {guid} 0\n")
    assert reply.status == 3
    assert GUID in reply.messages[0] and (guid in reply.messages[0] or guid == "-")


@pytest.mark.parametrize(
    ("fmi", "oddity", "text"),
    [
        (2, "m", "not for model exchange"),
        (3, "m", "not for model exchange"),
        (3, "s", "not for scheduled execution"),
        (
            3,
            "i",
            "inner_radius is required between communication points, allowed: outputs and "
            "Float64 inputs",
        ),
        (3, "n", "intermediateUpdate is NULL"),
    ],
)
def test_what_the_fmu_is_not_for_is_refused_at_once(fmi, oddity, text):
    reply = last(fmi, f"make toy {GUID} 0 {oddity}\n")
    assert reply.status == 3 and text in reply.messages[0]


@pytest.mark.parametrize(("fmi", "oddity"), [(2, "l"), (2, "c"), (3, "l")])
def test_without_a_logger_everything_works_and_nothing_is_said(fmi, oddity):
    script = f"make - {GUID} 1 {oddity}\nenter 0\nleave\nstep 0 1e-3\nput real 99 1\n"
    script += f"make toy x 1 {oddity}\n"
    replies = run(fmi, toy_library(), script)
    assert [r.status for r in replies] == [0, 0, 0, 0, 3, 3]
    assert not any(r.messages for r in replies)


@both
def test_unknown_references_and_wrong_types_are_named(fmi):
    cases = {
        "take real 99": "value reference 99 is unknown in ToyClutch",
        "put real 4294967295 1": "value reference 4294967295 is unknown in ToyClutch",
        f"take whole {ref('load')}": "load is of type",
        f"take real {ref('regime')}": "regime is of type Enumeration, not",
        f"take boolean {ref('steps')}": "steps is of type",
        f"put real {ref('friction_torque')} 1": "friction_torque is an output variable; it cannot",
        "put real 0 1": "time is an independent variable; it cannot be set",
    }
    for command, text in cases.items():
        reply = last(fmi, BEGUN + command + "\n")
        assert reply.status == 3 and text in reply.messages[-1], command


@both
def test_outputs_have_no_value_before_initialization(fmi):
    reply = last(fmi, MADE + f"take real {ref('friction_torque')}\n")
    assert reply.status == 3
    assert f"call fmi{fmi}EnterInitializationMode first" in reply.messages[-1]
    assert last(fmi, MADE + f"take real 0 {ref('load')}\n").values == [0.0, 100.0]


def test_event_mode_is_the_place_for_tunable_parameters():
    script = "call fmi3UpdateDiscreteStates\n" + putting(heat_capacity=50.0, load=7.0)
    script += taking(["friction_torque"]) + "call fmi3EnterStepMode\nstep 0 1e-3\n"
    script += "call fmi3EnterEventMode\nsave 0\ncall fmi3EnterStepMode\nstep 1e-3 1e-3\n"
    replies = run(3, toy_library(), EVENTS + script + "restore 0\ncall fmi3EnterStepMode\nend\n")
    assert all(r.status == 0 for r in replies)
    for wrong, first in (
        ("step 0 1e-3", "EnterStepMode"),
        ("call fmi3EnterEventMode", "EnterStep"),
        (putting(discs=3).strip(), "before the initialization"),
    ):
        reply = last(3, EVENTS + wrong + "\n")
        assert reply.status == 3 and first in reply.messages[-1]
    reply = last(3, BEGUN + "call fmi3UpdateDiscreteStates\n")
    assert reply.status == 3 and "call fmi3EnterEventMode first" in reply.messages[-1]
    reply = last(3, BEGUN + "call fmi3EnterEventMode\n")
    assert reply.status == 3 and "eventModeUsed = false" in reply.messages[-1]


@pytest.mark.parametrize("start", ["nan", "inf"])
def test_a_start_time_must_be_a_number(start):
    for fmi, command in ((2, f"setup {start}\n"), (3, f"enter {start}\n")):
        reply = last(fmi, MADE + command)
        assert reply.status == 3 and f"start time = {start} s" in reply.messages[0]


def test_status_questions_of_fmi_2_have_answers():
    stepped = BEGUN + "step 0 1e-3\n"
    assert last(2, stepped + "extra last-time\n").values == [1e-3]
    assert last(2, stepped + "extra terminated\n").values == [0.0]
    assert last(2, stepped + "step 0 -1\nextra step-status\n").values == [3.0]


def test_all_that_do_step_points_to_is_written_in_every_case():
    script = MADE + "step 0 1e-3\nenter 0\nleave\nstep 0 nan\nstep 0 1e-3\nextra pointers\n"
    assert last(3, script).values == [0.0]
    script = BEGUN + "step 0 1e-3\nstep 1e-3 0\nextra last-time\n"
    assert last(3, script).values == [1e-3]


def test_dependencies_of_fmi_3_are_those_of_the_list():
    torque = last(3, BEGUN + f"extra dependencies {ref('friction_torque')}\n")
    assert torque.values == [ref("load"), ref("speed")]
    assert last(3, BEGUN + f"extra dependencies {ref('energy')}\n").values == []
    assert last(3, BEGUN + f"extra dependencies {ref('load')}\n").status == 3


@both
@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda data: None, "missing"),
        (lambda data: data[:-1], "damaged"),
        (lambda data: data + b"0", "damaged"),
        (lambda data: data.replace(b"ToyClutch", b"ToyClutcH"), "damaged"),
        (lambda data: b"twpart0" + data[7:], "damaged"),
        (lambda data: summed(data[:8] + b"another build..." + data[24:-4]), "another build"),
    ],
)
def test_without_its_part_there_is_no_instance_and_the_folder_is_named(fmi, spoil, said, tmp_path):
    data = spoil((toy_library().parent / c_tables.PART).read_bytes())
    if data is not None:
        (tmp_path / c_tables.PART).write_bytes(data)
    script = f"make toy {GUID} 0\n"
    (reply,) = run(fmi, toy_library(), script, resources=tmp_path)
    assert reply.status == 3 and len(reply.messages) == 1
    assert f"part.bin in the folder {tmp_path} is" in reply.messages[0]
    assert said in reply.messages[0]


@both
@pytest.mark.parametrize("folder", ["file://", "file:", "/" * 5000])
def test_a_host_that_names_no_folder_is_refused_and_told_what_is_read_there(fmi, folder):
    (reply,) = run(fmi, toy_library(), f"make toy {GUID} 0\n", resources=folder)
    assert reply.status == 3 and len(reply.messages) == 1
    assert "names no folder of resources" in reply.messages[0]
    assert "the FMU's name and start values" in reply.messages[0]


@both
@pytest.mark.parametrize("scheme", ["", "file://", "FILE://", "File:", "file://localhost"])
def test_a_folder_of_any_length_is_taken_and_shown(fmi, scheme, tmp_path):
    """Over 1 023 bytes, by a URI whose scheme ignores case; the message shows how it ends."""
    folder = tmp_path.joinpath(*["a#b" * 60] * 7)
    folder.mkdir(parents=True)
    script = f"make toy {GUID} 0\n"
    where = scheme + (str(folder).replace("#", "%23") if scheme else str(folder))
    (reply,) = run(fmi, toy_library(), script, resources=where)
    assert reply.status == 3
    assert f"{'a#b' * 60}/{'a#b' * 60} is missing; unpack the FMU again" in reply.messages[0]
    shutil.copy(toy_library().parent / c_tables.PART, folder)
    (reply,) = run(fmi, toy_library(), script, resources=where)
    assert (reply.status, reply.messages) == (0, [])


def summed(data):
    return data + struct.pack("<I", zlib.crc32(data))
