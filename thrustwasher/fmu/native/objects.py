"""A model's object files for one platform, made when first wanted and kept in the user's cache."""

import hashlib
import importlib
import importlib.util
import os
import platform as this
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

from ...errors import EnvironmentProblem
from ...kernels._jit import KEPT_VERSIONS, cache_folder, kernel_digest
from .. import archive
from . import emit
from .targets import Level, Platform

Note = Callable[[str], None]
PACKAGE = __name__.rpartition(".")[0]
MAKERS = ("emit.py", "lower.py", "gate.py")  # an edit of these may change what comes out


def to_stderr(message: str) -> None:
    """Say a line of progress where it does not mix with results."""
    print(message, file=sys.stderr, flush=True)


def objects(
    kernel: str, platforms: Sequence[Platform], note: Note = to_stderr
) -> dict[tuple[str, str], bytes]:
    """Return (platform, level) -> object file with the entries of a kernel module.

    Parameters
    ----------
    kernel
        Dotted name of a module with the step ABI.
    platforms
        For which; what several of them need is made once.
    note
        Called with a line of progress before anything that takes long.

    Raises
    ------
    EnvironmentProblem : the kernel needs what an FMU does not have, or numba is not as expected
    """
    wanted = [(p, level) for p in platforms for level in p.levels]
    missing = [pair for pair in wanted if not object_file(kernel, *pair).is_file()]
    dialects = sorted({level.dialect for _, level in missing})
    absent = [d for d in dialects if not bitcode_file(kernel, d).is_file()]
    name = kernel.rpartition(".")[2]
    if absent:
        note(f"compiling {name} for {' and '.join(absent)}: seconds, the washer minutes")
    start = time.perf_counter()
    _side_by_side(_emit, [(kernel, dialect) for dialect in absent])
    if missing:
        _side_by_side(_lower, [(kernel, *pair) for pair in missing])
        note(f"compiled {name} in {time.perf_counter() - start:.0f} s")
    return {(p.name, level.name): object_file(kernel, p, level).read_bytes() for p, level in wanted}


def bitcode_file(kernel: str, dialect: str) -> Path:
    """Return where the module for one CPU lies that the objects are made from."""
    return _folder() / f"{_stem(kernel)}-{dialect}.bc"


def object_file(kernel: str, platform: Platform, level: Level) -> Path:
    """Return where an object lies; its name ends with a digest of all compiler settings."""
    settings = hashlib.sha256(f"{platform.triple} {level}".encode()).hexdigest()[:8]
    return _folder() / f"{_stem(kernel)}-{platform.name}-{level.name}-{settings}.o"


def _stem(kernel: str) -> str:
    """Return the module's name and a digest of its file, which may lie outside the package."""
    found = importlib.util.find_spec(kernel)
    source = Path(found.origin).read_bytes() if found and found.origin else b""
    return f"{kernel.rpartition('.')[2]}-{hashlib.sha256(source).hexdigest()[:8]}"


@cache
def _folder() -> Path:
    """Return the folder of this version of kernels, compilers and makers; drop the oldest."""
    made_by = [f"{name} {metadata.version(name)}" for name in ("numba", "llvmlite")]
    text = f"{kernel_digest()} {made_by} {this.python_version_tuple()[:2]}"
    hashed = hashlib.sha256(text.encode())
    for name in MAKERS:
        hashed.update((Path(__file__).parent / name).read_bytes())
    base = Path(cache_folder()).parent
    folder = base / f"objects-{hashed.hexdigest()[:16]}"
    if not folder.is_dir():
        for old in sorted(base.glob("objects-*"), key=lambda f: f.stat().st_mtime)[:-KEPT_VERSIONS]:
            shutil.rmtree(old, ignore_errors=True)
        folder.mkdir(parents=True, exist_ok=True)
    return folder


def _emit(kernel: str, dialect: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        part = Path(folder) / "module.bc"
        surroundings = emit.environment(dialect, os.path.join(folder, "numba"))
        _run("emit", [kernel, str(part)], surroundings)
        archive.write(bitcode_file(kernel, dialect), part.read_bytes())


def _lower(kernel: str, platform: Platform, level: Level) -> None:
    with tempfile.TemporaryDirectory() as folder:
        part = Path(folder) / "object.o"
        source, name = bitcode_file(kernel, level.dialect), kernel.rpartition(".")[2]
        _run("lower", [str(source), platform.name, level.name, name, str(part)], dict(os.environ))
        archive.write(object_file(kernel, platform, level), part.read_bytes())


def _run(module: str, arguments: list[str], surroundings: dict[str, str]) -> None:
    """Run a module of this package in a process of its own, which finds what this one finds."""
    command = [sys.executable, "-m", f"{PACKAGE}.{module}", *arguments]
    surroundings["PYTHONPATH"] = os.pathsep.join(filter(None, sys.path))
    done = subprocess.run(command, capture_output=True, text=True, env=surroundings)
    if done.returncode:
        lines = done.stderr.strip().splitlines() or [f"it ended with {done.returncode}"]
        text = lines[-1] if done.returncode == 2 else f"compiling {arguments[0]}: {lines[-1]}"
        raise EnvironmentProblem(text)


def _side_by_side(job: Callable[..., None], arguments: Sequence[tuple[Any, ...]]) -> None:
    with ThreadPoolExecutor(max_workers=min(4, os.cpu_count() or 1)) as pool:
        for result in [pool.submit(job, *given) for given in arguments]:
            result.result()
