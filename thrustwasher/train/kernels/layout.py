"""Where each number of the gear train lies in its arrays."""

from ...gearmesh.kernels import layout as G
from ...losses.kernels import skf_series
from ...tribology.holding.memory import N_FIGURES, N_MEMORY

MESHES, SHAFTS, ENDS = 3, 4, 2  # at most; bearings of a shaft
SERIES_ROW = skf_series.ROW  # type and constants of a bearing's series
PUSHES = 2  # at most: forces from outside on a shaft
# Parameters of a mesh: all meshes share oil and thermal mode; no rings, and none holds.
SHARED = (
    G.P_THERMAL_MODE,
    G.P_THERMAL_START,
    G.P_OIL_CONDUCTIVITY,
    G.P_OIL_HEAT_CAPACITY,
    G.P_OIL_DENSITY,
    G.P_VISCOSITY_SCALE,
    G.P_VISCOSITY_B,
    G.P_VISCOSITY_C,
    G.P_PRESSURE_VISCOSITY,
    G.P_SPEED_SMOOTHING,
    G.P_BASE_OIL,
)
FIXED = (G.P_INTERNAL, G.P_HOLDING, G.P_COUPLING_INERTIA, G.P_COUPLING_AGE)
OWN = tuple(i for i in range(G.P_FIDELITY) if i not in SHARED + FIXED)
N_SHARED, N_FIXED, N_OWN = len(SHARED), len(FIXED), len(OWN)
# The train: number of meshes, oil that the gears dip into, life that is asked for, law of bearings.
P_MESHES, P_OIL_VOLUME, P_STARVATION, P_REQUIRED_LIFE, P_LAW, P_FILM, P_SHARED = range(7)
# Of each mesh, before the parameters of its pair: who drives, hand of the pinion's helix, positions
# along the shafts, angle of the centre line, depths in the oil over diameter.
(
    A_DRIVER,
    A_HAND,
    A_PINION_POSITION,
    A_GEAR_POSITION,
    A_ANGLE,
    A_PINION_IMMERSION,
    A_GEAR_IMMERSION,
    A_PAIR,
) = range(8)
P_MESH, MESH_ROW = P_SHARED + N_SHARED, A_PAIR + N_OWN
# Of each shaft, then of each of its bearings, then of each force from outside.
B_AXIAL, B_SEALS, B_SEAL_DIAMETER, B_BEARING = range(4)
(
    C_KIND,
    C_POSITION,
    C_DIAMETER,
    C_SECTION,
    C_CAPACITY,
    C_X,
    C_Y,
    C_E,
    C_INDUCED,
    C_CENTRE,
    C_VISCOUS,
    C_LOAD,
    C_SERIES,
    C_STATIC,
    BEARING_ROW,
) = range(15)
(
    H_POSITION,
    H_RADIAL,
    H_DIRECTION,
    H_AXIAL,
    H_MOMENT,
    H_MOMENT_DIRECTION,
    PUSH_ROW,
) = range(7)
B_PUSH = B_BEARING + ENDS * BEARING_ROW
P_SHAFT, SHAFT_ROW = P_MESH + MESHES * MESH_ROW, B_PUSH + PUSHES * PUSH_ROW
P_FIDELITY = P_SHAFT + SHAFTS * SHAFT_ROW
N_PARAM = P_FIDELITY + 1
# What `derive` adds: of each mesh the ratio of speeds, radii of driver and driven [m], force per
# torque of the driver, radial and axial over tangential; constants of churning of both gears
# (`churning_constants`, radius times width, cube root of that times the radius); of each bearing
# its starvation, type and constants of its series; viscosity at 40 degC; the pairs' own arrays.
E_RATIO, E_DRIVER, E_DRIVEN, E_RADIAL, E_AXIAL, E_GEARS = range(6)
GEAR_ROW = 4
E_ROW = E_GEARS + 2 * GEAR_ROW
D_MESH = N_PARAM
D_STARVED = D_MESH + MESHES * E_ROW
D_SERIES = D_STARVED + SHAFTS * ENDS
D_NU_40 = D_SERIES + SHAFTS * ENDS * SERIES_ROW
D_PAIR = D_NU_40 + 1
NPAR = D_PAIR + MESHES * G.NPAR
I_TORQUE, I_SPEED, I_OIL, NINP = range(4)
# Memory: the pairs' own, heat into the oil [J], what the drag remembers of the first shaft.
S_ENERGY = MESHES * G.NSTATE
S_MEMORY = S_ENERGY + 1
NSTATE = S_MEMORY + N_MEMORY
(
    O_LOSS_TORQUE,
    O_OUTPUT_TORQUE,
    O_OUTPUT_SPEED,
    O_EFFICIENCY,
    O_LOSS,
    O_MESH_LOSS,
    O_BEARING_LOSS,
    O_SEAL_LOSS,
    O_CHURNING_LOSS,
    O_HEAT,
    O_ENERGY,
    O_PITTING,
    O_ROOT,
    O_SCUFFING,
    O_LIFE,
    O_MESH,
) = range(16)
# Of each mesh: loss [W], bodies [K], forces on the pinion [N], safeties.
(
    M_LOSS,
    M_BULK,
    M_TANGENTIAL,
    M_RADIAL,
    M_AXIAL,
    M_PITTING,
    M_ROOT,
    M_SCUFFING,
    M_ROW,
) = range(9)
O_BEARING = O_MESH + MESHES * M_ROW
# Of each bearing: forces and equivalent load [N], loss [W], rating life [s].
R_RADIAL, R_AXIAL, R_LOAD, R_LOSS, R_LIFE, R_ROW = range(6)
NOUT = O_BEARING + SHAFTS * ENDS * R_ROW
IO_STATUS = MESHES * G.NIOUT
NIOUT = IO_STATUS + 1
# `work`: torque [N m] of each driver, force [N] on it (x along the shafts, y and z), friction as a
# torque on the driver; loss torques of each shaft: its bearings, seals, churning; radial and axial
# force of each bearing; speed of each
# shaft, torque at the output; then inputs, outputs and scratch of a pair.
W_TORQUE = 0
W_FORCE = W_TORQUE + MESHES
W_FRICTION = W_FORCE + 3 * MESHES
LOSSES = ENDS + 2
W_LOSS = W_FRICTION + MESHES
W_BEARING = W_LOSS + SHAFTS * LOSSES
W_SPEED = W_BEARING + SHAFTS * ENDS * 2
W_END = W_SPEED + SHAFTS
W_SCRATCH = W_END + 1
W_INP = W_SCRATCH + 3
W_OUT = W_INP + G.NINP
W_PAIR = W_OUT + MESHES * G.NOUT
W_MEMORY = W_PAIR + G.NWORK  # of the driveline, while a step is made
W_TOLD = W_MEMORY + N_MEMORY  # numbers in what the train says of its speed
W_ADVICE = W_TOLD + N_FIGURES  # of each mesh: advice or failure
# Of model exchange: of each mesh how far it is from where the laws are stretched; the pairs' own
# memory; inputs and states at hand; what is told at them, what at others.
W_ROOM = W_ADVICE + MESHES
W_STATE = W_ROOM + MESHES
W_POINT = W_STATE + MESHES * G.NSTATE
N_TOLD = NOUT + 1 + MESHES
W_HERE = W_POINT + NINP + MESHES
W_THERE = W_HERE + N_TOLD
W_TRIED = W_THERE + N_TOLD
W_STATES = W_TRIED + N_TOLD  # the states of model exchange after a step: bodies, bend, energy
NWORK = W_STATES + MESHES + 2
PINION, GEAR = 1, 2  # who drives
RIGHT, LEFT = 1, 2  # hand
FIRST, SECOND, PUSHED = 1, 2, 3  # which bearing takes the axial force
BACK_TO_BACK, FACE_TO_FACE = 4, 5  # arrangements O and X, in which both may
BALL, ANGULAR, CYLINDRICAL, TAPER = range(1, 5)
NONE = -1.0  # of what is not there
RULES = 6  # of each shaft
