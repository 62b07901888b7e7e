"""What may go into an FMU: libm and memset pass, everything else is named with cause and cure."""

import json
import subprocess
import sys
from pathlib import Path

import gate_rows
import llvmlite.binding as llvm
import pytest

from thrustwasher.errors import EnvironmentProblem
from thrustwasher.native import binaries
from thrustwasher.native.compiling import emit, gate
from thrustwasher.native.targets import TARGETS


@pytest.fixture(scope="module")
def judgements(tmp_path_factory):
    """What the gate says of each kernel in gate_rows, from one process with numba's settings."""
    surroundings = emit.environment(str(tmp_path_factory.mktemp("numba")))
    surroundings["PYTHONPATH"] = str(Path(__file__).parents[3])
    command = [sys.executable, gate_rows.__file__]
    run = subprocess.run(command, capture_output=True, text=True, env=surroundings, timeout=500)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


@pytest.mark.parametrize("row", gate_rows.PASSED, ids=lambda row: row.__name__)
def test_numbers_loops_and_libm_pass(row, judgements):
    assert judgements[row.__name__] == ""


@pytest.mark.parametrize("row", gate_rows.REFUSED, ids=lambda row: row.__name__)
def test_what_needs_more_is_refused_with_kernel_symbol_and_cause(row, judgements):
    said = judgements[row.__name__]
    assert said.startswith("rows.derive is not self-contained, it needs ")
    assert gate_rows.REFUSED[row] in said and "not on the list" not in said


DOUBLE = (
    "define double @tw_step(double %x) {{\n %y = call double @{0}(double %x)\n ret double %y\n}}"
)


def compiled(text, platform):
    """Return (module, object file) of LLVM text for a platform."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    module = llvm.parse_assembly(text)
    module.triple = TARGETS[platform].triple
    machine = llvm.Target.from_triple(module.triple).create_target_machine(
        reloc="static" if platform == "wasm32" else "pic", codemodel="default"
    )
    return module, bytes(machine.emit_object(module))


@pytest.mark.parametrize("platform", TARGETS)
def test_the_object_file_is_read_too_on_every_platform(platform):
    text = DOUBLE.format("secret") + "\ndeclare double @secret(double)\n"
    _, code = compiled(text, platform)
    assert binaries.undefined(code) == {"secret"}
    with pytest.raises(EnvironmentProblem, match=r"k\.step .* it needs secret \(not on the list"):
        gate.check_object(code, "k.step")


@pytest.mark.parametrize("platform", TARGETS)
def test_an_intrinsic_that_becomes_a_call_of_libm_passes(platform):
    text = DOUBLE.format("llvm.exp.f64") + "\ndeclare double @llvm.exp.f64(double)\n"
    module, code = compiled(text, platform)
    assert binaries.undefined(code) == {"exp"}
    gate.check_module(module, "k")
    gate.check_object(code, "k")


def test_instructions_of_one_kind_of_machine_are_refused():
    name = "llvm.x86.rdtsc"
    text = f"define i64 @tw_step() {{\n %y = call i64 @{name}()\n ret i64 %y\n}}\n"
    module = llvm.parse_assembly(f"{text}declare i64 @{name}()\n")
    with pytest.raises(EnvironmentProblem, match=r"llvm\.x86\.rdtsc .* one kind of machine"):
        gate.check_module(module, "k")


def test_a_variable_that_is_only_declared_is_refused():
    text = "@outside = external global i64\ndefine ptr @tw_step() {\n ret ptr @outside\n}\n"
    with pytest.raises(EnvironmentProblem, match="it needs outside"):
        gate.check_module(llvm.parse_assembly(text), "k")


def test_an_unknown_kind_of_object_is_said():
    with pytest.raises(EnvironmentProblem, match="neither ELF"):
        binaries.undefined(b"garbage that is no object file")
