"""A kernel's object files: shipped with the package, kept from an earlier run, or compiled now."""

import importlib.util
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
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ..errors import EnvironmentProblem
from . import emit, files, shipped
from .digest import digest
from .files import Note, to_stderr
from .targets import Level, Platform

Objects = dict[tuple[str, str], bytes]  # (platform, level) -> object file
Wanted = dict[tuple[str, str], tuple[Platform, Level]]
PACKAGE = __name__.rpartition(".")[0]
KEPT_VERSIONS = 5
OFTEN = 5.0  # seconds between lines of progress
_at_once = threading.Semaphore(os.cpu_count() or 1)


def objects(kernel: str, platforms: Iterable[Platform], note: Note = to_stderr) -> Objects:
    """Return (platform, level) -> object file with the entries of a kernel module.

    What several platforms need is made once; ``note`` is called with a line of progress before and
    while something takes long. EnvironmentProblem: the kernel needs what an FMU does not have, or
    numba is not as expected.
    """
    wanted, found = wanted_for(platforms), shipped.objects_of(kernel)
    if wanted.keys() <= found.keys():
        return {which: found[which] for which in wanted}
    return compile_objects(kernel, kept_folder(kernel), wanted, note)


def wanted_for(platforms: Iterable[Platform]) -> Wanted:
    """Return all levels of some platforms."""
    return {(p.name, level.name): (p, level) for p in platforms for level in p.levels}


def prepare(kernels: Iterable[str], platforms: Sequence[Platform], note: Note = to_stderr) -> None:
    """Make the objects of several models side by side, as many at once as there are processors."""
    side_by_side(objects, [(kernel, platforms, note) for kernel in kernels])


def kept_folder(kernel: str) -> Path:
    """Return the folder of this version of a kernel in the user's cache; it need not exist."""
    return files.code_folder() / f"{shipped.short(kernel)}-{digest(kernel)}"


def compile_objects(kernel: str, folder: Path, wanted: Wanted, note: Note = to_stderr) -> Objects:
    """Return the objects in ``folder`` after compiling what is missing; one process does it."""
    name, made = shipped.short(kernel), _kept(folder, wanted)
    try:
        if made.keys() != wanted.keys():
            _compile_missing(kernel, name, folder, wanted, note)
            made = _kept(folder, wanted)
    except OSError as error:
        raise EnvironmentProblem(
            f"compiling {name}: {error.filename or folder}: {error.strerror or error}; free room "
            "there, or let XDG_CACHE_HOME name another folder"
        ) from None
    if made.keys() != wanted.keys():
        raise EnvironmentProblem(f"{folder}: what was compiled is not there any more; start again")
    return made


def _object(folder: Path, which: tuple[str, str]) -> Path:
    return folder / f"{which[0]}-{which[1]}.o"


def _kept(folder: Path, wanted: Wanted) -> Objects:
    """Return those objects that are there."""
    found = {which: files.kept(_object(folder, which)) for which in wanted}
    return {which: data for which, data in found.items() if data is not None}


def _compile_missing(kernel: str, name: str, folder: Path, wanted: Wanted, note: Note) -> None:
    _forget_old(folder, name)
    folder.mkdir(exist_ok=True, mode=0o700)

    def waiting() -> None:
        note(f"{name} is being compiled by another process: waiting for it")

    with files.locked(folder / "lock", waiting):
        missing = wanted.keys() - _kept(folder, wanted).keys()
        if not missing:
            return
        start, bitcode = time.perf_counter(), folder / "module.bc"
        if files.kept(bitcode) is None:
            took = _last_time(folder.parent, name, kernel)
            last = f"; last time {took:.0f} s" if took else ": seconds, the washer about a minute"
            note(f"compiling {name}, whose source is new here{last}")
            _make(bitcode, "emit", kernel, digest(kernel), note=_progress(name, note))
        side_by_side(
            _lower, [(_object(folder, w), bitcode, *wanted[w], name) for w in sorted(missing)]
        )
        took = time.perf_counter() - start
        note(f"compiled {name} in {took:.0f} s")
        with suppress(OSError):
            (folder.parent / f"{name}.seconds").write_text(f"{took:.1f}", "ascii")


def _last_time(home: Path, name: str, kernel: str) -> float:
    """Return how long compiling took the last time here, else where the package was made [s]."""
    with suppress(OSError, ValueError):
        return float((home / f"{name}.seconds").read_text("ascii"))
    about = shipped.index()["kernels"].get(kernel, {})
    return float(about.get("seconds", 0.0))


def _progress(name: str, note: Note) -> Callable[[str], None]:
    """Return what is told each finished entry and says so now and then."""
    start = last = time.perf_counter()

    def told(line: str) -> None:
        nonlocal last
        now = time.perf_counter()
        if line.startswith(emit.DONE) and now - last > OFTEN:
            last = now
            note(f"compiling {name}: {line.strip()}, {now - start:.0f} s")

    return told


def _forget_old(folder: Path, name: str) -> None:
    """Drop the oldest versions of a kernel in the user's cache."""
    with suppress(OSError):
        versions = sorted(folder.parent.glob(f"{name}-*"), key=lambda f: f.stat().st_mtime)
        for old in versions[: -KEPT_VERSIONS + 1]:
            if old != folder:
                shutil.rmtree(old, ignore_errors=True)


def _lower(path: Path, bitcode: Path, platform: Platform, level: Level, name: str) -> None:
    _make(path, "lower", str(bitcode), platform.name, json.dumps(asdict(level)), name)


def _make(
    path: Path, module: str, *arguments: str, note: Callable[[str], None] = lambda line: None
) -> None:
    """Run a module of this package in a process of its own, which writes one file."""
    if not importlib.util.find_spec("numba"):
        raise EnvironmentProblem("compiling kernels takes numba: pip install numba")
    with _at_once, tempfile.TemporaryDirectory() as folder:
        part = Path(folder) / "part"
        surroundings = emit.environment(os.path.join(folder, "numba"))
        surroundings["PYTHONPATH"] = os.pathsep.join(filter(None, sys.path))
        # -P: modules are those of this package, not what lies in the working directory
        command = [sys.executable, "-P", "-m", f"{PACKAGE}.{module}", *arguments, str(part)]
        with tempfile.TemporaryFile("w+", dir=folder) as errors:
            with subprocess.Popen(
                command, stdout=subprocess.PIPE, stderr=errors, text=True, env=surroundings
            ) as process:
                for line in process.stdout or ():
                    note(line)
            if process.returncode:
                errors.seek(0)
                lines = errors.read().strip().splitlines()
                last = lines[-1] if lines else f"it ended with {process.returncode}"
                said = process.returncode == emit.SAID
                raise EnvironmentProblem(last if said else f"compiling {arguments[0]}: {last}")
        files.keep(path, part.read_bytes())


def side_by_side(job: Callable[..., Any], arguments: Sequence[tuple[Any, ...]]) -> None:
    """Do a job with each of the arguments, as many at once as there are processors."""
    with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
        for result in [pool.submit(job, *given) for given in arguments]:
            result.result()
