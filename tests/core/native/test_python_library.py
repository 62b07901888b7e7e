"""The library that Python loads: shipped, kept, linked or loaded by llvmlite; always the same."""

import shutil

import needed
import pytest
from children import child

from lab.ship import pack, read_again
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.native import binaries, code, digest, files, link, shipped
from thrustwasher.native.compiling import objects
from thrustwasher.native.entries import called_modules, libraries
from thrustwasher.native.library import TABLE
from thrustwasher.native.targets import PLATFORMS, TARGETS

KERNELS = [name for name in libraries() if name.startswith("thrustwasher.")]
GEAR = "thrustwasher.gearmesh.kernels.step"
LARGEST = 5_600_000  # bytes of compiled files in the repository

linux = pytest.mark.skipif(
    link.local_machine() != ("Linux", "x86_64"), reason="the shipped library is for Linux on x86-64"
)


def with_cache(code, cache, **environment):
    return child(code, XDG_CACHE_HOME=str(cache), **environment)


@pytest.mark.parametrize("kernel", KERNELS)
def test_what_is_shipped_is_made_from_these_sources_for_every_platform(kernel):
    assert shipped.record(kernel) is not None, "renew it: python -m lab.ship_all"
    wanted = {(p.name, level.name) for p in TARGETS.values() for level in p.levels}
    assert shipped.objects_of(kernel).keys() == wanted
    for name in PLATFORMS:
        assert TABLE in binaries.read(shipped.library(kernel, name)).exports, name


@pytest.mark.parametrize("kernel", KERNELS)
def test_all_that_is_compiled_is_in_the_digest(kernel):
    listed = set(shipped.record(kernel)["sources"])
    assert set(called_modules(kernel)) <= listed
    for module in called_modules(kernel):
        assert digest.sources(module).keys() <= listed


def test_what_is_shipped_is_small_and_all_listed():
    found = sorted(path for path in shipped.FOLDER.rglob("*") if path.is_file())
    listed = {shipped.INDEX, code.KNOWN.name}
    for about in shipped.index()["kernels"].values():
        listed |= {about[x]["file"] for x in ("objects", "web", "portable") if x in about}
    assert {path.relative_to(shipped.FOLDER).as_posix() for path in found} == listed
    assert sum(path.stat().st_size for path in found) < LARGEST


def test_the_same_objects_are_packed_to_the_same_bytes():
    given = {("linux64", "v2"): b"a" * 1000, ("win64", "v2"): b"b"}
    data = pack(given, {"linux64": b"c"})
    assert data == pack(dict(reversed(given.items())), {"linux64": b"c"})
    found = shipped.unpack(data)
    assert found == {"linux64-v2.o": b"a" * 1000, "win64-v2.o": b"b", "library/linux64": b"c"}


@pytest.fixture
def spoiled(monkeypatch, tmp_path):
    """A copy of the shipped files that a test may spoil."""
    shutil.copytree(shipped.FOLDER, tmp_path / "native")
    monkeypatch.setattr(shipped, "FOLDER", tmp_path / "native")
    read_again()
    yield tmp_path / "native"
    monkeypatch.undo()
    read_again()


def test_a_damaged_file_is_not_used(spoiled):
    name = shipped.record(GEAR)["objects"]["file"]
    data = bytearray((spoiled / name).read_bytes())
    data[len(data) // 2] ^= 1
    (spoiled / name).write_bytes(data)
    assert shipped.objects_of(GEAR) == {}


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        "[" * 100_000,
        '{"kernels": []}',
        '{"kernels": {"' + GEAR + '": {}}}',
        '{"kernels": {"' + GEAR + '": {"sources": [3], "digest": 1, "objects": 2}}}',
    ],
)
def test_a_damaged_list_is_as_if_nothing_was_shipped(spoiled, text):
    (spoiled / shipped.INDEX).write_text(text)
    read_again()
    assert shipped.record(GEAR) is None and shipped.library(GEAR, "linux64") is None


def test_an_edited_source_makes_the_shipped_code_stale(monkeypatch):
    once = (digest.digest, digest.sources, shipped.record)
    once = [known for known in once if hasattr(known, "cache_clear")]
    true, edited = digest.read, b"\nEDITED = 1\n"
    for known in once:
        known.cache_clear()
    monkeypatch.setattr(
        digest, "read", lambda p: true(p) + edited * (p.name == "flank_temperature.py")
    )
    assert shipped.record(GEAR) is None
    assert shipped.record("thrustwasher.command.kernels.step") is not None
    monkeypatch.undo()
    for known in once:
        known.cache_clear()
    assert shipped.record(GEAR) is not None


SOLVED = """
import sys
from thrustwasher.native import files, library
{}
from thrustwasher import GearMeshParams, solve_gearmesh
print(solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0).friction_torque.hex())
print("llvmlite" in sys.modules, "thrustwasher.native.compiling" in sys.modules)
"""
NO_FOLDER = """
def none(*_):
    raise FileNotFoundError(2, "No usable temporary directory found")
files.code_folder = files.private_folder = none
"""
NO_LZMA = """
import sys
sys.modules["lzma"] = None
"""
NOWHERE_RUNS = "library._loaded = lambda kernel, path: {}"  # as where all is mounted noexec


