"""Finished work on disk, in an SQLite file: what was stopped goes on where it was.

One process writes: the one that hands the work out. What is done is committed at the first entry,
then once a second or where it is much, and at the end: a signal loses nothing, a crash a second's
work. SQLite does not notice a changed bit, so every entry has a checksum.
"""

import errno
import os
import sqlite3
import time
import zlib
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, naming

LAYOUT = "3"
INTERVAL = 1.0  # [s] from commit to commit, if there is not much to write before
MUCH = 4_000_000  # bytes
PATIENCE = 900.0  # [s] that one run waits for another; a lock ends with the process that has it
LOOK = 0.5  # [s] between two attempts
TABLES = """
CREATE TABLE work(name TEXT, value TEXT);
CREATE TABLE done(entry INTEGER PRIMARY KEY, value BLOB, checksum INTEGER);
"""
PUT = "INSERT OR REPLACE INTO done VALUES (?, ?, ?)"
Block = tuple[int, NDArray[np.float64], NDArray[np.int32]]  # first row, (n, ...), (n, ...)
T = TypeVar("T")
LOCK = "PRAGMA locking_mode=EXCLUSIVE; BEGIN EXCLUSIVE"
BUSY = (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)
DISK = (sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR)


class InUseError(ParameterError):
    """Another run writes the journal ``path`` now."""

    def __init__(self, path: Path, message: str) -> None:
        super().__init__(message)
        self.path = path


def when_free(attempt: Callable[[], T], say: Callable[[str], None]) -> T:
    """Return what an attempt returns, made again while another run has its journal.

    The wait is said once. InUseError: that run still has it after ``PATIENCE``.
    """
    until = time.monotonic() + PATIENCE
    is_said = False
    while True:
        try:
            return attempt()
        except InUseError as problem:
            if time.monotonic() > until or not _can_lock(problem.path.parent):
                raise
            if not is_said:
                say(f"waits for another run: {problem.path}")
                is_said = True
        time.sleep(LOOK)


def _can_lock(folder: Path) -> bool:
    """Return whether a file of a folder can be locked: not every file system can."""
    with TemporaryDirectory(dir=folder) as place:
        with closing(sqlite3.connect(Path(place) / "trial", timeout=0.0)) as trial:
            try:
                trial.executescript(f"{LOCK}; COMMIT")
            except sqlite3.Error:
                return False
    return True


