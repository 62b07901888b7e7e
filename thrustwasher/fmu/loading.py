"""Unpack an FMU once, load its library once, instantiate it with its messages kept."""

import ctypes
import hashlib
import os
import platform
import re
import shutil
import sys
import tempfile
import time
import zipfile
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from ..errors import EnvironmentProblem, ParameterError

KEPT = 20  # unpacked FMUs
IN_USE = 86400.0  # s; a folder used within this time may be open in another process
WARNING = 1  # fmi2Warning; what is above carries the reason of a failure


def unpack(path: str | os.PathLike[str]) -> Path:
    """Unpack an FMU once per content into the user's cache and return the folder."""
    file = Path(path)
    if not file.is_file():
        raise ParameterError(f"FMU = {str(file)!r}, allowed: an existing file; build it first")
    named = str(file.resolve()), file.stat().st_mtime_ns, file.stat().st_size
    folder = _unpacked(*named)
    if not (folder / "modelDescription.xml").is_file():  # somebody emptied the cache
        _unpacked.cache_clear()
        folder = _unpacked(*named)
    with suppress(OSError):
        os.utime(folder)  # the time of the last use
    return folder


@cache
def _unpacked(path: str, _changed: int, _size: int) -> Path:
    digest = hashlib.sha256(Path(path).read_bytes()).hexdigest()[:16]
    cache_home = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    home = Path(cache_home) / "thrustwasher" / "fmus"
    try:
        home.mkdir(parents=True, exist_ok=True)
        part = Path(tempfile.mkdtemp(dir=home))
    except OSError:
        home = Path(tempfile.mkdtemp(prefix="thrustwasher-fmus-"))
        part = Path(tempfile.mkdtemp(dir=home))
    folder = home / f"{Path(path).stem}-{digest}"
    if not (folder / "modelDescription.xml").is_file():
        with zipfile.ZipFile(path) as archive:
            archive.extractall(part)
        try:
            part.rename(folder)  # all or nothing; two processes may do it at once
        except OSError:
            if not (folder / "modelDescription.xml").is_file():
                raise
        prune(home)
    shutil.rmtree(part, ignore_errors=True)
    return folder


def prune(home: Path) -> None:
    """Remove folders that were not used for a day, except the ``KEPT`` used last."""
    used = []
    for folder in home.iterdir():
        with suppress(OSError):  # another process prunes too
            if folder.is_dir():
                used.append((folder.stat().st_mtime, folder))
    for last, folder in sorted(used, reverse=True)[KEPT:]:
        if time.time() - last > IN_USE:
            gone = folder.with_name(f".{folder.name}.{os.getpid()}")
            with suppress(OSError):
                folder.rename(gone)  # nobody finds half a folder
                shutil.rmtree(gone, ignore_errors=True)


@cache
def description(folder: Path) -> Any:
    """Return the parsed model description of an unpacked FMU."""
    from fmpy import read_model_description

    return read_model_description(str(folder), validate=False)


def instantiate(folder: Path, described: Any, name: str, messages: list[tuple[int, str]]) -> Any:
    """Instantiate; what the FMU logs is appended to ``messages`` as (status, text)."""
    from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions
    from fmpy.fmi2 import defaultCallbacks as default
    from fmpy.fmi2 import fmi2CallbackLoggerTYPE as logger_type

    def log(_: Any, _name: bytes, status: int, _category: bytes, message: bytes) -> None:
        if status >= WARNING:
            messages.append((status, message.decode("utf-8", "replace")))

    identifier = described.coSimulation.modelIdentifier
    before = os.getcwd()
    try:
        fmu = FMU2Slave(instanceName=name, guid=described.guid, unzipDirectory=str(folder),
                        modelIdentifier=identifier)  # fmt: skip
    except Exception as problem:  # FMPy has no type of its own for a library that does not load
        raise EnvironmentProblem(
            f"{identifier} cannot be loaded on {platform.system()} {platform.machine()}: {problem}"
        ) from None
    finally:
        os.chdir(before)
    _keep_loaded(fmu.dll)
    callbacks = fmi2CallbackFunctions()
    callbacks.logger = logger_type(log)
    callbacks.allocateMemory, callbacks.freeMemory = default.allocateMemory, default.freeMemory
    try:
        fmu.instantiate(callbacks=callbacks, loggingOn=True)
    except Exception as problem:
        fmu.freeLibrary()
        # pythonfmu writes one line on where it was, then the exception
        last = (text.rpartition("\n")[2] for _, text in messages)
        why = "; ".join(_bare(text) for text in last) or str(problem)
        raise EnvironmentProblem(f"{identifier} cannot be instantiated: {why}") from None
    return fmu


def _bare(text: str) -> str:
    """Return the sentence inside an exception that was written as Name('sentence')."""
    found = re.fullmatch(r"\w+\((['\"])(.*)\1,?\)", text.strip())
    return found[2] if found else text


def _keep_loaded(dll: Any) -> None:
    """Pin the library: unloading it and loading it again costs time and upsets its destructors."""
    if sys.platform == "linux":
        ctypes.CDLL(dll._name, mode=os.RTLD_NOLOAD | os.RTLD_NODELETE | os.RTLD_NOW)
