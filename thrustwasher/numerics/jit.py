"""The one decorator of kernels.

A kernel is Python that can be compiled. Called from Python it runs as machine code where the
package's compiled library has it, else as the Python it is; numba is not imported. The environment
variable ``THRUSTWASHER_KERNELS = jit`` lets numba compile each kernel when it is first called
instead, for work on kernels; ``NUMBA_DISABLE_JIT = 1`` runs all as plain Python, for a debugger.

In every way IEEE rules are kept and 1/0 is inf. numba stamps cached code by its own file only:
after an edit of a called function in another file it would go on running the old one. Its cache
folder is therefore named by a digest of all kernels.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable
from functools import cache, update_wrapper
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np

from ..errors import EnvironmentProblem
from ..native.digest import digest
from ..native.entries import libraries
from ..native.files import VARIABLE, code_folder, forget_old, is_trusted, private_folder
from ..native.load import native_function
from ..native.signatures import Array as Array  # the kinds of array that kernels have
from ..native.signatures import Ints as Ints

F = TypeVar("F", bound=Callable[..., Any])
NUMBAS = "NUMBA_CACHE_DIR"
KEPT_VERSIONS = 5
PACKAGE = f"{__name__.partition('.')[0]}."
WAYS = ("native", "jit", "python")


@cache
def way() -> str:
    """Return how kernels run: one of ``WAYS``, or "emit" where they are only compiled.

    Raises
    ------
    EnvironmentProblem : the environment asks for a way that there is not
    """
    if os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("", "0"):
        return "python"
    wanted = os.environ.get("THRUSTWASHER_KERNELS") or "native"
    only_compiled = wanted == "emit" and os.environ.get("NUMBA_OPT") == "0"
    if wanted not in WAYS and not only_compiled:
        allowed = " or ".join(map(repr, WAYS))
        raise EnvironmentProblem(f"THRUSTWASHER_KERNELS = {wanted!r}, allowed: {allowed}")
    return wanted


class Kernel:
    """A kernel as Python sees it; compiled code that calls it sees numba's compiled function."""

    is_native = True  # its compiled function may be called without the way through this object

    def __init__(self, function: Callable[..., Any], inline: str) -> None:
        self.py_func, self.inline = function, inline
        self._run: Callable[..., Any] = self._first
        self._dispatcher: Any = None
        update_wrapper(self, function)

    def __call__(self, *args: Any, **named: Any) -> Any:
        """Run the kernel."""
        return self._run(*args, **named)

    def __reduce__(self) -> str:
        """Be found by name in another process."""
        return self.py_func.__qualname__

    def __get__(self, instance: object, owner: object = None) -> Kernel:
        """Be no method, as compiled functions are none."""
        return self

    def _first(self, *args: Any, **named: Any) -> Any:
        """Find the way to run when it is first needed."""
        self._run = native_function(self.py_func, jitted) or self.py_func
        return self._run(*args, **named)

    @property
    def _numba_type_(self) -> Any:
        """Let numba compile calls of this kernel."""
        if self._dispatcher is None:
            self._dispatcher = jitted(self.py_func, self.inline)
        return self._dispatcher._numba_type_


@cache
def kernel_digest() -> str:
    """Return 16 hex digits over the code of all of the package's kernels."""
    own = sorted(digest(library) for library in libraries() if library.startswith(PACKAGE))
    return hashlib.sha256(" ".join(own).encode()).hexdigest()[:16]


def cache_folder() -> str:
    """Return the folder of what numba compiled: in NUMBA_CACHE_DIR, else in the user's cache.

    One that others could change is not used: what lies there is run.
    """
    named, version = os.environ.get(NUMBAS), f"kernels-{kernel_digest()}"
    folder = (Path(named) if named else code_folder("jit")) / version
    is_safe = is_trusted(folder, NUMBAS if named else VARIABLE)
    return str(folder if is_safe and _is_usable(folder) else private_folder() / version)


