"""The compiled files inside the package: objects of all platforms, libraries for some.

``index.json`` lists for each kernel module the sources it was made from, their digest, and the
files with their checksums. A source that differs, or a file that is not as listed, and it is as if
nothing had been shipped: what is needed is compiled again.
"""

import io
import json
import zipfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from .digest import HERE, PACKAGE, digest, digest_of, read
from .files import checksum, zipped

FOLDER = HERE.parent / "data" / "native"
INDEX = "index.json"


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
    return _listed(kernel, "libraries", platform)


def has_objects(kernel: str) -> bool:
    """Tell if the objects of a kernel module are shipped and can be used."""
    return _listed(kernel, "objects") is not None


@cache
def objects_of(kernel: str) -> Mapping[tuple[str, str], bytes]:
    """Return (platform, level) -> object file of a kernel module; empty if none can be used."""
    path = _listed(kernel, "objects")
    return unpack(path.read_bytes()) if path else {}


def pack(objects: Mapping[tuple[str, str], bytes]) -> bytes:
    """Return a zip of objects."""
    return zipped({f"{platform}-{level}.o": data for (platform, level), data in objects.items()})


def unpack(data: bytes) -> dict[tuple[str, str], bytes]:
    """Return the objects in a zip of ``pack``."""
    found = {}
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        for name in archive.namelist():
            platform, _, level = name.removesuffix(".o").rpartition("-")
            found[platform, level] = archive.read(name)
    return found


def short(kernel: str) -> str:
    """Return the name of a kernel module for file names."""
    own = kernel.removeprefix(f"{PACKAGE}.").removesuffix(".step").removesuffix(".kernels")
    return own.replace(".", "_")
