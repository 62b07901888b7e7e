"""Rows of a table as the text of a CSV file: numbers in full, as Python writes them."""

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

PLAIN = 1e-4, 1e10  # sizes between which pyarrow's text of a number differs by ".0" at most
SAMPLE = np.array([1e-4, 0.1, 2.5, -3.0, 0.0, -0.0, 1.0 / 3.0, 1e22, 1e-7, 9999999999.999998])


def text_of_rows(columns: Sequence[NDArray[Any]], *, many: bool = False) -> str:
    """Return the rows of columns of one length; cells of NaN are empty.

    ``many``: by pyarrow if it is installed, which takes a while to import: the same text sooner.
    """
    if many and (pa := _pyarrow()):
        return _by_arrow(pa, columns)
    return "\n".join(map(",".join, zip(*map(_cells, columns), strict=True))) + "\n"


def _cells(column: NDArray[Any]) -> list[str]:
    """Return the cells of a column; equal numbers, as on a grid, are made into text once."""
    if column.dtype.kind == "b":
        return ["true" if value else "false" for value in column.tolist()]
    if column.dtype.kind != "f":
        return [str(value) for value in column.tolist()]
    bits, where = np.unique(column.view(np.int64), return_inverse=True)
    if len(bits) > len(column) // 2:
        texts = list(map(repr, column.tolist()))
        return [text if text != "nan" else "" for text in texts] if "nan" in texts else texts
    cells = ["" if text == "nan" else text for text in map(repr, bits.view(np.float64).tolist())]
    found: list[str] = np.array(cells, object)[where].tolist()
    return found


def _by_arrow(pa: Any, columns: Sequence[NDArray[Any]]) -> str:
    """Return the rows as ``text_of_rows`` does."""
    cells = [_arrow_cells(pa, column) for column in columns]
    rows = _joined(pa, [_joined(pa, cells, ","), _strings(pa, [""])[0]], "\n")
    _, ends, data = rows.buffers()
    text: str = data[: int(np.frombuffer(ends, np.int32)[len(rows)])].to_pybytes().decode()
    return text


def _joined(pa: Any, cells: Sequence[Any], separator: str) -> Any:
    """Return texts row by row with a separator between them; null is empty."""
    between = _strings(pa, [separator])[0]  # a text as it is would import pandas
    return pa.compute.binary_join_element_wise(*cells, between, null_handling="replace")


def _arrow_cells(pa: Any, column: NDArray[Any]) -> Any:
    """Return the cells of a column as an array of pyarrow, null or empty for NaN."""
    if column.dtype.kind != "f":
        return _strings(pa, _cells(column))
    sizes, there = np.abs(column), ~np.isnan(column)
    others = ~((sizes >= PLAIN[0]) & (sizes < PLAIN[1]) | (sizes == 0.0)) & there
    if 2 * others.sum() > len(column):
        texts = map(repr, column.tolist())
        return _strings(pa, ["" if text == "nan" else text for text in texts])
    parts = np.packbits(there, bitorder="little"), np.ascontiguousarray(column, float)
    numbers = pa.Array.from_buffers(pa.float64(), len(column), [*map(pa.py_buffer, parts)])
    texts, whole = numbers.cast(pa.string()), column == np.rint(column)
    if whole.any():
        texts = pa.compute.if_else(
            _mask(pa, whole), _joined(pa, [texts, _strings(pa, ["0"])[0]], "."), texts
        )
    if others.any():
        known = _strings(pa, _cells(column[others]))
        texts = pa.compute.replace_with_mask(texts, _mask(pa, others), known)
    return texts


def _strings(pa: Any, texts: Sequence[str]) -> Any:
    """Return texts as an array of pyarrow, made of its bytes: others import pandas, of 50 MB."""
    words = [text.encode() for text in texts]
    ends = np.cumsum([0, *map(len, words)], dtype=np.int32)
    parts = map(pa.py_buffer, (ends, b"".join(words)))
    return pa.Array.from_buffers(pa.string(), len(words), [None, *parts])


def _mask(pa: Any, truths: NDArray[np.bool_]) -> Any:
    """Return truths as an array of pyarrow."""
    bits = pa.py_buffer(np.packbits(truths, bitorder="little"))
    return pa.Array.from_buffers(pa.bool_(), len(truths), [None, bits])


@cache
def _pyarrow() -> Any:
    """Return pyarrow; None if it is not installed, or writes numbers in another way."""
    try:
        import pyarrow as pa
        import pyarrow.compute
    except ImportError:
        return None
    columns = [SAMPLE, SAMPLE[::-1]]
    return pa if _by_arrow(pa, columns) == text_of_rows(columns) else None
