"""Where the washer keeps its numbers: places in parameters, memory, work and outputs.

Nodal arrays are indexed ``j * n_r + i`` (angle j, radius i). Temperatures are rises above the oil:
first, column by column, those that vary around the circumference, in the order film, carrier,
washer (n_r each), gear (n_r - i_g nodes), ``per_column`` in all; then, one number per radius,
those of the bodies that turn under the load, their rings. Field x has node (i, j) at
x_at + j x_step + i; the step of a ring is 0. Without oil cooling the film has no temperature of
its own.
"""

from ...tribology.asperities import N_TABLE
from ...tribology.holding.memory import N_FIGURES, N_MEMORY

# Positions: heights [m] of washer and gear, tilts [rad] of the washer about x and y; and the forces
# conjugate to them. Both orders are those of rows and columns of the 4 x 4 systems.
Z_WASHER, Z_GEAR, TILT_X, TILT_Y = range(4)
ON_WASHER, ON_GEAR, MOMENT_X, MOMENT_Y = range(4)

# `par`: parameters, then the fidelity. Behind a property of all bodies come those of carrier,
# washer and gear, 0 where a body has the common one.
# places: P_ of parameters
P_INNER_RADIUS, P_OUTER_RADIUS, P_GEAR_INNER_RADIUS, P_CARRIER_THICKNESS = range(0, 4)
P_WASHER_THICKNESS, P_GEAR_THICKNESS, P_ROUGHNESS, P_ROUGHNESS_CARRIER = range(4, 8)
P_ROUGHNESS_WASHER, P_ROUGHNESS_GEAR, P_YOUNGS_MODULUS, P_YOUNGS_MODULUS_CARRIER = range(8, 12)
P_YOUNGS_MODULUS_WASHER, P_YOUNGS_MODULUS_GEAR, P_POISSON_RATIO = range(12, 15)
P_POISSON_RATIO_CARRIER, P_POISSON_RATIO_WASHER, P_POISSON_RATIO_GEAR = range(15, 18)
P_YIELD_STRENGTH, P_YIELD_STRENGTH_CARRIER, P_YIELD_STRENGTH_WASHER = range(18, 21)
P_YIELD_STRENGTH_GEAR, P_YIELD_STRAIN_LAW, P_ASPERITY_RADIUS, P_ASPERITY_DENSITY = range(21, 25)
P_ASPERITY_HEIGHT_LAW, P_CONDUCTIVITY, P_CONDUCTIVITY_CARRIER, P_CONDUCTIVITY_WASHER = range(25, 29)
P_CONDUCTIVITY_GEAR, P_CONDUCTION, P_GEAR_FAR_FACE, P_OIL_CONDUCTIVITY = range(29, 33)
P_VISCOSITY_CONSTANT, P_VISCOSITY_EXPONENT, P_VISCOSITY_SCALE, P_OIL_COOLING = range(33, 37)
P_OIL_DENSITY, P_OIL_HEAT_CAPACITY, P_OIL_SUPPLY_TEMPERATURE, P_CAVITY_SHEAR = range(37, 41)
P_PRESSURE_FLOW_SHEAR, P_FRICTION_LAW, P_DRY_FRICTION, P_FRICTION_REFERENCE = range(41, 45)
P_FRICTION_SLOPE, P_FRICTION_PRESSURE_MIN, P_FRICTION_PRESSURE_MAX, P_HEAT_SPLIT = range(45, 49)
P_FILM_HEAT_FRACTION, P_THERMAL_MODE, P_DENSITY, P_DENSITY_CARRIER, P_DENSITY_WASHER = range(49, 54)
P_DENSITY_GEAR, P_SPECIFIC_HEAT, P_SPECIFIC_HEAT_CARRIER, P_SPECIFIC_HEAT_WASHER = range(54, 58)
P_SPECIFIC_HEAT_GEAR, P_BODY_STORAGE, P_THERMAL_START, P_HOLDING, P_COUPLING_INERTIA = range(58, 63)
P_COUPLING_AGE, P_OUTSIDE_MAP, P_FIDELITY, N_PARAM = range(63, 67)
# end of places
N_STEADY = P_THERMAL_MODE  # a steady solution depends on those before; what follows is of time
OF_CARRIER, OF_WASHER, OF_GEAR = 1, 2, 3  # places of a body's own property behind the common one
CONTACT_YIELD, SUMMIT_HEIGHTS, CONSTANT_FRICTION = 2.0, 2.0, 2.0  # values of the laws
IN_ALL, ONLY_CARRIER, ONLY_ROTATING = 1.0, 2.0, 3.0  # of conduction
ONLY_LIQUID, LUMPED = 2.0, 2.0  # of cavity_shear and body_storage
INSULATED, BULK = 2.0, 3.0  # of gear_far_face
QUASI_STEADY, TRANSIENT, FROM_OIL = 1.0, 2.0, 2.0
HOLD, REFUSE, SOLVE = 1.0, 2.0, 3.0  # of outside_map
MAP, FIELD, FINE = 1, 3, 4  # fidelity; 2 was coarser and runs as FIELD
# Behind them: nodes, and the radial one at the gear's inner radius; RMS roughness of film 1 and
# gap 2 [m]; (carrier^2 - washer^2)/film 1^2; means and scatters of the summits [m].
(
    D_RADIAL,
    D_AROUND,
    D_GEAR_NODE,
    D_SIGMA1,
    D_SIGMA2,
    D_SHEAR,
    D_MEAN_SUMMIT1,
    D_MEAN_SUMMIT2,
    D_SUMMIT_SIGMA1,
    D_SUMMIT_SIGMA2,
    D_PER_COLUMN,
    D_RINGS,
) = range(N_PARAM, N_PARAM + 12)
D_TABLE1 = N_PARAM + 16  # contact tables of film 1 and gap 2
D_TABLE2 = D_TABLE1 + N_TABLE
D_MESH = D_TABLE2 + N_TABLE  # arrays over the radial nodes, then over the angles
RADIUS, FACE, MIDDLE, LOG_WIDTH, WEIGHT1, WEIGHT2, ALONG, GEAR_WIDTH, N_RADIAL = range(9)
COS, SIN, COS_FACE, SIN_FACE, WEIGHT_T, WIDTH_T, STEP_T, PER_STEP, N_AROUND = range(9)

