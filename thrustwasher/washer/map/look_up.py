"""A washer's map from Python: look-ups, rows of look-ups, folds."""

import math
import os
import threading
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from ...errors import ParameterError, Status
from ...model.parameters import as_numbers
from ...model.prepare import Recent
from ...native.load import bound
from ...numerics.jit import Array
from ..kernel_arguments import NO_MESH
from ..kernels import layout as L
from ..kernels.map import map_layout as M
from ..kernels.map.map_rows import look_up_rows, map_folds, map_tilts, single_look_up
from ..kernels.map.map_search import map_covers
from ..kernels.map.map_step import N_MAP_WORK, NOT_HERE, look_up
from ..kernels.regime_and_status import LARGEST_RISE, LEAST_TILT
from ..kernels.workspace import Point
from ..parameters import SPEC, WasherParams
from ..washer_result import (
    BRANCH_NAMES,
    BRANCHES,
    FROM_TABLES,
    Fold,
    Inputs,
    WasherResult,
    result_of,
)
from . import map_file
from .map_plan import INPUTS

OUTPUTS = (*SPEC.real_outputs[: L.O_ENERGY], "fluid_load", "contact_load")
PLACES = (*range(L.O_ENERGY), L.O_FLUID_LOAD, L.O_CONTACT_LOAD)  # of them
NEARLY_FLAT = 0.03  # largest d ln(load)/d(film ratio), about 0 where folds begin
BEYOND_FOLD = 1.05  # of the load at a fold: from there on a mesh has lost its film too
NOTHING = (math.nan,) * L.N_ALL
OUTSIDE = {  # outside_map -> what became of points there
    "solve": "were solved by 'field', with its accuracy and time",
    "hold": "have the answer of the box's nearest point (outside_map = 'hold')",
    "refuse": "have no answer (outside_map = 'refuse')",
}
OF_BOX = (
    "fidelity = 'map': {outside} of {points} {what} are outside the map's box or without tilt and "
    "{then}; build a map for a larger box, or choose 'field'"
)
HELD = (
    "answered by the nearest point of the box (outside_map = 'hold'); build a map for a larger "
    "box, or set outside_map = 'solve'"
)


class _Memory(threading.local):
    """What looking up in a map writes to: each thread has its own."""

    def __init__(self, data: Array) -> None:
        self.data, self.work = data, np.zeros(N_MAP_WORK + L.N_ALL)
        self.torque = bound(single_look_up, data=data, w=self.work)

    def __reduce__(self) -> tuple[Any, ...]:
        """Let a copy have its own."""
        return _Memory, (self.data,)


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
    '0.2158 N m'
    """

    def __init__(self, params: WasherParams, path: str | os.PathLike[str] | None = None) -> None:
        self.params, self.file = params, map_for(params, path)
        self.data, self.metadata = self.file.data, self.file.metadata
        self._own = _Memory(self.data)

    @property
    def box(self) -> dict[str, tuple[float, float]]:
        """Ends of load [N], speed [rad/s], tilt [rad] and oil temperature [K]."""
        ends = self.data[M.BOX : M.BOX + 2 * len(INPUTS)].tolist()
        return {name: (ends[2 * k], ends[2 * k + 1]) for k, name in enumerate(INPUTS)}

    def covers(self, *, load: float, speed: float, tilt: float, oil_temperature: float) -> bool:
        """Tell if a point lies in the box."""
        return bool(map_covers(self.data, Point(load, speed, tilt, oil_temperature, 0.0)))

    def torque(
        self, load: float, speed: float, tilt: float, oil_temperature: float, branch: float = 0.0
    ) -> float:
        """Return the friction torque [N m], nan outside the box or where a branch is not.

        ``branch``: 0 film up to its fold, then contact; 1 film; 3 contact.
        """
        torque: float = self._own.torque(load, speed, tilt, oil_temperature, branch)
        return torque

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
        if branch is not None and branch not in BRANCHES:
            raise ParameterError(f"branch = {branch!r}, allowed: 'film' or 'contact'")
        required = L.ANY if branch is None else BRANCHES[branch]
        inputs = np.broadcast_arrays(load, speed, tilt, oil_temperature)
        rows = np.column_stack([np.asarray(x, dtype=np.float64).ravel() for x in inputs])
        out = np.empty((len(rows), L.N_ALL))
        found = np.empty((len(rows), 2))
        look_up_rows(self.data, rows, required, self._own.work, out, found)
        shape = inputs[0].shape
        columns = {n: out[:, k].reshape(shape) for n, k in zip(OUTPUTS, PLACES, strict=True)}
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
        point = Point(self.box["load"][0], speed, tilt, oil_temperature, 0.0)
        if not map_covers(self.data, point):
            raise ParameterError(
                f"speed = {speed:g} rad/s, tilt = {tilt:g} rad, oil_temperature = "
                f"{oil_temperature:g} K, allowed: inside the map's box {self.box}"
            )
        found = np.zeros((4, L.N_ALL + 2))
        count = int(map_folds(self.data, speed, tilt, oil_temperature, self._own.work, found))
        kinds = ("film_lost", "film_regained")
        return [
            Fold(kinds[k % 2], row[L.N_ALL], row[L.O_RATIO], row[L.O_MEAN], row[L.O_TORQUE])
            for k, row in enumerate(found[:count].tolist())
        ]


class _Solver:
    """A washer's map, ready to be looked up again: memory and the kernels."""

    def __init__(self, params: WasherParams, _maps: object) -> None:
        file = map_for(params)
        data, self.path, self.stamp = file.data, str(file.path), map_file.stamp_of(file.path)
        self.work, self.state = np.zeros(N_MAP_WORK), np.zeros(L.S_FIELDS)
        self.numbers, self.branch, self.tilts = np.zeros(L.N_ALL), np.zeros(2), np.zeros(2)
        self.look_up_in = data
        self.look_up = bound(
            look_up, data=data, state=self.state, w=self.work, out=self.numbers, branch=self.branch
        )
        self.covers = bound(map_covers, data=data)
        self.tilt = bound(map_tilts, data=data, w=self.work, tilts=self.tilts)
        self.found = np.zeros((4, L.N_ALL + 2))
        self.folds = bound(map_folds, data=data, w=self.work, folds=self.found)

    def guess(self, point: Inputs, required: float, state: Array) -> None:
        """Write to ``state`` where the washer is, for a solve on a mesh; not where it may err.

        It may where the map ends, next to folds and next to where they begin.
        """
        self.state[L.S_MAP_BRANCH] = 0.0
        if self.look_up(Point(*point), required) != Status.OK:
            return
        branch, several = self.branch.tolist()
        if abs(self.work[M.STEEP]) < NEARLY_FLAT:  # nan without contact
            return
        self.tilt()
        if several == 2.0 and branch == L.CONTACT_BRANCH and required == L.ANY:
            count = int(self.folds(*point[1:4]))
            if not count or point[0] < BEYOND_FOLD * self.found[:count:2, L.N_ALL].max():
                return
        numbers = self.numbers.tolist()
        state[L.S_VALID], state[L.S_BRANCH] = L.GUESSED, branch
        state[L.S_MULTIPLICITY] = L.MULTIPLE if several == 2.0 else L.SINGLE
        state[L.S_RATIO] = numbers[L.O_RATIO]
        state[L.S_POSITIONS + L.TILT_X : L.S_POSITIONS + L.TILT_Y + 1] = point[2] * self.tilts
        state[L.S_FIELDS] = numbers[L.O_FILM_TEMPERATURE] - point[3]
        state[L.S_FIELDS + 1] = numbers[L.O_MEAN] - point[3]


