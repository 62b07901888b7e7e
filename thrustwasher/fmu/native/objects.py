"""A model's object files for each platform, made when first wanted and kept in the user's cache."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ...errors import EnvironmentProblem
from ...kernels._jit import KEPT_VERSIONS, cache_folder
from .. import archive
from . import emit
from .key import key
from .targets import Level, Platform

Note = Callable[[str], None]
Objects = dict[tuple[str, str], bytes]  # (platform, level) -> object file
PACKAGE = __name__.rpartition(".")[0]
_at_once = threading.Semaphore(os.cpu_count() or 1)


def to_stderr(message: str) -> None:
    """Say a line of progress where it does not mix with results."""
    print(message, file=sys.stderr, flush=True)


def objects(kernel: str, platforms: Iterable[Platform], note: Note = to_stderr) -> Objects:
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
    folder, name = _folder(kernel), kernel.rpartition(".")[2]
    wanted = {(p.name, level.name): (p, level) for p in platforms for level in p.levels}
    paths = {which: folder / _file(*pair) for which, pair in wanted.items()}
    missing = [which for which, path in paths.items() if not path.is_file()]
    if missing:
        bitcode, start = folder / "module.bc", time.perf_counter()
        if not bitcode.is_file():
            note(f"compiling {name} ahead of time: seconds, the washer a minute or two")
            bitcode.parent.mkdir(parents=True, exist_ok=True)
            _make(bitcode, "emit", kernel)
        _side_by_side(_lower, [(paths[w], bitcode, *wanted[w], name) for w in missing])
        note(f"compiled {name} in {time.perf_counter() - start:.0f} s")
    return {which: path.read_bytes() for which, path in paths.items()}


def prepare(kernels: Iterable[str], platforms: Sequence[Platform], note: Note = to_stderr) -> None:
    """Make the objects of several models side by side, as many at once as there are processors."""
    _side_by_side(objects, [(kernel, platforms, note) for kernel in kernels])


def _folder(kernel: str) -> Path:
    """Return the folder of this version of a kernel; drop those of its oldest versions."""
    base, name = Path(cache_folder()).parent, kernel.rpartition(".")[2]
    folder = base / f"native-{name}-{key(kernel)}"
    if not folder.is_dir():
        versions = sorted(base.glob(f"native-{name}-*"), key=lambda f: f.stat().st_mtime)
        for old in versions[:-KEPT_VERSIONS]:
            shutil.rmtree(old, ignore_errors=True)
    return folder


def _file(platform: Platform, level: Level) -> str:
    return f"{platform.name}-{key('', platform.triple, level)}-{level.name}.o"


def _lower(path: Path, bitcode: Path, platform: Platform, level: Level, name: str) -> None:
    _make(path, "lower", str(bitcode), platform.name, json.dumps(asdict(level)), name)


def _make(path: Path, module: str, *arguments: str) -> None:
    """Run a module of this package in a process of its own, which writes one file."""
    with _at_once, tempfile.TemporaryDirectory() as folder:
        part = Path(folder) / "part"
        surroundings = emit.environment(os.path.join(folder, "numba"))
        surroundings["PYTHONPATH"] = os.pathsep.join(filter(None, sys.path))
        command = [sys.executable, "-m", f"{PACKAGE}.{module}", *arguments, str(part)]
        done = subprocess.run(command, capture_output=True, text=True, env=surroundings)
        if done.returncode:
            lines = done.stderr.strip().splitlines() or [f"it ended with {done.returncode}"]
            said = done.returncode == emit.SAID
            raise EnvironmentProblem(
                lines[-1] if said else f"compiling {arguments[0]}: {lines[-1]}"
            )
        archive.write(path, part.read_bytes())


def _side_by_side(job: Callable[..., Any], arguments: Sequence[tuple[Any, ...]]) -> None:
    with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
        for result in [pool.submit(job, *given) for given in arguments]:
            result.result()
