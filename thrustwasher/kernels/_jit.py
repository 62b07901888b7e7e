"""The one place that sets the compiler options: IEEE rules kept, 1/0 is inf, code cached.

numba stamps cached code by its own file only: after an edit of a called function in another file it
would go on running the old one. The cache folder is therefore named by a digest of all kernels.
"""

import hashlib
import os
import shutil
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba.core import config

F = TypeVar("F", bound=Callable[..., Any])
KEPT_VERSIONS = 5


@cache
def kernel_digest() -> str:
    """Return the first 16 hex digits of the SHA-256 over all kernel sources."""
    files = sorted(Path(__file__).parent.glob("*.py"))
    return hashlib.sha256(b"".join(f.name.encode() + f.read_bytes() for f in files)).hexdigest()[
        :16
    ]


def _forget_old(base: str) -> None:
    """Keep the compiled kernels of the last few versions only (some 10 MB each)."""
    folders = sorted(Path(base).glob("kernels-*"), key=lambda f: f.stat().st_mtime)
    for folder in folders[:-KEPT_VERSIONS]:
        shutil.rmtree(folder, ignore_errors=True)


@cache
def cache_folder() -> str:
    """Return the folder for compiled kernels: the user's cache, else a temporary folder."""
    base = os.environ.get("NUMBA_CACHE_DIR") or os.path.join(
        os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache"),
        "thrustwasher",
    )
    folder = os.path.join(base, f"kernels-{kernel_digest()}")
    try:
        if not os.path.isdir(folder):
            _forget_old(base)
        os.makedirs(folder, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:
        return os.path.join(tempfile.gettempdir(), f"thrustwasher-kernels-{kernel_digest()}")


def _compiled(function: Callable[..., Any], inline: str = "never") -> Any:
    """Compile lazily with the cache in ``cache_folder``; other users' numba cache is left alone."""
    settings: Any = config
    njit: Any = numba.njit
    before = settings.CACHE_DIR
    settings.CACHE_DIR = cache_folder()
    try:
        return njit(cache=True, fastmath=False, error_model="numpy", nogil=True, inline=inline)(
            function
        )
    finally:
        settings.CACHE_DIR = before


kernel = cast(Callable[[F], F], _compiled)


def _inlined(function: Callable[..., Any]) -> Any:
    """Compile as a part of each caller: for one that is called once and calls much code itself.

    numba optimises all code below a function again with that function; each layer costs seconds.
    """
    return _compiled(function, inline="always")


inlined = cast(Callable[[F], F], _inlined)