@linux
@pytest.mark.slow
def test_the_library_of_the_fmus_is_unpacked_once_and_again_where_it_was_damaged(tmp_path):
    first = with_cache(SOLVED.format(""), tmp_path)
    (kept,) = tmp_path.rglob("gearmesh-*.so")
    about, data = kept.stat(), kept.read_bytes()
    assert data == shipped.library(GEAR, "linux64")
    second = with_cache(SOLVED.format(""), tmp_path)
    assert kept.stat().st_mtime_ns == about.st_mtime_ns
    kept.write_bytes(data[:-1] + b"x")
    third = with_cache(SOLVED.format(""), tmp_path)
    assert kept.read_bytes() == data
    assert first.stdout == second.stdout == third.stdout
    assert first.stdout.splitlines()[1] == "False False", first.stderr


@linux
@pytest.mark.parametrize("how", [NO_FOLDER, NOWHERE_RUNS])
@pytest.mark.slow
def test_where_no_folder_takes_a_library_or_lets_it_run_llvmlite_loads_its_object(how, tmp_path):
    shown, done = (with_cache(SOLVED.format(code), tmp_path) for code in ("", how))
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == [shown.stdout.splitlines()[0], "True True"]


@pytest.mark.slow
@linux
def test_a_python_without_lzma_compiles_and_says_why(tmp_path):
    code = NO_LZMA + STALE.replace('shipped.index = lambda: {"kernels": {}}\n', "")
    done = with_cache(code, tmp_path)
    assert done.stdout == "0\n", done.stderr
    assert done.stderr.startswith("this Python was built without lzma: command is compiled once")


WITHOUT = """
import sys
from thrustwasher.native import link, shipped
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.gearmesh.kernels.constants import slide_roll
shipped.library = lambda kernel, platform: None
def none():
    raise EnvironmentProblem("no compiler")
if {no_linker}:
    link.local_linker = none
from thrustwasher import GearMeshParams, solve_gearmesh
print(solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0).friction_torque.hex())
print("llvmlite" in sys.modules, "numba" in sys.modules)
"""


@pytest.mark.slow
@linux
@pytest.mark.parametrize("no_linker", [False, True])
def test_without_a_library_it_is_linked_or_loaded_by_llvmlite_and_kept(tmp_path, no_linker):
    needed.linker()
    shown = with_cache(WITHOUT.format(no_linker="False"), tmp_path / "a")
    assert shown.returncode == 0, shown.stderr
    done = with_cache(WITHOUT.format(no_linker=no_linker), tmp_path / "b")
    assert done.returncode == 0, done.stderr
    number, modules = done.stdout.splitlines()
    assert number == shown.stdout.splitlines()[0]
    assert modules == f"{no_linker} False"
    kept = list((tmp_path / "b").rglob("gearmesh-*.so"))
    assert len(kept) == (0 if no_linker else 1)


STALE = """
from thrustwasher.native import shipped
shipped.index = lambda: {"kernels": {}}
from thrustwasher.command.kernels import step as k
import numpy as np
print(k.derive(np.zeros(k.NPAR)))
"""


@linux
@pytest.mark.slow
def test_stale_code_is_compiled_once_with_a_word(tmp_path):
    first, second = with_cache(STALE, tmp_path), with_cache(STALE, tmp_path)
    assert first.stdout == second.stdout == "0\n", first.stderr
    assert "compiling command," in first.stderr and "compiled command in" in first.stderr
    assert second.stderr == ""


@linux
@pytest.mark.slow
def test_a_source_that_changes_while_it_is_compiled_is_not_kept_under_the_old_name(tmp_path):
    wanted = {("linux64", "v2"): (PLATFORMS["linux64"], PLATFORMS["linux64"].levels[0])}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(objects, "digest", lambda kernel: "0" * 16)
        with pytest.raises(EnvironmentProblem, match="its source changed meanwhile"):
            objects.compile_objects("thrustwasher.command.kernels.step", tmp_path / "x", wanted)


@pytest.mark.slow
def test_an_error_of_the_disk_while_compiling_names_the_folder(monkeypatch, tmp_path):
    def full(path, data):
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr(files, "keep", full)
    wanted = {("linux64", "v2"): (PLATFORMS["linux64"], PLATFORMS["linux64"].levels[0])}
    with pytest.raises(EnvironmentProblem, match=r"No space left .* XDG_CACHE_HOME") as caught:
        objects.compile_objects("thrustwasher.command.kernels.step", tmp_path / "x", wanted)
    assert "\n" not in str(caught.value)


@pytest.mark.slow
def test_a_machine_nothing_is_made_for_lets_numba_compile(tmp_path):
    code = (
        "import platform\nplatform.machine = lambda: 'riscv64'\n"
        "from thrustwasher.tribology.viscosity import viscosity\n"
        "print(viscosity(350.0, 6.3e-5, 3.5, 1.05)[0] > 0.0)\n"
    )
    done = with_cache(code, tmp_path, NUMBA_CACHE_DIR=str(tmp_path))
    assert done.stdout == "True\n", done.stderr
    assert done.stderr.count("\n") == 1 and "riscv64" in done.stderr
