"""Where the wet clutch keeps its numbers: places in the arrays of parameters, state and work."""

# Parameters, in the order of ClutchParams.
(
    P_INNER_RADIUS, P_OUTER_RADIUS, P_FACES, P_EFFECTIVE_RADIUS, P_FRICTION_LAW,
    P_CONSTANT_FRICTION, P_TABLE_FRICTION_0, P_TABLE_SPEED_1, P_TABLE_FRICTION_1, P_TABLE_SPEED_2,
    P_TABLE_FRICTION_2, P_TABLE_SPEED_3, P_TABLE_FRICTION_3, P_TABLE_SPEED_4, P_TABLE_FRICTION_4,
    P_TABLE_SPEED_5, P_TABLE_FRICTION_5, P_INDENTATION, P_PLOUGH_WEIGHT, P_HARDNESS_RATIO,
    P_ADHESION_FACTOR,
    P_SHEAR_FLOOR, P_STICK_SPEED, P_DECAY_SPEED, P_KINK_WIDTH, P_SHEAR_TEMPERATURE_SLOPE,
    P_REFERENCE_TEMPERATURE, P_ROUGHNESS, P_CONTACT_MODULUS, P_ASPERITY_DENSITY,
    P_ASPERITY_RADIUS, P_LINING_THICKNESS, P_PERMEABILITY, P_GROOVE_FACTOR, P_INITIAL_FILM,
    P_STARTS_PRESSED, P_FILM_DYNAMICS, P_SHEAR_HEATING, P_OIL_FLOW, P_OIL_DENSITY,
    P_OIL_CONDUCTIVITY, P_VISCOSITY_CONSTANT, P_VISCOSITY_EXPONENT, P_VISCOSITY_SCALE,
    P_STEEL_THICKNESS, P_STEEL_DENSITY, P_STEEL_HEAT_CAPACITY, P_STEEL_CONDUCTIVITY,
    P_CONTACT_RISE, P_HEAT_TRANSFER, P_SPEED_SMOOTHING, P_INPUT_COURSE, P_FIDELITY,
) = range(53)  # fmt: skip
N_PARAM = 53

N_MODES = 8  # of heat conduction across half a steel plate

# Constants behind them.
(
    D_AREA, D_RADIUS, D_PLOUGH, D_ADHESION, D_PRESSURE, D_CONTACT_AREA, D_CAPACITY, D_COOLING,
    D_CLOSING, D_SEEPAGE, D_VISCOUS, D_DEMAND, D_SUPPLY, D_OPEN_RATIO, D_MODES,
) = range(N_PARAM, N_PARAM + 15)  # fmt: skip
D_DECAY = N_PARAM + 15  # decay rate [1/s] of the lumped heat, then of each mode
D_GAIN = D_DECAY + 1 + N_MODES  # their rise [K/s] per W into a face
N_PACK = D_GAIN + 1 + N_MODES
# The rung `fine` behind them: the number of rings, each ring's weight in the squeezed film, then a
# block like all of the above for each ring.
MAX_RINGS, N_RINGS = 8, 4  # at most, and those of the rung
D_RINGS, D_SQUEEZE, D_BLOCKS = N_PACK, N_PACK + 1, N_PACK + 1 + MAX_RINGS
NPAR = D_BLOCKS + MAX_RINGS * N_PACK

I_LOAD, I_SPEED, I_OIL = range(3)
NINP = 3

# Memory. What has to do with a point in time belongs to the last one whose inputs are known.
(
    S_STARTED, S_FILM, S_ENERGY, S_HEAT,
) = range(4)  # fmt: skip
S_MODES = 4
(
    S_SHOWN_TEMPERATURE, S_SHOWN_ENERGY, S_POWER, S_LOAD, S_SLIP, S_OIL, S_DURATION, S_SUBSTEP,
) = range(S_MODES + N_MODES, S_MODES + N_MODES + 8)  # fmt: skip
# Of the rung `fine`, ring by ring: mean temperature and modes of the plate.
S_RINGS = S_MODES + N_MODES + 8
N_BODY = 1 + N_MODES
NSTATE = S_RINGS + MAX_RINGS * N_BODY

