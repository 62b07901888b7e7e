"""Which packages are here, and the versions of each that this package was tried with."""

import platform
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib import metadata, resources

from packaging.requirements import Requirement
from packaging.version import Version

from ..errors import ParameterError

HOME = __name__.partition(".")[0]
OPTIONAL = ("build", "sweep", "data", "notebooks")  # extras that give commands more to do


@dataclass(frozen=True, slots=True)
class Range:
    """A package, the oldest version that it may have here and the newest that was tried."""

    name: str
    oldest: str
    newest: str

    def __str__(self) -> str:
        return f"{self.oldest} .. {self.newest}"


@cache
def newest_tried() -> dict[str, str]:
    """Return package or "python" -> the newest version that the tests ran with."""
    found: dict[str, str] = tomllib.loads(
        (resources.files(HOME) / "fmu" / "tried.toml").read_text("utf-8")
    )
    return found


def ranges(extra: str = "") -> Iterator[Range]:
    """Yield the packages that are required on this Python, by an extra if one is named."""
    oldest: dict[str, Version] = {}
    for line in metadata.requires(HOME) or ():
        asked = Requirement(line)
        is_extra = "extra" in str(asked.marker)
        applies = asked.marker is None or asked.marker.evaluate({"extra": extra})
        if asked.name == HOME or is_extra != bool(extra) or not applies:
            continue
        lower = (Version(s.version) for s in asked.specifier if s.operator in (">=", "=="))
        oldest[asked.name] = max(*lower, oldest.get(asked.name, Version("0")))
    for name, version in oldest.items():
        yield Range(name, str(version), newest_tried().get(name, str(version)))


def described(asked: Range) -> str:
    """Return the version that is installed and the range that was tried; a newer one is a note.

    ParameterError: it is missing, or older than what is required.
    """
    try:
        return _beside(metadata.version(asked.name), asked)
    except metadata.PackageNotFoundError:
        raise ParameterError(f"{asked.name} is not installed (tried: {asked})") from None


def python() -> str:
    """Return the version of this Python and the range that was tried."""
    lowest = Requirement(f"python{metadata.metadata(HOME)['Requires-Python']}").specifier
    oldest = next(s.version for s in lowest if s.operator == ">=")
    return _beside(platform.python_version(), Range("python", oldest, newest_tried()["python"]))


def _beside(version: str, asked: Range) -> str:
    here, newest = Version(version), Version(asked.newest)
    if here < Version(asked.oldest):
        raise ParameterError(f"{version} is older than what is required: {asked}")
    if here.release[: len(newest.release)] > newest.release:
        return f"{version}, newer than what was tried ({asked}): it may well do"
    return f"{version} (tried: {asked})"
