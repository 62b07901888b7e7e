"""Make the compiled files of the package: ``python ship.py [--check]``.

Writes ``data/native``: for each kernel module an archive with the objects of all platforms, a
library for Python on Linux x86-64, and one for browsers; ``index.json`` lists them. What has not
changed stays. With ``--check`` nothing is written: everything is made anew and compared with what
is there, byte by byte if the same versions made it.
"""

import io
import json
import lzma
import platform as machine
import sys
import tarfile
import tempfile
import time
from collections.abc import Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

from thrustwasher.model.registry import MODELS
from thrustwasher.native import files, mathematics, shipped
from thrustwasher.native.digest import digest, sources
from thrustwasher.native.entries import libraries as all_libraries
from thrustwasher.native.files import to_stderr
from thrustwasher.native.library import linked_library
from thrustwasher.native.objects import Objects, compile_objects, required_for
from thrustwasher.native.targets import TARGETS, WEB

FOR_BROWSERS = "wasm"  # folder beside the libraries
LIBRARIES = ("linux64",)  # platforms whose libraries for Python lie in the checkout


def toolchain() -> dict[str, str]:
    """Return the versions of all that makes the compiled files."""
    versions = {name: metadata.version(name) for name in ("numba", "llvmlite", "ziglang")}
    return {"python": machine.python_version(), **versions}


def made(kernel: str) -> tuple[Objects, float]:
    """Return a kernel module's objects for all platforms, compiled now, and the seconds it took."""
    start, wanted = time.perf_counter(), required_for(TARGETS.values())
    with tempfile.TemporaryDirectory() as folder:
        code = compile_objects(kernel, Path(folder) / "made", wanted)
    return code, time.perf_counter() - start


def libraries(kernel: str, code: Objects, platforms: Sequence[str] = LIBRARIES) -> dict[str, bytes]:
    """Return the libraries that go with the objects, of a model one for browsers too."""
    if kernel.startswith(tuple(f"{home}.kernels.step" for home in MODELS.values())):
        platforms = [*platforms, WEB.name]
    own = {name: {w: data for w, data in code.items() if w[0] == name} for name in platforms}
    return {name: linked_library(kernel, TARGETS[name], own[name]) for name in platforms}


def ship(kernels: Sequence[str]) -> None:
    """Make what is missing or stale, and list everything."""
    index: dict[str, Any] = {"toolchain": toolchain(), "kernels": {}}
    same_tools = shipped.index().get("toolchain") == index["toolchain"]
    keep = {shipped.INDEX}
    for kernel in kernels:
        about: Any = shipped.record(kernel)
        if not (about and same_tools and shipped.objects_of(kernel)):
            about = _write(kernel, *made(kernel))
        elif about.get("mathematics") != mathematics.digest():
            name = about["objects"]["file"].removesuffix(".tar.xz")
            code = shipped.objects_of(kernel)
            about |= _write_libraries(shipped.FOLDER, kernel, name, code, LIBRARIES)
        index["kernels"][kernel] = about
        list_all(index)
        keep |= {about["objects"]["file"], *(x["file"] for x in about["libraries"].values())}
    for folder in (shipped.FOLDER, shipped.FOLDER / FOR_BROWSERS):
        for path in folder.iterdir():
            if path.is_file() and path.relative_to(shipped.FOLDER).as_posix() not in keep:
                path.unlink()
    shipped.read_again()


def list_all(index: dict[str, Any], folder: Path = shipped.FOLDER) -> None:
    """Write the list."""
    text = json.dumps(index, indent=1, sort_keys=True) + "\n"
    files.write(folder / shipped.INDEX, text.encode())


def _write(kernel: str, code: Objects, took: float) -> dict[str, Any]:
    name = f"{shipped.short(kernel)}-{digest(kernel)}"
    return {
        "digest": digest(kernel),
        "sources": sorted(sources(kernel)),
        "seconds": round(took, 1),
        "objects": put(shipped.FOLDER / f"{name}.tar.xz", pack(code)),
        **_write_libraries(shipped.FOLDER, kernel, name, code, LIBRARIES),
    }


def _write_libraries(
    folder: Path, kernel: str, name: str, code: Objects, platforms: Sequence[str]
) -> dict[str, Any]:
    """Return the list's words on the libraries, and on the mathematics linked into them."""
    found = {}
    for platform, data in libraries(kernel, code, platforms).items():
        file = f"{name}-{platform}.{TARGETS[platform].extension}"
        if platform == "wasm32":
            file = f"{FOR_BROWSERS}/{file}"
        (folder / file).parent.mkdir(exist_ok=True)
        found[platform] = {**put(folder / file, data), "file": file}
    return {"libraries": found, "mathematics": mathematics.digest()}


def pack(
    objects: Mapping[tuple[str, str], bytes], libraries: Mapping[str, bytes] | None = None
) -> bytes:
    """Return an archive of objects, and of libraries for FMUs by platform."""
    found = {f"{platform}-{level}.o": data for (platform, level), data in objects.items()}
    found |= {f"{shipped.FMU}{platform}": data for platform, data in (libraries or {}).items()}
    return packed(found)


def packed(files: Mapping[str, bytes]) -> bytes:
    """Return an archive of files, the same whenever it is made."""
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w") as archive:
        for name, data in sorted(files.items()):
            about = tarfile.TarInfo(name)
            about.size = len(data)
            archive.addfile(about, io.BytesIO(data))
    return lzma.compress(buffer.getvalue(), preset=9 | lzma.PRESET_EXTREME)


def put(path: Path, data: bytes) -> dict[str, str]:
    """Write a file; return its line in the list."""
    files.write(path, data)
    return {"file": path.name, "sha256": files.checksum(data)}


def relist(folder: Path, platforms: Sequence[str]) -> None:
    """Leave the libraries for some platforms and for browsers in a copy of the compiled files."""
    index = json.loads((folder / shipped.INDEX).read_text("utf-8"))
    for kernel, about in index["kernels"].items():
        for old in about["libraries"].values():
            (folder / old["file"]).unlink()
        code = shipped.objects_in(shipped.unpack((folder / about["objects"]["file"]).read_bytes()))
        name = about["objects"]["file"].removesuffix(".tar.xz")
        about |= _write_libraries(folder, kernel, name, code, platforms)
    list_all(index, folder)


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
        again, _ = made(kernel)
        wrong += [
            f"{kernel}: {' '.join(which)} is made otherwise"
            for which in sorted(again)
            if again[which] != code.get(which)
        ]
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
        print("usage: python ship.py [--check]", file=sys.stderr)
        return 2
    ship(kernels)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
