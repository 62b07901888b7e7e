"""Finished work on disk, in an SQLite file: what was stopped goes on where it was.

One process writes: the one that hands the work out. What is done is committed at the first entry,
then once a second and at the end: a signal loses nothing, a crash a second's work. SQLite does not
notice a changed bit, so every entry has a checksum.
"""

import errno
import os
import sqlite3
import time
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, naming

LAYOUT = "3"
INTERVAL = 1.0  # [s] from commit to commit
TABLES = """
CREATE TABLE work(name TEXT, value TEXT);
CREATE TABLE done(entry INTEGER PRIMARY KEY, value BLOB, checksum INTEGER);
"""
PUT = "INSERT OR REPLACE INTO done VALUES (?, ?, ?)"
Block = tuple[int, NDArray[np.float64], NDArray[np.int32]]  # first row, (n, ...), (n, ...)
BUSY = (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)
DISK = (sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR)


class Journal:
    """What some work has finished, kept beside its output while it runs.

    ``identity`` is what makes this work differ from another of its kind, in words; ``work`` is the
    kind, "sweep" or "map". ParameterError: the file is no journal, is spoiled or that of other
    work, or another run writes it now.
    """

    def __init__(self, path: Path, identity: dict[str, str], work: str = "sweep") -> None:
        self.path, self.work = path, work
        self._waiting: list[tuple[int, bytes, int]] = []
        self._is_blank = False
        self._committed = -INTERVAL  # the first entry is written at once
        path.parent.mkdir(parents=True, exist_ok=True)
        with naming(path):
            path.touch()
        with self._named():
            self._db = sqlite3.connect(path, timeout=0.0, isolation_level=None)
        try:
            with self._named():
                self._db.executescript("PRAGMA locking_mode=EXCLUSIVE; BEGIN EXCLUSIVE")
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
                raise ParameterError(
                    f"{self.path}: another run is writing this {self.work}, or nothing can be "
                    "locked here; wait for it, or choose another output"
                ) from None
            if code in DISK or not os.access(self.path, os.W_OK):
                number = errno.ENOSPC if code == sqlite3.SQLITE_FULL else errno.EIO
                raise OSError(number, str(error), str(self.path)) from None
            raise ParameterError(
                f"{self.path}: is no journal of a {self.work}, or is spoiled ({error}); remove it"
            ) from None

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
        if time.monotonic() - self._committed >= INTERVAL:
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
        self._committed = time.monotonic()

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
            split = 8 * n_numbers * n
            numbers = np.frombuffer(value[:split], np.float64).reshape(n, -1)
            yield first, numbers, np.frombuffer(value[split:], np.int32).reshape(n, -1)

    def load(self, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> NDArray[np.bool_]:
        """Fill in the rows that are done; return which (n_rows,)."""
        done = np.zeros(len(numbers), bool)
        for first, values, marks in self.blocks(numbers.shape[1], flags.shape[1]):
            rows = slice(first, first + len(marks))
            numbers[rows], flags[rows], done[rows] = values, marks, True
        return done

    def append(self, first: int, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> None:
        """Keep finished rows, from row ``first`` on."""
        self.put(first, numbers.tobytes() + flags.tobytes())

    def close(self, *, finished: bool = False) -> None:
        """Close the file; finished work needs it no longer, nor does work that has nothing yet."""
        try:
            if self._waiting and not finished:
                self.flush()
        finally:
            with self._named():
                self._db.close()
        if finished or self._is_blank:
            with naming(self.path):
                self.path.with_name(f"{self.path.name}-journal").unlink(missing_ok=True)
                self.path.unlink(missing_ok=True)


def _checksum(entry: int, value: bytes) -> int:
    return zlib.crc32(value, zlib.crc32(str(entry).encode()))
