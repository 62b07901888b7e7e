"""Viscosity of an oil over temperature: ASTM D341, and the laws that the models have.

A viscosity is measured at two or three temperatures; the models have laws of three constants. Three
points give these exactly. To two a third is added on the line of ASTM D341 through both,
log log(nu + 0.7 mm2/s) over log T, half their distance below the colder one. A law of which the
whole line is known is fitted to it so that its largest relative error is smallest.
"""

import math
from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise

from ..errors import ParameterError

Points = Sequence[tuple[float, float]]  # temperature [K] and viscosity [Pa s], the coldest first
Constants = tuple[float, float, float]
Law = tuple[str, str, str]  # its parameters: ROELANDS or VOGEL
ZERO = 273.15  # K
ROELANDS: Law = ("viscosity_scale", "viscosity_constant", "viscosity_exponent")
VOGEL: Law = ("viscosity_scale", "viscosity_b", "viscosity_c")
EXPONENTS = (0.05, 6.0)  # of Roelands' law, looked through
HALVINGS = 60
FITTED = (293.15, 423.15)  # K, where a law is fitted to ASTM D341
STEPS = 65  # of 2 K each
RANGES = {ROELANDS: (0.2, 3.0), VOGEL: (60.0, 400.0)}  # of the last constant
EXCHANGES, SECTIONS, GOLDEN = 20, 40, 0.5 * (math.sqrt(5.0) - 1.0)


def walther(nu: float) -> float:
    """Return the ordinate of ASTM D341 of a kinematic viscosity [m2/s], above 0.3 mm2/s.

    It leaves out the term of viscosities below 2 mm2/s, which is worth 0.1 % there.
    """
    return math.log10(math.log10(1e6 * nu + 0.7))


def kinematic_viscosity(at_40: float, at_100: float, temperature: float) -> float:
    """Return the kinematic viscosity [m2/s] of ASTM D341 from those at 40 and 100 degC."""
    y_cold, y_warm = walther(at_40), walther(at_100)
    share = math.log(temperature / 313.15) / math.log(373.15 / 313.15)
    return float(1e-6 * (10.0 ** (10.0 ** (y_cold + share * (y_warm - y_cold))) - 0.7))


def density(at_15: float, temperature: float) -> float:
    """Return the density [kg/m3] of a lubricating oil from that at 15 degC.

    Source: API MPMS 11.1 (ASTM D1250), lubricating oils: K_1 = 0.34878 per degF, K_0 = 0.
    """
    rise = 0.34878 * 1.8 / at_15 * (temperature - 288.15)
    return at_15 * math.exp(-rise * (1.0 + 0.8 * rise))


def three_points(points: Points, density: float) -> Points:
    """Return three points of a viscosity; to two ASTM D341 gives the third.

    ParameterError unless it falls as the oil warms up.
    """
    known = sorted(points)
    if not 2 <= len(known) <= 3:
        raise ParameterError(f"viscosity: {len(known)} points, allowed: 2 or 3")
    for (cold, thick), (warm, thin) in pairwise(known):
        if not (warm > cold and thick > thin > 0.0):
            raise ParameterError(
                f"viscosity = {thin:.6g} Pa.s at {warm - ZERO:.6g} degC, allowed: above 0 and "
                f"below that at {cold - ZERO:.6g} degC ({thick:.6g} Pa.s)"
            )
    if len(known) == 3:
        return known
    (cold, thick), (warm, thin) = known
    third = cold - 0.5 * (warm - cold)
    if not thin / density > 0.3e-6:
        raise ParameterError(
            f"viscosity = {thin:.6g} Pa.s at {warm - ZERO:.6g} degC, allowed with two points: "
            f"above {0.3e-6 * density:.3g} Pa.s (ASTM D341); give three"
        )
    y_cold, y_warm = (walther(x / density) for x in (thick, thin))
    slope = (y_cold - y_warm) / math.log10(cold / warm)
    y = y_cold + slope * math.log10(third / cold)
    return [(third, 1e-6 * density * (10.0 ** (10.0**y) - 0.7)), *known]


def roelands(points: Points) -> Constants:
    """Return scale [Pa s], G_o and S_o of mu = scale 10^(G_o x^-S_o), x = 1 + T/135 degC."""
    x = [1.0 + (t - ZERO) / 135.0 for t, _ in points]
    y = [math.log(viscosity) for _, viscosity in points]
    required = (y[0] - y[1]) / (y[1] - y[2])

    def ratio(s: float) -> float:
        return float((x[0] ** -s - x[1] ** -s) / (x[1] ** -s - x[2] ** -s))

    s = _bisect(lambda s: ratio(s) - required, *EXPONENTS) if x[0] > 0.0 else math.nan
    if not s > 0.0:
        raise _no_law(points)
    height = (y[0] - y[1]) / (x[0] ** -s - x[1] ** -s)
    return math.exp(y[0] - height * x[0] ** -s), height / math.log(10.0), s