class Journal:
    """What some work has finished, kept next to its output while it runs.

    ``identity`` is what makes this work differ from another of its kind, in words; ``work`` is the
    kind, "sweep" or "map". ParameterError: the file is no journal, is spoiled or that of other
    work, or another run writes it now.
    """

    def __init__(self, path: Path, identity: dict[str, str], work: str = "sweep") -> None:
        self.path, self.work = path, work
        self._waiting: list[tuple[int, bytes, int]] = []
        self._size = 0  # [bytes] of what waits
        self._is_blank = False
        self._committed = -INTERVAL  # the first entry is written at once
        path.parent.mkdir(parents=True, exist_ok=True)
        with naming(path):
            path.touch()
            inode = path.stat().st_ino
        with self._named():
            self._db = sqlite3.connect(path, timeout=0.0, isolation_level=None)
        try:
            with self._named():
                self._db.executescript(LOCK)
                if not path.exists() or path.stat().st_ino != inode:
                    raise self._in_use()  # the run that had it ended just now and removed it
                self._begin({f"thrustwasher {work}": LAYOUT, **identity})
                self._db.execute("COMMIT")  # the lock stays
        except BaseException:
            self._db.close()
            raise

    def _begin(self, identity: dict[str, str]) -> None:
        """Say whose journal an empty file is; refuse one that is another's."""
        if self.path.stat().st_size == 0:
            self._is_blank = True
            for table in TABLES.strip().splitlines():
                self._db.execute(table)
            self._db.executemany("INSERT INTO work VALUES (?, ?)", identity.items())
            return
        found = dict(self._db.execute("SELECT name, value FROM work"))
        differ = [str(k) for k in {**found, **identity} if found.get(k) != identity.get(k)]
        if differ:
            raise ParameterError(
                f"{self.path}: was begun by another {self.work} (other {', '.join(differ)}); run "
                "that one to its end, remove the file, or choose another output"
            )

    @contextmanager
    def _named(self) -> Iterator[None]:
        """Say of which file SQLite complains, and what to do."""
        try:
            yield
        except (sqlite3.Error, sqlite3.Warning, UnicodeDecodeError) as error:
            code = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_ERROR) & 0xFF
            if code in BUSY:
                raise self._in_use() from None
            if code in DISK or not os.access(self.path, os.W_OK):
                number = errno.ENOSPC if code == sqlite3.SQLITE_FULL else errno.EIO
                raise OSError(number, str(error), str(self.path)) from None
            raise ParameterError(
                f"{self.path}: is no journal of a {self.work}, or is spoiled ({error}); remove it"
            ) from None

    def _in_use(self) -> InUseError:
        return InUseError(
            self.path,
            f"{self.path}: another run is writing this {self.work}, or nothing can be locked "
            "here; wait for it, stop it, or choose another output",
        )

    def entries(self) -> Iterator[tuple[int, bytes]]:
        """Yield what is done: number and content of each entry, by their numbers."""
        with self._named():
            for entry, value, checksum in self._db.execute("SELECT * FROM done ORDER BY entry"):
                if not isinstance(value, bytes) or checksum != _checksum(entry, value):
                    raise sqlite3.DatabaseError(f"entry {entry} was changed")
                yield entry, value

    def put(self, entry: int, value: bytes) -> None:
        """Keep an entry; it is on disk a second later, or when the journal is closed."""
        self._is_blank = False
        self._waiting.append((entry, value, _checksum(entry, value)))
        self._size += len(value)
        if self._size >= MUCH or time.monotonic() - self._committed >= INTERVAL:
            self.flush()

    def flush(self) -> None:
        """Write what waits; if the disk has no room for all of it, what there is room for."""
        if not self._waiting:  # the first entry is yet to come
            return
        with self._named():
            try:
                self._commit(len(self._waiting))
            except sqlite3.OperationalError:
                while self._waiting:
                    self._commit(1)
        self._committed, self._size = time.monotonic(), 0

    def _commit(self, n: int) -> None:
        self._db.execute("BEGIN")
        try:
            self._db.executemany(PUT, self._waiting[:n])
            self._db.execute("COMMIT")
        except BaseException:
            if self._db.in_transaction:
                self._db.execute("ROLLBACK")
            raise
        del self._waiting[:n]

    def blocks(self, n_numbers: int, n_flags: int) -> Iterator[Block]:
        """Yield the rows that are done, in their order: first row, numbers, flags."""
        self.flush()
        for first, value in self.entries():
            n = len(value) // (8 * n_numbers + 4 * n_flags)
            numbers = np.frombuffer(value, np.float64, n * n_numbers).reshape(n, -1)
            flags = np.frombuffer(value, np.int32, n * n_flags, numbers.nbytes)
            yield first, numbers, flags.reshape(n, -1)

    def load(self, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> NDArray[np.bool_]:
        """Fill in the rows that are done; return which (n_rows,)."""
        done = np.zeros(len(numbers), bool)
        for first, values, marks in self.blocks(numbers.shape[1], flags.shape[1]):
            rows = slice(first, first + len(marks))
            numbers[rows], flags[rows], done[rows] = values, marks, True
        return done

    def append(self, first: int, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> None:
        """Keep finished rows, from row ``first`` on."""
        self.put(first, b"".join(np.ascontiguousarray(part).data for part in (numbers, flags)))

    def close(self, *, finished: bool = False) -> None:
        """Close the file; finished work needs it no longer, nor does work that has nothing yet."""
        try:
            if self._waiting and not finished:
                self.flush()
        finally:
            gone = finished or self._is_blank
            if gone and os.name == "posix":
                self._remove()  # while it is locked: another run finds no half of it
            with self._named():
                self._db.close()
        if gone and os.name != "posix":  # where an open file cannot be removed
            with suppress(PermissionError):  # another run has it by now
                self._remove()

    def _remove(self) -> None:
        with naming(self.path):
            self.path.with_name(f"{self.path.name}-journal").unlink(missing_ok=True)
            self.path.unlink(missing_ok=True)


def _checksum(entry: int, value: bytes) -> int:
    return zlib.crc32(value, zlib.crc32(str(entry).encode()))
