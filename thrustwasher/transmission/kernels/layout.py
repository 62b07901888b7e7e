"""Where every number of the shift transmission lies in the arrays of its step."""

# Parameters, in the order of TransmissionParams.
(
    P_SUN_TEETH, P_PLANET_TEETH, P_RING_TEETH, P_PLANETS, P_NORMAL_MODULE, P_HELIX_ANGLE,
    P_SUN_INERTIA, P_CARRIER_INERTIA, P_RING_INERTIA, P_INITIAL_ENGINE_SPEED,
    P_INITIAL_RING_SPEED, P_ENGINE_TORQUE, P_ENGINE_START_TIME, P_LOAD_TORQUE, P_LOAD_SPEED,
    P_CLUTCH_FORCE, P_BRAKE_FORCE, P_WASHERS, P_WASHER_RADIUS, P_THRUST_SHARE, P_PLANET_TILT,
    P_OIL_TEMPERATURE, P_COUPLING, P_CAPACITY_EXTRAPOLATION, P_TORQUE_AGE, P_TOLERANCE,
    P_SHAFT_STIFFNESS, P_SHAFT_DAMPING, P_VEHICLE_INERTIA, P_INITIAL_TWIST, P_FIDELITY,
) = range(31)  # fmt: skip
N_PARAM = 31

# Constants that derive() adds: ratio r, inverse mass matrix of (sun, carrier), and how slip
# accelerations (clutch, brake) fall with the torques of clutch and brake.
(
    D_RATIO, D_SPIN, D_SUN_RADIUS, D_PLANET_RADIUS, D_TAN_HELIX, D_MESHES,
    D_INV_SS, D_INV_SC, D_INV_CC, D_SLIP_CC, D_SLIP_CB, D_SLIP_BB,
) = range(31, 43)  # fmt: skip
NPAR = 43

I_CLUTCH, I_BRAKE, I_WASHER, I_MESH, I_COMMAND = range(5)
NINP = 5

# The integrated quantities; in `state` they follow S_Y.
(
    Y_SUN, Y_CARRIER, Y_VEHICLE, Y_TWIST,
    Y_ENGINE, Y_LOAD, Y_CLUTCH, Y_BRAKE, Y_WASHER, Y_MESH, Y_SHAFT,
) = range(11)  # fmt: skip
N_Y = 11

S_STARTED = 0
S_Y = 1
(
    S_KINETIC_START, S_LAST_CLUTCH, S_LAST_BRAKE, S_LAST_DURATION, S_CLUTCH_NOW, S_BRAKE_NOW,
    S_CLUTCH_MODE, S_BRAKE_MODE, S_LOCK_TIME, S_LOCK_SPEED, S_RELEASE_TIME, S_EVENTS,
) = range(S_Y + N_Y, S_Y + N_Y + 12)  # fmt: skip
NSTATE = S_Y + N_Y + 12

# Work: what holds during one stretch of a step, then the vectors of the integrator.
(
    W_CLUTCH_GIVEN, W_BRAKE_GIVEN,  # torques taken as they are (coupling torque)
    W_CLUTCH_START, W_CLUTCH_SLOPE, W_BRAKE_START, W_BRAKE_SLOPE,  # capacities, linear in time
    W_WASHERS, W_MESHES, W_DRAG,  # drag torques at the planets; both as a torque at the clutch
    W_ENGINE, W_CLUTCH_MODE, W_BRAKE_MODE, W_CLUTCH_ACTIVE, W_BRAKE_ACTIVE,
    W_CLUTCH, W_BRAKE, W_SUN_RATE, W_CARRIER_RATE,  # results of solve_torques
    W_ERROR, W_SPARE,
) = range(20)  # fmt: skip
W_EVENTS = 20  # five slots: lock time, lock speed, release time, events, largest violation
W_Y = 25
W_NEW = W_Y + N_Y
W_STAGE = W_NEW + N_Y
W_SLOPES = W_STAGE + N_Y
N_STAGES = 7
NWORK = W_SLOPES + N_STAGES * N_Y

# Real outputs, in the order of SPEC.outputs.
(
    O_CLUTCH_LOAD, O_CLUTCH_SPEED, O_BRAKE_LOAD, O_BRAKE_SPEED, O_WASHER_LOAD, O_WASHER_SPEED,
    O_WASHER_TILT, O_MESH_LOAD, O_MESH_SPEED, O_ENGINE_SPEED, O_OUTPUT_SPEED, O_RING_SPEED,
    O_DRIVE_TORQUE, O_RESISTANCE_TORQUE, O_CLUTCH_REACTION, O_BRAKE_REACTION, O_SUN_TORQUE,
    O_DRAG_TORQUE, O_TOOTH_FORCE, O_TILTING_COUPLE, O_SUN_THRUST, O_ENGINE_WORK, O_LOAD_WORK,
    O_KINETIC_ENERGY, O_KINETIC_CHANGE, O_CLUTCH_HEAT, O_BRAKE_HEAT, O_WASHER_HEAT, O_MESH_HEAT,
    O_ENERGY_RESIDUAL, O_LOCK_TIME, O_LOCK_SPEED, O_RELEASE_TIME, O_OIL_SUPPLY_TEMPERATURE,
    O_VEHICLE_SPEED, O_SHAFT_TORQUE, O_SHAFT_TWIST, O_SHAFT_HEAT, O_SHAFT_ENERGY,
) = range(39)  # fmt: skip
NOUT = 39
IO_CLUTCH_LOCKED, IO_BRAKE_LOCKED, IO_EVENTS, IO_STATUS = range(4)
NIOUT = 4

TORQUE_COUPLING = 2
STUCK = 0.0  # modes of a pack: 1 slips forward, -1 slips backward, 0 sticks
