"""Files written at once, and folders from which code may be loaded: the user's alone.

Compiled code that lies where others can write is code that others can change. It is kept in a
folder that belongs to the user and has mode 0700; where no such folder can be had, in a temporary
one of this process, and that is said.
"""

import atexit
import hashlib
import io
import os
import shutil
import stat
import struct
import sys
import tempfile
import time
import zipfile
import zlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

from ..errors import naming

Note = Callable[[str], None]
READABLE = "can be read by others"
EPOCH = (1980, 1, 1, 0, 0, 0)
UNIX, FILE_MODE = 3, 0o100644
# What reading an archive raises, beside OSError, if it is damaged or none.
_BUILT_IN = (EOFError, KeyError, ValueError, OverflowError, RuntimeError)
DAMAGED = (zipfile.BadZipFile, zlib.error, struct.error, *_BUILT_IN)
SUM = ".sha256"  # ends the name of the file that holds another one's checksum


def to_stderr(message: str) -> None:
    """Say a line of progress where it does not mix with results."""
    print(message, file=sys.stderr, flush=True)


def write(path: Path, data: bytes, mode: int = 0o644) -> None:
    """Put a file in place at once: a reader sees the old one or the new one, never a half."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, part = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with naming(path), os.fdopen(handle, "wb") as file:
            file.write(data)
        os.chmod(part, mode)
        os.replace(part, path)
    except BaseException:
        with suppress(OSError):
            os.unlink(part)
        raise


def zipped(files: Mapping[str, bytes], first: str = "") -> bytes:
    """Return a zip, path -> content, the same bytes for the same content; ``first`` is in front."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name in sorted(files, key=lambda n: (n != first, n)):
            name.encode("ascii")  # FMI 2 says nothing about other characters
            info = zipfile.ZipInfo(name, EPOCH)
            info.create_system, info.external_attr = UNIX, FILE_MODE << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, files[name], compresslevel=9)
    return buffer.getvalue()


def checksum(data: bytes) -> str:
    """Return the SHA-256 of bytes as hex digits."""
    return hashlib.sha256(data).hexdigest()


def user_cache() -> Path:
    """Return where this user's compiled code lies; it need not exist."""
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    if not os.path.isabs(home):  # without a home, "~" is a folder like any other
        home = str(private_folder())
    return Path(home) / "thrustwasher"


def code_folder(name: str = "native") -> Path:
    """Return a folder for compiled code that nobody else can write to.

    It is ``name`` in the user's cache if that can be made so, else a temporary folder that goes
    with this process; then a line on standard error says why, once.
    """
    return _code_folder(user_cache(), name)


@cache
def _code_folder(home: Path, name: str) -> Path:
    folder = home / name
    why = _made_private(folder)
    if not why:
        return folder
    if not _said:  # other kinds of code find the same
        _said.append(why)
        meanwhile = f"it lies in {private_folder()} meanwhile"
        to_stderr(f"compiled code is not kept: {folder} {why}; {meanwhile}")
    (private_folder() / name).mkdir(exist_ok=True, mode=0o700)
    return private_folder() / name


_said: list[str] = []  # why code is not kept


def _made_private(folder: Path) -> str:
    """Make a folder that is the user's alone; return why it is not, or nothing."""
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        why = not_private(folder)
        if why == READABLE:  # what lies there is the user's own
            folder.chmod(0o700)
            why = not_private(folder)
        with tempfile.TemporaryFile(dir=folder):
            return why
    except OSError as error:
        return f"cannot be written ({error.strerror or error})"


def not_private(folder: Path) -> str:
    """Return why code in a folder is not trusted: "" if the folder is the user's alone.

    On Windows the folders of a user's profile are closed to others by the system.
    """
    if sys.platform == "win32":
        return ""
    about = folder.lstat()
    if not stat.S_ISDIR(about.st_mode):
        return "is no folder"
    if about.st_uid != os.getuid():
        return "belongs to another user"
    if about.st_mode & 0o022:
        return "could be written by others"
    return READABLE if about.st_mode & 0o055 else ""


@cache
def private_folder() -> Path:
    """Return a folder of mode 0700 that is removed when this process ends, not one it forks."""
    folder, process = tempfile.mkdtemp(prefix="thrustwasher-"), os.getpid()

    def remove() -> None:
        if os.getpid() == process:
            shutil.rmtree(folder, ignore_errors=True)

    atexit.register(remove)
    return Path(folder)


def forget_old(folder: Path, pattern: str, kept: int, unused: float = 0.0) -> None:
    """Remove all folders of a name but those changed last, or within ``unused`` seconds."""
    used = []
    for found in folder.glob(pattern):
        with suppress(OSError):  # another process removes them too
            if found.is_dir():
                used.append((found.stat().st_mtime, found))
    for last, old in sorted(used, reverse=True)[kept:]:
        if time.time() - last >= unused:
            gone = old.with_name(f".{old.name}.{os.getpid()}")
            with suppress(OSError):
                old.rename(gone)  # nobody finds half a folder
                shutil.rmtree(gone, ignore_errors=True)


def keep(path: Path, data: bytes) -> None:
    """Write a file of compiled code and beside it its checksum."""
    write(path, data, 0o600)
    write(path.with_name(path.name + SUM), checksum(data).encode(), 0o600)


def kept(path: Path) -> bytes | None:
    """Return a file of compiled code, None if it is not there or not as it was written.

    Nor is it taken where somebody else may have written it.
    """
    try:
        with path.open("rb") as file:
            about = os.fstat(file.fileno())
            data = file.read()
        if sys.platform != "win32" and (about.st_uid != os.getuid() or about.st_mode & 0o022):
            return None
        known = path.with_name(path.name + SUM).read_text("ascii")
    except (OSError, UnicodeDecodeError):
        return None
    return data if checksum(data) == known.strip() else None


@contextmanager
def locked(path: Path, waiting: Callable[[], None]) -> Iterator[None]:
    """Hold a lock that other processes see; ``waiting`` is called if another one holds it.

    The system lets go of it when a process ends, however it ends.
    """
    try:
        handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
    except OSError:  # no lock to be had: the work may be done twice, its files appear at once
        yield
        return
    try:
        if not _try_lock(handle):
            waiting()
            while not _try_lock(handle):
                time.sleep(0.2)
        yield
    finally:
        os.close(handle)


def _try_lock(handle: int) -> bool:
    """Take a lock if no other process holds it; a file system without locks lets all have it."""
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return sys.platform != "win32" and not isinstance(error, BlockingIOError)
    return True
