"""Finished rows on disk: work that was stopped goes on where it was.

The file has one line of JSON that says which work it belongs to, then blocks: first row, number of
rows, checksum over both and the rows, the rows as bytes. Whatever follows a block that was cut off
or damaged is dropped, and done again.
"""

from __future__ import annotations

import json
import struct
import zlib
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, naming

_PLACE, _CHECK = struct.Struct("<qq"), struct.Struct("<I")
LAYOUT = 2


class Journal:
    """What some work has finished, kept beside its output while it runs.

    Parameters
    ----------
    path : the file
    identity : what makes this work differ from another of its kind, in words
    work : its kind, "sweep" or "map"

    Raises
    ------
    ParameterError : the file belongs to other work, or another run writes it now
    """

    def __init__(self, path: Path, identity: dict[str, str], work: str = "sweep") -> None:
        self.path, self.identity, self.work = path, identity, work
        path.parent.mkdir(parents=True, exist_ok=True)
        self._stream: IO[bytes] = open(path, "a+b")
        try:
            _lock(self._stream, path, work)
            self._check_head()
        except BaseException:
            self._stream.close()
            raise

    def _check_head(self) -> None:
        mark = f"thrustwasher {self.work}"
        begun = json.dumps({mark: LAYOUT, **self.identity}).encode() + b"\n"
        self._stream.seek(0)
        head = self._stream.readline()
        if begun.startswith(head) and head != begun:  # new, or cut off before anything was done
            self._stream.truncate(0)
            self._stream.write(begun)
            self._stream.flush()
            return
        try:
            found = json.loads(head)
            known = found.pop(mark) == LAYOUT
        except (ValueError, KeyError, AttributeError, RecursionError):
            raise ParameterError(
                f"{self.path}: is no journal of a {self.work}; remove it"
            ) from None
        both = {**found, **self.identity}
        differ = [k for k in both if found.get(k) != self.identity.get(k)]
        if not known or differ:
            raise ParameterError(
                f"{self.path}: was begun by another {self.work} (other "
                f"{', '.join(differ) or 'layout'}); run that one to its end, remove the file, or "
                "choose another output"
            )

    def load(self, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> NDArray[np.bool_]:
        """Fill in the rows that are done; return which (n_rows,)."""
        done = np.zeros(len(numbers), bool)
        stream = self._stream
        stream.seek(0)
        stream.readline()
        while True:
            good = stream.tell()
            block = _read_block(stream, numbers, flags)
            if block is None:
                break
            done[block] = True
        stream.seek(good)
        stream.truncate()
        return done

    def append(self, first: int, numbers: NDArray[np.float64], flags: NDArray[np.int32]) -> None:
        """Write finished rows, from row ``first`` on."""
        block = _PLACE.pack(first, len(numbers)) + numbers.tobytes() + flags.tobytes()
        with naming(self.path):
            self._stream.write(_CHECK.pack(zlib.crc32(block)) + block)
            self._stream.flush()

    def close(self, *, finished: bool) -> None:
        """Close the file; finished work needs it no longer."""
        with naming(self.path):
            self._stream.close()
        if finished:
            self.path.unlink(missing_ok=True)


def _read_block(
    stream: IO[bytes], numbers: NDArray[np.float64], flags: NDArray[np.int32]
) -> slice | None:
    """Read the next block into its rows; None at the end or where the file is damaged."""
    head = stream.read(_CHECK.size + _PLACE.size)
    if len(head) < _CHECK.size + _PLACE.size:
        return None
    (checksum,), place = _CHECK.unpack(head[: _CHECK.size]), head[_CHECK.size :]
    first, n = _PLACE.unpack(place)
    if first < 0 or n < 1 or first + n > len(numbers):
        return None
    split, width = n * numbers.shape[1] * 8, n * flags.shape[1] * 4
    payload = stream.read(split + width)
    if len(payload) < split + width or zlib.crc32(place + payload) != checksum:
        return None
    rows = slice(first, first + n)
    numbers[rows] = np.frombuffer(payload[:split], np.float64).reshape(n, -1)
    flags[rows] = np.frombuffer(payload[split:], np.int32).reshape(n, -1)
    return rows


def _lock(stream: IO[bytes], path: Path, work: str) -> None:
    """Refuse a file that another run has open; without locks on this system let it be."""
    try:
        import fcntl
    except ImportError:
        return
    locks: Any = fcntl
    try:
        locks.flock(stream, locks.LOCK_EX | locks.LOCK_NB)
    except BlockingIOError:
        raise ParameterError(
            f"{path}: another run is writing this {work}; wait for it, or choose another output"
        ) from None
    except OSError:
        return  # a file system without locks
