"""From C files and objects to a shared library, for this platform or another; which one this is."""

import importlib.util
import os
import platform as this
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

from ..errors import EnvironmentProblem
from .files import Note, locked, to_stderr, user_cache
from .targets import PLATFORMS, Level, Platform

# -s: no symbols, no paths. Same files, same bytes: wherever the folder lies, whenever it is made.
COMMON = (
    *("-Os", "-std=c99", "-ffp-contract=off", "-fno-math-errno", "-fvisibility=hidden"),
    *("-s", "-I."),
)
# A module for browsers: zig's C library would bring mathematics once more.
ALONE = ("-nostdlib", "-Wl,--no-entry")
# What a processor must have for a level beyond the first one of its platform.
FEATURES = {"v3": ("avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe")}
SHORT, LONG = 6.0, 60.0  # seconds until something is printed, at the first build and at later ones
MISSING = (
    "native FMUs whose sources were edited need a C compiler to be built (not to be run): "
    "pip install 'thrustwasher[build]' for all platforms, or gcc for this one"
)


@dataclass(frozen=True, slots=True)
class Linker:
    """A C compiler that links: its command, its version and the platforms it can build for."""

    name: str
    command: tuple[str, ...]
    version: str
    platforms: tuple[str, ...]

    @property
    def is_cross(self) -> bool:
        """True for zig, which brings headers and C libraries of every platform."""
        return self.name == "ziglang"


@cache
def find_linker() -> Linker:
    """Return zig of the package ziglang, else this machine's gcc or cc, or say what to install."""
    if importlib.util.find_spec("ziglang"):
        from importlib import metadata  # late: 17 ms

        command = (sys.executable, "-m", "ziglang", "cc")
        return Linker("ziglang", command, metadata.version("ziglang"), tuple(PLATFORMS))
    local = _of_this_machine()
    if local is None:
        raise EnvironmentProblem(MISSING)
    return local


@cache
def local_linker() -> Linker:
    """Return what links for this machine soonest: its own compiler, else `find_linker`'s."""
    return _of_this_machine() or find_linker()


@cache
def _of_this_machine() -> Linker | None:
    found = shutil.which("gcc") or shutil.which("cc")
    own = tuple(p.name for p in PLATFORMS.values() if p.machine == local_machine())
    if not found or not own:
        return None
    shown = subprocess.run([found, "-dumpfullversion"], capture_output=True, text=True)
    return Linker(Path(found).name, (found,), shown.stdout.strip(), own)


def local_machine() -> tuple[str, str]:
    """Return the system and machine of this computer as ``Platform.machine`` names them."""
    return this.system(), this.machine().replace("amd64", "x86_64")


def this_platform() -> Platform:
    """Return the platform of this machine; EnvironmentProblem if native code is not made for it."""
    for platform in PLATFORMS.values():
        if platform.machine == local_machine():
            return platform
    raise EnvironmentProblem(
        f"native code is made for {', '.join(PLATFORMS)}, this is {' '.join(local_machine())}"
    )


def this_level(platform: Platform) -> Level:
    """Return the last of the platform's levels that this processor runs."""
    from llvmlite import binding

    has = binding.get_host_cpu_features()
    able = [x for x in platform.levels if all(has.get(f, False) for f in FEATURES.get(x.name, ()))]
    return able[-1]


def shared_library(
    files: Mapping[str, str | bytes],
    *,
    platform: Platform,
    name: str,
    defines: Sequence[str] = (),
    linker: Linker | None = None,
    note: Note = to_stderr,
) -> bytes:
    """Compile and link C files and objects to a shared library; EnvironmentProblem if that fails.

    No mathematical library is linked: what is needed of it is among the files.

    ``files``: name -> content; ``.c`` is compiled, ``.o`` linked, headers are found. ``name``,
    without extension, stands inside the file on macOS only. ``defines``: "NAME" or "NAME=VALUE".
    """
    output = f"{name}.{platform.extension}"
    kind = ALONE if platform.format == "WASM" else ("-shared",)
    flags = [*kind, *platform.flags]
    if platform.format == "MachO":
        flags.append(f"-Wl,-install_name,@rpath/{output}")
    platform = replace(platform, libraries=())
    return build(files, output, [*flags, *(f"-D{d}" for d in defines)], platform, linker, note)


def build(
    files: Mapping[str, str | bytes],
    output: str,
    flags: Sequence[str],
    platform: Platform,
    linker: Linker | None = None,
    note: Note = to_stderr,
) -> bytes:
    """Run the compiler in a fresh folder with relative paths only; return the file ``output``."""
    linker = linker or find_linker()
    if not linker.is_cross and platform.name not in linker.platforms:
        raise EnvironmentProblem(
            f"{linker.name} builds for {', '.join(linker.platforms)} only; for {platform.name}: "
            "pip install 'thrustwasher[build]'"
        )
    target = ["-target", platform.zig] if linker.is_cross else []
    given = sorted(f for f in files if f.endswith((".c", ".o")))
    command = [*linker.command, *target, *COMMON, *flags, "-o", output, *given, *platform.libraries]
    with tempfile.TemporaryDirectory() as folder:
        for file, content in files.items():
            data = content.encode() if isinstance(content, str) else content
            (Path(folder) / file).write_bytes(data)
        code, printed = _run(command, folder, platform, linker, note)
        if code:
            lines = [line for line in printed.splitlines() if "error" in line]
            first = (lines or printed.splitlines() or ["no message"])[0]
            raise EnvironmentProblem(f"{linker.name} cannot build {output}: {first}")
        return (Path(folder) / output).read_bytes()


def _run(
    command: Sequence[str], folder: str, platform: Platform, linker: Linker, note: Note
) -> tuple[int, str]:
    """Return the exit status and what was printed; do not let minutes pass in silence.

    Two first builds with zig at once can wait for each other for ever: they go one by one.
    """
    known = user_cache() / f"{linker.name}-{linker.version}-{platform.name}"
    with ExitStack() as stack:
        if linker.is_cross and not known.exists():
            kept = Path(os.environ.get("ZIG_GLOBAL_CACHE_DIR") or user_cache())
            waiting = f"waiting for another first build with {linker.name}"
            with suppress(OSError):  # where nothing can be written there is nothing to wait for
                kept.mkdir(parents=True, exist_ok=True)
                stack.enter_context(locked(kept / "first-build.lock", lambda: note(waiting)))
        pipes: Any = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        process = stack.enter_context(subprocess.Popen(command, cwd=folder, text=True, **pipes))
        try:
            printed, _ = process.communicate(timeout=LONG if known.exists() else SHORT)
        except subprocess.TimeoutExpired:
            note(
                f"{linker.name} takes long for {platform.name}: the first time on a machine it "
                "compiles its C library, some minutes"
            )
            printed, _ = process.communicate()
        if process.returncode == 0:
            with suppress(OSError):  # only a note for the next time
                known.parent.mkdir(parents=True, exist_ok=True)
                known.touch()
        return process.returncode, printed
