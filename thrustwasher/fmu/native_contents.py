"""What only the native target carries: one compiled library per platform."""

from collections.abc import Callable, Sequence
from importlib import metadata
from typing import Any

from ..errors import ParameterError
from ..models._spec import ModelSpec
from .universal import universal

Note = Callable[[str], None]


def chosen(platforms: Sequence[str] | None, note: Note) -> tuple[str, ...]:
    """Return the platforms to build for: those asked for, else all the compiler can do."""
    from .native.link import find_linker
    from .native.targets import PLATFORMS

    possible = tuple(find_linker().platforms)
    if platforms is None:
        if len(possible) < len(PLATFORMS):
            note(f"building for {', '.join(possible)} only: for all platforms pip install ziglang")
        return possible
    for name in platforms:
        if name not in PLATFORMS:
            raise ParameterError(f"platform = {name!r}, allowed: {', '.join(PLATFORMS)}")
        if name not in possible:
            raise ParameterError(
                f"platform = {name!r}, allowed here: {', '.join(possible)}; for the others pip "
                "install ziglang"
            )
    return tuple(name for name in PLATFORMS if name in platforms)


def tools() -> str:
    """Return names and versions of everything that compiles or links."""
    from .native.link import find_linker

    packages = ("numba", "llvmlite", "fmpy")
    versions = [f"{name} {metadata.version(name)}" for name in packages]
    return ", ".join([*versions, find_linker().version])


def native_contents(
    spec: ModelSpec, *, fmi: int, guid: str, platforms: Sequence[str], note: Note
) -> dict[str, bytes]:
    """Return the libraries, each at its place; the two of macOS share one file in FMI 2."""
    from .native.library import library
    from .native.targets import PLATFORMS

    found: dict[str, list[bytes]] = {}
    for name in platforms:
        note(f"{spec.name}: {name}")
        path = _place(PLATFORMS[name], fmi, spec.name)
        made = library(spec, fmi=fmi, guid=guid, platform=name)
        found.setdefault(path, []).append(made)
    return {path: parts[0] if len(parts) == 1 else universal(parts)
            for path, parts in found.items()}  # fmt: skip


def _place(platform: Any, fmi: int, model: str) -> str:
    folder = platform.fmi2 if fmi == 2 else platform.fmi3
    return f"binaries/{folder}/{model}{platform.extension}"
