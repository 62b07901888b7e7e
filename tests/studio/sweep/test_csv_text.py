"""Text of many rows by pyarrow against Python's own of each number."""

import numpy as np
import pytest

from thrustwasher.studio.sweep.csv_text import text_of_rows

pytest.importorskip("pyarrow")
EDGES = [1e-4, 1e10, 2.0**-10, 2.0**33, 5e-324, np.inf, -0.0, np.nan, 9999999999.999998]


@pytest.mark.parametrize("low, high", [(-320, 308), (-6, 12), (-4, 10), (-9, -5)])
def test_pyarrow_writes_each_number_as_python_does(low, high):
    draw = np.random.default_rng(1)
    sizes = 10.0 ** draw.uniform(low, high, 5000)
    mixed = np.where(draw.random(5000) < 0.2, np.rint(sizes), -sizes)
    numbers = np.concatenate([EDGES, np.nextafter(EDGES, 0.0), mixed])
    words = np.array(["Öl" if x > 0.0 else "none" for x in numbers], object)
    columns = [numbers, words, numbers > 0.0, numbers[::-1], np.full(len(numbers), np.nan)]
    assert text_of_rows(columns, many=True) == text_of_rows(columns)
    assert text_of_rows(columns, many=True).startswith("0.0001,Öl,true,")
