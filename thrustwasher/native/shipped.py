"""The compiled files inside the package: objects of all platforms, libraries made of them.

``index.json`` lists for each kernel module the sources it was made from, their digest, and the
files with their checksums. A source that differs, or a file that is not as listed, and it is as if
nothing had been shipped: what is needed is compiled again. An archive holds a module's objects and
the libraries for FMUs that were linked with them: they have most in common, which is stored once.
"""

import io
import json
import tarfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from . import mathematics
from .digest import HERE, PACKAGE, digest, digest_of, read
from .files import checksum

FOLDER = HERE.parent / "data" / "native"
INDEX = "index.json"
FMU = "fmu/"  # in an archive, before the platforms of libraries for FMUs


@cache
def index() -> Mapping[str, Any]:
    """Return the list of shipped files; empty if there is none that can be read."""
    try:
        found: dict[str, Any] = json.loads((FOLDER / INDEX).read_text("utf-8"))
    except (OSError, ValueError, RecursionError):
        return {"kernels": {}}
    known = isinstance(found, dict) and isinstance(found.get("kernels"), dict)
    return found if known else {"kernels": {}}


@cache
def record(kernel: str) -> Mapping[str, Any] | None:
    """Return what is shipped for a kernel module, None if its sources have changed since."""
    about: dict[str, Any] | None = index()["kernels"].get(kernel)
    if about is None:
        return None
    try:
        found = {name: read(_file(name)) for name in about["sources"]}
        return about if digest_of(kernel, found) == about["digest"] else None
    except (OSError, KeyError, TypeError, AttributeError, ValueError):  # changed by hand
        return None


def digest_now(kernel: str) -> str:
    """Return the digest of a kernel module's sources; quick where they are those shipped."""
    about = record(kernel)
    return str(about["digest"]) if about else digest(kernel)


def _file(module: str) -> Path:
    """Return the file of a module of this package."""
    path = HERE.parents[1].joinpath(*module.split("."))
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def _listed(kernel: str, *place: str) -> Path | None:
    """Return a listed file if it is fresh and as it was when it was listed."""
    about: Any = record(kernel)
    try:
        for key in place:
            about = about[key]
        path = FOLDER / about["file"]
        return path if checksum(path.read_bytes()) == about["sha256"] else None
    except (OSError, KeyError, TypeError):
        return None


def library_file(kernel: str, platform: str) -> Path | None:
    """Return the shipped library of a kernel module for Python, None if there is none to use."""
    made_of = (record(kernel) or {}).get("mathematics")
    return _listed(kernel, "libraries", platform) if made_of == mathematics.digest() else None


def has_objects(kernel: str) -> bool:
    """Tell if the objects of a kernel module are shipped and can be used."""
    return _listed(kernel, "objects") is not None


@cache
def _archive(kernel: str) -> Mapping[str, bytes]:
    path = _listed(kernel, "objects")
    try:
        return unpack(path.read_bytes()) if path else {}
    except (OSError, tarfile.TarError):  # also where this Python was built without lzma
        return {}


def objects_of(kernel: str) -> dict[tuple[str, str], bytes]:
    """Return (platform, level) -> object file of a kernel module; empty if none can be used."""
    return objects_in(_archive(kernel))


def is_linked(kernel: str, digest: str) -> bool:
    """Tell if the libraries for FMUs of a kernel module are shipped, made of what ``digest`` is."""
    return (record(kernel) or {}).get("fmu") == digest and has_objects(kernel)


def fmu_libraries(kernel: str, digest: str) -> dict[str, bytes]:
    """Return platform -> library for FMUs of a kernel module; empty if none can be used."""
    found = _archive(kernel) if is_linked(kernel, digest) else {}
    return {n.removeprefix(FMU): data for n, data in found.items() if n.startswith(FMU)}


def portable(kernel: str, made_of: str) -> dict[str, bytes]:
    """Return file name -> C of a kernel module; empty if none can be used that is ``made_of``."""
    path = _listed(kernel, "portable")
    if path is None or (record(kernel) or {})["portable"].get("made_of") != made_of:
        return {}
    try:
        return unpack(path.read_bytes())
    except (OSError, tarfile.TarError):  # also where this Python was built without lzma
        return {}


def unpack(data: bytes) -> dict[str, bytes]:
    """Return the files in an archive."""
    with tarfile.open(fileobj=io.BytesIO(data)) as archive:
        members = [(about.name, archive.extractfile(about)) for about in archive]
        return {name: file.read() for name, file in members if file}


def objects_in(archive: Mapping[str, bytes]) -> dict[tuple[str, str], bytes]:
    """Return the objects in an unpacked archive."""
    names = [name for name in archive if name.endswith(".o")]
    parts = {name: name.removesuffix(".o").rpartition("-") for name in names}
    return {(p[0], p[2]): archive[name] for name, p in parts.items()}


def read_again() -> None:
    """Forget what was read: the files have changed."""
    for read_once in (index, record, _archive):
        read_once.cache_clear()


def short(kernel: str) -> str:
    """Return the name of a kernel module for file names."""
    own = kernel.removeprefix(f"{PACKAGE}.").removesuffix(".step").removesuffix(".kernels")
    return own.replace(".", "_")
