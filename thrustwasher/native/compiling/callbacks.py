"""The entries of a kernel module as C callbacks that numba makes.

numba makes of each entry a C callback around a compiled function. The callback holds all that needs
Python (lock, exceptions) and falls away; the function inside takes numbers and needs libm at most.
"""

import importlib
import itertools
import re
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import Any

from ...errors import EnvironmentProblem
from ..entries import called_modules
from ..signatures import ITEMS, Entry, Kind, entries

# Entries of the step ABI: name in the kernel module -> name in the FMU's shell, lengths of the
# arrays ("": a number). NGIVEN: inputs, and their rates behind them where the model takes them;
# NSEED: inputs, and tunable parameters behind them where the model differentiates over these.
_ARRAYS = ("NPAR", "NGIVEN", "NSTATE", "NWORK")
ABI: dict[str, tuple[str, tuple[str, ...]]] = {
    "derive": ("tw_derive", ("NPAR",)),
    "broken_rule": ("tw_rule", ("NPAR",)),
    "step": ("tw_step", (*_ARRAYS, "NOUT", "NIOUT", "", "")),
    "sens": ("tw_sens", (*_ARRAYS, "NSEED", "NOUT")),
}
# Entries for model exchange, of the module or folder ``exchange`` beside that of the step.
_EXCHANGED = ("NPAR", "NOWN", "NINP", "NCONT", "NMODE", "NWORK")
EXCHANGE_ABI: dict[str, tuple[str, tuple[str, ...]]] = {
    "start": ("tw_start", (*_EXCHANGED, "")),
    "rates": ("tw_rates", (*_EXCHANGED, "NOUT", "NCONT", "NSIGN")),
    "update": ("tw_update", (*_EXCHANGED, "NOUT", "NIOUT", "")),
    "finish": ("tw_finish", (*_EXCHANGED, "")),  # of kernels that keep a solution
    "slopes": ("tw_slopes", (*_EXCHANGED, "NALONG", "NFOUND")),
}


@dataclass(frozen=True, slots=True)
class Callback:
    """A C function to be made: ``types`` of its arguments, Python source of ``entry``, its names.

    ``source`` defines ``entry``, which calls what ``scope`` holds.
    """

    symbol: str
    types: tuple[str, ...]  # "float", or the type an address points to
    source: str
    scope: dict[str, Any]


def callbacks(kernel: ModuleType) -> list[Callback]:
    """Return all entries of a kernel module: for an FMU's shell, then for Python."""
    shell = [abi_callback(*entry) for entry in abi(kernel)]
    return shell + [python_callback(entry) for entry in entries(kernel.__name__)]


def abi(kernel: ModuleType) -> list[tuple[ModuleType, str, str, tuple[str, ...]]]:
    """Return the entries for an FMU's shell: module, name, name in the shell, lengths of arrays."""
    found = [(kernel, name, *about) for name, about in ABI.items() if hasattr(kernel, name)]
    exchange = f"{kernel.__name__.rpartition('.')[0]}.exchange"
    for home in {exchange, f"{exchange}.unit"}.intersection(called_modules(kernel.__name__)):
        module = importlib.import_module(home)
        found += [
            (module, name, *about) for name, about in EXCHANGE_ABI.items() if hasattr(module, name)
        ]
    return found


def abi_callback(kernel: ModuleType, name: str, symbol: str, sizes: tuple[str, ...]) -> Callback:
    """Return an entry of the step ABI: bare addresses of arrays whose lengths are known."""
    kinds = tuple(("int32" if s == "NIOUT" else "float64") if s else "float" for s in sizes)
    names = [f"a{i}" for i in range(len(sizes))]
    given = [f"carray({n}, {size})" if size else n for n, size in zip(names, sizes, strict=True)]
    source = f"def entry({', '.join(names)}):\n return function({', '.join(given)})\n"
    scope = {"function": getattr(kernel, name)}
    scope |= {size: _length(kernel, size) for size in sizes if size}
    return Callback(symbol, kinds, source, scope)


