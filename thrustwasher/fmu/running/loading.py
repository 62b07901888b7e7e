"""Unpack an FMU once, load its library once, instantiate it with its messages kept."""

import ctypes
import errno
import hashlib
import io
import os
import platform
import re
import sys
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from ...errors import EnvironmentProblem, ParameterError, naming
from ...native.drafts import draft_in, flush
from ...native.files import (
    DAMAGED,
    code_folder,
    forget_old,
    locked,
    remove_folder,
    stamp,
    to_stderr,
)

KEPT = 20  # unpacked FMUs
IN_USE = 86400.0  # s; a folder used within this time may be open in another process
# The disk's or the user's trouble; other errors come of a damaged archive.
DISK = {
    getattr(errno, name, None)
    for name in "ENOSPC EDQUOT EFBIG EIO EROFS EACCES EPERM EMFILE ENFILE".split()
}
WARNING = 1  # of both FMI versions; what is above carries the reason of a failure
# Arguments behind "..." lie where named ones would: everywhere but on Apple's ARM.
VARIADIC_AS_USUAL = (sys.platform, platform.machine()) != ("darwin", "arm64")


class Message(NamedTuple):
    """What an FMU said."""

    status: int
    category: str
    text: str


class Messages(list[Message]):
    """What an FMU said and nobody has looked at yet; ``logged`` is 1 once there was something."""

    def __init__(self) -> None:
        super().__init__()
        self.logged = ctypes.c_int64(0)


def unpack(path: str | os.PathLike[str]) -> Path:
    """Unpack an FMU once per content into the user's cache and return the folder.

    What lies there is compared with the FMU once in a process, and again when a file was touched;
    if a byte is missing or another one, it is unpacked again and that is said. ParameterError: the
    FMU is none. EnvironmentProblem: no folder to be had lets libraries run.
    """
    file = Path(path)
    if not file.is_file():
        raise ParameterError(f"FMU = {str(file)!r}, allowed: an existing file; build it first")
    home = code_folder("fmus", runs=True)  # whose it is: looked at anew before each load
    about = file.stat()
    named = home, str(file.resolve()), about.st_mtime_ns, about.st_size
    known = _unpacked.get(named)
    if known is None or known != _Unpacked.at(known.folder, known.stamps):
        known = _unpacked[named] = _whole(home, file)
    with suppress(OSError):
        os.utime(known.folder)  # the time of the last use
    return known.folder


class _Unpacked(NamedTuple):
    """A folder that was compared with its FMU: by file, what changes when somebody writes to it."""

    folder: Path
    stamps: dict[str, tuple[int, ...]]

    @classmethod
    def at(cls, folder: Path, names: Iterable[str]) -> "_Unpacked":
        return cls(folder, {name: stamp(folder / name) for name in names})


_unpacked: dict[tuple[Path, str, int, int], _Unpacked] = {}


def _whole(home: Path, file: Path) -> _Unpacked:
    """Return the unpacked FMU after comparing it; one process at a time unpacks."""
    data = file.read_bytes()
    contents = _contents(file, data)
    folder = home / f"{file.stem}-{hashlib.sha256(data).hexdigest()[:16]}"
    with locked(home.with_name("fmus.lock"), lambda: None):
        if folder.is_dir() and (wrong := _difference(contents, folder)):
            to_stderr(f"{folder}: {wrong} is not as it was unpacked; it is unpacked again")
            remove_folder(folder)
        if not folder.is_dir():
            with draft_in(home) as draft, naming(folder):
                _write(file, contents, draft)
                flush(draft)
                draft.rename(folder)  # all or nothing
            prune(home)
        return _Unpacked.at(folder, contents)


def _contents(file: Path, data: bytes) -> dict[str, bytes]:
    """Return the files of an archive by path, or refuse one that is not whole by its name."""
    contents = {}
    with _refused_if_broken(file), zipfile.ZipFile(io.BytesIO(data)) as archive:
        archive.getinfo("modelDescription.xml")
        for info in archive.infolist():
            parts = [part for part in info.filename.split("/") if part not in ("", ".", "..")]
            if parts and not info.is_dir():
                contents["/".join(parts)] = archive.read(info)
    return contents


def _write(file: Path, contents: Mapping[str, bytes], folder: Path) -> None:
    with _refused_if_broken(file):  # a name may be that of a file and of a folder
        for name, data in contents.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)


@contextmanager
def _refused_if_broken(file: Path) -> Iterator[None]:
    try:
        yield
    except (OSError, *DAMAGED) as problem:
        if isinstance(problem, OSError) and problem.errno in DISK:
            raise
        raise ParameterError(
            f"FMU = {str(file)!r}: is no whole FMU ({problem}); remove it and build it again"
        ) from None


