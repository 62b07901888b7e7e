"""A kernel's object files: shipped with the package, kept from an earlier run, or compiled now."""

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

from ...errors import EnvironmentProblem
from .. import files, shipped
from ..digest import digest
from ..files import Note, to_stderr
from ..kept import forget_old, kept_folder
from ..targets import Level, Platform
from . import emit

Objects = dict[tuple[str, str], bytes]  # (platform, level) -> object file
Required = dict[tuple[str, str], tuple[Platform, Level]]
PACKAGE = __name__.rpartition(".")[0]


def objects(kernel: str, platforms: Iterable[Platform], note: Note = to_stderr) -> Objects:
    """Return (platform, level) -> object file with the entries of a kernel module.

    ``note`` is called before something takes long. EnvironmentProblem: the kernel needs what an FMU
    does not have, or numba is not as expected.
    """
    required, found = required_for(platforms), shipped.objects_of(kernel)
    if required.keys() <= found.keys():
        return {which: found[which] for which in required}
    return compile_objects(kernel, kept_folder(kernel), required, note)


def required_for(platforms: Iterable[Platform]) -> Required:
    """Return all levels of some platforms."""
    return {(p.name, level.name): (p, level) for p in platforms for level in p.levels}


def compile_objects(
    kernel: str, folder: Path, required: Required, note: Note = to_stderr
) -> Objects:
    """Return the objects in ``folder`` after compiling what is missing; one process does it."""
    name, made = shipped.short(kernel), _kept(folder, required)
    try:
        if made.keys() != required.keys():
            _compile_missing(kernel, name, folder, required, note)
            made = _kept(folder, required)
    except OSError as error:
        raise EnvironmentProblem(
            f"compiling {name}: {error.filename or folder}: {error.strerror or error}; free room "
            "there, or let XDG_CACHE_HOME name another folder"
        ) from None
    if made.keys() != required.keys():
        raise EnvironmentProblem(f"{folder}: what was compiled is not there any more; start again")
    return made


def _object(folder: Path, which: tuple[str, str]) -> Path:
    return folder / f"{which[0]}-{which[1]}.o"


def _kept(folder: Path, required: Required) -> Objects:
    """Return those objects that are there."""
    found = {which: files.kept(_object(folder, which)) for which in required}
    return {which: data for which, data in found.items() if data is not None}


def _compile_missing(kernel: str, name: str, folder: Path, required: Required, note: Note) -> None:
    folder.mkdir(exist_ok=True, mode=0o700)
    os.utime(folder)  # the one used last
    forget_old(kernel, folder.parent)

    def waiting() -> None:
        note(f"{name} is being compiled by another process: waiting for it")

    def lower(which: tuple[str, str]) -> None:
        platform, level = required[which]
        settings = platform.name, json.dumps(asdict(level)), name
        _make(_object(folder, which), "lower", str(bitcode), *settings)

    bitcode = folder / "module.bc"
    with files.locked(folder / "lock", waiting):
        missing = required.keys() - _kept(folder, required).keys()
        if not missing:
            return
        start = time.perf_counter()
        if files.kept(bitcode) is None:
            about = shipped.index()["kernels"].get(kernel, {}).get("seconds", 30.0)
            note(f"compiling {name}, whose source is new here: about {about:.0f} s")
            _make(bitcode, "emit", kernel, digest(kernel))
        with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
            list(pool.map(lower, sorted(missing)))
        note(f"compiled {name} in {time.perf_counter() - start:.0f} s")


def _make(path: Path, module: str, *arguments: str) -> None:
    """Run a module of this package in a process of its own, which writes one file."""
    if not importlib.util.find_spec("numba"):
        raise EnvironmentProblem("compiling kernels takes numba: pip install numba")
    with tempfile.TemporaryDirectory() as folder:
        part = Path(folder) / "part"
        surroundings = emit.environment(os.path.join(folder, "numba"))
        surroundings["PYTHONPATH"] = os.pathsep.join(filter(None, sys.path))
        # -P: modules are those of this package, not what lies in the working directory
        command = [sys.executable, "-P", "-m", f"{PACKAGE}.{module}", *arguments, str(part)]
        done = subprocess.run(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=surroundings
        )
        if done.returncode:
            lines = done.stderr.strip().splitlines()
            last = lines[-1] if lines else f"it ended with {done.returncode}"
            reported = done.returncode == emit.REPORTED
            raise EnvironmentProblem(last if reported else f"compiling {arguments[0]}: {last}")
        files.keep(path, part.read_bytes())
