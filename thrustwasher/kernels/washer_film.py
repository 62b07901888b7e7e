"""Average-flow Reynolds equation with cavitation: conductances, residual, linear system.

div( phi h^3/(12 mu) grad p ) = (omega/2) d/dtheta [ h_T - sigma s Phi_s ], p >= 0, residual >= 0,
product 0 (Reynolds cavitation as a complementarity problem). Finite volumes, gaps exact at the
faces, fluidity 1/mu averaged from the two nodes.

Source: Patir & Cheng 1978/79; Jackson & Green Eq 1-5 in polar form.
"""

import numpy as np
from numpy.typing import NDArray

from ._jit import kernel
from .banded import cholesky, cholesky_solve
from .film import flow_conductance, mean_gap, shear_flow
from .washer_fields import Fields, Point
from .washer_model import WasherModel


@kernel
def evaluate_film(m: WasherModel, pt: Point, q: NDArray[np.float64], f: Fields) -> None:
    """Fill conductances (but for the fluidity) and the wedge term at all faces."""
    z_w, gx, gy = q[0], q[2], q[3]
    n_r = m.n_r
    sheared = m.shear != 0.0
    for j in range(m.n_t):
        slope = m.sin_face[j] * gx - m.cos_face[j] * gy
        for i in range(1, n_r - 1):
            k = np.uintp(j * n_r + i)
            h = z_w + m.r[i] * slope
            c, dc = flow_conductance(h, m.sigma1)
            g = m.log_width[i] / (24.0 * m.step_t[j])
            f.ct[k], f.dct[k] = g * c, g * dc
            gap, dgap = mean_gap(h, m.sigma1)
            if sheared:
                s, ds = shear_flow(h, m.sigma1)
                gap -= m.sigma1 * m.shear * s
                dgap -= m.sigma1 * m.shear * ds
            inner = m.r_face[i - 1]
            pull = 0.25 * pt.speed * (m.r_face[i] * m.r_face[i] - inner * inner)
            f.wedge[k], f.dwedge[k] = pull * gap, pull * dgap
        slope = m.sin[j] * gx - m.cos[j] * gy
        for i in range(n_r - 1):
            k = np.uintp(j * n_r + i)
            c, dc = flow_conductance(z_w + m.r_face[i] * slope, m.sigma1)
            g = m.r_face[i] * m.width_t[j] / (24.0 * (m.r[i + 1] - m.r[i]))
            f.cr[k], f.dcr[k] = g * c, g * dc


@kernel
def film_residual(
    m: WasherModel, p: NDArray[np.float64], f: Fields
) -> tuple[float, float, int]:
    """Mark full and cavitated nodes; return (complementarity residual [Pa], p_max [Pa], n).

    ``n`` counts the unknowns of the linear system. A node cavitates if p - residual/diagonal <= 0,
    the semismooth Newton choice. Columns without a full node are left out; one such column cuts
    the ring, and the system is a band of one column, else the ring is folded (two columns).
    """
    n_r, n_t = m.n_r, m.n_t
    worst, p_max = 0.0, 0.0
    first_dry = -1
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        jb = j - 1 if j > 0 else n_t - 1
        any_wet = False
        for i in range(1, n_r - 1):
            k = np.uintp(j * n_r + i)
            kn, kb = np.uintp(jn * n_r + i), np.uintp(jb * n_r + i)
            up, down = np.uintp(j * n_r + i + 1), np.uintp(j * n_r + i - 1)
            here = 1.0 / f.mu[k]
            c_n = f.ct[k] * (here + 1.0 / f.mu[kn])
            c_b = f.ct[kb] * (here + 1.0 / f.mu[kb])
            c_u = f.cr[k] * (here + 1.0 / f.mu[up])
            c_d = f.cr[down] * (here + 1.0 / f.mu[down])
            diagonal = c_n + c_b + c_u + c_d
            flow = (
                diagonal * p[k] - c_n * p[kn] - c_b * p[kb] - c_u * p[up] - c_d * p[down]
                + f.wedge[k] - f.wedge[kb]
            ) / diagonal  # fmt: skip
            if p[k] > flow:
                f.wet[k] = 1.0
                any_wet = True
                worst = max(worst, abs(flow))
            else:
                f.wet[k] = 0.0
                worst = max(worst, abs(p[k]))
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
    f.small[127] = 0.0 if first_dry >= 0 else 1.0
    return worst, p_max, count * (n_r - 2)


