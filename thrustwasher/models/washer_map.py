"""A washer's map from Python: look-ups, rows of look-ups, folds."""

from __future__ import annotations

import math
import os
from dataclasses import fields
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import ParameterError, Status
from ..kernels import washer_map_layout as L
from ..kernels.washer_fields import Point
from ..kernels.washer_map import map_covers
from ..kernels.washer_map_rows import look_up_rows, map_folds, map_tilts, single_look_up
from ..kernels.washer_map_step import (
    HOT,
    MAP_BRANCH,
    MAP_RATIO,
    N_MAP_WORK,
    NOT_HERE,
    look_up,
)  # fmt: skip
from ..kernels.washer_memory import FIELDS
from ..kernels.washer_model import OK
from ..kernels.washer_outputs import N_ALL
from ..kernels.washer_verdict import LEAST_TILT
from ..store.maps import MapFile, find_map, read_map
from ._buffers import work_array
from ._params import as_numbers
from .washer_params import WasherParams
from .washer_result import WasherResult
from .washer_walker import Fold

Array = NDArray[np.float64]
BRANCHES = {None: 0.0, "film": 1.0, "contact": 3.0}
ERROR = 2e-3  # of friction_torque where no card says better
NAMES = {1: "film", 3: "contact"}
OUTPUTS = (
    "friction_torque", "temperature", "film_thickness", "temperature_max", "film_ratio",
    "fluid_load_share", "friction_coefficient", "friction_power", "fluid_load", "contact_load",
)  # fmt: skip

SHOWN = tuple(
    f.name for f in fields(WasherResult)
    if f.name in (*OUTPUTS, "washer_tilt_x", "washer_tilt_y")
)  # fmt: skip


class WasherMap:
    """All steady states of one washer in a box of load, speed, tilt and oil temperature.

    Parameters
    ----------
    params : the washer
    path : a file of ``thrustwasher map build``; without it the first map found for ``params``

    Raises
    ------
    ParameterError : no map was made for these parameters, or the file is none

    Examples
    --------
    >>> washer = WasherMap(WasherParams())
    >>> torque = washer.torque(load=300.0, speed=545.0, tilt=0.002, oil_temperature=297.15)
    >>> f"{torque:.4f} N m"
    '0.2052 N m'
    """

    def __init__(self, params: WasherParams, path: str | os.PathLike[str] | None = None) -> None:
        self.params, self.file = params, map_for(params, path)
        self.data, self.card = self.file.data, self.file.card
        self._work = np.zeros(N_MAP_WORK + N_ALL)

    @property
    def box(self) -> dict[str, tuple[float, float]]:
        """Ends of load [N], speed [rad/s], tilt [rad] and oil temperature [K]."""
        d, a = self.data, L.AXES
        low = d[L.BEND] * np.sinh(d[a])
        return {
            "load": (float(d[L.LOAD_MIN]), float(d[L.LOAD_MAX])),
            "speed": (0.0 if low <= L.FLOOR_SPEED else float(low), float(d[L.SPEED_MAX])),
            "tilt": (float(np.exp(d[a + 3])), float(np.exp(d[a + 4]))),
            "oil_temperature": (float(d[a + 6]), float(d[a + 7])),
        }

    def covers(self, *, load: float, speed: float, tilt: float, oil_temperature: float) -> bool:
        """Tell if a point lies in the box."""
        return bool(map_covers(self.data, Point(load, speed, tilt, oil_temperature)))

    def torque(
        self, load: float, speed: float, tilt: float, oil_temperature: float, branch: float = 0.0
    ) -> float:
        """Return the friction torque [N m], nan outside the box or where a branch is not.

        ``branch``: 0 film up to its fold, then contact; 1 film; 3 contact.
        """
        return float(
            single_look_up(self.data, self._work, load, speed, tilt, oil_temperature, branch)
        )

    def look_up(
        self, *, load: Any, speed: Any, tilt: Any, oil_temperature: Any, branch: str | None = None
    ) -> dict[str, Array]:
        """Return all outputs at many points.

        Parameters
        ----------
        load [N], speed [rad/s], tilt [rad], oil_temperature [K] : arrays that broadcast
        branch : "film" or "contact" where there are both; else film up to its fold, then contact

        Returns
        -------
        arrays of the common shape under the names of ``OUTPUTS``, ``branch`` (1 film, 3 contact,
        0 no such branch, -1 outside the box) and ``several`` (True where there are both); numbers
        are nan where ``branch`` is below 1
        """
        if branch not in BRANCHES:
            raise ParameterError(f"branch = {branch!r}, allowed: 'film' or 'contact'")
        inputs = np.broadcast_arrays(load, speed, tilt, oil_temperature)
        rows = np.column_stack([np.asarray(x, dtype=np.float64).ravel() for x in inputs])
        out = np.empty((len(rows), N_ALL))
        found = np.empty((len(rows), 2))
        look_up_rows(self.data, rows, BRANCHES[branch], self._work, out, found)
        shape = inputs[0].shape
        columns = {name: out[:, k].reshape(shape) for k, name in enumerate(OUTPUTS)}
        columns["branch"] = found[:, 0].reshape(shape)
        columns["several"] = (found[:, 1] == 2.0).reshape(shape)
        return columns

    def folds(self, *, speed: float, tilt: float, oil_temperature: float) -> list[Fold]:
        """Return the folds at a speed, tilt and oil temperature, as ``load_curve`` does.

        Folds outside the box's loads are found as far as the map's curve goes.

        Raises
        ------
        ParameterError : the point is outside the box
        """
        point = Point(self.box["load"][0], speed, tilt, oil_temperature)
        if not map_covers(self.data, point):
            raise ParameterError(
                f"speed = {speed:g} rad/s, tilt = {tilt:g} rad, oil_temperature = "
                f"{oil_temperature:g} K, allowed: inside the map's box {self.box}"
            )
        found = np.zeros((4, N_ALL + 2))
        count = int(map_folds(self.data, speed, tilt, oil_temperature, self._work,
                              found))  # fmt: skip
        kinds = ("film_lost", "film_regained")
        return [
            Fold(kinds[k % 2], float(row[N_ALL]), float(row[4]), float(row[1]), float(row[0]))
            for k, row in enumerate(found[:count])
        ]


