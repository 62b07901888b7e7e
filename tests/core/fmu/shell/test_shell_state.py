"""FMU states: complete, the same in a fresh process, and checked in full before they are used."""

import struct
import zlib

import pytest
from shell_runs import BEGUN, MADE, SANITIZED, last, needs_gcc, putting, run, taking, toy_library
from toy.spec import SPEC as TOY

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.shell import c_tables

pytestmark = needs_gcc
both = pytest.mark.parametrize("fmi", [2, 3])
ALL = taking([s.name for s in (*TOY.inputs, *TOY.outputs)])
CHECK = 80  # place of the checksum
HEAD = CHECK + 4 + 13 * 4


def steps(first, n):
    return "".join(
        putting(load=300.0 + 10.0 * i, speed=900.0 - i) + f"step {i * 1e-3!r} 1e-3\n" + ALL
        for i in range(first, first + n)
    )


def values(replies):
    return [r.values for r in replies if r.values]


@both
def test_a_fresh_process_goes_on_from_the_bytes_to_the_bit(fmi, tmp_path):
    file = tmp_path / "state"
    library = toy_library()
    before = BEGUN + steps(0, 5) + putting(load=77.0) + f"save 0\nwrite 0 {file}\nforget 0\n"
    whole = values(run(fmi, library, before + ALL + steps(5, 20)))[5 * 4 :]
    fresh = run(fmi, library, MADE + f"read 0 {file}\nrestore 0\nforget 0\n" + ALL + steps(5, 20))
    assert all(r.status == 0 for r in fresh)
    assert values(fresh) == whole


@both
def test_no_changed_byte_and_no_missing_one_is_taken_for_a_state(fmi):
    script = BEGUN + "step 0 1e-3\nsave 0\nfuzz 0\n"
    refused, taken = run(fmi, toy_library(SANITIZED), script, flags=SANITIZED)[-1].values
    assert taken == 0 and refused > 1000


@both
def test_numbers_that_no_run_leaves_behind_do_no_harm_with_a_right_checksum(fmi, tmp_path):
    library = toy_library(SANITIZED)
    run(
        fmi,
        library,
        BEGUN + f"step 0 1e-3\nsave 0\nwrite 0 {tmp_path}/good\nforget 0\n",
        flags=SANITIZED,
    )
    good = (tmp_path / "good").read_bytes()
    script = BEGUN
    for place in range(HEAD, len(good), 4):
        for word in (0xFFFFFFFF, 0x7FF80000, 99):
            bad = bytearray(good)
            bad[place : place + 4] = struct.pack("<I", word)
            bad[CHECK : CHECK + 4] = bytes(4)
            bad[CHECK : CHECK + 4] = struct.pack("<I", zlib.crc32(bad))
            file = tmp_path / f"{place}-{word}"
            file.write_bytes(bad)
            script += f"read 0 {file}\nrestore 0\n{ALL}step 0 1e-3\n{ALL}forget 0\n"
    replies = run(fmi, library, script + "drop\n", flags=SANITIZED)
    assert all(r.status in (0, 3) for r in replies)
    assert all(abs(x) < 1e300 for r in replies for x in r.values)
    refused = [r for r in replies if any("no run leaves behind" in m for m in r.messages)]
    assert len(refused) > 30


@both
def test_states_of_other_builds_and_pointers_that_are_none_are_refused(fmi, tmp_path):
    other = "f" * 32
    script = f"make toy {other} 0\nenter 0\nleave\nsave 0\nwrite 0 {tmp_path}/other\n"
    (tmp_path / c_tables.PART).write_bytes(c_tables.part_file(interface(TOY), other))
    run(fmi, toy_library(), script, resources=tmp_path)
    reply = last(fmi, BEGUN + f"read 0 {tmp_path}/other\n")
    assert reply.status == 3 and "bytes of another model or version" in reply.messages[-1]
    reply = last(fmi, BEGUN + "restore 0\n")
    assert reply.status == 3 and "none, allowed: one that was got before" in reply.messages[-1]
    assert last(fmi, BEGUN + "forget 0\n").status == 0


@both
def test_a_state_that_is_got_again_is_written_over_and_a_freed_one_is_gone(fmi):
    script = BEGUN + "save 0\n" + putting(load=7.0) + "step 0 1e-3\nsave 0\nreset\nrestore 0\n"
    assert last(fmi, script + taking(["load"])).values == [7.0]
    assert last(fmi, script + "forget 0\nforget 0\nrestore 0\n").status == 3


@both
@pytest.mark.parametrize(
    "wrong",
    [
        "forget-pointer 0",
        "restore-address 0",
        "alias 1 0\nforget 0\nforget 1",
        "alias 1 0\nforget 0\nrestore 1",
        "alias 1 0\nforget 0\nsave 1",
    ],
)
def test_a_pointer_that_is_no_living_state_is_refused_unread(fmi, wrong):
    """A host hands over the state in place of its address, its address in its place, or one that
    was freed: with the sanitizer a pointer that is followed would end the process."""
    script = BEGUN + "step 0 1e-3\nsave 0\n" + wrong + "\n"
    reply = run(fmi, toy_library(SANITIZED), script + "forget 0\n", flags=SANITIZED)[-2]
    assert reply.status == 3
    assert "a pointer that this FMU has not given or has freed" in reply.messages[-1]