def vogel(points: Points) -> Constants:
    """Return scale [Pa s], b [K] and c [K] of mu = scale exp(b/(T + c)), T in degC."""
    t = [temperature - ZERO for temperature, _ in points]
    y = [math.log(viscosity) for _, viscosity in points]
    q = (y[0] - y[1]) * (t[2] - t[1]) / ((y[1] - y[2]) * (t[1] - t[0]))
    if not q > 1.0:
        raise _no_law(points)
    c = (t[2] - q * t[0]) / (q - 1.0)
    b = (y[0] - y[1]) * (t[0] + c) * (t[1] + c) / (t[1] - t[0])
    return math.exp(y[0] - b / (t[0] + c)), b, c


def law_viscosity(law: Law, constants: Constants, temperature: float) -> float:
    """Return the viscosity [Pa s] of a law."""
    scale, size, last = constants
    base = 10.0 if law == ROELANDS else math.e
    return float(scale * base ** (size * _abscissa(law, last, temperature)))


@cache
def fitted(law: Law, at_40: float, at_100: float, at_15: float) -> Constants:
    """Return the constants of a law whose largest relative error to ASTM D341 is smallest.

    ``at_40``, ``at_100``: kinematic viscosities [m2/s]; ``at_15``:
    density [kg/m3]. Over ``FITTED``. With the last constant held log viscosity is a straight line
    over a function of the temperature; its best place is looked for by golden section.
    """
    low, high = FITTED
    grid = [low + (high - low) * i / STEPS for i in range(STEPS + 1)]
    y = [math.log(kinematic_viscosity(at_40, at_100, t) * density(at_15, t)) for t in grid]

    def line(last: float) -> Constants:
        return level_line([_abscissa(law, last, t) for t in grid], y)

    a, b = RANGES[law]
    for _ in range(SECTIONS):
        c, d = b - GOLDEN * (b - a), a + GOLDEN * (b - a)
        a, b = (a, d) if line(c)[2] < line(d)[2] else (c, b)
    last = 0.5 * (a + b)
    height, slope, _ = line(last)
    return math.exp(height), slope / (math.log(10.0) if law == ROELANDS else 1.0), last


def _abscissa(law: Law, last: float, temperature: float) -> float:
    """Return that over which the log of a law's viscosity is a straight line."""
    t = temperature - ZERO
    return float((1.0 + t / 135.0) ** -last) if law == ROELANDS else 1.0 / (t + last)


def level_line(x: Sequence[float], y: Sequence[float]) -> Constants:
    """Return height and slope of the line with the smallest maximum error, and that error.

    The points are in the order of ``x``. At three of them the errors are equally large with
    alternating signs (Chebyshev); the one that errs most takes the place of one of these.
    """
    at = [0, len(x) // 2, len(x) - 1]
    for _ in range(EXCHANGES):
        i, j, k = at
        slope = (y[k] - y[i]) / (x[k] - x[i])
        level = 0.5 * (y[j] - y[i] - slope * (x[j] - x[i]))
        height = y[i] + level - slope * x[i]
        rest = [v - height - slope * u for u, v in zip(x, y, strict=True)]
        worst = max(range(len(x)), key=lambda n: abs(rest[n]))
        if abs(rest[worst]) <= abs(level) * (1.0 + 1e-9) or worst in at:
            break
        place = sum(worst > n for n in at)  # between which two of the three it lies
        same = [n for n in (place - 1, place) if 0 <= n <= 2 and rest[at[n]] * rest[worst] > 0.0]
        if same:
            at[same[0]] = worst
        else:  # outside, of the other sign: the one at the far end goes
            at = [worst, *at[:2]] if place == 0 else [*at[1:], worst]
    return height, slope, abs(rest[worst])


def _bisect(rising: Callable[[float], float], low: float, high: float) -> float:
    """Return the zero of a rising function, nan if it has none in between."""
    if not rising(low) <= 0.0 <= rising(high):
        return math.nan
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if rising(middle) > 0.0 else (middle, high)
    return 0.5 * (low + high)


def _no_law(points: Points) -> ParameterError:
    given = ", ".join(f"{x:.6g} Pa.s at {t - ZERO:.6g} degC" for t, x in points)
    return ParameterError(
        f"viscosity = {given}, allowed: points of an oil, log viscosity falls ever more slowly"
    )
