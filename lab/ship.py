"""Make the compiled files of the package: ``python -m lab.ship [--check]``.

Writes ``data/native``: for each kernel module an archive with the objects of all platforms and, if
it is no model's, the libraries that Python loads; for each model a module for browsers;
``index.json`` lists them, ``code.json`` the digests of the parsed sources. What has not changed
stays, under the name that its digest has now. With ``--check`` nothing is written:
everything is made anew and compared with what is there, byte by byte if the same versions made it.
"""

import io
import json
import lzma
import os
import platform as machine
import sys
import tarfile
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

from thrustwasher.fmu.model_kernels import content_files
from thrustwasher.model.record import Ladder
from thrustwasher.model.registry import MODELS, OTHERS, all_models, all_specs
from thrustwasher.native import code, files, mathematics, shipped
from thrustwasher.native.compiling.objects import Objects, compile_objects, required_for
from thrustwasher.native.digest import HERE, MAKERS, closure, digest, read, sources
from thrustwasher.native.entries import libraries as all_libraries
from thrustwasher.native.files import to_stderr
from thrustwasher.native.library import linked_library
from thrustwasher.native.targets import PLATFORMS, TARGETS, WEB

FOLDER = "wasm"  # of the modules for browsers, next to the archives
FOR_BROWSERS = {f"{home}.kernels.step" for home in MODELS.values()}


def toolchain() -> dict[str, str]:
    """Return the versions of all that makes the compiled files."""
    versions = {name: metadata.version(name) for name in ("numba", "llvmlite", "ziglang")}
    return {"python": machine.python_version(), **versions}


def made(kernel: str, platforms: Iterable[str] = TARGETS) -> tuple[Objects, float]:
    """Return a kernel module's objects for some platforms, compiled now.

    Behind them the seconds of processor time that the first level took: what a user waits for whose
    kernels are new.
    """
    wanted, start = required_for(TARGETS[name] for name in platforms), os.times()
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "made"
        compile_objects(kernel, place, dict([next(iter(wanted.items()))]))
        took = os.times()
        made = compile_objects(kernel, place, wanted)
    return made, sum(took[2:4]) - sum(start[2:4])


def libraries(kernel: str, code: Objects) -> dict[str, bytes]:
    """Return the libraries of what is no model and so has no FMU, none of a model."""
    here = {name for name, _ in code} & PLATFORMS.keys()
    wanted = sorted(here) if kernel.startswith(tuple(OTHERS)) else ()
    return {name: linked(kernel, name, code) for name in wanted}


def linked(kernel: str, platform: str, code: Objects) -> bytes:
    """Return the library of some objects for one platform."""
    own = {which: data for which, data in code.items() if which[0] == platform}
    return linked_library(kernel, TARGETS[platform], own)


def ship(kernels: Sequence[str]) -> None:
    """Make what is missing or stale, and list everything."""
    index: dict[str, Any] = {"toolchain": toolchain(), "kernels": {}}
    same_tools = shipped.index().get("toolchain") == index["toolchain"]
    keep = {shipped.INDEX, code.KNOWN.name}
    list_code()
    rename(kernels)
    for kernel in kernels:
        about: Any = shipped.record(kernel)
        if not (about and same_tools and shipped.objects_of(kernel)):
            about = _write(kernel, *made(kernel))
        elif not is_linked(kernel) or about.get("mathematics") != mathematics.digest():
            in_c = {"portable": about["portable"]} if "portable" in about else {}
            about = in_c | _write(kernel, shipped.objects_of(kernel), about["seconds"])
        index["kernels"][kernel] = about
        list_all(index)
        keep |= {about[part]["file"] for part in ("objects", "web") if part in about}
    for folder in (shipped.FOLDER, shipped.FOLDER / FOLDER):
        for path in folder.iterdir():
            if path.is_file() and path.relative_to(shipped.FOLDER).as_posix() not in keep:
                path.unlink()
    read_again()


def read_again() -> None:
    """Forget what was read: the files have changed."""
    for read_once in (code.known, shipped.index, shipped.record, shipped._archive):
        read_once.cache_clear()


def is_linked(kernel: str) -> bool:
    """Tell if what is linked here with a kernel's objects is there."""
    has_own = not kernel.startswith(tuple(OTHERS)) or shipped.library(kernel, next(iter(PLATFORMS)))
    return bool(has_own and (kernel not in FOR_BROWSERS or shipped.web_file(kernel)))


