"""Where each number of the gear mesh lies in its arrays."""

# Parameters, in the order of GearMeshParams.
(
    P_GEAR_RATIO, P_PINION_TEETH, P_CENTRE_DISTANCE, P_PRESSURE_ANGLE, P_ADDENDUM, P_FACE_WIDTH,
    P_LOAD_SHARE, P_SURFACE, P_SIGMA_RMS, P_EFFECTIVE_ROUGHNESS, P_MEAN_ROUGHNESS, P_FRICTION_LAW,
    P_F0, P_CONSTANT_FRICTION, P_STEEL, P_YOUNGS_MODULUS, P_POISSON_RATIO, P_CONDUCTIVITY,
    P_HEAT_CAPACITY, P_DENSITY, P_THERMAL_EXPANSION, P_OIL_CONDUCTIVITY, P_OIL_HEAT_CAPACITY,
    P_OIL_DENSITY, P_VISCOSITY_SCALE, P_VISCOSITY_B, P_VISCOSITY_C, P_VISCOSITY_AT,
    P_FILM_VISCOSITY, P_PRESSURE_VISCOSITY, P_HEAT_PARTITION, P_PARTITION_SHARE, P_TRACTION_LAW,
    P_LIMITING_TRACTION, P_ASPERITY_GROUP, P_HARDNESS_FACTOR, P_AREA_LAW, P_AREA_RATIO, P_SWITCH,
    P_ASPERITY_BASE, P_SPEED_SMOOTHING, P_FIDELITY,
) = range(42)  # fmt: skip
N_PARAM = 42
# Constants that derive() adds: geometry per unit of speed and torque, surface, material.
(
    D_START, D_SLIDE_ROLL, D_RADIUS, D_LINE, D_V1, D_V2, D_SLIDING, D_ROLLING, D_PITCH_RADIUS,
    D_LOSS, D_THETA, D_CAPACITY, D_OIL_CAPACITY, D_EFFUSIVITY, D_SIGMA, D_ROUGHNESS, D_MEAN,
    D_SHARE, D_CONTACT_RATIO, D_PLACES,
) = range(42, 62)  # fmt: skip
# The line of action, for the rung `fine`: positions from the pitch point in base pitches, shares of
# the load that heat the pair there, shares of the loss; D_PLACES is the number of positions.
N_PATH = 80
D_POSITION, D_PATH_SHARE, D_PATH_LOSS, NPAR = 62, 62 + N_PATH, 62 + 2 * N_PATH, 62 + 3 * N_PATH
I_LOAD, I_SPEED, I_OIL = range(3)
NINP = 3
NSTATE = 1  # unused: the mesh follows its inputs at once
# What is known of one operating point; the real outputs come first, in their order.
(
    F_TORQUE, F_ASPERITY, F_FILM, F_SURFACE, F_STRESS, F_THERMAL, F_MODIFICATION, F_ALLOWABLE,
    F_FILM_TEMPERATURE, F_FLASH, F_RATIO, F_FRICTION, F_POWER, F_MODIFICATION_1020,
    F_MODIFICATION_4340, F_ALLOWABLE_1020, F_ALLOWABLE_4340, F_UTILIZATION_1020,
    F_UTILIZATION_4340, F_LINE_LOAD, F_WIDTH, F_PRESSURE, F_SLIDING, F_VISCOSITY, F_WEIGHT, F_AREA,
    F_STATUS, F_ITERATIONS, F_BULK_VISCOSITY, F_SURFACE_RISE, F_FILM_RISE, F_STRESS_SLOPE,
    F_FRICTION_SLOPE, F_FREE_AREA, F_FREE_AREA_SLOPE, F_SMOOTH_SIGN, F_FREE_RISE,
) = range(37)  # fmt: skip
N_FIELD = 37
# Behind them, for the rung `fine`: the hottest position's own numbers, those of the position at
# hand, the constants there, the number of the hottest.
W_HOTTEST, W_HERE, W_LOCAL, W_PLACE = N_FIELD, 2 * N_FIELD, 3 * N_FIELD, 3 * N_FIELD + 62
NWORK = W_PLACE + 1
NOUT = 19
IO_REGIME, IO_STATUS = range(2)
NIOUT = 2

FILM, MIXED, BOUNDARY = range(1, 4)  # regimes
# Numbers of the enumerations.
CLOSED, STRIBECK, FIELD, FINE = range(1, 5)  # fidelity
ROUGH = 1  # surface
LI_SEIREG, ISO = 1, 2  # friction_law, 3 is constant
AISI4340 = 1  # steel
AT_SURFACE = 1  # viscosity_at and film_viscosity, 2 is the inlet
CONSTANT_SHARE = 1  # heat_partition, 2 follows the speeds
AMBIENT = 1  # traction_law, 2 is limited
BOUNDED, FREE = 1, 2  # area_law, 3 is constant
SMOOTH, SHARP = 1, 2  # switch, 3 is none
ON_SURFACE = 1  # asperity_base, 2 is the bulk
