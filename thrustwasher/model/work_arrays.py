"""Per-thread work arrays for kernels, kept alive between calls."""

import threading

import numpy as np
from numpy.typing import NDArray

_local = threading.local()


def work_array(key: tuple[object, ...], size: int) -> NDArray[np.float64]:
    """Return this thread's array of ``size`` numbers for ``key``; contents are left over."""
    arrays: dict[tuple[object, ...], NDArray[np.float64]] = _local.__dict__.setdefault("arrays", {})
    if key not in arrays or arrays[key].size != size:
        if len(arrays) >= 8:  # many grids in one program: do not hoard
            arrays.clear()
        arrays[key] = np.zeros(size)
    return arrays[key]