@cache
def _is_usable(folder: Path) -> bool:
    """Make the folder of this version, and tell if it can be written to."""
    try:
        if not folder.is_dir():
            forget_old(folder.parent, "kernels-*", KEPT_VERSIONS)
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def jitted(function: Callable[..., Any], inline: str = "never") -> Any:
    """Compile lazily with the cache in ``cache_folder``; other users' numba cache is left alone."""
    import numba
    from numba.core import config

    settings: Any = config
    njit: Any = numba.njit
    rules: dict[str, Any] = {
        "fastmath": False,
        "error_model": "numpy",
        "nogil": True,
        "inline": inline,
    }
    if way() == "emit":
        return njit(no_cpython_wrapper=True, no_cfunc_wrapper=True, **rules)(function)
    before = settings.CACHE_DIR
    settings.CACHE_DIR = cache_folder()
    try:
        return njit(cache=True, **rules)(function)
    finally:
        settings.CACHE_DIR = before


def _made(function: Callable[..., Any], inline: str = "never") -> Any:
    if way() == "python":
        return function
    return Kernel(function, inline) if way() == "native" else jitted(function, inline)


kernel = cast(Callable[[F], F], _made)


def _inlined(function: Callable[..., Any]) -> Any:
    """Compile as a part of each caller: for one that is called once and calls much code itself."""
    return _made(function, "always")


inlined = cast(Callable[[F], F], _inlined)


class _View:
    """A function whose compiled form numba has no name for: ``numba_form`` makes it."""

    def __init__(self, function: Callable[..., Any], numba_form: Callable[[], Any]) -> None:
        self.function, self.numba_form = function, numba_form
        update_wrapper(self, function)

    def __call__(self, *args: Any) -> Any:
        """Return the view."""
        return self.function(*args)

    @property
    def _numba_type_(self) -> Any:
        """Let numba compile calls of this function."""
        return self.numba_form()


@cache
def _compiled_matrix() -> Any:
    """Return the type of ``matrix`` in numba, whose own reshape needs its library and may raise."""
    import numba
    from numba.core import cgutils
    from numba.core.registry import cpu_target
    from numba.extending import intrinsic
    from numba.np import arrayobj

    types: Any = numba.types
    arrays: Any = arrayobj
    pack: Any = cgutils.pack_array

    @intrinsic
    def matrix(_typing: Any, a: Any, rows: Any, columns: Any) -> Any:
        made = types.Array(a.dtype, 2, "C")

        def code(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            flat = arrays.make_array(signature.args[0])(context, builder, values[0])
            view = arrays.make_array(made)(context, builder)
            row = builder.mul(values[2], flat.itemsize)
            arrays.populate_array(
                view,
                data=flat.data,
                shape=pack(builder, values[1:]),
                strides=pack(builder, [row, flat.itemsize]),
                itemsize=flat.itemsize,
                meminfo=flat.meminfo,
                parent=flat.parent,
            )
            return arrays.impl_ret_borrowed(context, builder, made, view._getvalue())

        return made(a, types.intp, types.intp), code

    known: Any = cpu_target.typing_context
    known.refresh()
    return known.resolve_value_type(matrix)


def _matrix(a: Array, rows: int, columns: int) -> Array:
    """Return an array of rows x columns numbers as a matrix; nothing is copied."""
    return a.reshape(rows, columns)


matrix = cast(Callable[[Array, int, int], Array], _View(_matrix, _compiled_matrix))


@cache
def _cast_of(back: bool) -> Any:
    """Return the type of ``word_of``, or of ``number_of``, in numba."""
    import numba
    from numba.core.registry import cpu_target
    from numba.extending import intrinsic

    types: Any = numba.types

    @intrinsic
    def cast_bits(_typing: Any, x: Any) -> Any:
        made = types.float64 if back else types.uint64

        def code(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            return builder.bitcast(values[0], context.get_value_type(made))

        return made(types.uint64 if back else types.float64), code

    known: Any = cpu_target.typing_context
    known.refresh()
    return known.resolve_value_type(cast_bits)


def _word_of(x: float) -> Any:
    """Return the 64 bits of a number, as numpy's uint64."""
    return np.float64(x).view(np.uint64)


def _number_of(word: Any) -> float:
    """Return the number that has these 64 bits."""
    return float(np.uint64(word).view(np.float64))


word_of = cast(Callable[[float], Any], _View(_word_of, lambda: _cast_of(False)))
number_of = cast(Callable[[Any], float], _View(_number_of, lambda: _cast_of(True)))
