"""A kernel's compiled function as a Python function: numbers and arrays in, numbers out."""

import ctypes
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import Any

import numpy as np

from ..errors import EnvironmentProblem
from .entries import arrays_of_two, library_of, symbol_of
from .files import to_stderr
from .signatures import ITEMS, Entry, Kind, describe

_BACK = {"float": "_numbers[{}]", "int": "int(_numbers[{}])", "bool": "_numbers[{}] != 0.0"}
_ITEMS = {name: np.dtype(name) for name in ITEMS.values()}
_Native = ctypes.CFUNCTYPE(
    ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p
)
_raised = ctypes.c_void_p()  # where a kernel would leave an exception; kernels raise none
_result = ctypes.c_int32()  # always 0: what comes back stands in the block


class Unfit(TypeError):
    """An argument is no array of the kind that the compiled function takes."""

    def __init__(self, item: object, ndim: int) -> None:
        super().__init__(f"a contiguous array of {item} with {ndim} dimensions is required")


def native_function(
    function: Callable[..., Any], elsewhere: Callable[..., Any]
) -> Callable[..., Any] | None:
    """Return the compiled function of a kernel, None if no library has it.

    Arguments that it does not take, such as an array that is not contiguous, go to the kernel as
    plain Python. Arrays are handed over by their address, read only ones too. Where no libraries
    are made for this machine, ``elsewhere`` compiles the kernel. EnvironmentProblem: the library
    has to be made and cannot be.
    """
    if library_of(function.__module__, function.__name__) is None:
        return None
    place = _place_of(function)
    if place is None:
        compiled: Callable[..., Any] = elsewhere(function)
        return compiled
    return python_function(_entry_of(function), place)


@cache
def _has_platform() -> bool:
    """Tell if libraries are made for this machine; if not, say once what happens instead."""
    from .link import this_platform

    try:
        this_platform()
    except EnvironmentProblem as problem:
        to_stderr(f"{problem}; numba compiles the kernels instead, minutes at first")
        return False
    return True


def address(array: object, item: object, ndim: int) -> int:
    """Return where an array's numbers lie; Unfit if it is not contiguous, or of another kind."""
    if type(array) is not np.ndarray or array.ndim != ndim or array.dtype != item:
        raise Unfit(item, ndim)
    memory: Any = array  # how far an array is a buffer differs between releases of numpy's types
    try:
        return ctypes.addressof(ctypes.c_char.from_buffer(memory))
    except (TypeError, ValueError, BufferError):  # read only, empty, or not contiguous
        if not array.flags.c_contiguous:
            raise Unfit(item, ndim) from None
        return int(array.ctypes.data)


def bound(kernel: Any, **arrays: Any) -> Callable[..., Any]:
    """Return a kernel that always works on these arrays, as a function of its other arguments.

    Looking at arrays takes longer than most kernels: where the same are used again and again this
    is done once. The other arguments go by position, in their order.
    """
    function = getattr(kernel, "py_func", kernel)
    names = _names(function)
    assert arrays.keys() <= set(names), f"{function.__name__} takes {', '.join(names)}"
    place = _place_of(function) if getattr(kernel, "is_native", False) else None
    if place is None:
        open_ = [name for name in names if name not in arrays]
        return lambda *rest: kernel(**arrays, **dict(zip(open_, rest, strict=True)))
    return python_function(_entry_of(function), place, arrays)


@cache
def _entry_of(function: Callable[..., Any]) -> Entry:
    """Return what a kernel takes and gives; reading its annotations takes a while."""
    return describe(function, arrays_of_two(function.__module__, function.__name__))


def _names(function: Any) -> tuple[str, ...]:
    names: tuple[str, ...] = function.__code__.co_varnames[: function.__code__.co_argcount]
    return names


def _place_of(function: Callable[..., Any]) -> int | None:
    """Return the address of a kernel's compiled function, None if no library has it."""
    library = library_of(function.__module__, function.__name__)
    if library is None or not _has_platform():
        return None
    from .library import addresses

    return addresses(library)[symbol_of(function.__module__, function.__name__)]


def python_function(
    entry: Entry, place: int, fixed: Mapping[str, object] | None = None
) -> Callable[..., Any]:
    """Return the function at an address as one with the arguments of the kernel.

    The function takes one block of 64-bit words: a number is a word, an array its address and its
    lengths; what comes back follows. The way there is written as Python text for these arguments: a
    loop over their kinds in each call would take longer than most kernels. ``fixed``: arrays by the
    name of their argument, which falls away; their block is kept, so that one thread at a time may
    call.
    """
    plain = getattr(entry.function, "py_func", entry.function)
    names, fixed = _names(plain), fixed or {}
    words: list[tuple[str, str]] = []
    for kind, name in zip(entry.takes, names, strict=True):
        words += _words(kind, f"_kept[{name!r}]" if name in fixed else name)
    first, n = len(words), len(entry.returns)
    back = [_BACK[kind.name].format(first + k) for k, kind in enumerate(entry.returns)]
    value = (f"({', '.join(back)},)" if entry.is_tuple else back[0]) if n else "None"
    scope: dict[str, Any] = {
        "_native": _Native(place),
        "_plain": plain,
        "_kept": fixed,
        "_address": address,
        "_Unfit": Unfit,
        "_fail": _fail,
        "_Words": ctypes.c_int64 * (first + n),
        "_Numbers": ctypes.c_double * (first + n),
        "_raised": ctypes.byref(_raised),
        "_result": ctypes.byref(_result),
        **{f"_{name}": item for name, item in _ITEMS.items()},
    }
    steps = [f"{array}[{k}] = {text}" for k, (array, text) in enumerate(words)]
    make = ["_words = _Words()", "_numbers = _Numbers.from_buffer(_words)"]
    if fixed:  # the block stays, and what stands in it
        exec("\n".join([*make, *(step for step in steps if "_kept[" in step)]), scope)
        make, steps = [], [step for step in steps if "_kept[" not in step]
    given = ", ".join(f"_kept[{name!r}]" if name in fixed else name for name in names)
    source = "\n ".join(
        [
            f"def {plain.__name__}({', '.join(name for name in names if name not in fixed)}):",
            *make,
            "try:",
            *(f" {step}" for step in steps or ["pass"]),
            "except _Unfit:",
            f" return _plain({given})",
            "if _native(_result, _raised, _words, _words):",
            " _fail()",
            f"return {value}",
        ]
    )
    exec(source, scope)
    made: Callable[..., Any] = scope.pop(plain.__name__)  # or its arrays would outlive it
    return made


def _words(kind: Kind, text: str) -> Iterator[tuple[str, str]]:
    """Give, for each word of an argument, the array it is written to and its Python text."""
    if kind.name == "tuple":
        for k, part in enumerate(kind.parts):
            yield from _words(part, f"{text}[{k}]")
    elif kind.name == "float":
        yield "_numbers", text
    elif kind.name == "array":
        yield "_words", f"_address({text}, _{kind.item}, {kind.ndim})"
        for k in range(kind.ndim):
            yield "_words", f"{text}.shape[{k}]"
    else:
        yield "_words", f"int({text})"


def _fail() -> None:
    raise RuntimeError("a compiled kernel raised an exception, which it never should")
