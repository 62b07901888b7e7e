"""Average-flow Reynolds equation with cavitation: conductances, residual, linear system.

div( phi h^3/(12 mu) grad p ) = (omega/2) d/dtheta [ h_T - sigma s Phi_s ], p >= 0, residual >= 0,
product 0 (Reynolds cavitation as a complementarity problem). Finite volumes, gaps exact at the
faces, fluidity 1/mu averaged from the two nodes.

Source: Patir & Cheng 1978/79; Jackson & Green Eq 1-5 in polar form.
"""

import math

import numpy as np

from ...numerics.arrays import clear
from ...numerics.banded import N_SIDES, band_solve, cholesky, cholesky_solve_many
from ...numerics.jit import Array, kernel, matrix
from ...tribology.flow_factors import flow_conductance, mean_gap, shear_flow
from . import layout as L
from .constants import WasherModel
from .gap import film_change
from .layout import AT_FIXED, OVER_POSITIONS, TILT_X, TILT_Y, Z_WASHER
from .workspace import Fields, Point

AT_NODES = 0.07  # share of each node in the resistance between two
MOST_MARKS = 30  # rounds that settle which nodes are full


@kernel
def evaluate_film(m: WasherModel, pt: Point, q: Array, f: Fields) -> None:
    """Fill conductances (but for the fluidity) and the wedge term at all faces."""
    z_w, gx, gy = q[Z_WASHER], q[TILT_X], q[TILT_Y]
    n_r = m.n_r
    sheared = m.shear != 0.0
    for j in range(m.n_t):
        slope = m.sin_face[j] * gx - m.cos_face[j] * gy
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            h = z_w + m.middle[i] * slope
            f.ct[k], f.dct[k] = 0.0, 0.0
            if 0 < i < n_r - 1:  # there is no pressure at the rims
                c, dc = flow_conductance(h, m.sigma1)
                g = m.log_width[i] / (24.0 * m.step_t[j])
                f.ct[k], f.dct[k] = g * c, g * dc
            gap, dgap = mean_gap(h, m.sigma1)
            if sheared:
                s, ds = shear_flow(h, m.sigma1)
                gap -= m.sigma1 * m.shear * s
                dgap -= m.sigma1 * m.shear * ds
            inner = m.inner_radius if i == 0 else m.r_face[i - 1]
            pull = 0.25 * pt.speed * (m.r_face[i] * m.r_face[i] - inner * inner)
            f.wedge[k], f.dwedge[k] = pull * gap, pull * dgap
        slope = m.sin[j] * gx - m.cos[j] * gy
        c1, dc1 = flow_conductance(z_w + m.r[0] * slope, m.sigma1)
        for i in range(n_r - 1):
            # in series: node, face, node; slopes as shares of the resistance
            k = np.uintp(j * n_r + i)
            c0, dc0, r0, r1, face = c1, dc1, m.r[i], m.r[i + 1], m.r_face[i]
            c1, dc1 = flow_conductance(z_w + r1 * slope, m.sigma1)
            c, dc = flow_conductance(z_w + face * slope, m.sigma1)
            s0, s1 = AT_NODES / (r0 * c0), AT_NODES / (r1 * c1)
            s = (1.0 - 2.0 * AT_NODES) / (face * c)
            whole = s0 + s + s1
            s0, s, s1 = s0 / whole * dc0 / c0, s / whole * dc / c, s1 / whole * dc1 / c1
            f.cr[k] = m.width_t[j] / (24.0 * (r1 - r0)) / whole
            f.dcr[k] = f.cr[k] * (s0 + s + s1)
            f.arm_cr[k] = (s0 * r0 + s * face + s1 * r1) / (s0 + s + s1)


