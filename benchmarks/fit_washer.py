"""The constants of the washer rungs `closed` and `stribeck`, fitted again, and their errors.

python benchmarks/fit_washer.py lift     the wedge on a smooth annulus, constants of washer_wedge
python benchmarks/fit_washer.py heat     random washers against the rung `field`, of washer_lumped

`heat` fits three constants and measures all; run it with NUMBA_DISABLE_JIT=1, or the compiled
kernels keep the constants they were compiled with.
"""

from __future__ import annotations

import math
import sys
from typing import Any

import numpy as np

RHO = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.96)  # inner over outer radius
CLOSING = (0.02, 0.2, 0.4, 0.55, 0.7, 0.8, 0.88, 0.94, 0.98, 1.0)  # tilt x outer radius over z
N_RANDOM, SEED = 260, 3


def annulus(rho: float, eps: float, n_r: int = 20, n_t: int = 64) -> tuple[float, float]:
    """Return lift and centre of pressure of the film h = 1 - eps r cos(theta), rho < r < 1.

    div(h^3 grad p) = 6 dh/dtheta, p >= 0 with Reynolds' conditions, by an active set.
    """
    from scipy.sparse import csr_matrix
    from scipy.sparse.linalg import spsolve

    r = rho + (1.0 - rho) * (1.0 - (1.0 - np.linspace(0.0, 1.0, n_r + 1)) ** 1.6)
    face, inner = 0.5 * (r[1:] + r[:-1]), r[1:-1]
    s = np.arange(n_t) * 2.0 * np.pi / n_t
    th, edge = s - 0.4 * np.sin(s), s + np.pi / n_t - 0.4 * np.sin(s + np.pi / n_t)
    before = np.roll(edge, 1) - np.where(np.arange(n_t) == 0, 2.0 * np.pi, 0.0)
    wide = edge - before
    apart = np.roll(th, -1) - th + np.where(np.arange(n_t) == n_t - 1, 2.0 * np.pi, 0.0)
    m, n = n_r - 1, (n_r - 1) * n_t
    rows, cols, values = [], [], []

    def link(a: Any, b: Any, g: Any, inside: bool = True) -> None:
        rows.append(a), cols.append(a), values.append(g)
        if inside:
            rows.append(a), cols.append(b), values.append(-g)

    at = np.arange(n).reshape(n_t, m)
    gap = 1.0 - eps * np.outer(np.cos(th), face)
    side = (1.0 - eps * np.outer(np.cos(edge), inner)) ** 3 * np.log(face[1:] / face[:-1])
    side /= apart[:, None]
    for i in range(m):
        up = gap[:, i + 1] ** 3 * face[i + 1] * wide / (r[i + 2] - r[i + 1])
        down = gap[:, i] ** 3 * face[i] * wide / (r[i + 1] - r[i])
        link(at[:, i], at[:, min(i + 1, m - 1)], up, i + 1 < m)
        link(at[:, i], at[:, max(i - 1, 0)], down, i > 0)
        link(at[:, i], np.roll(at[:, i], -1), side[:, i])
        link(at[:, i], np.roll(at[:, i], 1), np.roll(side[:, i], 1))
    a = csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(cols))), (n, n))
    ring = (face[1:] ** 3 - face[:-1] ** 3) / 3.0
    source = np.outer(6.0 * eps * (np.cos(edge) - np.cos(before)), ring).ravel()
    area = np.outer(wide, 0.5 * (face[1:] ** 2 - face[:-1] ** 2)).ravel()
    wet, p = np.ones(n, bool), np.zeros(n)
    for _ in range(99):
        k = np.flatnonzero(wet)
        p[:] = 0.0
        p[k] = spsolve(a[k][:, k].tocsc(), source[k])
        new = p + (source - a @ p) / a.diagonal() > 0.0
        if np.array_equal(new, wet):
            break
        wet = new
    x = np.outer(np.cos(th), inner).ravel()
    return float(p @ area), float(p @ (area * x) / (p @ area))


