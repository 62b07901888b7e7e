"""documentation/licenses of an FMU: ours, and one notice for each part that comes from others."""

import re
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path

from ...errors import EnvironmentProblem
from ...model.toml_tables import table_beside
from .model_sources import PACKAGE

PLACE = "documentation/licenses"
NOTICES = PACKAGE / "data" / "notices"  # of what linked the libraries
SUMMARY = """Parts of this FMU and their licences; the full texts are next to this file.

{parts}
None of them asks for anything but that these notices are kept. This list is no legal advice.
"""
# Of "native", "mingw" and "python" FMUs: part -> file, licence, what it is; in this order.
PARTS = table_beside(__file__, "notices.toml")


def licences(
    target: str, platforms: Sequence[str] = (), *, c_sources: bool = False
) -> dict[str, bytes]:
    """Return the notices of everything in an FMU, by path; none is empty."""
    rows = listed_licences(target, platforms, c_sources=c_sources)
    files = {row[0]: _text(row[0]) for row in rows}
    lines = [f"{name}: {part}, {licence} ({where})" for name, part, licence, where in rows]
    files["overview.txt"] = SUMMARY.format(parts="\n".join([*lines, ""])).encode()
    return {f"{PLACE}/{name}": content for name, content in files.items()}


def listed_licences(
    target: str, platforms: Sequence[str] = (), *, c_sources: bool = False
) -> list[tuple[str, str, str, str]]:
    """Return (file, part, licence, where) of each part of an FMU."""
    mingw = target == "native" and "win64" in platforms
    parts = PARTS[target] | (PARTS["mingw"] if mingw else {})
    parts |= PARTS["sources"] if c_sources else {}
    return [(name, part, licence, where) for part, (name, licence, where) in parts.items()]


def _text(name: str) -> bytes:
    """Return one notice, from the package it belongs to."""
    if name == "license.txt":
        beside = PACKAGE.parent / "LICENSE"
        return _read(beside) if beside.is_file() else _distributed("thrustwasher", "LICENSE")
    if name == "fmi-headers.txt":
        # the copyright notice inside the FMI headers
        header = _read(_package("fmpy") / "c-code" / "fmi2Functions.h").decode("utf-8")
        found = re.search(r"Copyright.*?POSSIBILITY OF SUCH DAMAGE\.", header, re.DOTALL)
        if not found:
            raise EnvironmentProblem(
                "the FMI headers of FMPy carry no notice; install another FMPy"
            )
        lines = [line.strip() for line in found[0].splitlines()]
        return ("\n".join(lines) + "\n").encode()
    if name == "llvm.txt":
        return _distributed("llvmlite", "LICENSE.thirdparty")
    if name in ("zig.txt", "mingw-w64.txt", "musl.txt"):
        return _read(NOTICES / name)
    return _distributed(name.removesuffix(".txt"), "LICENSE")


def _package(name: str) -> Path:
    return Path(str(metadata.distribution(name).locate_file(name)))


def _distributed(package: str, name: str) -> bytes:
    """Return a file of that name that came with a package."""
    try:
        listed = metadata.files(package) or []
    except metadata.PackageNotFoundError:
        listed = []
    for file in listed:
        if file.name == name:
            return _read(Path(str(file.locate())))
    raise EnvironmentProblem(
        f"{name} of the package {package} is missing, and an FMU must carry it; install {package} "
        "again"
    )


def _read(file: Path) -> bytes:
    try:
        content = file.read_bytes()
    except OSError:
        content = b""
    if not content.strip():
        raise EnvironmentProblem(
            f"the notice {file.name} is missing or empty; it must be in an FMU"
        )
    return content
