"""Make the compiled files of the package: ``python -m thrustwasher.native.ship [--check]``.

Writes ``data/native``: for each kernel module a zip with the objects of all platforms, and a
library for Python on Linux x86-64; ``index.json`` lists them. What has not changed stays. With
``--check`` nothing is written: everything is made anew and compared with what is there, byte by
byte if the same versions made it.
"""

import json
import platform as machine
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

from . import files, objects, shipped
from .digest import digest, sources
from .entries import libraries as all_libraries
from .files import to_stderr
from .library import linked_library
from .targets import PLATFORMS

LIBRARIES = ("linux64",)  # platforms whose libraries for Python lie in the checkout


def toolchain() -> dict[str, str]:
    """Return the versions of all that makes the compiled files."""
    versions = {name: metadata.version(name) for name in ("numba", "llvmlite", "ziglang")}
    return {"python": machine.python_version(), **versions}


def made(kernel: str, folder: Path) -> tuple[dict[tuple[str, str], bytes], float]:
    """Return a kernel module's objects for all platforms, compiled now, and the seconds it took."""
    wanted = {(p.name, level.name): (p, level) for p in PLATFORMS.values() for level in p.levels}
    start = time.perf_counter()
    objects.compile_objects(kernel, folder, wanted)
    took = time.perf_counter() - start
    code = {which: files.kept(folder / f"{which[0]}-{which[1]}.o") for which in wanted}
    return {which: data for which, data in code.items() if data is not None}, took


def libraries(
    kernel: str, code: Mapping[tuple[str, str], bytes], platforms: Sequence[str] = LIBRARIES
) -> dict[str, bytes]:
    """Return the libraries for Python that go with the objects: platform -> content."""
    found = {}
    for name in platforms:
        own = {which: data for which, data in code.items() if which[0] == name}
        found[name] = linked_library(kernel, PLATFORMS[name], own)
    return found


def ship(kernels: Sequence[str]) -> None:
    """Make what is missing or stale, and list everything."""
    index: dict[str, Any] = {"toolchain": toolchain(), "kernels": {}}
    same_tools = shipped.index().get("toolchain") == index["toolchain"]
    keep = {shipped.INDEX}
    for kernel in kernels:
        about: Any = shipped.record(kernel)
        if not (about and same_tools and shipped.objects_of(kernel)):
            with tempfile.TemporaryDirectory() as folder:
                code, took = made(kernel, Path(folder) / "made")
            about = _write(kernel, code, took)
        index["kernels"][kernel] = about
        _list(index)
        keep |= {about["objects"]["file"], *(x["file"] for x in about["libraries"].values())}
    for path in shipped.FOLDER.iterdir():
        if path.name not in keep:
            path.unlink()


def _list(index: dict[str, Any], folder: Path = shipped.FOLDER) -> None:
    text = json.dumps(index, indent=1, sort_keys=True) + "\n"
    files.write(folder / shipped.INDEX, text.encode())


def _write(kernel: str, code: dict[tuple[str, str], bytes], took: float) -> dict[str, Any]:
    name = f"{shipped.short(kernel)}-{digest(kernel)}"
    packed = shipped.pack(code)
    files.write(shipped.FOLDER / f"{name}.zip", packed)
    about: dict[str, Any] = {
        "digest": digest(kernel), "sources": sorted(sources(kernel)), "seconds": round(took, 1),
        "objects": {"file": f"{name}.zip", "sha256": files.checksum(packed)},
    }  # fmt: skip
    about["libraries"] = _write_libraries(shipped.FOLDER, kernel, name, code, LIBRARIES)
    return about


def _write_libraries(
    folder: Path, kernel: str, name: str, code: Mapping[tuple[str, str], bytes],
    platforms: Sequence[str],
) -> dict[str, Any]:  # fmt: skip
    found = {}
    for platform, data in libraries(kernel, code, platforms).items():
        file = f"{name}-{platform}.{PLATFORMS[platform].extension}"
        files.write(folder / file, data)
        found[platform] = {"file": file, "sha256": files.checksum(data)}
    return found


def relist(folder: Path, platforms: Sequence[str]) -> None:
    """Leave only the libraries for some platforms in a copy of the compiled files."""
    index = json.loads((folder / shipped.INDEX).read_text("utf-8"))
    for kernel, about in index["kernels"].items():
        for old in about["libraries"].values():
            (folder / old["file"]).unlink()
        code = shipped.unpack((folder / about["objects"]["file"]).read_bytes())
        name = about["objects"]["file"].removesuffix(".zip")
        about["libraries"] = _write_libraries(folder, kernel, name, code, platforms)
    _list(index, folder)


def check(kernels: Sequence[str]) -> list[str]:
    """Return what is wrong with the shipped files: stale, damaged, or not what is made now."""
    same_tools = shipped.index().get("toolchain") == toolchain()
    wrong = []
    for kernel in kernels:
        about, code = shipped.record(kernel), shipped.objects_of(kernel)
        if about is None or not code:
            wrong.append(f"{kernel}: its sources have changed, or a file is missing or damaged")
            continue
        if not same_tools:
            continue
        with tempfile.TemporaryDirectory() as folder:
            again, _ = made(kernel, Path(folder) / "made")
        wrong += [f"{kernel}: {' '.join(which)} is made otherwise"
                  for which in sorted(again) if again[which] != code.get(which)]  # fmt: skip
        for platform, data in libraries(kernel, again).items():
            if files.checksum(data) != about["libraries"][platform]["sha256"]:
                wrong.append(f"{kernel}: the library for {platform} is made otherwise")
    if not same_tools:
        to_stderr(
            f"made with {shipped.index().get('toolchain')}, here are {toolchain()}: no comparison "
            "byte by byte"
        )
    return wrong


def main(arguments: Sequence[str]) -> int:
    """Make or check the compiled files of the package."""
    kernels = all_libraries()
    if list(arguments) == ["--check"]:
        wrong = check(kernels)
        print("\n".join(wrong) or "the compiled files are those of the sources")
        return 1 if wrong else 0
    if arguments:
        print("usage: python -m thrustwasher.native.ship [--check]", file=sys.stderr)
        return 2
    ship(kernels)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
