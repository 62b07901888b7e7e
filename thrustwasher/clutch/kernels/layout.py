"""Where the wet clutch keeps its numbers: places in the arrays of parameters, state and work."""

from ...tribology.holding.memory import N_FIGURES, N_MEMORY

# places: P_ of parameters
P_INNER_RADIUS, P_OUTER_RADIUS, P_FACES, P_EFFECTIVE_RADIUS, P_FRICTION_LAW = range(0, 5)
P_FRICTION_DATA, P_FRICTION_SCALE, P_FRICTION_TEMPERATURE = range(5, 8)
P_FRICTION_TEMPERATURE_SLOPE, P_REFERENCE_TEMPERATURE, P_POINT_TEMPERATURE_1 = range(8, 11)
P_POINT_FRICTION_1 = 11
P_CONSTANT_FRICTION, P_TABLE_FRICTION_0, P_TABLE_SPEED_1, P_TABLE_FRICTION_1 = range(20, 24)
P_INDENTATION, P_PLOUGH_WEIGHT, P_HARDNESS_RATIO, P_ADHESION_FACTOR, P_SHEAR_FLOOR = range(32, 37)
P_STICK_SPEED, P_DECAY_SPEED, P_KINK_WIDTH, P_SHEAR_TEMPERATURE_SLOPE, P_ROUGHNESS = range(37, 42)
P_CONTACT_MODULUS, P_ASPERITY_DENSITY, P_ASPERITY_RADIUS, P_LINING_THICKNESS = range(42, 46)
P_PERMEABILITY, P_LAND_SHARE, P_GROOVE_COUNT, P_GROOVE_WIDTH, P_GROOVE_DEPTH = range(46, 51)
P_INITIAL_FILM, P_SEPARATING_FORCE, P_STARTS_PRESSED, P_FILM_DYNAMICS = range(51, 55)
P_SHEAR_HEATING, P_OIL_FLOW, P_OIL_DENSITY, P_OIL_HEAT_CAPACITY, P_OIL_CONDUCTIVITY = range(55, 60)
P_VISCOSITY_CONSTANT, P_VISCOSITY_EXPONENT, P_VISCOSITY_SCALE, P_STEEL_THICKNESS = range(60, 64)
P_STEEL_DENSITY, P_STEEL_HEAT_CAPACITY, P_STEEL_CONDUCTIVITY, P_CONTACT_RISE = range(64, 68)
P_HEAT_TRANSFER, P_SPEED_SMOOTHING, P_INPUT_PROFILE, P_HOLDING, P_COUPLING_INERTIA = range(68, 73)
P_COUPLING_AGE, P_PROBING, P_FIDELITY, N_PARAM = range(73, 77)
# end of places

N_MODES = 8  # of heat conduction across half a steel plate

# Constants behind them.
(
    D_AREA,
    D_RADIUS,
    D_PLOUGH,
    D_ADHESION,
    D_PRESSURE,
    D_CONTACT_AREA,
    D_CAPACITY,
    D_CLOSED_COOLING,
    D_OIL_COOLING,
    D_CLOSING,
    D_SEEPAGE,
    D_VISCOUS,
    D_DEMAND,
    D_SUPPLY,
    D_OPEN_RATIO,
    D_GROOVE_RATIO,
    D_PARTING,
    D_LIFT,
    D_LIFT_SHARE,
    D_PAD_RATIO,
    D_MODES,
    D_TEMPERATURE_LAW,  # what changes friction with temperature: SLOPE_LAW, POINTS_LAW, 0 nothing
    D_POINTS,  # number of points of friction over temperature
    D_POINT_REFERENCE,  # their coefficient at the reference temperature
    D_CONSTANT,  # coefficient of the constant law there
) = range(N_PARAM, N_PARAM + 25)
D_DECAY = N_PARAM + 25  # decay rate [1/s] of each mode, from the second place on
D_GAIN = D_DECAY + 1 + N_MODES  # their rise [K/s] per W into a face
N_PACK = D_GAIN + 1 + N_MODES
# Behind them the rings the pack is resolved into: their number, the place of the first one's
# block, each ring's weight in the squeezed film, then for the level `fine` a block like all of the
# above for each ring. A lumped pack is one ring, whose block is the beginning of ``par`` itself.
MAX_RINGS, N_RINGS = 8, 4  # at most, and those of the level
D_RINGS, D_FIRST, D_SQUEEZE = N_PACK, N_PACK + 1, N_PACK + 2
D_BLOCKS = D_SQUEEZE + MAX_RINGS
NPAR = D_BLOCKS + MAX_RINGS * N_PACK

