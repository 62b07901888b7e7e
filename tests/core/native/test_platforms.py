"""FMUs for other platforms, run by emulators: the numbers of Python here, to the bit."""

import os
import shutil
import struct
import subprocess
from functools import cache
from pathlib import Path

import needed
import numpy as np
import pytest
from kernel_runs import HERE, MODELS, Python, Run, parameters, profile

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.shell import c_sources, c_tables, platform_libraries
from thrustwasher.model.registry import find_spec
from thrustwasher.native import entries, link, shipped
from thrustwasher.native.targets import PLATFORMS
from thrustwasher.tribology.viscosity import viscosity

GUID = "0123456789abcdef0123456789abcdef"
STEPS = 20
SAME_IN_C = 1e-12  # of the largest output of a unit: C of 32-bit code adds up in another order
every = pytest.mark.parametrize(
    "model", [pytest.param(m, marks=pytest.mark.slow) if m == "washer" else m for m in MODELS]
)


# Debian's wine64 alone puts nothing on PATH.
WINE = ("wine64", "wine", "/usr/lib/wine/wine64")
ARM_LIBRARIES = "/usr/aarch64-linux-gnu"


def first_of(names, package):
    """Return the path of a program, or skip and say which Debian package is missing."""
    found = [path for path in map(shutil.which, names) if path]
    if not found:
        pytest.skip(f"install the Debian package {package}")
    return found[0]


def emulator(platform):
    """Return what comes before a program of a platform to run it on Linux, x86-64."""
    if link.local_machine() != ("Linux", "x86_64"):
        pytest.skip("emulators are known for Linux on x86-64 only")
    if platform == "win64":
        return (first_of(WINE, "wine64"),)
    if not Path(ARM_LIBRARIES).is_dir():
        pytest.skip("install the Debian package libc6-arm64-cross")
    return (first_of(("qemu-aarch64", "qemu-aarch64-static"), "qemu-user"), "-L", ARM_LIBRARIES)


def old_processor():
    """Return what comes before a program of linux64 to run it as on an x86-64 CPU of 2008."""
    return (first_of(("qemu-x86_64", "qemu-x86_64-static"), "qemu-user"), "-cpu", "Nehalem")


@cache
def built(platform: str, host: str = "driver") -> tuple[bytes, str]:
    """Return a C program for a platform, and its file name."""
    target = PLATFORMS[platform]
    windows = target.format == "PE"
    name = f"{host}.exe" if windows else host
    text = next(HERE.rglob(f"{host}.c")).read_bytes()
    files = {f"{host}.c": text, **platform_libraries.headers()}
    return link.build(files, name, [] if windows else ["-ldl"], target), name


def stepped(model: str, platform: str, before, folder, made: bytes | None = None) -> np.ndarray:
    """Return the real outputs (steps, n) of the library on a platform."""
    if platform not in needed.linker().platforms:
        needed.missing(f"{link.find_linker().name} does not build for {platform}: {needed.DEV}")
    spec, target = find_spec(model), PLATFORMS[platform]
    found = interface(spec).variables
    inputs = [v.reference for v in found if v.causality == "input"]
    outputs = [v.reference for v in found if v.store == "out"]
    rows, dt = profile(model, STEPS)
    head = struct.pack("<3i", len(inputs), len(outputs), len(rows))
    references = np.array([*inputs, *outputs], "<u4").tobytes()
    (folder / "in.bin").write_bytes(head + references + struct.pack("<d", dt) + rows.tobytes())
    file = f"{spec.name}.{target.extension}"
    made = made or platform_libraries.library(spec, platform=platform)
    (folder / file).write_bytes(made)
    (folder / c_tables.PART).write_bytes(c_tables.part_file(interface(spec), GUID))
    program, name = built(platform)
    (folder / name).write_bytes(program)
    (folder / name).chmod(0o755)
    command = [*before, f"./{name}", f"./{file}", GUID, spec.name, "in.bin", "out.bin"]
    wine = {"WINEPREFIX": os.environ.get("WINEPREFIX", str(folder / "wine")), "WINEDEBUG": "-all"}
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, env={**os.environ, **wine}, timeout=600
    )
    assert done.returncode == 0, done.stderr
    return np.fromfile(folder / "out.bin").reshape(len(rows), len(outputs))


def expected(model: str) -> np.ndarray:
    run = Run(Python(model))
    run.start(parameters(model))
    rows, dt = profile(model, STEPS)
    found = []
    for i, row in enumerate(rows):
        assert run.step(row, i * dt, dt) == 0
        found.append(run.out.copy())
    return np.array(found)


@pytest.fixture(scope="module")
def wine_prefix(tmp_path_factory):
    """One folder for wine's first start, which takes seconds."""
    folder = tmp_path_factory.mktemp("wine")
    before = os.environ.get("WINEPREFIX")
    os.environ["WINEPREFIX"] = str(folder)
    yield
    os.environ.pop("WINEPREFIX")
    if before:
        os.environ["WINEPREFIX"] = before
    shutil.rmtree(folder, ignore_errors=True)  # 0.7 GB


RUNNERS = {"win64": emulator, "aarch64-linux": emulator, "linux64": lambda _: old_processor()}


@every
@pytest.mark.platforms
@pytest.mark.parametrize("platform", RUNNERS)
def test_elsewhere_and_on_an_old_processor_it_steps_as_in_python(
    model, platform, tmp_path, wine_prefix
):
    before = RUNNERS[platform](platform)
    found, wanted = stepped(model, platform, before, tmp_path), expected(model)
    assert np.array_equal(found, wanted)


@pytest.mark.platforms
@pytest.mark.parametrize("platform", RUNNERS)
def test_elsewhere_the_shipped_library_shows_python_the_same_functions(
    platform, tmp_path, wine_prefix
):
    before, given = RUNNERS[platform](platform), (350.0, 6.3e-5, 3.5, 1.05)
    library = entries.library_of(viscosity.__module__, "viscosity")
    place = entries.symbols(library).index(entries.symbol_of(viscosity.__module__, "viscosity"))
    program, name = built(platform, "table")
    (tmp_path / name).write_bytes(program)
    (tmp_path / name).chmod(0o755)
    kernels = tmp_path / f"kernels.{PLATFORMS[platform].extension}"
    kernels.write_bytes(shipped.library(library, platform))
    expected = viscosity(*given)
    words = [f"./{name}", f"./{kernels.name}", str(place), str(len(expected))]
    done = subprocess.run(
        [*before, *words, *map(float.hex, given)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        env={**os.environ, "WINEDEBUG": "-all"},
    )
    assert done.returncode == 0, done.stderr
    assert tuple(map(float.fromhex, done.stdout.split())) == expected


@every
@pytest.mark.platforms
def test_c_sources_compiled_for_arm_step_as_in_python(model, tmp_path):
    before, target = emulator("aarch64-linux"), PLATFORMS["aarch64-linux"]
    shown = interface(find_spec(model))
    files = c_sources.source_files(shown, 2, print, GUID) | platform_libraries.headers()
    made = link.shared_library(files, platform=target, name=shown.spec.name)
    found, wanted = stepped(model, target.name, before, tmp_path, made), expected(model)
    units = [v.unit for v in shown.outputs if v.store == "out"]
    largest = {u: np.abs(wanted[:, [u == x for x in units]]).max() or 1.0 for u in units}
    error = np.abs(found - wanted).max(axis=0) / [largest[u] for u in units]
    assert error.max() < SAME_IN_C, error.max()
