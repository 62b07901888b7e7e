"""Compile rivals like the kernels, with a cache of their own keyed by kernels and rivals."""

import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba.core import config

from thrustwasher.numerics.jit import cache_folder

F = TypeVar("F", bound=Callable[..., Any])


def _compiled(function: Callable[..., Any]) -> Any:
    settings: Any = config
    njit: Any = numba.njit
    sources = sorted(Path(function.__code__.co_filename).parent.glob("*.py"))
    digest = hashlib.sha256(b"".join(f.read_bytes() for f in sources)).hexdigest()[:16]
    before = settings.CACHE_DIR
    settings.CACHE_DIR = os.path.join(cache_folder(), f"rivals-{digest}")
    try:
        return njit(cache=True, fastmath=False, error_model="numpy", nogil=True)(function)
    finally:
        settings.CACHE_DIR = before


rival = cast(Callable[[F], F], _compiled)
