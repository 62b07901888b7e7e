"""After initialization a native FMU takes no memory, no file and no lock, and fails without NaN.

The host in trap.c steps through walks, hostile values, failed steps, states and derivatives.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import needed
import pytest
from built import built_fmu
from sampling import sizes

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.stepper import unpack
from thrustwasher.model.registry import all_specs
from thrustwasher.native.binaries import _DYNSYM, _elf_symbols
from thrustwasher.study.realtime.walk import ranges

HERE = Path(__file__).parent
needs_gcc = pytest.mark.skipif(
    sys.platform != "linux" or not shutil.which("gcc"), reason="needs Linux with glibc, and gcc"
)
RUNGS = [(spec, rung) for spec in all_specs() for rung in spec.rungs]
SLOW = {"washer-field": 100, "washer-fine": 1000, "washer-map": 10}  # times the cost of others
IDS = [f"{spec.key}-{rung}" for spec, rung in RUNGS]
# Beside the rung: what else steps go through.
WAYS = {
    "washer-field": {"thermal_mode": 2},
    "clutch-field": {"input_course": 2},
    "gearmesh-field": {"thermal_mode": 2},
    "transmission-rigid": {"actuation": 2, "shaft_stiffness": 1e4, "shaft_damping": 10.0},
}
OTHERS = [pytest.param(i, WAYS[i], id=f"{i}-{'-'.join(WAYS[i])}") for i in WAYS]
# All that the library may ask of the C library; what takes memory or a file does so before a step.
LIBC = set("calloc free fopen fclose fread fgetc snprintf vsnprintf strtod atoi bcmp".split())
LIBC |= set("memcpy memset memcmp memmove memchr strcmp strncmp strlen strchr strncpy".split())
LIBM = set("acos asin atan atan2 cbrt ceil cos erf erfc exp expm1 fabs floor fmod hypot".split())
LIBM |= set("asinh log log10 log1p pow sin sincos sinh cosh sqrt tan tanh".split())
COMPILER = {"__stack_chk_fail", "__cxa_finalize", "__gmon_start__"}
COMPILER |= {"_ITM_deregisterTMCloneTable", "_ITM_registerTMCloneTable"}


@pytest.fixture(scope="session")
def host(tmp_path_factory):
    made = tmp_path_factory.mktemp("trap") / "trap"
    headers = Path(fmpy.__file__).parent / "c-code"
    flags = f"-O1 -std=gnu11 -Wall -Wextra -Werror -fno-builtin-malloc -rdynamic -I{headers}"
    command = ["gcc", *flags.split(), HERE / "trap.c", "-o", made, "-ldl", "-lm", "-lpthread"]
    subprocess.run(command, check=True, timeout=60)
    return made


def library(spec, fmi=2):
    folder = unpack(built_fmu(spec.name, fmi=fmi, local=True))
    return folder, folder / "binaries" / "linux64" / f"{spec.name}.so"


def script(spec, rung, n, also):
    """Return what trap.c reads."""
    folder, file = library(spec)
    guid = re.search(r'guid="(\w+)"', (folder / "modelDescription.xml").read_text("utf-8"))[1]
    shown, known = interface(spec), ranges()[spec.key]
    given = {"fidelity": list(spec.fidelities).index(rung) + 1, **also}
    lines = [file, guid, (folder / "resources").as_uri(), len(shown.inputs)]
    for v in shown.inputs:
        low, high, law = known.get(v.name, (v.start, v.start, "stay"))
        low = -high if law in ("signed", "either") else low
        lines += [f"{v.reference} {low!r} {high!r} {v.bounds[0]!r} {v.bounds[1]!r}"]
    lines.append(len(given))
    for v in shown.parameters:
        if v.name in given:
            kind = {"Real": "r", "Boolean": "b"}.get(v.type, "i")
            lines.append(f"{kind} {v.reference} {given[v.name]}")
    real = [v.reference for v in shown.outputs if v.type == "Real"]
    lines += [len(real), " ".join(map(str, real)), n]
    return "\n".join(map(str, lines))


def walked(host, spec, rung, n, also=()):
    """Return what trap.c counted in ``n`` steps of a rung."""
    n = max(20, n // SLOW.get(f"{spec.key}-{rung}", 1))
    done = subprocess.run(
        [host], input=script(spec, rung, n, dict(also)), capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    lines = [line.split() for line in done.stdout.splitlines()]
    return {words[0]: words[1:] for words in lines}


def judge(found, n):
    assert found["trapped"] == ["0", "none"]
    assert found["not_finite"] == ["0"]
    assert found["moved"] == ["0"], "outputs after a failed step are not those before it"
    assert int(found["failed"][0]) > 0 and int(found["messages"][0]) > 0


@needs_gcc
@sizes(2_000, 100_000)
@pytest.mark.parametrize(("spec", "rung"), RUNGS, ids=IDS)
def test_steps_of_a_rung_call_for_nothing_and_show_no_nan(host, spec, rung, n):
    judge(walked(host, spec, rung, n), n)


@needs_gcc
@sizes(2_000, 100_000)
@pytest.mark.parametrize(("name", "also"), OTHERS)
def test_steps_in_other_ways_call_for_nothing(host, name, also, n):
    spec, rung = RUNGS[IDS.index(name)]
    judge(walked(host, spec, rung, n, also), n)


@needs_gcc
def test_the_trap_catches(host, tmp_path):
    """A library that takes memory in its steps."""
    code = (HERE / "taker.c").read_text("utf-8")
    (tmp_path / "taker.c").write_text(code)
    headers = Path(fmpy.__file__).parent / "c-code"
    made = tmp_path / "taker.so"
    command = ["gcc", "-O1", "-shared", "-fPIC", f"-I{headers}", tmp_path / "taker.c", "-o", made]
    subprocess.run(command, check=True, timeout=60)
    text = f"{made} guid file:///tmp\n0\n0\n0\n10"
    done = subprocess.run([host], input=text, capture_output=True, text=True, check=True)
    assert "trapped 20 free" in done.stdout


@pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.fmi3)])
@pytest.mark.parametrize("spec", all_specs(), ids=lambda spec: spec.key)
def test_a_library_knows_no_lock_and_no_jump(spec, fmi):
    """What it asks for, by name: nothing of threads, no longjmp, no exit, no other memory."""
    if sys.platform != "linux":
        needed.missing("the library of this machine is no ELF file")
    (file,) = (library(spec, fmi)[0] / "binaries").rglob("*.so")
    asked = {n for n, _, home in _elf_symbols(file.read_bytes(), _DYNSYM) if n and home == 0}
    assert asked - LIBC - LIBM - COMPILER == set()