@kernel
def mark_film(m: WasherModel, f: Fields) -> tuple[float, float, int]:
    """Mark full and cavitated nodes; return the residual [Pa], p_max [Pa], moves.

    ``moves`` counts the nodes whose mark has changed. A node cavitates if
    p - residual/diagonal <= 0, the semismooth Newton choice. Columns without a full node are left
    out; one such column cuts the ring, and the system is a band of one column, else the ring is
    folded (two columns).
    """
    n_r, n_t = m.n_r, m.n_t
    worst, p_max, moves = 0.0, 0.0, 0
    first_dry = -1
    p = f.p
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        jb = j - 1 if j > 0 else n_t - 1
        any_wet = False
        for i in range(1, n_r - 1):
            k = np.uintp(j * n_r + i)
            kn, kb = np.uintp(jn * n_r + i), np.uintp(jb * n_r + i)
            up, down = np.uintp(j * n_r + i + 1), np.uintp(j * n_r + i - 1)
            here = f.fluidity[k]
            c_n = f.ct[k] * (here + f.fluidity[kn])
            c_b = f.ct[kb] * (here + f.fluidity[kb])
            c_u = f.cr[k] * (here + f.fluidity[up])
            c_d = f.cr[down] * (here + f.fluidity[down])
            diagonal = c_n + c_b + c_u + c_d
            flow = (
                diagonal * p[k]
                - c_n * p[kn]
                - c_b * p[kb]
                - c_u * p[up]
                - c_d * p[down]
                + f.wedge[k]
                - f.wedge[kb]
            ) / diagonal
            before = f.wet[k]
            if p[k] > flow:
                f.wet[k] = 1.0
                any_wet = True
                worst = max(worst, abs(flow))
            else:
                f.wet[k] = 0.0
                worst = max(worst, abs(p[k]))
            if f.wet[k] != before:
                moves += 1
            p_max = max(p_max, p[k])
        f.place[j] = 0.0 if any_wet else -1.0
        if not any_wet and first_dry < 0:
            first_dry = j
    count = 0
    for step in range(n_t):
        if first_dry >= 0:
            j = (first_dry + step) % n_t
        else:  # folded ring
            j = step // 2 if step % 2 == 0 else n_t - 1 - step // 2
        if f.place[j] >= 0.0:
            f.place[j] = count
            count += 1
    f.small[L.RING] = 0.0 if first_dry >= 0 else 1.0
    return worst, p_max, moves


@kernel
def _face(
    f: Fields, k: int, other: int, c: float, drop: float, per_h: float, x: float, y: float
) -> None:
    """Add the slopes of the flow through one face to the right sides of its two nodes."""
    a, b = np.uintp(k), np.uintp(other)
    flow = c * drop
    for s in range(N_SIDES):
        v = flow * (f.lag[a, np.uintp(s)] + f.lag[b, np.uintp(s)])
        f.film_rhs[a, np.uintp(s)] -= v
        f.film_rhs[b, np.uintp(s)] += v
    over_z = OVER_POSITIONS + Z_WASHER
    over_x, over_y = OVER_POSITIONS + TILT_X, OVER_POSITIONS + TILT_Y
    f.film_rhs[a, over_z] -= per_h
    f.film_rhs[b, over_z] += per_h
    f.film_rhs[a, over_x] -= per_h * y
    f.film_rhs[b, over_x] += per_h * y
    f.film_rhs[a, over_y] += per_h * x
    f.film_rhs[b, over_y] -= per_h * x


@kernel
def _lags(m: WasherModel, f: Fields) -> None:
    """Fill the fluidity change of each node that follows from the temperature step and slopes."""
    n_r, n_t = m.n_r, m.n_t
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        jb = j - 1 if j > 0 else n_t - 1
        if f.place[j] < 0.0 and f.place[jn] < 0.0 and f.place[jb] < 0.0:
            continue  # no full film on either side
        one, two = m.film_at + j * m.film_step, m.film_at + j * m.film_step
        if m.film_step == 0:  # the mean of carrier and washer
            one, two = m.carrier_at + j * m.carrier_step, m.washer_at + j * m.washer_step
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            t, below = np.uintp(one + i), np.uintp(two + i)
            scale = -0.5 * f.dmu[k] * f.fluidity[k] * f.fluidity[k]
            f.lag[k, AT_FIXED] = scale * (f.dtemp[t] + f.dtemp[below])
            for c in range(4):
                following = f.following[np.uintp(c), t] + f.following[np.uintp(c), below]
                f.lag[k, np.uintp(OVER_POSITIONS + c)] = scale * following
            for s in range(OVER_POSITIONS + 4, N_SIDES):
                f.lag[k, np.uintp(s)] = 0.0


@kernel
def _right_sides(m: WasherModel, f: Fields) -> None:
    """Fill the film's right sides, node by node."""
    n_r, n_t = m.n_r, m.n_t
    p = f.p
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        used = f.place[j] >= 0.0
        if not (used or f.place[jn] >= 0.0):
            continue
        for i in range(1, n_r - 1):
            k, o = j * n_r + i, jn * n_r + i
            drop = p[k] - p[o]
            fluid = f.fluidity[k] + f.fluidity[o]
            _face(
                f,
                k,
                o,
                f.ct[k],
                drop,
                f.dct[k] * fluid * drop + f.dwedge[k],
                m.middle[i] * m.cos_face[j],
                m.middle[i] * m.sin_face[j],
            )
        if not used:
            continue
        for i in range(n_r - 1):
            k = j * n_r + i
            drop = p[k] - p[k + 1]
            fluid = f.fluidity[k] + f.fluidity[k + 1]
            _face(
                f,
                k,
                k + 1,
                f.cr[k],
                drop,
                f.dcr[k] * fluid * drop,
                f.arm_cr[np.uintp(k)] * m.cos[j],
                f.arm_cr[np.uintp(k)] * m.sin[j],
            )


