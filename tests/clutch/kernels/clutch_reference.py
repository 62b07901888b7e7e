"""The engagement once more, straight from its equations: numpy and scipy, no kernel of ours."""

import math

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.integrate import solve_ivp
from scipy.special import ndtr

NODES, WEIGHTS = leggauss(60)


def height_integral(n, u):
    """F_n(u) = int_u^inf (s - u)^n pdf(s) ds, with s - u = w^2."""
    low = math.sqrt(max(0.0, -u - 9.0))
    high = math.sqrt(max(9.0, 9.0 - u) if u < 0.0 else math.hypot(u, 9.0) - u)
    w = low + (high - low) * 0.5 * (NODES + 1.0)
    density = np.exp(-0.5 * (u + w * w) ** 2) / math.sqrt(2.0 * math.pi)
    return float((WEIGHTS * (high - low) * w * w ** (2 * n) * density).sum())


def oil_viscosity(p, temperature):
    reduced = 1.0 + (temperature - 273.15) / 135.0
    return p.viscosity_scale * 10.0 ** (p.viscosity_constant * reduced**-p.viscosity_exponent)


def friction(p, speed):
    """Coefficient of Wang et al. (2012), Eq 12, over the slip speed [m/s]."""
    ratio = p.shear_floor + (1.0 - p.shear_floor) * math.exp(
        -max(0.0, speed - p.stick_speed) / p.decay_speed
    )
    x = p.indentation
    root = math.sqrt(1.0 - x * x)
    plough = p.plough_weight * (math.asin(x) - x * root)
    return 2.0 / (math.pi * x * x) * (plough + 2.0 * ratio / p.hardness_ratio * (1.0 - root))


class Reference:
    """Film ratio and temperature of a pack; ``load`` and ``slip`` are functions of time."""

    def __init__(self, params, load, slip, oil=297.15):
        self.p, self.load, self.slip, self.oil = params, load, slip, oil
        p = params
        square = p.outer_radius**2 - p.inner_radius**2
        self.area = math.pi * square
        self.radius = 2.0 * (p.outer_radius**3 - p.inner_radius**3) / (3.0 * square)
        self.fourth = p.outer_radius**4 - p.inner_radius**4
        self.group = self.fourth - square**2 / math.log(p.outer_radius / p.inner_radius)
        self.count = p.asperity_density * p.asperity_radius * p.roughness
        self.scale = (
            16.0 * math.sqrt(2.0) * math.pi / 15.0 * self.count**2
            * math.sqrt(p.roughness / p.asperity_radius) * p.contact_modulus
        )  # fmt: skip
        self.heat = p.steel_density * p.steel_heat_capacity * self.area * p.steel_thickness / 2.0

    def parts(self, t, u, temperature):
        """Return film rate [1/s], contact and viscous torque [N m]."""
        p, slip, sigma = self.p, self.slip(t), self.p.roughness
        load, eta = self.load(t), oil_viscosity(self.p, temperature)
        pressure, carried = load / self.area, self.scale * height_integral(2.5, u)
        gap = sigma * (u * ndtr(u) + math.exp(-0.5 * u * u) / math.sqrt(2.0 * math.pi))
        flow = (1.0 - 0.9 * math.exp(-0.56 * u)) * (u * sigma) ** 3
        flow += 12.0 * p.permeability * p.lining_thickness
        ease = 2.0 * self.area / (3.0 * math.pi * eta * self.group * p.groove_factor * ndtr(u))
        rate = -ease * flow * (pressure - carried) / sigma
        if pressure < 1e3:
            rate = (p.initial_film / sigma - u) / 0.05
        touching = min(1.0, math.pi**2 * self.count**2 * height_integral(2.0, u))
        mu = friction(p, abs(slip) * self.radius)
        contact = p.faces * mu * min(carried, pressure) * self.area * self.radius
        shear = p.faces * eta * abs(slip) * math.pi / 2.0 * self.fourth / gap * (1.0 - touching)
        return rate, contact, shear

    def torque(self, t, u, temperature):
        _, contact, shear = self.parts(t, u, temperature)
        slip = self.slip(t)
        return contact * math.tanh(slip / self.p.speed_smoothing) + math.copysign(shear, slip)

    def rates(self, t, y):
        p = self.p
        rate, contact, shear = self.parts(t, *y)
        slip = abs(self.slip(t))
        power = slip * (contact * math.tanh(slip / p.speed_smoothing) + shear) / p.faces
        cooling = p.heat_transfer * self.area * (y[1] - self.oil)
        return [rate, (power - cooling) / self.heat]

    def solve(self, times, start=None):
        """Return film ratio and temperature at ``times``; Radau, rtol 1e-10."""
        first = start or [self.p.initial_film / self.p.roughness, self.oil]
        found = solve_ivp(
            self.rates, (times[0], times[-1]), first, method="Radau", rtol=1e-10, atol=1e-9,
            t_eval=times,
        )  # fmt: skip
        assert found.success
        return found.y
