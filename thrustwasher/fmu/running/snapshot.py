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
TYPES = {"par": "<f8", "inp": "<f8", "state": "<f8", "out": "<f8", "iout": "<i4",
         "refused": "<i4", "seen": "<i4"}  # fmt: skip
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
        arrays = [getattr(self, name) for name in TYPES]
        pairs = zip(arrays, TYPES.values(), strict=True)
        payload = b"".join(array.astype(kind).tobytes() for array, kind in pairs)
        sizes = [len(array) for array in arrays]
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
    expected = HEADER.size + 8 * sum(sizes[:4]) + 4 * sum(sizes[4:]) + CHECK.size
    if length != len(data) or expected != len(data):
        raise ParameterError(f"FMU state = {len(data)} bytes, allowed: {length}; it is truncated")
    (check,) = CHECK.unpack_from(data, length - CHECK.size)
    if check != zlib.crc32(data[: -CHECK.size]):
        raise ParameterError("FMU state = bytes with a wrong checksum; they were changed")
    arrays: dict[str, Any] = {}
    offset = HEADER.size
    for (name, kind), size in zip(TYPES.items(), sizes, strict=True):
        array = np.frombuffer(data, kind, size, offset)
        arrays[name] = array.astype(array.dtype.newbyteorder("="))
        offset += array.nbytes
    return Snapshot(
        identity=identity.decode("ascii", "replace"), time=time, mode=mode,
        dirty=bool(flags & 1), prepared=bool(flags & 2), latch=latch, **arrays,
    )  # fmt: skip