def _length(kernel: ModuleType, name: str) -> int:
    """Return a length of a kernel module's arrays by its name."""
    if name in ("NALONG", "NFOUND"):
        return sum(getattr(kernel, n) for n in ("NINP" if name == "NALONG" else "NOUT", "NCONT"))
    plain = name == "NGIVEN" or (name == "NSEED" and not hasattr(kernel, name))
    length: int = getattr(kernel, "NINP" if plain else name)
    return length + getattr(kernel, "NRATES", 0) if name == "NGIVEN" else length


def python_callback(entry: Entry) -> Callback:
    """Return an entry for Python, which takes one block of 64-bit words.

    A number is a word, an array its address and its lengths. What comes back follows them. The
    block is handed over twice, as whole numbers and as numbers.
    """
    scope: dict[str, Any] = {"function": entry.function}
    places = itertools.count()

    def given(kind: Kind) -> str:
        if kind.name == "tuple":
            parts = ", ".join([given(part) for part in kind.parts])
            if kind.made_by is None:
                return f"({parts},)"
            scope[kind.made_by.__name__] = kind.made_by
            return f"{kind.made_by.__name__}({parts})"
        place = next(places)
        if kind.name == "array":
            lengths = "".join(f"words[{next(places)}], " for _ in range(kind.ndim))
            return f"carray(at_{kind.item}(words[{place}]), ({lengths}))"
        return {"float": f"numbers[{place}]", "int": f"words[{place}]"}.get(
            kind.name, f"words[{place}] != 0"
        )

    call = f"function({', '.join([given(kind) for kind in entry.takes])})"
    first, n = next(places), len(entry.returns)
    lines = [f"back = {call}"]
    lines += [f"numbers[{first + k}] = back{f'[{k}]' if entry.is_tuple else ''}" for k in range(n)]
    source = "def entry(words, numbers):\n " + "\n ".join([*lines, "return 0"]) + "\n"
    return Callback(entry.symbol, ("int64", "float64"), source, scope)


@cache
def pointer(kind: Any) -> Any:
    """Return what makes of an address, a whole number, a pointer of one of numba's types."""
    from numba import types
    from numba.extending import intrinsic

    @intrinsic
    def at(_typing: object, address: object) -> Any:
        def code(context: Any, builder: Any, _signature: object, values: Any) -> Any:
            return builder.inttoptr(values[0], context.get_value_type(kind))

        return kind(types.int64), code

    return at


def compiled(callback: Callback) -> Any:
    """Return numba's C callback around an entry."""
    import numba

    compiler: Any = numba  # its annotations lag behind it
    types = compiler.types
    kinds = [
        types.float64 if t == "float" else types.CPointer(getattr(types, t)) for t in callback.types
    ]
    scope = {"carray": compiler.carray, **callback.scope}
    scope |= {
        f"at_{item}": pointer(types.CPointer(getattr(types, item)))
        for item in ITEMS.values()
        if f"at_{item}(" in callback.source
    }
    exec(callback.source, scope)
    make = compiler.cfunc(types.int32(*kinds), error_model="numpy", boundscheck=False)
    return make(scope["entry"])


def function_name(made: Any) -> str:
    """Return the name of the compiled function inside a C callback."""
    name: str = made.native_name
    if not name.startswith("cfunc."):
        raise unknown_numba(f"a callback is named {name[:40]!r}, not 'cfunc.' and its function")
    return name.removeprefix("cfunc.")


def check_convention(text: str, name: str) -> None:
    """Stop unless a function is ``int32 f(result *, void **, arguments)``."""
    arguments = r"\(ptr [^\n]*%retptr, ptr [^\n]*%excinfo"
    if not re.search(rf'^define (?:[a-z_]+ )?i32 @"?{re.escape(name)}"?{arguments}', text, re.M):
        raise unknown_numba("a compiled function is not int32 f(result *, void **, arguments)")


def unknown_numba(what: str) -> EnvironmentProblem:
    """Return the error for a numba that is not built as expected."""
    import numba

    return EnvironmentProblem(
        f"numba {numba.__version__} is not known to the native build: {what}; "
        "install another one: 0.62 to 0.68 are known to work"
    )