@kernel
def film_factor(m: WasherModel, f: Fields) -> bool:
    """Assemble the film's matrix in ``f.film`` and factor it; return False if a pivot fails."""
    n_r, n_t = m.n_r, m.n_t
    rows = n_r - 2
    band = band_of_film(m, f)
    size = size_of_film(m, f)
    used = f.film[: size * (band + 1)]
    clear(used)
    bands = matrix(used, size, band + 1)  # the diagonal, then what is below it
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        jb = j - 1 if j > 0 else n_t - 1
        if not f.place[j] >= 0.0:
            continue
        for i in range(1, n_r - 1):
            k = j * n_r + i
            row = int(f.place[j]) * rows + i - 1
            if f.wet[k] == 0.0:
                bands[row, 0] = 1.0
                continue
            kn, kb = jn * n_r + i, jb * n_r + i
            here = f.fluidity[k]
            c_n = f.ct[k] * (here + f.fluidity[kn])
            c_b = f.ct[kb] * (here + f.fluidity[kb])
            c_u = f.cr[k] * (here + f.fluidity[k + 1])
            c_d = f.cr[k - 1] * (here + f.fluidity[k - 1])
            bands[row, 0] = c_n + c_b + c_u + c_d
            if i + 1 < n_r - 1 and f.wet[k + 1] == 1.0:
                bands[row, 1] = -c_u
            if f.wet[kn] == 1.0:
                col = int(f.place[jn]) * rows + i - 1
                bands[min(row, col), abs(row - col)] -= c_n
    return size == 0 or cholesky(f.film, size, band)


@kernel
def band_of_film(m: WasherModel, f: Fields) -> int:
    """Return the half band width of the film's system."""
    return (m.n_r - 2) * (1 if f.small[L.RING] == 0.0 else 2)


@kernel
def size_of_film(m: WasherModel, f: Fields) -> int:
    """Return the number of unknowns of the film's system: columns with a full node."""
    size = 0
    for j in range(m.n_t):
        if f.place[j] >= 0.0:
            size += m.n_r - 2
    return size


@kernel
def _solve_sides(m: WasherModel, f: Fields) -> None:
    """Solve the factored film for all right sides ``f.film_rhs``, in place; 0 where it is dry."""
    n_r, n_t = m.n_r, m.n_t
    sides = matrix(f.sides, n_r * n_t, N_SIDES)
    for j in range(n_t):
        if f.place[j] >= 0.0:
            row = int(f.place[j]) * (n_r - 2) - 1
            for i in range(1, n_r - 1):
                k = np.uintp(j * n_r + i)
                for s in range(N_SIDES):
                    rhs = f.film_rhs[k, np.uintp(s)]
                    sides[np.uintp(row + i), np.uintp(s)] = rhs * f.wet[k]
    cholesky_solve_many(f.film, f.sides, size_of_film(m, f), band_of_film(m, f))
    for j in range(n_t):
        row = int(f.place[j]) * (n_r - 2) - 1
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            inside = f.place[j] >= 0.0 and 0 < i < n_r - 1
            for s in range(N_SIDES):
                solved = sides[np.uintp(row + i), np.uintp(s)] * f.wet[k] if inside else 0.0
                f.film_rhs[k, np.uintp(s)] = solved


@kernel
def _solve_one(m: WasherModel, f: Fields, to: Array) -> None:
    """Solve the factored film for the right side in ``to`` (n,), in place; 0 where it is dry."""
    n_r, n_t = m.n_r, m.n_t
    for j in range(n_t):
        if f.place[j] >= 0.0:
            row = int(f.place[j]) * (n_r - 2) - 1
            for i in range(1, n_r - 1):
                k = np.uintp(j * n_r + i)
                f.sides[np.uintp(row + i)] = to[k] * f.wet[k]
    band_solve(f.film, f.sides, size_of_film(m, f), band_of_film(m, f))
    for j in range(n_t):
        row = int(f.place[j]) * (n_r - 2) - 1
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            inside = f.place[j] >= 0.0 and 0 < i < n_r - 1
            to[k] = f.sides[np.uintp(row + i)] * f.wet[k] if inside else 0.0


@kernel
def settle_film(m: WasherModel, f: Fields) -> float:
    """Solve Reynolds' equation for ``f.p`` at the gaps and viscosities in ``f``.

    Return the residual of the complementarity problem over the largest pressure, inf if the matrix
    cannot be factored. The factor stays in ``f.film``. ``f.p`` is the start: semismooth Newton
    steps until no node changes between full and cavitated.
    """
    mark_film(m, f)
    return settle_marked(m, f)