def _difference(contents: Mapping[str, bytes], folder: Path) -> str:
    """Return the first file of an FMU that lies otherwise in a folder, "" if there is none."""
    for name, data in contents.items():
        try:
            if (folder / name).read_bytes() != data:
                return name
        except OSError:
            return name
    return ""


def prune(home: Path, kept: int = KEPT) -> None:
    """Remove folders that were not used for a day, except the ``kept`` used last."""
    forget_old(home, "*", kept, IN_USE)


@cache
def description(folder: Path) -> Any:
    """Return the parsed model description of an unpacked FMU."""
    from fmpy import read_model_description

    return read_model_description(str(folder), validate=False)


@cache
def capabilities(folder: Path) -> tuple[bool, bool]:
    """Tell if an unpacked FMU saves its state and gives directional derivatives.

    Read here: the two FMI versions spell these flags differently, and FMPy reads one spelling.
    """
    from xml.etree import ElementTree

    root = ElementTree.parse(folder / "modelDescription.xml").getroot()
    found = root.find("CoSimulation")
    flags = {} if found is None else {name.lower(): value for name, value in found.attrib.items()}
    slope = "providesdirectionalderivative"
    states, slopes = flags.get("cangetandsetfmustate"), flags.get(f"{slope}s") or flags.get(slope)
    return states in ("true", "1"), slopes in ("true", "1")


def instantiate(folder: Path, described: Any, name: str, messages: Messages) -> Any:
    """Load and instantiate; what the FMU logs is appended to ``messages``."""
    third = described.fmiVersion.startswith("3")
    from fmpy.fmi2 import FMU2Slave
    from fmpy.fmi3 import FMU3Slave

    identifier = described.coSimulation.modelIdentifier
    before = os.getcwd()
    try:
        fmu = (FMU3Slave if third else FMU2Slave)(
            instanceName=name,
            guid=described.guid,
            unzipDirectory=str(folder),
            modelIdentifier=identifier,
        )
    except Exception as problem:  # FMPy has no type of its own for a library that does not load
        raise EnvironmentProblem(
            f"{identifier} cannot be loaded on {platform.system()} {platform.machine()}: {problem}"
        ) from None
    finally:
        os.chdir(before)
    # pinned: unloading it and loading it again costs time and upsets its destructors
    if sys.platform == "linux":
        ctypes.CDLL(fmu.dll._name, mode=os.RTLD_NOLOAD | os.RTLD_NODELETE | os.RTLD_NOW)
    try:
        if third:  # its logger gets a plain text
            fmu.instantiate(loggingOn=True, logMessage=lambda _, *rest: _keep(messages, *rest))
        else:
            _begin2(fmu, messages)
    except Exception as problem:
        fmu.freeLibrary()
        # pythonfmu writes one line on where it was, then the exception as Name('sentence')
        last = (m.text.rpartition("\n")[2].strip() for m in messages if m.status >= WARNING)
        bare = (re.sub(r"^\w+\((['\"])(.*)\1,?\)$", r"\2", text) for text in last)
        why = "; ".join(bare) or str(problem)
        raise EnvironmentProblem(f"{identifier} cannot be instantiated: {why}") from None
    return fmu


def _begin2(fmu: Any, messages: Messages) -> None:
    """Instantiate after FMI 2; the logger's text is a format, for us with at most one string."""
    from fmpy.fmi2 import defaultCallbacks as default
    from fmpy.fmi2 import fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

    callbacks = fmi2CallbackFunctions()
    callbacks.allocateMemory, callbacks.freeMemory = default.allocateMemory, default.freeMemory
    if VARIADIC_AS_USUAL:

        def log(
            _: object, _name: bytes, status: int, category: bytes, text: bytes, more: int
        ) -> None:
            ctypes.pythonapi.PyErr_Clear()  # a Python FMU's: from 3.13 on nothing works with it
            sent = ctypes.string_at(more) if text == b"%s" and more else text
            _keep(messages, status, category, sent)

        pointers = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p
        logger = ctypes.CFUNCTYPE(None, *pointers, ctypes.c_void_p)(log)
        callbacks.logger = ctypes.cast(logger, fmi2CallbackLoggerTYPE)
    else:
        from fmpy.logging import addLoggerProxy

        logger = fmi2CallbackLoggerTYPE(lambda _e, _n, *rest: _keep(messages, *rest))
        callbacks.logger = logger
        addLoggerProxy(ctypes.byref(callbacks))  # it knows one logger per process: the last
    fmu.kept_logger = logger  # alive as long as the FMU
    fmu.instantiate(callbacks=callbacks, loggingOn=True)


def _keep(messages: Messages, status: int, category: bytes | None, text: bytes | None) -> None:
    texts = [(x or b"").decode("utf-8", "replace") for x in (category, text)]
    messages.append(Message(status, *texts))
    messages.logged.value = 1
