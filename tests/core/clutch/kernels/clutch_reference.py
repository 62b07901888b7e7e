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


def table_friction(p, speed):
    """Coefficient of the table law, straight between its points."""
    at = [0.0, *(getattr(p, f"table_speed_{k}") for k in range(1, 6))]
    return float(np.interp(speed, at, [getattr(p, f"table_friction_{k}") for k in range(6)]))


def warmed(p, temperature):
    """Friction over that at the reference temperature; points: the first three."""
    if p.friction_temperature == "points":
        at = [getattr(p, f"point_temperature_{n}") for n in (1, 2, 3)]
        mu = [getattr(p, f"point_friction_{n}") for n in (1, 2, 3)]
        here, there = np.interp([temperature, p.reference_temperature], at, mu)
        return float(here / there)
    within = min(max(temperature, 253.15), 473.15)
    return math.exp(p.friction_temperature_slope * (within - p.reference_temperature))


def lift(p, u, eta, speed):
    """Pressure [Pa] by which what the grooves pile up before the lands parts the faces."""
    if not p.groove_count:
        return 0.0
    a = math.pi * (p.outer_radius + p.inner_radius) / p.groove_count - p.groove_width
    b, h, d = p.outer_radius - p.inner_radius, max(u, 0.0) * p.roughness, p.groove_depth
    step = 6.0 * eta * speed * d * a / ((h + d) ** 3 * a / p.groove_width + h**3)
    share = sum(math.tanh(min(j * math.pi * a / (2.0 * b), 30.0)) / j**3 for j in range(1, 999, 2))
    share *= 8.0 * b / (math.pi**3 * a)
    share *= p.groove_count * a * b / math.pi / (p.outer_radius**2 - p.inner_radius**2)
    return share * max(0.0, step / 2.0 - 1e5)


def torn(suction):
    """How much faster the faces part than oil that bears any suction lets them."""
    q = suction / 1e5
    if not 2.0 / 3.0 < q < 1.0:
        return 1.0 if q < 1.0 else 85.0
    return 1.0 + 1.0 / (1.0 / (1.0 / (13.5 * q * (1.0 - q) ** 2) - 1.0) + 1.0 / 84.0)


def thinned(p, eta, speed, temperature):
    """Share of the shear stress that oil heated by its own shear keeps; Gavis & Laurence 1968."""
    d = 1e-3
    steep = math.log(oil_viscosity(p, temperature - d) / oil_viscosity(p, temperature + d))
    a = math.sqrt(steep / (2.0 * d) * eta * speed**2 / p.oil_conductivity / 8.0)
    return math.asinh(a) / (a * math.sqrt(1.0 + a * a)) if p.shear_heating and a else 1.0


def pad_factor(p):
    """Squeeze resistance of the pads between the grooves over that of a plain ring."""
    wide = p.outer_radius - p.inner_radius
    long = math.pi * (p.outer_radius + p.inner_radius) / p.groove_count - p.groove_width
    a, b = sorted((wide, long))
    odd = range(1, 4000, 2)
    k = 1.0 - 192.0 * a / (math.pi**5 * b) * sum(
        math.tanh(min(j * math.pi * b / (2.0 * a), 30.0)) / j**5 for j in odd
    )
    square = p.outer_radius**2 - p.inner_radius**2
    group = p.outer_radius**4 - p.inner_radius**4
    group -= square**2 / math.log(p.outer_radius / p.inner_radius)
    return p.groove_count * a**3 * b * k / (1.5 * math.pi * group)