def solve_by_map(
    params: WasherParams, point: tuple[float, float, float, float], wanted: float,
    start: WasherResult | None,
) -> WasherResult | None:  # fmt: skip
    """Return the state at a point by look-up, None where the map says nothing.

    ``wanted`` is 0, 1 (film) or 3 (contact); ``start`` an earlier result whose branch goes on.

    Raises
    ------
    ParameterError : there is no map for these parameters
    """
    washer = washer_map(params)
    w = work_array(("map",), N_MAP_WORK + N_ALL + 4)
    numbers, branch, tilts = w[N_MAP_WORK : N_MAP_WORK + N_ALL], w[-4:-2], w[-2:]
    state = np.zeros(FIELDS)
    if start is not None and start.params == params and start.branch in ("film", "contact"):
        state[MAP_BRANCH], state[MAP_RATIO] = BRANCHES[start.branch], start.film_ratio
    load, speed, tilt, oil = point
    if tilt <= LEAST_TILT:
        return None
    pt = Point(load, speed, tilt, oil)
    status = look_up(washer.data, pt, wanted, state, w, numbers, branch)
    if status == NOT_HERE:
        return None
    names = dict(zip(OUTPUTS, numbers.tolist(), strict=True))
    if status != OK:
        nothing = dict.fromkeys((*OUTPUTS, "washer_tilt_x", "washer_tilt_y"), math.nan)
        return _result(params, point, nothing, "film", False, Status(status), state)
    map_tilts(washer.data, w, tilts)
    state[MAP_BRANCH], state[MAP_RATIO] = branch[0], names["film_ratio"]
    hot = names["temperature"] - oil > HOT
    lost = branch[0] == BRANCHES["contact"] and branch[1] == 2.0
    found = {**names, "washer_tilt_x": tilt * float(tilts[0]),
             "washer_tilt_y": tilt * float(tilts[1])}  # fmt: skip
    return _result(params, point, found, NAMES[int(branch[0])], bool(hot or lost), Status.OK, state)


def _result(
    params: WasherParams, point: tuple[float, float, float, float], found: dict[str, float],
    branch: str, distress: bool, status: Status, state: Array,
) -> WasherResult:  # fmt: skip
    load, speed, tilt, oil = point
    return WasherResult(
        **{name: found[name] for name in SHOWN},
        branch=branch, distress=distress, status=status, iterations=0, fidelity="map",
        grid=(0, 0), error_estimate=ERROR, load=load, speed=speed, tilt=tilt, oil_temperature=oil,
        params=params, _state=state,
    )  # fmt: skip


def map_for(params: WasherParams, path: str | os.PathLike[str] | None = None) -> MapFile:
    """Return the map file for parameters, or say how to make one."""
    numbers = as_numbers(params)
    if path is not None:
        file = read_map(path)
        if not file.made_for(numbers):
            raise ParameterError(f"map = {str(path)!r} was made for other parameters")
        return file
    found = find_map(numbers)
    if found is None:
        raise ParameterError(
            "fidelity = 'map': no map was made for these parameters; make one with "
            "`thrustwasher map build`, or use fidelity 'field'"
        )
    return found


@lru_cache(maxsize=8)
def washer_map(params: WasherParams) -> WasherMap:
    """Return the map of a washer, read once; see ``WasherMap``."""
    return WasherMap(params)


def map_data(params: WasherParams) -> Array:
    """Return the map of a washer as the kernels take it; ParameterError if there is none."""
    return map_for(params).data