@kernel
def settle_marked(m: WasherModel, f: Fields) -> float:
    """Do as `settle_film`, from the marks that the last film has left in ``f``."""
    n_r, n_t = m.n_r, m.n_t
    error, p_max = 0.0, 0.0
    for _ in range(MOST_MARKS):
        if not film_factor(m, f):
            return math.inf
        clear(f.p)
        for j in range(n_t):
            jb = j - 1 if j > 0 else n_t - 1
            for i in range(1, n_r - 1):
                k = j * n_r + i
                f.p[k] = f.wedge[jb * n_r + i] - f.wedge[k]
        _solve_one(m, f, f.p)
        error, p_max, moves = mark_film(m, f)
        if moves == 0:
            break
    for k in range(f.p.size):  # cavitated by the last marks
        if f.p[np.uintp(k)] < 0.0:
            f.p[np.uintp(k)] = 0.0
    return error / p_max if p_max > 0.0 else 0.0


@kernel
def film_solve(m: WasherModel, f: Fields) -> None:
    """Solve the linearised film for five right sides; the film is settled.

    Out, in ``f.film_rhs[node]``: the change of pressure that the temperature step ``f.dtemp``
    brings, then the slopes over the positions (temperatures following by ``f.following``). Zero at
    cavitated nodes and rims.
    """
    for node in range(f.p.size):
        for s in range(N_SIDES):
            f.film_rhs[np.uintp(node), np.uintp(s)] = 0.0
    _lags(m, f)
    _right_sides(m, f)
    _solve_sides(m, f)


@kernel
def hold_pressure(
    m: WasherModel, pt: Point, change: Point, dq: Array, dtemp: Array, f: Fields
) -> None:
    """Fill ``f.dflow_t`` and ``f.dflow_r``, the changes of the flows at the pressures as they are.

    ``change`` is that of the operating point, ``dq`` (4,) of the positions, ``dtemp`` (n_temp,).
    """
    n_r, n_t = m.n_r, m.n_t
    per_speed = change.speed / pt.speed if pt.speed != 0.0 else 0.0
    for j in range(n_t):  # changes of the fluidity
        for i in range(n_r):
            k = np.uintp(j * n_r + i)
            rise = film_change(m, dtemp, j, i) + change.oil_temperature
            f.lag[k, 0] = -f.dmu[k] * rise * f.fluidity[k] * f.fluidity[k]
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        for i in range(n_r):
            k, o = np.uintp(j * n_r + i), np.uintp(jn * n_r + i)
            x, y = m.middle[i] * m.cos_face[j], m.middle[i] * m.sin_face[j]
            dh = dq[Z_WASHER] + y * dq[TILT_X] - x * dq[TILT_Y]
            fluid, dfluid = f.fluidity[k] + f.fluidity[o], f.lag[k, 0] + f.lag[o, 0]
            drop = f.p[k] - f.p[o]
            f.dflow_t[k] = (
                f.dwedge[k] * dh
                + f.wedge[k] * per_speed
                + (f.dct[k] * dh * fluid + f.ct[k] * dfluid) * drop
            )
            f.dflow_r[k] = 0.0
            if i + 1 < n_r:
                x, y = f.arm_cr[k] * m.cos[j], f.arm_cr[k] * m.sin[j]
                dh = dq[Z_WASHER] + y * dq[TILT_X] - x * dq[TILT_Y]
                o = k + np.uintp(1)
                fluid, dfluid = f.fluidity[k] + f.fluidity[o], f.lag[k, 0] + f.lag[o, 0]
                drop = f.p[k] - f.p[o]
                f.dflow_r[k] = (f.dcr[k] * dh * fluid + f.cr[k] * dfluid) * drop


@kernel
def let_pressure_follow(m: WasherModel, f: Fields) -> None:
    """Fill ``f.dp``, the change of the pressure that the changes of the flows bring."""
    n_r, n_t = m.n_r, m.n_t
    for j in range(n_t):
        jb = j - 1 if j > 0 else n_t - 1
        for i in range(n_r):
            k = j * n_r + i
            f.dp[k] = 0.0
            if 0 < i < n_r - 1:
                f.dp[k] = f.dflow_t[jb * n_r + i] - f.dflow_t[k] + f.dflow_r[k - 1] - f.dflow_r[k]
    _solve_one(m, f, f.dp)


@kernel
def let_flows_follow(m: WasherModel, f: Fields) -> None:
    """Add to the changes of the flows what the change of the pressure brings."""
    n_r, n_t = m.n_r, m.n_t
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        for i in range(n_r):
            k, o = np.uintp(j * n_r + i), np.uintp(jn * n_r + i)
            f.dflow_t[k] += f.ct[k] * (f.fluidity[k] + f.fluidity[o]) * (f.dp[k] - f.dp[o])
            if i + 1 < n_r:
                o = k + np.uintp(1)
                f.dflow_r[k] += f.cr[k] * (f.fluidity[k] + f.fluidity[o]) * (f.dp[k] - f.dp[o])
