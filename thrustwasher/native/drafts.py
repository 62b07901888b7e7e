"""Drafts: files and folders on their way, hidden beside their place, on disk before they take it.

Who writes a draft holds a lock on it. The system lets go of the lock when a process ends, however
it ends: a draft that can be locked is a dead one's, and goes when the next one is made beside it.
"""

import errno
import os
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

PREFIX = ".draft-"
UNABLE = (errno.EINVAL, errno.ENOTSUP, errno.EROFS, errno.EBADF)  # no disk behind it


@contextmanager
def draft_in(folder: Path, suffix: str = "", *, is_folder: bool = True) -> Iterator[Path]:
    """Give a new hidden folder or file in ``folder``; what is not moved from there is removed.

    Drafts that dead processes left in ``folder`` are removed first.
    """
    remove_drafts(folder)
    handle: int | None = None
    while handle is None:
        draft = folder / f"{PREFIX}{os.urandom(8).hex()}{suffix}"
        try:  # a signal may stop it at any line: the name is known before the draft is there
            draft.mkdir(0o700) if is_folder else draft.touch(0o600, exist_ok=False)
            handle = _held(draft)
            if handle is None:  # taken for a dead one's, by another process at this very moment
                continue
            yield draft
        finally:
            remove(draft)
            if handle is not None and handle >= 0:
                os.close(handle)


def remove_drafts(folder: Path) -> None:
    """Remove the drafts of dead processes; where nothing can be locked all stay."""
    with suppress(OSError), os.scandir(folder) as entries:
        for draft in [Path(e.path) for e in entries if e.name.startswith(PREFIX)]:
            handle = _held(draft)
            if handle is not None and handle >= 0:
                remove(draft)
                os.close(handle)


def _held(draft: Path) -> int | None:
    """Lock a draft; None if another process has it or it is gone, -1 where there are no locks."""
    if sys.platform == "win32":
        return -1
    import fcntl

    try:
        handle = os.open(draft, os.O_RDONLY | os.O_NOFOLLOW)
    except OSError as error:
        return None if error.errno == errno.ENOENT else -1
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if draft.lstat().st_ino == os.fstat(handle).st_ino:
            return handle
        found: int | None = None
    except (BlockingIOError, FileNotFoundError):
        found = None
    except OSError:
        found = -1
    os.close(handle)
    return found


def remove(path: Path) -> None:
    """Remove a file or folder if it is there."""
    try:
        path.unlink()
    except FileNotFoundError:
        pass
    except OSError:  # a folder
        import shutil  # late: few drafts are folders

        shutil.rmtree(path, ignore_errors=True)


def flush(path: Path) -> None:
    """Bring a file, or all files of a folder, to the disk: a name must not come before its bytes.

    OSError: the disk has no room for them, which writing need not have told.
    """
    is_folder = stat.S_ISDIR(path.stat().st_mode)
    for file in (p for p in path.rglob("*") if p.is_file()) if is_folder else [path]:
        handle = os.open(file, os.O_RDWR if sys.platform == "win32" else os.O_RDONLY)
        try:
            os.fsync(handle)
        except OSError as error:
            if error.errno not in UNABLE:
                raise
        finally:
            os.close(handle)