class Reference:
    """Film ratio and temperature of a pack; ``load`` and ``slip`` are functions of time."""

    def __init__(self, params, load, slip, oil=297.15, drum=0.0):
        self.p, self.load, self.slip, self.oil, self.drum = params, load, slip, oil, drum
        p = params
        square = p.outer_radius**2 - p.inner_radius**2
        self.area = math.pi * square
        self.radius = 2.0 * (p.outer_radius**3 - p.inner_radius**3) / (3.0 * square)
        self.fourth = p.outer_radius**4 - p.inner_radius**4
        self.group = self.fourth - square**2 / math.log(p.outer_radius / p.inner_radius)
        self.grooves = pad_factor(p) if p.groove_count else 1.0
        self.count = p.asperity_density * p.asperity_radius * p.roughness
        self.scale = (
            16.0
            * math.sqrt(2.0)
            * math.pi
            / 15.0
            * self.count**2
            * math.sqrt(p.roughness / p.asperity_radius)
            * p.contact_modulus
        )
        self.heat = p.steel_density * p.steel_heat_capacity * self.area * p.steel_thickness / 2.0

    def fill(self, slip, gap, eta):
        """Share of the gap that the supply keeps full against what centrifugal force pumps."""
        p = self.p
        if not p.oil_flow:
            return 1.0
        squares = (self.drum + slip / 2.0) ** 2 + slip**2 / 20.0
        demand = math.pi * p.oil_density * squares * gap**3 * self.area / math.pi
        demand /= 12.0 * eta * math.log(p.outer_radius / p.inner_radius)
        return min(1.0, p.oil_flow / p.faces / demand) if demand else 1.0

    def parts(self, t, u, temperature):
        """Return film rate [1/s], contact and viscous torque [N m], coefficient of cooling."""
        p, slip, sigma = self.p, self.slip(t), self.p.roughness
        load, eta = self.load(t), oil_viscosity(self.p, temperature)
        carried = p.land_share * self.area * self.scale * height_integral(2.5, u)
        gap = sigma * (u * ndtr(u) + math.exp(-0.5 * u * u) / math.sqrt(2.0 * math.pi))
        flow = (1.0 - 0.9 * math.exp(-0.56 * u)) * (u * sigma) ** 3
        flow += 12.0 * p.permeability * p.lining_thickness
        ease = 2.0 / (3.0 * math.pi * eta * self.group * self.grooves * ndtr(u))
        speed, pressed = abs(slip) * self.radius, load >= 1e3 * self.area
        closes = load - carried
        if not pressed:
            parted = p.separating_force + lift(p, u, eta, speed) * self.area
            closes = -carried - parted * (1.0 - u * sigma / p.initial_film)
        rate = -ease * flow * closes / sigma * torn(-closes / self.area)
        least = load if pressed else 1e5 * self.area - 99.0 * load
        share = min(1.0, carried / least)
        normal = min(carried, load + 1e5 * self.area)
        touching = min(1.0, math.pi**2 * self.count**2 * height_integral(2.0, u))
        mu = friction(p, speed) if p.friction_law == "wang" else table_friction(p, speed)
        contact = p.faces * mu * warmed(p, temperature) * normal * self.radius
        open_for = p.land_share / gap * (1.0 - touching)
        open_for += (1.0 - p.land_share) / (gap + p.groove_depth)
        shear = p.faces * eta * abs(slip) * math.pi / 2.0 * self.fourth * open_for
        shear *= thinned(p, eta, speed, temperature) * self.fill(slip, gap, eta)
        if p.friction_data == "total":
            shear *= 1.0 - share
        return rate, contact, shear, self.cooling(share)

    def cooling(self, share):
        """Coefficient [W/(m2 K)] of a face that asperities carry to this share."""
        p, h = self.p, self.p.heat_transfer
        if p.groove_count and p.land_share < 1.0:
            grooves = 4.86 * p.oil_conductivity / (2.0 * p.groove_depth)
            h = share * grooves * (1.0 - p.land_share) + (1.0 - share) * h
        flow = p.oil_density * p.oil_heat_capacity * p.oil_flow / (p.faces * self.area)
        return flow * (1.0 - math.exp(-h / flow)) if flow else h

    def torque(self, t, u, temperature):
        _, contact, shear, _ = self.parts(t, u, temperature)
        slip = self.slip(t)
        return contact * math.tanh(slip / self.p.speed_smoothing) + math.copysign(shear, slip)

    def rates(self, t, y):
        p = self.p
        rate, contact, shear, cooling = self.parts(t, *y)
        slip = abs(self.slip(t))
        power = slip * (contact * math.tanh(slip / p.speed_smoothing) + shear) / p.faces
        return [rate, (power - cooling * self.area * (y[1] - self.oil)) / self.heat]

    def solve(self, times, start=None):
        """Return film ratio and temperature at ``times``; Radau, rtol 1e-10."""
        first = start or [self.p.initial_film / self.p.roughness, self.oil]
        found = solve_ivp(
            self.rates,
            (times[0], times[-1]),
            first,
            method="Radau",
            rtol=1e-10,
            atol=1e-9,
            t_eval=times,
        )
        assert found.success
        return found.y