_known = Recent(_Solver)


def _solver_if_any(params: WasherParams, maps: object) -> _Solver | None:
    with suppress(ParameterError):
        return _known(params, maps)
    return None


_known_if_any = Recent(lambda params, maps: (_solver_if_any(params, maps),))


def guess_by_map(params: WasherParams, point: Inputs, required: float, state: Array) -> None:
    """Write to ``state`` where a map says that the washer is; nothing without a map.

    A solve on a mesh starts there in place of from nothing, and finds out if it is right.
    """
    (solver,) = _known_if_any(params, map_file.state_of_maps())
    if solver is not None and params.gear_far_face != "bulk":
        solver.guess(point, required, state)


def _solver(params: WasherParams) -> _Solver:
    """Return what looks up in the map that is found now: folders and file may have changed."""
    state = map_file.state_of_maps()
    solver = _known(params, state)
    if solver.stamp == map_file.stamp_of(solver.path):
        return solver
    _known.forget()  # written anew in its place
    return _known(params, state)


def solve_by_map(
    params: WasherParams, point: Inputs, required: float, start: WasherResult | None
) -> WasherResult | None:
    """Return the state at a point by look-up, None where the map says nothing.

    ``required`` is 0, 1 (film) or 3 (contact); ``start`` an earlier result whose branch goes on.
    With ``outside_map = "hold"`` a point outside the box has the answer of the nearest one in it.
    ParameterError: there is no map for these parameters, or it is left with ``"refuse"``.
    """
    if params.gear_far_face == "bulk":
        raise ParameterError(
            "fidelity = 'map' with gear_far_face = 'bulk', allowed: 'oil' or 'insulated'; a map "
            "has no far_face_temperature: use fidelity 'field'"
        )
    solver, state = _solver(params), np.zeros(L.S_FIELDS)
    there = Point(*point)
    beyond = "" if solver.covers(there) else words_of_outside(solver.look_up_in, point)
    if beyond and params.outside_map == "refuse":
        raise ParameterError(
            f"{beyond}: fidelity = 'map' with outside_map = 'refuse'; keep to the box, build a map "
            "for a larger one, or set outside_map = 'hold' or 'solve'"
        )
    if beyond and params.outside_map == "solve":
        return None
    place = Point(*_nearest(solver.look_up_in, point)) if beyond else there
    before, ratio = 0.0, 0.0
    if start is not None and start.branch in BRANCHES:
        if start.params is params or start.params == params:
            before, ratio = BRANCHES[start.branch], start.film_ratio
    solver.state[L.S_MAP_BRANCH], solver.state[L.S_MAP_RATIO] = before, ratio
    status = solver.look_up(place, required)
    if status == NOT_HERE:
        if params.outside_map == "solve":
            return None
        status = Status.NOT_IN_MAP
    numbers: Sequence[float] = NOTHING
    tilts, name, lost = NOTHING[:2], "film", False
    if status == Status.OK:
        solver.tilt()
        numbers, (branch, several) = solver.numbers.tolist(), solver.branch.tolist()
        tilts = tuple(place[2] * turn for turn in solver.tilts.tolist())
        before, ratio, name = branch, numbers[L.O_RATIO], BRANCH_NAMES[branch]
        lost = numbers[L.O_MEAN] - place[3] > LARGEST_RISE
        lost = lost or (branch == L.CONTACT_BRANCH and several == 2.0)
        if beyond:
            numbers = _at_given_speed(numbers, point[1])
    state[L.S_MAP_BRANCH], state[L.S_MAP_RATIO] = before, ratio
    found = result_of(
        params,
        point,
        numbers,
        tilts,
        name,
        lost,
        Status(status),
        0,
        "map",
        NO_MESH,
        FROM_TABLES,
        state,
    )
    return told_outside(found, f"{beyond}: {HELD}") if beyond else found


