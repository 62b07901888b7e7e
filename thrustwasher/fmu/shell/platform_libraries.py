"""The shared libraries inside native FMUs: the C shell linked with kernels, one per platform."""

import struct
from collections.abc import Sequence
from dataclasses import replace
from importlib import metadata
from pathlib import Path

from ...errors import ParameterError
from ...model.prepare import tables_of
from ...model.spec import ModelSpec
from ...native import digest, shipped
from ...native.files import Note, to_stderr
from ...native.library import linked_objects
from ...native.link import Linker, find_linker, local_linker, this_level, this_platform
from ...native.objects import objects
from ...native.targets import PLATFORMS
from ..package.model_sources import source_folder
from . import c_tables, call_table

CURE = "pip install 'thrustwasher[build]'"
# Of a macOS library for several processors, big-endian, as Apple's <mach-o/fat.h> defines them.
FAT, FAT_HEADER, FAT_ENTRY = 0xCAFEBABE, ">II", ">IIIII"
FAT_ALIGNMENT = 14  # as a power of two: the page of arm64


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
    if shipped.has_objects(spec.kernel):
        return None
    return this_level(this_platform()).name


def tools(linker: Linker) -> str:
    """Return names and versions of everything that links, with the C headers' package."""
    return f"fmpy {metadata.version('fmpy')}, {linker.name} {linker.version}"


def made_of(spec: ModelSpec, *, local: bool) -> str:
    """Return what decides a model's libraries beside the FMU's own texts."""
    kernel = spec.kernel
    linker = local_linker() if local else find_linker()
    return f"{shipped.digest_now(kernel)} {tools(linker)} {local_level(spec) if local else ''}"


def native_contents(
    spec: ModelSpec, *, fmi: int, guid: str, platforms: Sequence[str], note: Note,
    local: bool = False,
) -> dict[str, bytes]:  # fmt: skip
    """Return the libraries, each at its place, and the tables that the model may read.

    The two libraries of macOS share one file in FMI 2. ``local``: linked and compiled for use on
    this machine only, the soonest way.
    """
    level, linker = (local_level(spec), local_linker()) if local else (None, None)
    found: dict[str, list[bytes]] = {}
    for name in platforms:
        note(f"{spec.name}: {name}")
        made = library(
            spec, fmi=fmi, guid=guid, platform=name, level=level, linker=linker, note=note
        )
        target = PLATFORMS[name]
        folder = target.fmi2 if fmi == 2 else target.fmi3
        found.setdefault(f"binaries/{folder}/{spec.name}.{target.extension}", []).append(made)
    tables = tables_of(spec)
    files = map(tables.resource, tables.readable()) if tables else ()
    resources = {f"resources/map-{k}.bin": file for k, file in enumerate(files)}
    return resources | {
        path: parts[0] if len(parts) == 1 else universal(parts) for path, parts in found.items()
    }


def library(
    spec: ModelSpec, *, fmi: int, guid: str, platform: str, level: str | None = None,
    linker: Linker | None = None, note: Note = to_stderr,
) -> bytes:  # fmt: skip
    """Return the shared library of a model for one platform, a key of ``PLATFORMS``.

    ``guid`` is compiled in: a description of another build is refused. ``level`` is the one CPU
    level to compile for; None: all, chosen by the CPU at run time. ``note`` is called with a line
    of progress before anything that takes long.
    """
    if platform not in PLATFORMS:
        raise ParameterError(f"platform = {platform!r}, allowed: {' or '.join(PLATFORMS)}")
    target = PLATFORMS[platform]
    if level:
        target = replace(target, levels=tuple(x for x in target.levels if x.name == level))
    files: dict[str, str | bytes] = {**shell(fmi), **headers(fmi), **dispatch()}
    files |= c_tables.sources(spec, fmi=fmi, guid=guid)
    return linked_objects(
        files, objects(spec.kernel, [target], note), target, spec.name, call_table.functions(fmi),
        linker=linker, note=note,
    )  # fmt: skip


def shell(fmi: int) -> dict[str, bytes]:
    """Return the C files of the shell for one version of FMI, and its headers."""
    folder = source_folder() / "shell"
    names = [*c_tables.shell_files(fmi), *(f.name for f in sorted(folder.glob("*.h")))]
    return {name: (folder / name).read_bytes() for name in names}


def dispatch() -> dict[str, bytes]:
    """Return the C files between plain C and the kernels; they include the generated model.h."""
    folder = source_folder() / "shell"
    found = {name: (folder / name).read_bytes() for name in ("dispatch.c", "kernel.h", "tables.h")}
    return {**found, "cpu.h": (digest.HERE / "c" / "cpu.h").read_bytes()}


def headers(fmi: int) -> dict[str, bytes]:
    """Return the standard's C headers, from the package FMPy."""
    folder = Path(str(metadata.distribution("fmpy").locate_file("fmpy"))) / "c-code"
    return {f.name: f.read_bytes() for f in sorted(folder.glob(f"fmi{fmi}*.h"))}


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
