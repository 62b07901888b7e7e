"""Where the washer keeps its numbers: places in parameters, memory, work and outputs.

Nodal arrays are indexed ``j * n_r + i`` (angle j, radius i). Temperatures are rises above the oil,
column by column: carrier, washer (n_r each), then gear (n_r - i_g nodes), ``m_t`` in all.
"""

from ...tribology.asperities import N_TABLE

# Positions: heights [m] of washer and gear, tilts [rad] of the washer about x and y; and the forces
# conjugate to them. Both orders are those of rows and columns of the 4 x 4 systems.
Z_WASHER, Z_GEAR, TILT_X, TILT_Y = range(4)
ON_WASHER, ON_GEAR, MOMENT_X, MOMENT_Y = range(4)

# `par`: parameters in the order of WasherParams, then the fidelity.
(
    P_INNER_RADIUS, P_OUTER_RADIUS, P_GEAR_INNER_RADIUS, P_CARRIER_THICKNESS, P_WASHER_THICKNESS,
    P_GEAR_THICKNESS, P_ROUGHNESS, P_ROUGHNESS_CARRIER, P_ROUGHNESS_WASHER, P_ROUGHNESS_GEAR,
    P_YOUNGS_MODULUS, P_POISSON_RATIO, P_YIELD_STRENGTH, P_YIELD_STRAIN_LAW, P_ASPERITY_RADIUS,
    P_ASPERITY_DENSITY, P_ASPERITY_HEIGHT_LAW, P_CONDUCTIVITY, P_CONDUCTION, P_OIL_CONDUCTIVITY,
    P_VISCOSITY_CONSTANT, P_VISCOSITY_EXPONENT, P_VISCOSITY_SCALE, P_FRICTION_LAW, P_DRY_FRICTION,
    P_FRICTION_CONSTANT, P_FRICTION_SLOPE, P_FRICTION_LOAD_MIN, P_FRICTION_LOAD_MAX, P_HEAT_SPLIT,
    P_FILM_HEAT_FRACTION, P_THERMAL_MODE, P_DENSITY, P_SPECIFIC_HEAT, P_THERMAL_START, P_FIDELITY,
) = range(36)  # fmt: skip
N_PARAM = 36
N_STEADY = P_THERMAL_MODE  # a steady solution depends on those before; what follows is of time
CONTACT_YIELD, SUMMIT_HEIGHTS, CONSTANT_FRICTION = 2.0, 2.0, 2.0  # values of the laws
ONLY_CARRIER, ONLY_ROTATING = 2.0, 3.0  # of conduction
QUASI_STEADY, TRANSIENT, FROM_OIL = 1.0, 2.0, 2.0
CLOSED, STRIBECK, MAP, COARSE, FIELD, FINE = range(1, 7)
# Behind them: nodes, and the radial one at the gear's inner radius; RMS roughness of film 1 and
# gap 2 [m]; (carrier^2 - washer^2)/film 1^2; means and scatters of the summits [m].
(
    D_RADIAL, D_AROUND, D_GEAR_NODE, D_SIGMA1, D_SIGMA2, D_SHEAR, D_MEAN_SUMMIT1, D_MEAN_SUMMIT2,
    D_SUMMIT_SIGMA1, D_SUMMIT_SIGMA2,
) = range(N_PARAM, N_PARAM + 10)  # fmt: skip
D_TABLE1 = N_PARAM + 16  # contact tables of film 1 and gap 2
D_TABLE2 = D_TABLE1 + N_TABLE
D_MESH = D_TABLE2 + N_TABLE  # arrays over the radial nodes, then over the angles; or the wedge's
RADIUS, FACE, LOG_WIDTH, WEIGHT1, WEIGHT2, ALONG, GEAR_WIDTH = range(7)
N_RADIAL = 7
COS, SIN, COS_FACE, SIN_FACE, WEIGHT_T, WIDTH_T, STEP_T, PER_STEP = range(8)
N_AROUND = 8
N_PANEL = 12  # Gauss nodes of a panel; the wedge has two: distances, areas, moments
N_WEDGE = 2 * N_PANEL
DISTANCE, AREA, MOMENT = range(3)

# `inp`; of the branch there is no input to an FMU.
I_LOAD, I_SPEED, I_TILT, I_OIL, I_BRANCH = range(5)
NINP = 4

