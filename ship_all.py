"""Make all compiled files of the package: ``python ship_all.py [--check]``.

First those of the kernels (``ship.py``). Then each model's libraries for FMUs, linked for every
platform, go into its archive in ``data/native``, and the notices of what the linker puts in into
``data/notices``. What has not changed stays. With ``--check`` nothing is written: everything is
made anew and compared with what is there, byte by byte if the same versions made it.
"""

import json
import sys
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

import ship as kernels
from thrustwasher.fmu.package.licences import NOTICES
from thrustwasher.fmu.shell.platform_libraries import library_digest, linked
from thrustwasher.model.registry import all_specs
from thrustwasher.model.spec import ModelSpec
from thrustwasher.native import files, shipped
from thrustwasher.native.files import to_stderr
from thrustwasher.native.link import find_linker
from thrustwasher.native.targets import PLATFORMS

FROM_ZIG = {"zig.txt": "LICENSE", "mingw-w64.txt": "lib/libc/mingw/COPYING"}


def made(spec: ModelSpec) -> dict[str, bytes]:
    """Return a model's libraries for all platforms, linked now."""
    return {name: linked(spec, platform, find_linker()) for name, platform in PLATFORMS.items()}


def ship() -> None:
    """Make what is missing or stale, and list everything."""
    zig = Path(str(metadata.distribution("ziglang").locate_file("ziglang")))
    for name, place in FROM_ZIG.items():
        files.write(NOTICES / name, (zig / place).read_bytes())
    index: dict[str, Any] = json.loads((shipped.FOLDER / shipped.INDEX).read_text("utf-8"))
    for spec in all_specs(helpers=True):
        digest, about = library_digest(spec), index["kernels"][spec.kernel]
        if shipped.fmu_libraries(spec.kernel, digest).keys() != PLATFORMS.keys():
            data = kernels.pack(shipped.objects_of(spec.kernel), made(spec))
            about["objects"] = kernels.put(shipped.FOLDER / about["objects"]["file"], data)
            about["fmu"] = digest
            kernels.list_all(index)
            to_stderr(f"{spec.name}: {len(data)} bytes")
    shipped.read_again()


def check() -> list[str]:
    """Return what is wrong with the shipped libraries: stale, or not what is linked now."""
    comparable, wrong = shipped.index().get("toolchain") == kernels.toolchain(), []
    for spec in all_specs(helpers=True):
        found = shipped.fmu_libraries(spec.kernel, library_digest(spec))
        if not found or (comparable and found != made(spec)):
            wrong.append(f"{spec.name}: its FMUs' libraries are stale, damaged or made otherwise")
    return wrong


def main(arguments: Sequence[str]) -> int:
    """Make or check the compiled files of the package."""
    code, wrong = kernels.main(arguments), []
    if code != 2 and arguments:
        wrong = check()
        print("\n".join(wrong) or "the libraries of the FMUs are those of the sources")
    elif code == 0:
        ship()
    return 1 if wrong else code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