@kernel
def _film_rhs(m: WasherModel, p: NDArray[np.float64], f: Fields, k: int, side: int, n: int) -> None:
    """Add the slopes of one face to the five right sides of its two nodes.

    ``k`` is the node before the face; ``side`` 0: face to the next angle, 1: to the next radius.
    """
    n_r, n_t = m.n_r, m.n_t
    i, j = k % n_r, k // n_r
    m_t = 3 * n_r - m.i_g
    n_temp = m_t * n_t
    if side == 0:
        jn = j + 1 if j + 1 < n_t else 0
        other, jo, io = jn * n_r + i, jn, i
        c, dc = f.ct[k], f.dct[k]
        x, y = m.r[i] * m.cos_face[j], m.r[i] * m.sin_face[j]
        d_wedge = f.dwedge[k]
    else:
        other, jo, io = k + 1, j, i + 1
        c, dc = f.cr[k], f.dcr[k]
        x, y = m.r_face[i] * m.cos[j], m.r_face[i] * m.sin[j]
        d_wedge = 0.0
    fluid_k, fluid_o = 1.0 / f.mu[k], 1.0 / f.mu[other]
    drop = p[k] - p[other]
    per_h = dc * (fluid_k + fluid_o) * drop + d_wedge
    per_tk = -c * f.dmu[k] * fluid_k * fluid_k * drop * 0.5  # half: mean of carrier and washer
    per_to = -c * f.dmu[other] * fluid_o * fluid_o * drop * 0.5
    tk, to = j * m_t + i, jo * m_t + io
    for s in range(5):
        if s == 0:
            value = per_tk * (f.dtemp[tk] + f.dtemp[tk + n_r]) + per_to * (
                f.dtemp[to] + f.dtemp[to + n_r]
            )
        else:
            b = (s - 1) * n_temp
            value = per_tk * (f.sens[b + tk] + f.sens[b + tk + n_r]) + per_to * (
                f.sens[b + to] + f.sens[b + to + n_r]
            )
            if s == 1:
                value += per_h
            elif s == 3:
                value += per_h * y
            elif s == 4:
                value -= per_h * x
        f.film_rhs[s * n + k] -= value
        f.film_rhs[s * n + other] += value


@kernel
def film_solve(m: WasherModel, p: NDArray[np.float64], f: Fields) -> bool:
    """Solve the linearised film for five right sides; return False if a pivot fails.

    Out, in ``f.film_rhs``: the new pressure at fixed positions (after the temperature step
    ``f.dtemp``), then its slopes over z_w, z_g, gx, gy (temperatures following by ``f.sens``).
    Zero at cavitated nodes and rims. The residual is linear in p, so the new pressure itself is
    solved for and the neighbours that just cavitated need no care.
    """
    n_r, n_t = m.n_r, m.n_t
    n, rows = n_r * n_t, n_r - 2
    band = rows if f.small[127] == 0.0 else 2 * rows
    for k in range(5 * n):
        f.film_rhs[np.uintp(k)] = 0.0
    size = 0
    for j in range(n_t):
        if f.place[j] >= 0.0:
            size = max(size, (int(f.place[j]) + 1) * rows)
    for k in range(size * (band + 1)):
        f.film[np.uintp(k)] = 0.0
    for j in range(n_t):
        jn = j + 1 if j + 1 < n_t else 0
        jb = j - 1 if j > 0 else n_t - 1
        used = f.place[j] >= 0.0
        if used or f.place[jn] >= 0.0:
            for i in range(1, n_r - 1):
                _film_rhs(m, p, f, j * n_r + i, 0, n)
        if not used:
            continue
        for i in range(n_r - 1):
            _film_rhs(m, p, f, j * n_r + i, 1, n)
        for i in range(1, n_r - 1):
            k = j * n_r + i
            row = int(f.place[j]) * rows + i - 1
            if f.wet[k] == 0.0:
                f.film[row * (band + 1)] = 1.0
                continue
            kn, kb = jn * n_r + i, jb * n_r + i
            here = 1.0 / f.mu[k]
            c_n = f.ct[k] * (here + 1.0 / f.mu[kn])
            c_b = f.ct[kb] * (here + 1.0 / f.mu[kb])
            c_u = f.cr[k] * (here + 1.0 / f.mu[k + 1])
            c_d = f.cr[k - 1] * (here + 1.0 / f.mu[k - 1])
            f.film[row * (band + 1)] = c_n + c_b + c_u + c_d
            f.film_rhs[k] -= f.wedge[k] - f.wedge[kb]
            if i + 1 < n_r - 1 and f.wet[k + 1] == 1.0:
                f.film[row * (band + 1) + 1] = -c_u
            if f.wet[kn] == 1.0:
                col = int(f.place[jn]) * rows + i - 1
                f.film[min(row, col) * (band + 1) + abs(row - col)] -= c_n
    if size > 0 and not cholesky(f.film, size, band):
        return False
    for s in range(5):
        for j in range(n_t):
            if f.place[j] >= 0.0:
                row = int(f.place[j]) * rows - 1
                for i in range(1, n_r - 1):
                    k = j * n_r + i
                    f.spare[row + i] = f.film_rhs[s * n + k] * f.wet[k]
        if size > 0:
            cholesky_solve(f.film, f.spare, size, band)
        for j in range(n_t):
            row = int(f.place[j]) * rows - 1
            for i in range(n_r):
                k = j * n_r + i
                inside = f.place[j] >= 0.0 and 0 < i < n_r - 1
                f.film_rhs[s * n + k] = f.spare[row + i] * f.wet[k] if inside else 0.0
    return True
