# mypy: disable-error-code="no-any-return"
"""Forces of teeth in space, and what the two bearings of a shaft make of them by statics.

x runs along all shafts, y and z across. A torque or speed is positive about +x. On the driver, at
the end of its working radius r along the unit vector e of the centre line, with t = x cross e:

    F = -T/r t - |T|/r tan(a_wt) e + s T/r tan(b) x        s = 1 for a right hand of the driver

and the opposite on the driven gear (Newton's third law); friction is a couple beside them. Forces
and moments from outside come as they are given.
"""

import math

import numpy as np

from ...numerics.jit import Array, kernel
from . import layout as L
from .bearing_life import induced_share, shared_thrust


@kernel
def fill_force(par: Array, mesh: int, torque: float, force: Array) -> None:
    """Fill the force (x, y, z) [N] on the driver of a mesh, which takes up ``torque`` [N m]."""
    at, own = L.D_MESH + mesh * L.E_ROW, L.P_MESH + mesh * L.MESH_ROW
    angle = par[np.uintp(own + L.A_ANGLE)]
    cosine, sine = math.cos(angle), math.sin(angle)
    tangential = torque / par[np.uintp(at + L.E_DRIVER)]
    radial = abs(tangential) * par[np.uintp(at + L.E_RADIAL)]
    force[0] = tangential * par[np.uintp(at + L.E_AXIAL)]
    force[1] = tangential * sine - radial * cosine
    force[2] = -tangential * cosine - radial * sine


@kernel
def support(
    force: Array, arm: float, angle: float, place: float, ends: tuple[float, float]
) -> tuple[float, float, float, float]:
    """Return what a force on a shaft makes of its bearings: y and z of the first, of the second.

    ``force``: (x, y, z) [N], acting at ``place`` [m] along the shaft, ``arm`` [m] from its axis in
    the direction ``angle`` [rad] from y; ``ends``: places of the bearings. Forces and moments about
    the first bearing vanish.
    """
    across, up = arm * math.cos(angle), arm * math.sin(angle)
    apart, along = ends[1] - ends[0], place - ends[0]
    second_y = (across * force[0] - along * force[1]) / apart
    second_z = (up * force[0] - along * force[2]) / apart
    return -force[1] - second_y, -force[2] - second_z, second_y, second_z


@kernel
def centres(par: Array, shaft: int) -> tuple[float, float]:
    """Return where the radial forces of both bearings act along a shaft [m].

    Outside the pair in O, inside in X, else at the bearings.
    """
    own = L.P_SHAFT + shaft * L.SHAFT_ROW
    one, two = own + L.B_BEARING, own + L.B_BEARING + L.BEARING_ROW
    first, second = par[np.uintp(one + L.C_POSITION)], par[np.uintp(two + L.C_POSITION)]
    arrangement, inwards = int(par[np.uintp(own + L.B_AXIAL)]), 0.0
    if arrangement > L.PUSHED:
        inwards = 1.0 if (arrangement == L.FACE_TO_FACE) == (second > first) else -1.0
    first += inwards * par[np.uintp(one + L.C_CENTRE)]
    return first, second - inwards * par[np.uintp(two + L.C_CENTRE)]


@kernel
def induced_of(par: Array, shaft: int, end: int) -> float:
    """Return the axial force that a bearing makes of its radial load, over that load."""
    row = L.P_SHAFT + shaft * L.SHAFT_ROW + L.B_BEARING + end * L.BEARING_ROW
    return induced_share(
        int(par[np.uintp(row + L.C_KIND)]),
        par[np.uintp(row + L.C_X)],
        par[np.uintp(row + L.C_Y)],
        par[np.uintp(row + L.C_E)],
        par[np.uintp(row + L.C_INDUCED)],
    )


@kernel
def bear(par: Array, meshes: int, shaft: int, work: Array) -> None:
    """Fill radial and axial force [N] of both bearings of a shaft."""
    own, ends = L.P_SHAFT + shaft * L.SHAFT_ROW, centres(par, shaft)
    y1, z1, y2, z2, axial = 0.0, 0.0, 0.0, 0.0, 0.0
    force = work[L.W_SCRATCH : L.W_SCRATCH + 3]
    for mesh in range(max(shaft - 1, 0), min(shaft + 1, meshes)):
        at, of_mesh = L.D_MESH + mesh * L.E_ROW, L.P_MESH + mesh * L.MESH_ROW
        drives = mesh == shaft
        sign = 1.0 if drives else -1.0
        arm = par[np.uintp(at + L.E_DRIVER)] if drives else -par[np.uintp(at + L.E_DRIVEN)]
        is_pinion = drives == (par[np.uintp(of_mesh + L.A_DRIVER)] == L.PINION)
        place = par[np.uintp(of_mesh + (L.A_PINION_POSITION if is_pinion else L.A_GEAR_POSITION))]
        for k in range(3):
            force[k] = sign * work[np.uintp(L.W_FORCE + 3 * mesh + k)]
        a, b, c, d = support(force, arm, par[np.uintp(of_mesh + L.A_ANGLE)], place, ends)
        y1, z1, y2, z2, axial = y1 + a, z1 + b, y2 + c, z2 + d, axial + force[0]
    for k in range(L.PUSHES):
        row = own + L.B_PUSH + k * L.PUSH_ROW
        size, angle = par[np.uintp(row + L.H_RADIAL)], par[np.uintp(row + L.H_DIRECTION)]
        force[0] = par[np.uintp(row + L.H_AXIAL)]
        force[1], force[2] = size * math.cos(angle), size * math.sin(angle)
        a, b, c, d = support(force, 0.0, 0.0, par[np.uintp(row + L.H_POSITION)], ends)
        couple = par[np.uintp(row + L.H_MOMENT)] / (ends[1] - ends[0])
        turn = par[np.uintp(row + L.H_MOMENT_DIRECTION)]
        tilt_y, tilt_z = -couple * math.sin(turn), couple * math.cos(turn)
        y1, z1, y2, z2 = y1 + a - tilt_y, z1 + b - tilt_z, y2 + c + tilt_y, z2 + d + tilt_z
        axial += force[0]
    radial = (math.hypot(y1, z1), math.hypot(y2, z2))
    first = par[np.uintp(own + L.B_BEARING + L.C_POSITION)]
    is_ahead = par[np.uintp(own + L.B_BEARING + L.BEARING_ROW + L.C_POSITION)] > first
    takes, at = int(par[np.uintp(own + L.B_AXIAL)]), L.W_BEARING + 2 * L.ENDS * shaft
    work[np.uintp(at)], work[np.uintp(at + 1)] = radial[0], 0.0
    work[np.uintp(at + 2)], work[np.uintp(at + 3)] = radial[1], 0.0
    if takes > L.PUSHED:
        induced = (
            induced_of(par, shaft, 0) * radial[0],
            induced_of(par, shaft, 1) * radial[1],
        )
        towards = axial if is_ahead else -axial
        work[np.uintp(at + 1)], work[np.uintp(at + 3)] = shared_thrust(takes, induced, towards)
        return
    if takes == L.PUSHED:  # the one that lies where the shaft is pushed to
        takes = L.SECOND if (axial > 0.0) == is_ahead else L.FIRST
    work[np.uintp(at + 2 * takes - 1)] = abs(axial)
