"""``--sources``: the folder compiles anywhere and runs as the libraries do."""

import shutil
import subprocess
import zipfile
from functools import cache

import needed
import numpy as np
import pytest
from built import HEADERS, STRICT, compiled_fmu, packed, tool, with_sources
from lxml import etree

from thrustwasher.errors import EnvironmentProblem, ParameterError
from thrustwasher.fmu.build import build, validate
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.documentation.reference_results import input_rows
from thrustwasher.fmu.package.model_sources import source_folder
from thrustwasher.fmu.shell import c_sources
from thrustwasher.fmu.stepper import Instance
from thrustwasher.model.registry import all_specs, find_spec
from thrustwasher.native import binaries
from thrustwasher.native.binaries import _DYNSYM, _elf_symbols
from thrustwasher.native.compiling import portable

FAST = "OilSump"
NAMES = [spec.name for spec in all_specs(helpers=True)]
SAME = 1e-12  # relative to the largest output of a unit
STEPS = 200
each_fmi = pytest.mark.parametrize("fmi", [2, pytest.param(3, marks=pytest.mark.fmi3)])
each_model = pytest.mark.parametrize(
    "name", [FAST, *(pytest.param(n, marks=pytest.mark.slow) for n in NAMES if n != FAST)]
)


def unpacked(fmu, folder):
    with zipfile.ZipFile(fmu) as zipped:
        zipped.extractall(folder)
    return folder


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.slow
def test_the_functions_have_their_plain_names_with_any_version_of_the_headers(fmi, tmp_path):
    """Headers before 2.0.4 put the prefix in front whatever else is said."""
    own = unpacked(with_sources(FAST, fmi), tmp_path / "unpacked")
    for header in HEADERS.glob(f"fmi{fmi}*.h"):
        text = header.read_text().replace("_OVERRIDE_FUNCTION_PREFIX", "_UNKNOWN_TO_ALL")
        (tmp_path / header.name).write_text(text)
    (library,) = (own / "binaries").rglob("*.so")
    flags = ["-shared", "-fPIC", f"-DFMI{fmi}_OVERRIDE_FUNCTION_PREFIX", f"-I{tmp_path}"]
    files = sorted((own / "sources").glob("*.c"))
    line = [tool("gcc"), "-O0", "-std=c99", *flags, "-o", library, *files, "-lm"]
    subprocess.run(list(map(str, line)), check=True)
    assert f"fmi{fmi}GetVersion" in binaries.read(library.read_bytes()).exports


@pytest.mark.slow
def test_the_sources_of_a_model_without_maps_read_no_file(tmp_path):
    """Its name, identifier, start values and ranges are compiled in; resources may be empty."""
    fmu = compiled_fmu(FAST, 2, "gcc")
    folder = unpacked(fmu, tmp_path)
    (library,) = (folder / "binaries").rglob("*.so")
    asked = {name for name, _, home in _elf_symbols(library.read_bytes(), _DYNSYM) if not home}
    assert not asked & {"fopen", "fread", "fclose", "fgetc"}
    shutil.rmtree(folder / "resources")
    again = packed(folder, folder / "again.fmu")
    assert (run(again, FAST, "lumped") == run(fmu, FAST, "lumped")).all()


@cache
def points(name):
    """Return the inputs along the model's usual profile, and the step size [s]."""
    spec = find_spec(name)
    profile, (stop, h) = np.array(input_rows(spec)), interface(spec).experiment
    n = min(round(stop / h), STEPS)
    times = stop / n * np.arange(n)
    columns = [np.interp(times, profile[:, 0], values) for values in profile.T[1:]]
    return np.reshape(columns, (len(columns), n)).T.tolist(), h


def run(fmu, name, level):
    """Return the outputs along the usual profile, after each step, and derivatives."""
    rows, (inputs, h) = [], points(name)
    with Instance(fmu, parameters={"fidelity": level}) as model:
        reals = find_spec(name).real_outputs
        model.initialize(0.0, dict(zip(model.input_names, inputs[0], strict=True)))
        for i, values in enumerate(inputs):
            model.set_inputs(values)
            model.step(i * h, h)
            rows.append(model.outputs())
        if model.gives_derivatives:
            ones = [1.0] * len(model.input_names)
            slopes = model.directional_derivative(reals, model.input_names, ones)
            rows.append([*slopes, *rows[-1][len(slopes) :]])
    return np.array(rows)


def distance(name, found, wanted):
    """Return the largest difference, relative to the largest output of the same unit.

    A mean power is a difference of energies over a step: they count as powers too. An advised step
    is made of small differences, and an advice: a thousand times as much is allowed.
    """
    shown = interface(find_spec(name)).outputs
    units = [v.unit for v in shown]
    largest = {u: np.abs(wanted[:, [u == x for x in units]]).max() for u in units}
    energy = largest.get("J", 0.0) / points(name)[1]
    largest["W"] = max(largest.get("W", 0.0), energy)
    scale = np.array([largest[u] or 1.0 for u in units])
    scale[[v.name == "advised_step" for v in shown]] *= 1e3
    return (np.abs(found - wanted).max(axis=0) / scale).max()


