"""Kernels called from Python: compiled where a library has them, plain Python where not."""

import pickle
from pathlib import Path

import numpy as np
import pytest
from children import child
from numpy.typing import NDArray

from thrustwasher.errors import ParameterError
from thrustwasher.native import entries, load, signatures
from thrustwasher.native.digest import MAKERS
from thrustwasher.numerics import banded
from thrustwasher.numerics.jit import way
from thrustwasher.numerics.smoothing import sign_of
from thrustwasher.tribology import asperities, viscosity
from thrustwasher.washer.kernels.map import map_rows

pytestmark = pytest.mark.skipif(way() != "native", reason="kernels run another way here")


def words_of(code, **environment):
    return child(code, check=True, **environment).stdout.split()


SOLVES = """
import sys
from thrustwasher import *
solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002)
solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002, fidelity="map").error_estimate
load_curve(WasherParams(), speed=545.0, tilt=0.002, grid=(7, 16))
solve_clutch(ClutchParams(), load=9000.0, speed=5.0)
solve_gearmesh(GearMeshParams(), power=7500.0, speed=180.0)
print(*{name.partition(".")[0] for name in sys.modules})
"""


@pytest.mark.slow
def test_a_solve_imports_neither_compiler_nor_scipy():
    assert {"numba", "llvmlite", "scipy", "matplotlib", "fmpy"} & set(words_of(SOLVES)) == set()


def test_a_kernel_in_a_library_runs_as_compiled_code():
    native = load.native_function(viscosity.viscosity.py_func, None)
    given = (350.0, 6.3e-5, 3.5, 1.05)
    assert native.__code__.co_filename == "<string>"
    assert native(*given) == pytest.approx(viscosity.viscosity.py_func(*given), rel=1e-14)


def test_a_kernel_in_no_library_runs_as_python():
    assert load.native_function(sign_of.py_func, None) is None


def test_an_array_that_is_not_contiguous_goes_to_the_kernel_as_python():
    band, whole = np.array([4.0, 0.0, 9.0, 0.0]), np.zeros((4, 2))
    whole[:, 0] = band
    assert banded.cholesky(band, 2, 1) and banded.cholesky(whole[:, 0], 2, 1)
    assert whole[:, 0].tolist() == band.tolist()


def test_arrays_of_two_dimensions_are_known():
    entry = signatures.describe(map_rows.map_folds, ("folds",))
    assert [kind.ndim for kind in entry.takes if kind.name == "array"] == [1, 1, 2]


def test_what_comes_back_has_the_types_of_the_annotations():
    first, second = asperities.contact_pressure(3.0, np.linspace(0.0, 1.0, 4000))
    assert type(first) is float and type(second) is float


def test_a_kernel_is_found_by_name_in_another_process():
    assert pickle.loads(pickle.dumps(viscosity.viscosity)) is viscosity.viscosity


def test_a_bound_kernel_works_on_its_arrays():
    free, held = np.array([4.0, 0.0, 9.0, 0.0]), np.array([4.0, 0.0, 9.0, 0.0])
    assert banded.cholesky(free, 2, 1) and load.bound(banded.cholesky, a=held)(2, 1)
    assert held.tolist() == free.tolist() != [4.0, 0.0, 9.0, 0.0]


@pytest.mark.parametrize("library", entries.libraries())
def test_every_listed_function_is_there_and_described(library):
    found = signatures.entries(library)
    assert [e.symbol for e in found] and len(found) == len(entries.symbols(library))
    for entry in found:
        assert entries.library_of(entry.function.__module__, entry.function.__name__)


def test_an_unknown_way_is_refused_by_name():
    code = (
        "from thrustwasher.errors import EnvironmentProblem\n"
        "try:\n import thrustwasher.tribology.flow_factors\n"
        "except EnvironmentProblem as problem:\n print(problem)\n"
    )
    assert "THRUSTWASHER_KERNELS" in words_of(code, THRUSTWASHER_KERNELS="fast")


@pytest.mark.parametrize("annotation", [list[float], complex, np.ndarray, NDArray[np.float32]])
def test_an_annotation_that_no_compiled_function_has_is_named(annotation):
    def area(sides):
        return 0.0

    area.__annotations__ = {"sides": annotation, "return": float}
    with pytest.raises(ParameterError, match=r"area: sides is annotated .*Array \(float64\)"):
        signatures.describe(area, ())


def test_what_decides_digests_reads_no_annotations():
    source = Path(entries.__file__).read_text("utf-8")
    assert "entries.py" in MAKERS and "typing" not in source and "numpy" not in source
