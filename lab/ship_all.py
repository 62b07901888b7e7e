"""Make all compiled files of the package: ``python -m lab.ship_all [--check]``.

First those of the kernels (``ship.py``). Then each model's libraries, linked for every platform,
for its FMUs and for Python, go into its archive in ``data/native``, its kernels in C (made by
wasm2c of the Debian package wabt) into one of their own, and the notices of what the linker puts in
into ``data/notices``. What has not changed stays. With ``--check`` nothing is written: everything
is made anew and compared with what is there, byte by byte if the same versions made it; the C only
where wasm2c is installed. ``--c`` makes or checks the C alone.
"""

import json
import sys
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

from lab import ship as kernels
from thrustwasher.errors import EnvironmentProblem
from thrustwasher.fmu.package.licences import NOTICES
from thrustwasher.fmu.package.model_sources import source_folder
from thrustwasher.fmu.shell.platform_libraries import library_digest, linked
from thrustwasher.model.registry import all_specs
from thrustwasher.model.spec import ModelSpec
from thrustwasher.native import files, shipped
from thrustwasher.native.compiling.portable import MISSING, identity, maker, portable
from thrustwasher.native.files import to_stderr
from thrustwasher.native.link import find_linker
from thrustwasher.native.targets import PLATFORMS

IN_C = "c"  # folder next to the other archives
FROM_ZIG = {
    "zig.txt": "LICENSE",
    "mingw-w64.txt": "lib/libc/mingw/COPYING",
    "musl.txt": "lib/libc/musl/COPYRIGHT",
}


def made(spec: ModelSpec) -> dict[str, bytes]:
    """Return a model's libraries for all platforms, linked now."""
    return {name: linked(spec, platform, find_linker()) for name, platform in PLATFORMS.items()}


def ship() -> None:
    """Make what is missing or stale, and list everything."""
    zig = Path(str(metadata.distribution("ziglang").locate_file("ziglang")))
    for name, place in FROM_ZIG.items():
        files.write(NOTICES / name, (zig / place).read_bytes())
    index: dict[str, Any] = json.loads((shipped.FOLDER / shipped.INDEX).read_text("utf-8"))
    for spec in all_specs(helpers=True, alone=True):
        digest, about = library_digest(spec), index["kernels"][spec.kernel]
        if shipped.fmu_libraries(spec.kernel, digest).keys() != PLATFORMS.keys():
            data = kernels.pack(shipped.objects_of(spec.kernel), made(spec))
            about["objects"] = kernels.put(about["objects"]["file"], data)
            about["fmu"] = digest
            kernels.list_all(index)
            to_stderr(f"{spec.name}: {len(data)} bytes")
    kernels.read_again()


def in_c(spec: ModelSpec) -> dict[str, bytes]:
    """Return a model's kernels as C, made now."""
    return portable(spec.kernel, (source_folder() / "portable" / "wasm.h").read_text("utf-8"))


def ship_c() -> None:
    """Make the C that is missing or stale, and list it."""
    index: dict[str, Any] = json.loads((shipped.FOLDER / shipped.INDEX).read_text("utf-8"))
    for spec in all_specs(helpers=True, alone=True):
        made_of = identity(spec.kernel)
        if shipped.portable(spec.kernel, made_of):
            continue
        if not maker():
            raise EnvironmentProblem(MISSING)
        data = kernels.packed(in_c(spec))
        about = index["kernels"][spec.kernel]
        name = f"{IN_C}/{about['objects']['file']}"
        about["portable"] = {
            **kernels.put(name, data),
            "made_of": made_of,
            "made_by": maker(),
        }
        kernels.list_all(index)
        to_stderr(f"{spec.name} in C: {len(data)} bytes")
    keep = {about["portable"]["file"] for about in index["kernels"].values() if "portable" in about}
    for path in (shipped.FOLDER / IN_C).iterdir():
        if f"{IN_C}/{path.name}" not in keep:
            path.unlink()
    kernels.read_again()


def check_c() -> list[str]:
    """Return what is wrong with the shipped C: stale, or not what is made now."""
    same_tools, wrong = shipped.index().get("toolchain") == kernels.toolchain(), []
    for spec in all_specs(helpers=True, alone=True):
        found = shipped.portable(spec.kernel, identity(spec.kernel))
        about = (shipped.record(spec.kernel) or {}).get("portable", {})
        comparable = same_tools and about.get("made_by") == maker()
        if not found or (comparable and found != in_c(spec)):
            wrong.append(f"{spec.name}: its kernels in C are stale, damaged or made otherwise")
    return wrong


def check() -> list[str]:
    """Return what is wrong with the shipped libraries: stale, or not what is linked now."""
    comparable, wrong = shipped.index().get("toolchain") == kernels.toolchain(), []
    for spec in all_specs(helpers=True, alone=True):
        found = shipped.fmu_libraries(spec.kernel, library_digest(spec))
        if not found or (comparable and found != made(spec)):
            wrong.append(f"{spec.name}: its FMUs' libraries are stale, damaged or made otherwise")
    return wrong


def main(arguments: Sequence[str]) -> int:
    """Make or check the compiled files of the package."""
    checks, only_c = "--check" in arguments, "--c" in arguments
    code = 0 if only_c else kernels.main(arguments)
    if code == 2:
        return code
    if checks:
        wrong = check_c() if only_c else [*check(), *check_c()]
        print("\n".join(wrong) or "the libraries of the FMUs, and the C, are those of the sources")
        return 1 if wrong else code
    if not only_c:
        ship()
    try:
        ship_c()
    except EnvironmentProblem as problem:
        to_stderr(str(problem))
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