# The kernels' C is the same in both versions of FMI, whose own C one model shows.
BY_COMPILER = [(name, 2, compiler) for name in NAMES for compiler in ("gcc", "clang")]
IN_FMI_3 = [pytest.param(FAST, 3, c, marks=pytest.mark.fmi3) for c in ("gcc", "clang")]


@pytest.mark.parametrize(("name", "fmi", "compiler"), [*BY_COMPILER, *IN_FMI_3])
@pytest.mark.slow
def test_what_a_compiler_makes_of_them_steps_as_the_library_does(name, fmi, compiler):
    fmu, own = with_sources(name, fmi), compiled_fmu(name, fmi, compiler)
    for level in find_spec(name).levels:
        assert distance(name, run(own, name, level), run(fmu, name, level)) < SAME, level


@pytest.mark.slow
@pytest.mark.parametrize("options", [["-O0"], ["-O3", "-std=gnu99", "-march=haswell"]])
def test_options_of_the_compiler_change_no_number(options):
    if "linux64" not in needed.linkable():
        pytest.skip("the options are those of Linux on x86-64")
    (level, *_) = find_spec(FAST).fidelities
    usual, other = (compiled_fmu(FAST, 2, "gcc", *more) for more in ((), options))
    assert distance(FAST, run(other, FAST, level), run(usual, FAST, level)) == 0.0


def test_instances_side_by_side_do_not_see_each_other():
    own = compiled_fmu(FAST, 2, "gcc")
    inputs, h = points(FAST)
    with Instance(own) as alone, Instance(own) as one, Instance(own) as two:
        for model in (alone, one, two):
            model.initialize()
        for i, values in enumerate(inputs[:20]):
            for model, factor in ((one, 1.0), (two, 1.1)):
                model.set_inputs([factor * x for x in values])
                model.step(i * h, h)
        for i, values in enumerate(inputs[:20]):
            alone.set_inputs(values)
            alone.step(i * h, h)
        assert alone.outputs() == one.outputs() != two.outputs()


def test_all_names_that_a_linker_sees_are_the_models_or_the_standards():
    own = compiled_fmu(FAST, 2, "gcc")
    (library,) = (own.parent / "unpacked").rglob("*.so")
    shown = subprocess.run(
        [tool("nm"), "-g", "--defined-only", library], capture_output=True, text=True, check=True
    )
    names = [line.split()[-1] for line in shown.stdout.splitlines()]
    assert len(names) > 80
    assert [n for n in names if not n.startswith((f"{FAST}_", "fmi2", "_"))] == []


@each_model
def test_nothing_is_needed_beyond_the_c_library(name, tmp_path):
    folder = unpacked(with_sources(name, 2), tmp_path) / "sources"
    found = {
        line.split()[1].strip('<>"')
        for file in folder.iterdir()
        for line in file.read_text().splitlines()
        if line.startswith("#include")
    }
    standard = "fenv.h float.h math.h stdarg.h stddef.h stdint.h stdio.h stdlib.h string.h".split()
    own = {file.name for file in folder.iterdir()}
    allowed = own | {*standard, "fmi2Functions.h", "wchar.h"}  # the last on Windows
    assert found <= allowed


def test_both_descriptions_list_every_file_that_is_compiled(tmp_path):
    two = unpacked(with_sources(FAST, 2), tmp_path / "2")
    three = unpacked(with_sources(FAST, 3), tmp_path / "3")
    listed = {
        2: etree.parse(two / "modelDescription.xml").xpath("//SourceFiles/File/@name"),
        3: etree.parse(three / "sources" / "buildDescription.xml").xpath("//SourceFile/@name"),
    }
    shell = {f.name for f in (source_folder() / "shell").glob("*.c")} - {"library_file.c"}
    for fmi, folder in ((2, two), (3, three)):
        other = f"fmi{5 - fmi}"
        there = {f.name for f in (folder / "sources").glob("*.c")}
        assert set(listed[fmi]) == there
        made = {"module.c", "model.c", "part.c"}
        assert there - made == {n for n in shell if not n.startswith(other)}


@pytest.mark.slow
@each_fmi
def test_fmpys_check_finds_nothing_and_its_compiler_runs(fmi, tmp_path):
    from fmpy.build import build_platform_binary

    fmu = with_sources(FAST, fmi)
    assert validate(fmu) == []
    if not shutil.which("cmake"):
        pytest.skip("install the Debian package cmake")
    own = unpacked(fmu, tmp_path / "unpacked")
    (library,) = (own / "binaries").rglob("*.so")
    library.unlink()
    build_platform_binary(own, all_warnings=True)
    made, (level, *_) = packed(own, tmp_path / fmu.name), find_spec(FAST).fidelities
    assert distance(FAST, run(made, FAST, level), run(fmu, FAST, level)) < SAME


