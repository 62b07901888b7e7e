"""After initialization a native FMU takes no memory, no file and no lock, and fails without NaN.

The host in trap.c steps through walks, hostile values, failed steps, states and derivatives, and
measures the stack of the steps: of the library, and of the C sources compiled by gcc.
"""

import re
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

import needed
import pytest
from built import HEADERS, built_fmu, compiled_fmu
from sampling import sizes

from lab.realtime.host import Host
from lab.realtime.walk import ranges
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.package.model_sources import source_folder
from thrustwasher.fmu.shell.c_tables import sources
from thrustwasher.fmu.stepper import unpack
from thrustwasher.model.registry import all_specs
from thrustwasher.native.binaries import _DYNSYM, _elf_symbols

HERE = Path(__file__).parent
needs_gcc = pytest.mark.skipif(
    sys.platform != "linux" or not shutil.which("gcc"), reason="needs Linux with glibc, and gcc"
)
LEVELS = [(spec, level) for spec in all_specs() for level in spec.levels]
SLOW = {"washer-field": 100, "washer-fine": 1000, "washer-map": 10}  # times the cost of others
IDS = [f"{spec.key}-{level}" for spec, level in LEVELS]
# Next to the level: what else steps go through.
WAYS = {
    "washer-field": {"thermal_mode": 2},
    "clutch-field": {"input_profile": 2},
    "gearmesh-field": {"thermal_mode": 2},
    "transmission-rigid": {"actuation": 2, "shaft_stiffness": 1e4, "shaft_damping": 10.0},
}
OTHERS = [pytest.param(i, WAYS[i], id=f"{i}-{'-'.join(WAYS[i])}") for i in WAYS]
# All that the library may ask of the C library; what takes memory or a file does so before a step.
LIBC = set("calloc free fopen fclose fread fgetc snprintf vsnprintf strtod atoi bcmp".split())
LIBC |= set("memcpy memset memcmp memmove memchr strcmp strncmp strlen strchr strncpy".split())
LIBC |= {"dladdr"}  # weak: where the library itself lies
COMPILER = {"__stack_chk_fail", "__cxa_finalize", "__gmon_start__"}
COMPILER |= {"_ITM_deregisterTMCloneTable", "_ITM_registerTMCloneTable"}
# Bytes of stack that steps may take, failed ones and their messages among them.
STACK = 16 * 1024
WASHER_STACK = 64 * 1024  # in the library, whose compiled kernels have large frames
IN_SHORT = {"sump-lumped"}  # the rest of the C sources takes a minute to write and compile
IN_C = [
    pytest.param(*r, id=i, marks=() if i in IN_SHORT else pytest.mark.slow)
    for r, i in zip(LEVELS, IDS, strict=True)
]


def of_sources(name):
    """Return the folder and the library of an FMU that is compiled from its C sources."""
    folder = unpack(compiled_fmu(name, 2, "gcc"))
    (library,) = (folder / "binaries").rglob("*.so")
    return folder, library


@pytest.fixture(scope="session")
def host(tmp_path_factory):
    made = tmp_path_factory.mktemp("trap") / "trap"
    flags = f"-O1 -std=gnu11 -Wall -Wextra -Werror -fno-builtin-malloc -rdynamic -I{HEADERS}"
    command = ["gcc", *flags.split(), HERE / "trap.c", "-o", made, "-ldl", "-lm", "-lpthread"]
    subprocess.run(command, check=True, timeout=60)
    return made


def library(spec, fmi=2):
    folder = unpack(built_fmu(spec.name, fmi=fmi, local=True))
    return folder, folder / "binaries" / "linux64" / f"{spec.name}.so"


def script(spec, level, n, also, found):
    """Return what trap.c reads; ``found``: folder and library of the FMU."""
    folder, file = found
    guid = re.search(r'guid="(\w+)"', (folder / "modelDescription.xml").read_text("utf-8"))[1]
    shown, known = interface(spec), ranges()[spec.key]
    given = {"fidelity": list(spec.fidelities).index(level) + 1, **also}
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


