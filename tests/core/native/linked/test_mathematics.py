"""The mathematical functions inside the libraries: exact as the C library's, the same anywhere."""

import ctypes
import math
from pathlib import Path

import needed
import numpy as np
import pytest

from thrustwasher.native import binaries, link, mathematics
from thrustwasher.native.targets import PLATFORMS

ULPS = 3  # from the C library's, which is off by 1 at most
NEAR = (-1.0, 1.0)
ONE = {
    **dict.fromkeys(("exp", "sinh", "cosh"), (-700.0, 700.0)),
    **dict.fromkeys(("log", "log2", "log10"), (1e-9, 1e9)),
    **dict.fromkeys(("sin", "cos", "tan"), (-1e7, 1e7)),
    **dict.fromkeys(("asin", "acos"), NEAR),
    **dict.fromkeys(("atan", "asinh", "tanh", "erf", "ceil", "floor"), (-20.0, 20.0)),
    "sqrt": (0.0, 1e9),
    **{"expm1": (-5.0, 100.0), "log1p": (-0.9, 100.0), "erfc": (-5.0, 26.0)},
}
TWO = ("pow", "atan2", "hypot", "fmod")
linux = pytest.mark.skipif(
    link.local_machine() != ("Linux", "x86_64"), reason="loads a library of Linux on x86-64"
)


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    """All of them, under other names and for all to see."""
    needed.linker()
    names = [*ONE, *TWO]
    files = dict(mathematics.sources(names))
    shown = "".join(
        f"SHOWN double my_{name}({a}) {{ return {name}({b}); }}\n"
        for names, a, b in ((ONE, "double x", "x"), (TWO, "double x, double y", "x, y"))
        for name in names
    )
    head = '#include "libm.h"\n#define SHOWN __attribute__((visibility("default")))\n'
    files["shown.c"] = (head + shown).encode()
    path = tmp_path_factory.mktemp("mathematics") / "mathematics.so"
    linker, platform = link.local_linker(), PLATFORMS["linux64"]
    path.write_bytes(link.shared_library(files, platform=platform, name="m", linker=linker))
    return ctypes.CDLL(str(path))


def called(library, name, *arguments):
    function = getattr(library, f"my_{name}")
    function.restype, function.argtypes = ctypes.c_double, [ctypes.c_double] * len(arguments)
    return [function(*row) for row in zip(*arguments, strict=True)]


@linux
@pytest.mark.parametrize("name", [*ONE, *TWO])
def test_each_is_within_3_ulps_of_the_c_librarys(library, name):
    rng = np.random.default_rng(3)
    if name in ONE:
        given = [rng.uniform(*ONE[name], 3000).tolist()]
    else:
        given = [rng.uniform(0.0, 20.0, 3000).tolist(), rng.uniform(0.1, 5.0, 3000).tolist()]
    function = getattr(math, name)
    for found, *row in zip(called(library, name, *given), *given, strict=True):
        wanted = function(*row)
        assert abs(found - wanted) <= ULPS * math.ulp(wanted), (name, row)


@linux
def test_at_the_ends_they_answer_as_the_standard_says(library):
    inf, nan = math.inf, math.nan
    rows = [
        ("exp", [inf, -inf, 1000.0, -1000.0, 0.0], [inf, 0.0, inf, 0.0, 1.0]),
        ("log", [0.0, inf, 1.0, -1.0], [-inf, inf, 0.0, nan]),
        ("tanh", [inf, -inf, 0.0], [1.0, -1.0, 0.0]),
        ("asin", [1.0, -1.0, 1.5], [math.asin(1.0), -math.asin(1.0), nan]),
        ("sin", [0.0, inf, nan], [0.0, nan, nan]),
    ]
    for name, given, wanted in rows:
        np.testing.assert_array_equal(called(library, name, given), wanted)
    np.testing.assert_array_equal(
        called(library, "pow", [0.0, -8.0, 2.0, -2.0], [0.0, 1 / 3, 2000.0, 3.0]),
        [1.0, nan, inf, -8.0],
    )


def test_a_function_comes_with_all_that_it_calls_and_nothing_else():
    assert mathematics.sources(["memset", "calloc"]) == {}
    code = {n for n in mathematics.sources(["tanh"]) if n.endswith(".c")}
    assert code == {"tanh.c", "expm1.c"}
    code = {n for n in mathematics.sources(["cos"]) if n.endswith(".c")}
    assert {"__rem_pio2_large.c", "scalbn.c", "floor.c"} <= code and "exp.c" not in code


@linux
def test_none_of_them_is_shown_by_a_library(library):
    found = binaries.read(Path(library._name).read_bytes())
    assert found.exports == {f"my_{name}" for name in (*ONE, *TWO)}
    assert not found.imports & mathematics.defined().keys()
