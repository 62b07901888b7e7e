"""What a built library needs and shows, and that the same sources give the same bytes."""

import json
import re
import shutil
import struct
import subprocess
import sys
import threading
from dataclasses import asdict
from pathlib import Path

import needed
import pytest
from built import look_for_linkers_again
from kernel_files import ROOT, kernel_files
from kernel_runs import MODELS

from thrustwasher.errors import EnvironmentProblem, ParameterError
from thrustwasher.fmu.package.model_sources import PACKAGE
from thrustwasher.fmu.shell import call_table, platform_libraries
from thrustwasher.model.registry import find_spec
from thrustwasher.native import binaries, digest, link, mathematics, shipped
from thrustwasher.native.compiling import callbacks, emit, gate, lean
from thrustwasher.native.entries import called_modules
from thrustwasher.native.library import TABLE
from thrustwasher.native.targets import GLIBC, PLATFORMS

TOY = Path(__file__).parents[1] / "fmu" / "toy"


EXPORTS = {TABLE, *call_table.functions(2), *call_table.functions(3)}
# The first library for a platform takes ziglang a minute.
OTHERS = [pytest.param(p, marks=pytest.mark.platforms) for p in list(PLATFORMS)[1:]]
each_platform = pytest.mark.parametrize("platform", ["linux64", *OTHERS])


def made(platform, model="gearmesh"):
    linker = needed.linker()
    if platform not in linker.platforms:
        needed.missing(f"{linker.name} does not build for {platform}: {needed.DEV}")
    return platform_libraries.linked(find_spec(model), PLATFORMS[platform], linker)


@each_platform
@pytest.mark.slow
def test_a_library_needs_the_system_only_and_exports_fmi_and_the_kernels_and_no_more(platform):
    found = binaries.read(made(platform))
    assert found.format == PLATFORMS[platform].format
    exports = found.exports - {"__dso_handle", "_mh_dylib_header"}
    assert exports == EXPORTS
    names = {name.lower() for name in found.needed}
    assert names <= {"libc.so.6", "kernel32.dll", "/usr/lib/libsystem.b.dylib"} | {
        name for name in names if name.startswith("api-ms-win-crt-")
    }
    assert not {n for n in names if "math" in n}
    assert not found.imports & (mathematics.defined().keys() | {"sqrt", "ceil", "nextafter"})
    if link.find_linker().is_cross:
        asked = re.findall(rb"GLIBC_(\d+)\.(\d+)", made(platform))
        assert all((int(major), int(minor)) <= GLIBC for major, minor in asked)
        assert bool(asked) == (found.format == "ELF")


@pytest.mark.parametrize("model", [*MODELS, "command"])
def test_the_shipped_libraries_are_those_of_the_sources(model):
    spec = find_spec(model)
    found = shipped.fmu_libraries(spec.kernel, platform_libraries.library_digest(spec))
    assert found.keys() == PLATFORMS.keys(), "first: python -m lab.ship_all"