def _nearest(data: Array, point: Inputs) -> Inputs:
    """Return the point of the box that is nearest, as the kernel's ``nearest``."""
    ends = data[M.BOX : M.BOX + 2 * len(INPUTS)].tolist()
    at = [min(max(abs(x), a), b) for x, a, b in zip(point, ends[::2], ends[1::2], strict=False)]
    return at[0], math.copysign(at[1], point[1]), at[2], at[3], at[3]


def _at_given_speed(numbers: Sequence[float], speed: float) -> Sequence[float]:
    """Return outputs whose torque resists this speed, with its power."""
    own = list(numbers)
    own[L.O_TORQUE] = abs(own[L.O_TORQUE]) * (np.sign(speed) if speed else 0.0)
    own[L.O_POWER] = own[L.O_OIL_HEAT] = own[L.O_TORQUE] * speed
    return own


def words_of_outside(data: Array, point: Inputs) -> str:
    """Return in words which inputs lie outside the box of a map's data; empty where none does."""
    if map_covers(data, Point(*point)):
        return ""
    ends = data[M.BOX : M.BOX + 2 * len(INPUTS)].tolist()
    units = {s.name: s.unit for s in SPEC.inputs}
    beyond = [
        f"{name} = {x:g} {units[name]} is outside the map's box, {a:g} .. {b:g} {units[name]}"
        for name, x, a, b in zip(INPUTS, point, ends[::2], ends[1::2], strict=False)
        if not a * (1.0 - 1e-9) <= abs(x) <= b * (1.0 + 1e-9)
    ]
    return "; ".join(beyond) or "the point lies at an end of the map's box"


def told_outside(found: WasherResult, words: str) -> WasherResult:
    """Return a result that says, in status and warnings, that it lies outside its map."""
    status = found.status
    if status in (Status.OK, Status.OUTSIDE_VERIFIED):
        status = Status.OUTSIDE_MAP
    return replace(found, status=status, warnings=(words, *found.warnings))


def outside_text(
    params: WasherParams, columns: Sequence[Array], what: str, most: float = 0.0
) -> str:
    """Return a warning if more than a share of points lie outside the map, and what happens there.

    ``columns`` (n,): load [N], speed [rad/s], tilt [rad] and oil temperature [K].
    """
    box = WasherMap(params).box
    outside = np.abs(columns[2]) <= LEAST_TILT
    for column, (low, high) in zip(columns, box.values(), strict=False):
        there = np.abs(column)
        outside |= (there < low * (1.0 - 1e-9)) | (there > high * (1.0 + 1e-9))
    if np.mean(outside) <= most:
        return ""
    return OF_BOX.format(
        outside=outside.sum(), points=len(outside), what=what, then=OUTSIDE[params.outside_map]
    )


def map_for(params: WasherParams, path: str | os.PathLike[str] | None = None) -> map_file.MapFile:
    """Return the map file for parameters, or say how to make one."""
    numbers = as_numbers(params)
    if path is not None:
        file = map_file.read_map(path)
        if not file.made_for(numbers):
            raise ParameterError(f"map = {str(path)!r} was made for other parameters")
        return file
    found = map_file.find_map(numbers)
    if found is None:
        raise ParameterError(
            "fidelity = 'map': no map was made for these parameters; make one with "
            "`thrustwasher map build`, or use fidelity 'field'"
        )
    return found