def test_those_of_all_models_are_shipped_and_fresh():
    specs = all_specs(helpers=True, alone=True)
    stale = [s.name for s in specs if not c_sources.is_shipped(s.kernel)]
    assert stale == [], "first: python -m lab.ship_all"


def test_they_are_of_native_fmus_only(tmp_path):
    with pytest.raises(ParameterError, match="native"):
        build([FAST], target="python", c_sources=True, out=tmp_path)


def test_without_wasm2c_it_is_said_what_to_install(monkeypatch):
    monkeypatch.setattr(portable.shutil, "which", lambda _: None)
    with pytest.raises(EnvironmentProblem, match="wabt"):
        portable._by_wasm2c(b"", "any")


BODY = """static u32 w2c_tw_step_generic(Z_k_instance_t* instance, u32 w2c_p0) {
  u32 w2c_i0;
  w2c_i0 = instance->w2c_g0;
  w2c_i1 = 48u;
  w2c_i0 -= w2c_i1;
  %s
  return w2c_i0;
}
"""


def test_the_stack_that_kernels_take_is_known():
    leaf = "static void w2c_f1(Z_k_instance_t* instance) {\n  w2c_f2(instance);\n}\n"
    end = BODY.replace("tw_step_generic", "f2") % ""
    text = "\n".join([BODY % "w2c_f1(instance);", leaf, end])
    assert portable.stack_of(text, ["tw_step"]) == 48 + 48 + portable.LOW
    with pytest.raises(EnvironmentProblem, match="calls itself"):
        portable.stack_of(BODY % "w2c_tw_step_generic(instance, w2c_p0);", ["tw_step"])


def test_an_instruction_that_the_header_lacks_is_named():
    text = "  instance->w2c_g0 = 64u;\n  instance->w2c___heap_base = 64u;\n"
    with pytest.raises(EnvironmentProblem, match="i32_new"):
        portable.translated(text + BODY % "w2c_i0 = i32_new(w2c_i0);", ["tw_step"], "u32 i32_old")


CASES = """#include "wasm.h"
static union { Own own; u8 bytes[64]; } memory;
static u8 *const m = memory.bytes;
static int traps(u64 x) {
    u32 was = memory.own.trapped;
    (void)x;
    memory.own.trapped = 0;
    return (int)was;
}
int main(void) {
    volatile double none = 0.0; none /= none;
    return !(I32_CLZ(0) == 32 && I64_CLZ(1) == 63 && I32_CTZ(8) == 3 && I64_CTZ(0) == 64
        && I32_POPCNT(0xf0) == 4 && I32_ROTL(0x80000001u, 1) == 3 && I64_ROTR(1ull, 1) == 1ull << 63
        && I32_TRUNC_SAT_S_F64(none) == 0 && I32_TRUNC_SAT_S_F64(-1e99) == 0x80000000u
        && I64_TRUNC_SAT_S_F64(1e99) == (u64)INT64_MAX && I32_TRUNC_SAT_U_F64(-3.5) == 0
        && I32_TRUNC_SAT_S_F64(-3.5) == (u32)-3
        && I32_DIV_S((u32)-7, 2u) == (u32)-3 && I64_REM_S((u64)-7, 2ull) == (u64)-1
        && !traps(0) && I32_REM_S((u32)INT32_MIN, (u32)-1) == 0 && !traps(0)
        && traps(I32_DIV_S((u32)INT32_MIN, (u32)-1)) && traps(I64_DIV_S(1ull, 0ull))
        && traps(DIV_U((u64)1, (u64)0)) && DIV_U(7u, 2u) == 3 && REM_U(7u, 4u) == 3);
}
"""


def test_instructions_do_what_webassembly_says(tmp_path):
    (tmp_path / "cases.c").write_text(CASES)
    line = [tool("gcc"), *STRICT, "-Wno-unused-function", f"-I{source_folder() / 'portable'}"]
    subprocess.run([*line, "cases.c", "-o", "cases", "-lm"], cwd=tmp_path, check=True)
    subprocess.run([tmp_path / "cases"], check=True)


def test_a_machine_with_the_other_byte_order_is_refused(tmp_path):
    text = '#undef __BYTE_ORDER__\n#define __BYTE_ORDER__ 4321\n#include "wasm.h"\n'
    (tmp_path / "big.c").write_text(text)
    line = [tool("gcc"), "-c", f"-I{source_folder() / 'portable'}", "big.c"]
    done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode and "little-endian" in done.stderr
