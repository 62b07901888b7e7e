"""Files written at once, and folders from which code may be loaded: the user's alone.

Compiled code that lies where others can write is code that others can change. It is kept in a
folder that belongs to the user and has mode 0700; where no such folder can be had, in a temporary
one of this process, and that is said.
"""

import atexit
import hashlib
import io
import logging
import mmap
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

from ..errors import EnvironmentProblem, naming
from ..logs import is_heard
from .drafts import draft_in, flush
from .ownership import doubt_of

Note = Callable[[str], None]
VARIABLE = "XDG_CACHE_HOME"
READABLE = "can be read by others"
EPOCH = (1980, 1, 1, 0, 0, 0)
UNIX, FILE_MODE = 3, 0o100644
# What reading an archive raises, beside OSError, if it is damaged or none.
_BUILT_IN = (EOFError, KeyError, ValueError, OverflowError, RuntimeError)
DAMAGED = (zipfile.BadZipFile, zlib.error, struct.error, *_BUILT_IN)
SUM = ".sha256"  # ends the name of the file that holds another one's checksum


def to_stderr(message: str) -> None:
    """Say a line of progress where it does not mix with results.

    Where somebody listens to INFO of the caller's logger it goes there instead.
    """
    log = logging.getLogger(sys._getframe(1).f_globals["__name__"])
    if is_heard(log, logging.INFO):
        log.info("%s", message, stacklevel=2)
    else:
        print(message, file=sys.stderr, flush=True)


def write(path: Path, data: bytes, mode: int = 0o644) -> None:
    """Put a file in place at once: a reader sees the old one or the new one, never a half."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with naming(path), draft_in(path.parent, is_folder=False) as draft:
        draft.write_bytes(data)
        draft.chmod(mode)
        flush(draft)
        os.replace(draft, path)


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
    """Return where this user's compiled code and maps lie; it need not exist."""
    home = os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache")
    if not os.path.isabs(home):  # without a home, "~" is a folder like any other
        home = str(private_folder())
    return _trusted_cache(home)


@cache
def _trusted_cache(home: str) -> Path:
    """Return our folder in one for caches, or in a private one where others could change it."""
    return (Path(home) if is_trusted(Path(home)) else private_folder()) / "thrustwasher"


def code_folder(name: str = "native", *, runs: bool = False) -> Path:
    """Return a folder for compiled code that nobody else can write to.

    It is ``name`` in the user's cache if that can be made so, else a temporary folder that goes
    with this process; then a line on standard error says why, once. Whose it is and what leads to
    it are looked at anew each time. ``runs``: libraries are loaded from there. EnvironmentProblem:
    no folder lets them.
    """
    folder = user_cache() / name
    why = _unfit(folder, runs)
    if not why:
        return folder
    folder = private_folder() / name
    folder.mkdir(exist_ok=True, mode=0o700)
    if runs and not lets_run(folder):
        raise EnvironmentProblem(
            f"{why}, and {folder.parent.parent} lets no code run either (noexec); let {VARIABLE} "
            "name a folder that does"
        )
    _say_once(why)  # other kinds of code find the same
    return folder


def is_trusted(folder: Path, variable: str = VARIABLE) -> bool:
    """Tell if nobody else could change what lies in a folder; if not, say once why.

    ``variable``: of the environment, which names another one. The folder need not exist yet.
    """
    with suppress(FileNotFoundError):
        if why := doubt_of(folder):
            _say_once(why, variable)
            return False
    return True


_fit: dict[tuple[Path, bool], bool] = {}  # folders that were made and tried
_said: list[str] = []  # why code is not kept


def _say_once(why: str, variable: str = VARIABLE) -> None:
    if not _said:
        _said.append(why)
        to_stderr(
            f"compiled code is not kept: {why}; it lies in {private_folder()} meanwhile; let "
            f"{variable} name another folder"
        )


def why_not_kept() -> str:
    """Return why compiled code lies in a temporary folder, "" if it does not."""
    return _said[0] if _said else ""


def _unfit(folder: Path, runs: bool) -> str:
    """Make a folder that is the user's alone; return why it is not, or nothing."""
    try:
        if (folder, runs) not in _fit or not folder.is_dir():
            _make_private(folder)
            with tempfile.TemporaryFile(dir=folder):
                pass
            if runs and not lets_run(folder):
                return f"{folder} lies where no code may run (noexec)"
            _fit[folder, runs] = True
        return not_private(folder)
    except OSError as error:
        return f"{folder} cannot be written ({error.strerror or error})"


def _make_private(folder: Path) -> None:
    """Make a folder and its parents for the user alone; what lies there already is his own."""
    for made in reversed([p for p in (folder, *folder.parents) if not p.exists()]):
        made.mkdir(exist_ok=True, mode=0o700)
    if not_private(folder).endswith(READABLE):
        folder.chmod(0o700)


def lets_run(folder: Path) -> bool:
    """Tell if the system runs code of a folder: one mounted noexec is for data alone."""
    if not sys.platform.startswith("linux"):
        return True
    try:
        with tempfile.TemporaryFile(dir=folder) as file:
            file.truncate(mmap.PAGESIZE)
            mmap.mmap(file.fileno(), mmap.PAGESIZE, prot=mmap.PROT_READ | mmap.PROT_EXEC).close()
    except PermissionError:
        return False
    return True


def not_private(folder: Path) -> str:
    """Return why code in a folder is not trusted: "" if it is the user's alone, with its parents.

    On Windows the folders of a user's profile are closed to others by the system.
    """
    if sys.platform == "win32":
        return ""
    about = folder.lstat()
    if not stat.S_ISDIR(about.st_mode):
        return f"{folder} is no folder"
    if about.st_uid != os.getuid():
        return f"{folder} belongs to another user"
    if why := doubt_of(folder):
        return why
    return f"{folder} {READABLE}" if about.st_mode & 0o055 else ""


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
            remove_folder(old)


def remove_folder(folder: Path) -> None:
    """Remove a folder at once, so that nobody finds half of it."""
    gone = folder.with_name(f".{folder.name}.{os.getpid()}")
    with suppress(OSError):
        folder.rename(gone)
        shutil.rmtree(gone, ignore_errors=True)


def keep(path: Path, data: bytes) -> None:
    """Write a file of compiled code and beside it its checksum."""
    write(path, data, 0o600)
    keep_sum(path, data)


def keep_sum(path: Path, data: bytes) -> None:
    """Write the checksum of a file's content beside it."""
    write(path.with_name(path.name + SUM), checksum(data).encode(), 0o600)


def stamp(path: Path) -> tuple[int, ...]:
    """Return what changes when a file is written to or replaced; empty if it is not there."""
    try:
        about = path.stat()
    except OSError:
        return ()
    return about.st_ino, about.st_size, about.st_mtime_ns, about.st_ctime_ns


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
        if doubt_of(path.parent):  # looked at anew before each load
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
