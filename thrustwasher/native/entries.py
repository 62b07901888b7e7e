"""Which functions of the kernels can be called from Python, and the library each is in.

A model's library holds the entries of its step ABI for the FMU's shell, with arrays of fixed
length, and functions for Python, with the lengths as they are given (``signatures``). The head of
a model's package of kernels lists them: ``CALLED``, module of the library -> functions, those of a
module as "module: name name" or each by its full name. An array has one dimension unless it is
named behind that one function as having two.
"""

import importlib
from collections.abc import Mapping
from functools import cache

from ..model.registry import OTHERS, compiled_packages


@cache
def _called(package: str) -> Mapping[str, tuple[str, ...]]:
    """Return what the head of a package of kernels says Python calls."""
    try:
        found: Mapping[str, tuple[str, ...]] = importlib.import_module(package).CALLED
    except (ModuleNotFoundError, AttributeError):
        return {}
    return found


@cache
def called(library: str) -> tuple[tuple[str, str, tuple[str, ...]], ...]:
    """Return module, name and arrays of two dimensions of each function of a library for Python."""
    found: list[tuple[str, str, tuple[str, ...]]] = []
    package, lines = library, tuple[str, ...]()
    while "." in package and not lines:  # a package of kernels may have folders
        package = package.rpartition(".")[0]
        lines = _called(package).get(library, ())
    for line in lines:
        place, *rest = line.split()
        if place.endswith(":"):
            found += [(place[:-1], name, ()) for name in rest]
        else:
            module, _, name = place.rpartition(".")
            found.append((module, name, tuple(rest)))
    return tuple(found)


def libraries() -> list[str]:
    """Return all modules that a library is made of."""
    return [library for package in compiled_packages() for library in _called(package)]


@cache
def _found(module: str, name: str) -> tuple[str, tuple[str, ...]] | None:
    """Return the library that has a function, and the function's arrays of two dimensions."""
    for package in compiled_packages():
        if package in OTHERS and not module.startswith(package):
            continue
        for library in _called(package):
            for place, own, two in called(library):
                if (place, own) == (module, name):
                    return library, two
    return None


def library_of(module: str, name: str) -> str | None:
    """Return the module whose library has a function, None where none has it."""
    found = _found(module, name)
    return found[0] if found else None


def arrays_of_two(module: str, name: str) -> tuple[str, ...]:
    """Return which arguments of a function are arrays of two dimensions."""
    found = _found(module, name)
    return found[1] if found else ()


@cache
def symbols(library: str) -> tuple[str, ...]:
    """Return the names of a library's functions for Python, sorted: their order in its table."""
    return tuple(sorted(symbol_of(module, name) for module, name, _ in called(library)))


def called_modules(library: str) -> list[str]:
    """Return the modules whose functions are in a library because Python calls them."""
    return sorted({module for module, _, _ in called(library)})


def symbol_of(module: str, name: str) -> str:
    """Return the name a function has in its library, where no two modules have the same name."""
    return f"tw_call_{module.rpartition('.')[2]}_{name}"
