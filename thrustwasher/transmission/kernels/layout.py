"""Where every number of the shift transmission lies in the arrays of its step."""

# places: P_ of parameters
P_ARRANGEMENT, P_SUN_TEETH, P_PLANET_TEETH, P_RING_TEETH, P_PROFILE_SHIFTED, P_PLANETS = range(0, 6)
P_NORMAL_MODULE, P_HELIX_ANGLE, P_INPUT_INERTIA, P_CARRIER_INERTIA, P_DRUM_INERTIA = range(6, 11)
P_INITIAL_ENGINE_SPEED, P_INITIAL_DRUM_SPEED, P_ENGINE_TORQUE, P_ENGINE_START_TIME = range(11, 15)
P_LOAD_TORQUE, P_LOAD_SPEED, P_CLUTCH_FORCE, P_BRAKE_FORCE, P_WASHERS = range(15, 20)
P_WASHER_RADIUS, P_THRUST_SHARE, P_PLANET_TILT, P_OIL_TEMPERATURE, P_COUPLING = range(20, 25)
P_CAPACITY_EXTRAPOLATION, P_TORQUE_AGE, P_TOLERANCE, P_SHAFT_STIFFNESS = range(25, 29)
P_SHAFT_DAMPING, P_VEHICLE_INERTIA, P_INITIAL_TWIST, P_ACTUATION = range(29, 33)
P_PISTON_INNER_RADIUS, P_PISTON_OUTER_RADIUS, P_PISTON_SUPPLY_RADIUS = range(33, 36)
P_BALANCE_SHARE, P_OIL_DENSITY, P_ROLLING_TORQUE, P_GRADE_TORQUE, P_RING_MESH = range(36, 41)
P_NEEDLE_COUNT, P_NEEDLE_LENGTH, P_NEEDLE_CLEARANCE, P_NEEDLE_SLICES, P_PLANET_MASS = range(41, 46)
P_WASHER_OUTER_RADIUS, P_END_PLAY, P_SUN_BEARING_SHAFT_1 = range(46, 49)
P_SUN_BEARING_COEFFICIENT, P_SUN_BEARING_MEAN_RADIUS, P_RING_BEARING_SHAFT_1 = range(50, 53)
P_RING_BEARING_COEFFICIENT, P_RING_BEARING_MEAN_RADIUS, P_CLUTCH_PISTON_AREA = range(54, 57)
P_CLUTCH_RETURN_SPRING, P_CLUTCH_FILL_VOLUME, P_CLUTCH_FILL_FLOW = range(57, 60)
P_CLUTCH_PRESSURE_LAG, P_BRAKE_PISTON_AREA, P_BRAKE_RETURN_SPRING = range(60, 63)
P_BRAKE_FILL_VOLUME, P_BRAKE_FILL_FLOW, P_BRAKE_PRESSURE_LAG = range(63, 66)
P_CLUTCH_PRESSURE_POINTS, P_CLUTCH_PRESSURE_TIME_1 = range(66, 68)
P_CLUTCH_PRESSURE_1 = 77
P_BRAKE_PRESSURE_POINTS, P_BRAKE_PRESSURE_TIME_1 = range(87, 89)
P_BRAKE_PRESSURE_1 = 98
P_ENGINE_TORQUE_POINTS, P_ENGINE_TORQUE_TIME_1 = range(108, 110)
P_ENGINE_TORQUE_1 = 119
P_FIDELITY, N_PARAM = range(129, 131)
# end of places
N_BEARING = 4  # parameters of a bearing
# From P_CLUTCH_PISTON_AREA on: N_OWN of the clutch's piston, as many of the brake's, 3 profiles.
OWN_SPRING, OWN_VOLUME, OWN_FLOW, OWN_LAG, N_OWN = range(1, 6)
MAX_POINTS = 10
N_PROFILE = 1 + 2 * MAX_POINTS  # number of points, their times, their values
P_CLUTCH_PROFILE, P_ENGINE_PROFILE = P_CLUTCH_PRESSURE_POINTS, P_ENGINE_TORQUE_POINTS

