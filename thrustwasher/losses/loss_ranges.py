"""The ranges of the empirical laws of churning, bearings and seals."""

import math

from ..model.advice import LawRange
from .kernels import loss_laws as laws

LEAST_DEPTH, MOST_DEPTH = 0.1, 0.5  # over diameter
LEAST_LEFT = 0.1  # of a bearing's viscous torque, from which on it is no longer most of its drag
EXTRAPOLATED = "its loss is extrapolated"
TESTS = "estimate; the tables of the tests were not at hand"
CHURNING = "the laws of churning"
FROUDE = LawRange(CHURNING, "Froude number", "", laws.LEAST_FR, laws.MOST_FR, EXTRAPOLATED, TESTS)
REYNOLDS = LawRange(
    CHURNING, "Reynolds number", "", laws.LEAST_RE, laws.MOST_RE, EXTRAPOLATED, TESTS
)
DEPTH = LawRange(CHURNING, "depth over diameter", "", LEAST_DEPTH, MOST_DEPTH, EXTRAPOLATED, TESTS)
STARVED = LawRange(
    "the viscous torque of bearings",
    "share left by heat and starvation",
    "",
    LEAST_LEFT,
    math.inf,
    "drag of the oil around them, which is not in the law, may be more",
    "chosen here",
)
FAST = LawRange(
    "the torque of bearings",
    "speed times mean diameter",
    "mm/min",
    -math.inf,
    1e6,
    "cages slide and the oil around them drags",
    "rule of thumb for fast bearings, from memory",
)
BRACKET = LawRange(
    "the formula of seals",
    "its bracket",
    "",
    laws.LEAST_SEAL,
    math.inf,
    "their loss is an estimate",
    "chosen here; the formula falls to 0 and below",
)
RUBBING = LawRange(
    "the formula of seals",
    "speed of the lip",
    "m/s",
    -math.inf,
    38.0,
    "no lip of rubber runs so fast",
    "limit of fluororubber in DIN 3760 and catalogues, from memory",
)
PALMGREN = "Palmgren's law of bearings"
LIGHT_LOAD = LawRange(
    PALMGREN,
    "load over C",
    "",
    0.02,
    math.inf,
    "it may be off by several times, too large of ball bearings",
    "compared with SKF's model",
)
MIXED = LawRange(
    PALMGREN,
    "viscosity ratio kappa",
    "",
    1.0,
    math.inf,
    "mixed friction is left out, the torque may be several times it",
    "kappa of ISO 281",
)
OTHER_LAW = "; bearing_law = skf counts it"
LAW_RANGES = (FROUDE, REYNOLDS, DEPTH, STARVED, FAST, LIGHT_LOAD, MIXED, BRACKET, RUBBING)


def viscosity_ratio(speed: float, nu: float, diameter: float) -> float:
    """Return kappa of a bearing: kinematic viscosity [m2/s] over the required one of ISO 281.

    ``speed`` [rad/s], above 0; mean ``diameter`` [m].
    """
    n, d = speed * 30.0 / math.pi, 1e3 * diameter
    required = 45000.0 * n**-0.83 if n < 1000.0 else 4500.0 * n**-0.5
    return float(1e6 * nu * math.sqrt(d) / required)
