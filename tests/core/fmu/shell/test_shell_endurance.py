"""Memory: flat over many instances, clean under valgrind; instances know nothing of each other."""

import shutil
import subprocess

import pytest
from shell_runs import (
    BEGUN,
    GUID,
    last,
    model_library,
    needs_gcc,
    needs_linux,
    putting,
    run,
    taking,
    threads,
    toy_library,
)
from toy.spec import SPEC as TOY

from thrustwasher.fmu.description.interface import interface
from thrustwasher.model.registry import find_spec

both = pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.fmi3)])
needs_valgrind = pytest.mark.skipif(
    not shutil.which("valgrind"), reason="needs valgrind (Debian package valgrind)"
)
VALGRIND = (
    "valgrind -q --leak-check=full --show-leak-kinds=all --errors-for-leak-kinds=all "
    "--error-exitcode=7"
).split()


@needs_gcc
@both
def test_ten_thousand_instances_leave_no_memory_behind(fmi):
    reply = last(fmi, f"cycle {GUID} 10000\n")
    assert reply.status == 0 and reply.values[0] <= 512.0  # [kB]: less than 60 bytes each


def everything(spec):
    """Return a script that uses every part of the shell on a model, and leaves nothing behind."""
    inputs = {s.name: s.start or 0.0 for s in spec.inputs}
    real = [v for v in interface(spec).variables if v.type == "Real"]
    outputs = [v.reference for v in real if v.causality == "output"]
    known = [v.reference for v in real if v.causality == "input"]
    all_values = taking([v.name for v in interface(spec).variables], spec)
    script = BEGUN + putting(spec, **inputs) + all_values
    for i in range(3):
        script += f"step {i * 1e-3!r} 1e-3\n" + all_values
    if known:
        script += f"put real {known[0]} nan\nstep 3e-3 1e-3\n" + putting(spec, **inputs)
        script += f"derive {outputs[0]} {known[0]} 1\nadjoint {known[0]} {outputs[0]} 1\n"
    script += "save 0\nwrite 0 /dev/null\nstep 3e-3 1e-3\nrestore 0\nsave 0\nread 1 /dev/null\n"
    return script + "forget 0\nreset\nenter 0\nleave\nend\ndrop\n"


@needs_gcc
@needs_valgrind
@both
@pytest.mark.slow
def test_valgrind_finds_nothing_in_the_shell(fmi):
    script = (
        everything(TOY) + BEGUN + putting(inner_radius=0.2) + "save 0\nfuzz 0\nforget 0\ndrop\n"
    )
    replies = run(fmi, toy_library(("-O1", "-g")), script, wrap=VALGRIND)
    assert replies[-1].status == 0


@needs_linux
@needs_valgrind
@pytest.mark.parametrize("model", ["clutch", pytest.param("gearmesh", marks=pytest.mark.slow)])
def test_valgrind_finds_nothing_in_the_models(model):
    replies = run(2, model_library(model), everything(find_spec(model)), wrap=VALGRIND)
    assert [r.status for r in replies][-7:] == [3, 0, 0, 0, 0, 0, 0]


def job(spec, library, n):
    inputs = [v for v in interface(spec).variables if v.causality == "input"]
    outputs = [v for v in interface(spec).variables if v.causality == "output" and v.type == "Real"]
    ranges = [f"{v.reference} {v.low!r} {v.high!r}" for v in inputs]
    parts = [library, GUID, n, len(inputs), *ranges, len(outputs), *(v.reference for v in outputs)]
    return " ".join(map(str, parts)) + "\n"


@needs_linux
def test_threads_and_other_fmus_in_the_process_change_no_bit():
    jobs = job(TOY, toy_library(), 3000)
    for model in ("clutch", "gearmesh", "transmission"):
        jobs += job(find_spec(model), model_library(model), 200)
    done = subprocess.run(
        [threads()], input=jobs, env={}, capture_output=True, text=True, timeout=300, check=True
    )
    pairs = [line.split() for line in done.stdout.splitlines()]
    assert len(pairs) == 8 and len({alone for alone, _ in pairs}) == 8
    assert all(alone == beside for alone, beside in pairs)
