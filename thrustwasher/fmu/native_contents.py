"""What only the native target carries: one compiled library per platform."""

from collections.abc import Callable, Sequence
from importlib import metadata

from ..errors import ParameterError
from ..models._spec import ModelSpec
from ..store.maps import all_maps, plain
from .native.here import this_level, this_platform
from .native.link import find_linker
from .native.targets import PLATFORMS, Platform
from .universal import universal

Note = Callable[[str], None]
CURE = "pip install 'thrustwasher[build]'"


def chosen(platforms: Sequence[str] | None, note: Note) -> tuple[str, ...]:
    """Return the platforms to build for: those asked for, else all the compiler can do."""
    possible = find_linker().platforms
    if platforms is None:
        if len(possible) < len(PLATFORMS):
            note(f"building for {', '.join(possible)} only; for all platforms: {CURE}")
        return possible
    for name in platforms:
        if name not in PLATFORMS:
            raise ParameterError(f"platform = {name!r}, allowed: {', '.join(PLATFORMS)}")
        if name not in possible:
            raise ParameterError(
                f"platform = {name!r}, allowed here: {', '.join(possible)}; for the others: {CURE}"
            )
    return tuple(name for name in PLATFORMS if name in platforms)


def this_machine() -> tuple[str, str]:
    """Return the names of this machine's platform and of the CPU level that suits it best."""
    platform = this_platform()
    return platform.name, this_level(platform).name


def tools() -> str:
    """Return names and versions of everything that compiles or links."""
    packages = ("numba", "llvmlite", "fmpy")
    versions = [f"{name} {metadata.version(name)}" for name in packages]
    linker = find_linker()
    return ", ".join([*versions, f"{linker.name} {linker.version}"])


def native_contents(
    spec: ModelSpec, *, fmi: int, guid: str, platforms: Sequence[str], note: Note,
    level: str | None = None,
) -> dict[str, bytes]:  # fmt: skip
    """Return the libraries, each at its place; the two of macOS share one file in FMI 2."""
    from .native.library import library  # reads the shell's sources, and these lie beside ours

    found: dict[str, list[bytes]] = {}
    for name in platforms:
        note(f"{spec.name}: {name}")
        path = _place(PLATFORMS[name], fmi, spec.name)
        made = library(spec, fmi=fmi, guid=guid, platform=name, level=level, note=note)
        found.setdefault(path, []).append(made)
    libraries = {path: parts[0] if len(parts) == 1 else universal(parts)
                 for path, parts in found.items()}  # fmt: skip
    return libraries | table_files(spec)


def table_files(spec: ModelSpec) -> dict[str, bytes]:
    """Return the tables that the model may read while it starts."""
    if not spec.table:
        return {}
    return {f"resources/map-{k}.bin": plain(file) for k, file in enumerate(all_maps())}


def _place(platform: Platform, fmi: int, model: str) -> str:
    folder = platform.fmi2 if fmi == 2 else platform.fmi3
    return f"binaries/{folder}/{model}.{platform.extension}"
