"""The compiled files inside the package: objects of all platforms, libraries made of them.

``index.json`` lists for each kernel module the sources it was made from, the digest of their code,
and the files with their checksums. Code that differs, or a file that is not as listed, and it is
as if nothing had been shipped: what is needed is compiled again. An archive holds a module's
objects and the libraries that were linked with them, those of the FMUs, which Python loads too:
they have most in common, which is stored once. Beside the archives lie modules for browsers.
"""

import io
import json
import tarfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from . import mathematics
from .digest import HERE, PACKAGE, digest
from .files import checksum, to_stderr

FOLDER = HERE.parent / "data" / "native"
INDEX = "index.json"
LIBRARY = "library/"  # in an archive, before the platforms of libraries


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
    """Return what is shipped for a kernel module, None if its code has changed since."""
    about: dict[str, Any] | None = index()["kernels"].get(kernel)
    if not isinstance(about, dict):
        return None
    return about if about.get("digest") == digest(kernel) else None


def _listed(kernel: str, part: str) -> Path | None:
    """Return a listed file if it is fresh and as it was when it was listed."""
    try:
        about = (record(kernel) or {})[part]
        path = FOLDER / about["file"]
        return path if checksum(path.read_bytes()) == about["sha256"] else None
    except (OSError, KeyError, TypeError):
        return None


def web_file(kernel: str) -> Path | None:
    """Return the shipped module of a kernel module for browsers, None if there is none to use."""
    return _listed(kernel, "web") if _has_mathematics(kernel) else None


def library(kernel: str, platform: str) -> bytes | None:
    """Return the shipped library that Python loads, a model's is that of its FMUs; else None."""
    return _archive(kernel).get(LIBRARY + platform) if _has_mathematics(kernel) else None


def _has_mathematics(kernel: str) -> bool:
    """Tell if what is linked has the mathematical functions of now."""
    return (record(kernel) or {}).get("mathematics") == mathematics.digest()


def has_objects(kernel: str) -> bool:
    """Tell if the objects of a kernel module are shipped and can be used."""
    return _listed(kernel, "objects") is not None


@cache
def _archive(kernel: str) -> Mapping[str, bytes]:
    path = _listed(kernel, "objects")
    try:
        return unpack(path.read_bytes()) if path else {}
    except tarfile.CompressionError:
        to_stderr(f"this Python was built without lzma: {short(kernel)} is compiled once instead")
    except (OSError, tarfile.TarError):
        pass
    return {}


def objects_of(kernel: str) -> dict[tuple[str, str], bytes]:
    """Return (platform, level) -> object file of a kernel module; empty if none can be used."""
    found = {n.removesuffix(".o"): data for n, data in _archive(kernel).items() if n.endswith(".o")}
    return {(n.rpartition("-")[0], n.rpartition("-")[2]): data for n, data in found.items()}


def is_linked(kernel: str, digest: str) -> bool:
    """Tell if the libraries for FMUs of a kernel module are shipped, made of what ``digest`` is."""
    return (record(kernel) or {}).get("fmu") == digest and has_objects(kernel)


def fmu_libraries(kernel: str, digest: str) -> dict[str, bytes]:
    """Return platform -> library for FMUs of a kernel module; empty if none can be used."""
    found = _archive(kernel) if is_linked(kernel, digest) else {}
    return {n.removeprefix(LIBRARY): data for n, data in found.items() if n.startswith(LIBRARY)}


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
    with tarfile.open(fileobj=io.BytesIO(data), mode="r:xz") as archive:
        # one after the other: to go back in it is to unpack it again
        members = ((about.name, archive.extractfile(about)) for about in archive)
        return {name: file.read() for name, file in members if file}


def short(kernel: str) -> str:
    """Return the name of a kernel module for file names."""
    own = kernel.removeprefix(f"{PACKAGE}.").removesuffix(".step").removesuffix(".kernels")
    return own.replace(".", "_")