def fit_lift() -> None:
    """Fit width and centre to solutions on the annulus; print constants and worst errors."""
    found = [(rho, e, *annulus(rho, e, n_t=64 if rho < 0.8 else 128))
             for rho in RHO for e in CLOSING]  # fmt: skip
    rho, eps, lift, centre = np.array(found).T
    mean, width = 0.5 * (1.0 + rho), 1.0 - rho
    lam = 0.5 * eps * width / (1.0 - eps * mean)
    ring = mean**2 * width**3 * eps / (1.0 - (eps * mean) ** 2) ** 2
    ratio = lift / ring
    terms = np.stack([lam**j * rho**i for i in range(3) for j in range(1, 5)], 1)
    c = np.linalg.lstsq(terms * ratio[:, None], 1.0 - ratio, rcond=None)[0]
    error = ratio * (1.0 + terms @ c) - 1.0
    print("WIDE", np.round(c.reshape(3, 4), 5).tolist())
    print(f"lift: worst {np.abs(error).max():.2%}, rms {np.sqrt(np.mean(error**2)):.2%}")
    terms = np.stack([lam**j * width**i for i in (1, 2) for j in range(3)], 1)
    near = eps * mean**2
    c = np.linalg.lstsq(terms * eps[:, None], (centre / near - 1.0) * eps, rcond=None)[0]
    print("CENTRE", np.round(c, 4).tolist())
    print(f"centre: worst {np.abs((1.0 + terms @ c) * near - centre).max():.3f} outer radii")


def random_washers() -> list[tuple[dict[str, Any], dict[str, float]]]:
    """Return half default, half random parameters, each with a random operating point."""
    rng = np.random.default_rng(SEED)

    def log(a: float, b: float) -> float:
        return float(np.exp(rng.uniform(math.log(a), math.log(b))))

    found = []
    for k in range(N_RANDOM):
        p: dict[str, Any] = {}
        if k % 2:
            ri = log(4e-3, 0.03)
            ro = min(ri * log(1.3, 3.5), 0.06)
            p = {
                "inner_radius": ri, "outer_radius": ro,
                "gear_inner_radius": ri + (ro - ri) * rng.uniform(0.02, 0.6),
                "carrier_thickness": log(2e-3, 0.03), "washer_thickness": log(3e-4, 3e-3),
                "gear_thickness": log(2e-3, 0.03), "roughness": log(2e-7, 2e-6),
                "conductivity": log(15.0, 200.0), "viscosity_scale": log(2e-5, 2e-4),
                "heat_split": float(rng.choice([0.5, 0.2, 0.8])),
                "friction_law": str(rng.choice(["load", "constant"])),
                "dry_friction": rng.uniform(0.05, 0.2),
                "film_heat_fraction": float(rng.choice([1.0, 1.0, 0.5, 0.1])),
            }  # fmt: skip
        at = {"load": log(20.0, 3e3), "speed": log(20.0, 1500.0), "tilt": log(3e-4, 4e-3),
              "oil_temperature": float(rng.uniform(285.0, 390.0))}  # fmt: skip
        found.append((p, at))
    return found


def fit_heat() -> None:
    """Fit the lumped heat to the rung `field`; print constants and errors by regime."""
    from scipy.optimize import least_squares

    from thrustwasher import WasherParams, solve_washer
    from thrustwasher.washer.kernels import lumped

    names = ("FILM_HEAT", "RUB_HEAT", "YIELDING")
    cases = [(WasherParams(**p), at) for p, at in random_washers()]
    field = [solve_washer(p, **at) for p, at in cases]

    def solve(rung: str, x: Any = ()) -> tuple[Any, Any]:
        for name, value in zip(names, x, strict=False):
            setattr(lumped, name, float(value))
        found = [solve_washer(p, **at, fidelity=rung) for p, at in cases]
        pairs = list(zip(found, field, strict=True))
        torque = np.array([a.friction_torque / b.friction_torque for a, b in pairs])
        ratio = np.array([a.film_ratio - b.film_ratio for a, b in pairs])
        return torque, ratio

    films = np.array([b.film_ratio for b in field])

    def misses(x: Any) -> Any:
        torque, ratio = solve("stribeck", x)
        return np.r_[np.log(torque) / 0.03, 0.5 * ratio / (0.2 + 0.03 * np.abs(films))]

    if "--fit" in sys.argv:
        start = [getattr(lumped, name) for name in names]
        fit = least_squares(misses, start, bounds=([0.8, 1.0, 0.5], [1.5, 200.0, 0.98]),
                            loss="soft_l1", diff_step=0.02, max_nfev=9)  # fmt: skip
        print(dict(zip(names, np.round(fit.x, 3).tolist(), strict=True)))
    for rung in ("closed", "stribeck"):
        torque = np.abs(solve(rung)[0] - 1.0)
        for low, high, text in ((3.0, 1e9, "film"), (1.0, 3.0, "mixed"), (-1e9, 1.0, "boundary")):
            t = torque[(films > low) & (films <= high)]
            print(f"{rung:9} {text:9} {t.size:4} points: torque median {np.median(t):.1%}, "
                  f"rms {np.sqrt(np.mean(t**2)):.1%}, worst {t.max():.0%}")  # fmt: skip


if __name__ == "__main__":
    (fit_lift if sys.argv[1:2] == ["lift"] else fit_heat)()