# Constants that derive() adds: ratio r, inverse mass matrix of (driven, carrier), and how slip
# accelerations (clutch, brake) fall with the torques of clutch and brake.
(
    D_RATIO,
    D_SPIN,
    D_INPUT_RADIUS,
    D_PLANET_RADIUS,
    D_TAN_HELIX,
    D_MESHES,
    D_INV_SS,
    D_INV_SC,
    D_INV_CC,
    D_SLIP_CC,
    D_SLIP_CB,
    D_SLIP_BB,
    D_HEAD,
    D_RING_MESHES,
    D_NEEDLE_LINE,
    D_LARGEST_TILT,
    D_CENTRE,
    D_BEARINGS,
) = range(N_PARAM, N_PARAM + 18)
# Of a bearing, from D_BEARINGS on: torque per torque in the driven gear's teeth, slip per speed of
# driven gear and carrier, share of its torque that stands against the driven gear itself.
BEARING_TORQUE, BEARING_DRIVEN, BEARING_CARRIER, BEARING_OWN, N_TURNING = range(5)
D_RUN_START = D_BEARINGS + 2 * N_TURNING  # time [s] that those of profiles count from: the shell's
NPAR = D_RUN_START + 1

(
    I_CLUTCH,
    I_BRAKE,
    I_WASHER,
    I_MESH,
    I_COMMAND,
    I_PRESSURE,
    I_BRAKE_PRESSURE,
    I_ENGINE,
    I_LOAD,
    I_RING_MESH,
    I_INPUT_LOSS,
    I_DRUM_LOSS,
    I_OUTPUT_LOSS,
    I_PLANET_LOSS,
    NINP,
) = range(15)

# The integrated quantities; in `state` they follow S_Y.
(
    Y_INPUT,
    Y_CARRIER,
    Y_VEHICLE,
    Y_TWIST,
    Y_ENGINE,
    Y_LOAD,
    Y_CLUTCH,
    Y_BRAKE,
    Y_WASHER,
    Y_MESH,
    Y_SHAFT,
    Y_BEARING,
    Y_LOSS,
    N_Y,
) = range(14)

S_STARTED = 0
S_Y = 1
(
    S_KINETIC_START,
    S_LAST_DURATION,
    S_SPREAD,  # the time that changes of inputs are spread over: the last step, or a longer one
    S_CLUTCH_MODE,
    S_BRAKE_MODE,
    S_LOCK_TIME,
    S_LOCK_SPEED,
    S_RELEASE_TIME,
    S_EVENTS,
    S_BEARING_POWER,
    S_LOSS_POWER,
    S_ADVISED,
    S_PISTON,
) = range(S_Y + N_Y, S_Y + N_Y + 13)
# Of a piston: pressure [Pa], volume of oil [m3], whether it is full, times [s] of two events.
(
    PISTON_PRESSURE,
    PISTON_VOLUME,
    PISTON_FULL,
    PISTON_FILLED_TIME,
    PISTON_KISS_TIME,
    N_PISTON,
) = range(6)
# The inputs: as the last step was given them, and what they had reached at its end.
S_GIVEN = S_PISTON + 2 * N_PISTON
S_REACHED = S_GIVEN + NINP
S_LAST_CLUTCH, S_CLUTCH_NOW = S_GIVEN + I_CLUTCH, S_REACHED + I_CLUTCH
S_LAST_PRESSURE = S_REACHED + I_PRESSURE
NSTATE = S_REACHED + NINP