# The unknowns of the moving film: film ratio, energy of a face, lumped temperature, modes.
Y_FILM, Y_ENERGY, Y_HEAT = range(3)
NY = 3 + N_MODES
N_STAGES = 6
W_NOW, W_TRIAL, W_RATE = 0, NY, 2 * NY
W_STAGES = 3 * NY
W_SUBSTEPS = W_STAGES + N_STAGES * NY  # counts: accepted and refused substeps
W_REFUSED = W_SUBSTEPS + 1
W_PROPOSED = W_SUBSTEPS + 2  # size [s] the next substep should have
W_DURATION = W_SUBSTEPS + 3  # the step [s] that all this belongs to
# Slopes behind the outputs shown: of both torques (>= 0) over load, |slip|, film ratio, interface
# temperature; of the other outputs; film ratio over the load where it settles with it.
(
    W_CONTACT, W_CONTACT_LOAD, W_CONTACT_SLIP, W_CONTACT_FILM, W_CONTACT_HEAT,
    W_VISCOUS, W_VISCOUS_SLIP, W_VISCOUS_FILM, W_VISCOUS_HEAT,
    W_FRICTION_SLIP, W_FRICTION_HEAT, W_SHARE_FILM, W_VISCOSITY_HEAT, W_SMOOTH, W_SETTLED_LOAD,
) = range(W_SUBSTEPS + 4, W_SUBSTEPS + 19)  # fmt: skip
# Slopes at each stage of the last substep, then where the drift of the rates was read: of the film
# rate over film ratio and temperature, of the power over both; of rate, power over the load; of the
# power over the slip.
W_KEPT, N_KEPT = W_SUBSTEPS + 19, 7
W_VARIED = W_KEPT + (N_STAGES + 1) * N_KEPT  # changes of the unknowns with the inputs
W_VARIED_DRIFT = W_VARIED + NY
W_VARIED_STAGES = W_VARIED + 2 * NY
# Of the rung `fine`: unknowns, changes of them, trial values and changes, the stages' rates and
# theirs; then the rings' numbers at hand.
NZ = 2 + MAX_RINGS * N_BODY  # film ratio, energy of a face, then each ring
Z_FILM, Z_ENERGY, Z_RINGS = range(3)
N_FINE_STAGES, N_AT = 5, 12
W_Z = W_VARIED_STAGES + N_STAGES * NY
W_DZ, W_BASE, W_DBASE, W_K, W_DK = (
    W_Z + NZ, W_Z + 2 * NZ, W_Z + 3 * NZ, W_Z + 4 * NZ, W_Z + (4 + N_FINE_STAGES) * NZ,
)  # fmt: skip
W_AT = W_DK + N_FINE_STAGES * NZ
W_SURFACE = W_AT + MAX_RINGS * N_AT  # interface temperatures of the rings, their changes
NWORK = W_SURFACE + 2 * MAX_RINGS

(
    O_TORQUE, O_TEMPERATURE, O_FILM, O_CAPACITY, O_COEFFICIENT, O_RATIO, O_POWER, O_ENERGY,
    O_CONTACT_TORQUE, O_VISCOUS_TORQUE, O_CONTACT_SHARE, O_HEAT_FLUX, O_VISCOSITY,
) = range(13)  # fmt: skip
NOUT = 13
IO_REGIME, IO_STATUS = range(2)
NIOUT = 2

CLOSED, BOUNDARY_ONLY, STRIBECK, FIELD, FINE = range(1, 6)  # fidelity
CONSTANT_LAW, TABLE_LAW = 2, 3  # friction_law
N_TABLE = 5  # points above standstill
LINEAR_COURSE = 2  # input_course
OK, OUTSIDE_VERIFIED, HOT, MAX_ITERATIONS, NOT_FINITE, BAD_INPUT = 0, 1, 2, 10, 14, 15
HOT_LIMIT = 523.0  # K
LEAST_RATIO = -3.0  # film ratio below which rough faces are pressed out of the models' reach
OPEN_PRESSURE = 1e3  # Pa; a pack pressed less than this is open
OPENING_TIME = 0.05  # s
