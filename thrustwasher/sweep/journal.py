"""Finished lines on disk: a stopped sweep goes on where it was.

The file has one line of JSON that says which sweep it belongs to, then blocks: first row, number of
rows, checksum, the rows' outputs as bytes. A block that was cut off by a crash is dropped.
"""

from __future__ import annotations

import json
import struct
import zlib
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError

_HEAD = struct.Struct("<qqI")
_MARK = "thrustwasher sweep"
LAYOUT = 1


class Journal:
    """What a sweep has finished, kept beside its output while it runs."""

    def __init__(self, path: Path, identity: dict[str, str]) -> None:
        """Open the journal of this sweep, or begin one.

        Raises
        ------
        ParameterError : the file belongs to another sweep, or another run writes it now
        """
        self.path, self.identity = path, identity
        path.parent.mkdir(parents=True, exist_ok=True)
        self._stream: IO[bytes] = open(path, "a+b")
        try:
            _lock(self._stream, path)
            self._check_head()
        except BaseException:
            self._stream.close()
            raise

    def _check_head(self) -> None:
        self._stream.seek(0)
        head = self._stream.readline()
        if not head.endswith(b"\n"):  # new, or cut off before anything was done
            self._stream.truncate(0)
            line = json.dumps({_MARK: LAYOUT, **self.identity})
            self._stream.write(line.encode() + b"\n")
            self._stream.flush()
            return
        try:
            found = json.loads(head)
            known = found.pop(_MARK) == LAYOUT
        except (ValueError, KeyError, AttributeError):
            raise ParameterError(f"{self.path}: is no journal of a sweep; remove it") from None
        both = {**found, **self.identity}
        differ = [k for k in both if found.get(k) != self.identity.get(k)]
        if not known or differ:
            raise ParameterError(
                f"{self.path}: was begun by another sweep (other {', '.join(differ) or 'layout'}); "
                "run that one to its end, remove the file, or choose another output"
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
        payload = numbers.tobytes() + flags.tobytes()
        self._stream.write(_HEAD.pack(first, len(numbers), zlib.crc32(payload)) + payload)
        self._stream.flush()

    def close(self, *, finished: bool) -> None:
        """Close the file; a finished sweep needs it no longer."""
        self._stream.close()
        if finished:
            self.path.unlink(missing_ok=True)


def _read_block(
    stream: IO[bytes], numbers: NDArray[np.float64], flags: NDArray[np.int32]
) -> slice | None:
    """Read the next block into its rows; None at the end or where the file is damaged."""
    head = stream.read(_HEAD.size)
    if len(head) < _HEAD.size:
        return None
    first, n, checksum = _HEAD.unpack(head)
    if first < 0 or n < 1 or first + n > len(numbers):
        return None
    split, width = n * numbers.shape[1] * 8, n * flags.shape[1] * 4
    payload = stream.read(split + width)
    if len(payload) < split + width or zlib.crc32(payload) != checksum:
        return None
    rows = slice(first, first + n)
    numbers[rows] = np.frombuffer(payload[:split], np.float64).reshape(n, -1)
    flags[rows] = np.frombuffer(payload[split:], np.int32).reshape(n, -1)
    return rows


def _lock(stream: IO[bytes], path: Path) -> None:
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
            f"{path}: another run is writing this sweep; wait for it, or choose another output"
        ) from None
    except OSError:
        return  # a file system without locks
