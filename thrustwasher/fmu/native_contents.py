"""What only the native target carries: one compiled library per platform."""

import importlib
from collections.abc import Callable, Sequence
from importlib import metadata
from typing import Any

from ..errors import ParameterError
from ..models._spec import ModelSpec
from .universal import universal

Note = Callable[[str], None]


def _native(name: str) -> Any:
    try:
        return importlib.import_module(f"{__package__}.native.{name}")
    except ModuleNotFoundError as problem:
        raise ParameterError(
            f"target = 'native', allowed: python; the compiler is missing: {problem}"
        ) from None


def chosen(platforms: Sequence[str] | None, note: Note) -> tuple[str, ...]:
    """Return the platforms to build for: those asked for, else all the compiler can do."""
    platforms_known = _native("targets").PLATFORMS
    possible = tuple(_native("link").find_linker().platforms)
    if platforms is None:
        if len(possible) < len(platforms_known):
            note(f"building for {', '.join(possible)} only: for all platforms pip install ziglang")
        return possible
    for name in platforms:
        if name not in platforms_known:
            raise ParameterError(f"platform = {name!r}, allowed: {', '.join(platforms_known)}")
        if name not in possible:
            raise ParameterError(
                f"platform = {name!r}, allowed here: {', '.join(possible)}; for the others pip "
                "install ziglang"
            )
    return tuple(name for name in platforms_known if name in platforms)


def this_machine() -> tuple[str, str]:
    """Return the names of this machine's platform and of the CPU level that suits it best."""
    here = _native("here")
    platform = here.this_platform()
    return platform.name, here.this_level(platform).name


def tools() -> str:
    """Return names and versions of everything that compiles or links."""
    packages = ("numba", "llvmlite", "fmpy")
    versions = [f"{name} {metadata.version(name)}" for name in packages]
    return ", ".join([*versions, _native("link").find_linker().version])


def native_contents(
    spec: ModelSpec, *, fmi: int, guid: str, platforms: Sequence[str], note: Note,
    level: str | None = None,
) -> dict[str, bytes]:  # fmt: skip
    """Return the libraries, each at its place; the two of macOS share one file in FMI 2."""
    library, known = _native("library").library, _native("targets").PLATFORMS
    found: dict[str, list[bytes]] = {}
    for name in platforms:
        note(f"{spec.name}: {name}")
        path = _place(known[name], fmi, spec.name)
        made = library(spec, fmi=fmi, guid=guid, platform=name, level=level)
        found.setdefault(path, []).append(made)
    return {path: parts[0] if len(parts) == 1 else universal(parts)
            for path, parts in found.items()}  # fmt: skip


def _place(platform: Any, fmi: int, model: str) -> str:
    folder = platform.fmi2 if fmi == 2 else platform.fmi3
    return f"binaries/{folder}/{model}.{platform.extension}"
