"""The shared library inside a native FMU."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from importlib import metadata
from pathlib import Path

from ...errors import ParameterError
from ...models._spec import ModelSpec
from ...native import digest, link, linked
from ...native.files import Note, to_stderr
from ...native.objects import objects
from ...native.targets import GLIBC, PLATFORMS, Platform
from ..build import source_folder
from ..registry import kernel_module
from . import calls, tables


def library(
    spec: ModelSpec, *, fmi: int, guid: str, platform: str, level: str | None = None,
    linker: link.Linker | None = None, note: Note = to_stderr,
) -> bytes:  # fmt: skip
    """Return the shared library of a model for one platform.

    Parameters
    ----------
    spec
        The model.
    fmi
        2 or 3.
    guid
        Compiled in: a description of another build is refused.
    platform
        A key of ``targets.PLATFORMS``.
    level
        The one CPU level of the platform to compile for; None: all, chosen by the CPU at run time.
    linker
        None: that of ``link.find_linker``.
    note
        Called with a line of progress before anything that takes long.

    Raises
    ------
    ParameterError : there is no such platform
    EnvironmentProblem : something is missing to build it; the message says what
    """
    if platform not in PLATFORMS:
        raise ParameterError(f"platform = {platform!r}, allowed: {' or '.join(PLATFORMS)}")
    target = PLATFORMS[platform]
    if level:
        target = replace(target, levels=tuple(x for x in target.levels if x.name == level))
    files: dict[str, str | bytes] = {**shell(fmi), **headers(fmi)}
    files |= tables.sources(spec, fmi=fmi, guid=guid)
    exports = calls.functions(fmi)
    kernel = kernel_module(spec.kernel)
    return link_kernel(files, kernel, target, spec.name, exports, linker=linker, note=note)


def link_kernel(
    files: Mapping[str, str | bytes],
    kernel: str,
    platform: Platform,
    name: str,
    exports: Iterable[str],
    *,
    linker: link.Linker | None = None,
    note: Note = to_stderr,
) -> bytes:
    """Return C files linked with the dispatch to a kernel's objects, checked for what it needs."""
    code = objects(kernel, [platform], note)
    parts = {f"kernel_{level}.o": content for (_, level), content in code.items()}
    levels = platform.levels
    defines = [f"TW_LEVEL={levels[0].name}"] if len(levels) == 1 else []
    linker = linker or link.find_linker()
    made = link.shared_library(
        {**files, **dispatch(), **parts}, platform=platform, name=name, defines=defines,
        linker=linker, note=note,
    )  # fmt: skip
    glibc = GLIBC if linker.is_cross else None
    linked.check(made, exports=exports, glibc=glibc)
    return made


def shell(fmi: int) -> dict[str, bytes]:
    """Return the C files of the shell for one version of FMI, and its headers."""
    folder = source_folder() / "shell"
    names = [*tables.shell_files(fmi), *(f.name for f in sorted(folder.glob("*.h")))]
    return {name: (folder / name).read_bytes() for name in names}


def dispatch() -> dict[str, bytes]:
    """Return the C files between plain C and the kernels; they include the generated model.h."""
    folder = source_folder() / "shell"
    found = {name: (folder / name).read_bytes() for name in ("dispatch.c", "kernel.h", "tables.h")}
    return {**found, "cpu.h": (digest.HERE / "cpu.h").read_bytes()}


def headers(fmi: int) -> dict[str, bytes]:
    """Return the standard's C headers, from the package FMPy."""
    folder = Path(str(metadata.distribution("fmpy").locate_file("fmpy"))) / "c-code"
    return {f.name: f.read_bytes() for f in sorted(folder.glob(f"fmi{fmi}*.h"))}
