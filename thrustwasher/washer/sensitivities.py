"""Derivatives of a washer's results and of its fold loads over its parameters."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from ..errors import ParameterError, SolveError, Status
from ..model.parameters import as_numbers
from ..model.sensitivity import Varied, varied_parameters, wanted_outputs
from ..numerics.jit import Array
from .kernel_arguments import constants, work_array
from .kernels import continuation
from .kernels import layout as L
from .kernels import parameter_derivative as k
from .kernels.constants import derive_grid, washer_model
from .kernels.gap import face_area
from .kernels.heat import set_steady
from .kernels.newton import FILM, LOAD, NO_FLOOR, newton, smooth_film
from .kernels.outputs import outputs_at
from .kernels.regime_and_status import broken_rule, point_of
from .kernels.workspace import fields_of, size_of_work, workspace_of
from .parameters import WasherParams

TOLERANCE = 1e-10  # of the solution that is differentiated
N_CHANGES = L.N_ALL + 3
PLACES = {  # of a result's numbers among the outputs of the kernels
    "friction_torque": L.O_TORQUE,
    "temperature": L.O_MEAN,
    "temperature_max": L.O_PEAK,
    "film_thickness": L.O_FILM,
    "film_ratio": L.O_RATIO,
    "fluid_load": L.O_FLUID_LOAD,
    "contact_load": L.O_CONTACT_LOAD,
    "friction_coefficient": L.O_COEFFICIENT,
    "friction_power": L.O_POWER,
    "oil_flow": L.O_OIL_FLOW,
    "throughflow_heat": L.O_THROUGHFLOW_HEAT,
    "oil_heat": L.O_OIL_HEAT,
    "oil_outlet_temperature": L.O_OUTLET,
    "film_temperature": L.O_FILM_TEMPERATURE,
    "stick_margin": L.O_STICK_MARGIN,
}
OUTPUTS = {**PLACES, "washer_tilt_x": L.N_ALL + 1, "washer_tilt_y": L.N_ALL + 2}
LIMITS = {
    "friction_pressure_min": L.P_FRICTION_PRESSURE_MIN,
    "friction_pressure_max": L.P_FRICTION_PRESSURE_MAX,
}
NEAR = 1e-3  # of a limit: at it
ASIDE = 1e-3  # [sigma] of film thickness, next to a corner
SEARCH = 1e-3  # [sigma] first step towards a fold
MOST_STEPS = 12
FLAT = 1e-7  # of the load per sigma of film thickness: an extremum
IN_CONSTANTS = range(L.P_CARRIER_THICKNESS, L.P_GEAR_THICKNESS + 1)  # neither mesh nor contacts


class Solved(NamedTuple):
    """A solution on a mesh."""

    params: WasherParams
    grid: tuple[int, int]
    point: tuple[float, ...]  # the inputs
    state: Array


class Linearised:
    """A solution on a mesh, and how it follows its parameters."""

    def __init__(
        self, params: WasherParams, grid: tuple[int, int], point: tuple[float, ...], state: Array
    ) -> None:
        """Take a kept solution at a point."""
        self.grid, self.par = grid, constants(params, grid)
        work = work_array(("derivative", grid), L.N_HEAD + size_of_work(*grid))
        self.w = workspace_of(self.par, work)
        self.f = fields_of(self.w)
        self.take(state)
        self.pt = point_of(self.par, np.array(point))
        set_steady(washer_model(self.par), self.pt, self.f)

    def take(self, state: Array) -> None:
        """Go to a kept solution."""
        pressure = L.S_FIELDS + self.f.temp.size
        self.f.temp[:], self.f.p[:] = (
            state[L.S_FIELDS : pressure],
            state[pressure:][: self.f.p.size],
        )
        self.w.q[:] = state[L.S_POSITIONS :][:4]
        self.f.tag[L.TAG_VALID] = 0.0

    def settle(self) -> None:
        """Solve to ``TOLERANCE``."""
        pt = self.pt
        self._check(newton(self.w, pt, LOAD, pt.load, NO_FLOOR, TOLERANCE, 20.0))

    def changes(self, mode: float, varied: list[Varied]) -> Array:
        """Return (parameters, N_CHANGES), the derivatives of what `follow_parameter` lists."""
        found = np.zeros((len(varied), N_CHANGES))
        forces, heat = np.zeros((len(varied), 4)), np.zeros((len(varied), self.f.temp.size))
        now, warm = np.zeros(4), np.zeros(self.f.temp.size)
        for n, v in enumerate(varied):
            if v.place >= L.N_STEADY:
                continue  # of time
            for offset, weight in v.points:
                w = self.w._replace(par=self._constants(v, offset))
                if not k.residuals_here(w, self.pt, now, warm):
                    raise SolveError(f"washer: {v.name} = {v.value + offset!r}: not finite")
                forces[n] += weight * now
                heat[n] += weight * warm
                found[n, : L.N_ALL] += weight * self.w.outputs
        self._check(k.factor_for_parameters(self.w, self.pt, mode))
        change = np.zeros(N_CHANGES)
        for n, v in enumerate(varied):
            if v.place >= L.N_STEADY:
                continue
            code = k.follow_parameter(self.w, self.pt, mode, 0.0, forces[n], heat[n], change)
            self._check(code)
            found[n] += change
        return found

    def torque_over_load(self) -> float:
        """Return the slope of the torque over the load [N m/N]."""
        forces, change = np.zeros(4), np.zeros(N_CHANGES)
        forces[L.ON_GEAR] = -1.0  # what the gear carries, less the load
        self._check(k.factor_for_parameters(self.w, self.pt, LOAD))
        heat = np.zeros(self.f.temp.size)
        self._check(k.follow_parameter(self.w, self.pt, LOAD, 0.0, forces, heat, change))
        return float(change[L.O_TORQUE])

    def to_film(self, film: float) -> None:
        """Solve at a smoothed film thickness [m] near this one."""
        self._check(newton(self.w, self.pt, FILM, film, NO_FLOOR, TOLERANCE, 20.0))
        self.pt = self.pt._replace(load=float(self.w.info[L.REACHED_LOAD]))

    def tangent(self) -> Array:
        """Return (N_CHANGES,), the derivatives over the film thickness [1/m] at given parameters.

        `changes` has been called with the film held.
        """
        change, still = np.zeros(N_CHANGES), np.zeros(4 + self.f.temp.size)
        sigma = self.par[L.D_SIGMA1]
        self._check(k.follow_parameter(self.w, self.pt, FILM, sigma, still[:4], still[4:], change))
        return np.asarray(change / sigma)

    def _constants(self, v: Varied, offset: float) -> Array:
        par = self.par.copy()
        par[v.place] += offset
        if v.place < L.P_CONDUCTIVITY and v.place not in IN_CONSTANTS:
            derive_grid(par, *self.grid)
            if par[L.D_GEAR_NODE] != self.par[L.D_GEAR_NODE]:
                raise ParameterError(f"{v.name} = {v.value!r}: the mesh changes there")
        return par

    def _check(self, code: int) -> None:
        if code:
            raise SolveError(f"washer, derivatives over parameters: {Status(code).advice}")


def free_parameters(params: WasherParams, wanted: Collection[str] | None) -> list[Varied]:
    """Return the parameters that no rule holds where they are; of wanted ones, raise what does."""
    numbers, found = np.array(as_numbers(params), float), []
    for v in varied_parameters(params, wanted):
        changed = numbers.copy()
        changed[v.place] += v.points[0][0] or v.points[1][0]
        if not broken_rule(changed):
            found.append(v)
        elif wanted is not None:
            value: Any = float(changed[v.place])
            replace(params, **{v.name: value})
    return found


def parameter_derivatives(
    solved: Solved, outputs: Collection[str] | None, parameters: Collection[str] | None
) -> dict[str, dict[str, float]]:
    """Return {output: {parameter: derivative}}, SI, at a solution."""
    names = wanted_outputs(outputs, list(OUTPUTS))
    varied = free_parameters(solved.params, parameters)
    here = Linearised(*solved)
    here.settle()
    found = here.changes(LOAD, varied)
    found[:, L.O_FLUID_LOAD] = -found[:, L.O_CONTACT_LOAD]  # both carry the load; without rounding
    return {
        name: dict(zip((v.name for v in varied), found[:, OUTPUTS[name]].tolist(), strict=True))
        for name in names
    }


def fold_derivatives(
    start: Solved, below: Solved, parameters: Collection[str] | None
) -> dict[str, float] | None:
    """Return {parameter: derivative} of a fold's load [N]; None if its slope does not show it.

    The fold lies between two solutions.

    The load has an extremum over the film thickness there: with that held it moves as the fold.
    Where dry friction is held beyond the pressures of its data the load over film thickness has a
    corner, which may be the extremum: it stays where the mean contact pressure is that limit.
    """
    varied = free_parameters(start.params, parameters)
    here = Linearised(*start)
    w = here.w
    w.curve[L.ACCURACY] = TOLERANCE
    ends = []
    for p in (start, below):
        here.take(p.state)
        ends.append(smooth_film(w))
    here.take(start.state)
    w.curve[L.AT_FILM] = ends[0]
    if continuation.find_fold(w, here.pt, *ends):
        return None
    limit = _limit_met(here)
    if limit:
        found = _at_corner(here, varied, limit)
    elif _go_to_fold(here):
        found = here.changes(FILM, varied)[:, L.N_ALL]
    else:
        return None
    return dict(zip((v.name for v in varied), found.tolist(), strict=True))


def _go_to_fold(here: Linearised) -> bool:
    """Move to where the load has no slope over the film thickness; return True if it is found."""
    sigma = here.par[L.D_SIGMA1]
    step, before = SEARCH * sigma, 0.0
    for attempt in range(MOST_STEPS):
        here.to_film(smooth_film(here.w) + (step if attempt else 0.0))
        here.changes(FILM, [])
        slope = float(here.tangent()[L.N_ALL])
        if abs(slope) * sigma < FLAT * here.pt.load:
            return True
        if attempt:
            if slope == before:
                return False
            step *= slope / (before - slope)
        before = slope
    return False


def _limit_met(here: Linearised) -> str:
    """Return the name of the pressure at the end of the data of dry friction that is met, or ""."""
    outputs_at(here.w, here.pt)
    pressure = here.w.outputs[L.O_CONTACT_LOAD] / face_area(here.par)
    if here.par[L.P_FRICTION_LAW] != L.CONSTANT_FRICTION:
        for name, place in LIMITS.items():
            if abs(pressure - here.par[place]) < NEAR * pressure:
                return name
    return ""


def _at_corner(here: Linearised, varied: list[Varied], limit: str) -> Array:
    """Return the derivatives of the load where the mean contact pressure is at a limit.

    From two places next to it, for differences must not reach across the corner.
    """
    w, par = here.w, here.par
    face, wanted = face_area(par), float(par[LIMITS[limit]])
    start, places, slopes = smooth_film(w), [], []
    for film in (start + ASIDE * par[L.D_SIGMA1], start + 2.0 * ASIDE * par[L.D_SIGMA1]):
        here.to_film(film)
        found = here.changes(FILM, varied)
        along, contact = here.tangent(), float(w.outputs[L.O_CONTACT_LOAD])
        excess = found[:, L.O_CONTACT_LOAD] / face
        for n, v in enumerate(varied):
            if v.place == LIMITS[limit]:
                excess[n] -= 1.0
            elif v.place in (L.P_INNER_RADIUS, L.P_OUTER_RADIUS):
                side = 1.0 if v.place == L.P_OUTER_RADIUS else -1.0
                excess[n] -= side * contact * 2.0 * math.pi * v.value / face**2
        per_film = along[L.O_CONTACT_LOAD] / face
        places.append((contact / face - wanted) / per_film)  # film beyond the corner [m]
        slopes.append(found[:, L.N_ALL] - along[L.N_ALL] * excess / per_film)
    return np.asarray(slopes[0] - (slopes[1] - slopes[0]) * places[0] / (places[1] - places[0]))