# Work: what holds during one interval of a step, then the vectors of the integrator.
(
    W_CLUTCH_GIVEN,
    W_BRAKE_GIVEN,  # torques taken as they are (coupling torque)
    W_CLUTCH_START,
    W_CLUTCH_SLOPE,
    W_BRAKE_START,
    W_BRAKE_SLOPE,  # capacities, linear in time
    W_WASHERS,
    W_MESHES,
    W_DRAG,  # drag torques at the planets; both as a torque at the clutch
    W_ENGINE,
    W_CLUTCH_MODE,
    W_BRAKE_MODE,
    W_CLUTCH_ACTIVE,
    W_BRAKE_ACTIVE,
    W_CLUTCH,
    W_BRAKE,
    W_INPUT_RATE,
    W_CARRIER_RATE,  # results of solve_torques
    W_ENGINE_START,
    W_ENGINE_SLOPE,
    W_ENGINE_GIVEN,
    W_LOAD_GIVEN,  # torques from outside
    W_TEETH,  # torque in the driven gear's teeth
    W_BEARING_TEETH,  # its size as the bearings feel it
    W_BEARING_DRIVEN,
    W_BEARING_CARRIER,
    W_BEARING_OWN,  # per size of it: what the bearings take
    W_INPUT_LOSS,
    W_DRUM_LOSS,
    W_OUTPUT_LOSS,
    W_PLANET_LOSS,  # sizes of the torques against shafts and, all together, planets
    W_LOSS_DRIVEN,
    W_LOSS_CARRIER,
    W_LOSS_OWN,  # what they take from driven gear and carrier; from the driven gear's own shaft
) = range(34)
W_EVENTS = 34  # five slots: lock time, lock speed, release time, events, largest violation
W_PISTON = 39
W_Y = W_PISTON + 2 * N_PISTON
W_NEW = W_Y + N_Y
W_STAGE = W_NEW + N_Y
W_SLOPES = W_STAGE + N_Y
N_STAGES = 7
W_TAKEN = W_SLOPES + N_STAGES * N_Y  # the inputs as the step takes them, then their rates
W_ENGINE_RATE = W_TAKEN + NINP + I_ENGINE
W_SETTLED = W_TAKEN + 2 * NINP  # of a planet on its needles, then its loads
N_SETTLED = 52
W_PLANET_LOADS = W_SETTLED + N_SETTLED
NWORK = W_PLANET_LOADS + 4

# places: O_ of outputs
O_CLUTCH_LOAD, O_CLUTCH_SPEED, O_BRAKE_LOAD, O_BRAKE_SPEED, O_WASHER_LOAD = range(0, 5)
O_WASHER_SPEED, O_WASHER_TILT, O_MESH_LOAD, O_MESH_SPEED, O_ENGINE_SPEED = range(5, 10)
O_OUTPUT_SPEED, O_DRUM_SPEED, O_DRIVE_TORQUE, O_RESISTANCE_TORQUE, O_CLUTCH_REACTION = range(10, 15)
O_BRAKE_REACTION, O_INPUT_TOOTH_TORQUE, O_DRAG_TORQUE, O_TOOTH_FORCE = range(15, 19)
O_TILTING_COUPLE, O_SUN_THRUST, O_ENGINE_WORK, O_LOAD_WORK, O_KINETIC_ENERGY = range(19, 24)
O_KINETIC_CHANGE, O_CLUTCH_HEAT, O_BRAKE_HEAT, O_WASHER_HEAT, O_MESH_HEAT = range(24, 29)
O_ENERGY_RESIDUAL, O_LOCK_TIME, O_LOCK_SPEED, O_RELEASE_TIME = range(29, 33)
O_OIL_SUPPLY_TEMPERATURE, O_VEHICLE_SPEED, O_SHAFT_TORQUE, O_SHAFT_TWIST = range(33, 37)
O_SHAFT_HEAT, O_SHAFT_ENERGY, O_OUTPUT_TORQUE, O_OUTPUT_ACCELERATION = range(37, 41)
O_CLUTCH_HUB_SPEED, O_CLUTCH_DRUM_SPEED, O_BRAKE_HUB_SPEED, O_BRAKE_DRUM_SPEED = range(41, 45)
O_CLUTCH_PISTON_PRESSURE, O_BRAKE_PISTON_PRESSURE, O_CLUTCH_FILLED_TIME = range(45, 48)
O_BRAKE_FILLED_TIME, O_CLUTCH_KISS_TIME, O_BRAKE_KISS_TIME, O_SUN_BEARING_TORQUE = range(48, 52)
O_RING_BEARING_TORQUE, O_BEARING_POWER, O_BEARING_HEAT, O_ADVISED_STEP, O_LOSS_POWER = range(52, 57)
O_LOSS_HEAT, NOUT = range(57, 59)
# end of places
IO_CLUTCH_LOCKED, IO_BRAKE_LOCKED, IO_CLUTCH_FILLED, IO_BRAKE_FILLED = range(4)
IO_EVENTS, IO_STATUS, NIOUT = range(4, 7)

RING_INPUT = 2  # arrangement
PRESSURE = 2  # actuation
TORQUE_COUPLING = 2
SUN, CARRIER, RING, CASE = range(1, 5)  # shafts of a bearing
STUCK = 0.0  # modes of a pack: 1 slips forward, -1 slips backward, 0 sticks