# `inp`; of the branch there is no input to an FMU.
I_LOAD, I_SPEED, I_TILT, I_OIL, I_FAR_FACE, I_BRANCH = range(6)
NINP = 5

# `out`, in the order of the model's list; behind them what only Python shows.
(
    O_TORQUE,
    O_MEAN,
    O_FILM,
    O_PEAK,
    O_RATIO,
    O_FLUID_SHARE,
    O_COEFFICIENT,
    O_POWER,
    O_OIL_FLOW,
    O_THROUGHFLOW_HEAT,
    O_OIL_HEAT,
    O_OUTLET,
    O_FILM_TEMPERATURE,
    O_STICK_MARGIN,
    O_ENERGY,
    O_STORED_HEAT,
    O_ADVISED,
    O_OIL_ENERGY,
    O_FLUID_LOAD,
    O_CONTACT_LOAD,
) = range(20)
NOUT, N_ALL = 18, 20
IO_REGIME, IO_DISTRESS, IO_STATUS, NIOUT = range(4)
HOT_LIMIT = 523.0  # [K] of the hottest spot; above it oil and washer are lost

# The head of `work`: counts and residuals of a solve, what was found, where the walk along the
# curve of solutions stands, all outputs, the positions.
(
    ITERATIONS,
    FACTORED,
    RESIDUAL,
    REACHED_LOAD,
    LOAD_SLOPE,
    HEAT,
    ARRIVED,
    SCANNED,
    BUDGET,  # iterations at which to give up; 0: none
    N_INFO,
) = range(10)
BRANCH, MULTIPLICITY, LOST, REGAINED, N_FOUND = range(5)  # loads of folds found: nan if not met
# film thickness s [m], load [N], dload/ds [N/m], contact share [-]; tolerance, set by the caller;
# where it got stuck last
AT_FILM, AT_LOAD, AT_SLOPE, AT_SHARE, ACCURACY, STUCK = range(6)
N_CURVE = 8
AT_ENTRY, ON_THE_WAY, AT_A_LOAD = 0.0, 1.0, 2.0
# The whole curve: load of the last point, film thickness and load of the one before; load of the
# highest point since the film was regained, of the lowest since it was lost, and the film thickness
# before it; does the load rise, do points go by load, folds so far; has it begun, is it at its end,
# points of the last call. A fold that was just passed (1: the film is lost, -1: regained, 0: none):
# load and outputs.
(
    CURVE_LOAD,
    BEFORE_FILM,
    BEFORE_LOAD,
    TOP_LOAD,
    TOP_FILM,
    RISES,
    BY_LOAD,
    FOLDS,
    BEGUN,
    ENDED,
    POINTS,
    FOLD,
    FOLD_LOAD,
    FOLD_OUTPUTS,
) = range(14)
N_WHOLE = FOLD_OUTPUTS + N_ALL
AT_MEMORY = N_INFO  # of the driveline, while a step is made
AT_TOLD = AT_MEMORY + N_MEMORY  # numbers in what the washer says of its speed
N_STATES = 10  # of model exchange: `ladder` says which
AT_STATES = AT_TOLD + N_FIGURES  # these after a step in time, but for the energy
AT_FOUND = AT_STATES + N_STATES
AT_CURVE = AT_FOUND + N_FOUND
AT_OUTPUTS = AT_CURVE + N_CURVE
AT_POSITIONS = AT_OUTPUTS + N_ALL
N_HEAD = AT_POSITIONS + 4

