"""Reference values of the washer: three fine meshes of one family, extrapolated."""

from __future__ import annotations

from ..errors import SolveError
from ..models.washer import solve_washer
from ..models.washer_params import WasherParams
from .prolong import solve_on
from .reference_values import ReferenceValues, extrapolated

GRIDS = ((19, 64), (28, 96), (37, 128))  # all intervals refined alike, 3 : 2 then 4 : 3
FINER = ((37, 128), (55, 192), (73, 256))
NAMES = ("friction_torque", "temperature", "temperature_max", "film_thickness", "film_ratio",
         "fluid_load", "contact_load", "friction_coefficient")  # fmt: skip


def reference_washer(
    params: WasherParams, *, load: float, speed: float, tilt: float,
    oil_temperature: float = 297.15, branch: str | None = None, finer: bool = False,
) -> ReferenceValues:  # fmt: skip
    """Return the washer's values converged over the mesh, with what they may be off by.

    Parameters
    ----------
    params, load [N], speed [rad/s], tilt [rad], oil_temperature [K], branch : as in solve_washer
    finer : 73 x 256 nodes at the end (a minute or more) instead of 37 x 128 (seconds)

    Returns
    -------
    ReferenceValues : torque in N m, temperatures in K, film in m, loads in N; the maximum of the
        temperature converges slowly, which its uncertainty shows

    Raises
    ------
    ParameterError : an argument is outside its range
    SolveError : a mesh has no solution on the branch

    Notes
    -----
    Extrapolated with order 2 from the two finest meshes; the uncertainty also counts how far the
    value moved from that of the two coarser ones.
    """
    grids = FINER if finer else GRIDS
    result = solve_washer(params, load=load, speed=speed, tilt=tilt,
                          oil_temperature=oil_temperature, branch=branch)  # fmt: skip
    rows = []
    for grid in grids:
        branch_before = result.branch
        result = solve_on(result, grid)
        if result.status.is_failure or result.branch != branch_before:
            raise SolveError(
                f"reference_washer: {grid[0]} x {grid[1]} nodes have no solution on the branch "
                f"{branch_before!r} at load = {load:g} N; tried: from the next coarser mesh; move "
                "the load away from the fold"
            )
        rows.append({name: float(getattr(result, name)) for name in NAMES})
    intervals = [grid[0] - 1 for grid in grids]
    ratios = intervals[1] / intervals[0], intervals[2] / intervals[1]
    values, uncertainty = extrapolated(rows, ratios, 2.0)
    meshes = ", ".join(f"{a} x {b}" for a, b in grids)
    return ReferenceValues(values, uncertainty, (f"{meshes} nodes, order 2",))
