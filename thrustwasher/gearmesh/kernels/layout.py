"""Where each number of the gear mesh lies in its arrays."""

from ...tribology.holding.memory import N_FIGURES, N_MEMORY

# places: P_ of parameters
P_GEAR_RATIO, P_PINION_TEETH, P_CENTRE_DISTANCE, P_NORMAL_MODULE, P_PRESSURE_ANGLE = range(0, 5)
P_HELIX_ANGLE, P_INTERNAL, P_ADDENDUM, P_ADDENDUM_GEAR, P_FACE_WIDTH, P_LOAD_FACTOR = range(5, 11)
P_LOAD_SHARE, P_SURFACE, P_SIGMA_RMS, P_EFFECTIVE_ROUGHNESS, P_MEAN_ROUGHNESS = range(11, 16)
P_FRICTION_LAW, P_F0, P_CONSTANT_FRICTION, P_EYRING_STRESS, P_FILM_HEAT = range(16, 21)
P_THERMAL_MODE, P_THERMAL_START, P_BULK_CONDUCTANCE, P_BULK_HEAT_CAPACITY = range(21, 25)
P_LUBRICATION_FACTOR, P_MATES_PINION, P_MATES_GEAR, P_STEEL, P_CONTACT_LIMIT = range(25, 30)
P_STRUCTURAL_FACTOR, P_FZG_STAGE, P_PERMISSIBLE_FILM_RATIO, P_YOUNGS_MODULUS = range(30, 34)
P_POISSON_RATIO, P_CONDUCTIVITY, P_HEAT_CAPACITY, P_DENSITY, P_THERMAL_EXPANSION = range(34, 39)
P_OIL_CONDUCTIVITY, P_OIL_HEAT_CAPACITY, P_OIL_DENSITY, P_VISCOSITY_SCALE = range(39, 43)
P_VISCOSITY_B, P_VISCOSITY_C, P_VISCOSITY_AT, P_FILM_VISCOSITY, P_PRESSURE_VISCOSITY = range(43, 48)
P_HEAT_PARTITION, P_PARTITION_SHARE, P_TRACTION_LAW, P_LIMITING_TRACTION = range(48, 52)
P_ASPERITY_GROUP, P_HARDNESS_FACTOR, P_AREA_LAW, P_AREA_RATIO, P_SWITCH = range(52, 57)
P_ASPERITY_BASE, P_SPEED_SMOOTHING, P_PROFILE_SHIFT_PINION, P_PROFILE_SHIFT_GEAR = range(57, 61)
P_WORKING_CENTRE_DISTANCE, P_PROFILE_SHIFT_GEAR_FROM_DISTANCE, P_TIP_DIAMETER_PINION = range(61, 64)
P_TIP_DIAMETER_GEAR, P_TIP_SHORTENING, P_ROOT_LIMIT, P_TOOL_ADDENDUM = range(64, 68)
P_TOOL_TIP_RADIUS, P_REVERSED_BENDING, P_FACE_LOAD_FACTOR, P_MESH_LOAD_FACTOR = range(68, 72)
P_LOAD_SHARING, P_STIFFNESS_AT_ENDS, P_TIP_RELIEF_PINION, P_TIP_RELIEF_GEAR = range(72, 76)
P_TIP_RELIEF_LENGTH_PINION, P_TIP_RELIEF_LENGTH_GEAR, P_BASE_OIL, P_FRICTION_SCALE = range(76, 80)
P_BOUNDARY_FRICTION, P_MATERIAL_GEAR, P_YOUNGS_MODULUS_GEAR, P_POISSON_RATIO_GEAR = range(80, 84)
P_CONDUCTIVITY_GEAR, P_HEAT_CAPACITY_GEAR, P_DENSITY_GEAR, P_CONTACT_LIMIT_GEAR = range(84, 88)
P_ROOT_LIMIT_GEAR, P_EFFICIENCY, P_EFFICIENCY_BACK, P_HOLDING, P_COUPLING_INERTIA = range(88, 93)
P_COUPLING_AGE, P_FIDELITY, N_PARAM = range(93, 96)
# end of places
# Constants that derive() adds: geometry per unit of speed and torque, surface, material; then what
# a mesh heated by its loss needs: section, loads per torque, limits, body, extremes of the path.
(
    D_START,
    D_SLIDE_ROLL,
    D_RADIUS,
    D_LINE,
    D_V1,
    D_V2,
    D_SLIDING,
    D_ROLLING,
    D_PITCH_RADIUS,
    D_LOSS,
    D_THETA,
    D_CAPACITY,
    D_OIL_CAPACITY,
    D_EFFUSIVITY,
    D_SIGMA,
    D_ROUGHNESS,
    D_MEAN,
    D_SHARE,
    D_CONTACT_RATIO,
    D_SIDE,
    D_CENTRE,
    D_ANGLE,
    D_COS_BASE,
    D_OVERLAP,
    D_APPROACH,
    D_RECESS,
    D_SLIDE,
    D_LOAD,
    D_UNIT_LOAD,
    D_PITTING,
    D_LIMIT,
    D_SCUFFING,
    D_CONDUCTANCE,
    D_STILL,
    D_BULK_CAPACITY,
    D_HOTTEST,
    D_FLASH_MOST,
    D_PRESSURE_MOST,
    D_ROOT_PINION,
    D_ROOT_GEAR,
    D_ROOT_USED,
    D_FACTOR,
    D_HELICAL,
    D_FLASH_FACTOR,
    D_LIMIT_GEAR,
    D_PITTING_USED,
    D_MODULUS_GEAR,
    D_POISSON_GEAR,
    D_EFFUSIVITY_GEAR,
    D_CAPACITY_GEAR,
    D_LOSS_SPUR,
    D_GF_FRICTION,
    D_GF_RISE,
    D_BUTTRESS,
    D_GF_PLACES,
    D_HOT_RADIUS,
    D_HOT_ROLLING,
    D_HOT_SLIDING,
    D_HOT_SHARE,
    D_HOT_FILM,
    D_ALPHA,
    D_LOST_IN,
    D_LOST_OUT,
    D_PLACES,
) = range(N_PARAM, N_PARAM + 64)
# The line of action: positions from the pitch point in base pitches, shares of the load that the
# pair there bears, shares of the loss; D_PLACES is the number of positions. Where the loss heats,
# also lengths and, per root of load and speed, flash of a friction of 1, film, mean pressure; then
# of the D_GF_PLACES positions that may have the thinnest film against micropitting their numbers,
# logarithms of the film, flash of a friction of 1.
N_PATH = 160
D_POSITION = D_PLACES + 1
D_PATH_SHARE, D_PATH_LOSS, D_PATH_LENGTH, D_PATH_FLASH, D_PATH_FILM, D_PATH_PRESSURE, D_GF = (
    D_POSITION + i * N_PATH for i in range(1, 8)
)
N_GF = 24
D_GF_FILM, D_GF_FLASH, NPAR = (D_GF + i * N_GF for i in range(1, 4))
I_LOAD, I_SPEED, I_OIL, NINP = range(4)
# Memory: whether a step was made, temperature of the bodies [K]; heat stored since then and gone
# into the oil [J]; the driveline that the mesh sits in.
S_STARTED, S_BULK, S_STORED, S_OIL_ENERGY, S_MEMORY = range(5)
NSTATE = S_MEMORY + N_MEMORY
# What is known of one operating point; the real outputs come first, in their order.
(
    F_TORQUE,
    F_ASPERITY,
    F_FILM,
    F_SURFACE,
    F_STRESS,
    F_THERMAL,
    F_MODIFICATION,
    F_ALLOWABLE,
    F_FILM_TEMPERATURE,
    F_FLASH,
    F_RATIO,
    F_FRICTION,
    F_POWER,
    F_MODIFICATION_1020,
    F_MODIFICATION_4340,
    F_ALLOWABLE_1020,
    F_ALLOWABLE_4340,
    F_UTILIZATION_1020,
    F_UTILIZATION_4340,
    F_MEAN_FRICTION,
    F_FLASH_MAX,
    F_BULK,
    F_OIL_HEAT,
    F_STORED,
    F_PRESSURE_MAX,
    F_PITTING_STRESS,
    F_PITTING_SAFETY,
    F_SCUFFING_SAFETY,
    F_SCUFFING_MARGIN,
    F_FILM_GF,
    F_MICROPITTING,
    F_OIL_ENERGY,
    F_ROOT_STRESS,
    F_ROOT_SAFETY,
    F_SCUFFING_FRICTION,
    F_LINE_LOAD,
    F_WIDTH,
    F_PRESSURE,
    F_SLIDING,
    F_VISCOSITY,
    F_WEIGHT,
    F_AREA,
    F_STATUS,
    F_ITERATIONS,
    F_BULK_VISCOSITY,
    F_SURFACE_RISE,
    F_FILM_RISE,
    F_STRESS_SLOPE,
    F_FRICTION_SLOPE,
    F_FREE_AREA,
    F_FREE_AREA_SLOPE,
    F_SMOOTH_SIGN,
    F_SPEED_SLOPE,
    F_SCUFFING_SLOPE,
    F_GF_PLACE,
    F_GF_RISE,
    F_GF_FLASH,
    N_FIELD,
) = range(58)
# Behind them, for the level `fine` of the paper's heat: numbers of the hottest position, those of
# the position at hand, the constants there; then, for both heats, the number of the hottest.
W_HOTTEST, W_HERE, W_LOCAL, W_PLACE = N_FIELD, 2 * N_FIELD, 3 * N_FIELD, 3 * N_FIELD + D_POSITION
# Where the loss heats: how the step began (HELD and so on), the bodies over the oil then [K],
# duration [s]; speed over which the torque rises [rad/s]; the way of the power, from 1, in at the
# load's shaft, to -1, out there; friction of every position, in mixed friction the contact's share.
W_BEGAN, W_FROM, W_DURATION, W_WIDTH, W_WAY, W_FRICTION = range(W_PLACE + 1, W_PLACE + 7)
W_CONTACT, W_PAR = W_FRICTION + N_PATH, W_FRICTION + 2 * N_PATH
# Where stiffness shares the load: all constants with the shares at the load at hand; scratch for
# solving the point again with others.
W_AGAIN = W_PAR + NPAR
W_MEMORY = W_AGAIN + W_PAR + NSTATE  # of the driveline, while a step is made
W_TOLD = W_MEMORY + N_MEMORY  # numbers in what the mesh says of its speed
W_STATE = W_TOLD + N_FIGURES  # scratch of model exchange: memory, inputs
W_STATES = W_STATE + NSTATE + NINP  # the states of model exchange after a step: body, bend, energy
NWORK = W_STATES + 3
NOUT = 35
IO_REGIME, IO_STATUS, NIOUT = range(3)

