"""What is kept between calls, by each thread: work arrays, and what belongs to parameters."""

import threading
from collections.abc import Callable
from typing import Any, Generic, TypeVar

import numpy as np

from ..numerics.jit import Array

T = TypeVar("T")
KEPT = 16
_local = threading.local()


def work_array(key: tuple[object, ...], size: int) -> Array:
    """Return this thread's array of ``size`` numbers for ``key``; contents are left over."""
    arrays: dict[tuple[object, ...], Array] = _local.__dict__.setdefault("arrays", {})
    if key not in arrays or arrays[key].size != size:
        if len(arrays) >= 8:  # many grids in one program: do not hoard
            arrays.clear()
        arrays[key] = np.zeros(size)
    return arrays[key]


class Recent(Generic[T]):
    """What ``make(params, *key)`` returned for the last few parameter objects of this thread.

    Looking it up by the object's identity takes a tenth of the time of comparing all its fields.
    """

    def __init__(self, make: Callable[..., T]) -> None:
        self.make, self.local = make, threading.local()

    def __call__(self, params: Any, *key: Any) -> T:
        """Return what was made for this object, or make it."""
        try:
            known: dict[Any, tuple[Any, T]] = self.local.known
        except AttributeError:
            known = self.local.known = {}
        found = known.get((id(params), key))
        if found is not None and found[0] is params:
            return found[1]
        if len(known) >= KEPT:
            known.clear()
        made = self.make(params, *key)
        known[id(params), key] = params, made
        return made
