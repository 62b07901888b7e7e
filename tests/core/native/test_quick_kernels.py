"""Kernels that keep all speed are found by the name of their module in the compiler's names."""

import importlib
import inspect

import pytest

from thrustwasher.native.compiling.lower import is_quick
from thrustwasher.native.targets import PLATFORMS

LEVELS = {level.name: level for platform in PLATFORMS.values() for level in platform.levels}


@pytest.mark.parametrize("level", LEVELS.values(), ids=LEVELS)
def test_every_module_listed_as_quick_is_found_by_the_names_of_its_kernels(level):
    funcdesc = pytest.importorskip("numba.core.funcdesc")
    assert level.quick
    for name in level.quick:
        module = importlib.import_module(f"thrustwasher.{name}")
        kernels = [
            k for k in vars(module).values() if hasattr(k, "py_func") or inspect.isfunction(k)
        ]
        own = [k for k in kernels if k.__module__ == module.__name__]
        assert own
        for kernel in own:
            prefix = funcdesc.qualifying_prefix(module.__name__, kernel.__qualname__)
            assert is_quick(funcdesc.default_mangler(prefix, ()), level)
    assert not is_quick("_ZN12thrustwasher6washer7kernels9constants6deriveB2v1", level)
