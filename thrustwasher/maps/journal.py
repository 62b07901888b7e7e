"""Lines of a map that is being built, on disk as they come: a build that is stopped goes on."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..kernels import washer_map_layout as L

Array = NDArray[np.float64]


class Journal:
    """A file with the map's header and the lines solved so far, in order.

    Parameters
    ----------
    path : the file; None keeps nothing
    header : of the map; a file with another header is begun anew
    """

    def __init__(self, path: Path | None, header: Array) -> None:
        self.path, self._header = path, header
        self.lines = self._read()
        if path is not None and not len(self.lines):
            path.write_bytes(header.astype("<f8").tobytes())

    def _read(self) -> Array:
        """Return the lines in the file, (n, LINE); a line that is cut off does not count."""
        if self.path is None or not self.path.is_file():
            return np.empty((0, L.LINE))
        raw = self.path.read_bytes()
        whole = np.frombuffer(raw[: len(raw) // 8 * 8], "<f8")
        if not np.array_equal(whole[: L.DATA], self._header):
            return np.empty((0, L.LINE))
        n = (len(whole) - L.DATA) // L.LINE
        if n and len(raw) != 8 * (L.DATA + n * L.LINE):
            self.path.write_bytes(raw[: 8 * (L.DATA + n * L.LINE)])
        return whole[L.DATA : L.DATA + n * L.LINE].reshape(n, L.LINE).astype(np.float64)

    def add(self, line: Array) -> None:
        """Write one more line."""
        if self.path is not None:
            with self.path.open("ab") as file:
                file.write(line.astype("<f8").tobytes())

    def close(self) -> None:
        """Remove the file: the map is done."""
        if self.path is not None:
            self.path.unlink(missing_ok=True)
