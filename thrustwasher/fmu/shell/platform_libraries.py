"""The shared libraries inside native FMUs: the C shell linked with kernels, one per platform.

A library serves every part of its model, both versions of FMI, and Python, which loads its kernels:
what is an FMU's own lies in its resources. The libraries of the package's models are shipped;
others are linked when they are requested, and kept in the user's cache.
"""

import hashlib
import struct
from collections.abc import Iterable, Sequence
from contextlib import suppress
from importlib import metadata
from pathlib import Path

from ...errors import ParameterError
from ...model.prepare import tables_of
from ...model.registry import all_specs
from ...model.spec import ModelSpec
from ...native import digest, files, mathematics, shipped
from ...native.compiling.objects import objects
from ...native.files import Note, to_stderr
from ...native.kept import kept_folder
from ...native.library import TABLE, linked_objects, local_platform, table_sources
from ...native.link import COMMON, Linker, find_linker, local_linker
from ...native.targets import PLATFORMS, Platform
from ..description.interface import Interface, interface
from ..package.model_sources import Order, source_folder
from . import c_tables, call_table

CURE = "pip install 'thrustwasher[build]'"
# Of a macOS library for several processors, big-endian, as Apple's <mach-o/fat.h> defines them.
FAT, FAT_HEADER, FAT_ENTRY = 0xCAFEBABE, ">II", ">IIIII"
FAT_ALIGNMENT = 14  # as a power of two: the page of arm64


def chosen(
    platforms: Sequence[str] | None, note: Note, specs: Iterable[ModelSpec]
) -> tuple[str, ...]:
    """Return the platforms to build for: those requested, else all that can be had."""
    shipped_all = all(is_shipped(spec) for spec in specs)
    possible = tuple(PLATFORMS) if shipped_all else find_linker().platforms
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


def tools(linker: Linker) -> str:
    """Return names and versions of everything that links, with the C headers' package."""
    return f"fmpy {metadata.version('fmpy')}, {linker.name} {linker.version}"


def library_identity(spec: ModelSpec, *, local: bool) -> str:
    """Return what decides a model's libraries next to the FMU's own texts."""
    if is_shipped(spec):
        return library_digest(spec)
    linker = local_linker() if local else find_linker()
    levels = _levels(local_platform(spec.kernel)) if local else ""
    return f"{library_digest(spec)} {tools(linker)} {levels}"


def _levels(platform: Platform) -> str:
    return "-".join(level.name for level in platform.levels)


def require_linker() -> None:
    """Raise EnvironmentProblem if FMUs have to be linked and nothing links: before compiling."""
    if not all(map(is_shipped, all_specs(helpers=True))):
        local_linker()


def native_contents(shown: Interface, order: Order, guid: str) -> dict[str, bytes]:
    """Return the libraries, each at its place, and the resources that they read.

    The two libraries of macOS share one file in FMI 2. What has to be linked and compiled for this
    machine only is made the soonest way.
    """
    spec, found = shown.spec, dict[str, list[bytes]]()
    for name in order.platforms:
        made = library(spec, platform=name, local=order.local, note=order.note)
        target = PLATFORMS[name]
        folder = target.fmi2 if order.fmi == 2 else target.fmi3
        found.setdefault(f"binaries/{folder}/{spec.name}.{target.extension}", []).append(made)
    return {
        f"resources/{c_tables.PART}": c_tables.part_file(shown, guid),
        **{f"resources/map-{k}.bin": data for k, data in enumerate(_maps(spec, order.local))},
        **{p: parts[0] if len(parts) == 1 else universal(parts) for p, parts in found.items()},
    }


def _maps(spec: ModelSpec, local: bool) -> list[bytes]:
    """Return a model's tables that are shipped, or that of your own part if there is one.

    Those of other parameters are of no use to a part. ``local``: all that this machine has.
    """
    tables = tables_of(spec)
    if tables is None:
        return []
    if table := table_alone(spec):
        return [table]
    if not spec.kind:
        return [tables.resource(file) for file in tables.readable(not local)]
    with suppress(ParameterError):  # there is none for its parameters
        return [tables.resource(tables.find(spec.params()))]
    return []


def table_alone(spec: ModelSpec) -> bytes:
    """Return the table of a model that only looks up, as a file; empty for all others."""
    tables = tables_of(spec)
    if tables is None or spec.table_of is None:
        return b""
    return tables.resource(tables.find(spec.table_of))


