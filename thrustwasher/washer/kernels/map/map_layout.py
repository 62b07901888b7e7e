"""How a washer's map lies in memory: one array of floats, header first, then a line per node.

A line belongs to one speed, tilt and oil temperature and holds the whole curve of solutions over
the film ratio, which is single-valued through both folds. It is cut into ``N_PIECES`` pieces where
the solution has corners: at the onset of contact and at the contact loads ``marks`` at which the
dry friction law has its ends. Each piece holds ``N_CURVES`` Chebyshev polynomials of logarithms:

=======  =========================================================================
GF       fluid load over (viscosity of the oil at its own temperature x |speed|)
GC       contact load
DRY      dry friction torque over contact load
VISCOUS  viscous torque over (that viscosity x |speed|)
MEAN     rise of the mean wall temperature over the friction power
TOP      rise of the highest temperature over the friction power
FILM     rise of the film's own mean temperature over the friction power
FLOW     oil flow over |speed|
CARRIED  heat that this oil carries over (friction power x |speed|); 0 without oil cooling
GRIP     mean radius at which gap 2 presses, weighted with its pressure
=======  =========================================================================

and two short ones, the washer's tilts about x and y over that of the gear, which only Python shows.
In each piece the first four have ``TERMS`` coefficients, the others ``MORE_TERMS``.

All of them stay finite as the speed goes to 0, where the load rests on the asperities.
"""

from ....numerics.chebyshev import MOST_TERMS, N_CELL

N_PIECES = 5
N_CURVES = 10
GF, GC, DRY, VISCOUS, MEAN, TOP, FILM, FLOW, CARRIED, GRIP = range(N_CURVES)
N_MAIN = 4  # the curves of load and torque come first
N_MORE = N_CURVES - N_MAIN
THICK = 0  # the piece without contact; its coordinate is the logarithm of the film ratio
N_EDGES = 3  # film ratios at the three marks
STEEPEST = 3  # place in a line: the largest slope d ln(load)/d(film ratio); above 0: folds
N_LINE_HEAD = 4
N_TILT_TERMS = 4  # coefficients of each of the two tilts, at the end of a piece
N_TILTS = 2 * N_TILT_TERMS

MAGIC = 5818.0  # kind and version of the layout
KIND, SIZE = 0, 1
PARAMS, N_MAX_PARAMS = 2, 56
AXES = PARAMS + N_MAX_PARAMS  # low, high, patches of asinh(speed/bend), ln(tilt), -ln(viscosity)
BEND = AXES + 9  # [rad/s]
BOX = BEND + 1  # (8,) low and high of load, |speed|, tilt, oil temperature
ONSET = BOX + 8  # film ratio above which asperities do not touch
REACH = ONSET + 1  # (thickest film ratio)^2 = LEAST_REACH^2 + REACH x viscosity x |speed|
MARKS = REACH + 1  # (3,) contact loads [N] between the pieces
SIGMA = MARKS + 3  # [m] combined roughness of film 1
TERMS = SIGMA + 1  # (N_PIECES,) coefficients of the main curves
MORE_TERMS = TERMS + N_PIECES  # (N_PIECES,) of the other curves
PIECE_AT = MORE_TERMS + N_PIECES  # (N_PIECES + 1,) where pieces begin in a line; its length
IDENTITY = PIECE_AT + N_PIECES + 1  # a checksum, by which kept work is known to be this map's
DATA = IDENTITY + 1  # where the lines begin
ROOM = 520_000  # numbers of the largest map
LEAST_REACH = 6.0
FLOOR_SPEED = 0.5  # [rad/s]; an axis that begins below it serves down to rest
MIDDLE = 0.35  # where the curve between onset and first mark is cut: share below the cut

# scratch of a look-up, in the caller's work
WIDTH = 16  # numbers are interpolated by so many, which fills vector registers
MOST = N_CURVES * MOST_TERMS + N_TILTS  # numbers of the largest piece
CELL = 0
EDGES = N_CELL  # (N_PIECES + 1,) film ratios from the thick end
STEEP = EDGES + N_PIECES + 1
BEST = STEEP + 1
TAG = BEST + 1  # (4,) what is interpolated: identity of the map, |speed|, tilt, oil temperature
SCALE = TAG + 4  # viscosity x |speed| there
READ = SCALE + 1  # (N_PIECES,) how much of each piece is interpolated
HEAD = READ + N_PIECES  # (N_LINE_HEAD,)
HEAD_CHANGE = HEAD + N_LINE_HEAD  # (N_LINE_HEAD,)
LOGS = HEAD_CHANGE + N_LINE_HEAD  # (N_CURVES,) change of each curve along a direction
CURVES = LOGS + N_CURVES  # (N_PIECES, MOST) coefficients of the pieces
CHANGE = CURVES + N_PIECES * MOST  # (MOST,) their change along a direction
N_LOOK_UP = CHANGE + MOST
# then where a solution lies
AT_PIECE, AT_U, AT_RATIO, AT_SCALE, N_PLACE = range(5)