def walked(host, spec, level, n, also=(), found=None):
    """Return what trap.c counted in ``n`` steps of a level."""
    n = max(20, n // SLOW.get(f"{spec.key}-{level}", 1))
    text = script(spec, level, n, dict(also), found or library(spec))
    done = subprocess.run([host], input=text, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    lines = [line.split() for line in done.stdout.splitlines()]
    return {words[0]: words[1:] for words in lines}


@cache
def walk_of(host, name):
    """Return what trap.c counted in many steps of a level, of which there are several claims."""
    return walked(host, *LEVELS[IDS.index(name)], 100_000)


def judge(found):
    assert found["trapped"] == ["0", "none"]
    assert found["not_finite"] == ["0"]
    assert found["moved"] == ["0"], "outputs after a failed step are not those before it"
    assert int(found["failed"][0]) > 0 and int(found["messages"][0]) > 0


@needs_gcc
@pytest.mark.parametrize("name", IDS)
@pytest.mark.slow
def test_steps_of_a_level_call_for_nothing_and_show_no_nan(host, name):
    judge(walk_of(host, name))


@needs_gcc
@sizes(2_000, 100_000)
@pytest.mark.parametrize(("name", "also"), OTHERS)
def test_steps_in_other_ways_call_for_nothing(host, name, also, n):
    spec, level = LEVELS[IDS.index(name)]
    judge(walked(host, spec, level, n, also))


@needs_gcc
@pytest.mark.parametrize("name", IDS)
@pytest.mark.slow
def test_a_step_takes_little_stack(host, name):
    """The washer's kernel alone has a frame of 25 kB in the library."""
    at_start, in_steps = map(int, walk_of(host, name)["stack"])
    most = WASHER_STACK if name.startswith("washer") else STACK
    assert 0 < at_start <= most and 0 < in_steps <= most


@needs_gcc
@pytest.mark.parametrize(("spec", "level"), IN_C)
@pytest.mark.slow
def test_a_step_of_the_c_sources_takes_little_stack(host, spec, level):
    """The washer too: most of its stack lies in the instance."""
    found = walked(host, spec, level, 2_000, found=of_sources(spec.name))
    at_start, in_steps = map(int, found["stack"])
    assert 0 < at_start <= STACK and 0 < in_steps <= STACK


@needs_gcc
@sizes(2_000, 20_000)
@pytest.mark.parametrize("also", [{"outside_map": 1}, {"outside_map": 2}], ids=["hold", "refuse"])
def test_the_map_alone_takes_3_mb_and_little_stack_and_calls_for_nothing(host, also, n):
    """Also outside its box, where the path's hostile values are."""
    fmu = built_fmu("ThrustWasher", local=True, fidelity="map")
    (spec,) = [s for s in all_specs(alone=True) if s.kernel.endswith(".alone")]
    found = unpack(fmu), unpack(fmu) / "binaries" / "linux64" / "ThrustWasher.so"
    walk = walked(host, spec, "map", 10 * n, also, found)
    judge(walk)
    assert all(0 < int(bytes_) <= STACK for bytes_ in walk["stack"])
    with Host(fmu, interface(spec), {}) as alone:
        assert alone.memory() <= 3_000_000


@needs_gcc
@pytest.mark.parametrize("spec", all_specs(), ids=lambda spec: spec.key)
def test_the_command_knows_the_memory_of_an_instance(spec, tmp_path):
    """``sizeof`` of the shell's own structure; the C library rounds up, to a page at most."""
    for name, text in sources(interface(spec)).items():
        (tmp_path / name).write_text(text)
    program = '#include "shell.h"\n#include <stdio.h>\n'
    program += 'int main(void) { printf("%zu", sizeof(Instance)); return 0; }\n'
    (tmp_path / "size.c").write_text(program)
    shell, made = source_folder() / "shell", tmp_path / "size"
    command = ["gcc", f"-I{tmp_path}", f"-I{shell}", tmp_path / "size.c", "-o", made]
    subprocess.run(command, check=True, timeout=60)
    size = int(subprocess.run([made], capture_output=True, text=True, check=True).stdout)
    with Host(built_fmu(spec.name, local=True), interface(spec), {}) as host:
        assert size <= host.memory() < size + (4096 if size > 65536 else 32)
    if spec.key != "washer":
        assert size <= (92 if spec.key == "train" else 64) * 1024


@needs_gcc
def test_the_trap_catches(host, tmp_path):
    """A library that takes memory in its steps, and much stack."""
    code = (HERE / "taker.c").read_text("utf-8")
    (tmp_path / "taker.c").write_text(code)
    made = tmp_path / "taker.so"
    command = ["gcc", "-O1", "-shared", "-fPIC", f"-I{HEADERS}", tmp_path / "taker.c", "-o", made]
    subprocess.run(command, check=True, timeout=60)
    text = f"{made} guid file:///tmp\n0\n0\n0\n10"
    done = subprocess.run([host], input=text, capture_output=True, text=True, check=True)
    assert "trapped 20 free" in done.stdout
    assert int(re.search(r"stack \d+ (\d+)", done.stdout)[1]) >= 20_000


@pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.fmi3)])
@pytest.mark.parametrize("spec", all_specs(), ids=lambda spec: spec.key)
def test_a_library_knows_no_lock_and_no_jump(spec, fmi):
    """What it asks for, by name: nothing of threads, no longjmp, no mathematics."""
    if sys.platform != "linux":
        needed.missing("the library of this machine is no ELF file")
    (file,) = (library(spec, fmi)[0] / "binaries").rglob("*.so")
    asked = {n for n, _, home in _elf_symbols(file.read_bytes(), _DYNSYM) if n and home == 0}
    assert asked - LIBC - COMPILER == set()