# `out`, in the order of the model's list; behind them what only Python shows.
(
    O_TORQUE, O_MEAN, O_FILM, O_PEAK, O_RATIO, O_FLUID_SHARE, O_COEFFICIENT, O_POWER,
    O_FLUID_LOAD, O_CONTACT_LOAD,
) = range(10)  # fmt: skip
NOUT, N_ALL = 8, 10
IO_REGIME, IO_DISTRESS, IO_STATUS = range(3)
NIOUT = 3

# The head of `work`: counts and residuals of a solve, what was found, where the walk along the
# curve of solutions stands, all outputs, the positions.
ITERATIONS, FACTORED, RESIDUAL, REACHED_LOAD, LOAD_SLOPE, HEAT, ARRIVED, SCANNED = range(8)
N_INFO = 8
BRANCH, MULTIPLICITY, LOST, REGAINED = range(4)  # loads of the folds found: nan if not met
N_FOUND = 4
# film thickness s [m], load [N], dload/ds [N/m], contact share [-]; tolerance, set by the caller
AT_FILM, AT_LOAD, AT_SLOPE, AT_SHARE, ACCURACY = range(5)
N_CURVE = 8
AT_FOUND = N_INFO
AT_CURVE = AT_FOUND + N_FOUND
AT_OUTPUTS = AT_CURVE + N_CURVE
AT_POSITIONS = AT_OUTPUTS + N_ALL
N_HEAD = AT_POSITIONS + 4

# Values of branch and multiplicity, also in memory.
ANY, FILM_BRANCH, UNSTABLE, CONTACT_BRANCH = 0.0, 1.0, 2.0, 3.0
UNKNOWN, SINGLE, MULTIPLE = 0.0, 1.0, 2.0  # is the curve single-valued in load?

# The rest of `work`, ``Fields``. Its tag says what the heat factor was made for: inputs, positions,
# parameters with the grid, rate of storage; then temperatures.
TAG_VALID, TAG_SPEED, TAG_TILT, TAG_POSITIONS, TAG_OIL, TAG_PARAMETERS = 0, 1, 2, 3, 7, 8
TAG_RATE, N_TAG = 47, 48
# ``Fields.small``, numbers (16: a matrix): contact forces and their slopes; contact force of film 1
# [N] and its slopes; dry friction and its slope over that force [1/N]; 1 once the Jacobian of the
# forces is that of the last evaluation.
FORCES, STIFFNESS, CONTACT, CONTACT_SLOPES = 0, 4, 20, 21
FRICTION, FRICTION_SLOPE, JACOBIAN_READY = 25, 26, 27
# Newton's method: forces with the film's, load not subtracted, and slopes; the scaled system and
# its right side; dq/ds along the curve of solutions.
BALANCE, SLOPES, SYSTEM, RIGHT, TANGENT = 32, 36, 52, 68, 76
# Slopes of the forces over the positions, temperatures following by ``Fields.following``; over
# speed, tilt and oil temperature (4 each).
FORCE_SLOPES, OVER_SPEED, OVER_TILT, OVER_OIL = 80, 96, 100, 104
# Directional derivative: change of the positions, a step of it, the step before, a test; passes.
CHANGE, STEP, STEP_BEFORE, LOOSE, ROUNDS = 108, 112, 116, 120, 124
RATE = 125  # [1/s] that storage weighs heat with; 0: steady
STORED = 126  # [W] size of the heat that goes into storage
RING = 127  # 1 if no column of the film is dry, so that the ring is closed
N_SMALL = 128
# Right sides and solutions of the film, node by node: the step at fixed positions, its slopes.
AT_FIXED, OVER_POSITIONS = 0, 1
N_PRESSED = 3  # of the forces: the film presses on all but the gear
N_KEPT = 3  # solutions that ``remember`` has room for

# `state`: last solution, inputs of the last descent (tilt < 0: none), where the factor was made.
S_VALID, S_BRANCH, S_MULTIPLICITY, S_LOAD, S_SPEED, S_TILT, S_OIL = range(7)
S_SCAN_SPEED, S_SCAN_TILT, S_SCAN_OIL, S_POSITIONS = range(7, 11)
S_RATIO, S_FACTOR_VALID, S_FACTOR_SPEED, S_FACTOR_TILT, S_FACTOR_OIL = 14, 16, 17, 18, 19
S_FACTOR_POSITIONS = 20
S_MAP_BRANCH, S_MAP_RATIO = 24, 25  # of the last look-up, 0 if there is none
S_FACTOR_RATE, S_SUBSTEP = 26, 27  # the next substep to try [s]
S_FIELDS = 32  # temperatures, pressures, temperatures of the factor