FILM, MIXED, BOUNDARY = range(1, 4)  # regimes
# What stands where there is no such number: safety without a limit, endurance without its data.
NO_LIMIT, NO_DATA = 1000.0, -1.0
# Numbers of the enumerations.
FIELD, FINE = 3, 4  # fidelity; 1 and 2 were simpler and run as FIELD
ROUGH = 1  # surface
LI_SEIREG, ISO, CONSTANT, MIXED_FRICTION, SCHLENK, EFFICIENCY = range(1, 7)  # friction_law
LOSS = 1  # film_heat, 2 is the paper's
QUASI_STEADY = 1  # thermal_mode, 2 is transient
STEADY_START = 1  # thermal_start, 2 is the oil's temperature
HELD, STEADY, OILS = range(3)  # how a step began: as the last one ended, or with a first state
AISI4340, AISI1020, CASE_HARDENED = 1, 2, 3  # steel
AT_SURFACE = 1  # viscosity_at and film_viscosity, 2 is the inlet
CONSTANT_SHARE = 1  # heat_partition, 2 follows the speeds
ELASTIC = 2  # load_sharing, 1 is rigid
MINERAL, PAO, ESTER, POLYGLYCOL = range(1, 5)  # base_oil
AS_PINION = 1  # material_gear; 2 to 4 are nodular iron, grey iron, bronze
AMBIENT = 1  # traction_law, 2 is limited
BOUNDED, FREE = 1, 2  # area_law, 3 is constant
SMOOTH, SHARP = 1, 2  # switch, 3 is none
ON_SURFACE = 1  # asperity_base, 2 is the bulk