# Values of branch and multiplicity, also in memory.
ANY, FILM_BRANCH, UNSTABLE, CONTACT_BRANCH = 0.0, 1.0, 2.0, 3.0
UNKNOWN, SINGLE, MULTIPLE = 0.0, 1.0, 2.0  # is the curve single-valued in load?
GUESSED = 2.0  # of S_VALID: what a map says of a solution; 1: a solution, 0: nothing

# The rest of `work`, ``Fields``. Its tag says what the heat factor was made for: inputs, positions,
# parameters with the grid, conductances outwards; then temperatures.
TAG_VALID, TAG_SPEED, TAG_TILT, TAG_OIL, TAG_POSITIONS, TAG_PARAMETERS = 0, 1, 2, 3, 4, 8
TAG_OUT, TAG_GIVEN = TAG_PARAMETERS + D_SIGMA1, TAG_PARAMETERS + D_SIGMA1 + 3
N_TAG = TAG_GIVEN + 1
# ``Fields.small``, numbers (16: a matrix): contact forces and their slopes; contact force of film 1
# [N] and its slopes; dry friction and its slope over that force [1/N], and the
# coefficient of gap 2.
FORCES, STIFFNESS, CONTACT, CONTACT_SLOPES = 0, 4, 20, 21
FRICTION, FRICTION_SLOPE, FRICTION2 = 25, 26, 27
# Newton's method: forces with the film's, load not subtracted, and slopes; the scaled system and
# its right side; dq/ds along the curve of solutions.
BALANCE, SLOPES, SYSTEM, RIGHT, TANGENT = 32, 36, 52, 68, 76
# Directional derivative: change of the positions, a step of it, the step before, a test; passes.
CHANGE, STEP, STEP_BEFORE, LOOSE, ROUNDS = 108, 112, 116, 120, 124
# Conductances per area from film 1 outwards through carrier, washer and gear [W/(m^2 K)]; 0 for the
# washer in steady state, where it only passes heat on; size of the heat they take [W].
OUT_CARRIER, OUT_WASHER, OUT_GEAR, OUT_SIZE = 125, 126, 127, 128
RING = 129  # 1 if no column of the film is dry, so that the ring is closed
FILM_ERROR = 130  # residual of the film over its largest pressure
RIM_CHANGE = 131  # change of the heat that oil carries over the rims [W], of a derivative
# In time: by what the rises outside of the three bodies fall per kelvin of the oil. Slopes of the
# heat through the far faces of carrier and gear per area, over rise and oil [W/(m^2 K)].
OUT_OIL, FAR_CARRIER, FAR_GEAR = 132, 135, 137
# Of the torque of sliding the share that is given near rest, and its slope over the speed [s/rad].
GIVEN, GIVEN_SLOPE = 139, 140
WARMED = 141  # change of what the three bodies are held at [K], of a derivative
N_SMALL = 144
# Right sides and solutions of the film, node by node: the step at fixed positions, its slopes.
AT_FIXED, OVER_POSITIONS = 0, 1
N_KEPT = 3  # solutions that ``remember`` has room for
N_TERMS = 4  # of the ladder through the thickness of a body

# `state`: last solution, inputs of the last descent (tilt < 0: none), where the factor was made (as
# the tag begins).
S_VALID, S_BRANCH, S_MULTIPLICITY, S_LOAD, S_SPEED, S_TILT, S_OIL = range(7)
S_SCAN_SPEED, S_SCAN_TILT, S_SCAN_OIL, S_POSITIONS = range(7, 11)
S_RATIO, S_FACTOR_VALID, S_FACTOR_SPEED, S_FACTOR_TILT, S_FACTOR_OIL = 14, 16, 17, 18, 19
S_FACTOR_POSITIONS = 20
S_MAP_BRANCH, S_MAP_RATIO = 24, 25  # of the last look-up, 0 if there is none
S_FACTOR_OUT, S_FACTOR_GIVEN = 26, 29  # (3) as OUT_CARRIER; share of the torque that was given
S_SUBSTEP = 30  # the next to try [s]
S_TANGENT, S_LOAD_SLOPE = 31, 35  # dq/ds (4) and dload/ds [N/m] at the last solution, 0: unknown
S_ENERGY, S_STORED_HEAT = 36, 37  # made and stored since the start [J]
S_FAR_FACE = 38  # [K] temperature at the gear's far face
S_MEMORY = 39  # of the driveline the washer sits in
S_FIELDS = (
    S_MEMORY + N_MEMORY
)  # temperatures, pressures, temperatures of the factor, terms of the ladders
