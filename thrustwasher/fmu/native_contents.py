"""What only the native target carries: one compiled library per platform."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from importlib import metadata

from ..errors import ParameterError
from ..models._spec import ModelSpec
from ..native import shipped
from ..native.here import this_level, this_platform
from ..native.link import Linker, find_linker, local_linker
from ..native.objects import prepare
from ..native.targets import PLATFORMS, Platform
from ..store.maps import all_maps, plain
from .registry import kernel_module, load_kernel
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


def local_level(spec: ModelSpec) -> str | None:
    """Return the CPU level that is compiled for use on this machine only, None: all of them.

    What is shipped has them all; what has to be compiled is compiled for this processor alone.
    """
    if shipped.has_objects(kernel_module(spec.kernel)):
        return None
    return this_level(this_platform()).name


def tools(linker: Linker) -> str:
    """Return names and versions of everything that links, with the C headers' package."""
    return f"fmpy {metadata.version('fmpy')}, {linker.name} {linker.version}"


def made_of(spec: ModelSpec, *, local: bool) -> str:
    """Return what decides a model's libraries beside the FMU's own texts."""
    kernel = kernel_module(spec.kernel)
    linker = local_linker() if local else find_linker()
    return f"{shipped.digest_now(kernel)} {tools(linker)} {local_level(spec) if local else ''}"


def compile_local(specs: Iterable[ModelSpec], note: Note) -> None:
    """Compile models for use on this machine, side by side, unless they are compiled already."""
    platform = this_platform()
    # The model with the most memory has the most code; begun last it would run alone at the end.
    largest_first = sorted(specs, key=lambda spec: -load_kernel(spec.kernel).n_work)
    missing = [spec for spec in largest_first if local_level(spec)]
    if missing:
        one = replace(platform, levels=(this_level(platform),))
        prepare([kernel_module(spec.kernel) for spec in missing], [one], note)


def native_contents(
    spec: ModelSpec, *, fmi: int, guid: str, platforms: Sequence[str], note: Note,
    local: bool = False,
) -> dict[str, bytes]:  # fmt: skip
    """Return the libraries, each at its place; the two of macOS share one file in FMI 2.

    ``local``: linked and compiled for use on this machine only, the soonest way.
    """
    from .native.library import library  # reads the shell's sources, and these lie beside ours

    level, linker = (local_level(spec), local_linker()) if local else (None, None)
    found: dict[str, list[bytes]] = {}
    for name in platforms:
        note(f"{spec.name}: {name}")
        path = _place(PLATFORMS[name], fmi, spec.name)
        made = library(
            spec, fmi=fmi, guid=guid, platform=name, level=level, linker=linker, note=note
        )
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