I_LOAD, I_SPEED, I_OIL, I_DRUM, NINP = range(5)

# The unknowns of a pack: film ratio, energy of a face, then ring by ring the plate's mean
# temperature and its modes, without gaps.
Y_FILM, Y_ENERGY, Y_HEAT = range(3)
N_HEAT = MAX_RINGS * (1 + N_MODES)
NY = Y_HEAT + N_HEAT

# Memory. What has to do with a point in time belongs to the last one whose inputs are known.
S_STARTED, S_FILM, S_ENERGY, S_HEAT = range(4)  # the last three: unknowns in their order
(
    S_SHOWN_TEMPERATURE,
    S_SHOWN_ENERGY,
    S_SHOWN_STORED,
    S_SHOWN_OIL_HEAT,
    S_FIRST,
    S_POWER,
    S_LOAD,
    S_SLIP,
    S_OIL,
    S_DRUM,
    S_DURATION,
    S_SUBSTEP,
    S_CAPACITY,
    S_CAPACITY_CHANGE,
    S_CAPACITY_SPAN,
    S_ADVISED,
    S_MEMORY,  # of the driveline it sits in
) = range(S_HEAT + N_HEAT, S_HEAT + N_HEAT + 17)
NSTATE = S_MEMORY + N_MEMORY

# States of model exchange; a plate's temperature for each ring.
X_FILM, X_BEND, X_ENERGY, X_HEAT = range(4)
N_STATES = X_HEAT + N_RINGS

N_STAGES = 6
W_NOW, W_TRIAL, W_RATE, W_STAGES = 0, NY, 2 * NY, 3 * NY
W_SUBSTEPS = W_STAGES + N_STAGES * NY  # counts: accepted and refused substeps
W_REFUSED = W_SUBSTEPS + 1
W_PROPOSED = W_SUBSTEPS + 2  # size [s] the next substep should have
W_DURATION = W_SUBSTEPS + 3  # the step [s] that all this belongs to
# Slope of the film ratio over the load where it settles with it; how well a face is cooled
# [W/(m2 K)].
W_SETTLED_LOAD, W_COOLING = W_SUBSTEPS + 4, W_SUBSTEPS + 5
# Rates and their slopes at a point: film rate, its slopes over film ratio, load and slip; then for
# each ring the power of a face [W], its slopes over film ratio, temperature, load of the pack, slip
# and drum speed, the slope of the film rate over the ring's temperature, the cooling of a face
# [W/K], its slopes over film ratio and load, the plate's mean temperature above the oil's [K].
R_RATE, R_RATE_U, R_RATE_F, R_RATE_S, R_RINGS = range(5)
(
    R_POWER,
    R_POWER_U,
    R_POWER_T,
    R_POWER_F,
    R_POWER_S,
    R_POWER_D,
    R_RATE_T,
    R_COOL,
    R_COOL_U,
    R_COOL_F,
    R_EXCESS,
    N_OF_RING,
) = range(12)
N_RATES = R_RINGS + MAX_RINGS * N_OF_RING
# They are kept for each stage of the last substep, for where the drift of the rates was read, for a
# neighbouring state, and as changes of the slopes.
W_KEPT = W_SUBSTEPS + 6
DRIFTED, NEIGHBOUR, BENT = N_STAGES, N_STAGES + 1, N_STAGES + 2
W_NEIGHBOUR, W_BENT = W_KEPT + NEIGHBOUR * N_RATES, W_KEPT + BENT * N_RATES
W_VARIED = W_KEPT + (BENT + 1) * N_RATES  # changes of the unknowns with the inputs
W_VARIED_DRIFT, W_VARIED_STAGES = W_VARIED + NY, W_VARIED + 2 * NY
# Interface temperatures of the rings, or their changes; changes of their powers; what a substep's
# linear systems have in common for each ring, and the right side.
W_SURFACE = W_VARIED_STAGES + N_STAGES * NY
(
    W_SURFACE_CHANGE,
    W_POWER_CHANGE,
    W_COOLED,
    W_WARMED,
    W_DIAGONAL,
    W_FILM_PIVOT,
    W_DETERMINANT,
    W_COUPLED,
    W_HELD,
    W_RING_SHARE,  # of the rings in a power that is given
    W_VISCOSITY,  # of the rings' oil [Pa s], and its slopes [Pa s/K]
    W_VISCOSITY_SLOPE,
    W_GIVEN,
) = (W_SURFACE + i * MAX_RINGS for i in range(1, 14))
# 1: the power of a face is given; that at no slip [W], and how it grows with the slip. Then the
# bend of a substep's unknown for the film (rosenbrock), its change, and what it is where the rates
# were taken last.
W_GIVEN_POWER, W_GIVEN_SLOPE, W_BEND, W_BEND_CHANGE = (W_GIVEN + i for i in range(1, 5))
W_BEND_HERE = W_GIVEN + 5
W_PIVOT = W_GIVEN + 6  # 1 over what all stages' systems of a substep divide the heats by
W_MEMORY = W_PIVOT + NY
# The torque that was decided on, its slopes over slip and capacity; that of the bound of a lock
# over the capacity.
W_GIVEN_TORQUE, W_BY_SLIP, W_BY_CAPACITY, W_BOUND_SLOPE = (
    W_MEMORY + N_MEMORY + i for i in range(4)
)
W_TOLD = W_MEMORY + N_MEMORY + 4  # numbers in what a pack says when it cannot hold
W_STATES = W_TOLD + N_FIGURES  # the states of model exchange after a step
NWORK = W_STATES + N_STATES