@pytest.mark.slow
def test_what_is_not_shipped_is_linked_once_and_said(monkeypatch, tmp_path):
    monkeypatch.setattr(shipped, "is_linked", lambda kernel, digest: False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    said = []
    found = [
        platform_libraries.library(find_spec("command"), platform="linux64", note=said.append)
        for _ in range(2)
    ]
    assert found[0] == found[1]
    assert len([line for line in said if line.startswith("CommandSource: its library for")]) == 1


@each_platform
@pytest.mark.slow
def test_no_path_of_this_machine_is_inside(platform):
    code = made(platform)
    for path in (str(PACKAGE.parent), str(Path.home()), "/tmp/"):
        assert path.encode() not in code, path


@pytest.mark.slow
def test_what_is_too_much_in_a_library_is_named():
    code = made("linux64")
    with pytest.raises(EnvironmentProblem, match="it exports fmi2Reset"):
        binaries.check(code, exports=EXPORTS - {"fmi2Reset"})
    with pytest.raises(EnvironmentProblem, match="it does not export fmi2Dream"):
        binaries.check(code, exports={*EXPORTS, "fmi2Dream"})


def test_another_platform_is_refused_by_name():
    with pytest.raises(ParameterError, match="platform = 'dos', allowed: linux64 or win64"):
        platform_libraries.library(find_spec("gearmesh"), platform="dos")


@pytest.fixture
def without_zig(monkeypatch):
    """A machine without the package ziglang."""
    monkeypatch.setattr(link.importlib.util, "find_spec", lambda name: None)
    look_for_linkers_again()
    yield monkeypatch
    monkeypatch.undo()
    look_for_linkers_again()


def test_without_ziglang_the_local_compiler_builds_for_this_platform_only(without_zig):
    if not shutil.which("gcc") or link.local_machine() != ("Linux", "x86_64"):
        pytest.skip("needs gcc (Debian package gcc) on Linux, x86-64")
    assert link.find_linker().platforms == ("linux64",)
    code = link.shared_library({"a.c": "int a = 1;"}, platform=PLATFORMS["linux64"], name="a")
    assert binaries.read(code).format == "ELF"
    with pytest.raises(EnvironmentProblem, match=r"builds for linux64 only; for win64: pip"):
        link.shared_library({"a.c": ""}, platform=PLATFORMS["win64"], name="a")


def test_without_any_compiler_one_line_says_what_to_install(without_zig):
    without_zig.setattr(link.shutil, "which", lambda name: None)
    with pytest.raises(EnvironmentProblem, match=r"pip install 'thrustwasher\[build\]'") as caught:
        link.find_linker()
    assert "\n" not in str(caught.value)


def test_what_the_compiler_refuses_is_said_in_one_line():
    needed.linker()
    with pytest.raises(EnvironmentProblem, match=r"cannot build a\.so: a\.c:1:.*error") as caught:
        link.shared_library({"a.c": "int a = ;"}, platform=PLATFORMS["linux64"], name="a")
    assert "\n" not in str(caught.value)


def test_the_first_build_of_a_platform_does_not_pass_in_silence(monkeypatch, tmp_path):
    monkeypatch.setattr(link, "user_cache", lambda: tmp_path)
    monkeypatch.setattr(link, "SHORT", 0.0)
    said = []
    for _ in range(2):
        link.shared_library(
            {"a.c": "int a;"}, platform=PLATFORMS["linux64"], name="a", note=said.append
        )
    said = [line for line in said if "another first build" not in line]
    assert len(said) == 1 and "linux64" in said[0] and "minutes" in said[0]


@pytest.mark.slow
def test_first_builds_with_zig_go_one_by_one(monkeypatch, tmp_path):
    """Two that fill zig's cache at once can wait for each other for ever."""
    monkeypatch.setattr(link, "user_cache", lambda: tmp_path / "home")
    monkeypatch.setenv("ZIG_GLOBAL_CACHE_DIR", str(tmp_path))
    log, said = tmp_path / "log", []
    work = (
        f"import time; log = open({str(log)!r}, 'a', buffering=1); log.write('begin '); "
        "time.sleep(0.3); log.write('end '); raise SystemExit(1)"
    )
    fake = link.Linker("ziglang", (sys.executable, "-c", work), "0", tuple(PLATFORMS))

    def build():
        with pytest.raises(EnvironmentProblem):
            link.build({}, "a", [], PLATFORMS["linux64"], fake, said.append)

    threads = [threading.Thread(target=build) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert log.read_text() == 3 * "begin end "
    assert said == 2 * ["waiting for another first build with ziglang"]


@pytest.mark.parametrize(
    "model",
    [pytest.param(m, marks=[pytest.mark.slow] * (m not in ("washer", "train"))) for m in MODELS],
)
def test_code_is_kept_under_all_that_a_kernel_imports(model):
    kernel = find_spec(model).kernel
    found, called = digest.sources(kernel), [kernel, *called_modules(kernel)]
    run = subprocess.run(
        [sys.executable, "-c", f"import sys, {', '.join(called)}\nprint(*sys.modules)"],
        capture_output=True,
        text=True,
        check=True,
    )
    known = {".".join(path.relative_to(ROOT).with_suffix("").parts) for path in kernel_files()}
    assert set(run.stdout.split()) & known == set(found)


def emitted(folder, cpu):
    """Return (bitcode's object for v3, messages) of the toy kernel, from a folder of its own."""
    folder.mkdir()
    shutil.copytree(TOY, folder / "toy")
    surroundings = emit.environment(str(folder / "numba"))
    surroundings["NUMBA_CPU_NAME"] = cpu
    surroundings["PYTHONPATH"] = f"{folder}:{PACKAGE.parent}"
    v3 = PLATFORMS["linux64"].levels[1]
    for module, *given in (
        ("emit", "toy.kernel", digest.digest("toy.kernel"), "toy.bc"),
        ("lower", "toy.bc", "linux64", json.dumps(asdict(v3)), "toy.step", "toy.o"),
    ):
        command = [sys.executable, "-m", f"thrustwasher.native.compiling.{module}", *given]
        subprocess.run(command, cwd=folder, env=surroundings, check=True, timeout=300)
    return (folder / "toy.o").read_bytes()


@pytest.mark.slow
def test_objects_are_equal_whatever_the_folder_and_whatever_cpu_numba_was_told(
    tmp_path, monkeypatch
):
    """One emission serves all levels: before optimisation numba's output names no CPU."""
    monkeypatch.syspath_prepend(TOY.parent)
    code = emitted(tmp_path / "here", "x86-64-v2")
    assert code == emitted(tmp_path / "elsewhere", "x86-64-v3")
    gate.check_object(code, "toy.step")


def test_numba_with_another_convention_is_refused_plainly():
    class Made:
        native_name = "other.name"

    with pytest.raises(EnvironmentProblem, match=r"is not known to the native build: a callback"):
        callbacks.function_name(Made())
    with pytest.raises(EnvironmentProblem, match="is not int32 f"):
        callbacks.check_convention("", "step")


def test_numba_with_other_parts_is_refused_plainly(monkeypatch):
    monkeypatch.setitem(lean._EXPECTED, ("JITCodeLibrary", "finalize"), ["self", "more"])
    with pytest.raises(EnvironmentProblem, match=r"native build: JITCodeLibrary\.finalize is not"):
        lean.check_numba()


X86_64, ARM64 = 0x01000007, 0x0100000C


def mach_o(processor, subtype, length):
    return struct.pack("<III", 0xFEEDFACF, processor, subtype) + bytes(length - 12)


def test_each_part_of_a_macos_file_lies_at_a_whole_page_as_the_table_says():
    parts = [mach_o(X86_64, 3, 20_000), mach_o(ARM64, 0, 5_001)]
    data = platform_libraries.universal(parts)
    magic, n = struct.unpack_from(">II", data)
    assert (magic, n) == (0xCAFEBABE, 2)
    entries = [struct.unpack_from(">IIIII", data, 8 + 20 * i) for i in range(n)]
    assert [e[:2] for e in entries] == [(X86_64, 3), (ARM64, 0)]
    for part, (_, _, offset, size, align) in zip(parts, entries, strict=True):
        assert offset % (1 << align) == 0 and offset % 0x4000 == 0
        assert data[offset : offset + size] == part
    assert len(data) == entries[-1][2] + entries[-1][3]


@pytest.mark.parametrize("name", ["model", "bearing"])
def test_kernels_of_other_packages_count_whatever_they_are_called(tmp_path, monkeypatch, name):
    home = tmp_path / name
    home.mkdir()
    (home / "__init__.py").write_text("")
    (home / "step.py").write_text("ONE = 1\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    assert list(digest.closure(f"{name}.step")) == [f"{name}.step"]
