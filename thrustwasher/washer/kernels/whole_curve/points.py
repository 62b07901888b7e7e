"""The curve of solutions point by point, the folds that it passes, the branches of its points."""

from ....numerics.arrays import copy
from ....numerics.jit import Array, kernel
from ....numerics.status import OK
from .. import layout as L
from ..branch import FILM_RATIO
from ..continuation import begin_curve, next_point, pass_fold
from ..outputs import outputs_at
from ..regime_and_status import point_of
from ..workspace import Point, workspace_of

ROW = 1 + L.N_ALL  # numbers of a point: load, outputs


@kernel
def follow_curve(
    par: Array,
    inp: Array,
    work: Array,
    load_min: float,
    load_max: float,
    whole: Array,
    rows: Array,
) -> int:
    """Follow the curve on, over one or more points; return a status.

    It ends at the first point beyond ``load_max`` [N] from which the load rises.

    Parameters
    ----------
    inp : (NINP,) inputs; their load does not count
    load_min : load [N] below which the curve begins
    whole : (N_WHOLE,) where it stands; zeros: it begins. Then ``POINTS`` is how many rows were
        filled, ``FOLD`` tells of a fold before the last one, ``ENDED`` is 1 at the end
    rows : (n ROW,) load [N] and outputs, point by point; a fold or the end leaves some unfilled
    """
    w, pt = workspace_of(par, work), point_of(par, inp)
    whole[L.POINTS] = whole[L.FOLD] = 0.0
    for k in range(rows.size // ROW):
        status = OK
        if whole[L.BEGUN] == 0.0:
            status = begin_curve(w, pt, load_min, whole)
            whole[L.BEGUN] = 1.0
        else:
            status = pass_fold(w, pt, whole)
            if status != OK:
                return status
            if not whole[L.CURVE_LOAD] < load_max and whole[L.RISES] != 0.0:
                whole[L.ENDED] = 1.0
                return OK
            status = next_point(w, pt, whole)
        if status != OK:
            return status
        load = w.curve[L.AT_LOAD]
        outputs_at(w, Point(load, pt.speed, pt.tilt, pt.oil_temperature, pt.far_face))
        rows[k * ROW] = load
        copy(w.outputs, rows[k * ROW + 1 : (k + 1) * ROW])
        whole[L.POINTS] += 1.0
        if whole[L.FOLD] != 0.0:
            return OK
    return OK


@kernel
def name_branches(ratios: Array, folds: Array, branches: Array) -> None:
    """Fill the branches (n,) of points by their film ratios (n,) and those of the folds (k,).

    Without folds the curve is single-valued: the film ratio alone names its branches.
    """
    for i in range(ratios.size):
        passed = 0
        for k in range(folds.size):
            if ratios[i] < folds[k]:
                passed += 1
        if folds.size == 0:
            branches[i] = L.FILM_BRANCH if ratios[i] >= FILM_RATIO else L.CONTACT_BRANCH
        elif passed % 2 == 1:
            branches[i] = L.UNSTABLE
        else:
            branches[i] = L.CONTACT_BRANCH if passed > 0 else L.FILM_BRANCH