(
    O_TORQUE,
    O_TEMPERATURE,
    O_FILM,
    O_CAPACITY,
    O_COEFFICIENT,
    O_RATIO,
    O_POWER,
    O_ENERGY,
    O_CONTACT_TORQUE,
    O_VISCOUS_TORQUE,
    O_CONTACT_SHARE,
    O_HEAT_FLUX,
    O_VISCOSITY,
    O_OIL_HEAT,
    O_STORED_HEAT,
    O_ADVISED,
    O_OIL_ENERGY,
    O_PLANT_INERTIA,
    O_SLIP_BOUND,
    NOUT,
) = range(20)
IO_REGIME, IO_STATUS, IO_LOCKED, IO_PLANT_AGE, IO_LOCK_BASIS, NIOUT = range(6)

CLOSED, STRIBECK, FIELD, FINE = 1, 3, 4, 5  # fidelity; 2 had no heat and runs as STRIBECK
CONSTANT_LAW, TABLE_LAW = 2, 3  # friction_law
BOUNDARY_DATA = 2  # friction_data
N_TABLE = 5  # points above standstill
# The table of the start values: slip speeds [m/s], coefficients.
START_SPEED = (0.0, 0.1, 0.5, 2.0, 8.0, 30.0)
START_FRICTION = (0.112, 0.114, 0.118, 0.123, 0.129, 0.126)
WANG_LAW = 1
SLOPE_LAW, POINTS_LAW = 2, 3  # friction_temperature
N_POINTS, NO_POINT = 5, 223.15  # of friction over temperature; K, where a point counts as not given
LINEAR_PROFILE = 2  # input_profile
HOT_LIMIT = 523.0  # K
EXTRAPOLATED_LIMIT = 873.15  # K; above, numbers are no more than an extrapolation
LEAST_RATIO = -3.0  # film ratio below which rough faces are pressed out of the models' reach
OPEN_PRESSURE = 1e3  # Pa; a pack pressed less than this is open
AMBIENT = 1e5  # Pa; oil is drawn apart, and torn, by no more
TEMPERATE = (253.15, 473.15)  # K; beyond, the slope acts no further
