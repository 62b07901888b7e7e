"""The complete state of an instance, and its bytes: checked in full before anything is used."""

import struct
import zlib
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError

MAGIC = b"thrustw2"
# magic, total length, identity of the model's content, lengths, time, mode, flags, latch
HEADER = struct.Struct("<8sQ16s7Id3i")
N_REALS = 4  # of the seven arrays; the others hold integers
CHECK = struct.Struct("<I")  # CRC-32 over all that precedes it


@dataclass(frozen=True, slots=True)
class Snapshot:
    """All that decides what comes next; ``work`` is not in it as it carries nothing."""

    identity: str
    par: NDArray[np.float64]
    inp: NDArray[np.float64]
    state: NDArray[np.float64]
    out: NDArray[np.float64]
    iout: NDArray[np.int32]
    time: float
    mode: int
    dirty: bool
    prepared: bool
    latch: int
    refused: NDArray[np.int32]  # references of variables whose last value was not taken over
    seen: NDArray[np.int32]  # Boolean outputs that make events, at the last communication point

    def to_bytes(self) -> bytes:
        """Return the same bytes on every platform: little endian, header first, CRC last."""
        reals = (self.par, self.inp, self.state, self.out)
        whole = (self.iout, self.refused, self.seen)
        payload = b"".join(a.astype("<f8").tobytes() for a in reals)
        payload += b"".join(a.astype("<i4").tobytes() for a in whole)
        sizes = [len(a) for a in (*reals, *whole)]
        length = HEADER.size + len(payload) + CHECK.size
        flags = int(self.dirty) + 2 * int(self.prepared)
        head = HEADER.pack(MAGIC, length, self.identity.encode(), *sizes, self.time, self.mode,
                           flags, self.latch)  # fmt: skip
        return head + payload + CHECK.pack(zlib.crc32(head + payload))


def from_bytes(data: bytes) -> Snapshot:
    """Read what ``to_bytes`` wrote, or raise ParameterError saying why not."""
    if len(data) < HEADER.size + CHECK.size or data[:8] != MAGIC:
        raise ParameterError("FMU state = bytes that no thrustwasher FMU has written")
    _, length, identity, *rest = HEADER.unpack_from(data)
    sizes: list[Any] = rest[:7]
    time, mode, flags, latch = rest[7:]
    expected = HEADER.size + 8 * sum(sizes[:N_REALS]) + 4 * sum(sizes[N_REALS:]) + CHECK.size
    if length != len(data) or expected != len(data):
        raise ParameterError(f"FMU state = {len(data)} bytes, allowed: {length}; it is truncated")
    (check,) = CHECK.unpack_from(data, length - CHECK.size)
    if check != zlib.crc32(data[: -CHECK.size]):
        raise ParameterError("FMU state = bytes with a wrong checksum; they were changed")
    arrays, offset = [], HEADER.size
    for size, dtype in zip(sizes, ["<f8"] * N_REALS + ["<i4"] * 3, strict=True):
        array = np.frombuffer(data, dtype, size, offset)
        arrays.append(array.astype(array.dtype.newbyteorder("=")))
        offset += array.nbytes
    par, inp, state, out, iout, refused, seen = arrays
    return Snapshot(
        identity.decode("ascii", "replace"), par, inp, state, out, iout,
        time, mode, bool(flags & 1), bool(flags & 2), latch, refused, seen,
    )  # fmt: skip
