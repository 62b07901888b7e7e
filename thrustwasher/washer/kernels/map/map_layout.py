"""How a washer's map lies in memory: one array of floats, header first, then a line per node.

A line belongs to one speed, tilt and oil temperature and holds the whole curve of solutions over
the film ratio, which is single-valued through both folds. It is cut into ``N_PIECES`` pieces where
the solution has corners: at the onset of contact and at the contact loads ``marks`` at which the
dry friction law has its ends. Each piece holds ``N_CURVES`` Chebyshev polynomials of logarithms:

======  ==========================================================================
GF      fluid load over (viscosity of the oil at its own temperature x |speed|)
GC      contact load
VISCOUS viscous torque over (that viscosity x |speed|)
DRY     dry friction torque over contact load
MEAN    rise of the mean film temperature over the friction power
TOP     rise of the highest temperature over the friction power
======  ==========================================================================

and two short ones, the washer's tilts about x and y over that of the gear, which only Python shows.

All of them stay finite as the speed goes to 0, where the load rests on the asperities.
"""

from ....numerics.chebyshev import N_CELL, N_TERMS

N_PIECES = 5
N_CURVES = 6
GF, GC, VISCOUS, DRY, MEAN, TOP = range(N_CURVES)
THICK = 0  # the piece without contact; its coordinate is the logarithm of the film ratio
N_EDGES = 3  # film ratios at the three marks
STEEPEST = 3  # place in a line: the largest slope d ln(load)/d(film ratio); above 0: folds
N_LINE_HEAD = 4
TILTS, N_TILT_TERMS = N_CURVES * N_TERMS, 4  # place in a piece; coefficients of each of the two
PIECE = TILTS + 2 * N_TILT_TERMS
LINE = N_LINE_HEAD + N_PIECES * PIECE

MAGIC = 5817.0  # kind and version of the layout
KIND, SIZE = 0, 1
PARAMS, N_MAX_PARAMS = 2, 40
AXES = PARAMS + N_MAX_PARAMS  # low, high, patches of asinh(speed/bend), ln(tilt), oil temperature
BEND = AXES + 9  # [rad/s]
LOAD_MIN, LOAD_MAX = AXES + 10, AXES + 11  # [N]
ONSET = AXES + 12  # film ratio above which asperities do not touch
REACH = AXES + 13  # (thickest film ratio)^2 = LEAST_REACH^2 + REACH x viscosity x |speed|
MARKS = AXES + 14  # (3,) contact loads [N] between the pieces
SPEED_MAX = AXES + 17  # [rad/s]; the low end is 0 if the axis begins below FLOOR_SPEED
SIGMA = AXES + 18  # [m] combined roughness of film 1
DATA = AXES + 24  # where the lines begin
ROOM = 520_000  # numbers of the largest map
LEAST_REACH = 6.0
FLOOR_SPEED = 2.0  # [rad/s]; an axis that begins below it serves down to rest
MIDDLE = 0.35  # where the curve between onset and first mark is cut: share below the cut

# scratch of a look-up, in the caller's work
CELL = 0
EDGES = N_CELL  # (N_PIECES + 1,) film ratios from the thick end
STEEP = EDGES + N_PIECES + 1
CURVES = STEEP + 2  # (PIECE,) coefficients of one piece
CHANGE = CURVES + PIECE  # (PIECE,) their change along a direction
HEAD = CHANGE + PIECE  # (N_LINE_HEAD,) scratch
SPARE = HEAD + N_LINE_HEAD  # (PIECE,) one contraction
N_LOOK_UP = SPARE + PIECE
