"""Columns of a result as a dataset of xarray, on the grid of what was varied if they fill one."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .errors import EnvironmentProblem, Status

STATUS = "status"
INSTALL = 'pip install "thrustwasher[xarray]"'


def dataset_of(
    columns: Mapping[str, Any],
    words: Mapping[str, tuple[str, str]],
    axes: Sequence[str],
    title: str,
) -> Any:
    """Return an ``xarray.Dataset`` with ``units`` and ``long_name`` of every variable.

    ``words``: unit and meaning by name. Its dimensions are the axes, in their order, if every
    combination of their values is one row; else one, ``row``. The status is a number with
    ``flag_values`` and ``flag_meanings``.

    EnvironmentProblem: there is no xarray; the message says how to get it.
    """
    try:
        from xarray import Dataset
    except ImportError:
        raise EnvironmentProblem(f"to_xarray needs the package xarray: {INSTALL}") from None
    arrays = {name: np.asarray(column) for name, column in columns.items()}
    n = len(next(iter(arrays.values()), ()))
    values = [_in_order(arrays[name]) for name in axes]
    shape = tuple(map(len, values))
    dims: tuple[str, ...] = ("row",)
    order = np.arange(n)
    if axes and int(np.prod(shape)) == n:
        places = [_places(arrays[name], own) for name, own in zip(axes, values, strict=True)]
        flat = np.ravel_multi_index(places, shape)
        if len(np.unique(flat)) == n:
            dims, order = tuple(axes), np.argsort(flat)
    on_grid = dims != ("row",)
    shape = shape if on_grid else (n,)
    variables = {}
    for name, column in arrays.items():
        if on_grid and name in axes:
            continue
        column, flags = _flagged(name, column[order])
        variables[name] = dims, column.reshape(shape), _attributes(name, words) | flags
    coordinates = {
        name: (name, own, _attributes(name, words))
        for name, own in zip(axes, values, strict=True)
        if on_grid
    }
    return Dataset(variables, coordinates, {"title": title})


def _in_order(column: Any) -> Any:
    """Return the values of an axis in the order in which they first come."""
    values, first = np.unique(column, return_index=True)
    return values[np.argsort(first)]


def _places(column: Any, values: Any) -> Any:
    """Return the place of each row among the values of an axis."""
    order = np.argsort(values)
    return order[np.searchsorted(values[order], column)]


def _attributes(name: str, words: Mapping[str, tuple[str, str]]) -> dict[str, Any]:
    """Return unit and meaning of a variable."""
    unit, meaning = words.get(name, ("1", ""))
    return {"units": unit} | ({"long_name": meaning} if meaning else {})


def _flagged(name: str, column: Any) -> tuple[Any, dict[str, Any]]:
    """Return a column as files can hold it, and what its numbers mean: texts become numbers."""
    if name != STATUS:
        return (column.astype(str), {}) if column.dtype == object else (column, {})
    names = list(dict.fromkeys(column.tolist()))
    known = all(text in Status.__members__ for text in names)
    numbers = {text: int(Status[text]) if known else i for i, text in enumerate(names)}
    flags = {
        "flag_values": np.array(list(numbers.values()), np.int32),
        "flag_meanings": " ".join(text.replace(" ", "_") for text in names),
    }
    return np.array([numbers[text] for text in column.tolist()], np.int32), flags