def list_code() -> None:
    """List what parsing the sources of kernels and models gives, so that no user's run does it."""
    modules = {name for model in all_models() for name in _of_levels(model.ladder)}
    paths = set(closure(*modules).values()) | {HERE / name for name in MAKERS}
    for library in all_libraries():
        paths |= set(sources(library).values())
    for spec in all_specs(helpers=True):
        paths |= set(content_files(spec.kernel, spec.params.__module__, False))
    found = {}
    for text in (read(path) for path in paths if path.suffix == ".py"):
        made = code.parsed(text)
        found[code.key(text)] = [made.digest, *made.imports]
    files.write(code.KNOWN, json.dumps(found, indent=0, sort_keys=True).encode() + b"\n")


def _of_levels(ladder: Ladder | None) -> set[str]:
    """Return the modules of kernels that a model's levels name."""
    return {name for names in ladder.kernels.values() for name in names} if ladder else set()


def rename(kernels: Sequence[str]) -> None:
    """List what is shipped under the names of now: modules that moved have the same digests."""
    index: Any = shipped.index()
    known = {about["digest"]: about for about in index["kernels"].values()}
    moved = [name for name in kernels if not shipped.record(name) and digest(name) in known]
    for name in moved:
        index["kernels"][name] = {**known[digest(name)], "sources": sorted(sources(name))}
        to_stderr(f"{name} has moved, its files stay")
    if moved:
        list_all(index)
        read_again()


def list_all(index: dict[str, Any]) -> None:
    """Write the list."""
    text = json.dumps(index, indent=1, sort_keys=True) + "\n"
    files.write(shipped.FOLDER / shipped.INDEX, text.encode())


def _write(kernel: str, code: Objects, took: float) -> dict[str, Any]:
    name = f"{shipped.short(kernel)}-{digest(kernel)}"
    about = {
        "digest": digest(kernel),
        "sources": sorted(sources(kernel)),
        "seconds": round(took, 1),
        "objects": put(f"{name}.tar.xz", pack(code, libraries(kernel, code))),
        "mathematics": mathematics.digest(),
    }
    if kernel in FOR_BROWSERS:
        about["web"] = put(f"{FOLDER}/{name}.{WEB.extension}", linked(kernel, WEB.name, code))
    return about


def pack(
    objects: Mapping[tuple[str, str], bytes], libraries: Mapping[str, bytes] | None = None
) -> bytes:
    """Return an archive of objects, and of libraries by platform."""
    found = {f"{platform}-{level}.o": data for (platform, level), data in objects.items()}
    found |= {f"{shipped.LIBRARY}{platform}": data for platform, data in (libraries or {}).items()}
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


def put(name: str, data: bytes) -> dict[str, str]:
    """Write a file below the folder of compiled files; return its line in the list."""
    files.write(shipped.FOLDER / name, data)
    return {"file": name, "sha256": files.checksum(data)}


def check(kernels: Sequence[str], platforms: Iterable[str] = TARGETS) -> list[str]:
    """Return what is wrong with the shipped files: stale, damaged, or not what is made now.

    ``platforms``: those that are made again and compared, the browser among them.
    """
    same_tools = shipped.index().get("toolchain") == toolchain()
    wrong = []
    for kernel in kernels:
        about, code = shipped.record(kernel), shipped.objects_of(kernel)
        if about is None or not code:
            wrong.append(f"{kernel}: its sources have changed, or a file is missing or damaged")
            continue
        if not same_tools:
            continue
        again, _ = made(kernel, platforms)
        wrong += [
            f"{kernel}: {' '.join(which)} is made otherwise"
            for which in sorted(again)
            if again[which] != code.get(which)
        ]
        for platform, data in libraries(kernel, again).items():
            if data != shipped.library(kernel, platform):
                wrong.append(f"{kernel}: the library for {platform} is made otherwise")
        if kernel in FOR_BROWSERS:
            web = files.checksum(linked(kernel, WEB.name, again))
            if web != about["web"]["sha256"]:
                wrong.append(f"{kernel}: the module for browsers is made otherwise")
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
        print("usage: python -m lab.ship [--check]", file=sys.stderr)
        return 2
    ship(kernels)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