def is_shipped(spec: ModelSpec) -> bool:
    """Tell if the model's libraries are in the package, for all platforms."""
    return shipped.is_linked(spec.kernel, library_digest(spec))


def library(
    spec: ModelSpec, *, platform: str, local: bool = False, note: Note = to_stderr
) -> bytes:
    """Return the shared library of a model for one platform, a key of ``PLATFORMS``.

    It is the one shipped, else one kept from an earlier run, else it is linked. ``local``: for this
    machine alone. ``note`` is called with a line of progress before anything that takes long.
    """
    if platform not in PLATFORMS:
        raise ParameterError(f"platform = {platform!r}, allowed: {' or '.join(PLATFORMS)}")
    made = library_digest(spec)
    if own := shipped.fmu_libraries(spec.kernel, made).get(platform):
        return own
    linker = local_linker() if local else find_linker()
    target = local_platform(spec.kernel) if local else PLATFORMS[platform]
    by = f"{linker.name}-{linker.version}-{_levels(target)}"
    place = kept_folder(spec.kernel) / f"fmu-{made}-{platform}-{by}.{target.extension}"
    data = files.kept(place)
    if data is None:
        note(f"{spec.name}: its library for {platform} is not shipped: {linker.name} links it")
        data = linked(spec, target, linker, note)
        with suppress(OSError):  # it is linked again the next time
            files.keep(place, data)
    return data


def linked(spec: ModelSpec, platform: Platform, linker: Linker, note: Note = to_stderr) -> bytes:
    """Link the shared library of a model for one platform; nothing that was made before is used."""
    exports = [TABLE, *(n for fmi in c_tables.VERSIONS for n in call_table.functions(fmi))]
    parts, code = {**sources(spec), **headers()}, objects(spec.kernel, [platform], note)
    name = shipped.short(spec.kernel)
    return linked_objects(parts, code, platform, name, exports, linker=linker, note=note)


def library_digest(spec: ModelSpec) -> str:
    """Return 16 hex digits over all that a model's libraries are made of, compilers aside."""
    kernels = f"{digest.digest(spec.kernel)} {mathematics.digest()}"
    hashed = hashlib.sha256(f"{kernels} {COMMON}".encode())
    for name, content in sorted(sources(spec).items()):
        hashed.update(f"{name}\0{len(content)}\0".encode() + content)
    return hashed.hexdigest()[:16]


def sources(spec: ModelSpec) -> dict[str, bytes]:
    """Return the C files of a model's libraries, but the standard's headers."""
    tables = {name: text.encode() for name, text in c_tables.sources(interface(spec)).items()}
    folder = source_folder() / "shell"
    names = [*c_tables.SHELL_FILES, *(f.name for f in sorted(folder.glob("*.h")))]
    shell = {name: digest.read(folder / name) for name in names}
    return shell | dispatch() | tables | table_sources(spec.kernel)


def dispatch() -> dict[str, bytes]:
    """Return the C files between plain C and the kernels; they include the generated model.h."""
    folder = source_folder() / "shell"
    found = {name: digest.read(folder / name) for name in ("dispatch.c", "kernel.h", "tables.h")}
    return {**found, "cpu.h": digest.read(digest.HERE / "c" / "cpu.h")}


def headers() -> dict[str, bytes]:
    """Return the standard's C headers, from the package FMPy."""
    folder = Path(str(metadata.distribution("fmpy").locate_file("fmpy"))) / "c-code"
    return {f.name: f.read_bytes() for f in sorted(folder.glob("fmi[23]*.h"))}


def universal(parts: Sequence[bytes]) -> bytes:
    """Return one macOS file of several 64-bit Mach-O libraries: a table of contents, then each.

    Each part begins with magic, processor and subtype, little-endian; the table repeats the last
    two. Parts start at whole pages.
    """
    table = struct.pack(FAT_HEADER, FAT, len(parts))
    end = struct.calcsize(FAT_HEADER) + len(parts) * struct.calcsize(FAT_ENTRY)
    body = b""
    for part in parts:
        processor, subtype = struct.unpack_from("<II", part, 4)
        gap = -end % (1 << FAT_ALIGNMENT)
        table += struct.pack(FAT_ENTRY, processor, subtype, end + gap, len(part), FAT_ALIGNMENT)
        body += bytes(gap) + part
        end += gap + len(part)
    return table + body
