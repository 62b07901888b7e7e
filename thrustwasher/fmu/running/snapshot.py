"""The complete state of an instance, and its bytes: checked in full before anything is used."""

import json
import zlib
from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError

ARRAYS = ("par", "inp", "rates", "state", "out", "iout")
TYPES = dict.fromkeys(ARRAYS[:5], float) | dict.fromkeys(("iout", "refused", "seen"), np.int32)


@dataclass(frozen=True, slots=True)
class Snapshot:
    """All that decides what comes next; ``work`` is not in it as it carries nothing."""

    identity: str
    par: NDArray[np.float64]
    inp: NDArray[np.float64]
    rates: NDArray[np.float64]  # of the inputs in the next step
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
        """Return the same bytes on every platform: a CRC-32, then JSON, whose numbers are exact."""
        held = asdict(self)
        text = json.dumps({**held, **{name: held[name].tolist() for name in TYPES}}).encode()
        return _check(text) + text


def from_bytes(data: bytes) -> Snapshot:
    """Read what ``to_bytes`` wrote, or raise ParameterError."""
    check, text = data[:8], data[8:]
    try:
        if check != _check(text):
            raise ValueError("wrong checksum")
        found = json.loads(text)
        arrays = {name: np.array(found[name], kind) for name, kind in TYPES.items()}
        return Snapshot(**{**found, **arrays})
    except (ValueError, TypeError, KeyError):
        raise ParameterError(
            f"FMU state = {len(data)} bytes, allowed: bytes that this FMU has written, unchanged"
        ) from None


def _check(text: bytes) -> bytes:
    return b"%08x" % zlib.crc32(text)
